//! The bounds of a room: of the planes and the hollow bodies that enclose it.

use glam::{DMat3, DVec3};

use super::CompositeError;
use super::solid::{Placed, Profile, Solid};

/// How far out a room may reach, over the size of what it is made of.
const FAR: f64 = 1e4;

/// What places may be wrong by, in the same measure. Where three planes meet is known to some 1e-16 of how far
/// they reach, 1e4, over the determinant of their normals.
const EXACT: f64 = 1e-9;

/// Everything on one side of a plane: `normal . p >= offset`.
#[derive(Debug, Clone, Copy)]
struct HalfSpace {
    normal: DVec3,
    offset: f64,
}

impl HalfSpace {
    fn through(point: DVec3, normal: DVec3) -> Self {
        let offset = normal.dot(point);
        Self { normal, offset }
    }
}

/// The lower and the upper corner of a box that holds the room.
pub(super) fn bounds(parts: &[Placed], planar: bool) -> Result<[DVec3; 2], CompositeError> {
    let mut exact = [DVec3::NEG_INFINITY, DVec3::INFINITY];
    if planar {
        exact[0].z = 0.0;
        exact[1].z = 0.0;
    }
    let mut scale = 0.0_f64;
    for part in parts {
        let [low, high] = part.room();
        exact = [exact[0].max(low), exact[1].min(high)];
        scale = scale.max(part.size());
    }
    let limit = FAR * scale;
    let [low, high] = exact.map(|corner| corner.clamp(DVec3::splat(-limit), DVec3::splat(limit)));
    let mut spaces: Vec<HalfSpace> = parts.iter().flat_map(half_spaces).collect();
    for axis in DVec3::AXES {
        spaces.push(HalfSpace::through(low, axis));
        spaces.push(HalfSpace::through(high, -axis));
    }
    let Some([least, most]) = corners(&spaces, EXACT * scale) else {
        let position = 0.5 * (low + high);
        return Err(super::search::empty(parts, position));
    };
    for axis in 0..3 {
        if !planar || axis < 2 {
            let reach = most[axis].max(-least[axis]);
            if reach >= 0.99 * limit {
                return Err(CompositeError::Unbounded {
                    axis: DVec3::AXES[axis],
                    limit,
                });
            }
        }
    }
    // What is known exactly is not spoilt by rounding.
    let rounding = EXACT * scale;
    let pick = |exact: f64, found: f64| {
        if (exact - found).abs() < rounding {
            exact
        } else {
            found
        }
    };
    let [a, b] = [[low, least], [high, most]].map(|[exact, found]| {
        DVec3::new(
            pick(exact.x, found.x),
            pick(exact.y, found.y),
            pick(exact.z, found.z),
        )
    });
    Ok([a, b])
}

/// The box around the corners of a polyhedron, if it has any.
fn corners(spaces: &[HalfSpace], tolerance: f64) -> Option<[DVec3; 2]> {
    let holds = |point: DVec3| {
        let within = |space: &HalfSpace| space.normal.dot(point) >= space.offset - tolerance;
        spaces.iter().all(within)
    };
    let mut found: Option<[DVec3; 2]> = None;
    for (i, first) in spaces.iter().enumerate() {
        for (j, second) in spaces[..i].iter().enumerate() {
            for third in &spaces[..j] {
                let normals = DMat3::from_cols(first.normal, second.normal, third.normal);
                if normals.determinant().abs() < EXACT {
                    continue;
                }
                let offsets = DVec3::new(first.offset, second.offset, third.offset);
                let point = normals.transpose().inverse() * offsets;
                if holds(point) {
                    let [low, high] = found.unwrap_or([point; 2]);
                    found = Some([low.min(point), high.max(point)]);
                }
            }
        }
    }
    found
}

/// Half-spaces that hold the room, for all that one part tells: a round part touches its own.
fn half_spaces(part: &Placed) -> Vec<HalfSpace> {
    let (origin, axis) = (part.origin, part.axes.y_axis);
    match part.solid {
        Solid::HalfSpace => {
            let normal = if part.hollow { -axis } else { axis };
            vec![HalfSpace::through(origin, normal)]
        }
        Solid::Cylinder { radius } if part.hollow => around(part)
            .map(|across| HalfSpace::through(origin + across * radius, -across))
            .collect(),
        Solid::Revolved(Profile::Cone {
            sine,
            cosine,
            apex,
            layer,
        }) if part.hollow => {
            let tip = HalfSpace::through(origin + axis * (apex - layer), axis);
            around(part)
                .map(|across| HalfSpace::through(origin, axis * sine - across * cosine))
                .chain([tip])
                .collect()
        }
        _ => Vec::new(),
    }
}

/// Sixteen unit vectors around the axis of a part, its own ones exactly.
fn around(part: &Placed) -> impl Iterator<Item = DVec3> {
    const QUARTER: [[f64; 2]; 4] = [
        [1.0, 0.0],
        [0.923_879_532_511_286_7, 0.382_683_432_365_089_8],
        [std::f64::consts::FRAC_1_SQRT_2; 2],
        [0.382_683_432_365_089_8, 0.923_879_532_511_286_7],
    ];
    let [x, z] = [part.axes.x_axis, part.axes.z_axis];
    let quarters = [[x, z], [z, -x], [-x, -z], [-z, x]];
    quarters
        .into_iter()
        .flat_map(|[x, z]| QUARTER.map(|[a, b]| x * a + z * b))
}
