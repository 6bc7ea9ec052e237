use std::f64::consts::PI;

use super::{Jump, Signal};
use crate::error::{Bound, ValueError};

/// One half wave of a sine, A sin(pi (t - t0) / T) for t0 < t < t0 + T and nothing before and after: the
/// classical shock pulse. Its impulse is 2 A T / pi.
///
/// It sets in and ends with a kink, so that a base cannot follow it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSine {
    peak: f64,
    duration: f64,
    start: f64,
}

impl HalfSine {
    /// A pulse of `peak` A (N) that lasts for `duration` T (s) from time zero on.
    ///
    /// # Errors
    /// If the peak is not finite, or the duration is not positive and finite.
    pub fn new(peak: f64, duration: f64) -> Result<Self, ValueError> {
        Ok(Self {
            peak: Bound::Finite.check("peak", peak)?,
            duration: Bound::Positive.check("duration of the pulse (s)", duration)?,
            start: 0.0,
        })
    }

    /// The same pulse from `start` t0 (s) on.
    ///
    /// # Errors
    /// If the time is not finite.
    pub fn starting_at(mut self, start: f64) -> Result<Self, ValueError> {
        self.start = Bound::Finite.check("start of the pulse (s)", start)?;
        Ok(self)
    }
}

impl Signal for HalfSine {
    fn at(&self, time: f64) -> [f64; 2] {
        let s = (time - self.start) / self.duration;
        if !(0.0..=1.0).contains(&s) {
            return [0.0; 2];
        }
        let rate = PI / self.duration;
        [
            self.peak * libm::sin(PI * s),
            self.peak * rate * libm::cos(PI * s),
        ]
    }

    fn shortest_feature(&self) -> f64 {
        self.duration
    }

    fn jump(&self) -> Option<Jump> {
        (self.peak != 0.0).then_some(Jump {
            time: self.start,
            value: 0.0,
            rate: self.peak * PI / self.duration,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::signal::assert_rate_is_derivative;
    use super::*;

    #[test]
    fn the_pulse_has_its_peak_its_impulse_and_nothing_outside() {
        let pulse = HalfSine::new(3.0, 0.2).unwrap().starting_at(1.0).unwrap();
        assert!((pulse.value(1.1) - 3.0).abs() < 1e-14);
        assert!(pulse.value(0.999).abs() + pulse.value(1.201).abs() < 1e-300);
        let times = (1..50).map(|step| 1.0 + 0.004 * f64::from(step));
        assert_rate_is_derivative(&pulse, times, 1e-4, 1e-6);
        let sum: f64 = (0..2000)
            .map(|step| pulse.value(1.0 + 1e-4 * f64::from(step)))
            .sum();
        assert!((sum * 1e-4 - 2.0 * 3.0 * 0.2 / PI).abs() < 1e-6);
    }
}
