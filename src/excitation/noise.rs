use std::f64::consts::{PI, TAU};

use super::Signal;
use crate::error::{Bound, ValueError};
use crate::random::Random;

/// Stationary, nearly Gaussian noise with a flat spectrum between two frequencies: a sum of sines by
/// spectral representation (Shinozuka & Deodatis 1991, doi 10.1115/1.3119501).
///
/// `RMS sqrt(2 / n) sum of sin(2 pi f_i t + phi_i)`, i = 1 ... n. The band is cut into n equal slices;
/// `f_i` is uniform in the i-th of them, so that the noise does not repeat itself, and `phi_i` is
/// uniform in a turn. The RMS is that of a long time, many times n over the width of the band.
///
/// One value costs n sines. The same seed gives the same noise to the bit everywhere.
///
/// ```
/// use particle_damper::excitation::{BandLimitedNoise, Signal};
///
/// let noise = BandLimitedNoise::new(0.25, [4.0, 8.0], 64, 1)?;
/// assert_eq!(noise.value(1.0), BandLimitedNoise::new(0.25, [4.0, 8.0], 64, 1)?.value(1.0));
/// # Ok::<(), particle_damper::ValueError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct BandLimitedNoise {
    amplitude: f64,
    /// Angular frequency in rad/s and phase in rad.
    components: Vec<[f64; 2]>,
}

impl BandLimitedNoise {
    /// Noise of a long-time `rms` (N or m), between the two frequencies of `band` (Hz), of as many
    /// sines as `components`.
    ///
    /// # Errors
    /// If the RMS or the lower frequency is negative or not finite, the upper frequency is not above
    /// the lower one, or there is no component.
    pub fn new(rms: f64, band: [f64; 2], components: u16, seed: u64) -> Result<Self, ValueError> {
        let low = Bound::NonNegative.check("lower frequency (Hz)", band[0])?;
        let high = Bound::Above(low).check("upper frequency (Hz)", band[1])?;
        let count = Bound::AtLeast(1.0).check("number of components", f64::from(components))?;
        let mut random = Random::new(seed);
        let slice = (high - low) / count;
        Ok(Self {
            amplitude: Bound::NonNegative.check("RMS of the noise", rms)? * (2.0 / count).sqrt(),
            components: (0..components)
                .map(|number| {
                    let frequency = low + slice * (f64::from(number) + random.unit());
                    [TAU * frequency, TAU * random.unit()]
                })
                .collect(),
        })
    }
}

impl Signal for BandLimitedNoise {
    fn at(&self, time: f64) -> [f64; 2] {
        let (mut value, mut rate) = (0.0, 0.0);
        for [omega, phase] in &self.components {
            let angle = omega * time + phase;
            value += libm::sin(angle);
            rate += omega * libm::cos(angle);
        }
        [self.amplitude * value, self.amplitude * rate]
    }

    fn value(&self, time: f64) -> f64 {
        let mut value = 0.0;
        for [omega, phase] in &self.components {
            value += libm::sin(omega * time + phase);
        }
        self.amplitude * value
    }

    fn shortest_feature(&self) -> f64 {
        let omega = self.components.iter().map(|[omega, _]| *omega);
        PI / omega.fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::super::signal::assert_rate_is_derivative;
    use super::*;

    #[test]
    fn the_rate_is_the_derivative() {
        let noise = BandLimitedNoise::new(1.0, [0.0, 5.0], 100, 3).unwrap();
        let times = (-50..50).map(|step| f64::from(step) * 0.0731);
        assert_rate_is_derivative(&noise, times, 1e-4, 1e-8);
    }

    #[test]
    fn mean_rms_and_kurtosis_over_a_long_time_are_those_of_gaussian_noise() {
        let noise = BandLimitedNoise::new(0.25, [4.0, 8.0], 64, 11).unwrap();
        let count = 100_000;
        let [mut sum, mut squares, mut fourths] = [0.0; 3];
        for step in 0..count {
            let value = noise.value(f64::from(step) * 0.0317);
            sum += value;
            squares += value * value;
            fourths += value.powi(4);
        }
        let n = f64::from(count);
        let rms = (squares / n).sqrt();
        assert!((sum / n).abs() < 1e-3 * rms, "mean {}", sum / n);
        assert!((rms / 0.25 - 1.0).abs() < 5e-3, "{rms}");
        // Of n sines with random phases, 3 - 1.5 / n.
        let kurtosis = fourths / n / rms.powi(4);
        assert!((kurtosis - (3.0 - 1.5 / 64.0)).abs() < 0.06, "{kurtosis}");
    }

    #[test]
    fn the_power_lies_within_the_band_and_evenly() {
        let noise = BandLimitedNoise::new(1.0, [4.0, 8.0], 64, 5).unwrap();
        // Power within 0.5 Hz around a frequency, by a Hann-windowed sum over 32 s.
        let (duration, count) = (32.0, 4096_u32);
        let power = |centre: f64| -> f64 {
            (-8..8)
                .map(|bin| {
                    let frequency = centre + (f64::from(bin) + 0.5) / duration;
                    let (mut re, mut im) = (0.0, 0.0);
                    for step in 0..count {
                        let share = f64::from(step) / f64::from(count);
                        let window = 1.0 - (TAU * share).cos();
                        let value = window * noise.value(share * duration) / f64::from(count);
                        let (sin, cos) = (TAU * frequency * share * duration).sin_cos();
                        re += value * cos;
                        im += value * sin;
                    }
                    // Both sides of the spectrum, and the mean square 1.5 of the window.
                    2.0 * (re * re + im * im) / 1.5
                })
                .sum()
        };
        for centre in [2.0, 3.0, 9.0, 12.0] {
            assert!(power(centre) < 1e-4, "{centre} Hz: {}", power(centre));
        }
        let inside: Vec<f64> = (0..8).map(|i| power(4.25 + 0.5 * f64::from(i))).collect();
        let total: f64 = inside.iter().sum();
        assert!((total - 1.0).abs() < 0.1, "{total}");
    }

    #[test]
    fn the_same_seed_gives_the_same_bits_and_another_one_other_noise() {
        let noise = |seed| BandLimitedNoise::new(1.0, [4.0, 8.0], 16, seed).unwrap();
        assert_eq!(noise(1), noise(1));
        assert_ne!(noise(1), noise(2));
        let [omega, phase] = noise(1).components[7];
        let bits = [omega.to_bits(), phase.to_bits()];
        assert_eq!(bits, [0x4042_6814_971b_6d57, 0x3ff0_cacc_dfce_550b]);
    }

    #[test]
    fn unusable_numbers_are_refused() {
        assert!(BandLimitedNoise::new(-1.0, [4.0, 8.0], 8, 0).is_err());
        assert!(BandLimitedNoise::new(1.0, [8.0, 8.0], 8, 0).is_err());
        assert!(BandLimitedNoise::new(1.0, [4.0, f64::INFINITY], 8, 0).is_err());
        assert!(BandLimitedNoise::new(1.0, [4.0, 8.0], 0, 0).is_err());
    }
}
