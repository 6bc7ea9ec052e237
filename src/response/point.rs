use std::fmt;

use super::Drive;

/// One point of a response curve. It is measured by itself, whatever other points there are.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Point {
    /// Number of particles N, in each cavity.
    pub particles: usize,
    /// Seed of the initial filling.
    pub seed: u64,
    /// Amplitude of the drive: of a force in N, of a motion in m.
    pub amplitude: f64,
    /// Frequency f of the drive in Hz.
    pub frequency: f64,
}

impl Point {
    /// The drive at this point.
    #[must_use]
    pub const fn drive(&self) -> Drive {
        Drive {
            amplitude: self.amplitude,
            frequency: self.frequency,
        }
    }
}

impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            particles,
            seed,
            amplitude,
            frequency,
        } = self;
        write!(
            f,
            "{particles} particles, seed {seed}, amplitude {amplitude}, {frequency} Hz"
        )
    }
}

/// The steady response at one point: of what is watched, x, over the averaged periods.
///
/// Amplitudes are over the structure's [unit](super::Structure::unit), which is the static deflection F/K
/// unless a structure is set, and have none of their own then; a sine of amplitude a has the RMS a / sqrt 2.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Response {
    /// Where it was measured.
    pub point: Point,
    /// Length of a step in s.
    pub time_step: f64,
    /// RMS of x about zero: the paper's ordinate. It holds the deflection under the particles' weight,
    /// N m g / K.
    pub rms_zero: f64,
    /// RMS of x about its mean (its standard deviation).
    pub rms_mean: f64,
    /// Mean of x; negative where the bed weighs the oscillator down.
    pub mean: f64,
    /// Amplitude of the Fourier component of x at the frequency of the drive.
    pub first_harmonic: f64,
    /// By how much that component lags behind the drive, in rad from -pi to pi.
    pub phase_lag: f64,
    /// How sure these are; none of fewer than 4 averaged periods.
    pub half_widths: Option<HalfWidths>,
    /// Whether the start was over when averaging began, as far as the averaged periods tell by
    /// [`steady_state`](crate::statistics::steady_state). It takes 20 periods to know. If not, run longer.
    pub settled: bool,
    /// How many periods were discarded at the start.
    pub discarded: u32,
    /// How many periods were averaged.
    pub averaged: u32,
    /// The largest overlap of the whole run in m, discarded periods included.
    pub max_overlap: f64,
    /// The largest number of particles that were outside the cavity at the end of a period. Not zero
    /// only if the curve is not [`contained`](super::ResponseCurve::contained).
    pub outside: usize,
}

/// Half-widths of the intervals that hold what endless runs would give with a confidence of 95 %, from
/// the periods' own values ([`statistics`](crate::statistics)). Chance of the filling is not in them:
/// compare seeds.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct HalfWidths {
    /// Of [`Response::rms_zero`].
    pub rms_zero: f64,
    /// Of [`Response::rms_mean`].
    pub rms_mean: f64,
    /// Of [`Response::mean`].
    pub mean: f64,
    /// Of [`Response::first_harmonic`].
    pub first_harmonic: f64,
}

#[cfg(all(test, feature = "serde"))]
mod tests {
    use std::ops::ControlFlow;

    use super::super::{Branches, Swept};
    use super::*;
    use crate::{Material, ResponseCurve, RestitutionImpulse};

    /// Points go out and responses come back as text or bytes, and keep every bit.
    #[test]
    fn points_and_responses_are_written_and_read_to_the_bit() {
        let curve = ResponseCurve::new(RestitutionImpulse::new(Material::acrylic()))
            .particles([6])
            .seeds([u64::MAX])
            .frequencies([5.0 + 1e-15, 17.0 / 3.0])
            .periods(2, 6);
        let responses = curve.run(|_| ControlFlow::Continue(())).unwrap();
        let text = serde_json::to_string(&curve.points()).unwrap();
        let points: Vec<Point> = serde_json::from_str(&text).unwrap();
        let gathered = points.into_iter().map(|point| {
            let response = curve.measure(point, |_| ControlFlow::Continue(())).unwrap();
            let bytes = postcard::to_allocvec(&response).unwrap();
            let response: Response = postcard::from_bytes(&bytes).unwrap();
            let text = serde_json::to_string(&response).unwrap();
            serde_json::from_str(&text).unwrap()
        });
        assert_eq!(gathered.collect::<Vec<Response>>(), responses);

        let line = curve.lines(Swept::Frequency)[0];
        let text = serde_json::to_string(&line).unwrap();
        let followed = curve.follow(serde_json::from_str(&text).unwrap(), |_, _| {
            ControlFlow::Continue(())
        });
        let followed = followed.unwrap();
        let text = serde_json::to_string(&followed).unwrap();
        assert_eq!(serde_json::from_str::<Branches>(&text).unwrap(), followed);
    }
}
