use glam::DVec3;

mod bounds;
mod extent;
mod place;
mod search;
mod solid;

use super::{Cavity, Part, WallPoint};
use crate::error::ValueError;
use solid::Placed;

/// A cavity that is put together from [`Part`]s: what is on the right side of all of them.
///
/// Each part is a wall, numbered as they are given, with a name and a load of its own. So a room is
/// bounded by planes, cylinders, cones and whatever is hollow, and anything solid stands in it as an
/// obstacle. The room needs bounds, and some place in it that is free; whether it falls into several rooms
/// is not looked at.
///
/// A silo over a bin. While it is filled, its outlet is closed by one part more:
/// ```
/// use particle_damper::cavity::{Composite, Part};
/// use particle_damper::glam::DVec3;
/// use particle_damper::{Filling, Particle};
///
/// let silo = Composite::new([
///     Part::cylinder(0.03).inside().named("bin"),
///     Part::plane().named("floor"),
///     Part::plane().along(DVec3::NEG_Y).at(DVec3::Y * 0.16).named("lid"),
///     Part::orifice(0.011, 0.031, 2e-3).at(DVec3::Y * 0.06).named("bottom"),
/// ])?;
/// let gate = Part::plane().at(DVec3::Y * 0.061);
/// let closed = Composite::new(silo.parts().iter().cloned().chain([gate]))?;
/// let bed = Filling::new(1).with(300, Particle::new(2e-3, 8e-5)?).fill(&closed)?;
/// assert!(bed.iter().all(|particle| particle.position.y > 0.061));
/// assert_eq!(silo.wall_named("bottom"), Some(3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Composite {
    parts: Vec<Part>,
    placed: Vec<Placed>,
    /// The box that each body is in, if it is an obstacle.
    boxes: Vec<[DVec3; 2]>,
    bounds: [DVec3; 2],
    planar: bool,
    thickness: f64,
    rounding: f64,
}

/// Why parts do not make a cavity.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CompositeError {
    /// A number of a part is outside its range.
    #[error("part {part} ({name}): {error}")]
    Part {
        /// Number of the part.
        part: usize,
        /// Its name.
        name: String,
        /// What is wrong with it.
        error: ValueError,
    },
    /// A union from inside: nothing tells where its bodies end in each other.
    #[error("part {part} ({name}): a union and its bodies can be seen from outside alone")]
    HollowUnion {
        /// Number of the part.
        part: usize,
        /// Its name.
        name: String,
    },
    /// In a planar cavity, a part that is not the same on both sides of the plane z = 0.
    #[error("part {part} ({name}): {quantity} {value} leaves the plane z = 0")]
    OutOfPlane {
        /// Number of the part.
        part: usize,
        /// Its name.
        name: String,
        /// What leaves the plane.
        quantity: &'static str,
        /// Its value.
        value: DVec3,
    },
    /// Planes and hollow parts do not enclose the room.
    #[error("the room has no bounds: it reaches farther than {limit} m along {axis}")]
    Unbounded {
        /// The axis along which it has none.
        axis: DVec3,
        /// As far as was looked, in m.
        limit: f64,
    },
    /// No place is free.
    #[error("there is no room: the freest place, {position}, is {depth} m deep in a part")]
    Empty {
        /// The place that is nearest to being free, in m.
        position: DVec3,
        /// How deep it is in some part, in m.
        depth: f64,
    },
}

impl Composite {
    /// The room that `parts` leave, in space.
    ///
    /// # Errors
    /// If a part cannot be, or they leave no room, or one without bounds.
    pub fn new(parts: impl IntoIterator<Item = Part>) -> Result<Self, CompositeError> {
        Self::build(parts.into_iter().collect(), false)
    }

    /// The room that `parts` leave in the plane z = 0, in which particles move and spin about z. Every part
    /// has its origin in the plane, and its axis in it or along z.
    ///
    /// ```
    /// use particle_damper::cavity::{Composite, Part};
    /// use particle_damper::glam::{DVec3, dvec3};
    ///
    /// // A drum with a baffle.
    /// let drum = Composite::planar([
    ///     Part::cylinder(0.05).along(DVec3::Z).inside().named("drum"),
    ///     Part::rod([dvec3(0.03, 0.0, 0.0), dvec3(0.05, 0.0, 0.0)], 2e-3).named("baffle"),
    /// ])?;
    /// # Ok::<(), particle_damper::cavity::CompositeError>(())
    /// ```
    ///
    /// # Errors
    /// As [`new`](Self::new), and if a part leaves the plane.
    pub fn planar(parts: impl IntoIterator<Item = Part>) -> Result<Self, CompositeError> {
        Self::build(parts.into_iter().collect(), true)
    }

    fn build(parts: Vec<Part>, planar: bool) -> Result<Self, CompositeError> {
        let mut placed = Vec::with_capacity(parts.len());
        for (number, part) in parts.iter().enumerate() {
            placed.push(place::place(part, planar).map_err(|fault| fault.of(number, part))?);
        }
        let bounds = bounds::bounds(&placed, planar)?;
        search::check_free(&placed, bounds)?;
        Ok(Self {
            boxes: placed.iter().map(Placed::reach).collect(),
            thickness: least(&placed, Placed::thickness),
            rounding: least(&placed, Placed::rounding),
            parts,
            placed,
            bounds,
            planar,
        })
    }

    /// The parts, by the numbers of their walls.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The number of the first wall of a name.
    #[must_use]
    pub fn wall_named(&self, name: &str) -> Option<u32> {
        let number = self.parts.iter().position(|part| part.name() == name);
        number.map(|number| number as u32)
    }
}

fn least(placed: &[Placed], size: fn(&Placed) -> f64) -> f64 {
    placed.iter().map(size).fold(f64::INFINITY, f64::min)
}

impl Cavity for Composite {
    fn walls(&self) -> u32 {
        self.placed.len() as u32
    }

    #[inline]
    fn wall(&self, number: u32, point: DVec3) -> WallPoint {
        self.placed[number as usize].wall(point)
    }

    fn bounds(&self) -> [DVec3; 2] {
        self.bounds
    }

    fn is_planar(&self) -> bool {
        self.planar
    }

    fn wall_name(&self, number: u32) -> &str {
        self.parts
            .get(number as usize)
            .map_or("wall", |part| part.name())
    }

    #[inline]
    fn reaches(&self, number: u32, point: DVec3, reach: f64) -> bool {
        let [low, high] = self.boxes[number as usize];
        let beyond = (low - point).max(point - high).max_element();
        beyond < reach && self.wall(number, point).distance < reach
    }

    fn thickness(&self) -> f64 {
        self.thickness
    }

    fn rounding(&self) -> f64 {
        self.rounding
    }
}

#[cfg(test)]
mod tests;
