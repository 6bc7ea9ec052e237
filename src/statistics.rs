//! How sure a mean is: where the start of a series ends, and intervals for the mean of what follows.
//!
//! Values that follow each other in time resemble each other, so that n of them are worth fewer: n / g,
//! with g one and twice the sum of their autocorrelations. [`batch_means`] and [`autocorrelation`] are two
//! ways to heed that, [`truncation`] says how much of the start to drop, and [`steady_state`] does all of it.
//!
//! ```
//! use particle_damper::statistics::steady_state;
//!
//! // Something that dies out, and something that goes on.
//! let value = |n: u32| 3.0 + 5.0 * f64::exp(-f64::from(n) / 8.0) + 0.2 * f64::sin(1.3 * f64::from(n * n));
//! let series: Vec<f64> = (0..400).map(value).collect();
//! let steady = steady_state(&series, 0.95)?;
//! assert!(steady.settled && steady.discarded > 10);
//! assert!((steady.interval.mean - 3.0).abs() < 0.05 && steady.interval.half_width < 0.05);
//! # Ok::<(), particle_damper::statistics::StatisticsError>(())
//! ```

mod interval;
mod steady;
mod student;
mod truncation;

pub use interval::{Interval, autocorrelation, batch_means};
pub(crate) use steady::half_width;
pub use steady::{SteadyState, steady_state};
pub use student::student_t;
pub use truncation::{Truncation, truncation};

use crate::error::{Bound, ValueError};

/// Why there is no interval.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StatisticsError {
    /// The series is too short: run longer.
    #[error("{values} values say nothing of how sure their mean is, it takes {least}")]
    TooShort {
        /// How many values there are.
        values: usize,
        /// How many it takes.
        least: usize,
    },
    /// A number outside its range.
    #[error(transparent)]
    Value(#[from] ValueError),
}

/// Refuses fewer values than `least`, values that are not finite, and a confidence that is none.
fn check(series: &[f64], least: usize, confidence: f64) -> Result<(), StatisticsError> {
    check_confidence(confidence)?;
    if series.len() < least {
        let values = series.len();
        return Err(StatisticsError::TooShort { values, least });
    }
    for value in series {
        Bound::Finite.check("value of the series", *value)?;
    }
    Ok(())
}

fn check_confidence(confidence: f64) -> Result<(), ValueError> {
    Bound::Above(0.0).check("confidence", confidence)?;
    Bound::Below(1.0).check("confidence", confidence)?;
    Ok(())
}

/// The mean of a series that is not empty. Of equal values it is that value, to the bit.
fn mean(series: &[f64]) -> f64 {
    let first = series.first().copied().unwrap_or_default();
    let excess: f64 = series.iter().map(|value| value - first).sum();
    first + excess / series.len() as f64
}

/// The sum of squared deviations from `mean`.
fn squares(series: &[f64], mean: f64) -> f64 {
    let square = |value: &f64| (value - mean) * (value - mean);
    series.iter().map(square).sum()
}

#[cfg(test)]
mod series {
    use crate::random::Random;

    /// `count` values of x = `phi` x + a normal innovation of variance one, from its steady state.
    pub(super) fn autoregressive(phi: f64, count: usize, seed: u64) -> Vec<f64> {
        let mut random = Random::new(seed);
        let mut normal = move || {
            let radius = (-2.0 * (1.0 - random.unit()).ln()).sqrt();
            radius * (std::f64::consts::TAU * random.unit()).cos()
        };
        let mut x = normal() / (1.0 - phi * phi).sqrt();
        let mut next = || {
            x = phi * x + normal();
            x
        };
        (0..count).map(|_| next()).collect()
    }
}
