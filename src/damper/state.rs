//! The state of a damper and what it is made of: particles in columns, compartments, the mount's coordinates,
//! the clock, and the model that contacts follow.
//!
//! In: what the builder checked. Out: columns that the stages read and change; a [`StateView`] for those that
//! only read. Called by every stage; calls none.

mod clock;
mod coefficients;
mod compartment;
mod geometry;
mod model;
mod mount_state;
mod particles;
mod space;
mod vectors;
mod view;

pub(crate) use clock::Clock;
pub(crate) use coefficients::Coefficients;
pub(crate) use compartment::Compartment;
pub(crate) use geometry::{force_and_torques, levers, normal_and_overlap, surface_velocity};
pub(crate) use model::Model;
pub(crate) use mount_state::MountState;
pub(crate) use particles::Particles;
pub(crate) use space::{Plane, Space, Volume};
#[cfg(test)]
pub(crate) use vectors::Axes;
pub(crate) use vectors::{Rows, Vectors, axial, polar, scale};
pub(crate) use view::{StateView, StepTime};
