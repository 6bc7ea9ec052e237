//! Simulated time.

/// Counts equal steps, so that time does not gather rounding errors.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Clock {
    epoch: f64,
    steps: u64,
    step: f64,
}

impl Clock {
    pub(crate) const fn time(&self) -> f64 {
        self.epoch + self.steps as f64 * self.step
    }

    /// Whether a clock can show this.
    pub(crate) const fn is_sound(&self) -> bool {
        // Beyond 2^53 steps the count would no longer be exact.
        self.steps < 1 << 53 && self.time().is_finite() && self.step >= 0.0
    }

    pub(crate) const fn advance(&mut self, step: f64) {
        if step.to_bits() == self.step.to_bits() {
            self.steps += 1;
        } else {
            *self = Self {
                epoch: self.time(),
                steps: 1,
                step,
            };
        }
    }
}
