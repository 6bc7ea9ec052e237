//! How far a grid searches.

use crate::detector::Bed;

/// How far the exact neighbourhood extends to each side, in cells along x, y and z.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Reach {
    pub(super) length: f64,
    pub(super) cells: [u32; 3],
}

impl Reach {
    /// Of cells with these edges, of which the last along each axis has the index `last`.
    pub(super) fn new(bed: &Bed<'_>, edges: [f64; 3], last: [u32; 3]) -> Self {
        let contact = 2.0 * bed.largest_radius() + bed.margin();
        let [lower, upper] = bed.bounds();
        // Far above what rounding can move a centre across the border of a cell.
        let rounding = 1e-9 * contact + 1e-14 * lower.abs().max(upper.abs()).max_element();
        let length = contact + rounding;
        let cells = |axis: usize| cells_within(length, edges[axis], last[axis]);
        Self {
            length,
            cells: [cells(0), cells(1), cells(2)],
        }
    }
}

/// The largest number of cells whose gap is less than `distance`, and at most `most`.
pub(super) fn cells_within(distance: f64, edge: f64, most: u32) -> u32 {
    ((distance / edge).ceil() as u32).min(most)
}
