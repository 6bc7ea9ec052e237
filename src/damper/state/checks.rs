//! What a step refuses of the state.

use super::State;
use crate::step_error::StepError;

impl State {
    /// Refuses positions that are not finite.
    pub(crate) fn check_finite(&self) -> Result<(), StepError> {
        let bad = self
            .particles
            .position
            .iter()
            .position(|position| !position.is_finite());
        bad.map_or(Ok(()), |index| Err(self.not_finite(index)))
    }

    fn not_finite(&self, index: usize) -> StepError {
        StepError::NotFinite {
            particle: self.particles.id[index] as usize,
            position: self.particles.position.get(index),
            acceleration: self.particles.acceleration.get(index),
        }
    }

    pub(crate) fn check_accelerations(&self) -> Result<(), StepError> {
        let particles = &self.particles;
        let turning = particles.angular_acceleration.iter();
        let mut both = particles.acceleration.iter().zip(turning);
        let bad = both.position(|(a, turning)| !(a.is_finite() && turning.is_finite()));
        bad.map_or(Ok(()), |index| Err(self.not_finite(index)))
    }
}
