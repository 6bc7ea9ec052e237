use std::fmt;

/// One point of a response curve. It is measured by itself, whatever other points there are.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Point {
    /// Number of particles N.
    pub particles: usize,
    /// Seed of the initial filling.
    pub seed: u64,
    /// Frequency f of the force in Hz.
    pub frequency: f64,
}

impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            particles,
            seed,
            frequency,
        } = self;
        write!(f, "{particles} particles, seed {seed}, {frequency} Hz")
    }
}

/// The steady response at one point: of the oscillator's displacement x, over the averaged periods.
///
/// Amplitudes are over the static deflection F/K and have no unit; a sine of amplitude a has the RMS
/// a / sqrt 2.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Response {
    /// Where it was measured.
    pub point: Point,
    /// Length of a step in s.
    pub time_step: f64,
    /// RMS of x about zero, over F/K: the paper's ordinate. It holds the deflection under the
    /// particles' weight, N m g / K.
    pub rms_zero: f64,
    /// RMS of x about its mean (its standard deviation), over F/K.
    pub rms_mean: f64,
    /// Mean of x, over F/K; negative where the bed weighs the oscillator down.
    pub mean: f64,
    /// Amplitude of the Fourier component of x at the frequency of the force, over F/K.
    pub first_harmonic: f64,
    /// By how much that component lags behind the force, in rad from -pi to pi.
    pub phase_lag: f64,
    /// The largest overlap of the whole run in m, discarded periods included.
    pub max_overlap: f64,
    /// The largest number of particles that were outside the cavity at the end of a period. Not zero
    /// only if the curve is not [`contained`](super::ResponseCurve::contained).
    pub outside: usize,
}
