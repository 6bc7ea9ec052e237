use glam::DVec3;

use super::{Cavity, WallPoint};
use crate::error::{Bound, ValueError};

/// A hollow sphere about the origin.
///
/// Its one wall has the number 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    radius: f64,
}

impl Sphere {
    /// A hollow sphere of `radius` in m.
    ///
    /// # Errors
    /// If the radius is not positive and finite.
    pub fn new(radius: f64) -> Result<Self, ValueError> {
        Ok(Self {
            radius: Bound::Positive.check("radius of the hollow sphere (m)", radius)?,
        })
    }

    /// Radius in m.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }
}

impl Cavity for Sphere {
    fn walls(&self) -> u32 {
        1
    }

    #[inline]
    fn wall(&self, _number: u32, point: DVec3) -> WallPoint {
        WallPoint::inside_sphere(self.radius, point)
    }

    fn bounds(&self) -> [DVec3; 2] {
        [DVec3::splat(-self.radius), DVec3::splat(self.radius)]
    }
}
