//! Beds in cavities that are composed from parts.

use particle_damper::cavity::{Cavity, Composite, Cuboid, Part};
use particle_damper::glam::{DQuat, DVec3, dvec3};
use particle_damper::{
    ContactLaw, Damper, Filling, HertzTsuji, Material, Motion, Particle, Prescribed,
    RestitutionImpulse, StepError,
};

use super::AnyCavity;
use super::mechanics::{acrylic, paper_particle, steps};

/// The planes of a box of `size` with a corner at the origin, in the order of those of [`Cuboid`].
fn planes(size: DVec3) -> Vec<Part> {
    let pair = |axis: DVec3| {
        let far = Part::plane().along(-axis).at(axis * size.dot(axis));
        [Part::plane().along(axis), far]
    };
    DVec3::AXES.map(pair).concat()
}

/// Bits of positions and spins after a second of shaking.
fn shaken<C: Cavity + Clone, L: ContactLaw>(cavity: C, law: L, time_step: f64) -> Vec<u64> {
    let bed = Filling::new(3).with(60, paper_particle()).fill(&cavity);
    let motion = |time: f64| {
        let (sine, cosine) = (60.0 * time).sin_cos();
        Motion::at(
            dvec3(1e-3, 3e-3, 0.5e-3) * sine,
            dvec3(0.06, 0.18, 0.03) * cosine,
        )
    };
    let mut damper = Damper::builder(cavity, law)
        .mount(Prescribed(motion))
        .particles(bed.unwrap())
        .time_step(time_step)
        .build()
        .unwrap();
    steps(&mut damper, (0.2 / time_step) as usize);
    let vectors = damper.particles().flat_map(|own| [own.position, own.spin]);
    vectors
        .flat_map(|own| own.to_array().map(f64::to_bits))
        .collect()
}

#[test]
fn a_bed_in_a_box_of_planes_is_the_bed_in_the_box_to_the_bit() {
    let size = dvec3(0.024, 0.05, 0.03);
    let composed = Composite::new(planes(size)).unwrap();
    let cuboid = Cuboid::new(size).unwrap();
    let strict = || HertzTsuji::new(Material::acrylic());
    assert_eq!(
        shaken(&composed as AnyCavity<'_>, strict(), 2e-5),
        shaken(cuboid, strict(), 2e-5)
    );
    let coarse = || RestitutionImpulse::new(Material::acrylic());
    assert_eq!(
        shaken(&composed as AnyCavity<'_>, coarse(), 1e-4),
        shaken(cuboid, coarse(), 1e-4)
    );
}

/// Between two cylinders, lying, with a fixed sphere in the way.
fn annulus() -> Composite {
    Composite::new([
        Part::cylinder(0.03).along(DVec3::X).inside().named("shell"),
        Part::cylinder(0.01).along(DVec3::X).named("core"),
        Part::plane()
            .along(DVec3::X)
            .at(DVec3::X * -0.02)
            .named("left"),
        Part::plane()
            .along(DVec3::NEG_X)
            .at(DVec3::X * 0.02)
            .named("right"),
        Part::sphere(6e-3)
            .at(dvec3(0.004, -0.019, 0.003))
            .named("knob"),
    ])
    .unwrap()
}

/// A ball without friction that flies through the annulus keeps its energy. Returns the largest deviation over
/// the energy at first, and how often it struck the obstacles.
fn energy_kept<L: ContactLaw>(law: L, time_step: f64, duration: f64) -> (f64, usize) {
    let ball = paper_particle()
        .at(dvec3(-0.012, -0.02, 0.0))
        .moving(dvec3(0.13, 0.11, 0.47));
    let room = annulus();
    let mut damper = Damper::builder(&room as AnyCavity<'_>, law)
        .particles([ball])
        .gravity(DVec3::ZERO)
        .time_step(time_step)
        .build()
        .unwrap();
    let before = damper.kinetic_energy();
    let (mut worst, mut struck) = (0.0_f64, 0);
    for _ in 0..(duration / time_step) as usize {
        damper.step().unwrap();
        let at_obstacle = [1, 4]
            .iter()
            .any(|wall| damper.wall_load(0, *wall).unwrap().force.length() > 0.0);
        struck += usize::from(at_obstacle);
        if damper.contacts() == 0 {
            worst = worst.max((damper.kinetic_energy() / before - 1.0).abs());
        }
    }
    (worst, struck)
}

#[test]
fn an_elastic_ball_in_an_annulus_keeps_its_energy() {
    let material = || acrylic(1.0, 0.0);
    let (strict, struck) = energy_kept(HertzTsuji::new(material()), 1e-6, 2.0);
    let (coarse, hits) = energy_kept(RestitutionImpulse::new(material()), 1e-4, 20.0);
    assert!(strict < 1e-4 && struck > 100, "{strict} {struck}");
    assert!(coarse < 1e-9 && hits > 10, "{coarse} {hits}");
}

/// Half full rooms of several shapes, with obstacles, at odd angles.
fn half_full() -> [(Composite, usize); 4] {
    let tilt = DQuat::from_rotation_x(0.35) * DQuat::from_rotation_z(0.2);
    let size = dvec3(0.04, 0.05, 0.03);
    let rod = Part::cylinder(4e-3)
        .along(DVec3::Z)
        .at(dvec3(0.02, 0.012, 0.0))
        .named("rod");
    let knob = Part::sphere(5e-3).at(dvec3(0.03, 0.02, 0.02)).named("knob");
    let pegs = planes(size).into_iter().chain([rod, knob]);
    let cone = Part::cone(0.7, 6e-3).inside().at(DVec3::NEG_Y * 0.01);
    let lid = Part::plane().along(DVec3::NEG_Y).at(DVec3::Y * 0.05);
    let ring = Part::torus(0.015, 2e-3)
        .at(DVec3::Y * 0.018)
        .turned(tilt)
        .named("ring");
    let block = Part::block(dvec3(0.05, 0.05, 0.05), 8e-3)
        .inside()
        .turned(tilt);
    let plate = Part::block(dvec3(0.02, 2e-3, 0.03), 1e-3)
        .turned(tilt)
        .at(DVec3::NEG_Y * 0.013)
        .named("plate");
    [
        (annulus(), 120),
        (Composite::new(pegs).unwrap(), 120),
        (Composite::new([cone, lid, ring]).unwrap(), 80),
        (Composite::new([block, plate]).unwrap(), 200),
    ]
}

/// At rest the walls bear the weight, and the obstacles their share.
fn walls_bear_the_weight<L: ContactLaw + Clone>(law: &L, time_step: f64) {
    for (room, count) in half_full() {
        let bed = Filling::new(5)
            .with(count, paper_particle())
            .fill(&room)
            .unwrap();
        let obstacles: Vec<u32> = ["core", "rod", "knob", "ring", "plate"]
            .iter()
            .filter_map(|name| room.wall_named(name))
            .collect();
        let walls = room.walls();
        let mut damper = Damper::builder(&room as AnyCavity<'_>, law.clone())
            .particles(bed)
            .time_step(time_step)
            .build()
            .unwrap();
        steps(&mut damper, (0.5 / time_step) as usize);
        let mean = (0.1 / time_step) as usize;
        let (mut sum, mut borne) = (DVec3::ZERO, 0.0);
        for _ in 0..mean {
            damper.step().unwrap();
            let load = |wall: u32| damper.wall_load(0, wall).unwrap().force;
            sum += (0..walls).map(load).sum::<DVec3>() / mean as f64;
            borne += obstacles
                .iter()
                .map(|wall| load(*wall).length())
                .sum::<f64>()
                / mean as f64;
        }
        let weight = 9.81 * 0.2e-3 * count as f64;
        let off = (sum + DVec3::Y * weight).length() / weight;
        assert!(off < 2e-3, "{off} with {count}");
        assert!(borne > 0.02 * weight, "{borne} of {weight}");
        assert_eq!(damper.outside(), 0);
    }
}

#[test]
fn walls_and_obstacles_bear_the_weight_of_a_bed_at_rest() {
    walls_bear_the_weight(&HertzTsuji::new(Material::acrylic()), 2e-5);
    walls_bear_the_weight(&RestitutionImpulse::new(Material::acrylic()), 1e-4);
}

/// A hopper of an outlet of 20 mm over a bin: grains of 2 mm run out at the rate that Beverloo et al. found,
/// C rho sqrt(g) (D - k d)^(5/2) with C = 0.58 and k = 1.4 (Chem. Eng. Sci. 15 (1961) 260,
/// doi 10.1016/0009-2509(61)85030-6; cones of this angle up to some tenths faster).
fn discharge<L: ContactLaw>(law: L, time_step: f64) {
    const OUTLET: f64 = 0.02;
    const DIAMETER: f64 = 2.5e-3;
    let parts = || {
        vec![
            Part::cylinder(0.02).inside().named("bin"),
            Part::plane().named("floor"),
            Part::plane().along(DVec3::NEG_Y).at(DVec3::Y * 0.12),
            // Its inner rim leaves the outlet.
            Part::funnel([0.5 * OUTLET + 5e-4, 0.0205], 0.012, 1e-3).at(DVec3::Y * 0.04),
        ]
    };
    let room = Composite::new(parts()).unwrap();
    let gate = Part::plane().at(DVec3::Y * 0.041);
    // Grains start on the funnel, and none of them below.
    let sheet = Part::cone(10_f64.atan2(12.0), 0.0)
        .inside()
        .at(DVec3::Y * 0.0282);
    let closed = Composite::new(parts().into_iter().chain([gate, sheet])).unwrap();
    let grain = Particle::with_density(0.5 * DIAMETER, 1190.0).unwrap();
    let count = 1000;
    let bed = Filling::new(2).with(count, grain).fill(&closed).unwrap();
    let mut damper = Damper::builder(&room as AnyCavity<'_>, law)
        .particles(bed)
        .time_step(time_step)
        .build()
        .unwrap();
    let mut times = Vec::new();
    while damper.time() < 0.8 {
        steps(&mut damper, (5e-3 / time_step) as usize);
        let gone = damper
            .particles()
            .filter(|own| own.position.y < 0.039)
            .count();
        times.push((damper.time(), gone));
    }
    let at = |part: f64| {
        let gone = (part * count as f64) as usize;
        times.iter().find(|own| own.1 >= gone).map(|own| own.0)
    };
    let (begin, end) = (at(0.2).unwrap(), at(0.5).unwrap());
    let rate = 0.3 * count as f64 * grain.mass / (end - begin);
    let bulk = 0.6 * 1190.0;
    let expected = 0.58 * bulk * 9.81_f64.sqrt() * (OUTLET - 1.4 * DIAMETER).powf(2.5);
    assert!(
        (0.85..1.4).contains(&(rate / expected)),
        "{rate} against {expected}"
    );
    assert!(times.last().unwrap().1 as f64 > 0.98 * count as f64);
    assert_eq!(damper.outside(), 0);
}

#[test]
fn a_hopper_runs_out_as_fast_as_hoppers_do() {
    discharge(RestitutionImpulse::new(Material::acrylic()), 1e-4);
}

/// Two rooms, joined by a slit in a partition of a third of a grain's radius.
fn two_rooms(planar: bool) -> Composite {
    let across = DVec3::X * 0.03;
    if planar {
        let height = 0.05;
        let end = |y: f64| across + DVec3::Y * y;
        let box_of = planes(dvec3(0.06, height, 1.0)).into_iter().take(4);
        let partition = [
            Part::rod([end(-0.01), end(0.020)], 0.5e-3).named("lower"),
            Part::rod([end(0.025), end(0.06)], 0.5e-3).named("upper"),
        ];
        return Composite::planar(box_of.chain(partition)).unwrap();
    }
    let leaf = || Part::block(dvec3(1e-3, 0.04, 0.1), 0.5e-3);
    let partition = [leaf().at(across), leaf().at(across + DVec3::Y * 0.045)];
    let box_of = planes(dvec3(0.06, 0.05, 0.03));
    Composite::new(box_of.into_iter().chain(partition)).unwrap()
}

/// Grains that fit through a slit of 4 mm change rooms, larger ones never do.
fn stays_or_goes<L: ContactLaw + Clone>(law: &L, time_step: f64) {
    for planar in [true, false] {
        let room = two_rooms(planar);
        let wall = Part::plane().along(DVec3::NEG_X).at(DVec3::X * 0.029);
        let left = room.parts().iter().cloned().chain([wall]);
        let left = if planar {
            Composite::planar(left)
        } else {
            Composite::new(left)
        };
        let small = Particle::with_density(1.2e-3, 1190.0).unwrap();
        let counts = if planar { [12, 25] } else { [60, 120] };
        let bed = Filling::new(7)
            .with(counts[0], paper_particle())
            .with(counts[1], small)
            .fill(&left.unwrap())
            .unwrap();
        let motion = |time: f64| {
            let (sine, cosine) = (100.0 * time).sin_cos();
            Motion::at(
                dvec3(0.4, 0.6, 0.0) * (8e-3 * sine),
                dvec3(0.4, 0.6, 0.0) * (0.8 * cosine),
            )
        };
        let mut damper = Damper::builder(&room as AnyCavity<'_>, law.clone())
            .mount(Prescribed(motion))
            .particles(bed)
            .time_step(time_step)
            .build()
            .unwrap();
        steps(&mut damper, (1.0 / time_step) as usize);
        let origin = damper.container(0).unwrap().position;
        let gone = |large: bool| {
            let of_size = damper
                .particles()
                .filter(|own| (own.radius > 2e-3) == large);
            of_size
                .filter(|own| (own.position - origin).x > 0.03)
                .count()
        };
        assert_eq!(gone(true), 0);
        assert!(gone(false) > 3, "{}", gone(false));
    }
}

#[test]
fn grains_change_rooms_through_a_slit_that_is_wide_enough() {
    stays_or_goes(&RestitutionImpulse::new(Material::acrylic()), 1e-4);
    stays_or_goes(&HertzTsuji::new(Material::acrylic()), 1e-5);
}

/// A ball that is thrown at the partition: it rebounds, or is refused, at every speed and from everywhere.
fn thrown<L: ContactLaw + Clone>(law: &L, time_step: f64) {
    let (mut refused, mut rebounds) = (0, 0);
    let rooms = two_rooms(true);
    for number in 0..200_u32 {
        let ball = paper_particle().at(dvec3(0.01 + 3e-5 * f64::from(number), 0.01, 0.0));
        let speed = 0.05 * 1.05_f64.powi(number as i32);
        let mut damper = Damper::builder(&rooms as AnyCavity<'_>, law.clone())
            .particles([ball.moving(DVec3::X * speed)])
            .gravity(DVec3::ZERO)
            .time_step(time_step)
            .build()
            .unwrap();
        let mut thrown = || {
            for _ in 0..200 {
                damper.step()?;
                let ball = damper.particle(0).unwrap();
                assert!(ball.position.x < 0.03, "{speed}");
                if ball.velocity.x < 0.0 {
                    return Ok(());
                }
            }
            Ok(())
        };
        match thrown() {
            Ok(()) => rebounds += 1,
            Err(
                StepError::TooFast { .. } | StepError::Overlap { .. } | StepError::Escaped { .. },
            ) => {
                refused += 1;
            }
            Err(other) => panic!("{other}"),
        }
    }
    assert!(rebounds > 50 && refused > 10, "{rebounds} {refused}");
}

#[test]
fn nobody_passes_through_a_thin_partition_unseen() {
    thrown(&RestitutionImpulse::new(Material::acrylic()), 1e-4);
    thrown(&HertzTsuji::new(Material::acrylic()), 2e-5);
}

#[test]
fn a_snapshot_knows_the_obstacles() {
    let rooms = [0.02, 0.021].map(|x| {
        let rod = Part::cylinder(3e-3).along(DVec3::Z).at(dvec3(x, 0.02, 0.0));
        let room = planes(DVec3::splat(0.04)).into_iter().chain([rod]);
        Composite::new(room).unwrap()
    });
    let with = |room: usize| {
        let law = HertzTsuji::new(Material::acrylic());
        Damper::builder(&rooms[room] as AnyCavity<'_>, law)
            .particles([paper_particle().at(dvec3(0.006, 0.01, 0.02))])
            .build()
            .unwrap()
    };
    let (mut one, other) = (with(0), with(1));
    assert!(one.restore(&with(0).snapshot()).is_ok());
    let error = one.restore(&other.snapshot()).unwrap_err();
    assert!(error.to_string().contains("cavities"), "{error}");
}
