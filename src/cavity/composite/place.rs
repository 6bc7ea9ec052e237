//! From a part, as it was asked for, to a body in its place.

use std::f64::consts::FRAC_PI_2;

use glam::{DMat3, DVec2, DVec3, dvec2};

use super::solid::{Placed, Profile, Solid};
use super::{CompositeError, Part};
use crate::cavity::part::Shape;
use crate::error::{Bound, ValueError};

/// How far a direction may be off the plane z = 0, or off its normal, and be taken for it: rotations that are
/// multiplied a million times are off by less, and over a metre it is a nanometre.
const OFF_PLANE: f64 = 1e-9;

/// What is wrong with a part.
#[derive(Debug)]
pub(super) enum Fault {
    Value(ValueError),
    HollowUnion,
    OutOfPlane(&'static str, DVec3),
}

impl From<ValueError> for Fault {
    fn from(error: ValueError) -> Self {
        Self::Value(error)
    }
}

impl Fault {
    /// The error for the part of a number.
    pub(super) fn of(self, number: usize, part: &Part) -> CompositeError {
        let (part, name) = (number, part.name().to_owned());
        match self {
            Self::Value(error) => CompositeError::Part { part, name, error },
            Self::HollowUnion => CompositeError::HollowUnion { part, name },
            Self::OutOfPlane(quantity, value) => CompositeError::OutOfPlane {
                part,
                name,
                quantity,
                value,
            },
        }
    }
}

/// Puts a part in its place.
pub(super) fn place(part: &Part, planar: bool) -> Result<Placed, Fault> {
    for coordinate in part.at.to_array() {
        Bound::Finite.check("origin (m)", coordinate)?;
    }
    if planar && part.at.z != 0.0 {
        return Err(Fault::OutOfPlane("origin", part.at));
    }
    let mut axes = axes(part)?;
    if planar {
        let across = matches!(part.shape, Shape::Plane | Shape::Union(_));
        axes = in_plane(axes).ok_or(Fault::OutOfPlane("axis", axes.y_axis))?;
        // Planes stand on the plane, and the parts of a union have to share it.
        if across && axes.z_axis.z == 0.0 {
            return Err(Fault::OutOfPlane("axis", axes.y_axis));
        }
    }
    let mut solid = solid(part, planar)?;
    if planar {
        solid.extend_across(&axes);
    }
    Ok(Placed {
        solid,
        hollow: part.hollow,
        origin: part.at,
        axes,
    })
}

/// The axes of a part.
fn axes(part: &Part) -> Result<DMat3, ValueError> {
    let length = Bound::Positive.check("length of the axis", part.axis.length())?;
    let rotation = part.rotation.length();
    Bound::Within(1.0 - 1e-6, 1.0 + 1e-6).check("length of the rotation", rotation)?;
    let turned = DMat3::from_quat(part.rotation.normalize()) * turn_to(part.axis / length);
    // Rounding must not deform it.
    let y = turned.y_axis.normalize();
    let x = turned.x_axis - y * y.dot(turned.x_axis);
    let x = x.normalize();
    Ok(DMat3::from_cols(x, y, x.cross(y)))
}

/// A matrix that turns by the shortest way from y to the unit vector `axis`.
fn turn_to(axis: DVec3) -> DMat3 {
    let DVec3 { x, y, z } = axis;
    if 1.0 + y < 1e-6 {
        // Half a turn about z, and the little that is left.
        let half = DMat3::from_cols(DVec3::NEG_X, DVec3::NEG_Y, DVec3::Z);
        return turn_to(-axis) * half;
    }
    let over = 1.0 / (1.0 + y);
    DMat3::from_cols(
        DVec3::new(1.0 - x * x * over, -x, -x * z * over),
        axis,
        DVec3::new(-x * z * over, -z, 1.0 - z * z * over),
    )
}

/// The axes with one of them exactly along z and the others exactly in the plane z = 0, if they nearly are.
fn in_plane(axes: DMat3) -> Option<DMat3> {
    let snap = |axis: DVec3| {
        if axis.z.abs() < OFF_PLANE {
            Some(DVec3::new(axis.x, axis.y, 0.0).normalize())
        } else if axis.z.abs() > 1.0 - OFF_PLANE {
            Some(DVec3::Z * axis.z.signum())
        } else {
            None
        }
    };
    let [x, y, z] = [axes.x_axis, axes.y_axis, axes.z_axis].map(snap);
    Some(DMat3::from_cols(x?, y?, z?))
}

fn solid(part: &Part, planar: bool) -> Result<Solid, Fault> {
    Ok(match &part.shape {
        Shape::Plane => Solid::HalfSpace,
        Shape::Cylinder { radius } => Solid::Cylinder {
            radius: positive("radius (m)", *radius)?,
        },
        Shape::Capsule { radius, length } => Solid::Capsule {
            half: 0.5 * Bound::NonNegative.check("length (m)", *length)?,
            radius: positive("radius (m)", *radius)?,
        },
        Shape::Block { size, rounding } => block(*size, *rounding)?,
        Shape::Cone { half_angle, tip } => Solid::Revolved(cone(*half_angle, *tip, part.hollow)?),
        Shape::Torus { ring, radius } => Solid::Revolved(torus(*ring, *radius)?),
        Shape::Disc { size, rounding } => Solid::Revolved(disc(*size, *rounding)?),
        Shape::Funnel {
            radii,
            height,
            thickness,
        } => Solid::Revolved(funnel(*radii, *height, *thickness)?),
        Shape::Union(parts) => {
            if part.hollow || parts.iter().any(|part| part.hollow) {
                return Err(Fault::HollowUnion);
            }
            positive("number of bodies", parts.len() as f64)?;
            let parts = parts.iter().map(|part| place(part, planar));
            Solid::Union(parts.collect::<Result<_, _>>()?)
        }
    })
}

fn block(size: DVec3, rounding: f64) -> Result<Solid, ValueError> {
    for edge in size.to_array() {
        positive("edge (m)", edge)?;
    }
    let layer = check_rounding(rounding, 0.5 * size.min_element())?;
    let core = (0.5 * size - layer).max(DVec3::ZERO);
    Ok(Solid::Block { core, layer })
}

fn cone(half_angle: f64, tip: f64, hollow: bool) -> Result<Profile, ValueError> {
    let quantity = "half angle (rad)";
    Bound::Below(FRAC_PI_2).check(quantity, positive(quantity, half_angle)?)?;
    let sharp = if hollow {
        Bound::NonNegative
    } else {
        Bound::Positive
    };
    let layer = sharp.check("radius of the tip (m)", tip)?;
    let sine = libm::sin(half_angle);
    Ok(Profile::Cone {
        sine,
        cosine: libm::cos(half_angle),
        apex: layer / sine,
        layer,
    })
}

fn torus(ring: f64, radius: f64) -> Result<Profile, ValueError> {
    let ring = positive("radius of the ring (m)", ring)?;
    let quantity = "radius of the tube (m)";
    let radius = Bound::Below(ring).check(quantity, positive(quantity, radius)?)?;
    Ok(Profile::Sheet {
        ends: [dvec2(ring, 0.0); 2],
        radius,
    })
}

fn disc([radius, height]: [f64; 2], rounding: f64) -> Result<Profile, ValueError> {
    let size = dvec2(
        positive("radius (m)", radius)?,
        0.5 * positive("height (m)", height)?,
    );
    let layer = check_rounding(rounding, size.min_element())?;
    let core = (size - layer).max(DVec2::ZERO);
    Ok(Profile::Disc { core, layer })
}

fn funnel(radii: [f64; 2], height: f64, thickness: f64) -> Result<Profile, ValueError> {
    for radius in radii {
        Bound::NonNegative.check("radius (m)", radius)?;
    }
    let height = Bound::NonNegative.check("height (m)", height)?;
    Ok(Profile::Sheet {
        ends: [dvec2(radii[0], 0.0), dvec2(radii[1], height)],
        radius: 0.5 * positive("thickness (m)", thickness)?,
    })
}

fn positive(quantity: &'static str, value: f64) -> Result<f64, ValueError> {
    Bound::Positive.check(quantity, value)
}

/// A radius of edges that a body half as thick as `most` can have.
fn check_rounding(rounding: f64, most: f64) -> Result<f64, ValueError> {
    let quantity = "rounding (m)";
    Bound::AtMost(most).check(quantity, positive(quantity, rounding)?)
}
