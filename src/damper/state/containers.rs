//! The containers: where the mount has them, and what the particles do to it.

use super::State;
use crate::mount::{Motion, Mount};
use crate::step_error::StepError;

impl State {
    /// Moves the containers to where the `mount` has them at `time`.
    pub(crate) fn place_containers(
        &mut self,
        mount: &dyn Mount,
        time: f64,
    ) -> Result<(), StepError> {
        let [coordinates, velocities] = self.mount_coordinates.own(self.degrees);
        let mut both = coordinates.iter().zip(velocities);
        if let Some(coordinate) = both.position(|(x, v)| !(x.is_finite() && v.is_finite())) {
            return Err(StepError::Mount {
                coordinate,
                value: coordinates[coordinate],
                rate: velocities[coordinate],
            });
        }
        for (cavity, compartment) in self.compartments.iter_mut().enumerate() {
            let motion = mount.motion(time, coordinates, velocities, cavity);
            let motion = checked(motion, cavity, compartment.planar)?;
            compartment.place(motion);
            if !self.holds_forces {
                compartment.torque_origin = motion.position;
            }
        }
        Ok(())
    }

    /// Keeps the mount's accelerations as the previous ones.
    pub(crate) fn keep_mount_accelerations(&mut self) {
        let previous = &mut self.previous.mount;
        previous.copy_from_slice(&self.mount_coordinates.acceleration);
    }

    /// The mount's accelerations under the loads on the walls.
    pub(crate) fn accelerate_mount(&mut self, mount: &dyn Mount, time: f64) {
        for (compartment, load) in self.compartments.iter().zip(&mut self.loads) {
            *load = compartment.load(&self.wall_loads);
        }
        let degrees = self.degrees;
        let state = &mut self.mount_coordinates;
        let compartments = self.compartments.iter();
        let origins = compartments.map(|compartment| compartment.motion.position);
        state.sum_up(degrees, self.loads.iter().copied().zip(origins));
        mount.accelerate(
            time,
            &state.position[..degrees],
            &state.velocity[..degrees],
            &self.loads,
            &mut state.acceleration[..degrees],
        );
    }

    /// Works out anew how containers yield that turn as they do: where they stand counts.
    pub(crate) fn update_mobilities(&mut self, mount: &dyn Mount) {
        if !self.mobilities.turn() {
            return;
        }
        let own = self.mount_coordinates.own(self.degrees);
        self.mobilities.update(mount, self.time, own);
        for (cavity, compartment) in self.compartments.iter_mut().enumerate() {
            compartment.set_mobility(&self.mobilities.own(cavity));
        }
    }

    /// Lets the mount begin the next step with other coordinates.
    pub(crate) fn rebase_mount(&mut self, mount: &dyn Mount) {
        let own = &mut self.mount_coordinates;
        let coordinates = &mut own.position[..self.degrees];
        mount.rebase(coordinates, &mut own.velocity[..self.degrees]);
    }
}

/// `motion` with its orientation normalised, unless no container can move so. Most motions are translations, and
/// done with early.
pub(crate) fn checked(motion: Motion, cavity: usize, planar: bool) -> Result<Motion, StepError> {
    let Motion {
        position,
        velocity,
        orientation,
        angular_velocity,
    } = motion;
    if !(position.is_finite() && velocity.is_finite()) {
        return Err(StepError::Container {
            cavity,
            position,
            velocity,
        });
    }
    if motion.is_translation() && (!planar || motion.is_in_plane()) {
        return Ok(motion);
    }
    let unfit = StepError::Orientation {
        cavity,
        orientation,
        angular_velocity,
    };
    if !motion.is_finite() {
        return Err(unfit);
    }
    if planar && !motion.is_in_plane() {
        return Err(if motion.is_translation() {
            StepError::OutOfPlane {
                cavity,
                position,
                velocity,
            }
        } else {
            StepError::TurnsOutOfPlane {
                cavity,
                orientation,
                angular_velocity,
            }
        });
    }
    motion.normalized().ok_or(unfit)
}
