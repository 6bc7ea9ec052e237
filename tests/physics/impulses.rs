//! The impulse law creates no energy: whatever meets, however it turns, at every step that the law
//! accepts.

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    AllPairs, BuildError, Builder, Cuboid, Damper, Driven, EnergyLedger, Filling, Interaction,
    Material, Motion, Mount, Particle, Prescribed, RestitutionImpulse, SingleDof, Slot,
    VelocityVerlet,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

type Box3<M = Driven> = Damper<Cuboid, RestitutionImpulse, M, AllPairs, VelocityVerlet>;

/// So many cases, the same in every run.
fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(0x5eed),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// What a law of impulses is made for.
#[derive(Debug, Clone, Copy)]
struct Pairing {
    restitution: f64,
    friction: f64,
    rolling: f64,
    /// Step over the longest that the law accepts.
    part: f64,
}

/// A particle thrown at something.
#[derive(Debug, Clone, Copy)]
struct Throw {
    speed: f64,
    /// From the normal, in degrees.
    angle: f64,
    /// Surface speeds over the speed, about three axes.
    spins: [[f64; 3]; 2],
    /// Mass of the other over that of the one thrown.
    ratio: f64,
    /// Part of a step until they touch.
    phase: f64,
}

fn pairing() -> impl Strategy<Value = Pairing> {
    let rolling = prop_oneof![Just(0.0), 0.0..0.5];
    let restitution = prop_oneof![Just(0.0), Just(1.0), 0.0..1.0];
    let part = prop_oneof![Just(1.0), 0.01..1.0];
    (restitution, 0.0..1.0, rolling, part).prop_map(|(restitution, friction, rolling, part)| {
        Pairing {
            restitution,
            friction,
            rolling,
            part,
        }
    })
}

fn throw() -> impl Strategy<Value = Throw> {
    let spin = || [-2.0..2.0, -2.0..2.0, -2.0..2.0];
    let angle = prop_oneof![0.0..89.0, 80.0..89.0];
    (0.01..1.0, angle, [spin(), spin()], -3.0..3.0, 0.0..1.0).prop_map(
        |(speed, angle, spins, ratio, phase)| Throw {
            speed,
            angle,
            spins,
            ratio: 10.0_f64.powf(ratio),
            phase,
        },
    )
}

impl Pairing {
    fn law(&self) -> RestitutionImpulse {
        let interaction = Interaction::new(self.restitution, self.friction).unwrap();
        let interaction = interaction.with_rolling_friction(self.rolling).unwrap();
        RestitutionImpulse::new(Material::new(0.4e9, 0.3, interaction).unwrap())
    }

    /// Builds with its part of the longest step; `make` is given the step.
    fn build<M: Mount>(
        &self,
        make: impl Fn(f64) -> Builder<Cuboid, RestitutionImpulse, M, AllPairs, VelocityVerlet>,
    ) -> Box3<M> {
        let limit = match make(0.0).time_step(1e9).build() {
            Err(BuildError::TimeStepTooLong { limit, .. }) => limit,
            other => panic!("a step of 1e9 s is too long: {:?}", other.err()),
        };
        let step = self.part * limit;
        make(step).time_step(step).build().unwrap()
    }
}

/// Greatest gain of kinetic energy in a step, over that at the start, when one particle is thrown at a
/// wall (`others` zero) or at a row of particles that touch.
fn gain(pairing: &Pairing, throw: &Throw, others: usize) -> f64 {
    let first = Particle::new(3e-3, 0.2e-3).unwrap();
    let radius = first.radius * throw.ratio.cbrt();
    let side = 60.0 * first.radius.max(radius);
    let centre = DVec3::splat(0.5 * side);
    let (sine, cosine) = throw.angle.to_radians().sin_cos();
    let spin = |n: usize, radius: f64| DVec3::from(throw.spins[n]) * (throw.speed / radius);
    let first = first
        .moving(throw.speed * dvec3(sine, -cosine, 0.0))
        .spinning(spin(0, first.radius));
    let bodies = |step: f64| {
        let gap = throw.phase * throw.speed * cosine * step;
        if others == 0 {
            return vec![first.at(dvec3(centre.x, first.radius + gap, centre.z))];
        }
        let other = Particle::new(radius, first.mass * throw.ratio).unwrap();
        let other = other.spinning(spin(1, radius));
        let reach = first.radius + radius;
        // Onto the only one, between two, or onto the middle one of three.
        let (left, rise) = match others {
            1 => (0.0, reach),
            2 => (-radius, (reach * reach - radius * radius).sqrt()),
            _ => (-2.0 * radius, reach),
        };
        let mut bodies = vec![first.at(centre + DVec3::Y * (rise + gap))];
        bodies.extend((0..others).map(|n| {
            let along = left + 2.0 * radius * n as f64 * (1.0 + 1e-12);
            other.at(centre + DVec3::X * along)
        }));
        bodies
    };
    let mut damper = pairing.build(|step| {
        Damper::builder(Cuboid::new(DVec3::splat(side)).unwrap(), pairing.law())
            .detector(AllPairs)
            .gravity(DVec3::ZERO)
            .particles(bodies(step))
    });
    let start = damper.kinetic_energy();
    let (mut energy, mut most) = (start, f64::NEG_INFINITY);
    for _ in 0..40 {
        damper.step().unwrap();
        most = most.max(damper.kinetic_energy() - energy);
        energy = damper.kinetic_energy();
    }
    most / start
}

/// Particles of three sizes in a box, all in motion.
fn stirred(seed: u64, count: usize, speed: f64, turn: f64) -> (Cuboid, Vec<Particle>) {
    let cavity = Cuboid::new(dvec3(0.03, 0.04, 0.03)).unwrap();
    let sized = |radius: f64| Particle::new(radius, 1200.0 * 4.19 * radius.powi(3)).unwrap();
    let bed = Filling::new(seed)
        .with(count, sized(3e-3))
        .with(count, sized(2e-3))
        .with(count, sized(1.5e-3));
    let mut bed = bed.fill(&cavity).unwrap();
    for (n, particle) in bed.iter_mut().enumerate() {
        let angle = 2.399_963 * n as f64;
        let way = dvec3(angle.cos(), angle.sin(), (1.7 * angle).sin());
        particle.velocity = way * speed;
        particle.spin = dvec3(way.y, way.z, way.x) * (turn * speed / particle.radius);
    }
    (cavity, bed)
}

/// Kinetic energy and energy of height.
fn energy<M: Mount>(damper: &Box3<M>, gravity: f64) -> f64 {
    let height: f64 = damper.particles().map(|p| p.mass * p.position.y).sum();
    damper.kinetic_energy() + gravity * height
}

proptest! {
    #![proptest_config(config(400))]

    #[test]
    fn an_impact_takes_energy_step_by_step(pairing in pairing(), throw in throw(), others in 0..4_usize) {
        let gain = gain(&pairing, &throw, others);
        prop_assert!(gain <= 1e-12, "{gain:e}");
    }
}

proptest! {
    #![proptest_config(config(16))]

    /// Without gravity, and in a box at rest, no step may add to the kinetic energy.
    #[test]
    fn a_weightless_bed_left_alone_only_slows_down(
        pairing in pairing(), seed in 0..100_u64, turn in 0.0..2.0,
    ) {
        let (cavity, bed) = stirred(seed, 15, 0.5, turn);
        let mut damper = pairing.build(|_| {
            Damper::builder(cavity, pairing.law())
                .detector(AllPairs)
                .gravity(DVec3::ZERO)
                .particles(bed.iter().copied())
        });
        let start = damper.kinetic_energy();
        let mut before = start;
        for _ in 0..600 {
            damper.step().unwrap();
            let now = damper.kinetic_energy();
            prop_assert!(now <= before + 1e-13 * start, "{:e}", (now - before) / start);
            before = now;
        }
    }

    /// Under gravity resting contacts are pushed out of each other: what that lifts the bed by is all
    /// that its energy may rise.
    #[test]
    fn a_bed_left_alone_comes_to_rest(
        pairing in pairing(), seed in 0..100_u64, turn in 0.0..2.0,
    ) {
        let (cavity, bed) = stirred(seed, 12, 0.5, turn);
        let mut damper = pairing.build(|_| {
            Damper::builder(cavity, pairing.law())
                .detector(AllPairs)
                .particles(bed.iter().copied())
        });
        let start = energy(&damper, 9.81);
        let mut least = start;
        let mut rise = 0.0_f64;
        while damper.time() < 0.3 {
            damper.step().unwrap();
            let now = energy(&damper, 9.81);
            least = least.min(now);
            rise = rise.max(now - least);
        }
        prop_assert!(rise <= 2e-4 * start, "{:e}", rise / start);
        prop_assert!(damper.kinetic_energy() < 0.02 * start);
    }

    /// Each impulse is booked with the energy that it takes, in a container that a host shakes and in one
    /// that moves freely.
    #[test]
    fn every_impulse_is_booked_with_the_energy_it_takes(
        pairing in pairing(), seed in 0..100_u64, turn in 0.0..2.0,
    ) {
        let (cavity, bed) = stirred(seed, 12, 0.3, turn);
        let builder = || {
            let builder = Damper::builder(cavity, pairing.law());
            builder.detector(AllPairs).particles(bed.iter().copied())
        };
        let shaken = |t: f64| {
            let (sine, cosine) = (40.0 * t).sin_cos();
            Motion::at(dvec3(0.4, 1.0, 0.2) * 0.01 * sine, dvec3(0.4, 1.0, 0.2) * 0.4 * cosine)
        };
        let mut driven = pairing.build(|_| builder().mount(Prescribed(shaken)));
        let free = SingleDof::new(0.02, 0.0, 0.0).unwrap();
        let free = free.along(dvec3(0.3, 1.0, 0.5)).unwrap();
        let free = free.released_from(0.0, 0.3).unwrap();
        let mut free = pairing.build(|_| builder().mount(free).gravity(DVec3::ZERO));
        let (mut by_host, mut by_itself) = (EnergyLedger::new(), EnergyLedger::new());
        while driven.time() < 0.2 {
            driven.step_watched(&mut by_host).unwrap();
            free.step_watched(&mut by_itself).unwrap();
        }
        let scale = by_host.input().abs() + by_host.losses().total() + by_host.opening().total();
        let residual = by_host.residual() / scale;
        prop_assert!(residual.abs() < 1e-11, "shaken: {residual:e}");
        let residual = by_itself.residual() / by_itself.opening().total();
        prop_assert!(residual.abs() < 1e-11, "free: {residual:e}");
    }
}

/// Fifteen layers and more, as wide as the slot to the last grain: there is no room to push overlaps to.
#[test]
fn a_deep_pile_without_room_comes_to_rest() {
    let grain = Particle::new(3e-3, 0.2e-3).unwrap();
    let filling = Filling::new(1).with(150, grain);
    let law = RestitutionImpulse::new(Material::acrylic());
    let mut damper = Damper::builder(Slot::paper(), law)
        .particles(filling.fill(&Slot::paper()).unwrap())
        .time_step(1e-4)
        .build()
        .unwrap();
    let mut run = |seconds: f64| -> Vec<DVec3> {
        for _ in 0..(seconds / 1e-4) as u32 {
            damper.step().unwrap();
        }
        damper.particles().map(|grain| grain.position).collect()
    };
    let (before, after) = (run(6.0), run(1.0));
    let moved = before.iter().zip(&after).map(|(a, b)| a.distance(*b));
    let drift = moved.fold(0.0, f64::max) / grain.radius;
    assert!(drift < 1e-6, "{drift:e} radii");
    assert!(damper.largest_overlap() < 0.05 * grain.radius);
}
