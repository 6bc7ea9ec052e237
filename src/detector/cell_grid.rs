//! The cellular automaton of Komatsuzaki & Iwata (2017).

use super::{Bed, Detector, DetectorError, Pairs};
use crate::error::Bound;

mod lattice;
mod reach;
mod stencil;

use lattice::{Lattice, Site};
pub use stencil::Neighbourhood;
use stencil::{Board, Stencil};

/// Marks the end of a chain of particles in one cell.
const END: u32 = u32::MAX;

/// The paper's cellular automaton: every centre occupies a cell, and contacts are sought in the
/// cells around it.
///
/// The cells divide the cavity's bounding box. Along an axis with n cells over the length w, a
/// centre at x from the lower corner is in the cell with the index (Eq. 9)
///
/// i = max{k in Z : k < n x / w + 0.5}
///
/// so indices run from 0 to n. A centre outside the box is in the nearest cell at its border.
///
/// The default [`Neighbourhood::Exact`] finds every pair, whatever the resolution. The cost per
/// detection grows with the particles and the rows of cells in the neighbourhood, not with the
/// cells of the grid: a bit per cell tells whether it is occupied, and empty cells cost nothing.
/// Cells about as long as a radius are a good choice. Particles much smaller than the largest
/// crowd its neighbourhood; [`LinkedCells`](crate::LinkedCells) suits them better.
///
/// T. Komatsuzaki, Y. Iwata, Int. J. Mech. Mater. Des. 13 (2017) 407-417, Sec. 4.1-4.2,
/// doi 10.1007/s10999-016-9344-3.
///
/// ```
/// use particle_damper::{CellGrid, Neighbourhood};
///
/// let exact = CellGrid::paper();
/// let published = CellGrid::paper().with_neighbourhood(Neighbourhood::Paper);
/// let finer = CellGrid::new(40, 64)?;
/// # Ok::<(), particle_damper::DetectorError>(())
/// ```
#[derive(Debug, Clone)]
pub struct CellGrid {
    cells: [usize; 3],
    neighbourhood: Neighbourhood,
    missed: u64,
    lattice: Lattice,
    stencil: Stencil,
    /// One bit per cell; a set bit says that the cell's `first` is valid.
    occupied: Vec<u64>,
    /// Per cell the last particle that entered it.
    first: Vec<u32>,
    /// Per particle the one that entered its cell before it.
    next: Vec<u32>,
    sites: Vec<Site>,
}

impl CellGrid {
    /// The most cells that a grid can have; n + 1 count along an axis divided by n.
    pub const MAX_CELLS: usize = 1 << 24;

    /// A grid of `across` cells along x, the width, and `up` cells along y, the height. It does not
    /// divide z: in space its cells are columns as deep as the cavity.
    ///
    /// Mind the order: the paper names its grids height first, and its 64x40 is `new(40, 64)`.
    ///
    /// # Errors
    /// If either is zero, or the grid has more than [`MAX_CELLS`](Self::MAX_CELLS) cells.
    pub fn new(across: usize, up: usize) -> Result<Self, DetectorError> {
        Bound::AtLeast(1.0).check("cells along x", across as f64)?;
        Bound::AtLeast(1.0).check("cells along y", up as f64)?;
        Self::with_cells([across, up, 0])
    }

    /// A grid of so many cells along x, y and z. A planar cavity needs, and gets, one layer.
    ///
    /// # Errors
    /// If any is zero, or the grid has more than [`MAX_CELLS`](Self::MAX_CELLS) cells.
    pub fn in_space(cells: [usize; 3]) -> Result<Self, DetectorError> {
        Bound::AtLeast(1.0).check("cells along x", cells[0] as f64)?;
        Bound::AtLeast(1.0).check("cells along y", cells[1] as f64)?;
        Bound::AtLeast(1.0).check("cells along z", cells[2] as f64)?;
        Self::with_cells(cells)
    }

    /// The paper's coarsest grid, "32x20": 20 cells along the width (x) and 32 along the height
    /// (y), which are 3 mm long in its container. With the exact neighbourhood.
    #[must_use]
    pub fn paper() -> Self {
        Self::unchecked([20, 32, 0])
    }

    /// The same grid with another neighbourhood.
    #[must_use]
    pub fn with_neighbourhood(mut self, neighbourhood: Neighbourhood) -> Self {
        self.neighbourhood = neighbourhood;
        self
    }

    /// Cells along x, y and z; zero along z if the grid does not divide z.
    #[must_use]
    pub const fn cells(&self) -> [usize; 3] {
        self.cells
    }

    /// Which cells are searched.
    #[must_use]
    pub const fn neighbourhood(&self) -> Neighbourhood {
        self.neighbourhood
    }

    /// How many pairs with a gap below the margin (without a skin: touching pairs) were not
    /// proposed, summed over all detections. Zero for the exact neighbourhood.
    #[must_use]
    pub const fn missed(&self) -> u64 {
        self.missed
    }

    fn with_cells(cells: [usize; 3]) -> Result<Self, DetectorError> {
        let asked = cells.iter().map(|&along| along as f64 + 1.0).product();
        if asked > Self::MAX_CELLS as f64 {
            return Err(DetectorError::TooManyCells {
                cells: asked,
                limit: Self::MAX_CELLS,
            });
        }
        Ok(Self::unchecked(cells))
    }

    fn unchecked(cells: [usize; 3]) -> Self {
        Self {
            cells,
            neighbourhood: Neighbourhood::Exact,
            missed: 0,
            lattice: Lattice::single_cell(),
            stencil: Stencil::default(),
            occupied: vec![0; 2],
            first: vec![END],
            next: Vec::new(),
            sites: Vec::new(),
        }
    }

    fn place(&mut self, bed: &Bed<'_>) {
        self.next.resize(bed.len(), END);
        self.sites.clear();
        for a in 0..bed.len() {
            let site = self.lattice.site(bed.position(a));
            let (word, bit) = self.lattice.bit(site, 0);
            let word = &mut self.occupied[word];
            let first = &mut self.first[self.lattice.cell(site.row, site.x)];
            self.next[a] = if *word >> bit & 1 == 0 { END } else { *first };
            *word |= 1 << bit;
            *first = a as u32;
            self.sites.push(site);
        }
    }

    fn scan(&mut self, bed: &Bed<'_>, pairs: &mut Pairs) {
        let sees_own_cell = self.neighbourhood == Neighbourhood::Exact;
        let mut missed = 0;
        for (a, &site) in self.sites.iter().enumerate() {
            let mut meet = |mut b: u32, seen: bool| {
                while b != END {
                    if bed.are_near(a, b as usize) {
                        if seen {
                            pairs.push(a, b as usize);
                        } else {
                            missed += 1;
                        }
                    }
                    b = self.next[b as usize];
                }
            };
            meet(self.next[a], sees_own_cell);
            let own = self.lattice.cell(site.row, site.x);
            for board in self.stencil.boards() {
                let mut bits = self.lay(board, site);
                while bits != 0 {
                    let bit = bits.trailing_zeros();
                    bits &= bits - 1;
                    let cell = own.wrapping_add_signed(board.offsets[bit as usize] as isize);
                    meet(self.first[cell], board.seen >> bit & 1 == 1);
                }
            }
        }
        self.missed += missed;
    }

    /// The bits of the occupied cells of a board around a site.
    #[inline]
    fn lay(&self, board: &Board, site: Site) -> u64 {
        board.windows.iter().fold(0, |bits, window| {
            let row = site.row + window.rows;
            let (word, bit) = self.lattice.bit(Site { row, ..site }, window.right);
            let low = self.occupied[word] >> bit;
            let high = self.occupied[word + 1] << 1 << (63 - bit);
            bits | ((low | high) & window.mask) << window.shift
        })
    }

    fn clear(&mut self) {
        for &site in &self.sites {
            self.occupied[self.lattice.bit(site, 0).0] = 0;
        }
    }
}

impl Detector for CellGrid {
    fn prepare(&mut self, bed: &Bed<'_>) -> Result<(), DetectorError> {
        self.lattice = Lattice::new(self.cells, bed);
        self.stencil = Stencil::new(self.neighbourhood, &self.lattice, bed);
        self.occupied = vec![0; self.lattice.words()];
        self.first = vec![0; self.lattice.cells()];
        self.next.reserve(bed.len());
        self.sites.reserve(bed.len());
        Ok(())
    }

    fn detect(&mut self, bed: &Bed<'_>, pairs: &mut Pairs) {
        self.place(bed);
        self.scan(bed, pairs);
        self.clear();
    }
}
