//! One ball in a box on an oscillator, swept up and down in frequency: what it does depends on where it comes
//! from.
//!
//! On the way up the ball settles into two impacts a period, which hold the oscillator down far beyond its
//! resonance, up to 6.6 Hz; on the way down it bounces about irregularly and finds that motion at 6.4 Hz. The two
//! ways part in two narrower ranges below, where one motion takes over from another.
//! `cargo run --release --example sweep` leaves `target/sweep/sweep.csv` and `.svg`, and says where the two
//! ways part.

#![allow(clippy::print_stdout)]

#[path = "support/chart.rs"]
mod chart;
#[path = "support/output.rs"]
mod output;

use std::error::Error;
use std::ops::ControlFlow;

use chart::{Chart, Line};
use particle_damper::glam::DVec3;
use particle_damper::response::{Branches, Response, Swept};
use particle_damper::{
    Interaction, Material, Particle, ResponseCurve, RestitutionImpulse, SingleDof, Slot,
};
use plotters::prelude::SeriesLabelPosition;

type Failure = Box<dyn Error + Send + Sync>;

const RADIUS: f64 = 3e-3; // m
const MASS: f64 = 8.6e-3; // kg, a tenth of the oscillator's
const TRAVEL: f64 = 0.04; // m

fn sweep(quick: bool) -> Result<Branches, Failure> {
    // Of restitution 0.6, without friction: the case of Masri & Caughey (1966).
    let ball = Material::new(1e9, 0.3, Interaction::new(0.6, 0.0)?)?;
    let count = if quick { 8 } else { 69 };
    let frequency = |n: u32| 5.2 + 1.7 * f64::from(n) / f64::from(count - 1);
    let curve = ResponseCurve::new(RestitutionImpulse::new(ball))
        .cavity(Slot::new(0.02, TRAVEL + 2.0 * RADIUS)?)
        .oscillator(SingleDof::paper())
        .particle(Particle::new(RADIUS, MASS)?)
        .particles([1])
        .gravity(DVec3::ZERO)
        .force(0.25)
        .frequencies((0..count).map(frequency))
        .periods(80, if quick { 20 } else { 120 });
    let lines = curve.sweep(Swept::Frequency, |_| ControlFlow::Continue(()))?;
    Ok(lines.into_iter().next().ok_or("no line")?)
}

fn row(way: &str, response: &Response) -> String {
    let widths = response.half_widths;
    let width = widths.map_or_else(String::new, |widths| format!("{:.6}", widths.rms_mean));
    format!(
        "{way},{:.4},{:.6},{width},{}",
        response.point.frequency, response.rms_mean, response.settled
    )
}

fn main() -> Result<(), Failure> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let branches = sweep(quick)?;
    for parting in branches.parted(0.1) {
        println!(
            "up and down part from {:.3} to {:.3} Hz, by {:.0} % at the most",
            parting.from,
            parting.to,
            100.0 * parting.difference
        );
    }

    let directory = output::directory("sweep")?;
    let up = branches.up.iter().map(|response| row("up", response));
    let down = branches.down.iter().map(|response| row("down", response));
    let columns = "way,frequency_hz,rms_mean,half_width,settled";
    output::write_table(&directory.join("sweep.csv"), columns, up.chain(down))?;

    let line = |label: &str, colour, responses: &[Response]| {
        let points = responses.iter();
        let points = points.map(|response| (response.point.frequency, response.rms_mean));
        Line::through(label, colour, points.collect()).marked()
    };
    let path = directory.join("sweep.svg");
    Chart {
        title: "One ball of a tenth of the mass: up and down in frequency",
        axes: [
            "frequency f (Hz)",
            "RMS displacement about the mean / (F/K)",
        ],
        x: 5.2..6.9,
        y: 1.0..20.0,
        logarithmic: [false, true],
        legend: SeriesLabelPosition::UpperRight,
    }
    .draw(
        &path,
        &[line("up", 1, &branches.up), line("down", 2, &branches.down)],
    )?;
    output::say_where("picture", &path);
    Ok(())
}
