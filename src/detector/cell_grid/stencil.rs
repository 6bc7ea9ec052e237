//! Which cells are searched around a centre.

use super::lattice::Lattice;
use crate::detector::Bed;

/// Which cells a [`CellGrid`](super::CellGrid) searches around a centre.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Neighbourhood {
    /// Every cell that can hold a centre within reach: the largest contact distance r1 + r2 plus
    /// the bed's margin. Centres k cells apart along an axis, of edge h, are more than
    /// (|k| - 1) h apart, since Eq. (9) rounds; the cells with a smaller distance than the reach
    /// are searched, the own cell among them.
    #[default]
    Exact,
    /// The paper's (Sec. 4.2): as many cells to each side as a diameter (the largest one, and the
    /// margin) is long, rounded up, without the centre's own cell and the four nearest (in space,
    /// six). With cells as long as a radius these are 20 cells.
    ///
    /// It misses contacts if cells are so long, sqrt 5 h > r1 + r2 (in space sqrt 6 h), that two
    /// centres in adjacent cells can touch. With 32x20 cells and the paper's particles 1.4 % of
    /// touching pairs of random direction are unseen, and 2.8 % of those that overlap by 4 % of a
    /// radius; with 64x40 and finer, none. [`CellGrid::missed`](super::CellGrid::missed) counts
    /// them.
    Paper,
}

/// Part of a row of cells, relative to the centre's. The strips above and behind are whole, the
/// one through the centre begins right of it: so each pair of cells is searched once.
#[derive(Debug, Clone, Copy)]
pub(super) struct Strip {
    /// Rows up (y).
    pub(super) up: i32,
    /// Layers back (z).
    pub(super) back: u32,
    /// Cells to each side that can hold a centre within reach.
    half_width: u32,
    /// Cells to each side that the neighbourhood includes.
    ring: u32,
    /// The number of cells, from the middle to one side, that the neighbourhood leaves out.
    hole: u32,
}

impl Strip {
    /// The first and the last cell to search around `x` in a row that ends with `last`. The first
    /// one exceeds the last if there is none.
    #[inline]
    pub(super) fn span(&self, x: u32, last: u32) -> (u32, u32) {
        let low = if self.up == 0 && self.back == 0 {
            x + 1
        } else {
            x.saturating_sub(self.half_width)
        };
        (low, x.saturating_add(self.half_width).min(last))
    }

    /// Whether the neighbourhood includes the cells `across` from the middle.
    #[inline]
    pub(super) const fn sees(&self, across: u32) -> bool {
        self.hole <= across && across <= self.ring
    }
}

#[derive(Debug, Clone)]
pub(super) struct Stencil {
    strips: Vec<Strip>,
    sees_own_cell: bool,
}

impl Default for Stencil {
    fn default() -> Self {
        Self {
            strips: Vec::new(),
            sees_own_cell: true,
        }
    }
}

impl Stencil {
    /// The strips of the exact neighbourhood, marked with what `neighbourhood` includes of them:
    /// what it has beyond those cannot hold a contact.
    pub(super) fn new(neighbourhood: Neighbourhood, lattice: &Lattice, bed: &Bed<'_>) -> Self {
        let diameter = 2.0 * bed.largest_radius() + bed.margin();
        let [lower, upper] = bed.bounds();
        // Far above what rounding can move a centre across the border of a cell.
        let rounding = 1e-9 * diameter + 1e-14 * lower.abs().max(upper.abs()).max_element();
        let reach = diameter + rounding;
        let edges = lattice.edges();
        let last = lattice.last();
        let ring = |edge: f64| match neighbourhood {
            Neighbourhood::Exact => u32::MAX,
            Neighbourhood::Paper => (diameter / edge * (1.0 - 1e-9)).ceil() as u32,
        };
        let hole = |away: u32| match neighbourhood {
            Neighbourhood::Exact => 0,
            Neighbourhood::Paper => 2_u32.saturating_sub(away),
        };

        let mut strips = Vec::new();
        for back in 0..=cells_within(reach, edges.z, last.z) {
            let up_to = cells_within(reach, edges.y, last.y) as i32;
            for up in if back == 0 { 0 } else { -up_to }..=up_to {
                let away = up.unsigned_abs();
                let left = reach.powi(2) - gap(back, edges.z).powi(2) - gap(away, edges.y).powi(2);
                if left <= 0.0 {
                    continue;
                }
                let beyond = away > ring(edges.y) || back > ring(edges.z);
                strips.push(Strip {
                    up,
                    back,
                    half_width: cells_within(left.sqrt(), edges.x, last.x),
                    ring: ring(edges.x),
                    hole: if beyond { u32::MAX } else { hole(away + back) },
                });
            }
        }
        Self {
            strips,
            sees_own_cell: neighbourhood == Neighbourhood::Exact,
        }
    }

    #[inline]
    pub(super) fn strips(&self) -> &[Strip] {
        &self.strips
    }

    #[inline]
    pub(super) const fn sees_own_cell(&self) -> bool {
        self.sees_own_cell
    }
}

/// The least distance along an axis between centres that are `cells` apart.
fn gap(cells: u32, edge: f64) -> f64 {
    if cells < 2 {
        0.0
    } else {
        f64::from(cells - 1) * edge
    }
}

/// The largest number of cells whose [`gap`] is less than `distance`, and at most `last`.
fn cells_within(distance: f64, edge: f64, last: u32) -> u32 {
    ((distance / edge).ceil() as u32).min(last)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    /// Cells in the whole neighbourhood: (searched, of these seen).
    fn size(cells: [usize; 3], radius: f64, neighbourhood: Neighbourhood) -> [u32; 2] {
        let bounds = [DVec3::ZERO, DVec3::new(0.060, 0.096, 0.060)];
        let centre = [DVec3::ZERO];
        let radii = [radius];
        let bed = Bed::new(&centre, &radii, bounds).in_plane(cells[2] == 0);
        let lattice = Lattice::new(cells, &bed);
        let stencil = Stencil::new(neighbourhood, &lattice, &bed);
        let mut size = [1, u32::from(stencil.sees_own_cell())];
        for strip in stencil.strips() {
            let (low, high) = strip.span(100, 1000);
            for x in low..=high {
                size[0] += 2;
                size[1] += 2 * u32::from(strip.sees(x.abs_diff(100)));
            }
        }
        size
    }

    #[test]
    fn the_papers_ring_has_twenty_cells() {
        // Cells whose gap is a diameter are searched as well, since coordinates round: 12 more.
        assert_eq!(size([20, 32, 0], 0.003, Neighbourhood::Paper), [37, 20]);
        assert_eq!(size([20, 32, 0], 0.003, Neighbourhood::Exact), [37, 37]);
    }

    #[test]
    fn the_papers_ring_is_one_diameter_thick_on_finer_grids() {
        // 9 by 9, without five and without the corners that are out of reach.
        assert_eq!(size([40, 64, 0], 0.00299, Neighbourhood::Exact)[1], 77);
        assert_eq!(size([40, 64, 0], 0.00299, Neighbourhood::Paper)[1], 72);
    }

    #[test]
    fn in_space_the_papers_ring_leaves_out_six_faces_and_the_centre() {
        let [searched, seen] = size([20, 32, 20], 0.00299, Neighbourhood::Paper);
        assert_eq!(searched, 125);
        assert_eq!(seen, 125 - 7);
    }

    #[test]
    fn cells_larger_than_the_reach_leave_the_nearest_ring() {
        assert_eq!(size([2, 2, 0], 0.003, Neighbourhood::Exact), [9, 9]);
    }
}
