use std::f64::consts::TAU;

use glam::DVec3;

use super::{Load, Motion, Mount, MountEnergy};
use crate::error::{Bound, ValueError};
use crate::excitation::{Excitation, Jump};

/// The paper's primary system, Eq. (1): M x" + C x' + K x = f_d + f_p, with the container moving by
/// x along one axis, y (up) unless said otherwise.
///
/// x is counted from the position in which the spring is relaxed. The mount carries the particles'
/// forces alone; its own weight is taken to be balanced.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SingleDof<E = ()> {
    mass: f64,
    damping: f64,
    stiffness: f64,
    axis: DVec3,
    start: [f64; 2],
    excitation: E,
}

impl SingleDof {
    /// An oscillator of `mass` (kg), `damping` (N s/m) and `stiffness` (N/m), without excitation.
    ///
    /// # Errors
    /// If the mass is not positive, or another number is negative or not finite.
    pub fn new(mass: f64, damping: f64, stiffness: f64) -> Result<Self, ValueError> {
        Ok(Self {
            mass: Bound::Positive.check("mass of the primary system (kg)", mass)?,
            damping: Bound::NonNegative.check("damping of the primary system (N s/m)", damping)?,
            stiffness: Bound::NonNegative
                .check("stiffness of the primary system (N/m)", stiffness)?,
            axis: DVec3::Y,
            start: [0.0; 2],
            excitation: (),
        })
    }

    /// The primary system of the paper's Table 1: 0.086 kg, 0.08 N s/m, 123.4 N/m.
    #[must_use]
    pub const fn paper() -> Self {
        Self {
            mass: 0.086,
            damping: 0.08,
            stiffness: 123.4,
            axis: DVec3::Y,
            start: [0.0; 2],
            excitation: (),
        }
    }
}

impl<E> SingleDof<E> {
    /// The same oscillator under another excitation.
    #[must_use]
    pub fn excited_by<F: Excitation>(self, excitation: F) -> SingleDof<F> {
        SingleDof {
            mass: self.mass,
            damping: self.damping,
            stiffness: self.stiffness,
            axis: self.axis,
            start: self.start,
            excitation,
        }
    }

    /// The same oscillator moving along `axis` (of any length).
    ///
    /// # Errors
    /// If the axis is zero or not finite.
    pub fn along(mut self, axis: DVec3) -> Result<Self, ValueError> {
        let length = axis.length();
        self.axis = axis / Bound::Positive.check("length of the axis", length)?;
        Ok(self)
    }

    /// The same oscillator let go at `displacement` (m) with `velocity` (m/s).
    ///
    /// # Errors
    /// If a number is not finite.
    pub fn released_from(mut self, displacement: f64, velocity: f64) -> Result<Self, ValueError> {
        self.start = [
            Bound::Finite.check("initial displacement (m)", displacement)?,
            Bound::Finite.check("initial velocity (m/s)", velocity)?,
        ];
        Ok(self)
    }

    /// Mass M in kg.
    #[must_use]
    pub const fn mass(&self) -> f64 {
        self.mass
    }

    /// Damping C in N s/m.
    #[must_use]
    pub const fn damping(&self) -> f64 {
        self.damping
    }

    /// Stiffness K in N/m.
    #[must_use]
    pub const fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Unit vector along which the container moves.
    #[must_use]
    pub const fn axis(&self) -> DVec3 {
        self.axis
    }

    /// The excitation.
    #[must_use]
    pub const fn excitation(&self) -> &E {
        &self.excitation
    }
}

impl<E: Excitation> Mount for SingleDof<E> {
    fn degrees(&self) -> usize {
        1
    }

    fn start(&self, coordinates: &mut [f64], velocities: &mut [f64]) {
        coordinates[0] = self.start[0];
        velocities[0] = self.start[1];
    }

    #[inline]
    fn motion(&self, _time: f64, x: &[f64], v: &[f64], _cavity: usize) -> Motion {
        Motion::at(self.axis * x[0], self.axis * v[0])
    }

    #[inline]
    fn accelerate(&self, time: f64, x: &[f64], v: &[f64], loads: &[Load], a: &mut [f64]) {
        let driving = self.excitation.force(time, self.damping, self.stiffness);
        let particles: f64 = loads.iter().map(|load| load.force.dot(self.axis)).sum();
        let spring = self.stiffness * x[0] + self.damping * v[0];
        a[0] = (driving + particles - spring) / self.mass;
    }

    fn energy(&self, time: f64, x: &[f64], v: &[f64]) -> MountEnergy {
        let driving = self.excitation.force(time, self.damping, self.stiffness);
        MountEnergy::new(
            0.5 * self.mass * v[0] * v[0],
            0.5 * self.stiffness * x[0] * x[0],
        )
        .with_powers(driving * v[0], self.damping * v[0] * v[0])
    }

    fn highest_frequency(&self) -> f64 {
        let decay = self.damping / self.mass;
        (self.stiffness / self.mass).sqrt().max(decay) / TAU
    }

    fn shortest_feature(&self) -> f64 {
        self.excitation.shortest_feature()
    }

    fn jump(&self) -> Option<Jump> {
        self.excitation.jump()
    }
}
