//! Accelerations of the evaluation before the last.

use super::{MountCoordinates, Particles, Vectors};

/// Accelerations as the evaluation before the last left them: what integrators that predict correct by.
#[derive(Debug, Clone, Default)]
pub(crate) struct PreviousAccelerations {
    /// Of the particles: accelerations and angular accelerations. The next evaluation sums up forces there,
    /// and they change places.
    pub(crate) particles: [Vectors; 2],
    /// Of the mount's coordinates.
    pub(crate) mount: Vec<f64>,
}

impl PreviousAccelerations {
    /// Room for as many as there are.
    pub(crate) fn new(particles: &Particles, mount: &MountCoordinates) -> Self {
        Self {
            particles: [
                particles.acceleration.clone(),
                particles.angular_acceleration.clone(),
            ],
            mount: vec![0.0; mount.acceleration.len()],
        }
    }

    /// Memory in bytes that they have reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        let columns = self.particles.each_ref().map(Vectors::reserved_bytes);
        columns.iter().sum()
    }
}
