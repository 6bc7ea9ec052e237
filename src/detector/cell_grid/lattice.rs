//! Where the cells are: Eq. (9) and the layout of rows in memory.

use glam::DVec3;

use super::reach::Reach;
use crate::detector::Bed;

/// A cell as a row and a place in it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Site {
    pub(super) row: u32,
    pub(super) x: u32,
}

/// The cells of a bounding box. A row is the cells of equal y and z. Rows that stay empty follow
/// each layer, layers that stay empty follow the last one, and bits that stay clear surround each
/// row, so that no search runs over the border.
#[derive(Debug, Clone)]
pub(super) struct Lattice {
    lower: DVec3,
    /// Cells per metre along each axis.
    density: DVec3,
    /// The highest index along each axis.
    last: [u32; 3],
    reach: Reach,
    words_per_row: usize,
}

impl Lattice {
    pub(super) fn single_cell() -> Self {
        Self {
            lower: DVec3::ZERO,
            density: DVec3::ZERO,
            last: [0; 3],
            reach: Reach::default(),
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
        let density = DVec3::new(x, y, z);
        let last = [last_x, last_y, last_z];
        let reach = Reach::new(bed, density.recip().to_array(), last);
        Self {
            lower,
            density,
            last,
            reach,
            words_per_row: (last_x + 2 * reach.cells[0]) as usize / 64 + 1,
        }
    }

    /// Edges of a cell in m; infinite along an axis with a single cell.
    pub(super) fn edges(&self) -> [f64; 3] {
        self.density.recip().to_array()
    }

    pub(super) const fn reach(&self) -> Reach {
        self.reach
    }

    /// The cell of a centre in the container's frame. Along each axis the index never falls as the
    /// coordinate grows.
    #[inline]
    pub(super) fn site(&self, position: DVec3) -> Site {
        let at = (position - self.lower) * self.density + 0.5;
        let [last_x, last_y, last_z] = self.last;
        let layer = below(at.z, last_z) * self.rows_per_layer() as u32;
        Site {
            row: layer + below(at.y, last_y),
            x: below(at.x, last_x),
        }
    }

    /// The word and the bit of a cell that is so many to the right, which may be in the margin.
    #[inline]
    pub(super) const fn bit(&self, site: Site, right: i32) -> (usize, u32) {
        let bit = (site.x + self.reach.cells[0]).wrapping_add_signed(right);
        let word = site.row as usize * self.words_per_row + bit as usize / 64;
        (word, bit % 64)
    }

    /// Where a cell's particles are stored.
    #[inline]
    pub(super) const fn cell(&self, row: u32, x: u32) -> usize {
        row as usize * (self.last[0] as usize + 1) + x as usize
    }

    pub(super) const fn rows_per_layer(&self) -> usize {
        (self.last[1] + 1 + self.reach.cells[1]) as usize
    }

    fn rows(&self) -> usize {
        self.rows_per_layer() * (self.last[2] + 1 + self.reach.cells[2]) as usize
    }

    /// Words for the bits, with one more, so that each has a next.
    pub(super) fn words(&self) -> usize {
        self.rows() * self.words_per_row + 1
    }

    pub(super) fn cells(&self) -> usize {
        self.cell(self.rows() as u32, 0)
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
        let bed = Bed::new(&[DVec3::ZERO], &[0.003], bounds).in_plane(true);
        Lattice::new([20, 32, 0], &bed)
    }

    fn site(x: f64, y: f64) -> [u32; 2] {
        let site = paper().site(DVec3::new(x, y, 0.0));
        [site.x, site.row]
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
    fn the_margins_take_the_reach() {
        let lattice = paper();
        assert_eq!(lattice.reach().cells, [3, 3, 0]);
        assert_eq!(lattice.words(), 33 + 3 + 1);
        assert_eq!(lattice.cells(), 21 * 36);
        let corner = Site { row: 0, x: 0 };
        assert_eq!(lattice.bit(corner, -3), (0, 0));
        assert_eq!(lattice.bit(corner, 23), (0, 26));
    }

    #[test]
    fn an_axis_without_extent_has_one_cell() {
        for depth in [0.0, f64::INFINITY, f64::NAN, 1e-320] {
            let bounds = [DVec3::ZERO, DVec3::new(1.0, 1.0, depth)];
            let lattice = Lattice::new([4, 4, 4], &Bed::new(&[], &[], bounds));
            assert_eq!(lattice.last[2], 0, "{depth}");
            assert_eq!(lattice.site(DVec3::splat(0.5)).row, 2);
        }
    }
}
