//! The paper's Fig. 11: response of the oscillator with 0, 20, 40 and 60 particles, the strict law
//! (solid) against the approximate one (dashed).
//!
//! `cargo run --release --example response` leaves `target/response/response.csv` and `.svg`;
//! `-- --help` lists the options, `-- --quick` takes a few points. The picture of the README:
//! `cp target/response/response.svg examples/pictures/`.

#[path = "support/bends.rs"]
mod bends;
#[path = "support/chart.rs"]
mod chart;
#[path = "support/choice.rs"]
mod choice;
#[path = "support/output.rs"]
mod output;
#[path = "support/progress.rs"]
mod progress;
#[path = "support/spread.rs"]
mod spread;

use std::error::Error;
use std::ops::ControlFlow;

use chart::{Chart, Line};
use choice::{AnyDetector, AnyIntegrator, DetectorName, IntegratorName};
use clap::{Parser, ValueEnum};
use particle_damper::response::{Point, Response};
use particle_damper::{
    ContactLaw, HertzMindlin, HertzTsuji, Material, ResponseCurve, RestitutionImpulse, Slot,
};
use plotters::prelude::SeriesLabelPosition;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum LawName {
    /// The paper's strict law.
    HertzTsuji,
    /// Strict, with a tangential spring.
    HertzMindlin,
    /// The approximate law.
    Restitution,
    /// The approximate law as it is printed; it loses particles.
    Literal,
}

impl LawName {
    /// The paper's time steps.
    const fn time_step(self) -> f64 {
        match self {
            Self::HertzTsuji | Self::HertzMindlin => 2e-5,
            Self::Restitution | Self::Literal => 1e-4,
        }
    }
}

/// Response curves of the paper's particle damper.
#[derive(Debug, Parser)]
struct Options {
    /// Contact laws to compare.
    #[arg(long, value_delimiter = ',', default_value = "hertz-tsuji,restitution")]
    laws: Vec<LawName>,
    /// How time is integrated.
    #[arg(long, default_value = "verlet")]
    integrator: IntegratorName,
    /// How contacts are found; all but paper-grid give the same bits.
    #[arg(long, default_value = "linked-cells")]
    detector: DetectorName,
    /// Cells of the grids, up and across.
    #[arg(long, value_delimiter = 'x', default_value = "32x20")]
    grid: Vec<usize>,
    /// Time steps in s; unless given 2e-5 for strict laws and 1e-4 for approximate ones.
    #[arg(long, value_delimiter = ',')]
    time_steps: Vec<f64>,
    /// Numbers of particles.
    #[arg(long, value_delimiter = ',', default_value = "0,20,40,60")]
    particles: Vec<usize>,
    /// Frequencies in Hz; unless given 4 to 8, closer where the curves bend.
    #[arg(long, value_delimiter = ',')]
    frequencies: Vec<f64>,
    /// Seeds of the initial fillings.
    #[arg(long, value_delimiter = ',', default_value = "1")]
    seeds: Vec<u64>,
    /// Periods discarded; unless given 20, and without particles 14 time constants of the oscillator.
    #[arg(long)]
    discarded: Option<u32>,
    /// Periods averaged.
    #[arg(long, default_value_t = 40)]
    averaged: u32,
    /// Goes on until the RMS is known to this part of it, as in 0.01, whatever is discarded and averaged.
    #[arg(long)]
    half_width: Option<f64>,
    /// A few points and periods.
    #[arg(long)]
    quick: bool,
}

/// A law under a time step.
#[derive(Debug, Clone, Copy)]
struct Variant {
    law: LawName,
    time_step: f64,
}

/// One line of the picture.
#[derive(Debug, Clone, Copy)]
struct OneLine {
    variant: usize,
    particles: usize,
    seed: u64,
}

impl OneLine {
    fn at(self, frequency: f64) -> Point {
        Point {
            particles: self.particles,
            seed: self.seed,
            amplitude: 0.25,
            frequency,
        }
    }

    /// Its points among `results`, by frequency.
    fn of(self, results: &[(usize, Response)]) -> Vec<(f64, f64)> {
        let mine = |(variant, response): &&(usize, Response)| {
            let Point {
                particles, seed, ..
            } = response.point;
            (*variant, particles, seed) == (self.variant, self.particles, self.seed)
        };
        let mine = results.iter().filter(mine);
        let mut points: Vec<(f64, f64)> = mine
            .map(|(_, response)| (response.point.frequency, response.rms_zero))
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    }
}

impl Options {
    fn variants(&self) -> Vec<Variant> {
        let variants = self.laws.iter().flat_map(|&law| {
            let own = [law.time_step()];
            let steps = if self.time_steps.is_empty() {
                &own[..]
            } else {
                &self.time_steps
            };
            steps
                .iter()
                .map(|&time_step| Variant { law, time_step })
                .collect::<Vec<_>>()
        });
        variants.collect()
    }

    fn frequencies(&self) -> Vec<f64> {
        if !self.frequencies.is_empty() {
            return self.frequencies.clone();
        }
        if self.quick {
            return vec![5.0, 5.5, 6.0, 6.5, 7.0];
        }
        let tenths = [40, 45, 50, 52, 54, 56, 58, 60, 62, 64, 66, 70, 75, 80];
        tenths.iter().map(|&f| f64::from(f) / 10.0).collect()
    }

    /// What makes the lines of `results` smoother. A bed's motion is irregular: what bends on a small scale
    /// is chance.
    fn refined(&self, lines: &[OneLine], results: &[(usize, Response)]) -> Vec<(usize, Point)> {
        if self.quick || !self.frequencies.is_empty() {
            return Vec::new();
        }
        let added = |line: &OneLine| {
            let shortest = if line.particles == 0 { 0.006 } else { 0.025 };
            let added = bends::bends(&line.of(results), shortest);
            let points = added.into_iter().map(|f| (line.variant, line.at(f)));
            points.collect::<Vec<_>>()
        };
        lines.iter().flat_map(added).collect()
    }

    /// A line for each number of particles, variant and seed.
    fn lines(&self, variants: usize) -> Vec<OneLine> {
        let mut lines = Vec::new();
        for &particles in &self.particles {
            for variant in 0..variants {
                lines.extend(self.seeds.iter().map(|&seed| OneLine {
                    variant,
                    particles,
                    seed,
                }));
            }
        }
        lines
    }

    fn measure(&self, variant: Variant, point: Point) -> Result<Response, Failure> {
        let acrylic = Material::acrylic();
        match variant.law {
            LawName::HertzTsuji => self.under(HertzTsuji::new(acrylic), variant, point),
            LawName::HertzMindlin => self.under(HertzMindlin::new(acrylic), variant, point),
            LawName::Restitution => self.under(RestitutionImpulse::new(acrylic), variant, point),
            LawName::Literal => self.under(RestitutionImpulse::literal(acrylic), variant, point),
        }
    }

    fn under<L: ContactLaw + Clone>(
        &self,
        law: L,
        variant: Variant,
        point: Point,
    ) -> Result<Response, Failure> {
        let discarded = match self.discarded {
            Some(periods) => periods,
            None if self.quick => 5,
            None if point.particles == 0 => (30.0 * point.frequency).ceil() as u32,
            None => 20,
        };
        let grid = [self.grid[0], self.grid[1]];
        let curve: ResponseCurve<L, Slot, AnyDetector, AnyIntegrator> = ResponseCurve::new(law)
            .detector(self.detector.detector(grid)?)
            .integrator(self.integrator.integrator())
            .time_step(variant.time_step)
            .periods(discarded, if self.quick { 10 } else { self.averaged })
            .contained(variant.law != LawName::Literal && self.detector != DetectorName::PaperGrid);
        let curve = match self.half_width {
            Some(half_width) => curve.periods_until(half_width, 1000),
            None => curve,
        };
        Ok(curve.measure(point, |_| ControlFlow::Continue(()))?)
    }
}

type Failure = Box<dyn Error + Send + Sync>;

/// The name by which an option knows a value.
fn name(value: &impl ValueEnum) -> String {
    value
        .to_possible_value()
        .map_or_else(String::new, |value| value.get_name().to_owned())
}

fn main() -> Result<(), Failure> {
    let options = Options::parse();
    if options.grid.len() != 2 {
        return Err("--grid takes the cells up and across, as in 32x20".into());
    }
    let variants = options.variants();
    let lines = options.lines(variants.len());
    let mut jobs = Vec::new();
    for line in &lines {
        let frequencies = options.frequencies().into_iter();
        jobs.extend(frequencies.map(|f| (line.variant, line.at(f))));
    }
    let mut results = Vec::new();
    while !jobs.is_empty() {
        measure_all(&options, &variants, &jobs, &mut results)?;
        jobs = options.refined(&lines, &results);
    }

    let place = |(variant, response): &(usize, Response)| {
        let point = response.point;
        let seed = options.seeds.iter().position(|seed| *seed == point.seed);
        (*variant, point.particles, seed)
    };
    results.sort_by(|a, b| {
        let frequency = |result: &(usize, Response)| result.1.point.frequency;
        let first = place(a).cmp(&place(b));
        first.then(frequency(a).total_cmp(&frequency(b)))
    });
    let directory = output::directory("response")?;
    let rows = results
        .iter()
        .map(|(variant, response)| row(&options, variants[*variant], response));
    output::write_table(&directory.join("response.csv"), COLUMNS, rows)?;
    draw(&options, &variants, &lines, &results)
}

/// Measures on all cores.
fn measure_all(
    options: &Options,
    variants: &[Variant],
    jobs: &[(usize, Point)],
    results: &mut Vec<(usize, Response)>,
) -> Result<(), Failure> {
    // Longest first, so that no core waits for another at the end.
    let steps = |job: usize| {
        let (variant, point) = jobs[job];
        (point.particles as f64 + 4.0) / (point.frequency * variants[variant].time_step)
    };
    let mut order: Vec<usize> = (0..jobs.len()).collect();
    order.sort_by(|a, b| steps(*b).total_cmp(&steps(*a)));
    let bar = progress::bar(order.iter().map(|job| steps(*job) as u64).sum());
    spread::spread(
        &order,
        |job| options.measure(variants[jobs[job].0], jobs[job].1),
        |job, response| {
            results.push((jobs[job].0, response));
            bar.inc(steps(job) as u64);
        },
    )?;
    bar.finish_and_clear();
    Ok(())
}

const COLUMNS: &str = "law,integrator,detector,time_step_s,particles,seed,frequency_hz,\
    rms_zero,rms_mean,first_harmonic,max_overlap_m,outside,half_width,settled,periods";

fn row(options: &Options, variant: Variant, response: &Response) -> String {
    let Point {
        particles,
        seed,
        frequency,
        ..
    } = response.point;
    let widths = response.half_widths;
    let width = widths.map_or_else(String::new, |widths| format!("{:.6}", widths.rms_zero));
    format!(
        "{},{},{},{},{particles},{seed},{frequency},{:.6},{:.6},{:.6},{:.4e},{},{width},{},{}",
        name(&variant.law),
        name(&options.integrator),
        name(&options.detector),
        variant.time_step,
        response.rms_zero,
        response.rms_mean,
        response.first_harmonic,
        response.max_overlap,
        response.outside,
        response.settled,
        response.discarded + response.averaged,
    )
}

/// All lines in one picture.
fn draw(
    options: &Options,
    variants: &[Variant],
    lines: &[OneLine],
    results: &[(usize, Response)],
) -> Result<(), Failure> {
    let lone = options.frequencies().len() < 12;
    let colour = |particles| options.particles.iter().position(|n| *n == particles);
    let drawn = |line: &OneLine| {
        let variant = variants[line.variant];
        let label = format!(
            "N = {}, {}, {:e} s",
            line.particles,
            name(&variant.law),
            variant.time_step
        );
        Line {
            label: if line.seed == options.seeds[0] {
                label
            } else {
                String::new()
            },
            colour: colour(line.particles).unwrap_or_default(),
            dash: [0, 8, 4, 2][line.variant.min(3)],
            marked: lone,
            points: line.of(results),
        }
    };
    let lines: Vec<Line> = lines.iter().map(drawn).collect();
    let all = || lines.iter().flat_map(|line| &line.points);
    let bounds = |of: fn(&(f64, f64)) -> f64| {
        let values = all().map(of);
        values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| {
            (low.min(value), high.max(value))
        })
    };
    let (x, y) = (bounds(|point| point.0), bounds(|point| point.1));
    let chart = Chart {
        title: "Response of the oscillator with N particles",
        axes: ["frequency f (Hz)", "RMS displacement / (F/K)"],
        x: x.0..x.1.max(x.0 + 0.1),
        y: 0.8 * y.0..1.2 * y.1,
        logarithmic: [false, true],
        legend: SeriesLabelPosition::UpperRight,
    };
    let path = output::directory("response")?.join("response.svg");
    chart.draw(&path, &lines)?;
    output::say_where("picture", &path);
    Ok(())
}
