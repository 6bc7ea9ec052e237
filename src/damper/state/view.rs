//! What contacts are computed from: the state, for reading alone.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use super::Compartment;

use glam::DVec3;

use super::coefficients::Coefficients;
use super::vectors::Rows;
use crate::cavity::{Cavity, WallPoint};
use crate::law::ContactLaw;

/// When in a step contacts are evaluated.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepTime {
    /// Time since the contact history was advanced, s.
    pub(crate) elapsed: f64,
    /// Time by which a change of the forces still changes the velocities, s.
    pub(crate) correction: f64,
    /// Length of the step, s; zero before the first.
    pub(crate) time_step: f64,
}

/// The state that contacts are computed from, for reading alone.
pub(crate) struct StateView<'a, C, L: ContactLaw> {
    pub(crate) law: &'a L,
    pub(crate) coefficients: &'a Coefficients<L::Coefficients>,
    pub(crate) cavities: &'a [C],
    pub(crate) compartments: &'a [Compartment],
    pub(crate) compartment_of_wall: &'a [u32],
    pub(crate) position: Rows<'a>,
    pub(crate) velocity: Rows<'a>,
    pub(crate) spin: Rows<'a>,
    /// As they were evaluated last.
    pub(crate) acceleration: Rows<'a>,
    pub(crate) radius: &'a [f64],
    pub(crate) inverse_mass: &'a [f64],
    pub(crate) inverse_inertia: &'a [f64],
    pub(crate) species: &'a [u32],
    pub(crate) id: &'a [u32],
    /// When in the step this is.
    pub(crate) step_time: StepTime,
    /// Whether everything moves in the plane z = 0.
    pub(crate) planar: bool,
}

/// What a contact needs to know of a particle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Grain {
    pub(crate) position: DVec3,
    pub(crate) velocity: DVec3,
    pub(crate) spin: DVec3,
    pub(crate) radius: f64,
}

impl<C: Cavity, L: ContactLaw> StateView<'_, C, L> {
    /// The particle at an index.
    #[inline(always)]
    pub(crate) fn grain(&self, index: usize) -> Grain {
        Grain {
            position: self.position.get(index),
            velocity: self.velocity.get(index),
            spin: self.spin.get(index),
            radius: self.radius[index],
        }
    }

    /// The coefficients of two particles; `own` are those of the pair if the law was asked pair by pair.
    #[inline(always)]
    pub(crate) fn pair_coefficients(
        &self,
        bodies: [u32; 2],
        own: Option<&L::Coefficients>,
    ) -> L::Coefficients {
        let [first, second] = bodies.map(|index| self.species[index as usize]);
        self.coefficients.pair(first, second, own)
    }

    /// Number of the compartment that a particle is in.
    #[inline(always)]
    pub(crate) fn compartment_of(&self, index: u32) -> usize {
        match self.compartments {
            [_] => 0,
            all => all.partition_point(|compartment| compartment.indices.end <= index as usize),
        }
    }

    /// How a wall stands to a point of the fixed frame.
    #[inline(always)]
    pub(crate) fn wall_point(&self, wall: u32, position: DVec3) -> WallPoint {
        let number = self.cavity_of_wall(wall);
        self.compartments[number].wall(&self.cavities[number], wall, position)
    }

    /// How the centre of the first body was accelerated relative to that of the second when forces were
    /// evaluated last, in m/s^2.
    #[inline(always)]
    pub(crate) fn acceleration_of_pair(&self, bodies: [u32; 2]) -> DVec3 {
        let [first, second] = bodies.map(|index| self.acceleration.get(index as usize));
        first - second
    }

    /// How a particle was accelerated relative to a wall when forces were evaluated last, as far as the
    /// wall's rotation goes, in m/s^2.
    #[inline(always)]
    pub(crate) fn acceleration_at_wall(&self, index: usize, wall: u32) -> DVec3 {
        self.compartment_of_wall(wall).relative_acceleration(
            self.position.get(index),
            self.velocity.get(index),
            self.acceleration.get(index),
        )
    }

    /// Number of the cavity that has a wall.
    #[inline(always)]
    pub(crate) fn cavity_of_wall(&self, wall: u32) -> usize {
        self.compartment_of_wall[wall as usize] as usize
    }

    #[inline(always)]
    pub(crate) fn compartment_of_wall(&self, wall: u32) -> &Compartment {
        &self.compartments[self.cavity_of_wall(wall)]
    }
}
