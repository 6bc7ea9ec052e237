//! Cavities: the room inside a container, seen from the container's own frame.

use glam::DVec3;

mod cuboid;
mod slot;

pub use cuboid::Cuboid;
pub use slot::Slot;

/// Where a wall stands to a point inside the cavity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallPoint {
    /// Unit normal of the wall at its point nearest to the centre, into the cavity.
    pub normal: DVec3,
    /// Distance of the point from the wall in m, negative behind it.
    pub distance: f64,
}

/// The room that holds the particles: a set of numbered walls in the container's frame.
///
/// # Using
/// [`Slot`] holds motion to a plane, [`Cuboid`] is a box in space. A damper asks the cavity for
/// everything it needs; user code only builds it.
///
/// # Implementing
/// 1. Walls are numbered from 0 to [`walls`](Self::walls) (excluded), and each is a smooth surface: a
///    sphere touches a wall at one point at the most. A corner is two walls.
/// 2. [`wall`](Self::wall) gives a signed distance that is right to rounding within one particle
///    radius of the wall, on both sides. Farther inside it may be any larger number.
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
pub trait Cavity {
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
    fn wall_name(&self, _number: u32) -> &'static str {
        "wall"
    }
}

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
