//! Beds of more than one block: sorted in space, on any number of threads, the same bits.

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    Cavity, ContactLaw, Cuboid, Damper, Damping, Detector, HertzMindlin, LinkedCells, Material,
    Motion, Particle, Prescribed, RestitutionImpulse, Skin, Slot, VelocityVerlet,
};

const RADIUS: f64 = 3e-3;
const COUNT: usize = 4500;
/// Large beds are sorted every thousand steps.
const STEPS: usize = 1100;

fn shaken(time: f64) -> Motion {
    let w = std::f64::consts::TAU * 6.0;
    Motion::at(
        DVec3::Y * 0.01 * (1.0 - (w * time).cos()),
        DVec3::Y * 0.01 * w * (w * time).sin(),
    )
}

type Shaken = Prescribed<fn(f64) -> Motion>;

/// Rows that nearly touch, `columns` to a row, numbered so that neighbours have far numbers.
fn stacked(columns: usize, layers: usize) -> Vec<Particle> {
    let sphere = Particle::new(RADIUS, 2e-4).unwrap();
    let pitch = 2.001 * RADIUS;
    (0..COUNT)
        .map(|number| {
            let place = number * 1009 % COUNT;
            let (x, rest) = (place % columns, place / columns);
            let (z, y) = (rest % layers, rest / layers);
            let shift = 0.25 + 0.5 * (y % 2) as f64;
            let z = if layers > 1 { z as f64 + 0.5 } else { 0.0 };
            sphere.at(pitch * dvec3(x as f64 + 0.5 + shift, y as f64 + 0.5, z))
        })
        .collect()
}

fn planar<L: ContactLaw, D: Detector + Clone>(
    law: L,
    detector: D,
    time_step: f64,
) -> Damper<Slot, L, Shaken, D, VelocityVerlet> {
    Damper::builder(Slot::new(0.58, 0.40).unwrap(), law)
        .mount(Prescribed(shaken as fn(f64) -> Motion))
        .detector(detector)
        .particles(stacked(94, 1))
        .time_step(time_step)
        .build()
        .unwrap()
}

fn mindlin() -> HertzMindlin {
    HertzMindlin::new(Material::acrylic()).damping(Damping::Tsuji)
}

fn skin(thickness: f64) -> Skin<LinkedCells> {
    Skin::new(LinkedCells::new(), thickness).unwrap()
}

fn bits<C, L, D>(damper: &Damper<C, L, Shaken, D, VelocityVerlet>) -> Vec<u64>
where
    C: Cavity,
    L: ContactLaw,
    D: Detector,
{
    let numbers = damper.particles().flat_map(|particle| {
        [particle.position, particle.velocity, particle.spin].map(|vector| vector.to_array())
    });
    let force = damper.reaction(0).unwrap().force.to_array();
    let numbers = numbers.flatten().chain(force);
    numbers.map(f64::to_bits).collect()
}

#[test]
fn every_skin_gives_the_same_bits_and_particles_keep_their_numbers() {
    let mut first = planar(mindlin(), skin(1.0 / 3.0), 2e-5);
    let mut second = planar(mindlin(), skin(0.12), 2e-5);
    for _ in 0..STEPS {
        first.step().unwrap();
        second.step().unwrap();
    }
    assert!(first.contacts() > 100, "{}", first.contacts());
    assert_ne!(first.detections(), second.detections());
    assert_eq!(bits(&first), bits(&second));
    for (now, then) in first.particles().zip(stacked(94, 1)) {
        assert!(now.position.distance(then.position) < 0.03);
    }
}

#[test]
fn a_restored_bed_is_sorted_at_the_same_step() {
    let mut damper = planar(mindlin(), skin(1.0 / 3.0), 2e-5);
    for _ in 0..950 {
        damper.step().unwrap();
    }
    let snapshot = damper.snapshot();
    let mut other = planar(mindlin(), skin(0.2), 2e-5);
    other.restore(&snapshot).unwrap();
    for _ in 0..150 {
        damper.step().unwrap();
        other.step().unwrap();
    }
    assert_eq!(bits(&damper), bits(&other));
}

#[test]
fn impulses_in_a_large_bed_give_the_same_bits_with_every_skin() {
    let law = || RestitutionImpulse::new(Material::acrylic());
    let mut first = planar(law(), skin(1.0 / 3.0), 1e-4);
    let mut second = planar(law(), skin(0.15), 1e-4);
    for _ in 0..STEPS {
        first.step().unwrap();
        second.step().unwrap();
    }
    assert_eq!(bits(&first), bits(&second));
}

/// Momentum of bed and container is the same however the bed is cut into blocks.
#[test]
fn across_blocks_force_is_answered_by_force() {
    let mut damper = Damper::builder(Cuboid::new(DVec3::splat(0.2)).unwrap(), mindlin())
        .mount(Prescribed(shaken as fn(f64) -> Motion))
        .detector(skin(1.0 / 3.0))
        .gravity(DVec3::ZERO)
        .particles(stacked(16, 16))
        .time_step(2e-5)
        .build()
        .unwrap();
    let before = damper.momentum();
    let mut given = DVec3::ZERO;
    for _ in 0..300 {
        damper.step().unwrap();
        given += damper.reaction(0).unwrap().impulse;
    }
    let change = damper.momentum() - before;
    assert!(change.length() > 1e-3, "{change}");
    assert!(
        (change + given).length() < 1e-12 * change.length(),
        "{change} {given}"
    );
}

#[cfg(feature = "rayon")]
#[test]
fn every_number_of_threads_gives_the_same_bits() {
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap().install(|| {
            let mut damper = planar(mindlin(), skin(1.0 / 3.0), 2e-5);
            for _ in 0..STEPS {
                damper.step().unwrap();
            }
            bits(&damper)
        })
    };
    let one = run(1);
    assert!(one == run(2) && one == run(3));
}
