//! Errors name the cause, with its numbers, beside the particle that suffers it.

use particle_damper::cavity::Slot;
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::mount::{Load, Motion, Mount, Prescribed};
use particle_damper::{
    Cause, ContactLaw, Cuboid, Damper, HertzTsuji, Material, Particle, RestitutionImpulse,
    StepError,
};

use super::table::{Table, law, particle};

fn coarse() -> RestitutionImpulse {
    RestitutionImpulse::new(Material::acrylic())
}

fn bed() -> [Particle; 3] {
    [0.01, 0.03, 0.05].map(|x| particle().at(dvec3(x, 0.003, 0.0)))
}

/// What lies behind an error, if it says so.
fn cause(error: &StepError) -> Option<Cause> {
    match error {
        StepError::Escaped { cause, .. }
        | StepError::Overlap { cause, .. }
        | StepError::TooFast { cause, .. }
        | StepError::Jump { cause, .. } => Some(*cause),
        _ => None,
    }
}

/// A mount whose dashpot pushes.
struct Fluttering;

impl Mount for Fluttering {
    fn degrees(&self) -> usize {
        1
    }
    fn start(&self, _x: &mut [f64], v: &mut [f64]) {
        v[0] = 0.1;
    }
    fn motion(&self, _time: f64, x: &[f64], v: &[f64], _cavity: usize) -> Motion {
        Motion::at(DVec3::Y * x[0], DVec3::Y * v[0])
    }
    fn accelerate(&self, _time: f64, x: &[f64], v: &[f64], loads: &[Load], a: &mut [f64]) {
        a[0] = 200.0 * v[0] - 1e5 * x[0] + 1e-3 * loads[0].force.y;
    }
}

#[test]
fn a_mount_that_runs_away_is_named_by_its_coordinate() {
    fn run<L: ContactLaw>(law: L, dt: f64, bed: &[Particle], table: &mut Table) {
        let mut damper = Damper::builder(Slot::paper(), law)
            .mount(Fluttering)
            .particles(bed.iter().copied())
            .time_step(dt)
            .build()
            .unwrap();
        let outcome = (0..1_000_000).try_for_each(|_| damper.step());
        let is = |error: &StepError| match (error, cause(error)) {
            (StepError::Mount { coordinate: 0, .. }, None) => true,
            (
                _,
                Some(Cause::Mount {
                    coordinate: 0,
                    rate,
                    ..
                }),
            ) => rate.abs() > 1.0,
            _ => false,
        };
        table.row(
            outcome,
            is,
            &["the mount runs away", "coordinate 0", "rate"],
        );
    }
    let mut table = Table::default();
    run(law(), 1e-5, &bed(), &mut table);
    run(coarse(), 1e-4, &bed(), &mut table);
    run(law(), 1e-5, &[], &mut table);
    table.end(3);
}

#[test]
fn a_host_that_runs_away_is_named_by_what_it_does_to_the_container() {
    fn run<L: ContactLaw>(law: L, dt: f64, steps: f64, table: &mut Table) {
        let mut damper = Damper::builder(Slot::paper(), law)
            .particles(bed())
            .time_step(dt)
            .build()
            .unwrap();
        let mut x = 1e-6;
        let outcome = (0..200).try_for_each(|_| {
            x *= -1.5;
            let velocity = DVec3::Y * (5.0 / 3.0 * x / (steps * dt));
            let position = DVec3::Y * x;
            damper
                .drive(Motion::at(position, velocity), steps * dt)
                .map(|_| ())
        });
        let is = |error: &StepError| matches!(cause(error), Some(Cause::Container { velocity, .. }) if velocity.length() > 1.0);
        table.row(outcome, is, &["the container moves at", "in the step"]);
    }
    let mut table = Table::default();
    run(law(), 1e-5, 10.0, &mut table);
    run(law(), 1e-5, 1.0, &mut table);
    run(coarse(), 1e-4, 10.0, &mut table);
    run(coarse(), 1e-4, 1.0, &mut table);
    table.end(4);
}

#[test]
fn a_grain_far_above_the_speed_of_the_law_is_named_with_both() {
    let mut table = Table::default();
    for speed in [100.0, 150.0, 400.0] {
        let fast = particle()
            .at(dvec3(0.03, 0.03, 0.0))
            .moving(DVec3::X * speed);
        let mut damper = Damper::builder(Slot::paper(), coarse())
            .particles([fast])
            .overlap_limit(0.3)
            .time_step(1e-4)
            .build()
            .unwrap();
        let outcome = (0..1000).try_for_each(|_| damper.step());
        let is = |error: &StepError| matches!(cause(error), Some(Cause::Speed { particle: 0, reference, .. }) if reference == 1.0);
        table.row(
            outcome,
            is,
            &["particle 0 moves at", "set up for 1 m/s", "reference speed"],
        );
    }
    table.end(3);
}

#[test]
fn a_container_that_leaps_is_refused_where_no_particle_tells() {
    let mut table = Table::default();
    let room = Cuboid::new(DVec3::splat(0.1)).unwrap();
    // A step of 2 mm after 10 ms, that reaches no particle.
    let leaping =
        Prescribed(|t: f64| Motion::at(DVec3::X * if t > 0.01 { 2e-3 } else { 0.0 }, DVec3::ZERO));
    let floating = particle().at(DVec3::splat(0.05));
    let mut damper = Damper::builder(room, law())
        .mount(leaping)
        .gravity(DVec3::ZERO)
        .particles([floating])
        .build()
        .unwrap();
    let outcome = (0..100_000).try_for_each(|_| damper.step());
    let is = |error: &StepError| matches!(error, StepError::Jump { cavity: 0, off, .. } if (off - 2e-3).abs() < 1e-12);
    table.row(outcome, is, &["cavity 0", "0.002 m off", "0.0015 m"]);
    table.end(1);
}

fn shaken(velocity: impl Fn(f64) -> f64 + Copy) -> Result<(), StepError> {
    let mount = || {
        Prescribed(move |t: f64| {
            Motion::at(DVec3::Y * (1e-2 * (40.0 * t).sin()), DVec3::Y * velocity(t))
        })
    };
    let mut strict = Damper::builder(Slot::paper(), law())
        .mount(mount())
        .particles(bed())
        .build()
        .unwrap();
    (0..20_000).try_for_each(|_| strict.step())?;
    let mut damper = Damper::builder(Slot::paper(), coarse())
        .mount(mount())
        .particles(bed())
        .time_step(1e-4)
        .build()
        .unwrap();
    (0..2000).try_for_each(|_| damper.step())
}

#[test]
fn a_prescribed_velocity_that_is_not_the_rate_of_its_position_is_refused() {
    let mut table = Table::default();
    let right = |t: f64| 0.4 * (40.0 * t).cos();
    let is = |error: &StepError| matches!(error, StepError::NotItsRate { cavity: 0, .. });
    let texts = ["cavity 0", "not the rate of its position", "m/s"];
    table.row(shaken(|_| 0.0), is, &texts);
    table.row(shaken(|t| -right(t)), is, &texts);
    table.row(shaken(|t| 1e3 * right(t)), is, &texts);
    table.row(shaken(|t| right(t) / 40.0), is, &texts);
    table.end(4);
    shaken(right).unwrap();
}

#[test]
fn a_prescribed_motion_may_have_kinks() {
    for start in [0.0101, 0.010_133, 0.0102] {
        let belt = Prescribed(|t: f64| {
            Motion::at(
                DVec3::X * (0.5 * (t - start).max(0.0)),
                DVec3::X * if t > start { 0.5 } else { 0.0 },
            )
        });
        let mut damper = Damper::builder(Slot::paper(), coarse())
            .mount(belt)
            .particles(bed())
            .time_step(1e-4)
            .build()
            .unwrap();
        for _ in 0..1000 {
            damper.step().unwrap();
        }
    }
}

/// A belt that turns back at once was refused where it did so near the end of a step.
#[test]
fn a_prescribed_motion_may_turn_back_at_once() {
    for start in [0.0101, 0.010_110, 0.010_133, 0.010_199] {
        let there_and_back = Prescribed(|t: f64| {
            let velocity = if t > start { -0.5 } else { 0.5 };
            Motion::at(DVec3::X * (velocity * (t - start)), DVec3::X * velocity)
        });
        let mut damper = Damper::builder(Slot::paper(), coarse())
            .mount(there_and_back)
            .particles(bed())
            .time_step(1e-4)
            .build()
            .unwrap();
        for _ in 0..200 {
            damper.step().unwrap();
        }
    }
}

#[test]
fn a_strict_law_that_refuses_dead_impacts_names_the_coarse_one() {
    let mut table = Table::default();
    let mut dead = Material::acrylic();
    dead.interaction.restitution = 0.0;
    let built = Damper::builder(Slot::paper(), HertzTsuji::new(dead))
        .particles(bed())
        .build();
    table.row(
        built,
        |_| true,
        &["restitution", "not 0", "RestitutionImpulse"],
    );
    let coarse = Damper::builder(Slot::paper(), RestitutionImpulse::new(dead));
    assert!(coarse.particles(bed()).build().is_ok());
    table.end(1);
}
