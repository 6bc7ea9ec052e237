//! A block that does not rebound between the floor and the lid of a shaken box, under gravity: flight by
//! flight.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use particle_damper::fields::{Cell, Point};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{AllPairs, EffectiveFields, RestitutionImpulse, Slot};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::{acrylic, paper_particle};

const SOURCE: &str = "inelastic block between floor and lid, integrated flight by flight";
const FREQUENCY: f64 = 10.0;
const G: f64 = 9.81;

/// What the block does between two events, lengths in A and times in 1/w; gravity is 1/G.
#[derive(Debug, Clone, Copy)]
enum Motion {
    /// On the floor (false) or the lid (true).
    Resting(bool),
    /// From a height and with a speed, at a phase.
    Flying { from: f64, speed: f64, since: f64 },
}

/// Sums over cycles.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    loss: f64,
    /// Force in phase with the acceleration.
    harmonic: f64,
}

/// Loss per cycle over m A^2 w^2 and apparent mass over m at G = A w^2/g and the clear height D A: the mean of
/// 20 cycles after 60, on a fine grid of phases; events within a step are found by halving it.
pub(crate) fn exact(g: f64, d: f64) -> [f64; 2] {
    let (per_cycle, cycles) = (20_000, 80);
    let step = TAU / f64::from(per_cycle);
    let mut motion = Motion::Resting(false);
    let mut sums = Sums::default();
    for n in 0..per_cycle * cycles {
        if n == per_cycle * 60 {
            sums = Sums::default();
        }
        let end = f64::from(n + 1) * step;
        let mut phase = f64::from(n) * step;
        // A few events at the most in a step.
        while phase < end {
            (motion, phase) = advance(motion, phase, end, g, d, &mut sums);
        }
    }
    [sums.loss / 20.0, sums.harmonic / (20.0 * PI)]
}

/// Goes on from a phase to an event or to the end.
fn advance(motion: Motion, phase: f64, end: f64, g: f64, d: f64, sums: &mut Sums) -> (Motion, f64) {
    match motion {
        Motion::Resting(lid) => {
            // Force of the wall on the block: its weight and its acceleration.
            let force = |phase: f64| 1.0 / g - phase.sin();
            let pressed = |phase: f64| (force(phase) >= 0.0) != lid;
            let until = if pressed(end) {
                end
            } else {
                halve(phase, end, &|p| !pressed(p))
            };
            let middle = 0.5 * (phase + until);
            sums.harmonic -= force(middle) * middle.sin() * (until - phase);
            if until < end {
                let flying = Motion::Flying {
                    from: until.sin() + if lid { d } else { 0.0 },
                    speed: until.cos(),
                    since: until,
                };
                return (flying, until.max(phase + 1e-12));
            }
            (motion, end)
        }
        Motion::Flying { from, speed, since } => {
            let height = |phase: f64| {
                let t = phase - since;
                from + speed * t - 0.5 * t * t / g - phase.sin()
            };
            let out = |phase: f64| height(phase) < 0.0 || height(phase) > d;
            if !out(end) {
                return (motion, end);
            }
            let hit = halve(phase, end, &out);
            let lid = height(hit) > 0.5 * d;
            let change = hit.cos() - (speed - (hit - since) / g);
            sums.loss += 0.5 * change * change;
            sums.harmonic -= change * hit.sin();
            (Motion::Resting(lid), hit)
        }
    }
}

/// The first phase at which something is so, between one at which it may not be and one at which it is.
fn halve(from: f64, to: f64, is_so: &dyn Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (from, to);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if is_so(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

fn by_crate(g: f64, d: f64, steps: u32) -> Cell {
    let omega = TAU * FREQUENCY;
    let amplitude = g * G / (omega * omega);
    let ball = paper_particle();
    let slot = Slot::new(0.06, 2.0 * ball.radius + d * amplitude).unwrap();
    let speed = omega * amplitude;
    let law = RestitutionImpulse::new(acrylic(0.0, 0.0));
    let fields = EffectiveFields::new(law.reference_speed(3.0).unwrap(), slot)
        .detector(AllPairs)
        .placed([ball
            .at(dvec3(0.03, ball.radius, 0.0))
            .moving(DVec3::Y * speed)])
        .time_step(1.0 / (FREQUENCY * f64::from(steps)))
        .periods(40, 20);
    let point = Point {
        amplitude,
        frequency: FREQUENCY,
        seed: 1,
    };
    let measurement = fields.measure(point, |_| ControlFlow::Continue(()));
    Cell::pooled(&[measurement.unwrap()]).unwrap()
}

pub(crate) fn cases(form: Form) -> Vec<Case> {
    let (steps, part) = match form {
        Form::Short => (5000, 0.005),
        Form::Long => (50_000, 0.001),
    };
    let printed = [
        (2.0, 0.5, [0.720_468, 1.094_631]),
        (5.0, 1.0, [1.781_690, 1.074_870]),
        (10.0, 2.0, [3.312_961, 0.684_976]),
    ];
    let mut cases = Vec::new();
    for (g, d, rows) in printed {
        for (what, (row, got)) in ["loss", "apparent mass"]
            .into_iter()
            .zip(rows.into_iter().zip(exact(g, d)))
        {
            let name = format!("G {g}, D {d}, printed row: {what}");
            cases.push(Case::new(name, SOURCE, row, got, Tolerance::Absolute(2e-5)));
        }
    }
    for (g, d) in [
        (1.5, 0.2),
        (2.0, 0.5),
        (3.0, 0.5),
        (5.0, 1.0),
        (8.0, 1.5),
        (10.0, 2.0),
    ] {
        let [loss, mass] = exact(g, d);
        let cell = by_crate(g, d, steps);
        let scale = cell.bed_mass * (cell.angular_frequency() * cell.amplitude).powi(2);
        let mut check = |what: &str, expected: f64, got: f64| {
            let name = format!("block between floor and lid, G {g}, D {d}: {what}");
            let close = Tolerance::Absolute(part * expected.max(1.0));
            cases.push(Case::new(name, SOURCE, expected, got, close));
        };
        check(
            "loss by the wall force",
            loss,
            cell.energy_per_cycle.value / scale,
        );
        check(
            "loss by the contacts",
            loss,
            cell.contact_loss.value / scale,
        );
        check(
            "apparent mass",
            mass,
            cell.apparent_mass.value / cell.bed_mass,
        );
    }
    cases
}
