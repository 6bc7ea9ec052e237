//! Whether a room has a free place: boxes are cut into halves, the most promising first, as far as its
//! distance function, which changes no more than the place does, leaves hope.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec3;

use super::CompositeError;
use super::solid::Placed;

/// How many boxes are looked at, at the most.
const BOXES: usize = 100_000;

/// A box that may hold a free place.
#[derive(Debug)]
struct Cell {
    middle: DVec3,
    half: DVec3,
    /// The most that the room may be free in it, m.
    hope: f64,
}

impl Cell {
    fn new(parts: &[Placed], middle: DVec3, half: DVec3) -> Self {
        let hope = clearance(parts, middle) + half.length();
        Self { middle, half, hope }
    }
}

impl Ord for Cell {
    fn cmp(&self, other: &Self) -> Ordering {
        self.hope.total_cmp(&other.hope)
    }
}

impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Cell {}

fn clearance(parts: &[Placed], point: DVec3) -> f64 {
    let distances = parts.iter().map(|part| part.wall(point).distance);
    distances.fold(f64::INFINITY, f64::min)
}

/// Refuses a room within `bounds` without a free place.
pub(super) fn check_free(parts: &[Placed], [low, high]: [DVec3; 2]) -> Result<(), CompositeError> {
    let first = Cell::new(parts, 0.5 * (low + high), 0.5 * (high - low));
    let mut best = (first.middle, clearance(parts, first.middle));
    let mut cells = BinaryHeap::from([first]);
    for _ in 0..BOXES {
        if best.1 > 0.0 {
            return Ok(());
        }
        let Some(cell) = cells.pop().filter(|cell| cell.hope > 0.0) else {
            break;
        };
        let axis = cell.half.max_position();
        let step = DVec3::AXES[axis] * (0.5 * cell.half[axis]);
        for middle in [cell.middle - step, cell.middle + step] {
            let free = clearance(parts, middle);
            if free > best.1 {
                best = (middle, free);
            }
            cells.push(Cell::new(parts, middle, cell.half - step));
        }
    }
    Err(empty(parts, best.0))
}

/// The error of a room whose freest place is `position`.
pub(super) fn empty(parts: &[Placed], position: DVec3) -> CompositeError {
    let depth = -clearance(parts, position);
    CompositeError::Empty { position, depth }
}
