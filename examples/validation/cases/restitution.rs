//! Restitution at coarse steps: its mean over the phase of first touch, and its spread about it.
//!
//! What is left at a number of steps to a contact depends on that number, on the restitution asked for
//! and on the form of damping, hardly on the bodies: a wall, an equal pair and a pair of unlike masses
//! are compared because the effective mass enters the method.

use particle_damper::glam::DVec3;
use particle_damper::mount::SingleDof;
use particle_damper::{
    Body, ContactLaw, Cuboid, Damper, Damping, Ending, HertzMindlin, HertzTsuji, Integrator,
    Materials, Particle, RungeKutta4, VelocityVerlet,
};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::{acrylic, collide, hertz_constant, hertz_duration, paper_particle};

/// Phases of first touch over which means are taken: of 32 and of 64 the means differ by less than
/// 0.05 % of the restitution at six steps to a contact.
const PHASES: u32 = 32;

const ASKED_FOR: &str = "restitution asked for";

const CLAUSIUS: &str = "kinetic energy after minus before, over before: never above zero";

const SMALL_STEP: &str = "the same with 3000 steps to a contact";

/// Restitutions that bounds hold for.
pub(crate) const ASKED: [f64; 5] = [0.3, 0.5, 0.75, 0.9, 0.95];

/// What meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Bodies {
    /// The paper's particle and a wall.
    Wall,
    /// Two of the paper's particles.
    Equal,
    /// One and a tenth of its radius.
    Unequal,
}

/// How far restitution is off.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Deviation {
    /// Mean over the phase of first touch, less what was asked.
    pub(crate) mean: f64,
    /// The farthest from what was asked.
    pub(crate) farthest: f64,
    /// Root mean square over the phase.
    pub(crate) rms: f64,
}

impl Deviation {
    fn of(errors: impl Iterator<Item = f64>) -> Self {
        let (mut sum, mut squares, mut count, mut farthest) = (0.0, 0.0, 0.0, 0.0_f64);
        for error in errors {
            sum += error;
            squares += error * error;
            count += 1.0;
            farthest = farthest.max(error.abs());
        }
        Self {
            mean: sum / count,
            farthest,
            rms: f64::sqrt(squares / count),
        }
    }

    /// The larger deviations of both.
    #[must_use]
    pub(crate) fn or_larger(self, other: Self) -> Self {
        let mean = if self.mean.abs() < other.mean.abs() {
            other.mean
        } else {
            self.mean
        };
        Self {
            mean,
            farthest: self.farthest.max(other.farthest),
            rms: self.rms.max(other.rms),
        }
    }
}

/// The longest step that a builder accepts for particles of the first material in a box of it.
fn longest_step<L: ContactLaw>(law: &L, particles: &[Particle]) -> f64 {
    let sphere = |own: &Particle| Body::sphere(own.radius, own.mass, Materials::FIRST);
    let others = || {
        particles
            .iter()
            .map(sphere)
            .chain([Body::wall(Materials::FIRST)])
    };
    let pairs = particles.iter().map(sphere);
    let pairs = pairs.flat_map(|first| others().map(move |second| (first, second)));
    let steps = pairs.map(|(first, second)| {
        let own = law.coefficients(&particle_damper::Bodies::new(first, second));
        own.map_or(0.0, |own| law.time_step_limit(&own))
    });
    steps.fold(f64::INFINITY, f64::min)
}

/// Deviation of impacts at 1 m/s from `asked`, with `steps` to an elastic contact; none if the law
/// refuses so long a step.
pub(crate) fn deviation<L: ContactLaw + Clone, I: Integrator>(
    law: &L,
    integrator: impl Fn() -> I,
    bodies: Bodies,
    asked: f64,
    steps: f64,
) -> Option<Deviation> {
    let first = paper_particle();
    let second = match bodies {
        Bodies::Wall => None,
        Bodies::Equal => Some(first),
        Bodies::Unequal => Particle::new(0.1 * first.radius, 1e-3 * first.mass).ok(),
    };
    let other = second.map_or(f64::INFINITY, |body| body.radius);
    let k = hertz_constant((first.radius, 0.4e9, 0.3), (other, 0.4e9, 0.3));
    let mass = 1.0 / (1.0 / first.mass + second.map_or(0.0, |body| 1.0 / body.mass));
    let dt = hertz_duration(k, mass, 1.0) / steps;
    let mut placed = vec![first.moving(DVec3::NEG_Y)];
    placed.extend(second);
    if dt > longest_step(law, &placed) {
        return None;
    }
    Some(Deviation::of((0..PHASES).map(|phase| {
        let gap = dt * (f64::from(phase) + 0.37) / f64::from(PHASES);
        let impact = collide(
            law.clone(),
            Materials::FIRST,
            integrator(),
            dt,
            gap,
            &placed,
        );
        let other = impact.bodies.get(1).map_or(0.0, |body| body.velocity.y);
        impact.bodies[0].velocity.y - other - asked
    })))
}

/// The larger deviations of both strict laws, where they bear the step.
pub(crate) fn of_both_laws<I: Integrator>(
    integrator: impl Fn() -> I + Copy,
    (damping, ending): (Damping, Ending),
    bodies: Bodies,
    asked: f64,
    steps: f64,
) -> Option<Deviation> {
    let material = acrylic(asked, 0.2);
    let tsuji = HertzTsuji::new(material).damping(damping).ending(ending);
    let mindlin = HertzMindlin::new(material).damping(damping).ending(ending);
    let both = [
        deviation(&tsuji, integrator, bodies, asked, steps),
        deviation(&mindlin, integrator, bodies, asked, steps),
    ];
    both.into_iter().flatten().reduce(Deviation::or_larger)
}

/// Both forms of damping with both ends of contact.
pub(crate) const FORMS: [(Damping, Ending); 4] = [
    (Damping::Viscoelastic, Ending::NeverPulling),
    (Damping::Viscoelastic, Ending::PullingAllowed),
    (Damping::Tsuji, Ending::NeverPulling),
    (Damping::Tsuji, Ending::PullingAllowed),
];

/// Mean and farthest restitution at coarse steps.
fn coarse() -> Vec<Case> {
    let mut cases = Vec::new();
    // Of the mean as a fraction of what was asked, of the farthest as a number.
    for (steps, [mean, farthest]) in [(4.5, [0.015, 0.06]), (6.0, [0.007, 0.03])] {
        for form in FORMS {
            for bodies in [Bodies::Wall, Bodies::Equal, Bodies::Unequal] {
                for asked in ASKED {
                    let verlet = || VelocityVerlet;
                    let Some(found) = of_both_laws(verlet, form, bodies, asked, steps) else {
                        continue;
                    };
                    let (damping, ending) = form;
                    // Weak dashpots that are cut off leave a sixth of that.
                    let weak = ending == Ending::NeverPulling && asked >= 0.75;
                    let farthest = if weak { farthest / 6.0 } else { farthest };
                    let name = |what| {
                        format!(
                            "{damping:?}, {ending:?}, {bodies:?}, {steps} steps, e {asked}: {what}"
                        )
                    };
                    cases.push(Case::new(
                        name("mean over phases"),
                        ASKED_FOR,
                        asked,
                        asked + found.mean,
                        Tolerance::Relative(mean),
                    ));
                    cases.push(Case::bounded(
                        name("farthest"),
                        ASKED_FOR,
                        farthest,
                        found.farthest,
                    ));
                }
            }
        }
    }
    cases
}

/// Speeds of `count` of the paper's particles in a row, of which the first meets the others, that touch,
/// at 1 m/s with so many steps to a contact, in a phase of the step; the last touches the wall behind or
/// not.
fn row<L: ContactLaw + Clone, I: Integrator>(
    law: &L,
    integrator: I,
    count: usize,
    at_wall: bool,
    [steps, phase]: [f64; 2],
) -> Vec<f64> {
    let ball = paper_particle();
    let side = 0.2;
    let k = hertz_constant((ball.radius, 0.4e9, 0.3), (ball.radius, 0.4e9, 0.3));
    let dt = hertz_duration(k, 0.5 * ball.mass, 1.0) / steps;
    let foot = if at_wall { ball.radius } else { 0.5 * side };
    let row = (0..count).map(|n| {
        let height = foot + 2.0 * ball.radius * n as f64;
        let placed = ball.at(DVec3::new(0.5 * side, height, 0.5 * side));
        if n + 1 == count {
            let gap = phase * dt * DVec3::Y;
            placed.at(placed.position + gap).moving(DVec3::NEG_Y)
        } else {
            placed
        }
    });
    let mut damper = Damper::builder(Cuboid::new(DVec3::splat(side)).unwrap(), law.clone())
        .gravity(DVec3::ZERO)
        .integrator(integrator)
        .particles(row)
        .time_step(dt)
        .build()
        .unwrap();
    while damper.time() < 2e-3 {
        damper.step().unwrap();
    }
    damper.particles().map(|ball| ball.velocity.y).collect()
}

/// Order of the velocities after impacts of which each has several contacts, and how far they are off at
/// six steps to a contact.
fn several() -> Vec<Case> {
    let mut cases = Vec::new();
    for (damping, e) in [(Damping::Viscoelastic, 0.75), (Damping::Tsuji, 0.5)] {
        let law = HertzTsuji::new(acrylic(e, 0.2)).damping(damping);
        for (what, count, at_wall) in [
            ("one meets two", 3, false),
            ("one meets four", 5, false),
            ("one meets one at a wall", 2, true),
        ] {
            let exact = row(&law, RungeKutta4::default(), count, at_wall, [3000.0, 0.5]);
            let error = |steps| {
                let phases = (0..8).map(|n| (f64::from(n) + 0.37) / 8.0);
                let errors = phases.map(|phase| {
                    let found = row(&law, VelocityVerlet, count, at_wall, [steps, phase]);
                    let errors = found.iter().zip(&exact).map(|(a, b)| (a - b).abs());
                    errors.fold(0.0, f64::max)
                });
                errors.fold(0.0, f64::max)
            };
            let order = (error(12.0) / error(96.0)).ln() / 8.0_f64.ln();
            let name = |quantity| format!("{damping:?}, e {e}, {what}: {quantity}");
            cases.push(Case::bounded(
                name("minus the order"),
                SMALL_STEP,
                -1.75,
                -order,
            ));
            cases.push(Case::bounded(
                name("farthest velocity at six steps to a contact (m/s)"),
                SMALL_STEP,
                0.02,
                error(6.0),
            ));
        }
    }
    cases
}

/// Masses of a ball over that of the box that it meets.
const MASS_RATIOS: [f64; 5] = [0.01, 0.1, 0.3, 1.0, 10.0];

/// Deviation of impacts of a ball at 1 m/s on the floor of a box that is free to move, with `steps` to a
/// contact of their effective mass.
fn on_free_box<L: ContactLaw + Clone>(law: &L, ratio: f64, asked: f64, steps: f64) -> Deviation {
    let ball = paper_particle();
    let mass = ball.mass / ratio;
    let k = hertz_constant((ball.radius, 0.4e9, 0.3), (f64::INFINITY, 0.4e9, 0.3));
    let effective = 1.0 / (1.0 / ball.mass + 1.0 / mass);
    let dt = hertz_duration(k, effective, 1.0) / steps;
    Deviation::of((0..PHASES).map(|phase| {
        let gap = dt * (f64::from(phase) + 0.37) / f64::from(PHASES);
        let foot = DVec3::new(0.1, ball.radius + gap, 0.1);
        let mut damper = Damper::builder(Cuboid::new(DVec3::splat(0.2)).unwrap(), law.clone())
            .gravity(DVec3::ZERO)
            .mount(SingleDof::new(mass, 0.0, 0.0).unwrap())
            .particles([ball.at(foot).moving(DVec3::NEG_Y)])
            .time_step(dt)
            .build()
            .unwrap();
        for _ in 0..(2.0 * steps) as u32 {
            damper.step().unwrap();
        }
        damper.particle(0).unwrap().velocity.y - damper.rates()[0] - asked
    }))
}

/// Gain of energy, over what there was, in an oblique impact of a ball on such a box, with the
/// longest step that the builder accepts.
fn gain_on_free_box<L: ContactLaw + Clone>(law: &L, ratio: f64, phase: f64) -> f64 {
    let ball = paper_particle();
    let mass = ball.mass / ratio;
    let make = |dt: f64| {
        let foot = DVec3::new(0.1, ball.radius + phase * dt, 0.1);
        let thrown = ball.at(foot).moving(DVec3::new(0.8, -1.0, 0.0));
        let axis = DVec3::new(0.3, 1.0, 0.0);
        Damper::builder(Cuboid::new(DVec3::splat(0.2)).unwrap(), law.clone())
            .gravity(DVec3::ZERO)
            .mount(SingleDof::new(mass, 0.0, 0.0).unwrap().along(axis).unwrap())
            .particles([thrown])
    };
    // Half of the longest by default.
    let dt = 2.0 * make(0.0).build().unwrap().time_step();
    let mut damper = make(dt).time_step(dt).build().unwrap();
    let energy = |damper: &Damper<_, _, SingleDof, _, _>| {
        damper.kinetic_energy() + 0.5 * mass * damper.rates()[0].powi(2)
    };
    let before = energy(&damper);
    for _ in 0..200 {
        damper.step().unwrap();
    }
    energy(&damper) / before - 1.0
}

/// The largest of these gains over the phase of the step.
fn largest_gain<L: ContactLaw + Clone>(law: &L, ratio: f64) -> f64 {
    let gains = (0..8).map(|n| gain_on_free_box(law, ratio, f64::from(n) / 8.0));
    gains.fold(f64::NEG_INFINITY, f64::max)
}

/// One ball and one box.
fn free_box() -> Vec<Case> {
    let mut cases = Vec::new();
    for (damping, asked) in [(Damping::Viscoelastic, 0.6), (Damping::Tsuji, 0.6)] {
        let law = HertzTsuji::new(acrylic(asked, 0.2)).damping(damping);
        for ratio in MASS_RATIOS {
            for e in [0.3, 0.75, 0.99] {
                let law = HertzTsuji::new(acrylic(e, 0.0)).damping(damping);
                cases.push(Case::bounded(
                    format!("{damping:?}, ball {ratio} of the box, e {e}: gain of energy"),
                    CLAUSIUS,
                    0.0,
                    largest_gain(&law, ratio),
                ));
                let law = HertzMindlin::new(acrylic(e, 0.5)).damping(damping);
                cases.push(Case::bounded(
                    format!("{damping:?}, ball {ratio} of the box, e {e}, tangential spring: gain"),
                    CLAUSIUS,
                    0.0,
                    largest_gain(&law, ratio),
                ));
            }
            for (steps, mean) in [(6.0, 0.007), (100.0, 5e-4)] {
                let found = on_free_box(&law, ratio, asked, steps);
                cases.push(Case::new(
                    format!("{damping:?}, ball {ratio} of the box, {steps} steps, e {asked}: mean"),
                    ASKED_FOR,
                    asked,
                    asked + found.mean,
                    Tolerance::Relative(mean),
                ));
                cases.push(Case::bounded(
                    format!(
                        "{damping:?}, ball {ratio} of the box, {steps} steps, e {asked}: farthest"
                    ),
                    ASKED_FOR,
                    if steps > 6.0 { 1e-3 } else { 0.03 },
                    found.farthest,
                ));
            }
        }
    }
    cases
}

pub(crate) fn cases(_: Form) -> Vec<Case> {
    let mut cases = coarse();
    cases.extend(several());
    cases.extend(free_box());
    cases
}
