//! One particle, as it is put into a damper and as it is read back.

use glam::DVec3;

use crate::error::{Bound, ValueError};
use crate::material::{MaterialId, Materials};

/// A solid sphere. Positions are in metres in the container's frame when a damper is built and in
/// the fixed frame when they are read back; the two coincide while the container is at its origin.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Particle {
    /// Radius in m.
    pub radius: f64,
    /// Mass in kg.
    pub mass: f64,
    /// Number of its material in the law's table.
    pub material: MaterialId,
    /// The cavity that holds it: its number on the mount, zero where there is one alone.
    pub cavity: u32,
    /// Centre in m.
    pub position: DVec3,
    /// Velocity of the centre in m/s, in the fixed frame.
    pub velocity: DVec3,
    /// Angular velocity in rad/s.
    pub spin: DVec3,
}

impl Particle {
    /// A sphere of `radius` (m) and `mass` (kg) at rest at the origin, of the first material.
    ///
    /// # Errors
    /// If radius or mass is not positive and finite.
    pub fn new(radius: f64, mass: f64) -> Result<Self, ValueError> {
        Ok(Self {
            radius: Bound::Positive.check("particle radius (m)", radius)?,
            mass: Bound::Positive.check("particle mass (kg)", mass)?,
            material: Materials::FIRST,
            cavity: 0,
            position: DVec3::ZERO,
            velocity: DVec3::ZERO,
            spin: DVec3::ZERO,
        })
    }

    /// A sphere of `radius` (m) and `density` (kg/m^3).
    ///
    /// # Errors
    /// If radius or density is not positive and finite.
    pub fn with_density(radius: f64, density: f64) -> Result<Self, ValueError> {
        Bound::Positive.check("particle density (kg/m^3)", density)?;
        let volume = 4.0 / 3.0 * std::f64::consts::PI * (radius * radius * radius);
        Self::new(radius, density * volume)
    }

    /// The same particle with its centre at `position` (m, container's frame).
    #[must_use]
    pub const fn at(mut self, position: DVec3) -> Self {
        self.position = position;
        self
    }

    /// The same particle with `velocity` (m/s, fixed frame).
    #[must_use]
    pub const fn moving(mut self, velocity: DVec3) -> Self {
        self.velocity = velocity;
        self
    }

    /// The same particle with `spin` (rad/s).
    #[must_use]
    pub const fn spinning(mut self, spin: DVec3) -> Self {
        self.spin = spin;
        self
    }

    /// The same particle of another material.
    #[must_use]
    pub const fn of(mut self, material: MaterialId) -> Self {
        self.material = material;
        self
    }

    /// The same particle in another cavity of the mount.
    #[must_use]
    pub const fn in_cavity(mut self, cavity: u32) -> Self {
        self.cavity = cavity;
        self
    }

    /// Moment of inertia of the solid sphere about its centre, 2/5 m r^2, in kg m^2.
    #[must_use]
    pub fn inertia(&self) -> f64 {
        0.4 * self.mass * self.radius * self.radius
    }

    /// Kinetic energy of translation and spin in J.
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        0.5 * (self.mass * self.velocity.length_squared()
            + self.inertia() * self.spin.length_squared())
    }
}
