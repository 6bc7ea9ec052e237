//! Rolling resistance on an incline: a constant couple, rolling friction coefficient times normal
//! force times radius.

use particle_damper::cavity::Slot;
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    ContactLaw, Damper, HertzMindlin, HertzTsuji, Interaction, Material, Particle,
    RestitutionImpulse,
};

const RADIUS: f64 = 3e-3;
const MASS: f64 = 0.2e-3;
const ROLLING: f64 = 0.1;
const GRAVITY: f64 = 9.81;

fn material() -> Material {
    let interaction = Interaction::new(0.75, 0.5).unwrap();
    let interaction = interaction.with_rolling_friction(ROLLING).unwrap();
    Material::new(0.4e9, 0.3, interaction).unwrap()
}

/// A sphere rolls at `start` (m/s) down a floor of `slope`: its speed after 0.3 s, its acceleration
/// over the last 0.2 s, and the slip of its surface at the end.
fn down<L: ContactLaw>(law: L, time_step: f64, slope: f64, start: f64) -> (f64, f64, f64) {
    let angle = slope.atan();
    let normal = GRAVITY * angle.cos();
    let stiffness = 1.605_048e7;
    let sunk = (MASS * normal / stiffness).powf(2.0 / 3.0);
    let sphere = Particle::new(RADIUS, MASS)
        .unwrap()
        .at(dvec3(0.01, RADIUS - sunk, 0.0))
        .moving(DVec3::X * start)
        .spinning(DVec3::NEG_Z * start / RADIUS);
    let mut damper = Damper::builder(Slot::new(10.0, 0.1).unwrap(), law)
        .gravity(dvec3(GRAVITY * angle.sin(), -normal, 0.0))
        .particles([sphere])
        .time_step(time_step)
        .build()
        .unwrap();
    for _ in 0..(0.1 / time_step) as usize {
        damper.step().unwrap();
    }
    let before = damper.particle(0).unwrap().velocity.x;
    let begin = damper.time();
    for _ in 0..(0.2 / time_step) as usize {
        damper.step().unwrap();
    }
    let sphere = damper.particle(0).unwrap();
    let slip = sphere.velocity.x + sphere.spin.z * RADIUS;
    let acceleration = (sphere.velocity.x - before) / (damper.time() - begin);
    (sphere.velocity.x, acceleration, slip)
}

/// Rolling without slip: a = 5/7 g (sin - mu_r cos).
fn theory(slope: f64) -> f64 {
    let angle = slope.atan();
    5.0 / 7.0 * GRAVITY * (angle.sin() - ROLLING * angle.cos())
}

/// `creep` is the speed that is allowed at rest, over g sin times the time step.
fn holds_on_an_incline<L: ContactLaw + Clone>(law: &L, time_step: f64, creep: f64) {
    for slope in [0.02, 0.05, 0.09] {
        let (speed, _, _) = down(law.clone(), time_step, slope, 0.0);
        let pull = GRAVITY * slope.atan().sin() * time_step;
        assert!(
            speed.abs() <= creep * pull,
            "slope {slope}: creeps at {} g sin dt",
            speed / pull
        );
    }
    for slope in [0.12, 0.2, 0.4] {
        let (_, acceleration, slip) = down(law.clone(), time_step, slope, 0.0);
        let expected = theory(slope);
        assert!(
            (acceleration - expected).abs() < 5e-3 * expected,
            "slope {slope}: {acceleration} for {expected} m/s^2"
        );
        assert!(slip.abs() < 2e-3, "slope {slope}: slips at {slip} m/s");
    }
    // What rolls on a slope under the critical one comes to rest as theory has it.
    let (_, acceleration, _) = down(law.clone(), time_step, 0.05, 0.3);
    let expected = theory(0.05);
    assert!(
        (acceleration - expected).abs() < 5e-3 * -expected,
        "{acceleration} for {expected} m/s^2"
    );
}

/// Without memory, slip and spin are resisted in proportion below what a step could stop: they fade
/// at 7 mu f_n dt / m and 5 mu_r f_n dt / (m r), and rest is a creep of (7 + 5) g sin dt.
#[test]
fn a_sphere_stays_or_rolls_under_the_strict_law() {
    holds_on_an_incline(&HertzTsuji::new(material()), 1e-5, 12.01);
    holds_on_an_incline(&HertzTsuji::new(material()), 5e-6, 12.01);
}

/// A tangential spring does not creep; the rolling couple does.
#[test]
fn a_sphere_stays_or_rolls_under_the_strict_law_with_a_tangential_spring() {
    holds_on_an_incline(&HertzMindlin::new(material()), 1e-5, 5.01);
}

#[test]
fn a_sphere_stays_or_rolls_under_the_impulse_law() {
    holds_on_an_incline(&RestitutionImpulse::new(material()), 1e-4, 0.01);
}

/// A ball alone in the second cavity: its number among the cavities was taken for that of a partner, and a
/// step panicked.
#[test]
fn a_lone_ball_of_the_second_cavity_is_slowed_down() {
    let ball = Particle::new(RADIUS, MASS)
        .unwrap()
        .at(dvec3(0.05, RADIUS, 0.0))
        .moving(DVec3::X * 0.3)
        .spinning(DVec3::NEG_Z * 0.3 / RADIUS)
        .in_cavity(1);
    let slot = Slot::new(10.0, 0.1).unwrap();
    let mut damper = Damper::builder(slot, RestitutionImpulse::new(material()))
        .another_cavity(slot)
        .particles([ball])
        .time_step(1e-4)
        .build()
        .unwrap();
    for _ in 0..1000 {
        damper.step().unwrap();
    }
    let expected = 0.3 + theory(0.0) * damper.time();
    let speed = damper.particle(0).unwrap().velocity.x;
    assert!(
        (speed - expected).abs() < 5e-3 * expected,
        "{speed} for {expected} m/s"
    );
}
