use std::f64::consts::{PI, TAU};

use super::Signal;
use crate::error::{Bound, ValueError};

/// A sine, A sin(2 pi f t + phi). As a force, the paper's `f_d` of Eq. (1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    amplitude: f64,
    angular_frequency: f64,
    phase: f64,
}

impl Harmonic {
    /// A sine of `amplitude` A (N or m) and `frequency` f (Hz), zero and rising at time zero.
    ///
    /// # Errors
    /// If the amplitude is not finite, or the frequency is negative or not finite.
    pub fn new(amplitude: f64, frequency: f64) -> Result<Self, ValueError> {
        Ok(Self {
            amplitude: Bound::Finite.check("amplitude", amplitude)?,
            angular_frequency: TAU * Bound::NonNegative.check("frequency (Hz)", frequency)?,
            phase: 0.0,
        })
    }

    /// The same sine with the phase phi (rad) at time zero; pi/2 makes it a cosine.
    ///
    /// # Errors
    /// If the phase is not finite.
    pub fn with_phase(mut self, phase: f64) -> Result<Self, ValueError> {
        self.phase = Bound::Finite.check("phase (rad)", phase)?;
        Ok(self)
    }
}

impl Signal for Harmonic {
    #[inline]
    fn at(&self, time: f64) -> [f64; 2] {
        let angle = self.angular_frequency * time + self.phase;
        [
            self.amplitude * libm::sin(angle),
            self.amplitude * self.angular_frequency * libm::cos(angle),
        ]
    }

    #[inline]
    fn value(&self, time: f64) -> f64 {
        self.amplitude * libm::sin(self.angular_frequency * time + self.phase)
    }

    fn shortest_feature(&self) -> f64 {
        PI / self.angular_frequency
    }
}

#[cfg(test)]
mod tests {
    use super::super::signal::assert_rate_is_derivative;
    use super::*;

    #[test]
    fn the_rate_is_the_derivative_and_a_quarter_turn_is_a_cosine() {
        let sine = Harmonic::new(2.0, 0.7).unwrap();
        let times = (-50..50).map(|step| f64::from(step) * 0.37);
        assert_rate_is_derivative(&sine, times, 1e-3, 1e-9);
        let cosine = sine.with_phase(TAU / 4.0).unwrap();
        assert!((cosine.value(0.0) - 2.0).abs() < 1e-15);
        assert!((cosine.value(1.2) - sine.at(1.2)[1] / (TAU * 0.7)).abs() < 1e-14);
    }

    #[test]
    fn unusable_numbers_are_refused() {
        assert!(Harmonic::new(f64::NAN, 1.0).is_err());
        assert!(Harmonic::new(1.0, -1.0).is_err());
        assert!(
            Harmonic::new(1.0, 1.0)
                .unwrap()
                .with_phase(f64::INFINITY)
                .is_err()
        );
    }
}
