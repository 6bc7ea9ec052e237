use std::f64::consts::PI;

use super::{Jump, Signal};
use crate::error::{Bound, ValueError};

/// A measured record, sampled evenly from time zero on: a force in N, or the motion of a base.
///
/// Between the samples runs the cubic Hermite with Catmull-Rom slopes (central differences; at both
/// ends the slope of the parabola through three samples), so that value and rate are continuous and
/// a parabola is met exactly. Before and after the record its first and its last value hold, unless it is
/// told to do otherwise ([`beyond`](Self::beyond)). Its integral is the integral of that, too.
///
/// ```
/// use particle_damper::excitation::{Base, Beyond, Sampled, Signal};
///
/// let csv = "0.0\n0.1\n0.4\n0.9\n";
/// let values = csv.lines().map(str::parse).collect::<Result<Vec<f64>, _>>()?;
/// let record = Sampled::new(0.5, values)?;
/// assert!((record.value(0.75) - 0.225).abs() < 1e-15);
///
/// // A base of which the acceleration (m/s^2) was recorded, from rest; it goes on at its last speed.
/// let base = record.beyond(Beyond::Zero).integral().integral();
/// let [place, speed] = base.at(1.5);
/// assert!((base.value(2.5) - (place + speed)).abs() < 1e-15);
/// let base = Base(base);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Sampled {
    interval: f64,
    /// Value, and rate times the interval.
    knots: Vec<[f64; 2]>,
    /// Coefficients of the polynomials before the first and after the last sample, in powers of the time
    /// from there in s.
    outside: [Vec<f64>; 2],
    /// Whether what lies outside was asked for.
    chosen: bool,
}

/// What a record is before its first and after its last sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Beyond {
    /// The first and the last value hold. A record of a place that ends at speed stops there in no time.
    Hold,
    /// Nothing: a force that is not there yet or any more, an acceleration of a base at rest or at a
    /// steady speed.
    Zero,
    /// It goes on along its slope: a base at its last speed.
    Continue,
}

/// A part of the largest rate that passes for rest where a record ends: measured records end in noise of some
/// parts in a thousand.
const AT_REST: f64 = 0.01;

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
            outside: [vec![y[0]], vec![y[end]]],
            chosen: false,
        })
    }

    /// The same record with another course before its first and after its last sample.
    #[must_use]
    pub fn beyond(mut self, beyond: Beyond) -> Self {
        self.outside = self.ends().map(|[value, rate]| match beyond {
            Beyond::Hold => vec![value],
            Beyond::Zero => Vec::new(),
            Beyond::Continue => vec![value, rate],
        });
        self.chosen = true;
        self
    }

    /// Value and rate at the first and at the last sample.
    fn ends(&self) -> [[f64; 2]; 2] {
        let last = self.knots.len() - 1;
        [0, last].map(|i| [self.knots[i][0], self.knots[i][1] / self.interval])
    }

    /// The largest rate, at the samples and on the mean between two.
    fn largest_rate(&self) -> f64 {
        let at_knots = self.knots.iter().map(|[_, slope]| slope.abs());
        let between = self
            .knots
            .windows(2)
            .map(|two| (two[1][0] - two[0][0]).abs());
        at_knots.chain(between).fold(0.0, f64::max) / self.interval
    }

    /// The running integral over time, from zero at the first sample: of an acceleration the
    /// velocity, of a velocity the displacement.
    ///
    /// At the sampling times it is the exact integral of the interpolated record, with the record
    /// itself as its rate; before and after them it is the integral of what the record
    /// [is there](Self::beyond). A mean that the record should not have grows to a drift: take it off
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
        let [before, after] = &self.outside;
        Self {
            interval: self.interval,
            outside: [risen(before, 0.0), risen(after, self.interval * sum)],
            knots,
            chosen: self.chosen,
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
            return polynomial(&self.outside[0], time);
        }
        let number = place as usize;
        if number >= last {
            return polynomial(&self.outside[1], time - last as f64 * self.interval);
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

    /// The time in which the record would run through half a sine wave of its own size at its largest
    /// rate: half a period of a sine, the length of a half-sine pulse.
    fn shortest_feature(&self) -> f64 {
        let values = || self.knots.iter().map(|[value, _]| value);
        let mean = values().sum::<f64>() / self.knots.len() as f64;
        let size = values()
            .map(|value| (value - mean).abs())
            .fold(0.0, f64::max);
        let rate = self.largest_rate();
        if rate > 0.0 {
            PI * size / rate
        } else {
            f64::INFINITY
        }
    }

    fn jump(&self) -> Option<Jump> {
        let still = AT_REST * self.largest_rate();
        let times = [0.0, self.duration()];
        let mut ends = times.into_iter().zip(self.ends()).zip(&self.outside);
        ends.find_map(|((time, [value, rate]), outside)| {
            let [value_outside, rate_outside] = polynomial(outside, 0.0);
            let jump = Jump {
                time,
                value: value - value_outside,
                rate: rate - rate_outside,
            };
            let unasked = !self.chosen && jump.rate.abs() > still;
            (jump.value != 0.0 || unasked).then_some(jump)
        })
    }
}

/// Value and rate of a polynomial at `time`.
fn polynomial(coefficients: &[f64], time: f64) -> [f64; 2] {
    let terms = coefficients.iter().rev();
    terms.fold([0.0; 2], |[value, rate], coefficient| {
        [value * time + coefficient, rate * time + value]
    })
}

/// The integral of a polynomial, `start` at zero.
fn risen(coefficients: &[f64], start: f64) -> Vec<f64> {
    let terms = coefficients.iter().zip(1_u32..);
    let risen = terms.map(|(coefficient, power)| coefficient / f64::from(power));
    std::iter::once(start).chain(risen).collect()
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

    /// A base that is at 5.4 m/s when its record ends stopped there in no time.
    #[test]
    fn what_lies_beyond_the_record_is_consistent_under_the_integral() {
        let acceleration = record(0.01, 101, |t| 10.0 * t);
        let end = |t: f64| [10.0 / 6.0 + 5.0 * t, 5.0];
        for (beyond, coefficient) in [
            (Beyond::Zero, [0.0, 0.0]),
            (Beyond::Hold, [10.0, 0.0]),
            (Beyond::Continue, [10.0, 10.0]),
        ] {
            let velocity = acceleration.clone().beyond(beyond).integral();
            let place = velocity.integral();
            for t in [0.0, 0.3, 2.0] {
                let [held, rising] = coefficient;
                let [value, rate] = place.at(1.0 + t);
                let expected = end(t)[0] + held * t * t / 2.0 + rising * t.powi(3) / 6.0;
                assert!((value - expected).abs() < 1e-12, "{beyond:?} {t}: {value}");
                assert!((rate - velocity.value(1.0 + t)).abs() < 1e-12, "{beyond:?}");
                let speed = 5.0 + held * t + rising * t * t / 2.0;
                assert!((rate - speed).abs() < 1e-12, "{beyond:?} {t}: {rate}");
            }
            // It sets out from rest, whatever came before.
            assert!(place.value(-1e-3).abs() < 1e-7);
            assert_eq!(place.jump(), None);
        }
    }

    #[test]
    fn a_jump_is_stated_unless_it_was_asked_for() {
        let ramp = record(0.1, 11, |t| t);
        let jump = ramp.jump().unwrap();
        assert!(jump.value.abs() < 1e-15 && (jump.rate - 1.0).abs() < 1e-12);
        assert_eq!(ramp.clone().beyond(Beyond::Hold).jump(), None);
        assert_eq!(ramp.clone().beyond(Beyond::Continue).jump(), None);
        let torn = ramp.beyond(Beyond::Zero).jump().unwrap();
        assert!((torn.time - 1.0).abs() + (torn.value - 1.0).abs() < 1e-12);
        let rise = record(0.01, 101, |t| 0.5 - 0.5 * (PI * t).cos());
        assert_eq!(rise.jump(), None);
    }

    #[test]
    fn the_shortest_feature_is_half_a_period_or_the_length_of_a_pulse() {
        let sine = record(1e-3, 5001, |t| 2.0 + (6.0 * PI * t).sin());
        assert!((sine.shortest_feature() * 6.0 - 1.0).abs() < 1e-2);
        let pulse = record(1e-5, 2000, |t| {
            if t < 2e-4 { (PI * t / 2e-4).sin() } else { 0.0 }
        });
        assert!((pulse.shortest_feature() / 2e-4 - 1.0).abs() < 0.05);
        assert!(record(1.0, 5, |_| 3.0).shortest_feature().is_infinite());
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
