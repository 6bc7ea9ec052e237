//! The state of the mount, and the impulses on its containers.

use crate::mount::Mount;

/// Coordinates of the mount, followed by three per cavity whose velocity sums up the impulse on its
/// container. Integrating them along with the rest makes that impulse exactly the momentum that the
/// particles lost, whatever the integrator.
#[derive(Debug, Clone, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct MountCoordinates {
    pub(crate) position: Vec<f64>,
    pub(crate) velocity: Vec<f64>,
    pub(crate) acceleration: Vec<f64>,
}

impl MountCoordinates {
    pub(crate) fn new<M: Mount>(mount: &M, cavities: usize) -> Self {
        let degrees = mount.degrees();
        let mut state = Self {
            position: vec![0.0; degrees + 3 * cavities],
            velocity: vec![0.0; degrees + 3 * cavities],
            acceleration: vec![0.0; degrees + 3 * cavities],
        };
        mount.start(
            &mut state.position[..degrees],
            &mut state.velocity[..degrees],
        );
        state
    }

    /// The mount's own coordinates, of which there are `degrees`.
    pub(crate) fn own(&self, degrees: usize) -> &[f64] {
        &self.position[..degrees]
    }

    /// Their rates.
    pub(crate) fn own_rates(&self, degrees: usize) -> &[f64] {
        &self.velocity[..degrees]
    }
}
