//! The same bits: from run to run, with every detector, and after a restart.

use particle_damper::cavity::{Cavity, Cylinder, Slot};
use particle_damper::excitation::{BandLimitedNoise, Chirp, Harmonic, Signal};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::integrator::{Integrator, RungeKutta4, VelocityVerlet};
use particle_damper::mount::SingleDof;
use particle_damper::{
    AllPairs, Bed, Bodies, Body, CellGrid, ContactLaw, Cuboid, Damper, Damping, Detector, Ending,
    Filling, HertzMindlin, HertzTsuji, LinkedCells, Material, Materials, Motion, Mount, Pairs,
    Particle, RestitutionImpulse, Skin,
};

/// Sorts along x, and sweeps.
#[derive(Debug, Clone, Default)]
struct SweepAndPrune {
    order: Vec<u32>,
}

impl Detector for SweepAndPrune {
    fn detect(&mut self, bed: &Bed<'_>, pairs: &mut Pairs) {
        let reach = 2.0 * bed.largest_radius() + bed.margin();
        let x = |n: u32| bed.position(n as usize).x;
        self.order.clear();
        self.order.extend(0..bed.len() as u32);
        self.order.sort_unstable_by(|a, b| x(*a).total_cmp(&x(*b)));
        for (place, &a) in self.order.iter().enumerate() {
            for &b in &self.order[place + 1..] {
                if x(b) - x(a) > reach {
                    break;
                }
                pairs.push(b as usize, a as usize);
            }
        }
    }
}

/// FNV-1a over the bits of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Digest(u64);

impl Digest {
    fn add(&mut self, number: f64) {
        for byte in number.to_bits().to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

/// All bits of a damper's state that can be seen.
fn digest<C, L, M, D, I>(damper: &Damper<C, L, M, D, I>) -> Digest
where
    C: Cavity,
    L: ContactLaw,
    M: Mount,
    D: Detector,
    I: Integrator,
{
    let mut digest = Digest(0xcbf2_9ce4_8422_2325);
    for particle in damper.particles() {
        for vector in [particle.position, particle.velocity, particle.spin] {
            vector.to_array().into_iter().for_each(|x| digest.add(x));
        }
    }
    for number in damper.coordinates().iter().chain(damper.rates()) {
        digest.add(*number);
    }
    let reaction = damper.reaction(0).unwrap();
    for vector in [reaction.force, reaction.impulse] {
        vector.to_array().into_iter().for_each(|x| digest.add(x));
    }
    digest.add(damper.time());
    digest
}

/// A force of period 1/6 s without functions that a platform might round in its own way.
fn force(time: f64) -> f64 {
    let phase = (6.0 * time).fract();
    let sign = if phase < 0.5 { 1.0 } else { -1.0 };
    let s = (2.0 * phase).fract();
    4.0 * sign * s * (1.0 - s)
}

type Shaken<C, L, I> = Damper<C, L, SingleDof<fn(f64) -> f64>, Box<dyn Detector>, I>;

fn shaken<C, L, I>(
    cavity: C,
    law: L,
    integrator: I,
    bed: &[Particle],
    time_step: f64,
    detector: Box<dyn Detector>,
) -> Shaken<C, L, I>
where
    C: Cavity,
    L: ContactLaw,
    I: Integrator,
{
    Damper::builder(cavity, law)
        .mount(SingleDof::paper().excited_by(force as fn(f64) -> f64))
        .integrator(integrator)
        .detectors([detector])
        .particles(bed.iter().copied())
        .time_step(time_step)
        .build()
        .unwrap()
}

fn steps<C, L, I>(damper: &mut Shaken<C, L, I>, count: usize)
where
    C: Cavity,
    L: ContactLaw,
    I: Integrator,
{
    for _ in 0..count {
        damper.step().unwrap();
    }
}

fn detectors() -> Vec<(&'static str, Box<dyn Detector>)> {
    let grid = |across, up| CellGrid::new(across, up).unwrap();
    vec![
        ("20 x 32 cells", Box::new(CellGrid::paper())),
        ("40 x 64 cells", Box::new(grid(40, 64))),
        ("80 x 128 cells", Box::new(grid(80, 128))),
        ("linked cells", Box::new(LinkedCells::new())),
        ("sweep", Box::new(SweepAndPrune::default())),
        (
            "skin of all pairs",
            Box::new(Skin::new(AllPairs, 0.2).unwrap()),
        ),
        (
            "skin of cells",
            Box::new(Skin::new(CellGrid::paper(), 0.5).unwrap()),
        ),
        (
            "skin of linked cells",
            Box::new(Skin::<LinkedCells>::default()),
        ),
        (
            "skin of the sweep",
            Box::new(Skin::new(SweepAndPrune::default(), 0.1).unwrap()),
        ),
    ]
}

fn planar_bed(count: usize) -> Vec<Particle> {
    Filling::new(7)
        .with(count, Particle::new(3e-3, 0.2e-3).unwrap())
        .fill(&Slot::paper())
        .unwrap()
}

fn mixed_bed(cavity: &impl Cavity, scale: usize) -> Vec<Particle> {
    Filling::new(11)
        .with(3 * scale, Particle::new(2e-3, 0.06e-3).unwrap())
        .with(scale, Particle::new(4e-3, 0.4e-3).unwrap())
        .fill(cavity)
        .unwrap()
}

/// Every detector gives the bits that testing each pair gives, after a tenth of the steps and at the
/// end.
fn all_agree<C, L, I>(cavity: C, law: L, integrator: I, bed: &[Particle], dt: f64, count: usize)
where
    C: Cavity + Clone,
    L: ContactLaw + Clone,
    I: Integrator + Clone,
{
    let run = |detector| {
        let mut damper = shaken(
            cavity.clone(),
            law.clone(),
            integrator.clone(),
            bed,
            dt,
            detector,
        );
        steps(&mut damper, count / 10);
        let early = digest(&damper);
        steps(&mut damper, count - count / 10);
        [early, digest(&damper)]
    };
    let expected = run(Box::new(AllPairs));
    assert_eq!(run(Box::new(AllPairs)), expected, "a second run");
    for (name, detector) in detectors() {
        assert_eq!(run(detector), expected, "{name}");
    }
}

fn tsuji() -> HertzTsuji {
    HertzTsuji::new(Material::acrylic())
}

fn mindlin() -> HertzMindlin {
    HertzMindlin::new(Material::acrylic())
}

fn impulse() -> RestitutionImpulse {
    RestitutionImpulse::new(Material::acrylic())
}

#[test]
fn detectors_agree_under_the_strict_law() {
    all_agree(
        Slot::paper(),
        tsuji(),
        VelocityVerlet,
        &planar_bed(12),
        2e-5,
        100_000,
    );
}

#[test]
fn detectors_agree_under_the_strict_law_with_runge_kutta() {
    all_agree(
        Slot::paper(),
        tsuji(),
        RungeKutta4::default(),
        &planar_bed(12),
        2e-5,
        30_000,
    );
}

#[test]
fn detectors_agree_under_the_law_with_memory() {
    let bed = mixed_bed(&Slot::paper(), 4);
    all_agree(Slot::paper(), mindlin(), VelocityVerlet, &bed, 8e-6, 30_000);
}

#[test]
fn detectors_agree_under_impulses() {
    all_agree(
        Slot::paper(),
        impulse(),
        VelocityVerlet,
        &planar_bed(12),
        1e-4,
        100_000,
    );
}

#[test]
fn detectors_agree_in_space() {
    let room = Cuboid::new(dvec3(0.03, 0.05, 0.03)).unwrap();
    let bed = mixed_bed(&room, 4);
    all_agree(room, tsuji(), VelocityVerlet, &bed, 8e-6, 20_000);
    let room = Cylinder::new(0.02, 0.05).unwrap();
    let bed = mixed_bed(&room, 4);
    all_agree(room, impulse(), VelocityVerlet, &bed, 1e-4, 20_000);
}

/// The long form: a bed that fills a third of the paper's container.
#[test]
#[ignore = "takes minutes"]
fn detectors_agree_on_a_large_bed() {
    let bed = planar_bed(40);
    all_agree(Slot::paper(), tsuji(), VelocityVerlet, &bed, 2e-5, 100_000);
    all_agree(
        Slot::paper(),
        tsuji(),
        RungeKutta4::default(),
        &bed,
        2e-5,
        100_000,
    );
    all_agree(
        Slot::paper(),
        mindlin(),
        VelocityVerlet,
        &bed,
        1.5e-5,
        100_000,
    );
    all_agree(
        Slot::paper(),
        impulse(),
        VelocityVerlet,
        &bed,
        1e-4,
        100_000,
    );
}

/// Restored at step `at`, in the same damper and in one built anew, the bits are those of a run
/// without interruption.
fn restores<L, I>(law: L, integrator: I, dt: f64)
where
    L: ContactLaw + Clone,
    I: Integrator + Clone,
{
    let bed = mixed_bed(&Slot::paper(), 5);
    for (name, _) in detectors() {
        let build = || {
            let mut all = detectors().into_iter();
            let (_, detector) = all.find(|(other, _)| *other == name).unwrap();
            shaken(
                Slot::paper(),
                law.clone(),
                integrator.clone(),
                &bed,
                dt,
                detector,
            )
        };
        let mut damper = build();
        steps(&mut damper, 3001);
        let snapshot = damper.snapshot();
        steps(&mut damper, 2000);
        let expected = digest(&damper);
        damper.restore(&snapshot).unwrap();
        assert_eq!(damper.snapshot(), snapshot, "{name}");
        steps(&mut damper, 2000);
        assert_eq!(digest(&damper), expected, "{name}, the same damper");
        let mut other = build();
        other.restore(&snapshot).unwrap();
        steps(&mut other, 2000);
        assert_eq!(digest(&other), expected, "{name}, a new damper");
    }
}

#[test]
fn a_restored_damper_goes_on_to_the_same_bits() {
    restores(tsuji(), VelocityVerlet, 8e-6);
    restores(tsuji(), RungeKutta4::default(), 8e-6);
    restores(mindlin(), VelocityVerlet, 8e-6);
    restores(mindlin(), RungeKutta4::default(), 8e-6);
    restores(impulse(), VelocityVerlet, 1e-4);
    restores(
        RestitutionImpulse::new(Material::acrylic()).friction(false),
        VelocityVerlet,
        1e-4,
    );
}

#[test]
fn a_restored_damper_is_driven_on_to_the_same_bits() {
    fn run<L: ContactLaw + Clone>(law: &L, time_step: f64) {
        let bed = planar_bed(20);
        let build = || {
            Damper::builder(Slot::paper(), law.clone())
                .particles(bed.iter().copied())
                .time_step(time_step)
                .build()
                .unwrap()
        };
        // Uneven intervals, so that the steps are not all of one length.
        let motion = |n: u32| {
            let time = f64::from(n) * 2.7 * time_step;
            let speed = 0.3 - 4.0 * time;
            Motion::at(
                dvec3(0.1 * time, 0.3 * time - 2.0 * time * time, 0.0),
                dvec3(0.1, speed, 0.0),
            )
        };
        let mut damper = build();
        for n in 1..700 {
            damper.drive(motion(n), 2.7 * time_step).unwrap();
        }
        let snapshot = damper.snapshot();
        let mut other = build();
        other.restore(&snapshot).unwrap();
        for n in 700..1400 {
            let first = damper.drive(motion(n), 2.7 * time_step).unwrap();
            let second = other.drive(motion(n), 2.7 * time_step).unwrap();
            assert_eq!(first, second, "interval {n}");
            assert_eq!(digest(&damper), digest(&other), "interval {n}");
        }
    }
    run(&tsuji(), 2e-5);
    run(&mindlin(), 1.5e-5);
    run(&impulse(), 1e-4);
}

#[test]
fn the_order_in_which_particles_are_given_does_not_decide_who_is_who() {
    let bed = planar_bed(20);
    let mut damper = shaken(
        Slot::paper(),
        tsuji(),
        VelocityVerlet,
        &bed,
        2e-5,
        Box::new(AllPairs),
    );
    for (number, particle) in bed.iter().enumerate() {
        assert_eq!(damper.particle(number).unwrap().position, particle.position);
    }
    steps(&mut damper, 100);
    let listed: Vec<DVec3> = damper.particles().map(|p| p.position).collect();
    for (number, position) in listed.into_iter().enumerate() {
        assert_eq!(damper.particle(number).unwrap().position, position);
    }
}

/// Guards the values themselves. A digest changes whenever any bit of a trajectory does; if that was
/// meant, put the new one here (the failure prints it) and tell users under "Numerical results" in
/// the changelog.
#[test]
fn values_are_those_of_the_last_release() {
    fn run<L: ContactLaw, I: Integrator>(law: L, integrator: I, time_step: f64) -> String {
        let bed: Vec<Particle> = (0..12)
            .map(|n| {
                let (column, row) = (f64::from(n % 4), f64::from(n / 4));
                let place = dvec3(
                    0.006 + 0.011 * column + 0.002 * row,
                    0.005 + 0.008 * row,
                    0.0,
                );
                let small = n % 3 == 0;
                let (radius, mass) = if small {
                    (2e-3, 0.06e-3)
                } else {
                    (3e-3, 0.2e-3)
                };
                Particle::new(radius, mass).unwrap().at(place)
            })
            .collect();
        let detector = Box::new(LinkedCells::new());
        let mut damper = shaken(Slot::paper(), law, integrator, &bed, time_step, detector);
        steps(&mut damper, 10_000);
        format!("{:016x}", digest(&damper).0)
    }
    let found = [
        run(tsuji(), VelocityVerlet, 1e-5),
        run(tsuji(), RungeKutta4::default(), 1e-5),
        run(mindlin(), VelocityVerlet, 1e-5),
        run(impulse(), VelocityVerlet, 1e-4),
    ];
    assert_eq!(found, GOLDEN);
}

const GOLDEN: [&str; 4] = [
    "927b3f89b4c49d2a",
    "088b2b6a0683d828",
    "83c136b73c09f001",
    "44256f4ab7f93a3c",
];

/// The same on every platform: what sines and powers go into.
#[test]
fn signals_and_coefficients_have_the_bits_of_every_platform() {
    let mut digest = Digest(0xcbf2_9ce4_8422_2325);
    let noise = BandLimitedNoise::new(0.25, [4.0, 800.0], 64, 11).unwrap();
    let sine = Harmonic::new(0.25, 6.1).unwrap();
    let sweeps = [
        Chirp::linear(1.0, [4.0, 80.0], 5.0).unwrap(),
        Chirp::logarithmic(1.0, [4.0, 80.0], 5.0).unwrap(),
    ];
    for step in -100..2000 {
        let time = 0.0731 * f64::from(step);
        let signals = [&noise as &dyn Signal, &sine, &sweeps[0], &sweeps[1]];
        for number in signals.iter().flat_map(|signal| signal.at(time)) {
            digest.add(number);
        }
    }
    for restitution in 1..=20 {
        let restitution = 0.05 * f64::from(restitution);
        for damping in [Damping::Viscoelastic, Damping::Tsuji] {
            for ending in [Ending::NeverPulling, Ending::PullingAllowed] {
                digest.add(damping.number(restitution, ending).unwrap());
            }
        }
        let impact = Bodies::new(
            Body::sphere(3e-3, 0.2e-3, Materials::FIRST),
            Body::wall(Materials::FIRST),
        );
        let impact = tsuji().elastic_impact(&impact, restitution).unwrap();
        digest.add(impact.duration());
        digest.add(impact.force());
    }
    assert_eq!(format!("{:016x}", digest.0), "b35c23cabdd89332");
}
