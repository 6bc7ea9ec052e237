//! Contact detectors (broad phase): which particles might touch.

use glam::DVec3;

use crate::error::ValueError;

mod all_pairs;
mod cell_grid;
mod counted;
mod linked_cells;
mod skin;

pub use all_pairs::AllPairs;
pub use cell_grid::{CellGrid, Neighbourhood};
pub use counted::Counted;
pub use linked_cells::LinkedCells;
pub use skin::Skin;

/// The particles of one cavity, as a detector sees them. Numbers run from 0 to [`len`](Self::len).
#[derive(Debug, Clone, Copy)]
pub struct Bed<'a> {
    positions: &'a [DVec3],
    radii: &'a [f64],
    bounds: [DVec3; 2],
    planar: bool,
    margin: f64,
}

impl<'a> Bed<'a> {
    /// Particles with centres at `positions` (m, container's frame) and `radii` (m), one each, in a
    /// cavity with the bounding box `bounds`. Without margin, in space.
    ///
    /// If the two slices differ in length, the longer one is cut.
    #[must_use]
    pub fn new(positions: &'a [DVec3], radii: &'a [f64], bounds: [DVec3; 2]) -> Self {
        let count = positions.len().min(radii.len());
        Self {
            positions: &positions[..count],
            radii: &radii[..count],
            bounds,
            planar: false,
            margin: 0.0,
        }
    }

    /// The same particles, known to stay in the plane z = 0.
    #[must_use]
    pub const fn in_plane(mut self, planar: bool) -> Self {
        self.planar = planar;
        self
    }

    /// The same particles, with pairs wanted up to a gap of `margin` (m).
    #[must_use]
    pub const fn with_margin(mut self, margin: f64) -> Self {
        self.margin = margin;
        self
    }

    /// How many particles there are.
    #[must_use]
    #[inline]
    pub const fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there are none.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// The centre of a particle in m, in the container's frame.
    ///
    /// # Panics
    /// If the number is not below [`len`](Self::len).
    #[must_use]
    #[inline]
    pub fn position(&self, number: usize) -> DVec3 {
        self.positions[number]
    }

    /// Radii in m.
    #[must_use]
    #[inline]
    pub const fn radii(&self) -> &'a [f64] {
        self.radii
    }

    /// The largest radius in m; zero for an empty bed.
    #[must_use]
    pub fn largest_radius(&self) -> f64 {
        self.radii.iter().copied().fold(0.0, f64::max)
    }

    /// The lower and the upper corner of the cavity's bounding box, in m.
    #[must_use]
    pub const fn bounds(&self) -> [DVec3; 2] {
        self.bounds
    }

    /// Whether all particles are in the plane z = 0.
    #[must_use]
    pub const fn is_planar(&self) -> bool {
        self.planar
    }

    /// The gap in m up to which pairs are wanted.
    #[must_use]
    pub const fn margin(&self) -> f64 {
        self.margin
    }

    /// Whether the gap of two particles is below the margin.
    #[must_use]
    #[inline]
    pub fn are_near(&self, a: usize, b: usize) -> bool {
        let reach = self.radii[a] + self.radii[b] + self.margin;
        self.positions[a].distance_squared(self.positions[b]) < reach * reach
    }
}

/// The pairs that a detector proposes.
#[derive(Debug, Clone, Default)]
pub struct Pairs {
    found: Vec<[u32; 2]>,
}

impl Pairs {
    /// Proposes the pair of `a` and `b`, in either order.
    #[inline]
    pub fn push(&mut self, a: usize, b: usize) {
        let [a, b] = [a as u32, b as u32];
        self.found.push([a.min(b), a.max(b)]);
    }

    /// The proposals in the order in which they were made, the lower number first.
    #[must_use]
    #[inline]
    pub fn as_slice(&self) -> &[[u32; 2]] {
        &self.found
    }

    /// Memory in bytes that the proposals have reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        size_of::<[u32; 2]>() * self.found.capacity()
    }

    /// Makes room for proposals.
    pub(crate) fn reserve(&mut self, proposals: usize) {
        self.found.reserve(proposals);
    }

    /// Forgets all proposals and keeps the memory they stood in.
    pub fn clear(&mut self) {
        self.found.clear();
    }
}

/// Why a detector cannot serve a bed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DetectorError {
    /// A grid of more cells than it can hold.
    #[error("a grid of {cells} cells is too large to hold; the limit is {limit}")]
    TooManyCells {
        /// Cells asked for.
        cells: f64,
        /// Cells allowed.
        limit: usize,
    },
    /// A number that the detector works with is outside its range.
    #[error(transparent)]
    Value(#[from] ValueError),
}

/// Proposes pairs of particles that might touch.
///
/// # Using
/// [`AllPairs`] is the reference, [`CellGrid`] the paper's cellular automaton, [`LinkedCells`] the
/// usual choice for large beds, and [`Skin`] makes any of them last over many steps. All give the
/// same trajectory to the bit.
///
/// # Implementing
/// 1. [`prepare`](Self::prepare) comes before the first [`detect`](Self::detect), and again if the
///    cavity, the radii or the margin change. Refuse there what cannot be done.
/// 2. [`detect`](Self::detect) proposes *every* pair whose gap is below [`Bed::margin`], each pair
///    once, in any order, wherever the particles are: overlapping, outside the bounds, several at
///    one point. Pairs farther apart may be proposed as well; the engine tests the distance.
/// 3. `pairs` is empty when `detect` is called. Allocate nothing per call once warm.
///
/// The shortest correct detector:
/// ```
/// use particle_damper::{Bed, Detector, Pairs};
///
/// struct EveryPair;
///
/// impl Detector for EveryPair {
///     fn detect(&mut self, bed: &Bed<'_>, pairs: &mut Pairs) {
///         for a in 0..bed.len() {
///             for b in a + 1..bed.len() {
///                 pairs.push(a, b);
///             }
///         }
///     }
/// }
/// ```
pub trait Detector {
    /// Makes ready for a bed.
    ///
    /// # Errors
    /// If the detector cannot serve it, for instance because its grid would not fit in memory.
    fn prepare(&mut self, _bed: &Bed<'_>) -> Result<(), DetectorError> {
        Ok(())
    }

    /// Proposes every pair whose gap is below the bed's margin, once.
    fn detect(&mut self, bed: &Bed<'_>, pairs: &mut Pairs);

    /// The skin in m for a bed whose smallest particle has `radius` (m): proposals are kept until some
    /// particle has moved by half of it in the container's frame. Zero asks for new ones every step.
    fn skin(&self, _radius: f64) -> f64 {
        0.0
    }
}

macro_rules! forward_detector {
    ($reference:ty) => {
        impl<D: Detector + ?Sized> Detector for $reference {
            fn prepare(&mut self, bed: &Bed<'_>) -> Result<(), DetectorError> {
                (**self).prepare(bed)
            }

            fn detect(&mut self, bed: &Bed<'_>, pairs: &mut Pairs) {
                (**self).detect(bed, pairs);
            }

            fn skin(&self, radius: f64) -> f64 {
                (**self).skin(radius)
            }
        }
    };
}

forward_detector!(&mut D);
forward_detector!(Box<D>);
