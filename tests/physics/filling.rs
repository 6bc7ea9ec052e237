//! Filling a cavity: no overlap, the same bits from the same seed, and an error where there is no
//! room.

use glam::{DVec3, dvec3};
use particle_damper::cavity::{
    Cavity, Composite, Cuboid, Cylinder, Disc, Part, Slot, Sphere, WallPoint,
};
use particle_damper::{
    BuildError, Damper, Filling, FillingError, HertzTsuji, Material, Materials, Particle,
    ValueError,
};
use proptest::prelude::*;

fn ball(radius: f64) -> Particle {
    Particle::with_density(radius, 1190.0).unwrap()
}

/// Every gap to a wall and to another particle is positive.
fn assert_apart<C: Cavity + ?Sized>(cavity: &C, bed: &[Particle]) {
    for (number, particle) in bed.iter().enumerate() {
        for wall in 0..cavity.walls() {
            let gap = cavity.wall(wall, particle.position).distance - particle.radius;
            assert!(gap > 0.0, "particle {number}, wall {wall}: gap {gap}");
        }
        assert!(!cavity.is_planar() || particle.position.z == 0.0);
    }
    // Sorted along x, so that a large bed is checked in no time.
    let mut order: Vec<&Particle> = bed.iter().collect();
    order.sort_by(|a, b| a.position.x.total_cmp(&b.position.x));
    let widest = bed.iter().map(|p| p.radius).fold(0.0, f64::max);
    for (number, a) in order.iter().enumerate() {
        for b in &order[number + 1..] {
            if b.position.x - a.position.x > a.radius + widest {
                break;
            }
            let gap = a.position.distance(b.position) - a.radius - b.radius;
            assert!(
                gap > 0.0,
                "gap {gap} between {} and {}",
                a.position,
                b.position
            );
        }
    }
}

fn bits(bed: &[Particle]) -> Vec<[u64; 3]> {
    bed.iter()
        .map(|p| p.position.to_array().map(f64::to_bits))
        .collect()
}

fn cavities(a: f64, b: f64, c: f64) -> [Box<dyn Cavity>; 5] {
    [
        Box::new(Slot::new(a, b).unwrap()),
        Box::new(Disc::new(0.5 * a).unwrap()),
        Box::new(Cuboid::new(dvec3(a, b, c)).unwrap()),
        Box::new(Cylinder::new(0.5 * a, b).unwrap()),
        Box::new(Sphere::new(0.5 * a).unwrap()),
    ]
}

/// Rooms of about 40 across, composed.
fn composites() -> [(&'static str, Composite); 7] {
    let plane = |axis: DVec3, at: f64| Part::plane().along(axis).at(axis * at);
    let edges =
        [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| [plane(axis, -20.0), plane(-axis, -20.0)]);
    let cube = || edges.concat();
    let tilt = glam::DQuat::from_rotation_x(0.4) * glam::DQuat::from_rotation_z(0.3);
    let turned = |part: Part, at: DVec3| part.turned(tilt).at(tilt * at);
    let tilted = [DVec3::X, DVec3::Y, DVec3::Z]
        .map(|axis| [axis, -axis].map(|axis| turned(Part::plane().along(axis), axis * -20.0)));
    let annulus = [
        Part::cylinder(20.0).inside().along(DVec3::X),
        Part::cylinder(8.0).along(DVec3::X),
        plane(DVec3::X, -20.0),
        plane(DVec3::NEG_X, -20.0),
    ];
    let hopper = [
        Part::cylinder(20.0).inside(),
        plane(DVec3::Y, -20.0),
        plane(DVec3::NEG_Y, -20.0),
        Part::funnel([6.0, 21.0], 15.0, 1.0).at(DVec3::NEG_Y * 8.0),
    ];
    let leaf = || Part::block(dvec3(1.0, 17.0, 50.0), 0.4);
    let slit = [DVec3::Y, DVec3::NEG_Y].map(|side| leaf().at(side * 13.0));
    let baffles = (0..4).map(|n| {
        let axis = glam::DMat3::from_rotation_z(f64::from(n) * 1.57) * DVec3::X;
        Part::rod([axis * 13.0, axis * 20.0], 1.0)
    });
    let drum = Part::cylinder(20.0).along(DVec3::Z).inside();
    let pegs = (0..36).map(|n| {
        let place = dvec3(f64::from(n % 6) - 2.5, f64::from(n / 6) - 2.5, 0.0);
        Part::sphere(1.0).at(place * 7.0)
    });
    [
        ("annulus", Composite::new(annulus).unwrap()),
        ("hopper", Composite::new(hopper).unwrap()),
        (
            "rounded box",
            Composite::new([Part::block(DVec3::splat(40.0), 5.0).inside()]).unwrap(),
        ),
        (
            "slit",
            Composite::new(cube().into_iter().chain(slit)).unwrap(),
        ),
        ("drum", Composite::planar(baffles.chain([drum])).unwrap()),
        (
            "pegs",
            Composite::new(cube().into_iter().chain(pegs)).unwrap(),
        ),
        ("tilted box", Composite::new(tilted.concat()).unwrap()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// As much as a room with obstacles may be expected to hold, wherever down is.
    #[test]
    fn composed_cavities_are_filled_by_their_distance(
        counts in prop::array::uniform3(0..60_usize),
        down in prop::array::uniform3(-1.0..1.0_f64),
        number in 0..7_usize,
        seed in any::<u64>(),
    ) {
        let (name, room) = &composites()[number];
        let mut filling = Filling::new(seed).down(DVec3::from(down));
        for (count, radius) in counts.into_iter().zip([0.6, 0.9, 1.5]) {
            filling = filling.with(count / if room.is_planar() { 2 } else { 1 }, ball(radius));
        }
        let bed = filling.fill(room);
        prop_assert!(bed.is_ok(), "{} {:?}", name, bed);
        let bed = bed.unwrap();
        assert_apart(room, &bed);
        prop_assert_eq!(bits(&bed), bits(&filling.fill(room).unwrap()));
    }

    #[test]
    fn a_bed_has_no_overlap_and_the_same_bits_again_or_is_refused(
        sizes in prop::array::uniform3(4.0..40.0_f64),
        kinds in prop::collection::vec((0..300_usize, 0.4..4.0_f64), 1..4),
        down in prop::array::uniform3(-1.0..1.0_f64),
        number in 0..5_usize,
        seed in any::<u64>(),
    ) {
        let [a, b, c] = sizes;
        let cavity = &cavities(a, b, c)[number];
        let mut filling = Filling::new(seed).down(DVec3::from(down));
        for &(count, radius) in &kinds {
            filling = filling.with(count, ball(radius));
        }
        let wanted: usize = kinds.iter().map(|kind| kind.0).sum();
        match filling.fill(cavity.as_ref()) {
            Ok(bed) => {
                prop_assert_eq!(bed.len(), wanted);
                assert_apart(cavity.as_ref(), &bed);
                let radii = kinds.iter().flat_map(|&(count, r)| std::iter::repeat_n(r, count));
                prop_assert!(bed.iter().map(|p| p.radius).eq(radii));
                let again = filling.fill(cavity.as_ref()).unwrap();
                prop_assert_eq!(bits(&bed), bits(&again));
            }
            Err(FillingError::NoRoom { wanted: asked, placed, .. }) => {
                prop_assert_eq!(asked, wanted);
                prop_assert!(placed < wanted);
            }
            Err(FillingError::TooMuch { volume, room, .. }) => prop_assert!(volume > room),
            Err(other) => prop_assert!(false, "{}", other),
        }
    }

    /// A cavity whose solid part is below a quarter holds any mix of sizes well below its own.
    #[test]
    fn a_loose_bed_is_never_refused(
        counts in prop::array::uniform3(0..60_usize),
        number in 0..5_usize,
        seed in any::<u64>(),
    ) {
        let cavity = &cavities(40.0, 40.0, 40.0)[number];
        let mut filling = Filling::new(seed);
        for (count, radius) in counts.into_iter().zip([0.6, 0.9, 1.5]) {
            filling = filling.with(count / if cavity.is_planar() { 2 } else { 1 }, ball(radius));
        }
        assert_apart(cavity.as_ref(), &filling.fill(cavity.as_ref()).unwrap());
    }
}

#[test]
fn the_paper_slot_holds_every_bed_of_the_paper_and_what_close_rows_hold() {
    let slot = Slot::paper();
    for count in [0, 1, 20, 40, 60, 80, 100, 150, 162] {
        let bed = Filling::new(7).with(count, ball(3e-3)).fill(&slot).unwrap();
        assert_eq!(bed.len(), count);
        assert_apart(&slot, &bed);
    }
    // Eighteen rows of nine.
    let refused = Filling::new(7)
        .with(163, ball(3e-3))
        .fill(&slot)
        .unwrap_err();
    assert_eq!(
        refused,
        FillingError::NoRoom {
            wanted: 163,
            placed: 162,
            radius: 3e-3
        }
    );
    assert_eq!(
        refused.to_string(),
        "found room for 162 of 163 particles; no room for one of radius 0.003 m"
    );
}

#[test]
fn particles_start_near_the_end_that_is_down() {
    let slot = Slot::paper();
    let filling = Filling::new(3).with(20, ball(3e-3));
    let bed = filling.fill(&slot).unwrap();
    assert!(bed.iter().all(|p| p.position.y < 0.02));
    let bed = filling.clone().down(DVec3::X * 9.81).fill(&slot).unwrap();
    assert!(bed.iter().all(|p| p.position.x > 0.04));
    let cuboid = Cuboid::new(dvec3(0.1, 0.2, 0.3)).unwrap();
    let bed = filling.down(DVec3::NEG_Z).fill(&cuboid).unwrap();
    assert!(bed.iter().all(|p| p.position.z < 0.02));
}

#[test]
fn sizes_are_mixed_through_the_bed() {
    let slot = Slot::new(0.1, 0.2).unwrap();
    let bed = Filling::new(5)
        .with(300, ball(1.5e-3))
        .with(60, ball(3e-3))
        .fill(&slot)
        .unwrap();
    let height =
        |bed: &[Particle]| bed.iter().map(|p| p.position.y).sum::<f64>() / bed.len() as f64;
    let (small, large) = (height(&bed[..300]), height(&bed[300..]));
    assert!((small / large - 1.0).abs() < 0.35, "{small} {large}");
}

#[test]
fn another_seed_gives_another_bed_and_the_same_one_the_same_bits_for_good() {
    let slot = Slot::paper();
    let bed = |seed| {
        let bed = Filling::new(seed).with(60, ball(3e-3)).fill(&slot).unwrap();
        bits(&bed)
    };
    assert_eq!(bed(1), bed(1));
    assert_ne!(bed(1), bed(2));
    let digest = bed(1)
        .concat()
        .into_iter()
        .fold(0_u64, |sum, bits| sum.rotate_left(5) ^ bits);
    assert_eq!(
        digest, 0xc4d2_1e31_74c1_3cd2,
        "the beds of all seeds have changed: {digest:#x}"
    );
}

#[test]
fn prototypes_keep_all_but_their_position() {
    let prototype = ball(3e-3)
        .of(Materials::FIRST)
        .in_cavity(1)
        .moving(DVec3::X)
        .spinning(DVec3::Z);
    let bed = Filling::new(1)
        .with(3, prototype)
        .fill(&Slot::paper())
        .unwrap();
    for particle in bed {
        assert_eq!(particle, prototype.at(particle.position));
    }
}

#[test]
fn a_particle_that_just_fits_stands_in_the_middle_of_a_round_cavity() {
    let room = 1.001;
    for cavity in &cavities(2.0 * room, 2.0 * room, 2.0 * room) {
        let filling = Filling::new(1).with(1, ball(1.0));
        assert_apart(cavity.as_ref(), &filling.fill(cavity.as_ref()).unwrap());
        let two = Filling::new(1).with(2, ball(1.0)).fill(cavity.as_ref());
        assert!(two.is_err());
    }
}

#[test]
fn ten_thousand_particles_of_many_radii_fit_into_a_drum() {
    let drum = Cylinder::new(0.05, 0.2).unwrap();
    let filling = (0..10_000_u32).fold(Filling::new(9), |filling, number| {
        filling.with(1, ball(1e-3 * (1.0 + f64::from(number % 100) / 100.0)))
    });
    assert_apart(&drum, &filling.fill(&drum).unwrap());
}

#[test]
fn what_cannot_be_filled_is_refused_with_its_reason() {
    #[derive(Debug)]
    struct Endless;
    impl Cavity for Endless {
        fn walls(&self) -> u32 {
            0
        }
        fn wall(&self, _number: u32, point: DVec3) -> WallPoint {
            WallPoint {
                normal: DVec3::Y,
                distance: point.y,
            }
        }
        fn bounds(&self) -> [DVec3; 2] {
            [DVec3::NEG_INFINITY, DVec3::INFINITY]
        }
    }
    let one = Filling::new(1).with(1, ball(3e-3));
    let value = |result: Result<Vec<Particle>, FillingError>| -> ValueError {
        match result.unwrap_err() {
            FillingError::Value(error) => error,
            other => panic!("{other}"),
        }
    };
    assert_eq!(
        value(one.fill(&Endless)).quantity,
        "bound of the cavity (m)"
    );
    let flat = one.clone().down(DVec3::Z).fill(&Slot::paper());
    assert_eq!(value(flat).quantity, "length of the direction down");
    let mut shrunk = ball(1.0);
    shrunk.radius = f64::NAN;
    let nan = Filling::new(1).with(1, shrunk).fill(&Slot::paper());
    assert_eq!(value(nan).quantity, "particle radius (m)");
    let dust = Filling::new(1).with(1, ball(1e-12)).fill(&Slot::paper());
    assert_eq!(value(dust).quantity, "particle radius (m)");
    assert!(matches!(
        Filling::new(1)
            .with(usize::MAX, ball(3e-3))
            .fill(&Slot::paper()),
        Err(FillingError::TooMuch {
            wanted: usize::MAX,
            ..
        })
    ));
    let large = Filling::new(1).with(1, ball(0.04)).fill(&Slot::paper());
    assert!(matches!(large, Err(FillingError::NoRoom { placed: 0, .. })));
}

/// What fits into a room of the same shape and size, whoever tells its walls, fits in the same places.
#[test]
fn a_box_of_planes_is_filled_as_the_box_is() {
    let size = dvec3(0.04, 0.06, 0.05);
    let planes = DVec3::AXES.map(|axis| {
        let far = Part::plane().along(-axis).at(axis * size.dot(axis));
        [Part::plane().along(axis), far]
    });
    let composed = Composite::new(planes.concat()).unwrap();
    let cuboid = Cuboid::new(size).unwrap();
    assert_eq!(composed.bounds(), cuboid.bounds());
    for count in [20, 300, 700] {
        let filling = Filling::new(4).with(count, ball(2e-3));
        let [one, other] = [filling.fill(&composed), filling.fill(&cuboid)];
        assert_eq!(bits(&one.unwrap()), bits(&other.unwrap()));
    }
}

/// A particle a nanometre larger than its cavity is wide was refused, while overlaps of some per cent pass.
#[test]
fn an_exact_fit_may_be_off_by_rounding_and_by_what_may_be_squeezed() {
    let r = 3e-3;
    for excess in [-1e-9, 0.0, 1e-15, 1e-9] {
        let particle = Particle::new(r + 0.5 * excess, 0.2e-3).unwrap();
        let narrow = Cuboid::new(dvec3(2.0 * r, 0.05, 2.0 * r)).unwrap();
        let bed = Filling::new(1).with(4, particle).fill(&narrow).unwrap();
        assert_eq!(bed.len(), 4);
        let law = HertzTsuji::new(Material::acrylic());
        let mut damper = Damper::builder(narrow, law).particles(bed).build().unwrap();
        for _ in 0..1000 {
            damper.step().unwrap();
        }
        assert!(damper.largest_overlap() < 0.01 * r);
    }
    // Twice the overlap that is allowed, and no more.
    let built = |radius: f64| {
        let particle = Particle::new(radius, 0.2e-3).unwrap();
        let narrow = Slot::new(2.0 * r, 0.05).unwrap();
        Damper::builder(narrow, HertzTsuji::new(Material::acrylic()))
            .particles([particle.at(dvec3(r, 0.02, 0.0))])
            .build()
    };
    assert!(built(1.05 * r).is_ok());
    let error = built(1.06 * r).err().unwrap();
    assert!(
        matches!(error, BuildError::TooLarge { particle: 0, .. }),
        "{error}"
    );
}

#[test]
fn a_bed_without_gravity_is_spread_throughout_the_room() {
    for cavity in cavities(0.06, 0.08, 0.05) {
        let planar = cavity.is_planar();
        // From a few to more than can be strewn at random.
        for share in [0.02, 0.15, 0.3, 0.45] {
            let [low, high] = cavity.bounds();
            let size = high - low;
            // A round room fills half of its bounds or more.
            let room = size.x * size.y * if planar { 1.0 } else { size.z } * 0.52;
            let own = |r: f64| {
                if planar {
                    std::f64::consts::PI * r * r
                } else {
                    4.0 / 3.0 * std::f64::consts::PI * r * r * r
                }
            };
            let count = (share * room / own(2e-3)) as usize;
            let filling = Filling::new(3).with(count, ball(2e-3)).throughout();
            let bed = filling.fill(&cavity).unwrap();
            assert_apart(&cavity, &bed);
            assert_eq!(bits(&bed), bits(&filling.fill(&cavity).unwrap()));
            let middle = 0.5 * (low + high);
            let mean = bed.iter().map(|p| p.position).sum::<DVec3>() / count as f64;
            let off = ((mean - middle) / size).abs();
            let chance = 1.2 / (count as f64).sqrt();
            assert!(off.x < chance && off.y < chance, "{share} {count}: {off}");
            assert!(planar || off.z < chance, "{share} {count}: {off}");
        }
    }
    let mixed = Filling::new(1).with(50, ball(1e-3)).with(5, ball(6e-3));
    let room = Cuboid::new(DVec3::splat(0.06)).unwrap();
    assert_apart(&room, &mixed.throughout().fill(&room).unwrap());
    let full = Filling::new(1).with(10_000, ball(3e-3)).throughout();
    assert!(matches!(
        full.fill(&room),
        Err(FillingError::TooMuch { .. })
    ));
}
