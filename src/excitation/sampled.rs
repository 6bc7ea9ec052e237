use super::Signal;
use crate::error::{Bound, ValueError};

/// A measured record, sampled evenly from time zero on: a force in N, or the motion of a base.
///
/// Between the samples runs the cubic Hermite with Catmull-Rom slopes (central differences; at both
/// ends the slope of the parabola through three samples), so that value and rate are continuous and
/// a parabola is met exactly. Before and after the record its first and its last value hold.
///
/// ```
/// use particle_damper::excitation::{Base, Sampled, Signal};
///
/// let csv = "0.0\n0.1\n0.4\n0.9\n";
/// let values = csv.lines().map(str::parse).collect::<Result<Vec<f64>, _>>()?;
/// let record = Sampled::new(0.5, values)?;
/// assert!((record.value(0.75) - 0.225).abs() < 1e-15);
///
/// // A base of which the acceleration (m/s^2) was recorded, from rest.
/// let base = Base(record.integral().integral());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Sampled {
    interval: f64,
    /// Value, and rate times the interval.
    knots: Vec<[f64; 2]>,
}

/// Why a record is of no use.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SampledError {
    /// There is no sample.
    #[error("a record needs one sample at the least")]
    Empty,
    /// A sample is NaN or infinite.
    #[error("sample {number} of the record is {value}; it must be finite")]
    NotFinite {
        /// Number of the sample, from 0.
        number: usize,
        /// Its value.
        value: f64,
    },
    /// The sampling interval is outside its range.
    #[error(transparent)]
    Value(#[from] ValueError),
}

impl Sampled {
    /// The record of `values` (N or m, or m/s^2 to be integrated), one every `interval` (s).
    ///
    /// # Errors
    /// If the interval is not positive and finite, there is no value, or one is not finite.
    pub fn new(interval: f64, values: impl Into<Vec<f64>>) -> Result<Self, SampledError> {
        let interval = Bound::Positive.check("sampling interval (s)", interval)?;
        let y: Vec<f64> = values.into();
        if let Some(number) = y.iter().position(|value| !value.is_finite()) {
            return Err(SampledError::NotFinite {
                number,
                value: y[number],
            });
        }
        let end = y.len().checked_sub(1).ok_or(SampledError::Empty)?;
        let slope = |i: usize| match (i, end) {
            (_, 0) => 0.0,
            (_, 1) => y[1] - y[0],
            (0, _) => 2.0 * y[1] - 1.5 * y[0] - 0.5 * y[2],
            (i, end) if i == end => 1.5 * y[i] - 2.0 * y[i - 1] + 0.5 * y[i - 2],
            (i, _) => 0.5 * (y[i + 1] - y[i - 1]),
        };
        Ok(Self {
            interval,
            knots: (0..=end).map(|i| [y[i], slope(i)]).collect(),
        })
    }

    /// The running integral over time, from zero at the first sample: of an acceleration the
    /// velocity, of a velocity the displacement.
    ///
    /// At the sampling times it is the exact integral of the interpolated record, with the record
    /// itself as its rate. A mean that the record should not have grows to a drift: take it off
    /// first.
    #[must_use]
    pub fn integral(&self) -> Self {
        let mut sum = 0.0;
        let mut knots: Vec<[f64; 2]> = Vec::with_capacity(self.knots.len());
        for (i, &[value, slope]) in self.knots.iter().enumerate() {
            if i > 0 {
                let [value_before, slope_before] = self.knots[i - 1];
                sum += 0.5 * (value_before + value) + (slope_before - slope) / 12.0;
            }
            knots.push([self.interval * sum, self.interval * value]);
        }
        Self {
            interval: self.interval,
            knots,
        }
    }

    /// Time from the first to the last sample in s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        (self.knots.len() - 1) as f64 * self.interval
    }
}

impl Signal for Sampled {
    #[inline]
    fn at(&self, time: f64) -> [f64; 2] {
        let last = self.knots.len() - 1;
        let place = time / self.interval;
        if place < 0.0 {
            return [self.knots[0][0], 0.0];
        }
        let number = place as usize;
        if number >= last {
            return [self.knots[last][0], 0.0];
        }
        let s = place - number as f64;
        let ([y0, m0], [y1, m1]) = (self.knots[number], self.knots[number + 1]);
        let rise = y1 - y0;
        let (bend0, bend1) = (m0 - rise, m1 - rise);
        let r = 1.0 - s;
        let value = y0 + s * (rise + r * (r * bend0 - s * bend1));
        let slope = rise + r * (1.0 - 3.0 * s) * bend0 - s * (2.0 - 3.0 * s) * bend1;
        [value, slope / self.interval]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::signal::assert_rate_is_derivative;
    use super::*;

    fn record(interval: f64, count: u32, f: impl Fn(f64) -> f64) -> Sampled {
        let values: Vec<f64> = (0..count).map(|i| f(f64::from(i) * interval)).collect();
        Sampled::new(interval, values).unwrap()
    }

    #[test]
    fn a_parabola_is_met_exactly_and_its_rate_too() {
        let parabola = record(0.1, 20, |t| 3.0 * t * t - t + 0.5);
        for step in 0..190 {
            let t = f64::from(step) * 0.01;
            let [value, rate] = parabola.at(t);
            assert!((value - (3.0 * t * t - t + 0.5)).abs() < 1e-13, "at {t}");
            assert!((rate - (6.0 * t - 1.0)).abs() < 1e-11, "at {t}");
        }
    }

    #[test]
    fn the_first_and_the_last_value_hold_outside_the_record() {
        let line = record(0.5, 3, |t| 1.0 + t);
        let same = |[a, b]: [f64; 2], [c, d]: [f64; 2]| (a - c).abs() + (b - d).abs() < 1e-15;
        assert!(same(line.at(-3.0), [1.0, 0.0]));
        assert!(same(line.at(1.0), [2.0, 0.0]));
        assert!(same(line.at(1e300), [2.0, 0.0]));
        assert!(same(record(0.5, 1, |_| 7.0).at(0.2), [7.0, 0.0]));
        assert!(same(record(0.5, 2, |t| t).at(0.25), [0.25, 1.0]));
        assert!((line.duration() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn the_double_integral_of_an_acceleration_is_the_displacement() {
        // y = 1 - cos w t from rest, with y" = w^2 cos w t.
        let w = 7.0;
        let acceleration = record(1e-3, 4001, |t| w * w * (w * t).cos());
        let displacement = acceleration.integral().integral();
        for step in 0..400 {
            let t = f64::from(step) * 0.01;
            let [value, rate] = displacement.at(t);
            assert!((value - (1.0 - (w * t).cos())).abs() < 2e-7, "at {t}");
            assert!((rate - w * (w * t).sin()).abs() < 2e-7, "at {t}");
        }
    }

    #[test]
    fn an_unusable_record_is_refused_by_name() {
        assert_eq!(
            Sampled::new(0.1, Vec::new()).unwrap_err(),
            SampledError::Empty
        );
        let refused = Sampled::new(0.1, [1.0, f64::NAN]).unwrap_err();
        assert!(matches!(
            refused,
            SampledError::NotFinite { number: 1, value } if value.is_nan()
        ));
        assert!(matches!(
            Sampled::new(0.0, [1.0]).unwrap_err(),
            SampledError::Value(_)
        ));
    }

    proptest! {
        #[test]
        fn every_sample_is_met_and_the_rate_is_the_derivative(
            values in prop::collection::vec(-1.0..1.0_f64, 1..30),
            place in 0.0..1.0_f64,
        ) {
            let record = Sampled::new(1.0, values.clone()).unwrap();
            for (i, value) in values.iter().enumerate() {
                prop_assert!((record.value(i as f64) - value).abs() < 1e-15);
            }
            // Within an interval, where the cubic is one piece.
            let times = (0..values.len() - 1).map(|i| i as f64 + 0.01 + 0.98 * place);
            assert_rate_is_derivative(&record, times, 1e-3, 1e-10);
        }
    }
}
