//! The containers: where the mount has them, and what the particles do to it.

use glam::DMat3;

use super::State;
use crate::cavity::Cavity;
use crate::law::ContactLaw;
use crate::mount::{self, Motion, Mount};
use crate::step_error::StepError;

impl<C: Cavity, L: ContactLaw, M: Mount> State<C, L, M> {
    /// Moves the containers to where the mount has them at `time`.
    pub(crate) fn place_containers(&mut self, time: f64) -> Result<(), StepError> {
        let degrees = self.mount.degrees();
        let coordinates = &self.mount_coordinates.position[..degrees];
        let velocities = &self.mount_coordinates.velocity[..degrees];
        let mut both = coordinates.iter().zip(velocities);
        if let Some(coordinate) = both.position(|(x, v)| !(x.is_finite() && v.is_finite())) {
            return Err(StepError::Mount {
                coordinate,
                value: coordinates[coordinate],
                rate: velocities[coordinate],
            });
        }
        for (cavity, compartment) in self.model.compartments.iter_mut().enumerate() {
            let Motion { position, velocity } =
                self.mount.motion(time, coordinates, velocities, cavity);
            if !(position.is_finite() && velocity.is_finite()) {
                return Err(StepError::Container {
                    cavity,
                    position,
                    velocity,
                });
            }
            if compartment.cavity.is_planar() && (position.z != 0.0 || velocity.z != 0.0) {
                return Err(StepError::OutOfPlane {
                    cavity,
                    position,
                    velocity,
                });
            }
            compartment.motion = Motion { position, velocity };
        }
        Ok(())
    }

    /// Keeps the mount's accelerations as the previous ones.
    pub(crate) fn keep_mount_accelerations(&mut self) {
        let previous = &mut self.previous.mount;
        previous.copy_from_slice(&self.mount_coordinates.acceleration);
    }

    /// The mount's accelerations under the loads on the walls.
    pub(crate) fn accelerate_mount(&mut self, time: f64) {
        for (compartment, load) in self.model.compartments.iter().zip(&mut self.loads) {
            *load = compartment.load(&self.wall_loads);
        }
        let degrees = self.mount.degrees();
        let state = &mut self.mount_coordinates;
        let (accelerations, impulses) = state.acceleration.split_at_mut(degrees);
        for (impulse, load) in impulses.chunks_exact_mut(3).zip(&self.loads) {
            impulse.copy_from_slice(&load.to_array());
        }
        self.mount.accelerate(
            time,
            &state.position[..degrees],
            &state.velocity[..degrees],
            &self.loads,
            accelerations,
        );
    }

    /// Velocity of the second of two containers per unit impulse on the first, 1/kg, row by row.
    pub(crate) fn container_responses(&self) -> Vec<DMat3> {
        let cavities = self.model.compartments.len();
        mount::responses(
            &self.mount,
            self.time,
            self.mount_coordinates.own(self.mount.degrees()),
            self.mount_coordinates.own_rates(self.mount.degrees()),
            cavities,
        )
    }
}
