//! The equivalent damper beside the full simulation: the field of an isolated bed is measured once, and put on
//! an oscillator by harmonic balance, for any force and in milliseconds.
//!
//! An oscillator of 0.2 kg at 6 Hz carries the paper's container with 20 acrylic spheres (2 % of its mass), under
//! three forces; one of 0.05 kg carries the same container, which is more than the shortcut is made for (8 %), but
//! many small blows still shake it almost as a sine. Then one ball in a box, a tenth of the paper's oscillator: its
//! blows do not, and where solutions say that they are doubtful they are. `cargo run --release --example
//! equivalent` leaves `target/equivalent/equivalent.csv` and a picture.

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
use particle_damper::equivalent::{EquivalentDamper, Field, FieldTable, ModalStructure};
use particle_damper::glam::DVec3;
use particle_damper::impact_damper::OneBall;
use particle_damper::{
    EffectiveFields, Interaction, Material, Particle, ResponseCurve, RestitutionImpulse, SingleDof,
    Slot,
};
use plotters::prelude::SeriesLabelPosition;

type Failure = Box<dyn Error + Send + Sync>;

const GRAINS: usize = 20;

/// A structure with a damper, and how it is simulated.
struct Case {
    name: String,
    oscillator: SingleDof,
    /// Amplitude of the force in N.
    force: f64,
    /// Frequencies in Hz, from and to.
    frequencies: [f64; 2],
    curve: ResponseCurve<RestitutionImpulse>,
}

/// The grains on an oscillator of a mass (kg), under a force (N).
fn grains(mass: f64, force: f64) -> Result<Case, Failure> {
    let w = TAU * 6.0;
    Ok(Case {
        name: format!("{force} N on {mass} kg"),
        oscillator: SingleDof::new(mass, 2.0 * 0.01 * mass * w, mass * w * w)?,
        force,
        frequencies: [5.7, 6.3],
        curve: ResponseCurve::new(law()).particles([GRAINS]),
    })
}

/// One ball in a box on the paper's oscillator (Masri & Caughey 1966), and its field in closed form.
fn ball() -> Result<(Case, OneBall), Failure> {
    let (mass, radius, restitution, travel) = (8.6e-3, 3e-3, 0.6, 0.04);
    let material = Material::new(1e9, 0.3, Interaction::new(restitution, 0.0)?)?;
    let case = Case {
        name: "one ball of 10 %".into(),
        oscillator: SingleDof::paper(),
        force: 0.25,
        frequencies: [6.0, 6.3],
        curve: ResponseCurve::new(RestitutionImpulse::new(material))
            .cavity(Slot::new(0.02, travel + 2.0 * radius)?)
            .particle(Particle::new(radius, mass)?)
            .gravity(DVec3::ZERO)
            .particles([1]),
    };
    Ok((case, OneBall::new(mass, restitution, travel)?))
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
fn simulate(case: &Case, quick: bool) -> Result<Vec<(f64, f64)>, Failure> {
    let count = if quick { 5 } else { 19 };
    let [low, high] = case.frequencies;
    spread::all(count, |n| {
        let frequency = low + (high - low) * n as f64 / (count - 1) as f64;
        // Where the grains rest the start fades as slowly as without them.
        let curve = case.curve.clone();
        let curve = curve
            .oscillator(case.oscillator)
            .force(case.force)
            .frequencies([frequency])
            .periods(if quick { 40 } else { 120 }, if quick { 20 } else { 60 });
        let found = curve.run(|_| ControlFlow::Continue(()))?;
        let deflection = case.force / case.oscillator.stiffness();
        Ok((frequency, 1e3 * deflection * found[0].first_harmonic))
    })
}

/// All amplitudes (mm) of the equivalent damper over frequencies (Hz), and what speaks against them.
fn solve<F: Field>(case: &Case, damper: &EquivalentDamper<F>) -> Result<Vec<(f64, f64)>, Failure> {
    let begin = Instant::now();
    let [low, high] = case.frequencies;
    let (mut curve, mut several, mut none, mut doubt) = (Vec::new(), 0, 0, None);
    for step in 0..=200 {
        let frequency = low + (high - low) * f64::from(step) / 200.0;
        let found = damper.solutions(case.force, TAU * frequency)?;
        several += usize::from(found.len() > 1);
        none += usize::from(found.is_empty());
        doubt = found
            .iter()
            .find(|found| found.doubtful())
            .copied()
            .or(doubt);
        curve.extend(found.iter().map(|found| (frequency, 1e3 * found.amplitude)));
    }
    println!(
        "  {} solutions of the equivalent damper in {:.1} ms; of 201 frequencies {several} have several, {none} none",
        curve.len(),
        1e3 * begin.elapsed().as_secs_f64(),
    );
    if let Some(found) = doubt {
        let third = found.distortion.map_or_else(String::new, |part| {
            format!(
                "; the third harmonic is {:.1} % of the motion",
                100.0 * part
            )
        });
        let part = 100.0 * found.mass_ratio;
        println!("  doubtful: the bed is {part:.0} % of the structure's mass{third}");
    }
    Ok(curve)
}

/// Lays both side by side: a row of the table for each point simulated.
fn compare<F: Field>(
    case: &Case,
    damper: &EquivalentDamper<F>,
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
        rows.push(format!(
            "{},{frequency:.4},{simulated:.6},{shown:.6}",
            case.name
        ));
    }
    println!("  off by {worst:.1} % at the most");
    Ok(rows)
}

/// Solves a case, simulates it, and lays both side by side.
fn show<F: Field>(
    case: &Case,
    field: F,
    quick: bool,
    lines: &mut Vec<Line>,
) -> Result<(EquivalentDamper<F>, Vec<String>), Failure> {
    println!("\n{}", case.name);
    let damper = EquivalentDamper::new(ModalStructure::oscillator(&case.oscillator)?, field);
    let curve = solve(case, &damper)?;
    let begin = Instant::now();
    let full = simulate(case, quick)?;
    println!(
        "  {} points simulated in {:.1} s",
        full.len(),
        begin.elapsed().as_secs_f64()
    );
    let rows = compare(case, &damper, &full)?;
    let colour = lines.len() / 2 + 1;
    lines.push(Line::points("", colour, full));
    lines.push(Line::through(&case.name, colour, curve));
    Ok((damper, rows))
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

    let (mut lines, mut rows, mut resonances) = (Vec::new(), Vec::new(), Vec::new());
    for (mass, force) in [(0.2, 0.04), (0.2, 0.1), (0.2, 0.24), (0.05, 0.05)] {
        let case = grains(mass, force)?;
        let (damper, own) = show(&case, table.clone(), quick, &mut lines)?;
        rows.extend(own);
        if resonances.is_empty() {
            resonances = backbone(&damper)?;
        }
    }
    let (case, field) = ball()?;
    rows.extend(show(&case, field, quick, &mut lines)?.1);
    lines.push(Line::through("backbone on 0.2 kg", 0, resonances).dashed(6));

    let directory = output::directory("equivalent")?;
    let columns = "case,frequency_hz,simulated_mm,equivalent_mm";
    output::write_table(&directory.join("equivalent.csv"), columns, rows)?;
    let path = directory.join("equivalent.svg");
    Chart {
        title: "Fields put on an oscillator (lines), and the full simulation (points)",
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
