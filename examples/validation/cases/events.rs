//! When impacts happen: one impact damper, a chain of twenty, and the free decay that one makes.

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    AllPairs, ContactLaw, Damper, Damping, HertzTsuji, Load, Motion, Mount, Particle,
    RestitutionImpulse, SingleDof, Slot,
};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::material;

const PIECEWISE: &str = "exact solutions between impacts";
const CHAIN: &str = "Zhang et al., SMART 2025, recomputed exactly";

const RADIUS: f64 = 0.1;
/// A contact has ended when nothing has been felt for so long, s.
const APART: f64 = 1e-3;

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

/// A contact at 1 m/s lasts for 0.18 ms at 4e10 Pa, and goes with the modulus to the power -2/5.
fn strict(e: f64, modulus: f64) -> HertzTsuji {
    HertzTsuji::new(material(modulus, 0.3, e, 0.0)).damping(Damping::Tsuji)
}

/// The first `count` impacts under the strict law. Each contact sends the ball on its way later by as long as it
/// lasts; that is taken out by a second run with a tenth of the stiffness.
fn by_forces<M: Mount + Copy>(
    form: Form,
    e: f64,
    mount: M,
    balls: &dyn Fn() -> Vec<Particle>,
    count: usize,
) -> Vec<(f64, usize)> {
    let (modulus, time_step) = match form {
        // At 50 steps to a contact restitution is off by 1e-4, and the second impact, which comes 10 s later
        // per unit of it, by 1e-3: three times as many.
        _ if e < 1.0 => (4e10, 1.2e-6),
        Form::Short => (4e10, 3.5e-6),
        Form::Long => (4e11, 1.4e-6),
    };
    let softer = 10.0_f64.powf(0.4);
    let hard = impacts(strict(e, modulus), mount, balls(), time_step, count);
    let (law, time_step) = (strict(e, 0.1 * modulus), softer * time_step);
    let soft = impacts(law, mount, balls(), time_step, count);
    let at_once = |(hard, soft): (&(f64, usize), &(f64, usize))| {
        let time = hard.0 + (hard.0 - soft.0) / (softer - 1.0);
        (if hard.1 == soft.1 { time } else { f64::NAN }, hard.1)
    };
    hard.iter().zip(&soft).map(at_once).collect()
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
    let mut touching = vec![None; cavities];
    while events.len() < count && damper.time() < 50.0 {
        let from = damper.time();
        damper.step().unwrap();
        for (number, (old, ball)) in before.iter_mut().zip(damper.particles()).enumerate() {
            // Balls fly freely between contacts, which last for some steps under a force law.
            let change = ball.velocity.x - *old;
            *old = ball.velocity.x;
            if change.abs() > 1e-9 {
                touching[number].get_or_insert((from, damper.time())).1 = damper.time();
            } else if let Some((begin, end)) = touching[number]
                && from > end + APART
            {
                events.push((0.5 * (begin + end), number));
                touching[number] = None;
            }
        }
    }
    events.sort_by(|one, other| one.0.total_cmp(&other.0));
    events
}

/// M = K = 1, a ball of 0.3 that starts in the middle with speed -1, travel 2. In the short form the strict law
/// makes the first two impacts.
fn one(form: Form, e: f64, times: &[f64], cases: &mut Vec<Case>) {
    let mount = SingleDof::new(1.0, 0.0, 1.0)
        .unwrap()
        .along(DVec3::X)
        .unwrap();
    let balls = || vec![ball(0.3, 0, 1.0, -1.0)];
    let time_step = if form == Form::Short { 1e-4 } else { 1e-5 };
    let count = times.len();
    let by_impulses = impacts(coarse(e), mount, balls(), time_step, count);
    let count = if form == Form::Short { 2 } else { count };
    let by_forces = by_forces(form, e, mount, &balls, count);
    for (law, events, count) in [
        ("coarse law", by_impulses, times.len()),
        ("strict law", by_forces, count),
    ] {
        for (n, expected) in times[..count].iter().enumerate() {
            cases.push(Case::new(
                format!("one impact damper, e {e}, {law}: impact {} (s)", n + 1),
                PIECEWISE,
                *expected,
                events.get(n).map_or(f64::NAN, |event| event.0),
                Tolerance::Absolute(1e-3),
            ));
        }
    }
}

/// Twenty unit masses in a row, coupled by unit springs, with a cavity on each; the first has speed -1.
#[derive(Clone, Copy)]
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
    let balls = || (0..20).map(|n| ball(0.3, n, 1.0, 0.0)).collect();
    let time_step = if form == Form::Short { 5e-5 } else { 1e-5 };
    let by_impulses = impacts(coarse(1.0), Chain, balls(), time_step, expected.len());
    let count = if form == Form::Short { 2 } else { 7 };
    let by_forces = by_forces(form, 1.0, Chain, &balls, count);
    for (law, events, count) in [
        ("coarse law", by_impulses, expected.len()),
        ("strict law", by_forces, count),
    ] {
        for (n, (time, mass)) in expected.into_iter().take(count).enumerate() {
            let found = events.get(n).copied().unwrap_or((f64::NAN, usize::MAX - 1));
            let name = format!("chain of 20, {law}: impact {} (s)", n + 1);
            cases.push(Case::new(
                name,
                CHAIN,
                time,
                found.0,
                Tolerance::Absolute(1e-3),
            ));
            let name = format!("chain of 20, {law}: mass of impact {}", n + 1);
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
}

/// Released at x = 1 with a ball of 0.1 at rest by the wall on the -x side, travel 0.5.
fn decay<L: ContactLaw>(name: &str, law: L, time_step: f64, cases: &mut Vec<Case>) {
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
            format!("free decay with an impact damper, {name}: peak {}", n + 1),
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
    decay("coarse law", coarse(0.6), 5e-4, &mut cases);
    let (modulus, time_step) = match form {
        Form::Short => (4e8, 2e-5),
        Form::Long => (4e10, 3e-6),
    };
    let law = strict(0.6, modulus);
    decay("strict law", law, time_step, &mut cases);
    cases
}
