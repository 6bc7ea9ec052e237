//! A damper rides in a box of a rapier simulation that hangs on a ball joint: it swings, and twists about
//! the rod.
//!
//! Rapier moves the body; the damper is told where the box is, how it stands and how it moves at the end of
//! each step, and its impulse and angular impulse go to the body before the next one. The same box with the
//! grains fixed in it keeps its motion longer. The program says by how much, and fails if it does not.
//!
//! Run: `cargo run --manifest-path examples/rapier-host/Cargo.toml`

use std::error::Error;
use std::process::ExitCode;

use particle_damper::glam::{DQuat, DVec3};
use particle_damper::{
    Cuboid, Damper, Driven, Filling, Material, Motion, Particle, RestitutionImpulse,
};
use rapier3d_f64::prelude::*;

const BODY: f64 = 0.086; // kg
const SIZE: f64 = 0.04; // m, edge of the box
const ROD: f64 = 0.15; // m, from the joint to the middle of the box
const GRAINS: usize = 60;
const GRAIN: f64 = 0.2e-3; // kg
const TILT: f64 = 0.5; // rad from hanging down
const TWIST: f64 = 12.0; // rad/s about the rod
const INTERVAL: f64 = 1e-3; // s, rapier's step
const DURATION: f64 = 2.0; // s

/// A box of `mass` on a rod without mass, let go at a tilt and spinning about the rod.
fn hang(mass: f64) -> (PhysicsWorld, RigidBodyHandle) {
    let mut world = PhysicsWorld::new();
    world.integration_parameters.dt = INTERVAL;
    let joint = world.insert_body(RigidBodyBuilder::fixed());
    let (sine, cosine) = TILT.sin_cos();
    let inertia = Vector::splat(mass * SIZE * SIZE / 6.0);
    let body = RigidBodyBuilder::dynamic()
        .translation(Vector::new(sine, -cosine, 0.0) * ROD)
        .rotation(Vector::Z * TILT)
        .angvel(Vector::new(-sine, cosine, 0.0) * TWIST)
        .additional_mass_properties(MassProperties::new(Vector::ZERO, mass, inertia))
        .can_sleep(false);
    let body = world.insert_body(body);
    let ball = SphericalJointBuilder::new().local_anchor2(Vector::Y * ROD);
    world.insert_impulse_joint(joint, body, ball);
    (world, body)
}

/// How the box moves, as the damper wants it: the origin of a [`Cuboid`] is its corner.
fn motion(body: &RigidBody) -> Motion {
    let (place, velocity, turning) = (body.translation(), body.linvel(), body.angvel());
    let rotation = body.rotation();
    let orientation = DQuat::from_xyzw(rotation.x, rotation.y, rotation.z, rotation.w);
    let spin = DVec3::new(turning.x, turning.y, turning.z);
    let middle = Motion::at(
        DVec3::new(place.x, place.y, place.z),
        DVec3::new(velocity.x, velocity.y, velocity.z),
    )
    .turned(orientation, spin);
    let corner = middle.to_fixed(DVec3::splat(-0.5 * SIZE));
    Motion::at(corner, middle.velocity_at(corner)).turned(orientation, spin)
}

/// The twist about the rod (rad/s) and the height of the last swings (m) that are left, with grains in the
/// box or fixed to it.
fn swing(loose: bool) -> Result<(f64, f64), Box<dyn Error>> {
    let fixed = if loose { 0.0 } else { GRAIN * GRAINS as f64 };
    let (mut world, body) = hang(BODY + fixed);
    let cavity = Cuboid::new(DVec3::splat(SIZE))?;
    let start = motion(&world.bodies[body]);
    // Down is where gravity points in the box.
    let grains = Filling::new(1)
        .with(GRAINS, Particle::new(3e-3, GRAIN)?)
        .down(start.orientation.inverse() * DVec3::NEG_Y);
    let mut damper = Damper::builder(cavity, RestitutionImpulse::new(Material::acrylic()))
        .mount(Driven::at(start))
        .particles(grains.fill(&cavity)?)
        .time_step(1e-4)
        .build()?;
    let steps = (DURATION / INTERVAL) as usize;
    let (mut twist, mut highest) = (0.0, 0.0_f64);
    for step in 0..steps {
        world.step();
        if loose {
            let end = motion(&world.bodies[body]);
            let reaction = damper.drive(end, INTERVAL)?;
            let [impulse, angular, corner] =
                [reaction.impulse, reaction.angular_impulse, end.position]
                    .map(|vector| Vector::new(vector.x, vector.y, vector.z));
            world.bodies[body].apply_impulse_at_point(impulse, corner, true);
            world.bodies[body].apply_torque_impulse(angular, true);
        }
        let body = &world.bodies[body];
        twist = body.angvel().dot(body.translation()).abs() / ROD;
        if step >= steps / 2 {
            highest = highest.max(ROD + body.translation().y);
        }
    }
    Ok((twist, highest))
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let (loose, fixed) = (swing(true)?, swing(false)?);
    println!("let go {TILT} rad from hanging down, twisting at {TWIST} rad/s; {DURATION} s later");
    for (name, (twist, height)) in [("loose", loose), ("fixed", fixed)] {
        println!(
            "  grains {name}: twists at {twist:.3} rad/s, swings {:.2} mm high",
            height * 1e3
        );
    }
    if loose.0 < 0.95 * fixed.0 {
        return Ok(ExitCode::SUCCESS);
    }
    eprintln!("the twist should decay faster with grains than with their mass");
    Ok(ExitCode::FAILURE)
}
