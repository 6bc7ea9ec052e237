//! The state of a damper and what it is made of: particles in columns, compartments, the mount's coordinates,
//! the clock, and the model that contacts follow.
//!
//! In: what the builder checked. Out: columns that the stages read and change; a [`StateView`] for those that
//! only read. Called by every stage; calls none.

use glam::DVec3;

use crate::cavity::Cavity;
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
pub(crate) use geometry::{force_and_torques, levers, normal_and_overlap, surface_velocity};
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

/// Everything that a step changes, and what it follows.
#[derive(Clone)]
pub(crate) struct State<C, L: ContactLaw, M: ?Sized> {
    pub(crate) model: Model<C, L>,
    pub(crate) gravity: DVec3,
    pub(crate) particles: Particles,
    pub(crate) mount_coordinates: MountCoordinates,
    pub(crate) previous: PreviousAccelerations,
    /// Loads of the particles on each wall, all cavities in turn.
    pub(crate) wall_loads: Vec<WallLoad>,
    /// What the particles do to each container.
    pub(crate) loads: Vec<Load>,
    /// What impulses on the containers do.
    pub(crate) mobilities: Mobilities,
    pub(crate) time: f64,
    /// Number of the last accepted step; it wraps.
    pub(crate) stamp: u32,
    /// Length of the step, s.
    pub(crate) time_step: f64,
    /// How the step began.
    pub(crate) step_start: StepStart,
    /// The largest overlap that is no error, m.
    pub(crate) overlap_limit: f64,
    /// Whether a particle behind a wall is an error.
    pub(crate) contained: bool,
    /// Last, so that where little is optimised a step can be compiled once for all mounts.
    pub(crate) mount: M,
}

impl<C: Cavity, L: ContactLaw, M: ?Sized> State<C, L, M> {
    /// The state `elapsed` seconds after the contact history was advanced, to be read.
    pub(crate) fn view(&self, elapsed: f64) -> StateView<'_, C, L> {
        let Self {
            model, particles, ..
        } = self;
        StateView {
            law: &model.law,
            coefficients: &model.coefficients,
            compartments: &model.compartments,
            compartment_of_wall: &model.compartment_of_wall,
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
            planar: model.planar(),
        }
    }
}
