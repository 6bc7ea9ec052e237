//! What a damper by itself takes from a host that shakes it: a map over amplitude and box height, and one
//! ball's loss and apparent mass against theory.
//!
//! `cargo run --release --example effective_field` leaves `target/effective_field/map.csv`, `map.svg` and
//! `ball.svg` in about two minutes. The pictures of the README: `cp target/effective_field/*.svg
//! examples/pictures/`.

#[path = "support/chart.rs"]
mod chart;
#[path = "support/heat.rs"]
mod heat;
#[path = "support/output.rs"]
mod output;
#[path = "support/progress.rs"]
mod progress;
#[path = "support/spread.rs"]
mod spread;

use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;
use std::path::Path;

use chart::{Chart, Line};
use heat::HeatMap;
use particle_damper::fields::Cell;
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    Cuboid, EffectiveFields, Interaction, Material, Particle, RestitutionImpulse, Slot,
};
use plotters::prelude::SeriesLabelPosition;

type Failure = Box<dyn Error + Send + Sync>;

const FREQUENCY: f64 = 20.0;
/// Side of the box in m, number of grains and their radius in m.
const SIDE: f64 = 0.02;
const GRAINS: usize = 50;
const RADIUS: f64 = 2e-3;

/// Height in m of the grains as a loose pile, of which six tenths are solid.
fn pile() -> f64 {
    GRAINS as f64 * 4.0 / 3.0 * PI * RADIUS.powi(3) / (0.6 * SIDE * SIDE)
}

/// A row of the map: weightless grains in a box of one height that moves up and down.
fn row(height: f64, amplitudes: &[f64], periods: u32) -> Result<Vec<Cell>, Failure> {
    let cavity = Cuboid::new(dvec3(SIDE, height, SIDE))?;
    let fields = EffectiveFields::new(RestitutionImpulse::new(Material::acrylic()), cavity)
        .gravity(DVec3::ZERO)
        .with(GRAINS, Particle::with_density(RADIUS, 1190.0)?)
        .amplitudes(amplitudes.iter().copied())
        .frequencies([FREQUENCY])
        .time_step(5e-5)
        .periods(periods / 2, periods);
    Ok(fields.run(|_| ControlFlow::Continue(()))?)
}

fn draw_map(directory: &Path, quick: bool) -> Result<(), Failure> {
    let (count, periods) = if quick { (4, 4) } else { (16, 30) };
    let part = |n: usize| n as f64 / (count - 1) as f64;
    let amplitudes: Vec<f64> = (0..count).map(|n| 0.4e-3 * 25_f64.powf(part(n))).collect();
    let heights: Vec<f64> = (0..count).map(|n| 0.012 + 0.036 * part(n)).collect();
    let rows = spread::all(count, |number| row(heights[number], &amplitudes, periods))?;
    let table = heights.iter().zip(&rows).flat_map(|(height, cells)| {
        cells.iter().map(move |cell| {
            let half_width = cell.energy_per_cycle.half_width.unwrap_or(f64::NAN);
            format!(
                "{height:.6},{:.6e},{:.4},{:.6e},{half_width:.1e},{:.2e},{:.4},{:.4e},{:.3},{:.3},{},{:.3e},{}",
                cell.amplitude,
                cell.normalised_loss(),
                cell.energy_per_cycle.value,
                cell.difference() - cell.gain,
                cell.apparent_mass.value / cell.bed_mass,
                cell.viscous_coefficient.value,
                cell.state.flight,
                cell.state.coherence(),
                cell.state.regime(),
                cell.max_overlap,
                cell.settled
            )
        })
    });
    let columns = "height_m,amplitude_m,normalised_loss,energy_per_cycle_j,half_width_j,unexplained_j,\
        apparent_mass_over_bed,viscous_coefficient_ns_per_m,flight,coherence,regime,max_overlap_m,settled";
    output::write_table(&directory.join("map.csv"), columns, table)?;
    let millimetres = |values: &[f64]| values.iter().map(|value| 1e3 * value).collect::<Vec<_>>();
    // The box is as high as this where a bed that does not rebound loses most.
    let height = |amplitude: f64| pile() + PI * amplitude;
    let ends = [heights[0], heights[count - 1]].map(|height| (height - pile()) / PI);
    let [from, to] = [
        ends[0].max(amplitudes[0]),
        ends[1].min(amplitudes[count - 1]),
    ];
    let best = (0..=50).map(|n| from * (to / from).powf(f64::from(n) / 50.0));
    let best = best.map(|amplitude| (1e3 * amplitude, 1e3 * height(amplitude)));
    let path = directory.join("map.svg");
    HeatMap {
        title: "Energy that 50 weightless grains take per cycle",
        axes: [
            "amplitude of the box (mm)",
            "height of the box (mm)",
            "E / (m V²/2)",
        ],
        x: &millimetres(&amplitudes),
        y: &millimetres(&heights),
        logarithmic: true,
        values: &rows
            .iter()
            .flatten()
            .map(Cell::normalised_loss)
            .collect::<Vec<_>>(),
        range: 0.0..8.0,
        line: Some(("clear height = π A: best without rebound", best.collect())),
        mark: None,
    }
    .draw(&path)?;
    output::say_where("picture", &path);
    Ok(())
}

/// Loss per cycle over m V^2/2 and apparent mass over m of one ball in a box of clear travel D A, which hits
/// twice a cycle; and the ball on its orbit.
fn theory(e: f64, d: f64) -> ([f64; 2], [f64; 2]) {
    let c = (1.0 - e) / (1.0 + e);
    let r = (1.0 + (2.0 * c / PI).powi(2)).sqrt();
    let phase = (2.0 * c / PI).atan() + (-c * d / (PI * r)).acos();
    let speed = (d + 2.0 * phase.sin()) / PI;
    let fields = [8.0 * c * speed * speed, 4.0 / PI * speed * phase.sin()];
    (fields, [phase.sin() - speed * phase, speed])
}

fn ball(e: f64, d: f64) -> Result<[f64; 2], Failure> {
    let (amplitude, radius, (_, [offset, speed])) = (0.01, 0.01, theory(e, d));
    let material = Material::new(0.4e9, 0.3, Interaction::new(e, 0.0)?)?;
    let start = dvec3(radius + amplitude * (d + offset), 2.0 * radius, 0.0);
    let moving = DVec3::X * (speed * TAU * FREQUENCY * amplitude);
    let cavity = Slot::new(d * amplitude + 2.0 * radius, 4.0 * radius)?;
    let fields = EffectiveFields::new(
        RestitutionImpulse::new(material).reference_speed(20.0)?,
        cavity,
    )
    .along(DVec3::X)
    .gravity(DVec3::ZERO)
    .placed([Particle::new(radius, 1e-3)?.at(start).moving(moving)])
    .amplitudes([amplitude])
    .frequencies([FREQUENCY])
    .time_step(2.5e-5)
    .periods(60, 20);
    let cells = fields.run(|_| ControlFlow::Continue(()))?;
    Ok([
        cells[0].normalised_loss(),
        cells[0].apparent_mass.value / cells[0].bed_mass,
    ])
}

fn draw_ball(directory: &Path) -> Result<(), Failure> {
    let mut lines = Vec::new();
    for (colour, e) in [(1, 0.5), (2, 0.7)] {
        let c = (1.0 - e) / (1.0 + e);
        let lowest = (PI - 4.0 / PI) / (c * c + 4.0 / (PI * PI)).sqrt();
        let highest = (PI * PI / (c * c) + 4.0).sqrt();
        let at = |part: f64| lowest + (highest - lowest) * part;
        for (what, label) in ["loss / (m V²/2)", "apparent mass / m"]
            .into_iter()
            .enumerate()
        {
            let exact = (0..=200).map(|n| at(f64::from(n) / 200.0));
            let tried: Result<Vec<_>, Failure> = (0..12)
                .map(|n| at(0.02 + 0.94 * f64::from(n) / 11.0))
                .map(|d| Ok((d, ball(e, d)?[what])))
                .collect();
            let exact = exact.map(|d| (d, theory(e, d).0[what])).collect();
            let colour = colour + 2 * what;
            lines.push(Line::through(&format!("e {e}: {label}"), colour, exact));
            lines.push(Line::points("", colour, tried?));
        }
    }
    let path = directory.join("ball.svg");
    Chart {
        title: "One ball in a shaken box: theory (lines) and simulation (points)",
        axes: [
            "clear travel over amplitude, d/A",
            "loss, and apparent mass",
        ],
        x: 2.0..18.5,
        y: -2.0..48.0,
        logarithmic: [false, false],
        legend: SeriesLabelPosition::UpperLeft,
    }
    .draw(&path, &lines)?;
    output::say_where("picture", &path);
    Ok(())
}

fn main() -> Result<(), Failure> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let directory = output::directory("effective_field")?;
    draw_map(&directory, quick)?;
    draw_ball(&directory)
}
