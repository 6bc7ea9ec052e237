//! Defects seen in other tools, each as a case that must not show them.

use particle_damper::excitation::Harmonic;
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::mount::SingleDof;
use particle_damper::{
    AllPairs, BuildError, CellGrid, ContactLaw, Damper, Detector, Filling, HertzMindlin,
    HertzTsuji, Integrator, Interaction, LinkedCells, Material, Particle, RestitutionImpulse,
    RungeKutta4, Skin, Slot, VelocityVerlet,
};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::{acrylic, hertz_constant, hertz_duration, paper_particle};

const ELASTIC: &str = "conservation of energy: 1000 bounces of an elastic ball";
const MOMENTUM: &str = "conservation of momentum: container and particles without a spring";
const REFUSED: &str = "what cannot be is refused when a damper is built";
const WEIGHT: &str = "mean force on the floor is the weight, downwards";
const BITS: &str = "every detector, run and restart gives the same bits";

pub(crate) fn cases(_: Form) -> Vec<Case> {
    let mut cases = bounces();
    cases.extend(momentum());
    cases.extend(floor_force());
    cases.extend(bits());
    cases.extend(refusals());
    cases.extend(edges());
    cases
}

/// Largest relative change of the apex height over 1000 bounces.
fn bouncing<L: ContactLaw>(law: L, dt: f64, drop: f64) -> f64 {
    let ball = paper_particle();
    let mut damper = Damper::builder(Slot::paper(), law)
        .detector(AllPairs)
        .particles([ball.at(dvec3(0.03, ball.radius + drop, 0.0))])
        .time_step(dt)
        .build()
        .unwrap();
    let (mut bounces, mut worst) = (0, 0.0_f64);
    let mut before = damper.particle(0).unwrap();
    while bounces < 1000 {
        damper.step().unwrap();
        let now = damper.particle(0).unwrap();
        if before.velocity.y > 0.0 && now.velocity.y <= 0.0 {
            let height = now.position.y - ball.radius + now.velocity.y.powi(2) / (2.0 * 9.81);
            worst = worst.max((height / drop - 1.0).abs());
            bounces += 1;
        }
        before = now;
    }
    worst
}

fn bounces() -> Vec<Case> {
    let drop = 2e-4;
    let speed = f64::sqrt(2.0 * 9.81 * drop);
    let k = hertz_constant((3e-3, 0.4e9, 0.3), (f64::INFINITY, 0.4e9, 0.3));
    let dt = hertz_duration(k, 0.2e-3, speed) / 100.0;
    [
        (
            "HertzTsuji",
            bouncing(HertzTsuji::new(acrylic(1.0, 0.2)), dt, drop),
        ),
        (
            "HertzMindlin",
            bouncing(HertzMindlin::new(acrylic(1.0, 0.2)), dt, drop),
        ),
        (
            "RestitutionImpulse, 1e-4 s",
            bouncing(RestitutionImpulse::new(acrylic(1.0, 0.2)), 1e-4, 0.05),
        ),
    ]
    .map(|(law, drift)| {
        Case::bounded(
            format!("elastic ball, {law}: drift of energy"),
            ELASTIC,
            1e-4,
            drift,
        )
    })
    .into()
}

/// Largest change of momentum along the axis of a free container, over that of the particles.
fn momentum_drift<L: ContactLaw, I: Integrator>(law: L, integrator: I, dt: f64) -> f64 {
    let mount = SingleDof::new(0.086, 0.0, 0.0).unwrap();
    let mut bed = Filling::new(5)
        .with(40, paper_particle())
        .fill(&Slot::paper())
        .unwrap();
    for (n, particle) in bed.iter_mut().enumerate() {
        particle.velocity = 0.5 * dvec3((n as f64).cos(), (n as f64).sin(), 0.0);
    }
    let mut damper = Damper::builder(Slot::paper(), law)
        .mount(mount.released_from(0.0, 0.3).unwrap())
        .integrator(integrator)
        .gravity(DVec3::ZERO)
        .particles(bed)
        .time_step(dt)
        .build()
        .unwrap();
    let start = damper.momentum().y + 0.086 * damper.rates()[0];
    let mut worst = 0.0_f64;
    for _ in 0..20_000 {
        damper.step().unwrap();
        let now = damper.momentum().y + 0.086 * damper.rates()[0];
        worst = worst.max((now - start).abs());
    }
    worst / (40.0 * 0.2e-3 * 0.5)
}

fn momentum() -> Vec<Case> {
    let strict = HertzTsuji::new(Material::acrylic());
    let coarse = RestitutionImpulse::new(Material::acrylic());
    [
        (
            "HertzTsuji, VelocityVerlet",
            momentum_drift(strict.clone(), VelocityVerlet, 2e-5),
        ),
        (
            "HertzTsuji, RungeKutta4",
            momentum_drift(strict.clone(), RungeKutta4::default(), 2e-5),
        ),
        (
            "RestitutionImpulse, VelocityVerlet",
            momentum_drift(coarse.clone(), VelocityVerlet, 1e-4),
        ),
        (
            "RestitutionImpulse, longest step",
            momentum_drift(coarse.clone(), VelocityVerlet, 6e-4),
        ),
    ]
    .map(|(parts, drift)| {
        Case::bounded(
            format!("container and 40 particles, {parts}: drift"),
            MOMENTUM,
            1e-11,
            drift,
        )
    })
    .into()
}

/// Mean force (N) along y of a bed of 30 that has come to rest: on the floor without friction, on the
/// container with it, because side walls then carry a part of the bed (Janssen).
fn mean_force<L: ContactLaw>(law: L, mu: f64, time_step: f64) -> f64 {
    let bed = Filling::new(2)
        .with(30, paper_particle())
        .fill(&Slot::paper())
        .unwrap();
    let mut damper = Damper::builder(Slot::paper(), law)
        .particles(bed)
        .time_step(time_step)
        .build()
        .unwrap();
    let settled = (2.0 / time_step).round() as u32;
    let average = 5000;
    let mut force = 0.0;
    for step in 0..settled + average {
        damper.step().unwrap();
        if step >= settled {
            force += if mu > 0.0 {
                damper.reaction(0).unwrap().force.y
            } else {
                damper.wall_load(0, 2).unwrap().force.y
            };
        }
    }
    force / f64::from(average)
}

fn floor_force() -> Vec<Case> {
    let mut cases = Vec::new();
    let run = |strict: bool, mu: f64| {
        let material = acrylic(0.75, mu);
        if strict {
            mean_force(HertzTsuji::new(material), mu, 2e-5)
        } else {
            mean_force(RestitutionImpulse::new(material), mu, 1e-4)
        }
    };
    for (law, strict) in [("HertzTsuji", true), ("RestitutionImpulse", false)] {
        let weight = -30.0 * 0.2e-3 * 9.81;
        for (mu, what) in [
            (0.0, "floor, no friction"),
            (0.2, "container, friction 0.2"),
        ] {
            let name = format!("bed of 30, {law}: force on the {what} (N)");
            let got = run(strict, mu);
            cases.push(Case::new(
                name,
                WEIGHT,
                weight,
                got,
                Tolerance::Relative(1e-3),
            ));
        }
    }
    cases
}

/// The bed of a driven oscillator after 0.2 s, restored halfway if `again`.
fn shaken<D: Detector + Clone>(detector: D, again: bool) -> Vec<Particle> {
    let bed = Filling::new(4)
        .with(60, paper_particle())
        .fill(&Slot::paper())
        .unwrap();
    let law = HertzMindlin::new(Material::acrylic());
    let mut damper = Damper::builder(Slot::paper(), law)
        .mount(SingleDof::paper().excited_by(Harmonic::new(0.25, 6.0).unwrap()))
        .detector(detector)
        .particles(bed)
        .time_step(2e-5)
        .build()
        .unwrap();
    for _ in 0..5000 {
        damper.step().unwrap();
    }
    if again {
        let halfway = damper.snapshot();
        for _ in 0..777 {
            damper.step().unwrap();
        }
        damper.restore(&halfway).unwrap();
    }
    for _ in 0..5000 {
        damper.step().unwrap();
    }
    damper.particles().collect()
}

fn bits() -> Vec<Case> {
    let one = shaken(AllPairs, false);
    let differ = |other: &[Particle]| one.iter().zip(other).filter(|(a, b)| a != b).count() as f64;
    [
        ("run again", differ(&shaken(AllPairs, false))),
        ("restored halfway", differ(&shaken(AllPairs, true))),
        (
            "linked cells",
            differ(&shaken(LinkedCells::default(), false)),
        ),
        (
            "linked cells with a skin",
            differ(&shaken(Skin::<LinkedCells>::default(), true)),
        ),
        (
            "grid 32 x 20",
            differ(&shaken(CellGrid::new(20, 32).unwrap(), false)),
        ),
        (
            "grid 64 x 40",
            differ(&shaken(CellGrid::new(40, 64).unwrap(), false)),
        ),
        (
            "grid 5 x 3",
            differ(&shaken(CellGrid::new(3, 5).unwrap(), false)),
        ),
    ]
    .map(|(what, count)| Case::bounded(format!("{what}: particles that differ"), BITS, 0.0, count))
    .into()
}

/// Whether a thing went as it should, as a number: zero if so.
fn unless(holds: bool) -> f64 {
    f64::from(u8::from(!holds))
}

fn refusals() -> Vec<Case> {
    let ball = paper_particle().at(dvec3(0.03, 0.05, 0.0));
    let build = |dt: f64, gravity: DVec3, particles: Vec<Particle>| {
        Damper::builder(Slot::paper(), HertzTsuji::new(Material::acrylic()))
            .gravity(gravity)
            .particles(particles)
            .time_step(dt)
            .build()
    };
    let down = DVec3::NEG_Y * 9.81;
    let late = build(1e-3, down, vec![ball]);
    let names_limit = match &late {
        Err(error @ BuildError::TimeStepTooLong { limit, .. }) => {
            error.to_string().contains(&limit.to_string())
        }
        _ => false,
    };
    let same = vec![ball, ball];
    let outside = ball.at(dvec3(0.03, -0.01, 0.0));
    let crowd = Filling::new(1)
        .with(500, paper_particle())
        .fill(&Slot::paper());
    [
        ("a step too long is refused with its limit", names_limit),
        ("a negative step", build(-1e-5, down, vec![ball]).is_err()),
        (
            "gravity that is no number",
            build(1e-5, DVec3::NAN, vec![ball]).is_err(),
        ),
        ("coincident centres", build(1e-5, down, same).is_err()),
        (
            "a particle outside",
            build(1e-5, down, vec![outside]).is_err(),
        ),
        ("restitution 1.2", Interaction::new(1.2, 0.2).is_err()),
        ("friction -0.1", Interaction::new(0.5, -0.1).is_err()),
        ("a radius of zero", Particle::new(0.0, 1.0).is_err()),
        (
            "a mass that is no number",
            Particle::new(1.0, f64::NAN).is_err(),
        ),
        ("more particles than fit", crowd.is_err()),
    ]
    .map(|(what, holds)| Case::bounded(what, REFUSED, 0.0, unless(holds)))
    .into()
}

/// Extremes that must stay finite.
fn edges() -> Vec<Case> {
    let ball = paper_particle();
    let heap = |count: usize| {
        Filling::new(6)
            .with(count, ball)
            .fill(&Slot::paper())
            .unwrap()
    };
    let mut coincident = heap(5);
    coincident[1].position = coincident[0].position;
    let finite = |e: f64, mu: f64, bed: Vec<Particle>, overlap: f64| {
        let short = if e < 1.0 { 1e-5 } else { 2e-6 };
        let mut strict = Damper::builder(Slot::paper(), HertzMindlin::new(acrylic(e.max(0.1), mu)))
            .particles(bed.clone())
            .initial_overlap(overlap)
            .overlap_limit(f64::INFINITY)
            .contained(false)
            .time_step(short)
            .build()
            .unwrap();
        let mut coarse = Damper::builder(Slot::paper(), RestitutionImpulse::new(acrylic(e, mu)))
            .particles(bed)
            .initial_overlap(overlap)
            .overlap_limit(f64::INFINITY)
            .contained(false)
            .time_step(1e-4)
            .build()
            .unwrap();
        for _ in 0..2000 {
            strict.step().unwrap();
            coarse.step().unwrap();
        }
        let all = strict.particles().chain(coarse.particles());
        all.fold(0.0, |bad, body| {
            bad + unless(
                body.position.is_finite() && body.velocity.is_finite() && body.spin.is_finite(),
            )
        })
    };
    [
        ("coincident centres", finite(0.75, 0.2, coincident, 3.0)),
        ("no particle", finite(0.75, 0.2, Vec::new(), 0.05)),
        ("one particle", finite(0.75, 0.2, heap(1), 0.05)),
        ("e 0", finite(0.0, 0.2, heap(40), 0.05)),
        ("e 1: no damping", finite(1.0, 0.2, heap(40), 0.05)),
        ("mu 0", finite(0.75, 0.0, heap(40), 0.05)),
    ]
    .map(|(what, count)| {
        Case::bounded(
            format!("{what}: numbers that are not finite"),
            REFUSED,
            0.0,
            count,
        )
    })
    .into()
}
