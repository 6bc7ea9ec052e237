//! What a contact law sees of two bodies that touch, and what it answers.

use glam::DVec3;

use crate::material::MaterialId;
use crate::numbers::vector;

mod partner;
mod wall_load;

pub use partner::Partner;
pub use wall_load::WallLoad;

/// One of the two bodies of a contact: a sphere, or a wall (infinite radius and mass).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Body {
    /// Radius in m; infinite for a wall.
    pub radius: f64,
    /// Mass in kg; infinite for a wall, unless a time step is judged: then the least effective mass of
    /// the containers.
    pub mass: f64,
    /// Number of its material.
    pub material: MaterialId,
}

impl Body {
    /// A sphere of `radius` (m) and `mass` (kg).
    #[must_use]
    pub const fn sphere(radius: f64, mass: f64, material: MaterialId) -> Self {
        Self {
            radius,
            mass,
            material,
        }
    }

    /// A wall of the container.
    #[must_use]
    pub const fn wall(material: MaterialId) -> Self {
        Self::sphere(f64::INFINITY, f64::INFINITY, material)
    }
}

/// The two bodies that a law prepares its coefficients for. The first is always a sphere, the
/// second a sphere or a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Bodies {
    /// The sphere that the contact normal points to.
    pub first: Body,
    /// The other sphere, or the wall.
    pub second: Body,
}

impl Bodies {
    /// `first` touching `second`.
    #[must_use]
    pub const fn new(first: Body, second: Body) -> Self {
        Self { first, second }
    }

    /// Whether the second body is a wall.
    #[must_use]
    pub fn at_wall(&self) -> bool {
        self.second.radius.is_infinite()
    }

    /// Effective mass m* = m1 m2/(m1 + m2) in kg; the sphere's own mass at a wall that does not yield.
    #[must_use]
    pub fn effective_mass(&self) -> f64 {
        1.0 / (1.0 / self.first.mass + 1.0 / self.second.mass)
    }

    /// Effective radius r* = r1 r2/(r1 + r2) in m; the sphere's own radius at a wall.
    #[must_use]
    pub fn effective_radius(&self) -> f64 {
        1.0 / (1.0 / self.first.radius + 1.0 / self.second.radius)
    }
}

/// Two bodies that touch, at one instant.
///
/// Forces and velocities are those of the *first* body relative to the *second*.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Contact {
    /// Unit vector from the second body to the first: along it a positive normal force pushes the
    /// first body away.
    pub normal: DVec3,
    /// Overlap d in m, positive when touching.
    pub overlap: f64,
    /// Velocity of the first body's surface relative to the second's at the point of contact, spin
    /// included, in m/s. Under a force law two spheres touch in the middle of their overlap, and a wall
    /// gives way nowhere and turns a sphere by its radius; under an impulse law overlaps are small errors,
    /// which bodies share by their radii.
    pub velocity: DVec3,
    /// Angular velocities of the two bodies in rad/s; zero for a wall.
    pub spins: [DVec3; 2],
    /// Time since the contact's memory was advanced, in s; under an impulse law the length of the step.
    pub elapsed: f64,
    /// Time in s by which a force, by as much as it differs from that of the evaluation before, still
    /// changes `velocity` and `spins` to those of the instant: half of the step where an integrator
    /// [predicts](crate::integrator::Stage::Predicted) them, zero where they are those of the instant.
    pub correction: f64,
    /// Velocity along the normal that the second body gains per unit impulse along it, in 1/kg, if it is
    /// a wall of a container that yields; zero if it does not, and for a pair (the law knows its masses).
    /// The inverse effective mass along the normal is larger by as much.
    pub wall_inverse_mass: f64,
    /// Whether the bodies move in the plane z = 0: normal and velocity have no z, spins have z alone, and a law may
    /// leave out the rest. It is known when the program is compiled, so that asking costs nothing.
    pub planar: bool,
}

impl Contact {
    /// A contact with its normal (unit, towards the first body), overlap (m) and relative surface
    /// velocity (m/s); the rest zero, to be set field by field. For testing a law by itself.
    #[must_use]
    pub const fn new(normal: DVec3, overlap: f64, velocity: DVec3) -> Self {
        Self {
            normal,
            overlap,
            velocity,
            spins: [DVec3::ZERO; 2],
            elapsed: 0.0,
            correction: 0.0,
            wall_inverse_mass: 0.0,
            planar: false,
        }
    }

    /// Rate of overlap d' in m/s: positive while the bodies approach.
    #[must_use]
    #[inline(always)]
    pub fn approach_speed(&self) -> f64 {
        -self.velocity.dot(self.normal)
    }

    /// Tangential part of the relative surface velocity, in m/s.
    #[must_use]
    #[inline(always)]
    pub fn slip(&self) -> DVec3 {
        self.velocity + self.approach_speed() * self.normal
    }
}

/// What a law sees besides of a contact that may begin or end within a step.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Onset {
    /// Length of the step in s: the force of a contact is taken at intervals of this length.
    pub time_step: f64,
    /// How fast the bodies' speed of separation along the normal changed when forces were evaluated
    /// last, in m/s^2.
    pub acceleration: f64,
}

impl Onset {
    /// A step of `time_step` (s), and the acceleration along the normal (m/s^2).
    #[must_use]
    #[inline(always)]
    pub const fn new(time_step: f64, acceleration: f64) -> Self {
        Self {
            time_step,
            acceleration,
        }
    }

    /// Whether two bodies that overlap by `overlap` (m) and approach or part with `speed` (m/s) may
    /// have met, or may part, within a step of `time_step` (s). Speeds within it may be twice as high.
    #[must_use]
    #[inline(always)]
    pub const fn is_near(overlap: f64, speed: f64, time_step: f64) -> bool {
        overlap < 2.0 * time_step * speed.abs()
    }
}

/// The force of a contact on its first body; the second body feels the opposite.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ContactForce {
    /// Along the normal, in N: positive pushes the bodies apart.
    pub normal: f64,
    /// In the tangent plane, at the point of contact, in N. It turns both bodies.
    pub tangential: DVec3,
    /// A couple besides (rolling resistance), in N m: on the first body, and reversed on the
    /// second.
    pub couple: DVec3,
}

/// The force that a contact under an impulse law bore over a step: what it remembers, and what the next
/// step starts from.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct HeldForce {
    /// On the first body.
    pub force: ContactForce,
    /// Normal force in N that it bore over this step and the one before it, both: none after an impact,
    /// however hard.
    pub load: f64,
    /// Acceleration of a free body relative to the container in m/s^2: loads at rest grow with it.
    pub gravity: f64,
}

impl HeldForce {
    /// Tells every number.
    pub(crate) fn tell(&self, tell: &mut dyn FnMut(f64)) {
        let ContactForce {
            normal,
            tangential,
            couple,
        } = self.force;
        let vectors = [tangential, couple].map(|vector| vector.to_array());
        let numbers = [normal, self.load, self.gravity];
        vectors.into_iter().flatten().chain(numbers).for_each(tell);
    }

    /// That of which the next numbers were told; none if they are too few.
    pub(crate) fn recall(told: &mut dyn Iterator<Item = f64>) -> Option<Self> {
        let [tangential, couple] = [vector(told)?, vector(told)?];
        let force = ContactForce {
            normal: told.next()?,
            tangential,
            couple,
        };
        Some(Self {
            force,
            load: told.next()?,
            gravity: told.next()?,
        })
    }
}

/// What a contact holds by elasticity, and can give back.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Stored {
    /// Elastic part of the normal force, in N, positive when pushing: minus the derivative of
    /// `normal` by the distance of the bodies. What the normal force has besides is lost.
    pub normal_force: f64,
    /// Energy of the compression along the normal, in J.
    pub normal: f64,
    /// Energy of the tangential stretch, in J.
    pub tangential: f64,
}

impl Stored {
    /// The elastic normal force (N) and the energies (J) of compression and of tangential stretch.
    #[must_use]
    pub const fn new(normal_force: f64, normal: f64, tangential: f64) -> Self {
        Self {
            normal_force,
            normal,
            tangential,
        }
    }
}

impl ContactForce {
    /// A force without a couple.
    #[must_use]
    #[inline(always)]
    pub const fn new(normal: f64, tangential: DVec3) -> Self {
        Self {
            normal,
            tangential,
            couple: DVec3::ZERO,
        }
    }
}
