//! Whatever numbers are handed in: a typed error or a finite answer, never a panic.

use particle_damper::cavity::{Cavity, Cuboid, Cylinder, Disc, Slot, Sphere};
use particle_damper::excitation::Harmonic;
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::integrator::{Integrator, RungeKutta4, VelocityVerlet};
use particle_damper::mount::{Motion, SingleDof};
use particle_damper::{
    AllPairs, CellGrid, ContactLaw, Damper, Damping, Detector, Ending, Filling, Friction,
    HertzMindlin, HertzTsuji, Interaction, LinkedCells, Material, Neighbourhood, Particle,
    RestitutionImpulse, Skin,
};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::RngSeed;

use super::AnyCavity;
use super::mechanics::steps;

/// Numbers that nobody should hand in, and some at the edge.
const ABSURD: [f64; 20] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    -1.0,
    1.0,
    0.5,
    1e300,
    -1e300,
    1e-300,
    5e-324,
    f64::MIN_POSITIVE,
    f64::MAX,
    1e150,
    1e-150,
    1e9,
    1e-9,
    1e18,
    -1e-3,
];

/// A set-up that works, number by number.
const SANE: [f64; 32] = [
    0.4e9, 0.3, 0.75, 0.2, 0.01, // 0 material
    3e-3, 0.2e-3, 2e-3, 0.06e-3, // 5 two kinds of particles
    0.06, 0.096, 0.05, // 9 cavity
    1.0,  // 12 reference speed
    0.086, 0.08, 123.4, 0.0, 0.1, // 13 mount
    0.25, 6.0, // 18 excitation
    0.0, -9.81, 0.0,  // 20 gravity
    2e-6, // 23 time step
    0.3,  // 24 skin
    0.05, 1.0, // 25 overlaps
    0.012, 0.02, 0.1, 5.0, // 27 place, speed, spin
    1.0, // 31 tangential damping
];

#[derive(Debug, Clone)]
#[allow(clippy::struct_excessive_bools)]
struct Case {
    numbers: [f64; 32],
    count: usize,
    cavity: usize,
    law: usize,
    detector: usize,
    runge_kutta: bool,
    mounted: bool,
    coincident: bool,
    contained: bool,
    own_step: bool,
}

fn case() -> impl Strategy<Value = Case> {
    let changes = vec((any::<Index>(), any::<Index>()), 0..4);
    let choices = [0..6_usize, 0..6, 0..6, 0..7];
    (changes, choices, any::<[bool; 5]>()).prop_map(|(changes, choices, flags)| {
        let mut numbers = SANE;
        for (place, number) in changes {
            *place.get_mut(&mut numbers) = *number.get(&ABSURD);
        }
        let [count, cavity, law, detector] = choices;
        let [runge_kutta, mounted, coincident, contained, own_step] = flags;
        Case {
            numbers,
            count: [0, 1, 2, 3, 5, 9][count],
            cavity,
            law,
            detector,
            runge_kutta,
            mounted,
            coincident: coincident && mounted,
            contained,
            own_step,
        }
    })
}

type Outcome = Result<(), Box<dyn std::error::Error>>;

impl Case {
    fn cavity(&self) -> Result<Box<dyn Cavity>, Box<dyn std::error::Error>> {
        let [a, b, c] = [self.numbers[9], self.numbers[10], self.numbers[11]];
        Ok(match self.cavity {
            0 => Box::new(Slot::new(a, b)?),
            1 => Box::new(Disc::new(a)?),
            2 => Box::new(Cuboid::new(dvec3(a, b, c))?),
            3 => Box::new(Cylinder::new(a, b)?),
            4 => Box::new(Sphere::new(a)?),
            _ => Box::new(Slot::paper()),
        })
    }

    fn detector(&self) -> Result<Box<dyn Detector>, Box<dyn std::error::Error>> {
        let thickness = self.numbers[24];
        Ok(match self.detector {
            0 => Box::new(AllPairs),
            1 => Box::new(CellGrid::paper()),
            2 => Box::new(CellGrid::in_space([9, 1, 70])?),
            3 => Box::new(CellGrid::paper().with_neighbourhood(Neighbourhood::Paper)),
            4 => Box::new(LinkedCells::new()),
            5 => Box::new(Skin::new(CellGrid::paper(), thickness)?),
            _ => Box::new(Skin::new(LinkedCells::new(), thickness)?),
        })
    }

    fn particles(&self) -> Result<Vec<Particle>, Box<dyn std::error::Error>> {
        let n = &self.numbers;
        let kinds = [Particle::new(n[5], n[6])?, Particle::new(n[7], n[8])?];
        Ok((0..self.count)
            .map(|number| {
                let (row, column) = (number / 3, number % 3);
                let apart = if self.coincident { 0.0 } else { 1.0 };
                let place = dvec3(
                    n[27] + 0.009 * apart * column as f64,
                    n[28] + 0.009 * apart * row as f64,
                    0.0,
                );
                let speed = n[29] * (1.0 - column as f64);
                kinds[number % 2]
                    .at(place)
                    .moving(dvec3(speed, -speed, 0.0))
                    .spinning(DVec3::Z * n[30])
            })
            .collect())
    }

    fn material(&self) -> Result<Material, Box<dyn std::error::Error>> {
        let n = &self.numbers;
        let own = Interaction::new(n[2], n[3])?.with_rolling_friction(n[4])?;
        Ok(Material::new(n[0], n[1], own)?)
    }

    fn run(&self) -> Outcome {
        let material = self.material()?;
        let speed = self.numbers[12];
        match self.law {
            0 => self.integrate(HertzTsuji::new(material).reference_speed(speed)?),
            1 => self.integrate(
                HertzTsuji::new(material)
                    .damping(Damping::Tsuji)
                    .ending(Ending::PullingAllowed)
                    .friction(Friction::as_printed()),
            ),
            2 => self.integrate(HertzTsuji::new(material).friction(Friction::regularised(speed)?)),
            3 => {
                let law = HertzMindlin::new(material).reference_speed(speed)?;
                self.integrate(law.tangential_damping(self.numbers[31])?)
            }
            4 => self.integrate(RestitutionImpulse::new(material).reference_speed(speed)?),
            _ => self.integrate(RestitutionImpulse::literal(material)),
        }
    }

    fn integrate<L: ContactLaw>(&self, law: L) -> Outcome {
        if self.runge_kutta {
            self.build(law, RungeKutta4::default())
        } else {
            self.build(law, VelocityVerlet)
        }
    }

    fn build<L: ContactLaw, I: Integrator>(&self, law: L, integrator: I) -> Outcome {
        let n = &self.numbers;
        let cavity = self.cavity()?;
        let mut builder = Damper::builder(&*cavity as AnyCavity<'_>, law)
            .integrator(integrator)
            .detectors([self.detector()?])
            .particles(self.particles()?)
            .gravity(dvec3(n[20], n[21], n[22]))
            .initial_overlap(if self.coincident { 1e3 } else { n[25] })
            .overlap_limit(if self.coincident {
                f64::INFINITY
            } else {
                n[26]
            })
            .contained(self.contained);
        if self.own_step {
            builder = builder.time_step(n[23]);
        }
        if self.mounted {
            let mount = SingleDof::new(n[13], n[14], n[15])?.released_from(n[16], n[17])?;
            let mount = mount.excited_by(Harmonic::new(n[18], n[19])?);
            let mut damper = builder.mount(mount).build()?;
            for _ in 0..12 {
                damper.step()?;
            }
            let snapshot = damper.snapshot();
            damper.step()?;
            damper.restore(&snapshot)?;
            damper.step()?;
            finite_or_told(&mut damper);
        } else {
            let mut damper = builder.build()?;
            let end = Motion::at(dvec3(n[16], n[17] * 1e-4, n[22]), dvec3(0.0, n[17], 0.0));
            // Few steps, or an interval that is refused.
            for share in [0.5, 3.0, 1e12] {
                let _ = damper.drive(end, share * damper.time_step());
                let _ = damper.step();
            }
            finite_or_told(&mut damper);
        }
        Ok(())
    }
}

/// What is no longer finite is told by the next step.
fn finite_or_told<C, L, M, D, I>(damper: &mut Damper<C, L, M, D, I>)
where
    C: Cavity,
    L: ContactLaw,
    M: particle_damper::Mount,
    D: Detector,
    I: Integrator,
{
    let finite = damper
        .particles()
        .all(|p| p.position.is_finite() && p.velocity.is_finite() && p.spin.is_finite());
    let told = damper.step().is_err() || damper.step().is_err();
    assert!(finite || told, "not finite, and not told");
    let _ = (
        damper.outside(),
        damper.kinetic_energy(),
        damper.memory_bytes(),
    );
    let _ = (
        damper.wall_load(0, 9),
        damper.reaction(7),
        damper.container(3),
        damper.particle(99),
    );
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 4000,
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_damper_of_any_numbers_is_refused_or_runs(case in case()) {
        // Both are fine.
        let _ = case.run();
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 300,
        rng_seed: RngSeed::Fixed(2),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_filling_of_any_numbers_is_refused_or_does_not_overlap(
        which in vec(any::<Index>(), 6),
        sane in vec(any::<bool>(), 6),
        count in 0..30_usize,
        round in any::<bool>(),
    ) {
        let numbers: Vec<f64> = which
            .iter()
            .zip(&sane)
            .zip([2e-3, 1e-3, 0.03, 0.04, 0.0, -1.0])
            .map(|((index, sane), own)| if *sane { own } else { *index.get(&ABSURD) })
            .collect();
        let mut particle = Particle::new(1e-3, 1e-5).unwrap();
        particle.radius = numbers[0];
        let mut other = particle;
        other.radius = numbers[1];
        let filling = Filling::new(1)
            .with(count, particle)
            .with(count / 2, other)
            .down(dvec3(numbers[4], numbers[5], 0.0));
        let filled = if round {
            Cylinder::new(numbers[2], numbers[3]).map(|room| filling.fill(&room))
        } else {
            Slot::new(numbers[2], numbers[3]).map(|room| filling.fill(&room))
        };
        if let Ok(Ok(bed)) = filled {
            for (n, a) in bed.iter().enumerate() {
                prop_assert!(a.position.is_finite());
                for b in &bed[n + 1..] {
                    prop_assert!(a.position.distance(b.position) >= a.radius + b.radius);
                }
            }
        }
    }
}

/// A material, and `count` grains side by side that come down on a floor.
fn dropped(count: u32, e: f64, mu: f64) -> (Material, impl Iterator<Item = Particle>) {
    let own = Interaction::new(e, mu).unwrap();
    let material = Material::new(0.4e9, 0.3, own).unwrap();
    let bed = (0..count).map(|n| {
        let place = dvec3(0.02 + 0.006 * f64::from(n), 0.003, 0.0);
        Particle::new(3e-3, 2e-4)
            .unwrap()
            .at(place)
            .moving(DVec3::NEG_Y)
    });
    (material, bed)
}

/// Limits that are in range, together.
#[test]
fn extremes_that_are_in_range_stay_finite() {
    let finite = |p: Particle| p.velocity.is_finite() && p.spin.is_finite();
    for count in [0, 1, 2] {
        for (e, mu) in [(0.001, 0.0), (1.0, 0.0), (1.0, 1.0), (0.001, 1e6)] {
            let (material, bed) = dropped(count, e, mu);
            let mut strict = Damper::builder(Slot::paper(), HertzMindlin::new(material))
                .particles(bed)
                .time_step(1e-7)
                .build()
                .unwrap();
            steps(&mut strict, 5000);
            assert!(strict.particles().all(finite));
        }
        for (e, mu) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1e6), (1.0, 1e6)] {
            let (material, bed) = dropped(count, e, mu);
            let mut coarse = Damper::builder(Slot::paper(), RestitutionImpulse::new(material))
                .mount(SingleDof::new(1e-6, 0.0, 0.0).unwrap())
                .particles(bed)
                .time_step(1e-5)
                .build()
                .unwrap();
            steps(&mut coarse, 500);
            assert!(coarse.particles().all(finite));
        }
    }
}
