//! A host program that moves the container and gets the particles' reaction back.
//!
//! `cargo run --release --example quickstart` leaves `target/quickstart/quickstart.csv` and `.svg`.

#[path = "support/chart.rs"]
mod chart;
#[path = "support/output.rs"]
mod output;

use std::error::Error;
use std::f64::consts::TAU;

use chart::{Chart, Line};
use particle_damper::glam::DVec3;
use particle_damper::mount::Motion;
use particle_damper::{Cuboid, Damper, Filling, Material, Particle, RestitutionImpulse};
use plotters::prelude::SeriesLabelPosition;

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    // A box of 40 x 60 x 40 mm with 200 acrylic spheres.
    let cavity = Cuboid::new(DVec3::new(0.04, 0.06, 0.04))?;
    let bed = Filling::new(1)
        .with(200, Particle::new(2e-3, 0.04e-3)?)
        .fill(&cavity)?;
    let law = RestitutionImpulse::new(Material::acrylic());
    let mut damper = Damper::builder(cavity, law)
        .particles(bed)
        .time_step(1e-4)
        .build()?;

    // The host's loop: shake by 3 mm at 15 Hz, and take the reaction back every millisecond.
    let (amplitude, w, interval) = (3e-3, TAU * 15.0, 1e-3);
    let (mut rows, mut points, mut work) = (Vec::new(), Vec::new(), 0.0);
    for step in 1..=500 {
        let time = f64::from(step) * interval;
        let end = Motion::at(
            DVec3::Y * amplitude * (1.0 - (w * time).cos()),
            DVec3::Y * amplitude * w * (w * time).sin(),
        );
        let reaction = damper.drive(end, interval)?;
        work -= reaction.impulse.dot(end.velocity);
        let mean_force = reaction.impulse.y / interval;
        rows.push(format!("{time:.3},{:.6},{mean_force:.6}", end.position.y));
        points.push((time, mean_force));
    }
    println!(
        "{:.2} mJ put into the bed; {} particles outside",
        1e3 * work,
        damper.outside()
    );

    let directory = output::directory("quickstart")?;
    let columns = "time_s,container_m,force_n";
    output::write_table(&directory.join("quickstart.csv"), columns, rows)?;
    let lowest = points.iter().fold(0.0_f64, |low, point| low.min(point.1));
    let highest = points.iter().fold(0.0_f64, |high, point| high.max(point.1));
    let path = directory.join("quickstart.svg");
    Chart {
        title: "Force of 200 particles on a box shaken by 3 mm at 15 Hz",
        axes: ["time t (s)", "mean vertical force over 1 ms (N)"],
        x: 0.0..0.5,
        y: 1.1 * lowest - 0.01..1.1 * highest + 0.01,
        logarithmic: [false; 2],
        legend: SeriesLabelPosition::LowerRight,
    }
    .draw(
        &path,
        &[Line {
            label: "force on the box".into(),
            colour: 1,
            dash: 0,
            marked: false,
            points,
        }],
    )?;
    output::say_where("picture", &path);
    Ok(())
}
