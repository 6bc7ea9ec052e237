use glam::{DVec3, dvec3};

use super::{Cavity, WallPoint};
use crate::error::{Bound, ValueError};

/// An upright cylinder: its axis is the line x = z = 0, its floor y = 0.
///
/// Walls: 0 floor, 1 lid, 2 side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    radius: f64,
    height: f64,
}

impl Cylinder {
    /// A cylinder of `radius` and `height`, in m.
    ///
    /// # Errors
    /// If either is not positive and finite.
    pub fn new(radius: f64, height: f64) -> Result<Self, ValueError> {
        Ok(Self {
            radius: Bound::Positive.check("cylinder radius (m)", radius)?,
            height: Bound::Positive.check("cylinder height (m)", height)?,
        })
    }

    /// Radius in m.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// Height along y in m.
    #[must_use]
    pub const fn height(&self) -> f64 {
        self.height
    }
}

impl Cavity for Cylinder {
    fn walls(&self) -> u32 {
        3
    }

    #[inline]
    fn wall(&self, number: u32, point: DVec3) -> WallPoint {
        match number {
            0 => WallPoint {
                normal: DVec3::Y,
                distance: point.y,
            },
            1 => WallPoint {
                normal: DVec3::NEG_Y,
                distance: self.height - point.y,
            },
            _ => WallPoint::inside_sphere(self.radius, dvec3(point.x, 0.0, point.z)),
        }
    }

    fn bounds(&self) -> [DVec3; 2] {
        [
            dvec3(-self.radius, 0.0, -self.radius),
            dvec3(self.radius, self.height, self.radius),
        ]
    }

    fn wall_name(&self, number: u32) -> &'static str {
        ["floor", "lid", "side"][number as usize % 3]
    }
}
