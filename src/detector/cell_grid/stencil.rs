//! Which cells are searched around a centre: the stencil, made from the geometry of the grid.
//!
//! The paper searches the cells within a diameter but for the nearest, which is right for cells about as long
//! as a radius. Here the stencil follows from the contact distance and the edges of a cell, so that a grid of
//! any fineness and shape sees every pair:
//! cells k apart along an axis hold centres that are more than (|k| - 1) edges apart, and a cell is searched if
//! the length of these least distances along the axes is below the reach. Only half of them are taken, those
//! after the own cell in the order of cells, since the other half sees the pair from its side. Cells that follow
//! one another in a row are bits of a word, which is laid over the bits of the occupied cells: up to 64 cells
//! are searched at a time, and empty ones cost nothing.

use super::lattice::Lattice;
use super::reach::cells_within;
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

impl Neighbourhood {
    /// Whether cells that are so many apart along x, y and z are searched, if a diameter is
    /// `thickness` cells long.
    fn includes(self, apart: [u32; 3], thickness: [f64; 3]) -> bool {
        match self {
            Self::Exact => true,
            Self::Paper => {
                let within = |(apart, thickness): (u32, f64)| {
                    f64::from(apart) <= (thickness * (1.0 - 1e-9)).ceil()
                };
                apart.iter().sum::<u32>() > 1 && apart.into_iter().zip(thickness).all(within)
            }
        }
    }
}

/// Consecutive cells of a row, relative to a centre's cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    /// Rows on.
    pub(super) rows: u32,
    /// The first cell, to the right.
    pub(super) right: i32,
    /// One bit for each cell, from the lowest up.
    pub(super) mask: u64,
    /// Where the first cell's bit goes in the board.
    pub(super) shift: u32,
}

/// Windows that together have at most 64 cells, to be searched as one word.
#[derive(Debug, Clone)]
pub(super) struct Board {
    pub(super) windows: Vec<Window>,
    /// Per bit, how many cells on from the centre's that cell is stored.
    pub(super) offsets: [i32; 64],
    /// Bits of the cells that the neighbourhood includes.
    pub(super) seen: u64,
    used: u32,
}

impl Board {
    const EMPTY: Self = Self {
        windows: Vec::new(),
        offsets: [0; 64],
        seen: 0,
        used: 0,
    };
}

/// Half of the cells of the exact neighbourhood, so that each pair of cells is searched once. They
/// are marked with what the neighbourhood includes; what that has beyond cannot hold a contact.
#[derive(Debug, Clone, Default)]
pub(super) struct Stencil {
    boards: Vec<Board>,
}

impl Stencil {
    pub(super) fn new(neighbourhood: Neighbourhood, lattice: &Lattice, bed: &Bed<'_>) -> Self {
        let edges = lattice.edges();
        let reach = lattice.reach();
        let contact = 2.0 * bed.largest_radius() + bed.margin();
        let thickness = edges.map(|edge| contact / edge);
        let [_, most_up, most_back] = reach.cells;

        let mut stencil = Self::default();
        for back in 0..=most_back {
            let lowest = if back == 0 { 0 } else { -(most_up as i32) };
            for up in lowest..=most_up as i32 {
                let away = up.unsigned_abs();
                let gaps = square(gap(back, edges[2])) + square(gap(away, edges[1]));
                let left = square(reach.length) - gaps;
                if left <= 0.0 {
                    continue;
                }
                let side = cells_within(left.sqrt(), edges[0], reach.cells[0]) as i32;
                let rows = (back as usize * lattice.rows_per_layer()) as i32 + up;
                let first = if rows == 0 { 1 } else { -side };
                for right in first..=side {
                    let apart = [right.unsigned_abs(), away, back];
                    let seen = neighbourhood.includes(apart, thickness);
                    stencil.push(rows as u32, right, seen, right == first, lattice);
                }
            }
        }
        stencil
    }

    fn push(&mut self, rows: u32, right: i32, seen: bool, new_row: bool, lattice: &Lattice) {
        let full = self.boards.last().is_none_or(|board| board.used == 64);
        if full {
            self.boards.push(Board::EMPTY);
        }
        let Some(board) = self.boards.last_mut() else {
            return;
        };
        if full || new_row {
            board.windows.push(Window {
                rows,
                right,
                mask: 0,
                shift: board.used,
            });
        }
        if let Some(window) = board.windows.last_mut() {
            window.mask = window.mask << 1 | 1;
        }
        board.offsets[board.used as usize] = lattice.cell(rows, 0) as i32 + right;
        board.seen |= u64::from(seen) << board.used;
        board.used += 1;
    }

    #[inline]
    pub(super) fn boards(&self) -> &[Board] {
        &self.boards
    }
}

fn square(length: f64) -> f64 {
    length * length
}

/// The least distance along an axis between centres that are `cells` apart.
fn gap(cells: u32, edge: f64) -> f64 {
    if cells < 2 {
        0.0
    } else {
        f64::from(cells - 1) * edge
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    /// Cells in the whole neighbourhood but the own one: searched, and of these seen.
    fn size(cells: [usize; 3], radius: f64, neighbourhood: Neighbourhood) -> [u32; 2] {
        let bounds = [DVec3::ZERO, DVec3::new(0.060, 0.096, 0.060)];
        let centre = [DVec3::ZERO];
        let radii = [radius];
        let bed = Bed::new(&centre, &radii, bounds).in_plane(cells[2] == 0);
        let lattice = Lattice::new(cells, &bed);
        let stencil = Stencil::new(neighbourhood, &lattice, &bed);
        let mut size = [0; 2];
        for board in stencil.boards() {
            let searched: u32 = board.windows.iter().map(|w| w.mask.count_ones()).sum();
            assert_eq!(searched, board.used);
            size[0] += 2 * searched;
            size[1] += 2 * board.seen.count_ones();
        }
        size
    }

    #[test]
    fn the_papers_ring_has_twenty_cells() {
        // Cells whose gap is a diameter are searched as well, since coordinates round: 12 more.
        assert_eq!(size([20, 32, 0], 0.003, Neighbourhood::Paper), [36, 20]);
        assert_eq!(size([20, 32, 0], 0.003, Neighbourhood::Exact), [36, 36]);
    }

    #[test]
    fn the_papers_ring_is_one_diameter_thick_on_finer_grids() {
        // 9 by 9, without five and without the corners that are out of reach.
        assert_eq!(size([40, 64, 0], 0.00299, Neighbourhood::Exact), [76, 76]);
        assert_eq!(size([40, 64, 0], 0.00299, Neighbourhood::Paper), [76, 72]);
    }

    #[test]
    fn in_space_the_papers_ring_leaves_out_six_faces_and_the_centre() {
        let size = size([20, 32, 20], 0.00299, Neighbourhood::Paper);
        assert_eq!(size, [124, 118]);
    }

    #[test]
    fn cells_larger_than_the_reach_leave_the_nearest_ring() {
        assert_eq!(size([2, 2, 0], 0.003, Neighbourhood::Exact), [8, 8]);
    }

    #[test]
    fn wide_rows_are_split_over_boards() {
        let size = size([400, 1, 0], 0.003, Neighbourhood::Exact);
        assert_eq!(size[0], 2 * (41 + 83));
    }
}
