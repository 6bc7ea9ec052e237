//! The rules that contacts follow, and where.

use super::coefficients::Coefficients;
use super::compartment::Compartment;
use super::particles::Particles;
use super::view::{StateView, StepTime};
use crate::cavity::Cavity;
use crate::law::ContactLaw;

/// The rules that contacts follow, and the compartments that they happen in.
#[derive(Debug, Clone)]
pub(crate) struct Model<C, L: ContactLaw> {
    pub(crate) law: L,
    pub(crate) coefficients: Coefficients<L::Coefficients>,
    pub(crate) compartments: Vec<Compartment<C>>,
    /// Number of the compartment of each wall.
    pub(crate) compartment_of_wall: Vec<u32>,
    /// Gap in m up to which bodies count as in contact: zero under a force law.
    pub(crate) prediction_distance: f64,
    /// Gap in m up to which candidates are listed, besides the margin.
    pub(crate) listed_distance: f64,
    /// Number of the last accepted step; it wraps.
    pub(crate) stamp: u32,
    /// Length of the step, s.
    pub(crate) time_step: f64,
}

impl<C: Cavity, L: ContactLaw> Model<C, L> {
    /// A view of `particles`, `elapsed` seconds after the contact history was advanced.
    pub(crate) fn view<'a>(
        &'a self,
        particles: &'a Particles,
        elapsed: f64,
    ) -> StateView<'a, C, L> {
        StateView {
            law: &self.law,
            coefficients: &self.coefficients,
            compartments: &self.compartments,
            compartment_of_wall: &self.compartment_of_wall,
            position: particles.position.rows(),
            velocity: particles.velocity.rows(),
            spin: particles.spin.rows(),
            acceleration: particles.acceleration.rows(),
            radius: &particles.radius,
            inverse_mass: &particles.inverse_mass,
            inverse_inertia: &particles.inverse_inertia,
            species: &particles.species,
            id: &particles.id,
            step_time: StepTime {
                elapsed,
                correction: 0.0,
                time_step: self.time_step,
            },
            stamp: self.stamp,
            planar: self.planar(),
            prediction_distance: self.prediction_distance,
            listed_distance: self.listed_distance,
        }
    }
}

impl<C, L: ContactLaw> Model<C, L> {
    /// Whether everything moves in the plane z = 0.
    pub(crate) fn planar(&self) -> bool
    where
        C: Cavity,
    {
        self.compartments
            .iter()
            .all(|compartment| compartment.cavity.is_planar())
    }

    /// Number of the cavity whose particle is at `index`.
    pub(crate) fn cavity_of(&self, index: usize) -> usize {
        self.compartments
            .partition_point(|compartment| compartment.indices.end <= index)
    }
}
