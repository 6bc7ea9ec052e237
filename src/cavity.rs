//! Cavities: the room inside a container, seen from the container's own frame.

use glam::DVec3;

mod composite;
mod cuboid;
mod cylinder;
mod disc;
mod part;
mod slot;
mod sphere;

pub use composite::{Composite, CompositeError};
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use disc::Disc;
pub use part::Part;
pub use slot::Slot;
pub use sphere::Sphere;

/// Where a wall stands to a point inside the cavity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallPoint {
    /// Unit normal of the wall at its point nearest to the centre, into the cavity.
    pub normal: DVec3,
    /// Distance of the point from the wall in m, negative behind it.
    pub distance: f64,
}

impl WallPoint {
    /// The wall of a hollow sphere of `radius` about the origin; at the very centre, where every
    /// direction is as good, the normal is -x.
    #[inline]
    fn inside_sphere(radius: f64, point: DVec3) -> Self {
        Self {
            normal: -point.normalize_or(DVec3::X),
            distance: radius - point.length(),
        }
    }
}

/// The room that holds the particles: a set of numbered walls in the container's frame.
///
/// # Using
/// [`Slot`] and [`Disc`] hold motion to a plane; [`Cuboid`], [`Cylinder`] and [`Sphere`] are rooms in
/// space. A [`Composite`] is any of both, put together from [`Part`]s: bodies and obstacles at any angle. A
/// damper asks the cavity for everything it needs; user code only builds it.
///
/// # Implementing
/// 1. Walls are numbered from 0 to [`walls`](Self::walls) (excluded), and each is a smooth surface: a
///    sphere touches a wall at one point at the most. A corner is two walls.
/// 2. [`wall`](Self::wall) gives a signed distance that is right to rounding within one particle
///    radius of the wall, on both sides; in an obstacle that is thinner, up to its middle. Farther inside it
///    may be any larger number.
/// 3. The distance never changes by more than the point moves (it is 1-Lipschitz).
/// 4. [`bounds`](Self::bounds) encloses every point with all distances positive.
/// 5. A planar cavity has all normals in the plane z = 0.
///
/// A half-space above a floor:
/// ```
/// use glam::{DVec3, dvec3};
/// use particle_damper::cavity::{Cavity, WallPoint};
///
/// #[derive(Clone)]
/// struct Floor;
///
/// impl Cavity for Floor {
///     fn walls(&self) -> u32 {
///         1
///     }
///     fn wall(&self, _number: u32, point: DVec3) -> WallPoint {
///         WallPoint { normal: DVec3::Y, distance: point.y }
///     }
///     fn bounds(&self) -> [DVec3; 2] {
///         [dvec3(-1.0, 0.0, -1.0), dvec3(1.0, 1.0, 1.0)]
///     }
/// }
/// assert_eq!(Floor.wall(0, dvec3(0.2, 0.3, 0.0)).distance, 0.3);
/// ```
pub trait Cavity: Sync {
    /// How many walls there are.
    fn walls(&self) -> u32;

    /// The wall of a number, as it stands to `point` (m, container's frame).
    fn wall(&self, number: u32, point: DVec3) -> WallPoint;

    /// The lower and the upper corner of a box that holds the room, in m.
    fn bounds(&self) -> [DVec3; 2];

    /// Whether motion is held to the plane z = 0, with spin about z alone.
    fn is_planar(&self) -> bool {
        false
    }

    /// A name for a wall, for tables and messages.
    #[allow(clippy::unnecessary_literal_bound)]
    fn wall_name(&self, _number: u32) -> &str {
        "wall"
    }

    /// Whether a wall is nearer to `point` than `reach` (m). Cavities of many walls may have a quicker answer
    /// than the distance.
    #[inline]
    fn reaches(&self, number: u32, point: DVec3, reach: f64) -> bool {
        self.wall(number, point).distance < reach
    }

    /// The least thickness of an obstacle in m: what is so fast that it could pass through one within a step
    /// is an error. Infinite where nothing that could be passed stands in the room.
    fn thickness(&self) -> f64 {
        f64::INFINITY
    }

    /// The least radius to which a wall's hollow edges are rounded, in m: a larger particle would touch that
    /// wall at two points, and is refused. Infinite where there are none.
    fn rounding(&self) -> f64 {
        f64::INFINITY
    }
}

macro_rules! forward_cavity {
    ($reference:ty) => {
        impl<C: Cavity + ?Sized> Cavity for $reference {
            fn walls(&self) -> u32 {
                (**self).walls()
            }

            #[inline]
            fn wall(&self, number: u32, point: DVec3) -> WallPoint {
                (**self).wall(number, point)
            }

            fn bounds(&self) -> [DVec3; 2] {
                (**self).bounds()
            }

            fn is_planar(&self) -> bool {
                (**self).is_planar()
            }

            fn wall_name(&self, number: u32) -> &str {
                (**self).wall_name(number)
            }

            #[inline]
            fn reaches(&self, number: u32, point: DVec3, reach: f64) -> bool {
                (**self).reaches(number, point, reach)
            }

            fn thickness(&self) -> f64 {
                (**self).thickness()
            }

            fn rounding(&self) -> f64 {
                (**self).rounding()
            }
        }
    };
}

forward_cavity!(&C);
forward_cavity!(Box<C>);

/// The least distance of `point` from any wall of `cavity`, in m; infinite without walls.
pub(crate) fn clearance<C: Cavity + ?Sized>(cavity: &C, point: DVec3) -> f64 {
    (0..cavity.walls())
        .map(|number| cavity.wall(number, point).distance)
        .fold(f64::INFINITY, f64::min)
}

/// The wall of an axis-aligned box with the corners `low` and `high`: numbers 2a and 2a + 1 are the
/// lower and the upper wall of axis a.
#[inline]
fn box_wall(low: DVec3, high: DVec3, number: u32, point: DVec3) -> WallPoint {
    let axis = number as usize / 2;
    if number.is_multiple_of(2) {
        WallPoint {
            normal: DVec3::AXES[axis],
            distance: point[axis] - low[axis],
        }
    } else {
        WallPoint {
            normal: -DVec3::AXES[axis],
            distance: high[axis] - point[axis],
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::dvec3;
    use proptest::prelude::*;

    use super::*;

    /// The contract of [`Cavity`], at two points given within its bounds widened by half.
    fn holds_the_contract(cavity: &impl Cavity, place: DVec3, step: DVec3) {
        let [low, high] = cavity.bounds();
        let size = (high - low).length();
        let point = low + (high - low) * (place * 2.0 - 0.5);
        let other = point
            + step
                * size
                * if cavity.is_planar() {
                    1.0 - DVec3::Z
                } else {
                    DVec3::ONE
                };
        let h = 1e-6 * size;
        for number in 0..cavity.walls() {
            let at = cavity.wall(number, point);
            let normal = at.normal;
            assert!(
                (normal.length() - 1.0).abs() < 1e-14,
                "wall {number} at {point}"
            );
            assert!(
                !cavity.is_planar() || normal.z == 0.0,
                "wall {number} at {point}"
            );

            let change = (cavity.wall(number, other).distance - at.distance).abs();
            assert!(
                change <= (other - point).length() + 1e-14 * size,
                "wall {number} at {point}"
            );

            // The distance grows along the normal, one to one, short of the far side.
            if at.distance.abs() < 0.1 * size {
                let behind = cavity.wall(number, point - normal * h).distance;
                let before = cavity.wall(number, point + normal * h).distance;
                let growth = (before - behind) / (2.0 * h);
                assert!(
                    (growth - 1.0).abs() < 1e-6,
                    "wall {number} at {point}: {growth}"
                );
                let foot = cavity.wall(number, point - normal * at.distance);
                assert!(
                    foot.distance.abs() < 1e-14 * size,
                    "wall {number} at {point}"
                );
                assert!(
                    (foot.normal - normal).length() < 1e-9,
                    "wall {number} at {point}"
                );
            }
        }
        if clearance(cavity, point) > 0.0 {
            assert!(point.cmpge(low).all() && point.cmple(high).all(), "{point}");
        }
    }

    proptest! {
        #[test]
        fn every_cavity_holds_the_contract(
            place in prop::array::uniform3(0.0..1.0_f64),
            step in prop::array::uniform3(-0.3..0.3_f64),
            sizes in prop::array::uniform3(0.2..2.0_f64),
        ) {
            let (place, step) = (DVec3::from(place), DVec3::from(step));
            let [a, b, c] = sizes;
            let flat = dvec3(place.x, place.y, 0.25);
            holds_the_contract(&Slot::new(a, b).unwrap(), flat, step);
            holds_the_contract(&Disc::new(a).unwrap(), flat, step);
            holds_the_contract(&Cuboid::new(dvec3(a, b, c)).unwrap(), place, step);
            holds_the_contract(&Cylinder::new(a, b).unwrap(), place, step);
            holds_the_contract(&Sphere::new(a).unwrap(), place, step);
        }
    }

    #[test]
    fn centre_and_axis_of_round_cavities_have_a_unit_normal() {
        let sphere = Sphere::new(0.03).unwrap().wall(0, DVec3::ZERO);
        let disc = Disc::new(0.03).unwrap().wall(0, DVec3::ZERO);
        let side = Cylinder::new(0.03, 0.1).unwrap().wall(2, DVec3::Y * 0.05);
        for wall in [sphere, disc, side] {
            assert!((wall.normal.length() - 1.0).abs() < 1e-15, "{wall:?}");
            assert!((wall.distance - 0.03).abs() < 1e-15);
        }
        assert!(disc.normal.z.abs() < 1e-15);
        assert!(side.normal.y.abs() < 1e-15);
        let near = Sphere::new(0.03).unwrap().wall(0, DVec3::X * 1e-310);
        assert!((near.normal.length() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_size_that_is_not_positive_is_refused() {
        assert!(Sphere::new(0.0).is_err());
        assert!(Disc::new(f64::NAN).is_err());
        assert!(Cylinder::new(1.0, -1.0).is_err());
        assert!(Cylinder::new(f64::INFINITY, 1.0).is_err());
    }
}
