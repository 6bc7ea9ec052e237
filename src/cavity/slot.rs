use glam::{DVec3, dvec3};

use super::{Cavity, WallPoint, box_wall};
use crate::error::{Bound, ValueError};

/// A planar cavity between x = 0 and the width and y = 0 and the height: particles move in the
/// plane z = 0 and spin about z. It has no front and back walls, so that a slot one diameter deep
/// (the paper's 96 x 60 x 6 mm container) costs nothing for them.
///
/// Walls: 0 left, 1 right, 2 floor (y = 0), 3 lid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slot {
    size: DVec3,
}

impl Slot {
    /// A slot of `width` (along x) and `height` (along y), in m.
    ///
    /// # Errors
    /// If either is not positive and finite.
    pub fn new(width: f64, height: f64) -> Result<Self, ValueError> {
        Ok(Self {
            size: dvec3(
                Bound::Positive.check("slot width (m)", width)?,
                Bound::Positive.check("slot height (m)", height)?,
                0.0,
            ),
        })
    }

    /// The paper's container: 60 mm wide, 96 mm high.
    #[must_use]
    pub const fn paper() -> Self {
        Self {
            size: dvec3(0.060, 0.096, 0.0),
        }
    }

    /// Width along x in m.
    #[must_use]
    pub const fn width(&self) -> f64 {
        self.size.x
    }

    /// Height along y in m.
    #[must_use]
    pub const fn height(&self) -> f64 {
        self.size.y
    }
}

impl Cavity for Slot {
    fn walls(&self) -> u32 {
        4
    }

    #[inline]
    fn wall(&self, number: u32, point: DVec3) -> WallPoint {
        box_wall(DVec3::ZERO, self.size, number, point)
    }

    fn bounds(&self) -> [DVec3; 2] {
        [DVec3::ZERO, self.size]
    }

    fn is_planar(&self) -> bool {
        true
    }

    fn wall_name(&self, number: u32) -> &'static str {
        ["left", "right", "floor", "lid"][number as usize % 4]
    }
}
