//! Excitations of a mount.

use std::f64::consts::TAU;

use crate::error::{Bound, ValueError};

/// What drives an oscillator: an external force as a function of time, which may depend on the
/// oscillator's support (base excitation).
///
/// Any closure from time (s) to force (N) is an excitation, and `()` is none at all.
pub trait Excitation {
    /// Force on the mass in N at `time` (s). `damping` (N s/m) and `stiffness` (N/m) are those of the
    /// support.
    fn force(&self, time: f64, damping: f64, stiffness: f64) -> f64;
}

impl Excitation for () {
    fn force(&self, _time: f64, _damping: f64, _stiffness: f64) -> f64 {
        0.0
    }
}

impl<F: Fn(f64) -> f64> Excitation for F {
    fn force(&self, time: f64, _damping: f64, _stiffness: f64) -> f64 {
        self(time)
    }
}

/// A sine: amplitude times sin(2 pi f t). As an excitation, the paper's f_d of Eq. (1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    amplitude: f64,
    angular_frequency: f64,
}

impl Harmonic {
    /// A sine of `amplitude` and `frequency` (Hz).
    ///
    /// # Errors
    /// If the amplitude is not finite, or the frequency is negative or not finite.
    pub fn new(amplitude: f64, frequency: f64) -> Result<Self, ValueError> {
        Ok(Self {
            amplitude: Bound::Finite.check("amplitude", amplitude)?,
            angular_frequency: TAU * Bound::NonNegative.check("frequency (Hz)", frequency)?,
        })
    }
}

impl Excitation for Harmonic {
    fn force(&self, time: f64, _damping: f64, _stiffness: f64) -> f64 {
        self.amplitude * (self.angular_frequency * time).sin()
    }
}
