//! Cells over the occupied part of the cavity.

use std::ops::Range;

use glam::DVec3;

use crate::detector::Bed;

/// The part of the cavity's bounds where there are particles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    lower: DVec3,
    upper: DVec3,
}

impl Extent {
    /// Along an axis where all particles are outside the bounds, where they are.
    pub(super) fn of(bed: &Bed<'_>) -> Self {
        let mut lower = [f64::INFINITY; 3];
        let mut upper = [f64::NEG_INFINITY; 3];
        for position in bed.positions {
            let position = position.to_array();
            for axis in 0..3 {
                lower[axis] = lower[axis].min(position[axis]);
                upper[axis] = upper[axis].max(position[axis]);
            }
        }
        let [bottom, top] = bed.bounds.map(|corner| corner.to_array());
        for axis in 0..3 {
            let inside = [lower[axis].max(bottom[axis]), upper[axis].min(top[axis])];
            if inside[0] <= inside[1] {
                [lower[axis], upper[axis]] = inside;
            }
        }
        Self {
            lower: lower.into(),
            upper: upper.into(),
        }
    }
}

/// The cells of one level. Particles outside are in the nearest cell at the border, which does not
/// bring any two farther apart.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Lattice {
    lower: DVec3,
    /// Cells per metre along each axis.
    density: DVec3,
    counts: [u32; 3],
    first: usize,
}

impl Lattice {
    /// Cells with edges of at least `edge`, and longer ones if they were more than `most`. The
    /// first of them has the number `first`.
    pub(super) fn new(extent: &Extent, edge: f64, most: usize, first: usize) -> Self {
        let size = extent.upper - extent.lower;
        // Far above what rounding can move a centre across the border of a cell.
        let coordinate = extent.lower.abs().max(extent.upper.abs()).max_element();
        let mut edge = edge * (1.0 + 1e-9) + 1e-14 * coordinate;
        let along = |size: f64, edge: f64| {
            if size > 0.0 && size.is_finite() {
                (size / edge).floor().max(1.0)
            } else {
                1.0
            }
        };
        let counts = loop {
            let counts = size.to_array().map(|size| along(size, edge));
            let excess = counts.iter().product::<f64>() / most as f64;
            if excess <= 1.0 {
                break counts;
            }
            let divided = counts.iter().filter(|&&count| count > 1.0).count();
            edge *= 1.01 * libm::pow(excess, 1.0 / divided as f64);
        };
        let density = |axis: usize| {
            if counts[axis] > 1.0 {
                counts[axis] / size[axis]
            } else {
                0.0
            }
        };
        Self {
            lower: extent.lower,
            density: DVec3::new(density(0), density(1), density(2)),
            counts: counts.map(|count| count as u32),
            first,
        }
    }

    /// Columns, rows and layers of cells: how many along x, y and z.
    pub(super) fn counts(&self) -> [usize; 3] {
        self.counts.map(|count| count as usize)
    }

    /// Numbers of the cells, x running fastest.
    pub(super) fn cells(&self) -> Range<usize> {
        let [columns, rows, layers] = self.counts();
        self.first..self.first + columns * rows * layers
    }

    /// The number of the first cell of a row.
    #[inline]
    pub(super) fn row(&self, y: usize, z: usize) -> usize {
        self.first + (z * self.counts[1] as usize + y) * self.counts[0] as usize
    }

    /// The indices of the cell of a centre in the container's frame. Along each axis the index
    /// never falls as the coordinate grows.
    #[inline]
    pub(super) fn indices(&self, position: DVec3) -> [usize; 3] {
        let at = (position - self.lower) * self.density;
        let [columns, rows, layers] = self.counts;
        [
            (at.x as u32).min(columns - 1) as usize,
            (at.y as u32).min(rows - 1) as usize,
            (at.z as u32).min(layers - 1) as usize,
        ]
    }

    /// The number of the cell of a centre in the container's frame.
    #[inline]
    pub(super) fn cell(&self, position: DVec3) -> usize {
        let [x, y, z] = self.indices(position);
        self.row(y, z) + x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn extent(positions: &[DVec3], bounds: [DVec3; 2]) -> Extent {
        let radii = vec![1.0; positions.len()];
        Extent::of(&Bed::new(positions, &radii, bounds))
    }

    #[test]
    fn the_extent_is_the_occupied_part_of_the_bounds() {
        let bounds = [DVec3::ZERO, DVec3::splat(10.0)];
        let extent = extent(
            &[DVec3::new(1.0, -2.0, 30.0), DVec3::new(3.0, 4.0, 20.0)],
            bounds,
        );
        assert_eq!(extent.lower, DVec3::new(1.0, 0.0, 20.0));
        assert_eq!(extent.upper, DVec3::new(3.0, 4.0, 30.0));
    }

    #[test]
    fn cells_are_no_shorter_than_asked_and_no_more_than_allowed() {
        let corners = [DVec3::ZERO, DVec3::new(10.0, 5.0, 2.0)];
        let extent = extent(&corners, corners);
        let lattice = Lattice::new(&extent, 0.9, 1000, 0);
        assert_eq!(lattice.counts(), [11, 5, 2]);
        for most in [1, 7, 64, 109] {
            let counts = Lattice::new(&extent, 0.9, most, 0).counts();
            let cells: usize = counts.iter().product();
            assert!(cells <= most && 3 * cells >= most, "{counts:?}");
        }
    }

    #[test]
    fn a_size_that_cannot_be_divided_gets_one_cell() {
        let huge = DVec3::splat(f64::MAX);
        for corners in [
            [DVec3::ZERO, DVec3::ZERO],
            [-huge, huge],
            [DVec3::ZERO, DVec3::INFINITY],
            [DVec3::NAN, DVec3::NAN],
        ] {
            let bounds = [DVec3::NEG_INFINITY, DVec3::INFINITY];
            let lattice = Lattice::new(&extent(&corners, bounds), 0.1, 1000, 5);
            assert_eq!(lattice.cells(), 5..6);
            assert_eq!(lattice.cell(DVec3::ONE), 5);
        }
        let none = extent(&[], [DVec3::ZERO, DVec3::ONE]);
        assert_eq!(Lattice::new(&none, 0.0, 1, 0).cells(), 0..1);
    }
}
