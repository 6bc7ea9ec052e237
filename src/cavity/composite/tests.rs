//! Parts keep the contract of a cavity wherever they are; rooms are bounded, or refused.

use std::f64::consts::PI;

use glam::{DQuat, dvec3};
use proptest::prelude::*;

use super::*;

/// One part of each kind, of sizes around 1.
fn bodies() -> Vec<Part> {
    let plate = Part::block(dvec3(2.0, 0.2, 1.5), 0.1);
    let arm = Part::rod([DVec3::ZERO, dvec3(1.0, 0.7, -0.4)], 0.2);
    vec![
        Part::plane(),
        Part::sphere(0.8),
        Part::cylinder(0.6),
        Part::cone(0.5, 0.1),
        Part::cone(1.1, 0.3),
        Part::capsule(0.4, 1.3),
        Part::torus(0.9, 0.3),
        Part::disc(0.8, 0.5, 0.1),
        Part::block(dvec3(1.0, 0.7, 1.6), 0.2),
        plate.clone(),
        Part::funnel([0.3, 1.1], 0.9, 0.2),
        Part::tube(0.7, 1.2, 0.15),
        Part::orifice(0.5, 1.4, 0.2),
        Part::union([plate.at(DVec3::Y * 0.2), arm]),
    ]
}

fn placed(part: &Part) -> Placed {
    place::place(part, false).unwrap()
}

fn rotation() -> impl Strategy<Value = DQuat> {
    prop::array::uniform4(-1.0..1.0_f64)
        .prop_filter("not nothing", |q| {
            q.iter().map(|c| c * c).sum::<f64>() > 0.01
        })
        .prop_map(|q| DQuat::from_array(q).normalize())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// The contract of a cavity: with a distance that nowhere changes faster than the place, a foot on the
    /// surface proves the distance right.
    #[test]
    fn every_part_holds_the_contract_wherever_it_is(
        rotation in rotation(),
        at in prop::array::uniform3(-3.0..3.0_f64),
        from in prop::array::uniform3(-2.0..2.0_f64),
        step in prop::array::uniform3(-0.5..0.5_f64),
        hollow in any::<bool>(),
    ) {
        let [at, from, step] = [at, from, step].map(DVec3::from);
        let point = at + from;
        for part in bodies() {
            let union = matches!(part.shape, super::super::part::Shape::Union(_));
            let mut body = placed(&part.at(at).turned(rotation));
            let depth = 0.5 * body.thickness();
            body.hollow = hollow && !union;
            let wall = body.wall(point);
            let other = body.wall(point + step);
            prop_assert!((wall.normal.length() - 1.0).abs() < 1e-14, "{:?}", body);
            let change = (other.distance - wall.distance).abs();
            prop_assert!(change <= step.length() + 1e-14, "{:?}", body);
            // Deep in a body its distance is that of the nearer face, and need be no more; nor within a
            // union, where that face may lie in a neighbour.
            let inside = if body.hollow { wall.distance } else { -wall.distance };
            let most = if union { 0.0 } else { depth.min(0.2) };
            if inside < most {
                let foot = body.wall(point - wall.normal * wall.distance);
                prop_assert!(foot.distance.abs() < 1e-14, "{:?} {}", body, foot.distance);
                prop_assert!((foot.normal - wall.normal).length() < 1e-9, "{:?}", body);
            }
        }
    }

    /// A part that is turned and moved stands to a point as it did to where the point was.
    #[test]
    fn a_part_in_place_is_the_part_seen_from_its_frame(
        rotation in rotation(),
        at in prop::array::uniform3(-3.0..3.0_f64),
        from in prop::array::uniform3(-2.0..2.0_f64),
    ) {
        let [at, from] = [at, from].map(DVec3::from);
        for part in bodies() {
            let own = placed(&part).wall(from);
            let there = placed(&part.clone().at(at).turned(rotation)).wall(at + rotation * from);
            prop_assert!((own.distance - there.distance).abs() < 1e-14, "{:?}", part);
            prop_assert!((rotation * own.normal - there.normal).length() < 1e-9, "{:?}", part);
        }
    }

    /// The quick answer is the distance's.
    #[test]
    fn a_wall_reaches_as_far_as_its_distance_says(
        rotation in rotation(),
        point in prop::array::uniform3(-4.0..4.0_f64),
        reach in 0.0..3.0_f64,
        hollow in any::<bool>(),
    ) {
        let shell = Part::sphere(9.0).inside();
        for part in bodies() {
            let union = matches!(part.shape, super::super::part::Shape::Union(_));
            let mut part = part.turned(rotation).at(DVec3::X);
            part.hollow = hollow && !union;
            let room = Composite::new([shell.clone(), part.clone()]).unwrap();
            for wall in 0..2 {
                let point = DVec3::from(point);
                let near = room.wall(wall, point).distance < reach;
                prop_assert_eq!(room.reaches(wall, point, reach), near, "{:?}", part);
            }
        }
    }

    /// No free place is out of bounds, and bounds are not much wider than the room.
    #[test]
    fn bounds_hold_the_room_at_any_angle(
        rotation in rotation(),
        at in prop::array::uniform3(-3.0..3.0_f64),
        sizes in prop::array::uniform3(0.3..2.0_f64),
        places in prop::collection::vec(prop::array::uniform3(0.0..1.0_f64), 50),
    ) {
        let (at, [a, b, c]) = (DVec3::from(at), sizes);
        let put = |part: Part, own: DVec3| part.turned(rotation).at(at + rotation * own);
        let facing = |axis: DVec3, own| put(Part::plane().along(axis), own);
        let ends = [facing(DVec3::Y, DVec3::ZERO), facing(DVec3::NEG_Y, DVec3::Y * b)];
        let sides = [
            facing(DVec3::X, DVec3::ZERO),
            facing(DVec3::NEG_X, DVec3::X * a),
            facing(DVec3::Z, DVec3::ZERO),
            facing(DVec3::NEG_Z, DVec3::Z * c),
        ];
        let drum = put(Part::cylinder(a).inside(), DVec3::ZERO);
        let cone = put(Part::cone(0.6, 0.1).inside(), DVec3::NEG_Y * 0.1);
        // With the corners or rings that enclose each.
        let corner = |n: u32| {
            let pick = |bit: u32, size: f64| if n >> bit & 1 == 0 { 0.0 } else { size };
            dvec3(pick(0, a), pick(1, b), pick(2, c))
        };
        let ring = |n: u32, r: f64, y: f64| {
            let (sine, cosine) = (f64::from(n) * 0.01 * PI).sin_cos();
            dvec3(r * cosine, y, r * sine)
        };
        let wide = (b + 0.1) * 0.6_f64.tan();
        let rooms = [
            (sides.to_vec(), (0..8).map(corner).collect::<Vec<_>>()),
            (vec![drum], (0..400).map(|n| ring(n % 200, a, if n < 200 { 0.0 } else { b })).collect()),
            (vec![cone], (0..200).flat_map(|n| [ring(n, wide, b), ring(n, 0.06, 0.0)]).collect()),
        ];
        for (parts, outline) in rooms {
            let room = Composite::new(ends.iter().cloned().chain(parts)).unwrap();
            let [low, high] = room.bounds();
            for place in &places {
                let point = low + (high - low) * (DVec3::from(*place) * 2.0 - 0.5);
                if super::super::clearance(&room, point) > 0.0 {
                    prop_assert!(point.cmpge(low).all() && point.cmple(high).all());
                }
            }
            let outline: Vec<DVec3> = outline.iter().map(|p| at + rotation * *p).collect();
            let least = outline.iter().fold(DVec3::INFINITY, |a, b| a.min(*b));
            let most = outline.iter().fold(DVec3::NEG_INFINITY, |a, b| a.max(*b));
            let slack = 0.03 * (most - least).length();
            prop_assert!((least - low).min_element() > -1e-12 && (high - most).min_element() > -1e-12);
            prop_assert!((least - low).max_element() < slack && (high - most).max_element() < slack);
        }
    }
}

#[test]
fn upright_bounds_are_exact() {
    let (floor, lid) = (
        Part::plane().at(DVec3::Y * 0.1),
        Part::plane().along(DVec3::NEG_Y).at(DVec3::Y * 0.3),
    );
    let drum = Part::cylinder(0.07).inside();
    let room = Composite::new([floor.clone(), lid.clone(), drum]).unwrap();
    assert_eq!(
        room.bounds(),
        [dvec3(-0.07, 0.1, -0.07), dvec3(0.07, 0.3, 0.07)]
    );
    let cup = Part::disc(0.07, 0.4, 0.01).inside().at(DVec3::Y * 0.2);
    let room = Composite::new([floor, lid, cup]).unwrap();
    assert_eq!(
        room.bounds(),
        [dvec3(-0.07, 0.1, -0.07), dvec3(0.07, 0.3, 0.07)]
    );
    assert!((room.rounding() - 0.01).abs() < 1e-15);
}

#[test]
fn parts_that_cannot_be_are_refused() {
    let shell = || Part::sphere(1.0).inside().named("shell");
    let refused = |part: Part| Composite::new([shell(), part]).unwrap_err();
    for part in [
        Part::sphere(0.0),
        Part::cylinder(f64::NAN),
        Part::capsule(0.1, -1.0),
        Part::cone(0.0, 0.0),
        Part::cone(2.0, 0.0),
        Part::cone(0.4, -1e-3),
        Part::cone(0.4, 0.0),
        Part::torus(0.2, 0.2),
        Part::disc(0.2, 0.1, 0.06),
        Part::disc(0.2, 0.1, 0.0),
        Part::block(dvec3(0.1, -0.1, 0.1), 0.01),
        Part::block(DVec3::splat(0.1), 0.051),
        Part::funnel([-0.1, 0.1], 0.1, 0.01),
        Part::tube(0.1, 0.1, 0.0),
        Part::union([]),
        Part::plane().at(DVec3::NAN),
        Part::plane().along(DVec3::ZERO),
        Part::plane().turned(DQuat::from_xyzw(0.0, 0.0, 0.0, 0.5)),
        Part::union([Part::sphere(-1.0)]),
    ] {
        let error = refused(part.named("it"));
        assert!(
            matches!(&error, CompositeError::Part { part: 1, name, .. } if name == "it"),
            "{error}"
        );
    }
    let error = refused(Part::sphere(-0.2));
    assert_eq!(
        error.to_string(),
        "part 1 (wall): radius (m) must be positive and finite, not -0.2"
    );
    let union = Part::union([Part::sphere(0.1), Part::sphere(0.2).inside()]);
    for part in [union, Part::union([Part::sphere(0.1)]).inside()] {
        assert!(matches!(
            refused(part),
            CompositeError::HollowUnion { part: 1, .. }
        ));
    }
}

#[test]
fn a_room_without_bounds_or_without_room_is_refused() {
    let floor = Part::plane();
    let lid = Part::plane().along(DVec3::NEG_Y).at(DVec3::Y * 0.1);
    let error = Composite::new([floor.clone(), lid.clone()]).unwrap_err();
    assert!(
        matches!(error, CompositeError::Unbounded { axis: DVec3::X, .. }),
        "{error}"
    );
    let pipe = Part::cylinder(0.1).inside();
    let error = Composite::new([pipe.clone(), floor.clone()]).unwrap_err();
    assert!(
        matches!(error, CompositeError::Unbounded { axis: DVec3::Y, .. }),
        "{error}"
    );
    assert!(Composite::new([]).is_err());
    // Solid bodies bound nothing.
    assert!(Composite::new([Part::sphere(0.1)]).is_err());

    let can = [pipe, floor, lid.clone()];
    let with = |part| Composite::new(can.iter().cloned().chain([part]));
    assert!(with(Part::cylinder(0.099)).is_ok());
    let error = with(Part::cylinder(0.101)).unwrap_err();
    let CompositeError::Empty { depth, position } = error else {
        panic!("{error}");
    };
    // The freest place is somewhere at the side.
    assert!(depth > 0.0 && depth < 2e-3, "{depth} {position}");
    let error = with(Part::plane().at(DVec3::Y * 0.2)).unwrap_err();
    assert!(matches!(error, CompositeError::Empty { .. }), "{error}");
}

#[test]
fn what_leaves_the_plane_is_refused() {
    let drum = || Part::cylinder(0.1).along(DVec3::Z).inside();
    assert!(Composite::planar([drum()]).is_ok());
    // A direction that rounding has put off the plane is taken for what it was meant to be.
    let turned = Part::cylinder(0.1)
        .inside()
        .turned(DQuat::from_rotation_x(0.5 * PI));
    let room = Composite::planar([turned, Part::capsule(0.01, 0.02)]).unwrap();
    assert_eq!(
        room.bounds(),
        [dvec3(-0.1, -0.1, 0.0), dvec3(0.1, 0.1, 0.0)]
    );
    for part in [
        Part::sphere(0.01).at(DVec3::Z * 0.01),
        Part::capsule(0.01, 0.02).along(dvec3(0.0, 1.0, 1.0)),
        Part::plane().along(DVec3::Z),
        Part::block(DVec3::splat(0.02), 1e-3).turned(DQuat::from_rotation_x(0.3)),
    ] {
        let error = Composite::planar([drum(), part]).unwrap_err();
        assert!(
            matches!(error, CompositeError::OutOfPlane { part: 1, .. }),
            "{error}"
        );
    }
}

#[test]
fn walls_of_planar_rooms_are_upright_to_the_bit() {
    let turn = DQuat::from_rotation_z(0.7);
    let parts = bodies().into_iter().map(|part| part.turned(turn));
    let union = Part::union([Part::sphere(0.1), Part::rod([DVec3::X, DVec3::Y], 0.1)]);
    let across = [
        Part::disc(0.3, 0.05, 0.02).along(DVec3::Z),
        Part::block(dvec3(0.4, 0.3, 0.01), 2e-3),
        Part::torus(0.9, 0.3).along(DVec3::NEG_Z),
        union.turned(turn),
    ];
    let solid = |part: &Part| !matches!(part.shape, super::super::part::Shape::Union(_));
    for part in parts.filter(solid).chain(across) {
        let shell = Part::sphere(5.0).inside();
        let room = Composite::planar([shell, part]).unwrap();
        for n in 0..900 {
            let point = dvec3(f64::from(n % 30) - 14.5, f64::from(n / 30) - 14.5, 0.0) * 0.11;
            let wall = room.wall(1, point);
            assert!(wall.normal.z == 0.0, "{wall:?} {:?}", room.parts()[1]);
            assert!((wall.normal.length() - 1.0).abs() < 1e-14);
            let foot = point - wall.normal * wall.distance;
            if wall.distance > 0.0 {
                assert!(room.wall(1, foot).distance.abs() < 1e-14);
            }
        }
    }
}
