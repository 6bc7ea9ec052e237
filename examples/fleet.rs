//! Dampers of unlike make in one list: a host keeps them behind one trait, drives them alike, and takes
//! them back to where they were.
//!
//! `cargo run --release --example fleet` leaves `target/fleet/fleet.csv`.

#[path = "support/output.rs"]
mod output;

use std::error::Error;
use std::f64::consts::TAU;

use particle_damper::cavity::Sphere;
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    Cavity, Cuboid, Damper, DrivenDamper, Filling, FillingError, HertzTsuji, Material, Motion,
    Particle, RestitutionImpulse, StepError,
};

fn bed<C: Cavity>(cavity: &C, count: usize) -> Result<Vec<Particle>, FillingError> {
    let grain = Particle::new(2e-3, 0.04e-3)?;
    Filling::new(1).with(count, grain).fill(cavity)
}

/// The work (J) that it takes to shake a damper of whatever make.
fn shake(damper: &mut dyn DrivenDamper, amplitude: f64) -> Result<f64, StepError> {
    let mut work = 0.0;
    for step in 1..=200 {
        let (sine, cosine) = (TAU * 15.0 * 1e-3 * f64::from(step)).sin_cos();
        let (height, speed) = (amplitude * (1.0 - cosine), amplitude * TAU * 15.0 * sine);
        let reaction = damper.drive(Motion::at(DVec3::Y * height, DVec3::Y * speed), 1e-3)?;
        work -= reaction.impulse.y * speed;
    }
    Ok(work)
}

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let cuboid = Cuboid::new(dvec3(0.04, 0.06, 0.04))?;
    let sphere = Sphere::new(0.02)?;
    let fast = RestitutionImpulse::new(Material::acrylic());
    let strict = HertzTsuji::new(Material::acrylic());
    let coarse = Damper::builder(cuboid, fast).particles(bed(&cuboid, 200)?);
    let fine = Damper::builder(sphere, strict).particles(bed(&sphere, 60)?);
    let mut fleet: Vec<(&str, Box<dyn DrivenDamper>)> = vec![
        ("box", Box::new(coarse.time_step(1e-4).build()?)),
        ("sphere", Box::new(fine.build()?)),
    ];

    // Shaken for three periods of 15 Hz, by three amplitudes (m), each time from the same start.
    let mut rows = Vec::new();
    for (name, damper) in &mut fleet {
        let start = damper.snapshot();
        for amplitude in [1e-3, 2e-3, 3e-3] {
            damper.restore(&start)?;
            let work = shake(damper.as_mut(), amplitude)?;
            println!("{name:8}{:.0} mm {:7.3} mJ", 1e3 * amplitude, 1e3 * work);
            rows.push(format!("{name},{amplitude},{work:.9}"));
        }
    }
    let table = output::directory("fleet")?.join("fleet.csv");
    output::write_table(&table, "damper,amplitude_m,work_j", rows)?;
    Ok(())
}
