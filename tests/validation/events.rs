//! When impacts happen: one impact damper, a chain of twenty, and the free decay that one makes.

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    AllPairs, ContactLaw, Damper, Load, Motion, Mount, Particle, RestitutionImpulse, SingleDof,
    Slot,
};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::material;

const PIECEWISE: &str = "exact solutions between impacts";
const CHAIN: &str = "Zhang et al., SMART 2025, recomputed exactly";

const RADIUS: f64 = 0.1;

/// A box in which a ball of `RADIUS` has `travel` to go.
fn room(travel: f64) -> Slot {
    Slot::new(travel + 2.0 * RADIUS, 4.0 * RADIUS).unwrap()
}

/// A ball of mass `m` in cavity `cavity`, at `from` the wall on the -x side, with a speed along x.
fn ball(m: f64, cavity: u32, from: f64, speed: f64) -> Particle {
    let ball = Particle::new(RADIUS, m).unwrap().in_cavity(cavity);
    let mut ball = ball.at(dvec3(RADIUS + from, 2.0 * RADIUS, 0.0));
    ball.velocity = DVec3::X * speed;
    ball
}

fn coarse(e: f64) -> RestitutionImpulse {
    RestitutionImpulse::new(material(4e10, 0.3, e, 0.0))
}

/// Times at which the speed of a ball along x changes sign against its box or leaps, with the ball's number:
/// the first of `count`.
fn impacts<L: ContactLaw, M: Mount>(
    law: L,
    mount: M,
    balls: Vec<Particle>,
    time_step: f64,
    count: usize,
) -> Vec<(f64, usize)> {
    let cavities = balls.len();
    let mut builder = Damper::builder(room(2.0), law)
        .detector(AllPairs)
        .mount(mount)
        .gravity(DVec3::ZERO)
        .particles(balls)
        .time_step(time_step);
    for _ in 1..cavities {
        builder = builder.another_cavity(room(2.0));
    }
    let mut damper = builder.build().unwrap();
    let mut events: Vec<(f64, usize)> = Vec::new();
    let mut before: Vec<f64> = damper.particles().map(|ball| ball.velocity.x).collect();
    let mut begun = vec![None; cavities];
    while events.len() < count && damper.time() < 50.0 {
        let from = damper.time();
        damper.step().unwrap();
        let now: Vec<f64> = damper.particles().map(|ball| ball.velocity.x).collect();
        for (number, (old, new)) in before.iter().zip(&now).enumerate() {
            // Balls fly freely between contacts, which last for some steps under a force law.
            if (new - old).abs() > 1e-9 {
                begun[number].get_or_insert(from);
            } else if let Some(begin) = begun[number].take() {
                events.push((0.5 * (begin + from), number));
            }
        }
        before = now;
    }
    events.sort_by(|one, other| one.0.total_cmp(&other.0));
    events
}

/// M = K = 1, a ball of 0.3 that starts in the middle with speed -1, travel 2.
fn one(form: Form, e: f64, times: &[f64], cases: &mut Vec<Case>) {
    let mount = SingleDof::new(1.0, 0.0, 1.0)
        .unwrap()
        .along(DVec3::X)
        .unwrap();
    let balls = vec![ball(0.3, 0, 1.0, -1.0)];
    let time_step = if form == Form::Short { 1e-4 } else { 1e-5 };
    let events = impacts(coarse(e), mount, balls, time_step, times.len());
    for (n, expected) in times.iter().enumerate() {
        cases.push(Case::new(
            format!("one impact damper, e {e}: impact {} (s)", n + 1),
            PIECEWISE,
            *expected,
            events.get(n).map_or(f64::NAN, |event| event.0),
            Tolerance::Absolute(1e-3),
        ));
    }
}

/// Twenty unit masses in a row, coupled by unit springs, with a cavity on each; the first has speed -1.
struct Chain;

impl Mount for Chain {
    fn degrees(&self) -> usize {
        20
    }

    fn start(&self, _x: &mut [f64], v: &mut [f64]) {
        v[0] = -1.0;
    }

    fn motion(&self, _time: f64, x: &[f64], v: &[f64], cavity: usize) -> Motion {
        Motion::at(DVec3::X * x[cavity], DVec3::X * v[cavity])
    }

    fn accelerate(&self, _time: f64, x: &[f64], _v: &[f64], loads: &[Load], a: &mut [f64]) {
        for (n, rate) in a.iter_mut().enumerate() {
            *rate = loads[n].force.x;
            if n > 0 {
                *rate += x[n - 1] - x[n];
            }
            if let Some(next) = x.get(n + 1) {
                *rate += next - x[n];
            }
        }
    }

    fn highest_frequency(&self) -> f64 {
        2.0 / std::f64::consts::TAU
    }
}

fn chain(form: Form, cases: &mut Vec<Case>) {
    let expected = [
        (1.328_742, 1),
        (2.586_410, 2),
        (3.845_948, 3),
        (4.663_724, 1),
        (5.144_684, 4),
        (6.609_890, 2),
        (9.514_651, 1),
    ];
    let balls = (0..20).map(|n| ball(0.3, n, 1.0, 0.0)).collect();
    let time_step = if form == Form::Short { 5e-5 } else { 1e-5 };
    let events = impacts(coarse(1.0), Chain, balls, time_step, expected.len());
    for (n, (time, mass)) in expected.into_iter().enumerate() {
        let found = events.get(n).copied().unwrap_or((f64::NAN, usize::MAX - 1));
        let name = format!("chain of 20: impact {} (s)", n + 1);
        cases.push(Case::new(
            name,
            CHAIN,
            time,
            found.0,
            Tolerance::Absolute(1e-3),
        ));
        let name = format!("chain of 20: mass of impact {}", n + 1);
        let number = (found.1 + 1) as f64;
        cases.push(Case::new(
            name,
            CHAIN,
            f64::from(mass),
            number,
            Tolerance::Absolute(0.0),
        ));
    }
}

/// Released at x = 1 with a ball of 0.1 at rest by the wall on the -x side, travel 0.5.
fn decay<L: ContactLaw>(law: L, time_step: f64, cases: &mut Vec<Case>) {
    let mount = SingleDof::new(1.0, 0.0, 1.0)
        .unwrap()
        .along(DVec3::X)
        .unwrap();
    let mount = mount.released_from(1.0, 0.0).unwrap();
    let mut damper = Damper::builder(room(0.5), law)
        .detector(AllPairs)
        .mount(mount)
        .gravity(DVec3::ZERO)
        .particles([ball(0.1, 0, 1e-9, 0.0)])
        .time_step(time_step)
        .build()
        .unwrap();
    let mut peaks = Vec::new();
    let mut before = (damper.coordinates()[0], damper.rates()[0]);
    while peaks.len() < 5 && damper.time() < 100.0 {
        damper.step().unwrap();
        let now = (damper.coordinates()[0], damper.rates()[0]);
        if before.1 > 0.0 && now.1 <= 0.0 {
            peaks.push(now.0.max(before.0));
        }
        before = now;
    }
    for (n, expected) in [0.93089, 0.88357, 0.82909, 0.78112, 0.72761]
        .into_iter()
        .enumerate()
    {
        cases.push(Case::new(
            format!("free decay with an impact damper: peak {}", n + 1),
            PIECEWISE,
            expected,
            peaks.get(n).copied().unwrap_or(f64::NAN),
            Tolerance::Relative(0.01),
        ));
    }
}

pub(crate) fn cases(form: Form) -> Vec<Case> {
    let elastic = [
        1.0, 5.561_718, 7.505_486, 10.603_458, 12.795_727, 19.690_920,
    ];
    let lossy = [1.0, 6.749_451, 10.430_632, 15.433_835];
    let mut cases = Vec::new();
    one(form, 1.0, &elastic, &mut cases);
    one(form, 0.8, &lossy, &mut cases);
    chain(form, &mut cases);
    decay(coarse(0.6), 5e-4, &mut cases);
    cases
}
