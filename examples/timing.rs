//! The paper's Fig. 12 and Table 2: seconds of calculation for 5 s simulated, against the number of
//! particles. Strict law (Runge-Kutta) with all pairs, and with the cell grid in a skin; approximate law
//! with the grid in a skin, all at 20 microseconds; approximate at 100 microseconds. Beside them the paper's
//! efficiency ratio, strict with all pairs over approximate at the same step, and then what a response point
//! of 60 particles costs under either law at its own step.
//!
//! `cargo run --release --example timing` leaves `target/timing/timing.csv` and `.svg`. One thread,
//! about a minute; the machine should have nothing else to do, and ratios are worth more than seconds.

#[path = "support/chart.rs"]
mod chart;
#[path = "support/output.rs"]
mod output;
#[path = "support/progress.rs"]
mod progress;

use std::error::Error;
use std::time::Instant;

use chart::{Chart, Line};
use clap::Parser;
use indicatif::ProgressBar;
use particle_damper::excitation::Harmonic;
use particle_damper::{
    AllPairs, CellGrid, ContactLaw, Damper, Detector, Filling, HertzTsuji, Integrator, LinkedCells,
    Material, Particle, RestitutionImpulse, RungeKutta4, SingleDof, Skin, Slot, VelocityVerlet,
};
use plotters::prelude::SeriesLabelPosition;

type Failure = Box<dyn Error + Send + Sync>;

/// Table 2: seconds on a Core 2 Duo of 3 GHz.
const PUBLISHED: [(usize, f64, f64); 5] = [
    (20, 4.4, 3.3),
    (40, 16.6, 5.7),
    (60, 37.3, 8.4),
    (80, 62.5, 11.0),
    (100, 97.2, 13.7),
];

/// Calculation time against the number of particles.
#[derive(Debug, Parser)]
struct Options {
    /// Numbers of particles.
    #[arg(long, value_delimiter = ',', default_value = "20,40,60,80,100")]
    particles: Vec<usize>,
    /// Simulated time in s; seconds are given for 5 s.
    #[arg(long, default_value_t = 5.0)]
    simulated: f64,
    /// Frequency of the force in Hz.
    #[arg(long, default_value_t = 6.0)]
    frequency: f64,
    /// Simulates 0.2 s.
    #[arg(long)]
    quick: bool,
}

impl Options {
    fn simulated(&self) -> f64 {
        if self.quick { 0.2 } else { self.simulated }
    }

    /// Seconds of calculation for 5 s simulated.
    fn seconds<L: ContactLaw, D: Detector + Clone, I: Integrator>(
        &self,
        parts: (L, D, I),
        time_step: f64,
        particles: usize,
        bar: &ProgressBar,
    ) -> Result<f64, Failure> {
        let (law, detector, integrator) = parts;
        let sphere = Particle::new(3e-3, 0.2e-3)?;
        let mut damper = Damper::builder(Slot::paper(), law)
            .mount(SingleDof::paper().excited_by(Harmonic::new(0.25, self.frequency)?))
            .detector(detector)
            .integrator(integrator)
            .particles(
                Filling::new(1)
                    .with(particles, sphere)
                    .fill(&Slot::paper())?,
            )
            .time_step(time_step)
            .build()?;
        let steps = (self.simulated() / time_step).round() as u64;
        let start = Instant::now();
        for _ in 0..steps {
            damper.step()?;
        }
        let seconds = start.elapsed().as_secs_f64() * 5.0 / self.simulated();
        bar.inc(particles as u64);
        Ok(seconds)
    }
}

impl Options {
    /// What 60 particles cost at the paper's steps under either law, the default detector's way: in turn,
    /// the least of three.
    fn compare_laws(&self) -> Result<(), Failure> {
        let (acrylic, bar) = (Material::acrylic(), ProgressBar::hidden());
        let skin = Skin::<LinkedCells>::default;
        let strict = || HertzTsuji::new(acrylic);
        let coarse = || RestitutionImpulse::new(acrylic);
        let mut least = [f64::INFINITY; 4];
        for _ in 0..3 {
            let times = [
                self.seconds((strict(), skin(), RungeKutta4::default()), 2e-5, 60, &bar)?,
                self.seconds((strict(), skin(), VelocityVerlet), 2e-5, 60, &bar)?,
                self.seconds((coarse(), skin(), VelocityVerlet), 1e-4, 60, &bar)?,
                self.seconds((coarse(), skin(), VelocityVerlet), 2e-4, 60, &bar)?,
            ];
            for (least, time) in least.iter_mut().zip(times) {
                *least = least.min(time);
            }
        }
        let [runge_kutta, verlet, coarse, coarser] = least;
        println!(
            "60 particles, default detector, times the approximate law's at 1e-4 s ({coarse:.3} s):"
        );
        println!("  strict, Runge-Kutta, 2e-5 s  {:.1}", runge_kutta / coarse);
        println!("  strict, Verlet, 2e-5 s       {:.1}", verlet / coarse);
        println!(
            "and at 2e-4 s ({coarser:.3} s): {:.1}, {:.1}",
            runge_kutta / coarser,
            verlet / coarser
        );
        Ok(())
    }
}

/// Slope of the straight line through the logarithms, by least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = logs.len() as f64;
    let mean_x = logs.iter().map(|log| log.0).sum::<f64>() / count;
    let mean_y = logs.iter().map(|log| log.1).sum::<f64>() / count;
    let covariance: f64 = logs.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let variance: f64 = logs.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    covariance / variance
}

fn main() -> Result<(), Failure> {
    let options = Options::parse();
    let acrylic = Material::acrylic();
    let grid = Skin::new(CellGrid::paper(), 1.0 / 3.0)?;
    let strict = || (HertzTsuji::new(acrylic), AllPairs, RungeKutta4::default());
    let strict_grid = || {
        (
            HertzTsuji::new(acrylic),
            grid.clone(),
            RungeKutta4::default(),
        )
    };
    let approximate = || {
        let law = RestitutionImpulse::new(acrylic);
        (law, grid.clone(), VelocityVerlet)
    };
    let names = [
        "strict, all pairs, dt 2e-5 s",
        "strict, grid, dt 2e-5 s",
        "approximate, grid, dt 2e-5 s",
        "approximate, grid, dt 1e-4 s",
    ];
    let mut curves = [const { Vec::new() }; 4];
    let bar = progress::bar(4 * options.particles.iter().sum::<usize>() as u64);
    for &particles in &options.particles {
        let seconds = [
            options.seconds(strict(), 2e-5, particles, &bar)?,
            options.seconds(strict_grid(), 2e-5, particles, &bar)?,
            options.seconds(approximate(), 2e-5, particles, &bar)?,
            options.seconds(approximate(), 1e-4, particles, &bar)?,
        ];
        for (curve, seconds) in curves.iter_mut().zip(seconds) {
            curve.push((particles as f64, seconds));
        }
    }
    bar.finish_and_clear();

    println!("seconds for 5 s simulated; efficiency: strict over approximate, in %");
    println!(
        "  N   strict  strict, grid  approximate  at 1e-4 s  efficiency  at 1e-4 s   published"
    );
    for (row, &particles) in options.particles.iter().enumerate() {
        let [strict, grid, fine, coarse] = [0, 1, 2, 3].map(|curve| curves[curve][row].1);
        let published = PUBLISHED.iter().find(|published| published.0 == particles);
        let published = published.map_or_else(String::new, |(_, s, a)| {
            format!("{s:.1}, {a:.1}: {:.0}", 100.0 * s / a)
        });
        let [efficiency, at_own_step] = [fine, coarse].map(|time| 100.0 * strict / time);
        println!(
            "{particles:3} {strict:8.3} {grid:13.3} {fine:12.3} {coarse:10.3} {efficiency:11.0} \
             {at_own_step:10.0}   {published}"
        );
    }
    for (name, curve) in names.iter().zip(&curves) {
        println!("{name}: N^{:.2}", slope(curve));
    }
    options.compare_laws()?;

    let directory = output::directory("timing")?;
    let rows = options
        .particles
        .iter()
        .enumerate()
        .map(|(row, particles)| {
            let [strict, grid, fine, coarse] = [0, 1, 2, 3].map(|curve| curves[curve][row].1);
            format!("{particles},{strict:.4},{grid:.4},{fine:.4},{coarse:.4}")
        });
    let columns = "particles,strict_s,strict_grid_s,approximate_s,approximate_coarse_s";
    output::write_table(&directory.join("timing.csv"), columns, rows)?;
    draw(&options, &names, &curves)
}

fn draw(options: &Options, names: &[&str], curves: &[Vec<(f64, f64)>]) -> Result<(), Failure> {
    let lines: Vec<Line> = names
        .iter()
        .zip(curves)
        .enumerate()
        .map(|(number, (name, points))| Line {
            label: format!("{name}: N^{:.2}", slope(points)),
            colour: number + 1,
            dash: 0,
            marked: true,
            points: points.clone(),
        })
        .collect();
    let seconds = || curves.iter().flatten().map(|point| point.1);
    let counts = || options.particles.iter().map(|count| *count as f64);
    let path = output::directory("timing")?.join("timing.svg");
    Chart {
        title: "Calculation time for 5 s simulated",
        axes: ["number of particles N", "time (s)"],
        x: 0.9 * counts().fold(f64::INFINITY, f64::min)..1.1 * counts().fold(0.0, f64::max),
        y: 0.5 * seconds().fold(f64::INFINITY, f64::min)..3.0 * seconds().fold(0.0, f64::max),
        logarithmic: [true; 2],
        legend: SeriesLabelPosition::UpperLeft,
    }
    .draw(&path, &lines)?;
    output::say_where("picture", &path);
    Ok(())
}
