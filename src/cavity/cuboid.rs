use glam::DVec3;

use super::{Cavity, WallPoint, box_wall};
use crate::error::{Bound, ValueError};

/// A rectangular box in space with one corner at the origin and the others at positive
/// coordinates.
///
/// Walls: 0 and 1 the lower and the upper one of x, 2 and 3 of y, 4 and 5 of z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cuboid {
    size: DVec3,
}

impl Cuboid {
    /// A box of edge lengths `size` in m.
    ///
    /// # Errors
    /// If a length is not positive and finite.
    pub fn new(size: DVec3) -> Result<Self, ValueError> {
        for length in size.to_array() {
            Bound::Positive.check("box edge (m)", length)?;
        }
        Ok(Self { size })
    }

    /// Edge lengths in m.
    #[must_use]
    pub const fn size(&self) -> DVec3 {
        self.size
    }
}

impl Cavity for Cuboid {
    fn walls(&self) -> u32 {
        6
    }

    #[inline]
    fn wall(&self, number: u32, point: DVec3) -> WallPoint {
        box_wall(DVec3::ZERO, self.size, number, point)
    }

    fn bounds(&self) -> [DVec3; 2] {
        [DVec3::ZERO, self.size]
    }

    fn wall_name(&self, number: u32) -> &'static str {
        ["x low", "x high", "y low", "y high", "z low", "z high"][number as usize % 6]
    }
}
