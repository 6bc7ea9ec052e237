//! From a structure to an order: which grains, how many, and how much room to leave them.
//!
//! A plate of 0.5 kg that resonates at 10 Hz may carry 25 g of acrylic spheres in a slot of at most 100 x 200 mm.
//! A map of the peak response over fill and grain size shows what there is; an optimiser (Nelder & Mead's, of
//! the argmin crate) finds the best size, fill and mass from there, both under the coarse law; the strict law has
//! the last word. `cargo run --release --example design` leaves `target/design/map.csv` and `map.svg`.

#[path = "support/chart.rs"]
mod chart;
#[path = "support/heat.rs"]
mod heat;
#[path = "support/output.rs"]
mod output;
#[path = "support/progress.rs"]
mod progress;
#[path = "support/slot_design.rs"]
mod slot_design;
#[path = "support/spread.rs"]
mod spread;

use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;
use std::path::Path;

use argmin::core::{CostFunction, Executor};
use argmin::solver::neldermead::NelderMead;
use chart::{Chart, Line};
use heat::HeatMap;
use particle_damper::excitation::Harmonic;
use particle_damper::impact_damper::{ball_clearance, bed_clearance};
use particle_damper::response::{Response, ResponseError};
use particle_damper::{
    ContactLaw, Damper, Damping, Filling, HertzTsuji, Material, ResponseCurve, RestitutionImpulse,
    SingleDof, WallRecorder,
};
use plotters::prelude::SeriesLabelPosition;
use slot_design::{Design, FILLS, RADII, WIDTH};

type Failure = Box<dyn Error + Send + Sync>;

/// The structure: mass in kg, natural frequency in Hz, damping ratio, amplitude of the force in N.
const MASS: f64 = 0.5;
const FREQUENCY: f64 = 10.0;
const DAMPING: f64 = 0.005;
const FORCE: f64 = 0.5;
fn structure() -> Result<SingleDof, Failure> {
    let w = TAU * FREQUENCY;
    Ok(SingleDof::new(
        MASS,
        2.0 * DAMPING * MASS * w,
        MASS * w * w,
    )?)
}

/// How much is simulated.
#[derive(Debug, Clone, Copy)]
struct Effort {
    frequencies: u32,
    discarded: u32,
    averaged: u32,
}

/// The responses at frequencies from the natural one with the bed's mass to that without.
fn responses<L: ContactLaw + Clone>(
    law: L,
    time_step: f64,
    design: &Design,
    effort: Effort,
    seeds: u64,
) -> Result<Vec<Response>, Failure> {
    let lowest = FREQUENCY / (1.0 + design.bed_mass()? / MASS).sqrt();
    let part = |n: u32| f64::from(n) / f64::from(effort.frequencies - 1);
    let frequency = |n: u32| lowest + (1.01 * FREQUENCY - lowest) * part(n);
    let curve = ResponseCurve::new(law)
        .cavity(design.slot()?)
        .oscillator(structure()?)
        .force(FORCE)
        .particle(design.grain()?)
        .time_step(time_step)
        .particles([design.grains])
        .seeds(1..=seeds)
        .frequencies((0..effort.frequencies).map(frequency))
        .periods(effort.discarded, effort.averaged);
    Ok(curve.run(|_| ControlFlow::Continue(()))?)
}

/// The largest of them.
fn peak(responses: &[Response]) -> Result<Response, Failure> {
    let larger =
        |one: &&Response, other: &&Response| one.first_harmonic.total_cmp(&other.first_harmonic);
    let largest = responses.iter().max_by(larger);
    Ok(*largest.ok_or("no frequencies")?)
}

/// Amplification of the structure with a design, under the coarse law; infinite if the grains do not go in.
fn cost(design: &Design, effort: Effort) -> Result<f64, Failure> {
    let law = RestitutionImpulse::new(Material::acrylic());
    match responses(law, 2e-4, design, effort, 1) {
        Ok(responses) => Ok(peak(&responses)?.first_harmonic),
        Err(error) if matches!(error.downcast_ref(), Some(ResponseError::Filling { .. })) => {
            Ok(f64::INFINITY)
        }
        Err(error) => Err(error),
    }
}

/// Radius over the largest, fill and part of the mass as the optimiser has them.
struct Problem(Effort);

impl CostFunction for Problem {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, at: &Self::Param) -> Result<f64, argmin::core::Error> {
        let design = Design::new(at[0] * RADII[1], at[1], at[2]);
        let found = design.and_then(|design| cost(&design, self.0));
        // Outside its range a number costs what it is beyond, so that the way back is found.
        let beyond = |value: f64, [low, high]: [f64; 2]| (low - value).max(value - high).max(0.0);
        let radii = [RADII[0] / RADII[1], 1.0];
        let out = beyond(at[0], radii) + beyond(at[1], FILLS) + beyond(at[2], [0.1, 1.0]);
        found
            .map(|found| found + 20.0 * out)
            .map_err(|error| argmin::core::Error::msg(error.to_string()))
    }
}

/// The best design of a map, refined.
fn refine(start: &Design, effort: Effort, iterations: u64) -> Result<(Design, u64), Failure> {
    let at = [start.radius / RADII[1], start.fill, 0.97];
    let corner = |n: usize, by: f64| {
        let mut corner = at.to_vec();
        corner[n] += by;
        corner
    };
    let simplex = vec![
        at.to_vec(),
        corner(0, -0.08),
        corner(1, 0.08),
        corner(2, -0.2),
    ];
    let solver = NelderMead::new(simplex).with_sd_tolerance(0.02)?;
    let result = Executor::new(Problem(effort), solver)
        .configure(|state| state.max_iters(iterations))
        .run()?;
    let state = result.state;
    let best = state.best_param.ok_or("nothing found")?;
    Ok((
        Design::new(best[0] * RADII[1], best[1], best[2])?,
        state.iter,
    ))
}

/// Peak force on a wall (N) and impacts per second on walls at `frequency` (Hz), under the strict law.
fn wear(
    law: HertzTsuji,
    design: &Design,
    frequency: f64,
    periods: f64,
) -> Result<(f64, f64), Failure> {
    let slot = design.slot()?;
    let bed = Filling::new(1)
        .with(design.grains, design.grain()?)
        .fill(&slot)?;
    let mut damper = Damper::builder(slot, law)
        .mount(structure()?.excited_by(Harmonic::new(FORCE, frequency)?))
        .particles(bed)
        .build()?;
    let mut walls = WallRecorder::new();
    while damper.time() < periods / frequency {
        damper.step()?;
    }
    let begin = damper.time();
    while damper.time() < 1.5 * periods / frequency {
        damper.step_watched(&mut walls)?;
    }
    let peak = walls
        .records()
        .iter()
        .map(|wall| wall.peak)
        .fold(0.0, f64::max);
    let impacts: u64 = walls.records().iter().map(|wall| wall.impacts).sum();
    Ok((peak, impacts as f64 / (damper.time() - begin)))
}

fn main() -> Result<(), Failure> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let (columns, rows, iterations) = if quick { (3, 3, 3) } else { (9, 9, 30) };
    let effort = Effort {
        frequencies: if quick { 3 } else { 5 },
        discarded: if quick { 20 } else { 60 },
        averaged: if quick { 10 } else { 20 },
    };
    let even = |[low, high]: [f64; 2], count: u32| -> Vec<f64> {
        (0..count)
            .map(|n| low + (high - low) * f64::from(n) / f64::from(count - 1))
            .collect()
    };
    let (radii, fills) = (even(RADII, columns), even(FILLS, rows));

    let count = radii.len() * fills.len();
    let design = |n: usize| Design::new(radii[n % radii.len()], fills[n / radii.len()], 1.0);
    let map = spread::all(count, |n| {
        let design = design(n)?;
        // Where the room is too low for a fill, the map is left white.
        if design.fill > fills[n / radii.len()] + 1e-12 {
            return Ok(f64::NAN);
        }
        cost(&design, effort)
    })?;
    let finite = (0..count).filter(|n| map[*n].is_finite());
    let best = finite.min_by(|one, other| map[*one].total_cmp(&map[*other]));
    let best = best.ok_or("no design fits")?;
    let (found, steps) = refine(&design(best)?, effort, iterations)?;
    let [coarse, strict] = last_word(&found, effort, quick)?;
    report(&found, &coarse, &strict, effort)?;
    println!("\n{count} designs in the map, {steps} iterations of the optimiser");

    let directory = output::directory("design")?;
    let lines = (0..count).map(|n| {
        let (radius, fill) = (radii[n % radii.len()], fills[n / radii.len()]);
        format!("{:.3},{fill:.3},{:.4}", 2e3 * radius, map[n])
    });
    output::write_table(
        &directory.join("map.csv"),
        "grain_mm,fill,peak_over_static",
        lines,
    )?;
    let path = directory.join("map.svg");
    HeatMap {
        title: "Peak response of the structure, up to 25 g of grains",
        axes: [
            "diameter of the grains (mm)",
            "fill of the slot's height",
            "peak over static deflection (lightest: and more)",
        ],
        x: &radii.iter().map(|radius| 2e3 * radius).collect::<Vec<_>>(),
        y: &fills,
        logarithmic: false,
        values: &map,
        // Half as much again is bad enough.
        range: map[best]..1.5 * map[best],
        line: None,
        mark: Some((2e3 * found.radius, found.fill, "optimum")),
    }
    .draw(&path)?;
    output::say_where("picture", &path);
    draw_responses(&directory.join("response.svg"), &coarse, &strict)
}

/// The responses with the design under the coarse law and under the strict one.
fn last_word(found: &Design, effort: Effort, quick: bool) -> Result<[Vec<Response>; 2], Failure> {
    let fine = Effort {
        frequencies: if quick { 3 } else { 15 },
        discarded: 2 * effort.discarded,
        averaged: if quick { 10 } else { 160 },
    };
    let last = Effort {
        frequencies: fine.frequencies.min(8),
        averaged: if quick { 10 } else { 120 },
        ..fine
    };
    let coarse = RestitutionImpulse::new(Material::acrylic());
    let seeds = if quick { 1 } else { 2 };
    Ok([
        responses(coarse, 1e-4, found, fine, 1)?,
        responses(strict(), 3e-5, found, last, seeds)?,
    ])
}

fn strict() -> HertzTsuji {
    HertzTsuji::new(Material::acrylic()).damping(Damping::Tsuji)
}

/// The structure without a damper, and with it under both laws.
fn draw_responses(path: &Path, coarse: &[Response], strict: &[Response]) -> Result<(), Failure> {
    let of = |responses: &[Response]| {
        let points = responses.iter();
        let points = points.map(|response| (response.point.frequency, response.first_harmonic));
        points.collect::<Vec<_>>()
    };
    let with = of(coarse);
    let (low, high) = (with[0].0, with[with.len() - 1].0);
    let bare = (0..=300).map(|n| {
        let ratio = (low + (high - low) * f64::from(n) / 300.0) / FREQUENCY;
        let off = (1.0 - ratio * ratio).hypot(2.0 * DAMPING * ratio);
        (FREQUENCY * ratio, 1.0 / off)
    });
    Chart {
        title: "The structure without grains and with those to be ordered",
        axes: ["frequency f (Hz)", "amplitude over static deflection"],
        x: low..high,
        y: 5.0..150.0,
        logarithmic: [false, true],
        legend: SeriesLabelPosition::UpperLeft,
    }
    .draw(
        path,
        &[
            Line::through("without", 0, bare.collect()),
            Line::through("with, coarse law", 1, with).marked(),
            Line::points("with, strict law, two seeds", 2, of(strict)),
        ],
    )?;
    output::say_where("picture", path);
    Ok(())
}

/// Prints the parts, what they do under both laws, and what rules of thumb say.
fn report(
    found: &Design,
    coarse: &[Response],
    strict_law: &[Response],
    effort: Effort,
) -> Result<(), Failure> {
    let e = Material::acrylic().interaction.restitution;
    println!(
        "parts: {} acrylic spheres of {:.1} mm, {:.1} g",
        found.grains,
        2e3 * found.radius,
        1e3 * found.bed_mass()?
    );
    println!(
        "       a slot of {:.0} x {:.1} mm, {:.1} mm deep: bed {:.1} mm, clearance {:.1} mm, fill {:.2}",
        1e3 * WIDTH,
        1e3 * found.height(),
        2e3 * found.radius + 0.1,
        1e3 * found.bed_height(),
        1e3 * found.clearance(),
        found.fill
    );
    for limit in found.limits() {
        println!("       at the {limit}: a better design may lie beyond");
    }
    println!(
        "\npeak over static deflection; without the damper {:.1}",
        0.5 / DAMPING
    );
    let (coarse, last) = (peak(coarse)?, peak(strict_law)?);
    for (law, response) in [("coarse law", coarse), ("strict law", last)] {
        let within = response
            .half_widths
            .map_or(f64::NAN, |widths| widths.first_harmonic);
        let ratio = |peak: f64| 0.5 / peak;
        let x = response.first_harmonic;
        println!(
            "  {law}: {x:.2} +- {within:.2} at {:.2} Hz; damping ratio {:.4}, {:.4} to {:.4}{}",
            response.point.frequency,
            ratio(x),
            ratio(x + within),
            ratio(x - within),
            if response.settled {
                ""
            } else {
                " (not settled)"
            }
        );
    }
    let frequency = last.point.frequency;
    let (force, impacts) = wear(strict(), found, frequency, f64::from(effort.discarded))?;
    println!(
        "\nwear and noise at {frequency:.2} Hz: {force:.2} N at most on a wall, {impacts:.0} impacts on walls a second"
    );

    let amplitude = last.first_harmonic * FORCE / structure()?.stiffness();
    println!(
        "\nclearance of {:.1} mm at an amplitude of {:.2} mm; rules of thumb, without gravity, for it:",
        1e3 * found.clearance(),
        1e3 * amplitude
    );
    println!(
        "  a bed that does not rebound, pi A             {:6.1} mm",
        1e3 * bed_clearance(amplitude)?
    );
    println!(
        "  one ball of e {e}, pi A (1 + e)/(1 - e)      {:6.1} mm: not for {} grains, which lose more in their midst",
        1e3 * ball_clearance(amplitude, e)?,
        found.grains
    );
    println!(
        "  A w^2 is {:.1} g here: the rules hold where it is well above 1",
        amplitude * (TAU * frequency).powi(2) / 9.81
    );
    // At its best a collecting bed takes 4 m A^2 w^2 a cycle: what amplitude does that leave?
    let bound = 0.5 / (DAMPING + 2.0 / PI * found.bed_mass()? / MASS);
    println!(
        "  a bed that loses the most it can, 4 m A^2 w^2 a cycle, would leave a peak of {bound:.1}"
    );
    Ok(())
}
