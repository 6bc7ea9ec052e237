//! A completely inelastic mass: on a shaken floor under gravity, and between the walls of a shaken
//! box without it (collect and collide).

use std::f64::consts::{PI, TAU};

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::mount::{Motion, Prescribed};
use particle_damper::{AllPairs, Damper, RestitutionImpulse, Slot};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::{acrylic, paper_particle};

const FLOOR: &str = "completely inelastic bouncing ball, event by event; Mehta & Luck 1990, doi 10.1103/PhysRevLett.65.393";
const COLLECT: &str = "Bannerman et al. 2011, doi 10.1103/PhysRevE.84.011301";
const G: f64 = 9.81;
const FREQUENCY: f64 = 10.0;

/// Per cycle of the floor, in units of m, A and w.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cycle {
    /// Energy lost over m A^2 w^2.
    pub(crate) loss: f64,
    /// In-phase first harmonic of the floor force over m A w^2.
    pub(crate) apparent_mass: f64,
    /// Part of the cycle in flight.
    pub(crate) flight: f64,
}

/// The mass on z = A sin phi with G = A w^2/g, by the law of free flight; up to G = sqrt(4 + pi^2),
/// where flights of two periods begin.
pub(crate) fn on_floor(g: f64) -> Cycle {
    if g <= 1.0 {
        return Cycle {
            loss: 0.0,
            apparent_mass: 1.0,
            flight: 0.0,
        };
    }
    // Heights in A, phases in rad, speeds in A w: gravity is 1/G.
    let (start, flight) = if g < (1.0 + PI * PI).sqrt() {
        let start = (1.0 / g).asin();
        let gap = |s: f64| start.sin() + start.cos() * s - s * s / (2.0 * g) - (start + s).sin();
        let (mut low, mut high) = (0.05_f64, 0.05);
        while gap(high) > 0.0 {
            low = high;
            high += 1e-3;
        }
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if gap(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        (start, low)
    } else {
        // Flights of a whole period, one after the other.
        ((PI / g).acos(), TAU)
    };
    let speed = start.cos() - flight / g - (start + flight).cos();
    // In phase with the floor's acceleration -A w^2 sin phi.
    let impulse = -speed.abs() * -(start + flight).sin();
    let rest = TAU - flight;
    let (samples, mut contact) = (200_000, 0.0);
    for n in 0..samples {
        let phase = start + flight + (f64::from(n) + 0.5) * rest / f64::from(samples);
        contact += (1.0 / g - phase.sin()) * -phase.sin() * rest / f64::from(samples);
    }
    Cycle {
        loss: 0.5 * speed * speed,
        apparent_mass: (contact - impulse) / PI,
        flight: flight / TAU,
    }
}

/// The same by the crate, averaged over ten cycles after sixty.
pub(crate) fn on_floor_by_crate(g: f64, steps: u32) -> Cycle {
    let omega = TAU * FREQUENCY;
    let amplitude = g * G / (omega * omega);
    let shake = move |t: f64| {
        let (sine, cosine) = (omega * t).sin_cos();
        Motion::at(
            DVec3::Y * amplitude * sine,
            DVec3::Y * amplitude * omega * cosine,
        )
    };
    let ball = paper_particle();
    let law = RestitutionImpulse::new(acrylic(0.0, 0.0))
        .reference_speed(3.0)
        .unwrap();
    let mut damper = Damper::builder(Slot::new(0.06, 0.6).unwrap(), law)
        .detector(AllPairs)
        .mount(Prescribed(shake))
        .gravity(DVec3::NEG_Y * G)
        .particles([ball.at(dvec3(0.03, ball.radius, 0.0))])
        .time_step(1.0 / (FREQUENCY * f64::from(steps)))
        .build()
        .unwrap();
    // Near flights of two periods the start is slow to be forgotten.
    for _ in 0..60 * steps {
        damper.step().unwrap();
    }
    let (mut work, mut harmonic, mut before) = (0.0, 0.0, damper.time());
    let (mut flying, mut longest) = (0_u32, 0);
    for _ in 0..10 * steps {
        damper.step().unwrap();
        let impulse = -damper.reaction(0).unwrap().impulse.y;
        let phase = omega * 0.5 * (before + damper.time());
        work += impulse * amplitude * omega * phase.cos();
        harmonic += impulse * -phase.sin();
        flying = if impulse > 0.0 { 0 } else { flying + 1 };
        longest = longest.max(flying);
        before = damper.time();
    }
    let scale = ball.mass * amplitude * omega;
    Cycle {
        loss: work / (10.0 * scale * amplitude * omega),
        apparent_mass: harmonic / (10.0 * PI * scale),
        // A mass at rest that landed a little early is struck in some steps and not in others: flight
        // is the longest time without a force.
        flight: f64::from(longest.min(steps)) / f64::from(steps),
    }
}

/// Loss per cycle over m A^2 w^2 of a clear gap L = `ratio` A: tau - sin tau = L/A, (1 - cos tau)^2.
pub(crate) fn collect(ratio: f64) -> f64 {
    let (mut low, mut high) = (0.0_f64, PI);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if middle - middle.sin() < ratio {
            low = middle;
        } else {
            high = middle;
        }
    }
    (1.0 - low.cos()).powi(2)
}

/// The same by the crate, averaged over ten cycles after ten.
pub(crate) fn collect_by_crate(ratio: f64, steps: u32) -> f64 {
    let omega = TAU * FREQUENCY;
    let amplitude = 0.01;
    let shake = move |t: f64| {
        let (sine, cosine) = (omega * t).sin_cos();
        Motion::at(
            DVec3::X * amplitude * sine,
            DVec3::X * amplitude * omega * cosine,
        )
    };
    let ball = paper_particle();
    let law = RestitutionImpulse::new(acrylic(0.0, 0.0))
        .reference_speed(3.0)
        .unwrap();
    let width = ratio * amplitude + 2.0 * ball.radius;
    let start = dvec3(ball.radius, 2.0 * ball.radius, 0.0);
    let mut damper = Damper::builder(Slot::new(width, 4.0 * ball.radius).unwrap(), law)
        .detector(AllPairs)
        .mount(Prescribed(shake))
        .gravity(DVec3::ZERO)
        .particles([ball.at(start).moving(DVec3::X * amplitude * omega)])
        .time_step(1.0 / (FREQUENCY * f64::from(steps)))
        .build()
        .unwrap();
    let (mut work, mut before) = (0.0, 0.0);
    for step in 0..20 * steps {
        damper.step().unwrap();
        let impulse = -damper.reaction(0).unwrap().impulse.x;
        let phase = omega * 0.5 * (before + damper.time());
        if step >= 10 * steps {
            work += impulse * amplitude * omega * phase.cos();
        }
        before = damper.time();
    }
    work / (10.0 * ball.mass * (amplitude * omega).powi(2))
}

pub(crate) fn cases(form: Form) -> Vec<Case> {
    let mut cases = Vec::new();
    let (steps, close) = match form {
        Form::Short => (10_000, Tolerance::Absolute(2e-3)),
        Form::Long => (100_000, Tolerance::Absolute(2e-4)),
    };
    for g in [0.5, 0.99, 1.2, 1.5, 2.0, 2.5, 3.0, 3.25, 3.4, 3.6] {
        let expected = on_floor(g);
        let got = on_floor_by_crate(g, steps);
        let mut check = |what: &str, expected, got| {
            let name = format!("inelastic mass on a floor, G {g}: {what}");
            cases.push(Case::new(name, FLOOR, expected, got, close));
        };
        check("loss per cycle / (m A^2 w^2)", expected.loss, got.loss);
        check(
            "apparent mass / m",
            expected.apparent_mass,
            got.apparent_mass,
        );
        check("part of the cycle in flight", expected.flight, got.flight);
    }
    let printed = Tolerance::Absolute(5e-6);
    let two = on_floor(2.0);
    cases.push(Case::new(
        "G 2, printed row: loss",
        FLOOR,
        1.836_18,
        two.loss,
        printed,
    ));
    cases.push(Case::new(
        "G 2, printed row: apparent mass",
        FLOOR,
        0.734_91,
        two.apparent_mass,
        printed,
    ));
    let first = on_floor((1.0 + PI * PI).sqrt() - 1e-9);
    cases.push(Case::new(
        "first full-period flight at sqrt(1 + pi^2)",
        FLOOR,
        1.0,
        first.flight,
        Tolerance::Absolute(1e-4),
    ));
    for ratio in [0.2, 0.5, 1.0, 2.0, 3.0, PI] {
        let name = format!("collect and collide, L/A {ratio:.4}: loss / (m A^2 w^2)");
        let got = collect_by_crate(ratio, steps);
        cases.push(Case::new(name, COLLECT, collect(ratio), got, close));
    }
    cases
}
