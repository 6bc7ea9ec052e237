use glam::{DVec3, dvec3};

use super::{Cavity, WallPoint};
use crate::error::{Bound, ValueError};

/// A planar cavity within a circle about the origin: particles move in the plane z = 0 and spin
/// about z. It has no front and back walls.
///
/// Its one wall has the number 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    radius: f64,
}

impl Disc {
    /// A circle of `radius` in m.
    ///
    /// # Errors
    /// If the radius is not positive and finite.
    pub fn new(radius: f64) -> Result<Self, ValueError> {
        Ok(Self {
            radius: Bound::Positive.check("disc radius (m)", radius)?,
        })
    }

    /// Radius in m.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }
}

impl Cavity for Disc {
    fn walls(&self) -> u32 {
        1
    }

    #[inline]
    fn wall(&self, _number: u32, point: DVec3) -> WallPoint {
        WallPoint::inside_sphere(self.radius, dvec3(point.x, point.y, 0.0))
    }

    fn bounds(&self) -> [DVec3; 2] {
        [
            dvec3(-self.radius, -self.radius, 0.0),
            dvec3(self.radius, self.radius, 0.0),
        ]
    }

    fn is_planar(&self) -> bool {
        true
    }
}
