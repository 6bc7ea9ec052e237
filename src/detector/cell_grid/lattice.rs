//! Where the cells are: Eq. (9) and the layout of rows in memory.

use glam::DVec3;

use crate::detector::Bed;

/// The indices of a cell.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Site {
    pub(super) x: u32,
    pub(super) y: u32,
    pub(super) z: u32,
}

/// The cells of a bounding box. A row is the cells of equal y and z.
#[derive(Debug, Clone)]
pub(super) struct Lattice {
    lower: DVec3,
    /// Cells per metre along each axis.
    density: DVec3,
    /// The highest index along each axis.
    last: Site,
    words_per_row: usize,
}

impl Lattice {
    pub(super) fn single_cell() -> Self {
        Self {
            lower: DVec3::ZERO,
            density: DVec3::ZERO,
            last: Site::default(),
            words_per_row: 1,
        }
    }

    /// Divides the bed's bounds. An axis along which they have no extent, or none that is finite,
    /// gets a single cell, which holds everything.
    pub(super) fn new(cells: [usize; 3], bed: &Bed<'_>) -> Self {
        let [lower, upper] = bed.bounds();
        let extent = upper - lower;
        let axis = |cells: usize, extent: f64| {
            let density = cells as f64 / extent;
            if extent.is_finite() && extent > 0.0 && density.is_finite() {
                (density, cells as u32)
            } else {
                (0.0, 0)
            }
        };
        let (x, last_x) = axis(cells[0], extent.x);
        let (y, last_y) = axis(cells[1], extent.y);
        let (z, last_z) = axis(if bed.is_planar() { 0 } else { cells[2] }, extent.z);
        Self {
            lower,
            density: DVec3::new(x, y, z),
            last: Site {
                x: last_x,
                y: last_y,
                z: last_z,
            },
            words_per_row: last_x as usize / 64 + 1,
        }
    }

    /// Edges of a cell in m; infinite along an axis with a single cell.
    pub(super) fn edges(&self) -> DVec3 {
        self.density.recip()
    }

    pub(super) const fn last(&self) -> Site {
        self.last
    }

    /// The cell of a centre in the container's frame. Along each axis the index never falls as the
    /// coordinate grows.
    #[inline]
    pub(super) fn site(&self, position: DVec3) -> Site {
        let at = (position - self.lower) * self.density + 0.5;
        Site {
            x: below(at.x, self.last.x),
            y: below(at.y, self.last.y),
            z: below(at.z, self.last.z),
        }
    }

    #[inline]
    pub(super) const fn last_x(&self) -> u32 {
        self.last.x
    }

    #[inline]
    pub(super) const fn contains_row(&self, y: u32, z: u32) -> bool {
        y <= self.last.y && z <= self.last.z
    }

    #[inline]
    pub(super) const fn row(&self, y: u32, z: u32) -> usize {
        z as usize * (self.last.y as usize + 1) + y as usize
    }

    /// Where the occupancy bit of a cell is.
    #[inline]
    pub(super) const fn word(&self, row: usize, x: u32) -> usize {
        row * self.words_per_row + x as usize / 64
    }

    #[inline]
    pub(super) const fn cell(&self, row: usize, x: u32) -> usize {
        row * (self.last.x as usize + 1) + x as usize
    }

    pub(super) const fn words(&self) -> usize {
        (self.row(self.last.y, self.last.z) + 1) * self.words_per_row
    }

    pub(super) const fn cells(&self) -> usize {
        self.cell(self.row(self.last.y, self.last.z), self.last.x) + 1
    }
}

/// The largest integer below `at`, between 0 and `last`; 0 if `at` is not a number.
#[inline]
fn below(at: f64, last: u32) -> u32 {
    let whole = at as i64;
    let index = whole.saturating_sub(i64::from(whole as f64 >= at));
    index.clamp(0, i64::from(last)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paper() -> Lattice {
        let bounds = [DVec3::ZERO, DVec3::new(0.060, 0.096, 0.0)];
        Lattice::new([20, 32, 0], &Bed::new(&[], &[], bounds).in_plane(true))
    }

    fn site(x: f64, y: f64) -> [u32; 2] {
        let site = paper().site(DVec3::new(x, y, 0.0));
        assert_eq!(site.z, 0);
        [site.x, site.y]
    }

    #[test]
    fn indices_follow_equation_nine() {
        assert_eq!(site(0.0, 0.0), [0, 0]);
        assert_eq!(site(0.003, 0.006), [1, 2]);
        assert_eq!(site(0.00151, 0.00149), [1, 0]);
        assert_eq!(site(0.060, 0.096), [20, 32]);
    }

    #[test]
    fn a_tie_goes_to_the_lower_cell() {
        assert_eq!(below(1.0, 9), 0);
        assert_eq!(below(1.0 + f64::EPSILON, 9), 1);
    }

    #[test]
    fn centres_outside_are_in_the_nearest_cell() {
        assert_eq!(site(-1.0, 1.0), [0, 32]);
        assert_eq!(site(f64::INFINITY, f64::NEG_INFINITY), [20, 0]);
        assert_eq!(site(f64::MAX, f64::NAN), [20, 0]);
    }

    #[test]
    fn rows_and_cells_fill_their_memory_exactly() {
        let lattice = paper();
        assert_eq!(lattice.cells(), 21 * 33);
        assert_eq!(lattice.words(), 33);
        let bounds = [DVec3::ZERO, DVec3::ONE];
        let fine = Lattice::new([128, 3, 2], &Bed::new(&[], &[], bounds));
        assert_eq!(fine.cells(), 129 * 4 * 3);
        assert_eq!(fine.words(), 3 * 4 * 3);
    }

    #[test]
    fn an_axis_without_extent_has_one_cell() {
        for depth in [0.0, f64::INFINITY, f64::NAN, 1e-320] {
            let bounds = [DVec3::ZERO, DVec3::new(1.0, 1.0, depth)];
            let lattice = Lattice::new([4, 4, 4], &Bed::new(&[], &[], bounds));
            assert_eq!(lattice.last().z, 0, "{depth}");
            assert_eq!(lattice.site(DVec3::splat(0.5)).z, 0);
        }
    }
}
