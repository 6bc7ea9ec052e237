//! Beds of mixed radii and materials: exact with every detector, fast, and of the materials named.

use glam::{DVec3, dvec3};
use particle_damper::{
    AllPairs, Bed, Cavity, CellGrid, Cuboid, Damper, Detector, Driven, Filling, HertzTsuji,
    Interaction, LinkedCells, Material, Materials, Motion, Pairs, Particle, RestitutionImpulse,
    Skin, Slot, SolverParameters,
};

/// Radii from 1 to 10 in two materials, and the table that the law has of them.
fn bed(small: usize, large: usize) -> (Materials, Vec<Particle>, Cuboid) {
    let mut materials = Materials::from(Material::acrylic());
    let interaction = Interaction::new(0.9, 0.1).unwrap();
    let steel = Material::new(2e9, 0.3, interaction).unwrap();
    let steel = materials.add(steel);
    let cavity = Cuboid::new(dvec3(0.05, 0.06, 0.05)).unwrap();
    let filling = Filling::new(4)
        .with(large, Particle::with_density(5e-3, 1200.0).unwrap())
        .with(
            large,
            Particle::with_density(2e-3, 7800.0).unwrap().of(steel),
        )
        .with(small, Particle::with_density(0.5e-3, 1200.0).unwrap())
        .with(
            small,
            Particle::with_density(0.7e-3, 7800.0).unwrap().of(steel),
        );
    (materials, filling.fill(&cavity).unwrap(), cavity)
}

fn shaken(time: f64) -> Motion {
    let (sine, cosine) = (100.0 * time).sin_cos();
    Motion::at(
        dvec3(2.0, 3.0, 1.0) * (1e-3 * sine),
        dvec3(2.0, 3.0, 1.0) * (0.1 * cosine),
    )
}

type Shaken<D> = Damper<Cuboid, RestitutionImpulse, Driven, D>;

fn damper<D: Detector + Clone>(detector: D, small: usize) -> Shaken<D> {
    let (materials, particles, cavity) = bed(small, 15);
    // A thousand times as heavy as the small ones.
    let parameters = SolverParameters::default().with_sweeps(16);
    let law = RestitutionImpulse::new(materials).solved_with(parameters);
    Damper::builder(cavity, law)
        .particles(particles)
        .detector(detector)
        .time_step(5e-5)
        .build()
        .unwrap()
}

fn run<D: Detector>(damper: &mut Shaken<D>, steps: u32) -> Vec<Particle> {
    for _ in 0..steps {
        let end = shaken(damper.time() + 5e-5);
        damper.drive(end, 5e-5).unwrap();
    }
    damper.particles().collect()
}

#[test]
fn a_size_ratio_of_ten_is_exact_with_every_detector() {
    let reference = run(&mut damper(AllPairs, 150), 2000);
    let linked = run(&mut damper(LinkedCells::new(), 150), 2000);
    let skinned = Skin::new(LinkedCells::new(), 0.5).unwrap();
    let skinned = run(&mut damper(skinned, 150), 2000);
    let grid = run(&mut damper(CellGrid::new(12, 14).unwrap(), 150), 2000);
    assert_eq!(linked, reference);
    assert_eq!(skinned, reference);
    assert_eq!(grid, reference);
}

/// The levels of linked cells find what testing every pair finds. How fast they are is measured by the
/// group `space_mixed` of the bench `detect`.
#[test]
fn levels_of_cells_lose_no_pair_of_unlike_sizes() {
    let (_, particles, cavity) = bed(2000, 15);
    let positions: Vec<DVec3> = particles.iter().map(|p| p.position).collect();
    let radii: Vec<f64> = particles.iter().map(|p| p.radius).collect();
    let bed = Bed::new(&positions, &radii, cavity.bounds()).with_margin(1e-4);
    let found_by = |detector: &mut dyn Detector| {
        detector.prepare(&bed).unwrap();
        let mut pairs = Pairs::default();
        detector.detect(&bed, &mut pairs);
        let mut pairs = pairs.as_slice().to_vec();
        pairs.sort_unstable();
        pairs
    };
    let linked = found_by(&mut LinkedCells::new());
    assert!(!linked.is_empty());
    assert_eq!(linked, found_by(&mut AllPairs));
}

/// Speed after over speed before a ball of `material` meets a wall of `walls`.
fn rebound(materials: &Materials, material: u16, walls: u16) -> f64 {
    let id = particle_damper::MaterialId;
    let ball = Particle::new(3e-3, 0.2e-3).unwrap().of(id(material));
    let ball = ball.at(dvec3(3.1e-3, 0.03, 0.0)).moving(DVec3::NEG_X);
    let law = HertzTsuji::new(materials.clone()).damping(particle_damper::Damping::Tsuji);
    let mut damper = Damper::builder(Slot::paper(), law)
        .walls_of(id(walls))
        .particles([ball])
        .gravity(DVec3::ZERO)
        .time_step(2e-7)
        .build()
        .unwrap();
    for _ in 0..10_000 {
        damper.step().unwrap();
    }
    damper.particle(0).unwrap().velocity.x
}

#[test]
fn pairs_meet_as_named_and_else_by_the_geometric_mean() {
    let soft = |e: f64| {
        let interaction = Interaction::new(e, 0.1).unwrap();
        Material::new(0.4e9, 0.3, interaction).unwrap()
    };
    let mut materials = Materials::from(soft(0.9));
    materials.add(soft(0.4));
    let third = materials.add(soft(0.8));
    let named = Interaction::new(0.7, 0.2).unwrap();
    materials.set_interaction(Materials::FIRST, third, named);
    for (ball, wall, expected) in [
        (0, 0, 0.9),
        (1, 1, 0.4),
        (0, 1, 0.6),
        (1, 0, 0.6),
        (0, 2, 0.7),
        (2, 0, 0.7),
    ] {
        let found = rebound(&materials, ball, wall);
        assert!((found - expected).abs() < 5e-3, "{ball} on {wall}: {found}");
    }
}
