//! No law creates energy: single impacts of every kind, and several contacts at once.

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    AllPairs, BuildError, Builder, ContactLaw, Cuboid, Damper, Driven, EnergyLedger, Filling,
    HertzMindlin, HertzTsuji, Integrator, Particle, RestitutionImpulse, RungeKutta4, Slot,
    VelocityVerlet,
};

use super::Form;
use super::case::Case;
use super::oblique::Law;
use super::setup::{acrylic, paper_particle};

const CLAUSIUS: &str = "kinetic energy after minus before, over before: never above zero";

/// An impact at random: every number in its range.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Throw {
    /// Relative speed in m/s, at most 1.
    pub(crate) speed: f64,
    /// Angle from the normal in degrees.
    pub(crate) degrees: f64,
    pub(crate) restitution: f64,
    pub(crate) friction: f64,
    /// Surface speeds of the spins over the relative speed, about z.
    pub(crate) spins: [f64; 2],
    /// Mass of the second body over the first's.
    pub(crate) ratio: f64,
    /// Time step as a part of the longest that the law accepts.
    pub(crate) part: f64,
    /// Part of a step from first touch.
    pub(crate) phase: f64,
}

/// What a thrown particle meets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Target {
    Wall,
    /// Particles that touch one another in a row across the line of impact.
    Particles(usize),
    /// As many in a line along it.
    Line(usize),
}

/// Builds with `part` of the longest step that the law accepts.
fn with_part<L: ContactLaw + Clone, I: Integrator>(
    make: impl Fn() -> Builder<Cuboid, L, Driven, AllPairs, I>,
    part: f64,
) -> Damper<Cuboid, L, Driven, AllPairs, I> {
    let limit = match make().time_step(1e9).build() {
        Err(BuildError::TimeStepTooLong { limit, .. }) => limit,
        other => panic!("a step of 1e9 s is too long: {:?}", other.err()),
    };
    make().time_step(part * limit).build().unwrap()
}

/// Gain of kinetic energy, over what there was, in an impact.
fn gain_under<L: ContactLaw + Clone, I: Integrator + Clone>(
    law: &L,
    integrator: I,
    throw: &Throw,
    target: Target,
) -> f64 {
    let first = paper_particle();
    let radius = first.radius * throw.ratio.cbrt();
    let side = 60.0 * first.radius.max(radius);
    let centre = DVec3::splat(0.5 * side);
    let (sine, cosine) = throw.degrees.to_radians().sin_cos();
    let velocity = throw.speed * dvec3(sine, -cosine, 0.0);
    let spin = |n: usize, radius: f64| DVec3::Z * (throw.spins[n] * throw.speed / radius);
    let first = first.moving(velocity).spinning(spin(0, first.radius));
    let place = |dt: f64| {
        let gap = throw.phase * throw.speed * cosine * dt;
        let mut bodies = Vec::new();
        match target {
            Target::Wall => {
                let height = first.radius + gap;
                bodies.push(first.at(dvec3(centre.x, height, centre.z)));
            }
            Target::Line(count) => {
                let other = Particle::new(radius, first.mass * throw.ratio).unwrap();
                let other = other.spinning(spin(1, radius));
                bodies.push(first.at(centre + DVec3::Y * (first.radius + radius + gap)));
                for n in 0..count {
                    let down = 2.0 * radius * n as f64 * (1.0 + 1e-12);
                    bodies.push(other.at(centre - DVec3::Y * down));
                }
            }
            Target::Particles(count) => {
                // Neighbours along x touch; the thrown one comes down on the middle of the row.
                let other = Particle::new(radius, first.mass * throw.ratio).unwrap();
                let other = other.spinning(spin(1, radius));
                let reach = first.radius + radius;
                let (offset, rise) = match count {
                    1 => (0.0, reach),
                    2 => (-radius, (reach * reach - radius * radius).sqrt()),
                    _ => (-2.0 * radius, reach),
                };
                bodies.push(first.at(centre + DVec3::Y * (rise + gap)));
                for n in 0..count {
                    let along = offset + 2.0 * radius * n as f64 * (1.0 + 1e-12);
                    bodies.push(other.at(centre + DVec3::X * along));
                }
            }
        }
        bodies
    };
    let make = |dt: f64| {
        let integrator = &integrator;
        move || {
            Damper::builder(Cuboid::new(DVec3::splat(side)).unwrap(), law.clone())
                .detector(AllPairs)
                .integrator(integrator.clone())
                .gravity(DVec3::ZERO)
                .particles(place(dt))
        }
    };
    let step = with_part(make(0.0), throw.part).time_step();
    let mut damper = with_part(make(step), throw.part);
    let before = damper.kinetic_energy();
    let (mut touched, mut apart) = (false, 0);
    for _ in 0..20_000 {
        damper.step().unwrap();
        if damper.contacts() > 0 && damper.largest_overlap() > 0.0 {
            (touched, apart) = (true, 0);
        } else {
            apart += 1;
        }
        if (touched && apart > 3) || apart > 200 {
            break;
        }
    }
    damper.kinetic_energy() / before - 1.0
}

/// The larger gain of kinetic energy, over what there was, of both integrators in an impact under
/// `law`.
pub(crate) fn gain(law: Law, throw: &Throw, target: Target) -> f64 {
    let material = acrylic(throw.restitution, throw.friction);
    match law {
        Law::HertzTsuji => gain_of_both(&HertzTsuji::new(material), throw, target),
        Law::HertzMindlin => gain_of_both(&HertzMindlin::new(material), throw, target),
        Law::RestitutionImpulse => gain_of_both(&RestitutionImpulse::new(material), throw, target),
    }
}

fn gain_of_both<L: ContactLaw + Clone>(law: &L, throw: &Throw, target: Target) -> f64 {
    let verlet = gain_under(law, VelocityVerlet, throw, target);
    verlet.max(gain_under(law, RungeKutta4::default(), throw, target))
}

/// A number between 0 and 1: the Weyl sequence of dimension `axis`.
fn weyl(n: u32, axis: i32) -> f64 {
    // Powers of the generalised golden ratio in nine dimensions.
    (0.5 + f64::from(n) * 1.077_766_2_f64.powi(-axis)).fract()
}

/// Throw number `n` of an even sequence over all ranges.
pub(crate) fn throw(n: u32, restitution: [f64; 2], part: [f64; 2]) -> Throw {
    let between = |[low, high]: [f64; 2], axis| low + (high - low) * weyl(n, axis);
    Throw {
        speed: between([0.02, 1.0], 1),
        degrees: between([0.0, 89.0], 2),
        restitution: between(restitution, 3),
        // One in five without friction.
        friction: between([-0.25, 1.0], 4).max(0.0),
        spins: [between([-2.0, 2.0], 5), between([-2.0, 2.0], 6)],
        ratio: 10.0_f64.powf(between([-3.0, 3.0], 7)),
        part: between(part, 8),
        phase: between([0.0, 1.0], 9),
    }
}

/// What is left to integration where no damping takes energy. The strict laws take fifty steps at
/// least to a contact without damping, and allow n steps 4/n^3 of the energy. In a line of bodies,
/// which meet while other contacts accelerate them, the error comes to a tenth of that; an impact by
/// itself has none of lower order than n^(-7/2), with a coefficient under 0.1 as measured.
fn undamped(law: Law, target: Target) -> f64 {
    match (law, target) {
        (Law::RestitutionImpulse, _) => 1e-12,
        (_, Target::Line(_)) => 4.0 / 50.0_f64.powi(3),
        _ => 0.1 * 50.0_f64.powf(-3.5),
    }
}

/// How many windows of 20 ms a stirred pile is watched for.
const WINDOWS: usize = 100;

/// The energy of a stirred pile, over the kinetic energy that it had, once it is left alone: means over windows
/// of 20 ms, since what a contact holds between two steps is known but roughly.
fn pile<L: ContactLaw + Clone>(law: &L, seed: u64) -> [f64; WINDOWS] {
    let bed = Filling::new(seed).with(40, paper_particle());
    let stir = |(n, particle): (usize, Particle)| {
        let (sine, cosine) = (2.4 * n as f64).sin_cos();
        let velocity = dvec3(cosine, sine, 0.0) * 0.5;
        particle.moving(velocity).spinning(DVec3::Z * 100.0 * sine)
    };
    let bed: Vec<Particle> = bed
        .fill(&Slot::paper())
        .unwrap()
        .into_iter()
        .enumerate()
        .map(stir)
        .collect();
    let builder = || Damper::builder(Slot::paper(), law.clone()).particles(bed.clone());
    let limit = match builder().time_step(1e9).build() {
        Err(BuildError::TimeStepTooLong { limit, .. }) => limit,
        other => panic!("a step of 1e9 s is too long: {:?}", other.err()),
    };
    let mut damper = builder().time_step(limit).build().unwrap();
    let kinetic = damper.kinetic_energy();
    let window = (0.02 / limit) as u32;
    [(); WINDOWS].map(|()| {
        let mut ledger = EnergyLedger::new();
        let mut mean = 0.0;
        for _ in 0..window {
            damper.step_watched(&mut ledger).unwrap();
            mean += ledger.energies().total() / f64::from(window);
        }
        mean / kinetic
    })
}

/// The largest rise of the mean energy of three piles from one window to the next. (Of one pile it is up to
/// 2e-6 where grains are rough and friction has no memory: a wedge of them that gives way is a jump.)
fn rise<L: ContactLaw + Clone>(law: &L) -> f64 {
    let mut mean = [0.0; WINDOWS];
    for seed in [8, 9, 10] {
        for (mean, own) in mean.iter_mut().zip(pile(law, seed)) {
            *mean += own / 3.0;
        }
    }
    let rises = mean.windows(2).map(|pair| pair[1] - pair[0]);
    rises.fold(f64::NEG_INFINITY, f64::max)
}

fn piles() -> Vec<Case> {
    let mut cases = Vec::new();
    for (e, mu) in [(0.3, 0.2), (0.75, 0.0), (0.75, 0.2), (0.95, 1.0)] {
        let material = acrylic(e, mu);
        for (law, rise) in [
            ("HertzTsuji", rise(&HertzTsuji::new(material))),
            ("HertzMindlin", rise(&HertzMindlin::new(material))),
        ] {
            let name =
                format!("stirred piles left alone, {law}, e {e}, mu {mu}, longest step: rise");
            cases.push(Case::bounded(name, CLAUSIUS, 1e-6, rise));
        }
    }
    cases
}

pub(crate) fn cases(form: Form) -> Vec<Case> {
    let count = match form {
        Form::Short => 300,
        Form::Long => 10_000,
    };
    let mut cases = piles();
    for law in [Law::HertzTsuji, Law::HertzMindlin, Law::RestitutionImpulse] {
        for target in [
            Target::Wall,
            Target::Particles(1),
            Target::Particles(2),
            Target::Particles(3),
            Target::Line(2),
        ] {
            for (range, part) in [
                ([0.05, 0.99], [0.05, 0.5]),
                ([0.05, 0.99], [0.5, 1.0]),
                ([0.99, 1.0], [0.9, 1.0]),
                ([1.0, 1.0], [0.5, 1.0]),
            ] {
                let gains = (0..count).map(|n| gain(law, &throw(n, range, part), target));
                let worst = gains.fold(f64::NEG_INFINITY, f64::max);
                let name = format!(
                    "{law:?}, {target:?}, e {range:?}, steps {part:?} of the longest, {count} throws"
                );
                let bound = if range[0] < 1.0 {
                    1e-12
                } else {
                    undamped(law, target)
                };
                cases.push(Case::bounded(name, CLAUSIUS, bound, worst));
            }
        }
    }
    cases
}
