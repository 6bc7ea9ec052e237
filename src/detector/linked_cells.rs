//! Linked cells, with levels for beds of mixed sizes.

use std::ops::Range;

use glam::DVec3;

use super::{Bed, Detector, DetectorError, Pairs};

mod lattice;
mod level;

use lattice::{Extent, Lattice};
use level::Level;

/// The linked-cell method: cells as long as the largest contact distance r1 + r2 plus the margin,
/// so that partners are in the same cell or in two that touch. The usual choice for large beds: a
/// detection costs of the order of N, whatever the size of the cavity.
///
/// A bed whose radii differ by a factor of two or more is split into levels, each with cells for
/// the largest radius that it holds: within a level as above, and each particle looks in those
/// cells of the coarser levels that are within reach (hierarchical grid). So small particles do not
/// crowd the cells of large ones.
///
/// The cells cover the part of the cavity's bounds where there are particles, and become longer
/// rather than many more than these. A detection sorts the particles by cell (counting sort), and
/// reads a row of neighbouring cells as one block of memory.
///
/// M. P. Allen, D. J. Tildesley, Computer Simulation of Liquids, 2nd ed. (2017), Sec. 5.3,
/// doi 10.1093/oso/9780198803195.001.0001; V. Ogarko, S. Luding, Comput. Phys. Commun. 183 (2012)
/// 931-936, doi 10.1016/j.cpc.2011.12.019.
#[derive(Debug, Clone, Default)]
pub struct LinkedCells {
    /// From coarse to fine.
    levels: Vec<Level>,
    /// Per particle its cell.
    cells: Vec<u32>,
    /// Per cell, level after level, the place of its first particle; and the end of the last one.
    starts: Vec<u32>,
    /// The particles in the order of their cells.
    spheres: Vec<Sphere>,
    /// Their numbers.
    numbers: Vec<u32>,
}

/// Partners tested at a time.
const BATCH: usize = 16;

#[derive(Debug, Clone, Copy, Default)]
struct Sphere {
    centre: DVec3,
    radius: f64,
}

impl LinkedCells {
    /// Cells that adapt to the bed.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    fn arrange(&mut self, bed: &Bed<'_>) {
        let extent = Extent::of(bed);
        let mut cells = 0;
        for level in &mut self.levels {
            level.lattice = Lattice::new(&extent, level.edge, level.most_cells, cells);
            cells = level.lattice.cells().end;
        }
        self.starts.clear();
        self.starts.resize(cells + 2, 0);
        self.cells.clear();
        self.spheres.resize(bed.len(), Sphere::default());
        self.numbers.resize(bed.len(), 0);
    }

    /// Sorts the particles by cell.
    fn sort(&mut self, bed: &Bed<'_>) {
        let Some((coarsest, finer)) = self.levels.split_first() else {
            return;
        };
        // A count goes two places behind its cell. Adding up then leaves a cell's start one place
        // behind it, and filling the cell moves that on to the start of the next.
        for (a, &radius) in bed.radii().iter().enumerate() {
            let mut level = coarsest;
            for finer in finer {
                if radius > finer.largest {
                    break;
                }
                level = finer;
            }
            let cell = level.lattice.cell(bed.position(a));
            self.starts[cell + 2] += 1;
            self.cells.push(cell as u32);
        }
        let mut before = 0;
        for start in &mut self.starts {
            before += *start;
            *start = before;
        }
        for (a, (&cell, &radius)) in self.cells.iter().zip(bed.radii()).enumerate() {
            let start = &mut self.starts[cell as usize + 1];
            self.spheres[*start as usize] = Sphere {
                centre: bed.positions[a],
                radius,
            };
            self.numbers[*start as usize] = a as u32;
            *start += 1;
        }
    }

    /// The particles in a block of cells along x.
    #[inline]
    fn block(&self, cells: Range<usize>) -> Range<usize> {
        self.starts[cells.start] as usize..self.starts[cells.end] as usize
    }

    /// Proposes those partners of the particle at `place` that are in the blocks of places `others`.
    #[inline]
    fn meet(
        &self,
        place: usize,
        others: impl IntoIterator<Item = Range<usize>>,
        margin: f64,
        pairs: &mut Pairs,
    ) {
        let Sphere { centre, radius } = self.spheres[place];
        let number = self.numbers[place] as usize;
        // Whether a partner is near is anyone's guess; noting it without a branch is faster.
        let mut near = [0; 4 * BATCH];
        let mut count = 0;
        for block in others {
            let numbers = self.numbers[block.clone()].chunks(BATCH);
            for (others, numbers) in self.spheres[block].chunks(BATCH).zip(numbers) {
                if count > 3 * BATCH {
                    for &partner in &near[..count] {
                        pairs.push(number, partner as usize);
                    }
                    count = 0;
                }
                for (other, &partner) in others.iter().zip(numbers) {
                    let reach = radius + other.radius + margin;
                    near[count % (4 * BATCH)] = partner;
                    count += usize::from(centre.distance_squared(other.centre) < reach * reach);
                }
            }
        }
        for &partner in &near[..count] {
            pairs.push(number, partner as usize);
        }
    }

    /// Pairs of one level: half of the cells around each, so that each pair comes once.
    fn scan_level(&self, lattice: &Lattice, margin: f64, pairs: &mut Pairs) {
        let [columns, rows, layers] = lattice.counts();
        for z in 0..layers {
            for y in 0..rows {
                let row = lattice.row(y, z);
                let above = (y + 1 < rows).then(|| lattice.row(y + 1, z));
                let behind = (z + 1 < layers)
                    .then(|| (y.saturating_sub(1)..rows.min(y + 2)).map(|y| lattice.row(y, z + 1)));
                let mut others = [0; 4];
                let mut count = 0;
                for other in above.into_iter().chain(behind.into_iter().flatten()) {
                    others[count] = other;
                    count += 1;
                }
                for x in 0..columns {
                    let own = self.block(row + x..row + x + 1);
                    if own.is_empty() {
                        continue;
                    }
                    let (low, high) = (x.saturating_sub(1), columns.min(x + 2));
                    let end = self.starts[row + high] as usize;
                    let blocks = others.map(|other| self.block(other + low..other + high));
                    for place in own {
                        let own = std::iter::once(place + 1..end);
                        self.meet(
                            place,
                            own.chain(blocks[..count].iter().cloned()),
                            margin,
                            pairs,
                        );
                    }
                }
            }
        }
    }

    /// Pairs of a particle in `fine` and one in the coarser level `coarse`.
    fn scan_between(&self, fine: &Level, coarse: &Level, bed: &Bed<'_>, pairs: &mut Pairs) {
        let lattice = &coarse.lattice;
        for place in self.block(fine.lattice.cells()) {
            let Sphere { centre, radius } = self.spheres[place];
            let reach = (radius + coarse.largest + bed.margin()) * (1.0 + 1e-9);
            let [left, low, front] = lattice.indices(centre - reach);
            let [right, high, back] = lattice.indices(centre + reach);
            for z in front..=back {
                for y in low..=high {
                    let row = lattice.row(y, z);
                    let block = self.block(row + left..row + right + 1);
                    self.meet(place, [block], bed.margin(), pairs);
                }
            }
        }
    }
}

impl Detector for LinkedCells {
    fn prepare(&mut self, bed: &Bed<'_>) -> Result<(), DetectorError> {
        self.levels = Level::split(bed);
        let cells: usize = self.levels.iter().map(|level| level.most_cells).sum();
        self.starts.clear();
        self.starts.reserve(cells + 2);
        self.cells.clear();
        self.cells.reserve(bed.len());
        self.arrange(bed);
        Ok(())
    }

    fn detect(&mut self, bed: &Bed<'_>, pairs: &mut Pairs) {
        if self.levels.is_empty() {
            self.levels = Level::split(bed);
        }
        self.arrange(bed);
        self.sort(bed);
        for (index, level) in self.levels.iter().enumerate() {
            self.scan_level(&level.lattice, bed.margin(), pairs);
            for coarse in &self.levels[..index] {
                self.scan_between(level, coarse, bed, pairs);
            }
        }
    }
}
