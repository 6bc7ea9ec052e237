//! One body in a box, or on a floor, that is moved to and fro: energy per cycle and apparent mass by closed
//! forms, through effective fields.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use particle_damper::fields::{Cell, Point};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    AllPairs, Bodies, Body, ContactLaw, Damping, EffectiveFields, ElasticImpact, HertzMindlin,
    HertzTsuji, Materials, Particle, RestitutionImpulse, Slot,
};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::{acrylic, material};

const BALL: &str = "one ball, two impacts per cycle: closed form";
const COLLECT: &str = "Bannerman et al. 2011, doi 10.1103/PhysRevE.84.011301";
const ROLLING: &str = "sphere on a shaken floor under Coulomb friction, closed form";

const FREQUENCY: f64 = 10.0;
const AMPLITUDE: f64 = 0.01;
/// A w in m/s.
const SPEED: f64 = TAU * FREQUENCY * AMPLITUDE;
const GRAVITY: f64 = 9.81;

/// A motion that repeats itself every cycle, in units of A and w.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TwoImpacts {
    /// Phase of the impact on the wall at the high end.
    pub(crate) phase: f64,
    /// Speed between impacts over A w.
    pub(crate) speed: f64,
    /// Energy per cycle over m A^2 w^2.
    pub(crate) loss: f64,
    /// Apparent mass over m.
    pub(crate) mass: f64,
}

/// One ball of restitution `e` in a box of clear travel `d` = D A that moves by A sin wt.
pub(crate) fn two_impacts(e: f64, d: f64) -> TwoImpacts {
    let c = (1.0 - e) / (1.0 + e);
    let r = (1.0 + (2.0 * c / PI).powi(2)).sqrt();
    let phase = (2.0 * c / PI).atan() + (-c * d / (PI * r)).acos();
    let sine = phase.sin();
    let speed = (d + 2.0 * sine) / PI;
    TwoImpacts {
        phase,
        speed,
        loss: 4.0 * c * speed * speed,
        mass: 4.0 / PI * speed * sine,
    }
}

/// The travels D between which the motion is stable.
pub(crate) fn stable(e: f64) -> [f64; 2] {
    let c = (1.0 - e) / (1.0 + e);
    let lowest = (PI - 4.0 / PI) / (c * c + 4.0 / (PI * PI)).sqrt();
    [lowest, (PI * PI / (c * c) + 4.0).sqrt()]
}

/// Energy per cycle and apparent mass of a body that does not rebound, in a box of clear travel D <= pi.
pub(crate) fn collect(d: f64) -> [f64; 2] {
    let (mut low, mut high) = (0.0_f64, PI);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if middle - middle.sin() < d {
            low = middle;
        } else {
            high = middle;
        }
    }
    let (sine, cosine) = low.sin_cos();
    let mass = (1.0 - cosine) * sine + 0.5 * (PI - low) + 0.25 * (2.0 * low).sin();
    [(1.0 - cosine).powi(2), 2.0 / PI * mass]
}

/// The cell of a bed in a slot that moves along x.
fn cell<L: ContactLaw + Clone>(
    law: L,
    slot: Slot,
    gravity: f64,
    particle: Particle,
    (steps, periods): (u32, [u32; 2]),
) -> Cell {
    let fields = EffectiveFields::new(law, slot)
        .detector(AllPairs)
        .along(DVec3::X)
        .gravity(DVec3::NEG_Y * gravity)
        .placed([particle])
        .time_step(1.0 / (FREQUENCY * f64::from(steps)))
        .periods(periods[0], periods[1]);
    let point = Point {
        amplitude: AMPLITUDE,
        frequency: FREQUENCY,
        seed: 1,
    };
    let measurement = fields.measure(point, |_| ControlFlow::Continue(()));
    Cell::pooled(&[measurement.unwrap()]).unwrap()
}

/// Energy per cycle by the walls and by the contacts, over m A^2 w^2, and apparent mass over m.
fn numbers(cell: &Cell) -> [f64; 3] {
    let scale = cell.bed_mass * SPEED * SPEED;
    [
        cell.energy_per_cycle.value / scale,
        cell.contact_loss.value / scale,
        cell.apparent_mass.value / cell.bed_mass,
    ]
}

fn compare(
    cases: &mut Vec<Case>,
    name: &str,
    source: &'static str,
    [loss, mass]: [f64; 2],
    cell: &Cell,
    part: f64,
) {
    let [by_walls, by_contacts, got] = numbers(cell);
    // Where a number passes zero its size is that of the loss.
    let size = loss.max(0.1);
    for (what, expected, got) in [
        ("loss by the wall force", loss, by_walls),
        ("loss by the contacts", loss, by_contacts),
    ] {
        let close = Tolerance::Absolute(part * size);
        cases.push(Case::new(
            format!("{name}: {what}"),
            source,
            expected,
            got,
            close,
        ));
    }
    let close = Tolerance::Absolute(part * mass.abs().max(0.5 * size));
    cases.push(Case::new(
        format!("{name}: apparent mass"),
        source,
        mass,
        got,
        close,
    ));
}

/// The ball on its orbit in a slot, at the time zero.
fn on_orbit(motion: &TwoImpacts, d: f64, radius: f64) -> (Slot, Particle) {
    let travel = d * AMPLITUDE;
    let slot = Slot::new(travel + 2.0 * radius, 4.0 * radius).unwrap();
    let offset = AMPLITUDE * (motion.phase.sin() - motion.speed * motion.phase);
    let ball = Particle::new(radius, 2e-3)
        .unwrap()
        .at(dvec3(radius + travel + offset, 2.0 * radius, 0.0))
        .moving(DVec3::X * motion.speed * SPEED);
    (slot, ball)
}

fn two_impact_cases(cases: &mut Vec<Case>, form: Form) {
    let steps = match form {
        Form::Short => 2000,
        Form::Long => 20_000,
    };
    for e in [0.3, 0.5, 0.7, 0.9] {
        let [low, high] = stable(e);
        let best = PI * (1.0 + e) / (1.0 - e);
        let within = [0.1, 0.35, 0.6].map(|part| low + part * (high - low));
        for d in within.into_iter().chain([best, 5.0]) {
            if !(low..high).contains(&d) {
                continue;
            }
            let motion = two_impacts(e, d);
            let (slot, ball) = on_orbit(&motion, d, 0.01);
            let reference = 2.0 * SPEED * (motion.speed + 1.0);
            let coarse = RestitutionImpulse::new(acrylic(e, 0.0));
            let coarse = coarse.reference_speed(reference).unwrap();
            let name = format!("one ball, e {e}, D {d:.3}, coarse law");
            let run = cell(coarse, slot, 0.0, ball, (steps, [20, 20]));
            let expected = [motion.loss, motion.mass];
            compare(cases, &name, BALL, expected, &run, 0.01);
            let hits: f64 = run.impacts[..2].iter().sum();
            let exactly = Tolerance::Absolute(1e-9);
            cases.push(Case::new(
                format!("{name}: impacts"),
                BALL,
                2.0,
                hits,
                exactly,
            ));
            if form == Form::Long || ((0.4..0.6).contains(&e) && d < 5.5) {
                let run = strictly(e, &motion, d);
                let name = format!("one ball, e {e}, D {d:.3}, strict law");
                compare(cases, &name, BALL, expected, &run, 0.02);
            }
        }
    }
    let printed = two_impacts(0.5, 5.0);
    let close = Tolerance::Absolute(5e-7);
    for (what, expected, got) in [
        ("loss", 5.632_319, printed.loss),
        ("apparent mass", 1.906_270, printed.mass),
    ] {
        let name = format!("e 0.5, D 5, printed row: {what}");
        cases.push(Case::new(name, BALL, expected, got, close));
    }
}

/// The same under Hertz's force with Tsuji's damping: 40 steps to a contact, which lasts a thousandth of a period with
/// a restitution of a half. (How long it lasts shifts the apparent mass by a part of the loss, which grows with
/// 1/(1 - e): at 0.9 a thousandth of a period by 3.6 %.)
fn strictly(e: f64, motion: &TwoImpacts, d: f64) -> Cell {
    let (radius, part) = (0.01, 2e-3 * (1.0 - e));
    let steps = (40.0 / part).round() as u32;
    let impact_speed = SPEED * (motion.speed - motion.phase.cos());
    let impact = ElasticImpact::lasting(part / FREQUENCY, 2e-3, impact_speed).unwrap();
    let soft = acrylic(e, 0.0).with_contact_stiffness(impact.stiffness(), radius);
    // A wall of the same material: its contact is as if of one sphere of twice the radius.
    let law = HertzTsuji::new(soft.unwrap())
        .damping(Damping::Tsuji)
        .reference_speed(impact_speed)
        .unwrap();
    let (slot, ball) = on_orbit(motion, d, radius);
    cell(law, slot, 0.0, ball, (steps, [10, 10]))
}

fn collect_cases(cases: &mut Vec<Case>, form: Form) {
    let (steps, part) = match form {
        Form::Short => (4000, 0.005),
        Form::Long => (40_000, 0.0005),
    };
    let radius = 3e-3;
    for d in [0.2, 0.5, 1.0, 2.0, 3.0, PI] {
        let slot = Slot::new(d * AMPLITUDE + 2.0 * radius, 4.0 * radius).unwrap();
        let ball = Particle::new(radius, 2e-4)
            .unwrap()
            .at(dvec3(radius, 2.0 * radius, 0.0))
            .moving(DVec3::X * SPEED);
        let law = RestitutionImpulse::new(acrylic(0.0, 0.0));
        let law = law.reference_speed(3.0).unwrap();
        let run = cell(law, slot, 0.0, ball, (steps, [10, 10]));
        let name = format!("collect and collide, D {d:.3}");
        compare(cases, &name, COLLECT, collect(d), &run, part);
    }
    let [_, mass] = collect(1.0);
    let close = Tolerance::Absolute(5e-7);
    cases.push(Case::new(
        "D 1, printed row: apparent mass",
        COLLECT,
        1.085_014,
        mass,
        close,
    ));
}

/// Energy per cycle over m A^2 w^2 and apparent mass over m, at beta = 3.5 mu g/(A w^2).
fn rolling(beta: f64) -> [f64; 2] {
    if beta >= 1.0 {
        return [0.0, 2.0 / 7.0];
    }
    let friction = beta / 3.5;
    let slip = (1.0 - (0.5 * PI * beta).powi(2)).sqrt();
    [4.0 * friction * slip, 4.0 / 7.0 * beta * beta]
}

/// How far (rad) friction lags behind the slip where a tangential spring has to be turned over, of a frequency
/// (in w) and a damping ratio, both of a sphere that slips: `slope` is the floor's acceleration (in A w^2)
/// there. It takes about 1/`frequency`, during which friction does not yet resist: the impulse that is missed,
/// over that of a reversal at once. What slips is borne by spring and dashpot together, and sticks as soon as
/// the slip is so slow that the spring gains less than the dashpot loses.
fn lag(beta: f64, slope: f64, frequency: f64, damping: f64) -> f64 {
    // Lengths in A, times in 1/w; `way` and `rate` of the slip since it sticks, towards the new side.
    let step = 1e-4 / frequency;
    let slowing = slope + beta;
    let begin = 2.0 * damping * slowing / frequency;
    let turned =
        |way: f64, rate: f64| frequency * (frequency * way + 2.0 * damping * (rate + begin));
    let (mut way, mut rate, mut time) = (0.0, -begin, 0.0);
    while turned(way, rate) < 2.0 * beta {
        let middle = rate + 0.5 * step * (slowing - turned(way, rate));
        rate += step * (slowing - turned(way + 0.5 * step * rate, middle));
        way += step * middle;
        time += step;
    }
    (rate - (slope - beta) * (time - begin / slowing)) / (2.0 * beta)
}

/// [`rolling`] of a sphere that slips all the time against a tangential spring: first order in the lag.
fn rolling_on_spring(beta: f64, frequency: f64, damping: f64) -> [f64; 2] {
    let friction = beta / 3.5;
    let mut late = 0.0;
    for _ in 0..20 {
        let change = (beta * (0.5 * PI - late)).acos();
        late = lag(beta, change.sin(), frequency, damping);
    }
    let (sine, cosine) = ((beta * (0.5 * PI - late)).acos() + late).sin_cos();
    [4.0 * friction * sine, 4.0 / PI * friction * cosine]
}

const SPHERE: f64 = 5e-3;
const SPHERE_MASS: f64 = 1e-3;

/// Frequency over w and damping ratio of the sphere's tangential oscillation on the floor, where 2/7 of its
/// mass moves.
fn tangential(law: &HertzMindlin, modulus: f64) -> (f64, f64) {
    let sphere = Body::sphere(SPHERE, SPHERE_MASS, Materials::FIRST);
    let bodies = Bodies::new(sphere, Body::wall(Materials::FIRST));
    let normal = law.normal_stiffness(&bodies).unwrap();
    let overlap = (SPHERE_MASS * GRAVITY / normal).powf(2.0 / 3.0);
    let shear = modulus / (2.0 * (1.0 + POISSON)) / (2.0 * (2.0 - POISSON));
    let stiffness = 8.0 * shear * (SPHERE * overlap).sqrt();
    let resistance = law.damping_coefficient(&bodies).unwrap() * overlap.sqrt();
    let moving = 2.0 / 7.0 * SPHERE_MASS;
    let damping = resistance / (2.0 * (stiffness * moving).sqrt());
    ((stiffness / moving).sqrt() / (TAU * FREQUENCY), damping)
}

const POISSON: f64 = 0.3;

fn rolling_cases(cases: &mut Vec<Case>, form: Form) {
    let betas: &[f64] = match form {
        Form::Short => &[1.5, 0.53, 0.45, 0.2],
        Form::Long => &[3.0, 1.5, 1.05, 0.53, 0.45, 0.3, 0.1],
    };
    for &beta in betas {
        let mu = beta * SPEED * TAU * FREQUENCY / (3.5 * GRAVITY);
        let slot = Slot::new(0.5, 0.05).unwrap();
        // Rolling on the floor as it is at the start.
        let sphere = Particle::new(SPHERE, SPHERE_MASS)
            .unwrap()
            .at(dvec3(0.25, SPHERE, 0.0))
            .moving(DVec3::X * (2.0 / 7.0 * SPEED))
            .spinning(DVec3::Z * (5.0 / 7.0 * SPEED / SPHERE));
        let mut check = |name: &str, expected, run: &Cell, part| {
            let name = format!("sphere on a shaken floor, beta {beta:.3}, {name}");
            compare(cases, &name, ROLLING, expected, run, part);
        };
        let rubbing = material(1e8, POISSON, 0.5, mu);
        let coarse = RestitutionImpulse::new(rubbing);
        let run = cell(coarse, slot, GRAVITY, sphere, (4000, [20, 10]));
        check("coarse law", rolling(beta), &run, 0.01);
        let strict = HertzTsuji::new(rubbing);
        let run = cell(strict, slot, GRAVITY, sphere, (10_000, [10, 10]));
        check("sliding friction", rolling(beta), &run, 0.02);
        // Stiffer by 100, the spring is quicker by 100^(1/3).
        let stiffer: &[(f64, u32)] = match form {
            Form::Short => &[(1e8, 10_000)],
            Form::Long => &[(1e8, 10_000), (1e10, 80_000)],
        };
        for &(modulus, steps) in stiffer {
            let sticking = HertzMindlin::new(material(modulus, POISSON, 0.5, mu));
            let expected = if beta < 1.0 {
                let (frequency, damping) = tangential(&sticking, modulus);
                rolling_on_spring(beta, frequency, damping)
            } else {
                rolling(beta)
            };
            let run = cell(sticking, slot, GRAVITY, sphere, (steps, [10, 10]));
            let name = format!("tangential spring, {modulus:e} Pa");
            check(&name, expected, &run, 1e-3);
        }
    }
    let [largest, _] = rolling(2.0_f64.sqrt() / PI);
    let name = "largest loss, 8/(7 pi), at A w^2 = 7.775 mu g";
    let close = Tolerance::Absolute(1e-12);
    cases.push(Case::new(name, ROLLING, 8.0 / (7.0 * PI), largest, close));
}

pub(crate) fn cases(form: Form) -> Vec<Case> {
    let mut cases = Vec::new();
    two_impact_cases(&mut cases, form);
    collect_cases(&mut cases, form);
    rolling_cases(&mut cases, form);
    cases
}
