//! The paper's Fig. 8: one particle falls on a plate, by the strict law and by the approximate one.
//! The strict law's damping coefficient `c_p` is fitted to the approximate rebound.
//!
//! `cargo run --release --example rebound` leaves `target/rebound/rebound.csv` and `.svg`.

#[path = "support/chart.rs"]
mod chart;
#[path = "support/output.rs"]
mod output;

use std::error::Error;

use chart::{Chart, Line};
use clap::Parser;
use particle_damper::glam::DVec3;
use particle_damper::{
    Bodies, Body, ContactLaw, Damper, HertzTsuji, Integrator, Material, Materials, Particle,
    RestitutionImpulse, RungeKutta4, Slot, VelocityVerlet,
};
use plotters::prelude::SeriesLabelPosition;

type Failure = Box<dyn Error + Send + Sync>;

const RADIUS: f64 = 3e-3;
const MASS: f64 = 0.2e-3;

/// One particle rebounds on a plate by two laws.
#[derive(Debug, Parser)]
struct Options {
    /// Height of the fall in m.
    #[arg(long, default_value_t = 0.05)]
    height: f64,
    /// Simulated time in s.
    #[arg(long, default_value_t = 0.6)]
    duration: f64,
    /// A fifth of the time.
    #[arg(long)]
    quick: bool,
}

/// Time (s) and height (m) of the particle's lowest point, for each step.
fn fall<L: ContactLaw, I: Integrator>(
    law: L,
    integrator: I,
    time_step: f64,
    options: &Options,
) -> Result<Vec<(f64, f64)>, Failure> {
    let start = DVec3::new(0.03, RADIUS + options.height, 0.0);
    let mut damper = Damper::builder(Slot::new(0.06, 2.0 * options.height + 0.1)?, law)
        .integrator(integrator)
        .particles([Particle::new(RADIUS, MASS)?.at(start)])
        .time_step(time_step)
        .build()?;
    let duration = if options.quick {
        0.2 * options.duration
    } else {
        options.duration
    };
    let mut trace = vec![(0.0, options.height)];
    while damper.time() < duration {
        damper.step()?;
        for particle in damper.particles() {
            trace.push((damper.time(), particle.position.y - RADIUS));
        }
    }
    Ok(trace)
}

fn main() -> Result<(), Failure> {
    let options = Options::parse();
    let acrylic = Material::acrylic();
    // The speed of the first impact: the rebound fitted there has the measured restitution.
    let speed = (2.0 * 9.81 * options.height).sqrt();
    let strict = HertzTsuji::new(acrylic).reference_speed(speed)?;
    let plate = Bodies::new(
        Body::sphere(RADIUS, MASS, Materials::FIRST),
        Body::wall(Materials::FIRST),
    );
    println!(
        "c_p = {:.2} N s/m^1.5 for e = {} at {speed:.3} m/s",
        strict.damping_coefficient(&plate)?,
        acrylic.interaction.restitution
    );
    let strict = fall(strict, RungeKutta4::default(), 2e-5, &options)?;
    let approximate = RestitutionImpulse::new(acrylic);
    let approximate = fall(approximate, VelocityVerlet, 1e-4, &options)?;

    let directory = output::directory("rebound")?;
    let traces = [("hertz-tsuji", &strict), ("restitution", &approximate)];
    let rows = traces.iter().flat_map(|(law, trace)| {
        trace
            .iter()
            .map(move |(time, height)| format!("{law},{time:.6},{height:.7}"))
    });
    output::write_table(&directory.join("rebound.csv"), "law,time_s,height_m", rows)?;
    let in_millimetres = |trace: &[(f64, f64)]| -> Vec<_> {
        trace
            .iter()
            .map(|(time, height)| (*time, 1e3 * height))
            .collect()
    };
    let path = directory.join("rebound.svg");
    Chart {
        title: "Rebound of a particle on a plate, e = 0.75",
        axes: ["time t (s)", "height above the plate (mm)"],
        x: 0.0..strict.last().map_or(1.0, |last| last.0),
        y: -1.0..1.1e3 * options.height,
        logarithmic: [false; 2],
        legend: SeriesLabelPosition::UpperRight,
    }
    .draw(
        &path,
        &[
            Line {
                label: "strict, dt 2e-5 s".into(),
                colour: 1,
                dash: 0,
                marked: false,
                points: in_millimetres(&strict),
            },
            Line {
                label: "approximate, dt 1e-4 s".into(),
                colour: 2,
                dash: 8,
                marked: false,
                points: in_millimetres(&approximate),
            },
        ],
    )?;
    output::say_where("picture", &path);
    Ok(())
}
