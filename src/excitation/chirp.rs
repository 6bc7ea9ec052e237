use std::f64::consts::TAU;

use super::Signal;
use crate::error::{Bound, ValueError};

/// A sine that sweeps from one frequency to another, A sin(phi(t)), with phi' = 2 pi f(t).
///
/// With s = t / T in [0, 1]: f = f0 + (f1 - f0) s ([`linear`](Self::linear)), or
/// f = f0 (f1 / f0)^s ([`logarithmic`](Self::logarithmic)). Before the sweep the sine has the first
/// frequency, after it the last one; value and rate are continuous throughout.
///
/// ```
/// use particle_damper::excitation::{Chirp, Signal};
///
/// // The paper's band, swept upwards within two minutes.
/// let sweep = Chirp::linear(0.25, [4.0, 8.0], 120.0)?;
/// assert_eq!(sweep.frequency(60.0), 6.0);
/// assert_eq!(sweep.frequency(500.0), 8.0);
/// # Ok::<(), particle_damper::ValueError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chirp {
    amplitude: f64,
    frequencies: [f64; 2],
    duration: f64,
    course: Course,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Course {
    Linear,
    /// f grows as exp(growth t), growth in 1/s and not zero.
    Logarithmic {
        growth: f64,
    },
}

impl Chirp {
    /// A sweep at a constant rate in Hz/s: `amplitude` A (N or m), from the first to the second of
    /// `frequencies` (Hz) within `duration` T (s).
    ///
    /// # Errors
    /// If the amplitude is not finite, a frequency is negative or not finite, or the duration is not
    /// positive and finite.
    pub fn linear(
        amplitude: f64,
        frequencies: [f64; 2],
        duration: f64,
    ) -> Result<Self, ValueError> {
        for frequency in frequencies {
            Bound::NonNegative.check("frequency (Hz)", frequency)?;
        }
        Ok(Self {
            amplitude: Bound::Finite.check("amplitude", amplitude)?,
            frequencies,
            duration: Bound::Positive.check("duration of the sweep (s)", duration)?,
            course: Course::Linear,
        })
    }

    /// A sweep at a constant number of octaves per second; arguments as of
    /// [`linear`](Self::linear).
    ///
    /// # Errors
    /// As [`linear`](Self::linear), and if a frequency is zero.
    pub fn logarithmic(
        amplitude: f64,
        frequencies: [f64; 2],
        duration: f64,
    ) -> Result<Self, ValueError> {
        for frequency in frequencies {
            Bound::Positive.check("frequency (Hz)", frequency)?;
        }
        let mut sweep = Self::linear(amplitude, frequencies, duration)?;
        let growth = (libm::log(frequencies[1]) - libm::log(frequencies[0])) / duration;
        if growth.abs() > 0.0 {
            sweep.course = Course::Logarithmic { growth };
        }
        Ok(sweep)
    }

    /// Instantaneous frequency in Hz at `time` (s).
    #[must_use]
    pub fn frequency(&self, time: f64) -> f64 {
        let [first, last] = self.frequencies;
        let elapsed = time.clamp(0.0, self.duration);
        match self.course {
            Course::Linear => first + (last - first) * (elapsed / self.duration),
            Course::Logarithmic { growth } => first * libm::exp(growth * elapsed),
        }
    }

    /// Phase in rad.
    #[inline]
    fn phase(&self, time: f64) -> f64 {
        let [first, last] = self.frequencies;
        let elapsed = time.clamp(0.0, self.duration);
        let turns = match self.course {
            Course::Linear => elapsed * (first + (last - first) * (0.5 * elapsed / self.duration)),
            Course::Logarithmic { growth } => first * (libm::expm1(growth * elapsed) / growth),
        };
        let dwell = time.min(0.0) * first + (time - self.duration).max(0.0) * last;
        TAU * (turns + dwell)
    }
}

impl Signal for Chirp {
    #[inline]
    fn at(&self, time: f64) -> [f64; 2] {
        let phase = self.phase(time);
        let rate = TAU * self.frequency(time);
        [
            self.amplitude * libm::sin(phase),
            self.amplitude * rate * libm::cos(phase),
        ]
    }

    #[inline]
    fn value(&self, time: f64) -> f64 {
        self.amplitude * libm::sin(self.phase(time))
    }

    fn shortest_feature(&self) -> f64 {
        0.5 / self.frequencies[0].max(self.frequencies[1])
    }
}

#[cfg(test)]
mod tests {
    use super::super::signal::assert_rate_is_derivative;
    use super::*;

    fn sweeps() -> [Chirp; 5] {
        [
            Chirp::linear(1.5, [1.0, 4.0], 10.0).unwrap(),
            Chirp::linear(1.5, [4.0, 0.0], 10.0).unwrap(),
            Chirp::logarithmic(1.5, [0.5, 4.0], 10.0).unwrap(),
            Chirp::logarithmic(1.5, [4.0, 0.5], 10.0).unwrap(),
            Chirp::logarithmic(1.5, [2.0, 2.0], 10.0).unwrap(),
        ]
    }

    #[test]
    fn the_rate_is_the_derivative_before_during_and_after_the_sweep() {
        for sweep in sweeps() {
            // Off both ends of the sweep, where the rate has a kink.
            let times = (-40..250).map(|step| 0.013 + f64::from(step) * 0.0731);
            assert_rate_is_derivative(&sweep, times, 1e-4, 1e-7);
        }
    }

    #[test]
    fn the_phase_grows_at_the_instantaneous_frequency() {
        for sweep in sweeps() {
            for step in -20..200_i32 {
                let t = f64::from(step) * 0.0931;
                let difference = (sweep.phase(t + 1e-5) - sweep.phase(t - 1e-5)) / 2e-5;
                assert!((difference / TAU - sweep.frequency(t)).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn the_sweep_starts_and_ends_at_its_frequencies_and_passes_the_mean() {
        let [up, down, log, ..] = sweeps();
        assert!((up.frequency(-1.0) - 1.0).abs() < 1e-12);
        assert!((up.frequency(5.0) - 2.5).abs() < 1e-12);
        assert!((down.frequency(11.0)).abs() < 1e-12);
        assert!((log.frequency(5.0) - 2_f64.sqrt()).abs() < 1e-12);
        assert!((log.frequency(10.0) - 4.0).abs() < 1e-12);
        // Cycles in the sweep: T (f1 - f0) / ln(f1 / f0).
        let cycles = 10.0 * 3.5 / 8_f64.ln();
        assert!((log.phase(10.0) / TAU - cycles).abs() < 1e-12);
    }

    #[test]
    fn unusable_numbers_are_refused() {
        assert!(Chirp::logarithmic(1.0, [0.0, 4.0], 1.0).is_err());
        assert!(Chirp::linear(1.0, [4.0, f64::NAN], 1.0).is_err());
        assert!(Chirp::linear(1.0, [4.0, 8.0], 0.0).is_err());
    }
}
