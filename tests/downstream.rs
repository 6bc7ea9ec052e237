//! Every trait implemented from outside, with what the crate makes public alone, and run together.

use std::f64::consts::PI;

use particle_damper::cavity::{Cavity, Cuboid, Slot};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::integrator::{Integrator, VelocityVerlet};
use particle_damper::mount::{Mount, SingleDof};
use particle_damper::{
    AllPairs, Bed, Bodies, Body, CellGrid, Contact, ContactForce, ContactLaw, Damper, Detector,
    ForceLaw, HertzTsuji, LinkedCells, Material, Materials, Observer, Pairs, Particle, Skin,
};

#[path = "downstream/parts.rs"]
mod parts;
#[path = "downstream/run_time.rs"]
mod run_time;

use parts::{CundallStrack, HalfPipe, Leapfrog, SpringDashpot, SweepAndPrune, TwoMasses, Watch};

const PIPE: HalfPipe = HalfPipe {
    radius: 0.03,
    length: 0.04,
};
const SPRING: SpringDashpot = SpringDashpot {
    stiffness: 1e4,
    damping: 0.0,
};
const MASSES: TwoMasses = TwoMasses {
    masses: [0.05, 0.03],
    stiffness: [200.0, 100.0],
    speed: 0.3,
};

/// Four particles of two sizes in each pipe.
fn particles() -> Vec<Particle> {
    (0..8_u32)
        .map(|n| {
            let column = f64::from(n % 4);
            let (radius, mass) = if n % 2 == 0 {
                (3e-3, 2e-4)
            } else {
                (2e-3, 6e-5)
            };
            Particle::new(radius, mass)
                .unwrap()
                .at(dvec3(0.007 * column - 0.0105, 0.02, 0.003 * (column - 1.0)))
                .moving(dvec3(0.1, -0.02 * column, 0.05 * column))
                .in_cavity(n / 4)
        })
        .collect()
}

#[test]
fn energy_is_kept_by_an_elastic_law_with_a_leapfrog_on_two_masses() {
    let gravity = DVec3::NEG_Y * 9.81;
    let mut damper = Damper::builder(PIPE, SPRING)
        .another_cavity(PIPE)
        .mount(MASSES)
        .detector(SweepAndPrune::default())
        .integrator(Leapfrog)
        .gravity(gravity)
        .particles(particles())
        .time_step(2e-6)
        .build()
        .unwrap();
    let mut first = None;
    let (mut contacts, mut largest) = (0, 0.0_f64);
    for _ in 0..200_000 {
        let mut watch = Watch {
            stiffness: SPRING.stiffness,
            ..Watch::default()
        };
        damper.step_watched(&mut watch).unwrap();
        let potential: f64 = damper
            .particles()
            .map(|p| -p.mass * gravity.dot(p.position))
            .sum();
        let mount = MASSES.energy(damper.coordinates(), damper.rates());
        let energy = damper.kinetic_energy() + potential + mount + watch.stored;
        let start = *first.get_or_insert(energy);
        largest = largest.max((energy / start - 1.0).abs());
        contacts += watch.contacts;
        let reaction = damper.reaction(0).unwrap().force;
        assert!((reaction - watch.on_first).length() <= 1e-12 * reaction.length());
    }
    assert!(contacts > 5_000, "{contacts}");
    assert!(largest < 1e-3, "{largest}");
    assert_eq!(damper.outside(), 0);
}

#[test]
fn momentum_along_the_line_of_two_free_masses_is_kept() {
    let mount = TwoMasses {
        stiffness: [0.0, 100.0],
        ..MASSES
    };
    let law = CundallStrack {
        normal: SpringDashpot {
            stiffness: 1e4,
            damping: 0.3,
        },
        stiffness: 5e3,
        friction: 0.4,
    };
    let mut damper = Damper::builder(PIPE, law)
        .another_cavity(PIPE)
        .mount(mount)
        .detector(SweepAndPrune::default())
        .integrator(Leapfrog)
        .particles(particles())
        .time_step(4e-6)
        .build()
        .unwrap();
    let momentum = |damper: &Damper<_, _, TwoMasses, _, _>| {
        let v = damper.rates();
        damper.momentum().x + mount.masses[0] * v[0] + mount.masses[1] * v[1]
    };
    let before = momentum(&damper);
    for _ in 0..100_000 {
        damper.step().unwrap();
    }
    assert!((momentum(&damper) / before - 1.0).abs() < 1e-12);
    // All that friction and damping leave is the motion of the whole, and of what rests in it.
    assert!(damper.particles().all(|p| p.velocity.y.abs() < 0.1));
}

/// All bits of the particles after some steps.
fn trajectory<C, L, M, D, I>(mut damper: Damper<C, L, M, D, I>, steps: usize) -> Vec<[u64; 3]>
where
    C: Cavity,
    L: ContactLaw,
    M: Mount,
    D: Detector,
    I: Integrator,
{
    for _ in 0..steps {
        damper.step().unwrap();
    }
    let vectors = damper
        .particles()
        .flat_map(|p| [p.position, p.velocity, p.spin]);
    vectors.map(|v| v.to_array().map(f64::to_bits)).collect()
}

#[test]
fn detectors_chosen_at_run_time_give_the_same_bits() {
    let law = CundallStrack {
        normal: SpringDashpot {
            stiffness: 1e4,
            damping: 0.3,
        },
        stiffness: 5e3,
        friction: 0.4,
    };
    let run = |detectors: [Box<dyn Detector>; 2]| {
        let damper = Damper::builder(PIPE, law)
            .another_cavity(PIPE)
            .mount(MASSES)
            .detectors(detectors)
            .integrator(Leapfrog)
            .particles(particles())
            .time_step(4e-6)
            .build()
            .unwrap();
        trajectory(damper, 50_000)
    };
    let expected = run([Box::new(AllPairs), Box::new(AllPairs)]);
    let sweep = SweepAndPrune::default;
    assert_eq!(
        run([Box::new(sweep()), Box::new(LinkedCells::new())]),
        expected
    );
    let grid = CellGrid::in_space([8, 4, 6]).unwrap();
    let skin = Skin::new(sweep(), 0.3).unwrap();
    assert_eq!(run([Box::new(grid), Box::new(skin)]), expected);
}

#[test]
fn every_part_can_be_borrowed_or_boxed() {
    let law = HertzTsuji::new(Material::acrylic());
    let bed: Vec<Particle> = particles().into_iter().filter(|p| p.cavity == 0).collect();
    let plain = Damper::builder(PIPE, law.clone())
        .mount(SingleDof::paper())
        .detector(AllPairs)
        .particles(bed.clone())
        .build()
        .unwrap();
    let expected = trajectory(plain, 3000);

    let room: Box<dyn Cavity> = Box::new(PIPE);
    let mut sweep = SweepAndPrune::default();
    let mut oscillator = SingleDof::paper();
    let mount: &mut dyn Mount = &mut oscillator;
    let mut verlet = VelocityVerlet;
    let borrowed = Damper::builder(room, &law)
        .mount(mount)
        .detectors([&mut sweep])
        .integrator(&mut verlet)
        .particles(bed.clone())
        .build()
        .unwrap();
    assert_eq!(trajectory(borrowed, 3000), expected);

    let boxed = Damper::builder(&PIPE, Box::new(law))
        .mount(SingleDof::paper())
        .detectors([Box::new(sweep) as Box<dyn Detector>])
        .particles(bed)
        .build()
        .unwrap();
    assert_eq!(trajectory(boxed, 3000), expected);
}

#[test]
fn observers_pair_up_and_nobody_watches_at_no_cost() {
    let mut damper = Damper::builder(PIPE, SPRING)
        .particles(particles().into_iter().filter(|p| p.cavity == 0))
        .time_step(1e-5)
        .build()
        .unwrap();
    let mut pair = (Watch::default(), (Watch::default(), ()));
    for _ in 0..20_000 {
        damper.step_watched(&mut pair).unwrap();
    }
    assert!(pair.0.contacts > 0);
    assert_eq!(pair.0.contacts, pair.1.0.contacts);
    assert!(!().wants_contacts() && !((), ()).wants_contacts() && pair.wants_contacts());
}

/// A solid sphere on a slope of angle a, sticking, rolls with 5/7 g sin a.
#[test]
fn a_tangential_spring_makes_a_sphere_roll_down_a_slope() {
    let room = Cuboid::new(dvec3(1.0, 0.1, 0.1)).unwrap();
    let law = CundallStrack {
        normal: SpringDashpot {
            stiffness: 1e4,
            damping: 1.0,
        },
        stiffness: 5e3,
        friction: 0.5,
    };
    let (slope, radius) = (0.2_f64, 3e-3);
    let mut damper = Damper::builder(room, law)
        .gravity(dvec3(slope.sin(), -slope.cos(), 0.0) * 9.81)
        .particles([Particle::new(radius, 2e-4)
            .unwrap()
            .at(dvec3(0.1, radius, 0.05))])
        .time_step(1e-5)
        .build()
        .unwrap();
    for _ in 0..30_000 {
        damper.step().unwrap();
    }
    let ball = damper.particle(0).unwrap();
    let speed = 5.0 / 7.0 * 9.81 * slope.sin() * damper.time();
    assert!(
        (ball.velocity.x / speed - 1.0).abs() < 1e-2,
        "{} for {speed}",
        ball.velocity.x
    );
    assert!((-ball.spin.z * radius / speed - 1.0).abs() < 1e-2);
}

/// A linear spring and dashpot has the restitution exp(-pi z/sqrt(1 - z^2)) where it may pull; tested
/// by itself, away from any damper.
#[test]
fn a_law_can_be_tested_by_itself() {
    let sphere = Body::sphere(3e-3, 2e-4, Materials::FIRST);
    let wall = Bodies::new(sphere, Body::wall(Materials::FIRST));
    let longest = SPRING.coefficients(&wall).unwrap();
    assert!((longest - PI * (2e-4_f64 / 1e4).sqrt() / 5.0).abs() < 1e-18);
    let contact = Contact::new(DVec3::Y, 1e-5, DVec3::NEG_Y);
    let damped = SpringDashpot {
        damping: 0.5,
        ..SPRING
    };
    assert!((damped.force(&longest, &contact, &()).normal - 0.6).abs() < 1e-15);
    let leaving = Contact::new(DVec3::Y, 1e-5, DVec3::Y);
    assert_eq!(
        damped.force(&longest, &leaving, &()),
        ContactForce::default()
    );
}

#[test]
fn a_detector_that_invents_particles_is_an_error() {
    #[derive(Debug, Clone)]
    struct Liar(usize, usize);
    impl Detector for Liar {
        fn detect(&mut self, _bed: &Bed<'_>, pairs: &mut Pairs) {
            pairs.push(self.0, self.1);
        }
    }
    for liar in [Liar(0, 7), Liar(1, 1), Liar(usize::MAX, 0)] {
        let built = Damper::builder(Slot::paper(), SPRING)
            .detector(liar.clone())
            .particles([
                Particle::new(3e-3, 2e-4)
                    .unwrap()
                    .at(dvec3(0.01, 0.01, 0.0)),
                Particle::new(3e-3, 2e-4)
                    .unwrap()
                    .at(dvec3(0.03, 0.01, 0.0)),
            ])
            .build();
        let error = built.err().unwrap().to_string();
        assert!(error.contains("proposed the pair"), "{liar:?}: {error}");
    }
}
