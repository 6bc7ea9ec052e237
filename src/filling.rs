//! Filling a cavity with particles that do not overlap.

mod filler;
mod lattice;
mod occupied;
mod plan;
mod throughout;

use glam::{DVec3, dvec3};

use crate::cavity::Cavity;
use crate::error::{Bound, ValueError};
use crate::particle::Particle;
use crate::random::Random;
use filler::Filler;
use lattice::Frame;

/// Smallest radius over the largest coordinate: below it the gap around a particle is lost in rounding.
const SMALLEST: f64 = 1e-9;

/// Fills a cavity with particles, near its floor, at random and without overlap.
///
/// Particles stand on a loose lattice, layer upon layer, each shifted at random as far as its
/// neighbours allow; sizes are mixed throughout the bed, the larger ones placed first. Few particles
/// are strewn over the floor. Where the loose lattice has no room for all, tighter ones are tried, up
/// to triangles (in the plane) and close packing (in space): the fuller the cavity, the more regular
/// the bed. Between particles, and to every wall, a gap of about 1e-6 of the radii is kept.
///
/// The same seed gives the same bits. Time and memory grow in proportion to the number of particles.
///
/// ```
/// use particle_damper::cavity::Slot;
/// use particle_damper::{Filling, Particle};
///
/// let small = Particle::new(2e-3, 0.06e-3)?;
/// let large = Particle::new(3e-3, 0.2e-3)?;
/// let bed = Filling::new(1).with(40, small).with(20, large).fill(&Slot::paper())?;
/// assert_eq!(bed.len(), 60);
/// assert_eq!(bed[59].radius, 3e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct Filling {
    seed: u64,
    down: DVec3,
    throughout: bool,
    kinds: Vec<(usize, Particle)>,
}

/// Why a cavity could not be filled.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FillingError {
    /// A radius, the direction or the bounds of the cavity are outside their range.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// No lattice that was tried holds all particles.
    #[error("found room for {placed} of {wanted} particles; no room for one of radius {radius} m")]
    NoRoom {
        /// How many particles were asked for.
        wanted: usize,
        /// How many had a place in the best try.
        placed: usize,
        /// Radius in m of the first that had none.
        radius: f64,
    },
    /// The particles alone have more volume than the cavity.
    #[error(
        "{wanted} particles fill {volume}, the bounds of the cavity {room} (m^3, or m^2 in a plane)"
    )]
    TooMuch {
        /// How many particles were asked for.
        wanted: usize,
        /// Their volume in m^3; in a planar cavity their area in m^2.
        volume: f64,
        /// The same of the bounding box of the cavity.
        room: f64,
    },
    /// More particles than 32-bit numbers can count.
    #[error("{wanted} particles are more than the limit of {limit}")]
    TooMany {
        /// How many particles were asked for.
        wanted: usize,
        /// How many are allowed.
        limit: usize,
    },
}

impl Filling {
    /// No particle yet; gravity points down along y.
    pub const fn new(seed: u64) -> Self {
        Self {
            seed,
            down: DVec3::NEG_Y,
            throughout: false,
            kinds: Vec::new(),
        }
    }

    /// Adds `count` particles like `prototype`; its position is of no account.
    pub fn with(mut self, count: usize, prototype: Particle) -> Self {
        self.kinds.push((count, prototype));
        self
    }

    /// Starts from where `down` (of any length, container's frame) points to, instead of from the low end of
    /// y. In a container that stands turned that is `orientation.inverse() * gravity`.
    pub const fn down(mut self, down: DVec3) -> Self {
        self.down = down;
        self
    }

    /// Spreads the particles at random through the whole room instead of near the floor, as they are without
    /// gravity. Where they are too many to be strewn (from about a third of the room on), they stand on
    /// places taken at random from a lattice that fills the room.
    pub const fn throughout(mut self) -> Self {
        self.throughout = true;
        self
    }

    /// The particles in the order in which they were added, at rest unless their prototypes move.
    ///
    /// # Errors
    /// If there is no room for all of them, a radius is not positive and finite or below a billionth of the
    /// cavity, the direction has no
    /// length (in the plane of a planar cavity), or the bounds of the cavity are empty or infinite.
    pub fn fill<C: Cavity + ?Sized>(&self, cavity: &C) -> Result<Vec<Particle>, FillingError> {
        let frame = self.frame(cavity)?;
        let wanted = self.check_volume(&frame)?;
        let mut bed: Vec<Particle> = Vec::with_capacity(wanted);
        for &(count, prototype) in &self.kinds {
            bed.extend(std::iter::repeat_n(prototype, count));
        }
        let mut sizes = plan::sizes(&bed, frame.planar);
        let (mut best, mut radius) = (0, 0.0);
        let mut tried = Vec::new();
        let mut random = Random::new(self.seed);
        let ways = plan::plans(&frame, &sizes);
        if let (true, Some(&plan)) = (self.throughout, ways.first()) {
            let mut filler = Filler {
                cavity,
                frame,
                plan,
                varied: false,
                throughout: true,
                random: &mut random,
                occupied: Vec::new(),
            };
            if filler.scatter(&sizes, &mut bed) == wanted {
                return Ok(bed);
            }
        }
        for way in ways {
            if sizes.len() == 1 && plan::hopeless(&tried, way, wanted, frame.planar) {
                continue;
            }
            let mut filler = Filler {
                cavity,
                frame,
                plan: way,
                varied: self.kinds.len() > 1,
                throughout: self.throughout,
                random: &mut random,
                occupied: Vec::new(),
            };
            let placed = filler.place_all(&mut sizes, &mut bed);
            if placed == wanted {
                return Ok(bed);
            }
            tried.push((way, placed));
            if placed >= best {
                best = placed;
                radius = plan::first_without_place(&sizes, &bed, placed);
            }
        }
        Err(FillingError::NoRoom {
            wanted,
            placed: best,
            radius,
        })
    }

    fn frame<C: Cavity + ?Sized>(&self, cavity: &C) -> Result<Frame, ValueError> {
        let planar = cavity.is_planar();
        let [low, high] = cavity.bounds();
        for axis in 0..if planar { 2 } else { 3 } {
            Bound::Finite.check("bound of the cavity (m)", low[axis])?;
            Bound::Positive.check("extent of the cavity (m)", high[axis] - low[axis])?;
        }
        let up = if planar {
            dvec3(-self.down.x, -self.down.y, 0.0)
        } else {
            -self.down
        };
        let length = Bound::Positive.check("length of the direction down", up.length())?;
        let flat = |corner: DVec3| {
            if planar {
                dvec3(corner.x, corner.y, 0.0)
            } else {
                corner
            }
        };
        Ok(Frame::new([flat(low), flat(high)], up / length, planar))
    }

    /// The number of particles, if they might fit and can be counted.
    fn check_volume(&self, frame: &Frame) -> Result<usize, FillingError> {
        let (mut wanted, mut volume) = (0_usize, 0.0);
        for &(count, prototype) in &self.kinds {
            let r = Bound::Positive.check("particle radius (m)", prototype.radius)?;
            Bound::AtLeast(SMALLEST * frame.reach()).check("particle radius (m)", r)?;
            wanted = wanted.saturating_add(count);
            volume += count as f64 * plan::solid_volume(r, frame.planar);
        }
        let [a, b, c] = frame.extent;
        let room = if frame.planar { a * c } else { a * b * c };
        if volume > room {
            return Err(FillingError::TooMuch {
                wanted,
                volume,
                room,
            });
        }
        let limit = u32::MAX as usize - 1;
        if wanted > limit {
            return Err(FillingError::TooMany { wanted, limit });
        }
        Ok(wanted)
    }
}
