//! A recorded base acceleration shakes the paper's oscillator, with and without particles.
//!
//! The record is `examples/data/base_acceleration.csv` or a file named on the command line: a heading,
//! then time (s, evenly spaced) and acceleration (m/s^2). It is integrated twice, because a support
//! acts on the mass by its displacement and velocity. (The one that comes with the example was made
//! up: a dozen or two sines of 2 to 9 Hz in an envelope.)
//! `cargo run --release --example custom_excitation` leaves `target/custom_excitation/shaken.csv` and
//! `.svg`.

#![allow(clippy::print_stdout)]

#[path = "support/chart.rs"]
mod chart;
#[path = "support/output.rs"]
mod output;

use std::error::Error;
use std::fs;
use std::path::PathBuf;

use chart::{Chart, Line};
use particle_damper::excitation::{Base, Sampled, Signal};
use particle_damper::{Damper, Filling, Material, Particle, RestitutionImpulse, SingleDof, Slot};
use plotters::prelude::SeriesLabelPosition;

type Failure = Box<dyn Error + Send + Sync>;

/// The displacement of the base from a table of its acceleration.
fn base(table: &str) -> Result<Sampled, Failure> {
    let mut times = Vec::new();
    let mut accelerations = Vec::new();
    for line in table.lines().skip(1) {
        let (time, acceleration) = line.split_once(',').ok_or("a line needs two columns")?;
        times.push(time.trim().parse::<f64>()?);
        accelerations.push(acceleration.trim().parse::<f64>()?);
    }
    let [first, second, ..] = times[..] else {
        return Err("a record needs two samples".into());
    };
    Ok(Sampled::new(second - first, accelerations)?
        .integral()
        .integral())
}

/// Displacement of the mass against the base (mm) over time (s).
fn shaken(base: &Sampled, particles: usize, duration: f64) -> Result<Vec<(f64, f64)>, Failure> {
    let filling = Filling::new(1).with(particles, Particle::new(3e-3, 0.2e-3)?);
    let law = RestitutionImpulse::new(Material::acrylic());
    let mut damper = Damper::builder(Slot::paper(), law)
        .mount(SingleDof::paper().excited_by(Base(base.clone())))
        .particles(filling.fill(&Slot::paper())?)
        .time_step(1e-4)
        .build()?;
    let mut record = Vec::new();
    while damper.time() < duration {
        damper.step()?;
        let stretch = damper.coordinates()[0] - base.value(damper.time());
        record.push((damper.time(), 1e3 * stretch));
    }
    Ok(record)
}

fn main() -> Result<(), Failure> {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let quick = arguments.iter().any(|argument| argument == "--quick");
    arguments.retain(|argument| argument != "--quick");
    let shipped = || {
        let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
        root.join("examples/data/base_acceleration.csv")
    };
    let path = arguments.first().map_or_else(shipped, PathBuf::from);
    let base = base(&fs::read_to_string(path)?)?;
    let duration = if quick { 1.0 } else { base.duration() };

    let bare = shaken(&base, 0, duration)?;
    let damped = shaken(&base, 60, duration)?;
    let peak = |record: &[(f64, f64)]| record.iter().fold(0.0_f64, |a, b| a.max(b.1.abs()));
    println!(
        "peak without particles {:.2} mm, with 60 {:.2} mm",
        peak(&bare),
        peak(&damped)
    );

    let directory = output::directory("custom_excitation")?;
    let rows = bare.iter().zip(&damped).step_by(10);
    let rows = rows.map(|(bare, damped)| format!("{:.4},{:.5},{:.5}", bare.0, bare.1, damped.1));
    let columns = "time_s,without_mm,with_60_mm";
    output::write_table(&directory.join("shaken.csv"), columns, rows)?;
    let high = 1.1 * peak(&bare).max(peak(&damped));
    let line = |label: &str, colour, record: &[(f64, f64)]| Line {
        label: label.into(),
        colour,
        dash: 0,
        marked: false,
        points: record.iter().step_by(10).copied().collect(),
    };
    let path = directory.join("shaken.svg");
    Chart {
        title: "An oscillator on a shaken base",
        axes: ["time t (s)", "displacement against the base (mm)"],
        x: 0.0..duration,
        y: -high..high,
        logarithmic: [false; 2],
        legend: SeriesLabelPosition::UpperRight,
    }
    .draw(
        &path,
        &[
            line("no particles", 0, &bare),
            line("60 particles", 2, &damped),
        ],
    )?;
    output::say_where("picture", &path);
    Ok(())
}
