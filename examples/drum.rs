//! A drum half full of grains turns slowly about its axis: the slope of the bed, over friction.
//!
//! The bed climbs until it slides down again. Its slope is seen in where its centre of mass hangs: across the
//! free surface. While the drum turns slowly it lies between the slope that is left when the drum stops and
//! the one at which the bed flows in a drum that turns fast.
//!
//! `cargo run --release --example drum` leaves `target/drum/drum.csv` and `.svg`.

#[path = "support/chart.rs"]
mod chart;
#[path = "support/output.rs"]
mod output;

use std::error::Error;

use chart::{Chart, Line};
use particle_damper::cavity::Disc;
use particle_damper::glam::DVec3;
use particle_damper::{
    ContactLaw, Damper, Detector, Driven, Filling, Interaction, Material, Motion, Particle,
    RestitutionImpulse,
};
use plotters::prelude::SeriesLabelPosition;

const RADIUS: f64 = 0.05; // m
const SLOW: f64 = 0.5; // rad/s
const FAST: f64 = 5.0; // rad/s
const FRAME: f64 = 0.01; // s

/// Turns the drum at `rate` (rad/s) for `duration` (s). Returns the mean slope of the bed (degrees) over its
/// last part of so many seconds.
fn turn<L: ContactLaw, D: Detector>(
    damper: &mut Damper<Disc, L, Driven, D>,
    angle: &mut f64,
    rate: f64,
    [duration, last]: [f64; 2],
) -> Result<f64, Box<dyn Error + Send + Sync>> {
    let frames = (duration / FRAME) as usize;
    let measured = (last / FRAME) as usize;
    let mut sum = 0.0;
    for frame in 0..frames {
        *angle += rate * FRAME;
        damper.drive(Motion::default().turned_in_plane(*angle, rate), FRAME)?;
        if frame >= frames - measured {
            let centre: DVec3 = damper.particles().map(|own| own.position * own.mass).sum();
            sum += centre.x.atan2(-centre.y).to_degrees();
        }
    }
    Ok(sum / measured as f64)
}

/// Slopes (degrees) of a bed with a coefficient of friction: turning slowly, at rest after it, flowing.
fn slopes(friction: f64, duration: f64) -> Result<[f64; 3], Box<dyn Error + Send + Sync>> {
    let interaction = Interaction::new(0.5, friction)?.with_rolling_friction(0.05)?;
    let law = RestitutionImpulse::new(Material::new(1e7, 0.3, interaction)?);
    let drum = Disc::new(RADIUS)?;
    let bed = Filling::new(7)
        .with(120, Particle::with_density(2e-3, 2500.0)?)
        .with(110, Particle::with_density(1.6e-3, 2500.0)?);
    let mut damper = Damper::builder(drum, law)
        .particles(bed.fill(&drum)?)
        .time_step(2e-4)
        .build()?;
    let mut angle = 0.0;
    let slow = turn(&mut damper, &mut angle, SLOW, [duration + 2.0, duration])?;
    let rest = turn(&mut damper, &mut angle, 0.0, [1.0, 0.2])?;
    let flowing = turn(&mut damper, &mut angle, FAST, [duration + 1.0, duration])?;
    Ok([slow, rest, flowing])
}

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let (frictions, duration): (&[f64], f64) = if quick {
        (&[0.1, 0.6], 0.5)
    } else {
        (&[0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8], 4.0)
    };
    let names = ["turning slowly", "at rest after it", "flowing"];
    let mut number = 0;
    let mut lines = names.map(|name| {
        number += 1;
        Line {
            label: name.into(),
            colour: number,
            dash: 0,
            marked: true,
            points: Vec::new(),
        }
    });
    let mut rows = Vec::new();
    for friction in frictions {
        let slopes = slopes(*friction, duration)?;
        for (line, slope) in lines.iter_mut().zip(slopes) {
            line.points.push((*friction, slope));
        }
        let [slow, rest, flowing] = slopes;
        println!("mu {friction}: {slow:.1} degrees, {rest:.1} at rest, {flowing:.1} flowing");
        rows.push(format!("{friction},{slow:.2},{rest:.2},{flowing:.2}"));
    }
    let directory = output::directory("drum")?;
    let columns = "friction,slow_deg,rest_deg,flowing_deg";
    output::write_table(&directory.join("drum.csv"), columns, rows)?;
    let path = directory.join("drum.svg");
    Chart {
        title: "Slope of 230 grains in a drum of 100 mm: 0.5 rad/s, stopped, 5 rad/s",
        axes: ["coefficient of friction", "slope (degrees)"],
        x: 0.0..0.85,
        y: 0.0..45.0,
        logarithmic: [false; 2],
        legend: SeriesLabelPosition::LowerRight,
    }
    .draw(&path, &lines)?;
    output::say_where("picture", &path);
    Ok(())
}
