//! A damper rides on a body of a rapier simulation that hangs on a spring.
//!
//! Rapier moves the body; the damper is told where the body is and how it moves at the end of each
//! step, and its impulse goes to the body before the next one. The same swing with the grains' weight
//! fixed to the body decays more slowly. The program says by how much, and fails if it does not.
//!
//! Run: `cargo run --manifest-path examples/rapier-host/Cargo.toml`

use std::error::Error;
use std::process::ExitCode;

use particle_damper::glam::DVec3;
use particle_damper::{
    Damper, Driven, Filling, Material, Motion, Particle, RestitutionImpulse, Slot,
};
use rapier2d_f64::prelude::*;

const BODY: f64 = 0.086; // kg
const STIFFNESS: f64 = 123.4; // N/m
const DAMPING: f64 = 0.08; // N s/m
const GRAINS: usize = 60;
const GRAIN: f64 = 0.2e-3; // kg
const RELEASE: f64 = 0.02; // m above the position of rest
const INTERVAL: f64 = 1e-3; // s, rapier's step
const DURATION: f64 = 2.0; // s

/// A body of `mass` on a spring that carries body and grains with the body at the origin.
fn hang(mass: f64) -> (PhysicsWorld, RigidBodyHandle) {
    let mut world = PhysicsWorld::new();
    world.integration_parameters.dt = INTERVAL;
    let height = 0.5;
    let weight = (BODY + GRAIN * GRAINS as f64) * 9.81;
    let ceiling = world.insert_body(RigidBodyBuilder::fixed().translation(Vector::Y * height));
    let body = RigidBodyBuilder::dynamic()
        .translation(Vector::Y * RELEASE)
        .additional_mass(mass)
        .enabled_translations(false, true)
        .lock_rotations()
        .can_sleep(false);
    let body = world.insert_body(body);
    let spring = SpringJointBuilder::new(height - weight / STIFFNESS, STIFFNESS, DAMPING);
    world.insert_impulse_joint(ceiling, body, spring);
    (world, body)
}

/// How the body moves, as the damper wants it.
fn motion(body: &RigidBody) -> Motion {
    let (place, velocity) = (body.translation(), body.linvel());
    Motion::at(
        DVec3::new(place.x, place.y, 0.0),
        DVec3::new(velocity.x, velocity.y, 0.0),
    )
}

/// The largest height over the last fifth of a swing, with grains in the body or fixed to it.
fn swing(loose: bool) -> Result<f64, Box<dyn Error>> {
    let fixed = if loose { 0.0 } else { GRAIN * GRAINS as f64 };
    let (mut world, body) = hang(BODY + fixed);
    let grains = Filling::new(1).with(GRAINS, Particle::new(3e-3, GRAIN)?);
    let mut damper = Damper::builder(Slot::paper(), RestitutionImpulse::new(Material::acrylic()))
        .mount(Driven::at(motion(&world.bodies[body])))
        .particles(grains.fill(&Slot::paper())?)
        .time_step(1e-4)
        .build()?;
    let steps = (DURATION / INTERVAL) as usize;
    let mut largest = 0.0_f64;
    for step in 0..steps {
        world.step();
        if loose {
            let reaction = damper.drive(motion(&world.bodies[body]), INTERVAL)?;
            let impulse = Vector::new(reaction.impulse.x, reaction.impulse.y);
            world.bodies[body].apply_impulse(impulse, true);
        }
        if step >= steps * 4 / 5 {
            largest = largest.max(world.bodies[body].translation().y.abs());
        }
    }
    Ok(largest)
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let (loose, fixed) = (swing(true)?, swing(false)?);
    println!(
        "let go {:.1} mm from rest; {DURATION} s later",
        RELEASE * 1e3
    );
    println!("  grains loose: {:.3} mm", loose * 1e3);
    println!("  grains fixed: {:.3} mm", fixed * 1e3);
    if loose < 0.8 * fixed {
        return Ok(ExitCode::SUCCESS);
    }
    eprintln!("the swing should decay faster with grains than with their weight");
    Ok(ExitCode::FAILURE)
}
