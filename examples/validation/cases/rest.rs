//! Beds at rest, and beds that are hit: nothing creeps, nothing leaves.

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::mount::{Motion, Prescribed};
use particle_damper::{
    BuildError, ContactLaw, Damper, Filling, HertzMindlin, HertzTsuji, Material, Particle,
    RestitutionImpulse, Slot,
};

use super::Form;
use super::case::Case;
use super::setup::{acrylic, paper_particle};

const REST: &str = "a bed at rest under gravity stays where it is";
const SLAM: &str = "walls hold, whatever the acceleration of the box";
const ALONE: &str = "energy of a bed left alone falls";

pub(crate) fn cases(form: Form) -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, [drift, outside], steps) in at_rest(form) {
        let name = format!("pile of 60, {name}, {steps}");
        cases.push(Case::bounded(
            format!("{name}: drift / r"),
            REST,
            1e-3,
            drift,
        ));
        cases.push(Case::bounded(
            format!("{name}: outside"),
            REST,
            0.0,
            outside,
        ));
    }
    cases.extend(slammed(form));
    cases.extend(left_alone());
    cases
}

fn bed() -> Vec<Particle> {
    Filling::new(3)
        .with(60, paper_particle())
        .fill(&Slot::paper())
        .unwrap()
}

/// The longest step that `law` accepts for the paper's particles.
fn longest<L: ContactLaw>(law: L) -> f64 {
    let refused = Damper::builder(Slot::paper(), law)
        .particles(bed())
        .time_step(1e9)
        .build();
    match refused {
        Err(BuildError::TimeStepTooLong { limit, .. }) => limit,
        _ => f64::NAN,
    }
}

/// Largest displacement over r, and particles outside, of a bed that settles and is then left for
/// `seconds`.
fn drift<L: ContactLaw>(law: L, dt: f64, settle: f64, seconds: f64) -> [f64; 2] {
    let mut damper = Damper::builder(Slot::paper(), law)
        .particles(bed())
        .time_step(dt)
        .contained(false)
        .build()
        .unwrap();
    while damper.time() < settle {
        damper.step().unwrap();
    }
    let before: Vec<DVec3> = damper.particles().map(|body| body.position).collect();
    while damper.time() < settle + seconds {
        damper.step().unwrap();
    }
    let moved = damper
        .particles()
        .zip(before)
        .map(|(body, before)| body.position.distance(before) / body.radius);
    [moved.fold(0.0, f64::max), damper.outside() as f64]
}

/// A law and its restitution.
enum Choice {
    Strict,
    Spring,
    Coarse(f64),
}

fn at_rest(form: Form) -> Vec<(&'static str, [f64; 2], String)> {
    let strict = || HertzTsuji::new(Material::acrylic());
    let spring = || HertzMindlin::new(Material::acrylic());
    let coarse = |e| RestitutionImpulse::new(acrylic(e, 0.2));
    let (settle, seconds) = match form {
        Form::Short => (4.0, 2.0),
        Form::Long => (10.0, 60.0),
    };
    let mut runs = Vec::new();
    let mut add = |name, law: Choice, dt: f64| {
        let drift = match law {
            Choice::Strict => drift(strict(), dt, settle, seconds),
            Choice::Spring => drift(spring(), dt, settle, seconds),
            Choice::Coarse(e) => drift(coarse(e), dt, settle, seconds),
        };
        runs.push((name, drift, format!("{seconds} s in steps of {dt:.3e} s")));
    };
    add("HertzTsuji", Choice::Strict, 2e-5);
    add("HertzTsuji", Choice::Strict, longest(strict()));
    add("HertzMindlin", Choice::Spring, 2e-5);
    add("HertzMindlin", Choice::Spring, longest(spring()));
    for e in [0.75, 0.0] {
        let name = ["RestitutionImpulse", "RestitutionImpulse, e 0"][usize::from(e == 0.0)];
        for dt in [1e-4, 3e-4, longest(coarse(e))] {
            add(name, Choice::Coarse(e), dt);
        }
    }
    runs
}

/// Most particles outside at any time of a box that rests for 0.3 s and is then thrown up and down
/// with `acceleration` (m/s^2) of either sign, up to `speed` (m/s).
fn outside<L: ContactLaw>(law: L, dt: f64, acceleration: f64, speed: f64, steps: u64) -> f64 {
    let quarter = speed / acceleration;
    let slam = move |t: f64| {
        let since = t - 0.3;
        if since <= 0.0 {
            return Motion::default();
        }
        let phase = since.rem_euclid(4.0 * quarter);
        // Up with +a for a quarter, -a for two, +a for the last.
        let middle = phase - 2.0 * quarter;
        let (position, velocity) = if phase < quarter {
            (0.5 * acceleration * phase * phase, acceleration * phase)
        } else if phase < 3.0 * quarter {
            let top = acceleration * quarter * quarter;
            (
                top - 0.5 * acceleration * middle * middle,
                -acceleration * middle,
            )
        } else {
            let left = 4.0 * quarter - phase;
            (0.5 * acceleration * left * left, -acceleration * left)
        };
        Motion::at(DVec3::Y * position, DVec3::Y * velocity)
    };
    let mut damper = Damper::builder(Slot::paper(), law)
        .mount(Prescribed(slam))
        .particles(bed())
        .time_step(dt)
        .contained(false)
        .overlap_limit(f64::INFINITY)
        .build()
        .unwrap();
    let mut most = 0;
    for step in 0..steps {
        damper.step().unwrap();
        if step % 20 == 0 {
            most = most.max(damper.outside());
        }
    }
    most as f64
}

fn slammed(form: Form) -> Vec<Case> {
    let mut cases = Vec::new();
    let (coarse_steps, strict_steps) = match form {
        Form::Short => (20_000, 40_000),
        Form::Long => (1_700_000, 1_700_000),
    };
    for (times, speed) in [(10.0, 1.0), (50.0, 1.0), (50.0, 2.0)] {
        let acceleration = times * 9.81;
        let fastest = 2.0 * speed;
        let coarse = || {
            let law = RestitutionImpulse::new(Material::acrylic());
            law.reference_speed(fastest).unwrap()
        };
        let strict = || {
            HertzTsuji::new(Material::acrylic())
                .reference_speed(fastest)
                .unwrap()
        };
        let mut check = |name: String, steps: u64, got| {
            let name = format!(
                "box at {times} g up to {speed} m/s, {name}, {} particle steps: outside",
                60 * steps
            );
            cases.push(Case::bounded(name, SLAM, 0.0, got));
        };
        let dt = longest(coarse());
        let got = outside(coarse(), dt, acceleration, speed, coarse_steps);
        check(
            format!("RestitutionImpulse, dt {dt:.2e} s"),
            coarse_steps,
            got,
        );
        let got = outside(coarse(), 5e-5, acceleration, speed, coarse_steps);
        check("RestitutionImpulse, dt 5e-5 s".into(), coarse_steps, got);
        let dt = longest(strict());
        let got = outside(strict(), dt, acceleration, speed, strict_steps);
        check(format!("HertzTsuji, dt {dt:.2e} s"), strict_steps, got);
    }
    cases
}

/// Largest energy (kinetic and of height) of a bed that starts in motion, over the energy at the
/// start, and the kinetic energy left after a second.
fn energies<L: ContactLaw>(law: L, dt: f64, spin: f64) -> [f64; 2] {
    let mut particles = bed();
    for (n, particle) in particles.iter_mut().enumerate() {
        let angle = 2.399_963 * n as f64;
        particle.velocity = 0.5 * dvec3(angle.cos(), angle.sin(), 0.0);
        particle.spin = DVec3::Z * spin * (2.0 * angle).sin();
    }
    let mut damper = Damper::builder(Slot::paper(), law)
        .particles(particles)
        .time_step(dt)
        .build()
        .unwrap();
    let energy = |bodies: Vec<Particle>| -> f64 {
        let all = bodies
            .iter()
            .map(|body| body.kinetic_energy() + body.mass * 9.81 * body.position.y);
        all.sum()
    };
    let start = energy(damper.particles().collect());
    let kinetic = damper.kinetic_energy();
    let mut most = 0.0_f64;
    while damper.time() < 1.0 {
        for _ in 0..4 {
            damper.step().unwrap();
        }
        most = most.max(energy(damper.particles().collect()));
    }
    [most / start, damper.kinetic_energy() / kinetic]
}

fn left_alone() -> Vec<Case> {
    let mut cases = Vec::new();
    // Without friction nothing would end the spin.
    for (e, mu, spin) in [(0.75, 0.2, 200.0), (0.9, 1.0, 200.0), (0.3, 0.0, 0.0)] {
        let strict = || HertzTsuji::new(acrylic(e, mu));
        let spring = || HertzMindlin::new(acrylic(e, mu));
        let coarse = || RestitutionImpulse::new(acrylic(e, mu));
        for (law, [most, left]) in [
            ("HertzTsuji", energies(strict(), longest(strict()), spin)),
            ("HertzMindlin", energies(spring(), longest(spring()), spin)),
            (
                "RestitutionImpulse",
                energies(coarse(), longest(coarse()), spin),
            ),
        ] {
            let name = |what| {
                format!("shaken bed of 60 left alone, e {e}, mu {mu}, {law}, longest step: {what}")
            };
            cases.push(Case::bounded(
                name("greatest energy / first"),
                ALONE,
                1.0 + 1e-9,
                most,
            ));
            cases.push(Case::bounded(
                name("kinetic energy after 1 s / first"),
                ALONE,
                0.02,
                left,
            ));
        }
    }
    cases
}
