//! The equivalent damper beside the full simulation: the field of an isolated bed is measured once, and put on
//! an oscillator by harmonic balance, for any force and in milliseconds.
//!
//! An oscillator of 0.2 kg at 6 Hz carries the paper's container with 20 acrylic spheres (2 % of its mass), under
//! three forces; and one of 0.05 kg carries the same container, for which it is too heavy (8 %): solutions say that
//! they are doubtful, and are. `cargo run --release --example equivalent` leaves
//! `target/equivalent/equivalent.csv` and a picture.

#[path = "support/chart.rs"]
mod chart;
#[path = "support/output.rs"]
mod output;
#[path = "support/progress.rs"]
mod progress;
#[path = "support/spread.rs"]
mod spread;

use std::error::Error;
use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::time::Instant;

use chart::{Chart, Line};
use particle_damper::equivalent::{EquivalentDamper, FieldTable, ModalStructure};
use particle_damper::{
    EffectiveFields, Material, Particle, ResponseCurve, RestitutionImpulse, SingleDof, Slot,
};
use plotters::prelude::SeriesLabelPosition;

type Failure = Box<dyn Error + Send + Sync>;

const GRAINS: usize = 20;

/// A structure and the force on it.
#[derive(Debug, Clone, Copy)]
struct Case {
    /// Mass of the oscillator in kg.
    mass: f64,
    /// Amplitude of the force in N.
    force: f64,
}

const CASES: [Case; 4] = [
    Case {
        mass: 0.2,
        force: 0.04,
    },
    Case {
        mass: 0.2,
        force: 0.1,
    },
    Case {
        mass: 0.2,
        force: 0.24,
    },
    Case {
        mass: 0.05,
        force: 0.05,
    },
];

impl Case {
    fn oscillator(self) -> Result<SingleDof, Failure> {
        let (mass, w) = (self.mass, TAU * 6.0);
        Ok(SingleDof::new(mass, 2.0 * 0.01 * mass * w, mass * w * w)?)
    }

    fn name(self) -> String {
        format!("{} N on {} kg", self.force, self.mass)
    }
}

fn law() -> RestitutionImpulse {
    RestitutionImpulse::new(Material::acrylic())
}

/// What the bed does in a box that nothing stops.
fn field(quick: bool) -> Result<FieldTable, Failure> {
    let count = if quick { 8 } else { 20 };
    let amplitudes: Vec<f64> = (0..count)
        .map(|n| 0.2e-3 * 150_f64.powf(f64::from(n) / f64::from(count - 1)))
        .collect();
    let frequencies = [5.6, 6.0, 6.4];
    let measure = |n: usize| {
        let fields = EffectiveFields::new(law(), Slot::paper())
            .with(GRAINS, Particle::new(3e-3, 0.2e-3)?)
            .amplitudes([amplitudes[n / frequencies.len()]])
            .frequencies([frequencies[n % frequencies.len()]])
            .periods(10, if quick { 20 } else { 60 });
        Ok(fields.run(|_| ControlFlow::Continue(()))?)
    };
    let cells = spread::all(amplitudes.len() * frequencies.len(), measure)?;
    Ok(FieldTable::from_cells(&cells.concat())?)
}

/// Amplitudes (mm) over frequencies (Hz) of the full simulation.
fn simulate(case: Case, quick: bool) -> Result<Vec<(f64, f64)>, Failure> {
    let count = if quick { 5 } else { 19 };
    let oscillator = case.oscillator()?;
    spread::all(count, |n| {
        let frequency = 5.7 + 0.6 * n as f64 / (count - 1) as f64;
        // Where the grains rest the start fades as slowly as without them.
        let curve = ResponseCurve::new(law())
            .oscillator(oscillator)
            .force(case.force)
            .particles([GRAINS])
            .frequencies([frequency])
            .periods(if quick { 40 } else { 120 }, if quick { 20 } else { 60 });
        let found = curve.run(|_| ControlFlow::Continue(()))?;
        let deflection = case.force / oscillator.stiffness();
        Ok((frequency, 1e3 * deflection * found[0].first_harmonic))
    })
}

/// All amplitudes (mm) of the equivalent damper over frequencies (Hz), and whether they are to be trusted.
fn solve(damper: &EquivalentDamper<FieldTable>, force: f64) -> Result<Vec<(f64, f64)>, Failure> {
    let begin = Instant::now();
    let (mut curve, mut several, mut doubtful) = (Vec::new(), 0, None);
    for step in 0..=200 {
        let frequency = 5.7 + 0.003 * f64::from(step);
        let found = damper.solutions(force, TAU * frequency)?;
        several += usize::from(found.len() > 1);
        doubtful = found
            .iter()
            .find(|found| found.doubtful())
            .copied()
            .or(doubtful);
        curve.extend(found.iter().map(|found| (frequency, 1e3 * found.amplitude)));
    }
    println!(
        "  {} solutions of the equivalent damper in {:.1} ms; {several} of 201 frequencies have several",
        curve.len(),
        1e3 * begin.elapsed().as_secs_f64(),
    );
    if let Some(found) = doubtful {
        let part = 100.0 * found.mass_ratio;
        println!(
            "  they are doubtful: the bed is {part:.0} % of the structure's mass, more than a twentieth"
        );
    }
    Ok(curve)
}

/// Lays both side by side: a row of the table for each point simulated.
fn compare(
    case: Case,
    damper: &EquivalentDamper<FieldTable>,
    full: &[(f64, f64)],
) -> Result<Vec<String>, Failure> {
    println!(
        "{:>8} {:>12} {:>12} {:>8}",
        "Hz", "simulated mm", "equivalent", "off %"
    );
    let (mut rows, mut worst) = (Vec::new(), 0.0_f64);
    for (frequency, simulated) in full {
        let found = damper.solutions(case.force, TAU * frequency)?;
        let near = |a: &f64, b: &f64| (a - simulated).abs().total_cmp(&(b - simulated).abs());
        let nearest = found.iter().map(|found| 1e3 * found.amplitude).min_by(near);
        let shown = nearest.unwrap_or(f64::NAN);
        let off = 100.0 * (shown / simulated - 1.0);
        worst = worst.max(off.abs());
        println!("{frequency:8.3} {simulated:12.4} {shown:12.4} {off:8.2}");
        let Case { mass, force } = case;
        rows.push(format!(
            "{mass},{force},{frequency:.4},{simulated:.6},{shown:.6}"
        ));
    }
    println!("  off by {worst:.1} % at the most");
    Ok(rows)
}

/// Resonances over amplitude.
fn backbone(damper: &EquivalentDamper<FieldTable>) -> Result<Vec<(f64, f64)>, Failure> {
    let amplitudes: Vec<f64> = (0..160)
        .map(|n| 0.2e-3 * 150_f64.powf(f64::from(n) / 159.0))
        .collect();
    let points = damper.backbone(&amplitudes)?.into_iter();
    Ok(points
        .map(|at| (at.angular_frequency / TAU, 1e3 * at.amplitude))
        .collect())
}

fn main() -> Result<(), Failure> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let begin = Instant::now();
    let table = field(quick)?;
    println!(
        "field of the isolated bed: {:.1} s, once",
        begin.elapsed().as_secs_f64()
    );

    let (mut lines, mut rows) = (Vec::new(), Vec::new());
    for (n, case) in CASES.into_iter().enumerate() {
        println!("\n{}", case.name());
        let structure = ModalStructure::oscillator(&case.oscillator()?)?;
        let damper = EquivalentDamper::new(structure, table.clone());
        let curve = solve(&damper, case.force)?;
        let begin = Instant::now();
        let full = simulate(case, quick)?;
        println!(
            "  {} points simulated in {:.1} s",
            full.len(),
            begin.elapsed().as_secs_f64()
        );
        rows.extend(compare(case, &damper, &full)?);
        let label = |what: &str| format!("{}, {what}", case.name());
        lines.push(Line::points(&label("simulated"), n + 1, full));
        lines.push(Line::through(&label("equivalent damper"), n + 1, curve));
        if n == 0 {
            lines.push(Line::through("backbone on 0.2 kg", 0, backbone(&damper)?).dashed(6));
        }
    }

    let directory = output::directory("equivalent")?;
    let columns = "mass_kg,force_n,frequency_hz,simulated_mm,equivalent_mm";
    output::write_table(&directory.join("equivalent.csv"), columns, rows)?;
    let path = directory.join("equivalent.svg");
    Chart {
        title: "20 grains on an oscillator of 6 Hz: field put on it, and simulated",
        axes: ["frequency f (Hz)", "amplitude of the oscillator (mm)"],
        x: 5.7..6.3,
        y: 0.2..30.0,
        logarithmic: [false, true],
        legend: SeriesLabelPosition::LowerLeft,
    }
    .draw(&path, &lines)?;
    output::say_where("picture", &path);
    Ok(())
}
