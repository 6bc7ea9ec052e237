//! The state of the mount, and the impulses on its containers.

use glam::DVec3;

use crate::mount::{Load, Mount};

/// How many numbers of the state a cavity has: impulse and angular impulse.
const PER_CAVITY: usize = 6;

/// Coordinates of the mount, followed by six per cavity whose velocities sum up the impulse on its
/// container, and the angular impulse about where its origin was when the sums began. Integrating them along
/// with the rest makes that impulse exactly the momentum that the particles lost, whatever the integrator.
#[derive(Debug, Clone, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct MountCoordinates {
    pub(crate) position: Vec<f64>,
    pub(crate) velocity: Vec<f64>,
    pub(crate) acceleration: Vec<f64>,
    /// Where the containers' origins were when the sums began, m.
    pub(crate) origins: Vec<DVec3>,
}

impl MountCoordinates {
    pub(crate) fn new(mount: &dyn Mount, cavities: usize) -> Self {
        let degrees = mount.degrees();
        let count = degrees + PER_CAVITY * cavities;
        let mut state = Self {
            position: vec![0.0; count],
            velocity: vec![0.0; count],
            acceleration: vec![0.0; count],
            origins: vec![DVec3::ZERO; cavities],
        };
        mount.start(
            &mut state.position[..degrees],
            &mut state.velocity[..degrees],
        );
        state
    }

    /// The mount's own coordinates, of which there are `degrees`, and their rates.
    #[inline]
    pub(crate) fn own(&self, degrees: usize) -> [&[f64]; 2] {
        [&self.position[..degrees], &self.velocity[..degrees]]
    }

    /// Starts the sums afresh, with the containers' origins at `origins`. The mount has `degrees`
    /// coordinates.
    pub(crate) fn reset_impulses(&mut self, degrees: usize, origins: impl Iterator<Item = DVec3>) {
        self.position[degrees..].fill(0.0);
        self.velocity[degrees..].fill(0.0);
        let rates = self.acceleration[degrees..].chunks_exact_mut(PER_CAVITY);
        for ((own, origin), rate) in self.origins.iter_mut().zip(origins).zip(rates) {
            // What holds at the start of the next step is about the new origin, too.
            let [force, torque] = [&rate[..3], &rate[3..]].map(DVec3::from_slice);
            let moved = Load::new(force, torque).torque_about(origin - *own);
            moved.write_to_slice(&mut rate[3..]);
            *own = origin;
        }
    }

    /// Impulse on the container of a cavity, and angular impulse about its `origin` (m).
    pub(crate) fn impulses(
        &self,
        degrees: usize,
        cavity: usize,
        origin: DVec3,
    ) -> Option<[DVec3; 2]> {
        let first = degrees + PER_CAVITY * cavity;
        let sums = self.velocity.get(first..first + PER_CAVITY)?;
        let [impulse, angular] = [&sums[..3], &sums[3..]].map(DVec3::from_slice);
        let moved = origin - self.origins[cavity];
        Some([impulse, angular - moved.cross(impulse)])
    }

    /// The impulse on the container of a cavity among the `sums`, which are this state's or were.
    pub(crate) fn impulse_among(sums: &[f64], cavity: usize) -> Option<DVec3> {
        let first = PER_CAVITY * cavity;
        Some(DVec3::from_slice(sums.get(first..first + 3)?))
    }

    /// Sets the rates of the sums: force and torque on each container, about its origin.
    pub(crate) fn sum_up(&mut self, degrees: usize, loads: impl Iterator<Item = (Load, DVec3)>) {
        let sums = self.acceleration[degrees..].chunks_exact_mut(PER_CAVITY);
        for ((sum, (load, origin)), start) in sums.zip(loads).zip(&self.origins) {
            let torque = load.torque_about(*start - origin);
            load.force.write_to_slice(sum);
            torque.write_to_slice(&mut sum[3..]);
        }
    }
}
