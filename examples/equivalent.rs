//! The equivalent damper beside the full simulation: the field of an isolated bed is measured once, and put on
//! an oscillator by harmonic balance, for any force and in milliseconds.
//!
//! An oscillator of 0.2 kg at 6 Hz carries the paper's container with 20 acrylic spheres (2 % of its mass), under
//! three forces. `cargo run --release --example equivalent` leaves `target/equivalent/equivalent.csv` and a
//! picture.

#[path = "support/chart.rs"]
mod chart;
#[path = "support/output.rs"]
mod output;
#[path = "support/spread.rs"]
mod spread;

use std::error::Error;
use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::time::Instant;

use chart::{Chart, Line, POINTS};
use particle_damper::equivalent::{EquivalentDamper, FieldTable, ModalStructure};
use particle_damper::fields::Cell;
use particle_damper::{
    EffectiveFields, Material, Particle, ResponseCurve, RestitutionImpulse, SingleDof, Slot,
};
use plotters::prelude::SeriesLabelPosition;

type Failure = Box<dyn Error + Send + Sync>;

const GRAINS: usize = 20;
const FORCES: [f64; 3] = [0.04, 0.1, 0.24];

fn law() -> RestitutionImpulse {
    RestitutionImpulse::new(Material::acrylic())
}

fn oscillator() -> Result<SingleDof, Failure> {
    let (mass, w) = (0.2, TAU * 6.0);
    Ok(SingleDof::new(mass, 2.0 * 0.01 * mass * w, mass * w * w)?)
}

/// What the bed does in a box that nothing stops.
fn field(quick: bool) -> Result<FieldTable, Failure> {
    let count = if quick { 8 } else { 20 };
    let amplitudes: Vec<f64> = (0..count)
        .map(|n| 0.2e-3 * 150_f64.powf(f64::from(n) / f64::from(count - 1)))
        .collect();
    let frequencies = [5.6, 6.0, 6.4];
    let mut cells: Vec<Cell> = Vec::new();
    let order: Vec<usize> = (0..amplitudes.len() * frequencies.len()).collect();
    let measure = |n: usize| {
        let fields = EffectiveFields::new(law(), Slot::paper())
            .with(GRAINS, Particle::new(3e-3, 0.2e-3)?)
            .amplitudes([amplitudes[n / frequencies.len()]])
            .frequencies([frequencies[n % frequencies.len()]])
            .periods(10, if quick { 20 } else { 60 });
        Ok(fields.run(|_| ControlFlow::Continue(()))?)
    };
    spread::spread(&order, measure, |_, found| cells.extend(found))?;
    Ok(FieldTable::from_cells(&cells)?)
}

/// Amplitudes (mm) over frequencies (Hz) of the full simulation.
fn simulate(force: f64, quick: bool) -> Result<Vec<(f64, f64)>, Failure> {
    let count = if quick { 5 } else { 19 };
    let oscillator = oscillator()?;
    let frequency = |n: usize| 5.7 + 0.6 * n as f64 / (count - 1) as f64;
    let order: Vec<usize> = (0..count).collect();
    let measure = |n: usize| {
        // Where the grains rest the start fades as slowly as without them.
        let curve = ResponseCurve::new(law())
            .oscillator(oscillator)
            .force(force)
            .particles([GRAINS])
            .frequencies([frequency(n)])
            .periods(if quick { 40 } else { 120 }, if quick { 20 } else { 60 });
        let found = curve.run(|_| ControlFlow::Continue(()))?;
        Ok(found[0].first_harmonic * 1e3 * force / oscillator.stiffness())
    };
    let mut points = Vec::new();
    spread::spread(&order, measure, |n, found| {
        points.push((frequency(n), found));
    })?;
    points.sort_by(|one, other| one.0.total_cmp(&other.0));
    Ok(points)
}

fn main() -> Result<(), Failure> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let begin = Instant::now();
    let table = field(quick)?;
    println!(
        "field of the isolated bed: {:.1} s, once",
        begin.elapsed().as_secs_f64()
    );
    let structure = ModalStructure::oscillator(&oscillator()?)?;
    let damper = EquivalentDamper::new(structure, table);

    let (mut lines, mut rows) = (Vec::new(), Vec::new());
    let mut line = |label: String, colour, dash, points| {
        lines.push(Line {
            label,
            colour,
            dash,
            marked: false,
            points,
        });
    };
    for (n, force) in FORCES.into_iter().enumerate() {
        let begin = Instant::now();
        let mut curve = Vec::new();
        let mut doubtful = 0;
        for step in 0..=200 {
            let frequency = 5.7 + 0.003 * f64::from(step);
            for found in damper.solutions(force, TAU * frequency)? {
                curve.push((frequency, 1e3 * found.amplitude));
                doubtful += usize::from(found.doubtful());
            }
        }
        let shortcut = begin.elapsed().as_secs_f64();
        let begin = Instant::now();
        let full = simulate(force, quick)?;
        let whole = begin.elapsed().as_secs_f64();
        println!(
            "\n{force} N: {} solutions of the equivalent damper in {:.1} ms, {doubtful} doubtful; {} points simulated in {whole:.1} s",
            curve.len(),
            1e3 * shortcut,
            full.len()
        );
        println!(
            "{:>8} {:>12} {:>12} {:>8}",
            "Hz", "simulated mm", "equivalent", "off %"
        );
        for (frequency, simulated) in &full {
            let found = damper.solutions(force, TAU * frequency)?;
            let near = |a: &f64, b: &f64| (a - simulated).abs().total_cmp(&(b - simulated).abs());
            let nearest = found.iter().map(|found| 1e3 * found.amplitude).min_by(near);
            let shown = nearest.unwrap_or(f64::NAN);
            let off = 100.0 * (shown / simulated - 1.0);
            println!("{frequency:8.3} {simulated:12.4} {shown:12.4} {off:8.2}");
            rows.push(format!("{force},{frequency:.4},{simulated:.6},{shown:.6}"));
        }
        line(format!("{force} N, simulated"), n + 1, POINTS, full);
        line(format!("{force} N, equivalent damper"), n + 1, 0, curve);
    }
    let amplitudes: Vec<f64> = (0..80)
        .map(|n| 0.2e-3 * 150_f64.powf(f64::from(n) / 79.0))
        .collect();
    let backbone = damper.backbone(&amplitudes)?;
    let backbone = backbone
        .iter()
        .map(|at| (at.angular_frequency / TAU, 1e3 * at.amplitude));
    line("backbone".into(), 0, 6, backbone.collect());

    let directory = output::directory("equivalent")?;
    let columns = "force_n,frequency_hz,simulated_mm,equivalent_mm";
    output::write_table(&directory.join("equivalent.csv"), columns, rows)?;
    let path = directory.join("equivalent.svg");
    Chart {
        title: "20 grains (2 %) on an oscillator of 6 Hz: field put on it, and simulated",
        axes: ["frequency f (Hz)", "amplitude of the oscillator (mm)"],
        x: 5.7..6.3,
        y: 0.1..30.0,
        logarithmic: [false, true],
        legend: SeriesLabelPosition::UpperRight,
    }
    .draw(&path, &lines)?;
    output::say_where("picture", &path);
    Ok(())
}
