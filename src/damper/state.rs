//! The state of a damper: particles in columns, compartments, the mount's coordinates and the clock; and the
//! model that its contacts follow.
//!
//! In: what the builder checked. Out: columns that the stages read and change; a [`StateView`] for those that
//! only read. Called by every stage; calls none. The state is of one type, whatever the damper is made of, and
//! what works on it alone is compiled once.

use glam::DVec3;

use crate::contact::WallLoad;
use crate::law::ContactLaw;
use crate::mount::{Load, Mobilities};

mod checks;
mod clock;
mod coefficients;
mod compartment;
mod containers;
mod diagnosis;
mod geometry;
mod model;
mod mount_coordinates;
mod particles;
mod previous;
mod setup;
mod space;
mod vectors;
mod view;

pub(crate) use clock::Clock;
pub(crate) use coefficients::Coefficients;
pub(crate) use compartment::Compartment;
pub(crate) use containers::checked;
pub(crate) use diagnosis::StepStart;
pub(crate) use geometry::{force_and_torques, levers, normal_and_overlap, react, surface_velocity};
pub(crate) use model::Model;
pub(crate) use mount_coordinates::MountCoordinates;
pub(crate) use particles::Particles;
pub(crate) use previous::PreviousAccelerations;
pub(crate) use setup::Setup;
pub(crate) use space::{Plane, Space, Volume};
#[cfg(test)]
pub(crate) use vectors::Axes;
pub(crate) use vectors::{Rows, Vectors};
pub(crate) use view::{StateView, StepTime};

/// Everything that a step changes, and the numbers that it goes by.
#[derive(Debug, Clone)]
pub(crate) struct State {
    pub(crate) gravity: DVec3,
    pub(crate) particles: Particles,
    pub(crate) compartments: Vec<Compartment>,
    /// Number of the compartment of each wall.
    pub(crate) compartment_of_wall: Vec<u32>,
    /// Whether everything moves in the plane z = 0.
    pub(crate) planar: bool,
    /// How many coordinates the mount has.
    pub(crate) degrees: usize,
    pub(crate) mount_coordinates: MountCoordinates,
    pub(crate) previous: PreviousAccelerations,
    /// Loads of the particles on each wall, all cavities in turn.
    pub(crate) wall_loads: Vec<WallLoad>,
    /// What the particles do to each container.
    pub(crate) loads: Vec<Load>,
    /// What impulses on the containers do.
    pub(crate) mobilities: Mobilities,
    pub(crate) time: f64,
    /// Length of the step, s.
    pub(crate) time_step: f64,
    /// How the step began.
    pub(crate) step_start: StepStart,
    /// The largest overlap that is no error, m.
    pub(crate) overlap_limit: f64,
    /// Whether a particle behind a wall is an error.
    pub(crate) contained: bool,
    /// Whether contact forces are held over a step, as those of an impulse law are.
    pub(crate) holds_forces: bool,
    /// The speed of impacts that the contact law is set up for, m/s.
    pub(crate) design_speed: f64,
}

impl State {
    /// The state `elapsed` seconds after the contact history was advanced, to be read beside the `model`.
    pub(crate) fn view<'a, C, L: ContactLaw>(
        &'a self,
        model: &'a Model<C, L>,
        elapsed: f64,
    ) -> StateView<'a, C, L> {
        let particles = &self.particles;
        StateView {
            law: &model.law,
            coefficients: &model.coefficients,
            cavities: &model.cavities,
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
            planar: self.planar,
        }
    }

    /// Number of the cavity whose particle is at `index`.
    pub(crate) fn cavity_of(&self, index: usize) -> usize {
        self.compartments
            .partition_point(|compartment| compartment.indices.end <= index)
    }

    /// The mount's own coordinates, and their rates.
    #[inline]
    pub(crate) fn mount_state(&self) -> [&[f64]; 2] {
        self.mount_coordinates.own(self.degrees)
    }
}
