use super::interval::LEAST;
use super::{
    Interval, StatisticsError, Truncation, autocorrelation, batch_means, check, mean, truncation,
};

/// What may still be to fade, over the mean: a tenth of the one per cent to which laws and theory agree at best.
const NEGLIGIBLE: f64 = 1e-3;

/// The mean of a series after its start.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct SteadyState {
    /// The mean of what was kept, and how sure it is.
    pub interval: Interval,
    /// How many values were dropped at the start.
    pub discarded: usize,
    /// Whether the start is over. If not, nothing says that the interval holds: run longer.
    pub settled: bool,
}

/// The mean of `series` in the steady state: the start is dropped as [`truncation`] says, and the interval
/// is the wider one of [`batch_means`] and [`autocorrelation`].
///
/// A start that fades into no noise at all (a bed at rest, an empty container) has no end that
/// [`truncation`] could find. Then half of the series is dropped, and what is still to fade is worked out
/// from the means of the three thirds of the rest, as if it faded evenly (Aitken's delta squared). It counts
/// as settled if that is less than a thousandth of the mean; it is added to the half-width.
///
/// # Errors
/// If there are fewer than 4 values, one is not finite, or the confidence is not between 0 and 1 (both
/// excluded).
pub fn steady_state(series: &[f64], confidence: f64) -> Result<SteadyState, StatisticsError> {
    check(series, LEAST, confidence)?;
    let (discarded, over) = match truncation(series) {
        Truncation::After(cut) => (cut, true),
        Truncation::RunLonger => ((series.len() / 2).min(series.len() - LEAST), false),
    };
    let kept = &series[discarded..];
    let mut interval = wider(kept, confidence)?;
    let settled = over || {
        let little = NEGLIGIBLE * interval.mean.abs();
        interval.half_width += fade(kept);
        still_to_fade(kept).is_some_and(|left| left <= little)
    };
    Ok(SteadyState {
        interval,
        discarded,
        settled,
    })
}

/// The wider of the two intervals.
fn wider(series: &[f64], confidence: f64) -> Result<Interval, StatisticsError> {
    let batches = batch_means(series, confidence)?;
    let other = autocorrelation(series, confidence)?;
    Ok(if other.half_width > batches.half_width {
        other
    } else {
        batches
    })
}

/// The half-width for the mean of a series that is kept whole: of the wider interval, and what is still to
/// fade if the series is on its way.
pub(crate) fn half_width(series: &[f64], confidence: f64) -> Result<f64, StatisticsError> {
    let width = wider(series, confidence)?.half_width;
    Ok(match truncation(series) {
        Truncation::After(_) => width,
        Truncation::RunLonger => width + fade(series),
    })
}

/// What the half-width of a series on its way has to be wider by: what is still to fade, where that is no
/// more than has been seen to change.
fn fade(series: &[f64]) -> f64 {
    let low = series.iter().copied().fold(f64::INFINITY, f64::min);
    let high = series.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    still_to_fade(series).map_or(0.0, |left| left.min(high - low))
}

/// How far the mean of a series that fades evenly is from what it fades to; none if it does not fade.
fn still_to_fade(series: &[f64]) -> Option<f64> {
    if series.len() < 6 {
        return None;
    }
    let third = series.len() / 3;
    let mut thirds = series.rchunks_exact(third).map(mean);
    let (last, middle, first) = (thirds.next()?, thirds.next()?, thirds.next()?);
    let [before, after] = [(first - middle).abs(), (middle - last).abs()];
    if after < before {
        // The mean is off by as much as the sum of the thirds' deviations d + d r + d r^2 over 3.
        let ratio = after / before;
        let deviation = before / (1.0 - ratio);
        return Some(deviation * (1.0 + ratio + ratio * ratio) / 3.0);
    }
    // Beats and rounding: no trend, and too little to look for one.
    let left = before + after;
    (left <= NEGLIGIBLE * mean(series).abs()).then_some(left)
}

#[cfg(test)]
mod tests {
    use super::super::series::autoregressive;
    use super::*;

    fn fading(rate: f64, count: usize) -> Vec<f64> {
        let value = |n| 2.0 + (-rate * n as f64).exp();
        (0..count).map(value).collect()
    }

    /// Without noise: what is said to be settled holds the limit, and sooner or later it is said.
    #[test]
    fn a_start_that_fades_into_nothing_is_known_by_how_it_fades() {
        for rate in [0.003, 0.077, 0.3] {
            let mut settled = 0;
            for count in [20, 50, 100, 200, 500, 2000, 5000, 10_000] {
                let steady = steady_state(&fading(rate, count), 0.95).unwrap();
                if steady.settled {
                    settled += 1;
                    let off = (steady.interval.mean - 2.0).abs();
                    assert!(
                        off <= steady.interval.half_width,
                        "{rate} {count}: {steady:?}"
                    );
                }
            }
            assert!(settled >= 2, "{rate}: {settled}");
            let short = steady_state(&fading(rate, (2.0 / rate) as usize), 0.95).unwrap();
            assert!(!short.settled, "{rate}: {short:?}");
        }
        assert!(steady_state(&[0.3; 8], 0.95).unwrap().interval.half_width <= 0.0);
    }

    /// A start that beats against the steady motion, when little of it is left.
    #[test]
    fn the_last_of_a_beat_does_not_count() {
        let beat = |n: i32| 3.0 + 1e-5 * (-0.05 * f64::from(n)).exp() * (0.4 * f64::from(n)).sin();
        for count in 20..60 {
            let series: Vec<f64> = (0..count).map(beat).collect();
            assert!(steady_state(&series, 0.95).unwrap().settled, "{count}");
        }
    }

    #[test]
    fn a_start_in_noise_is_dropped_and_the_interval_covers() {
        let mut covered = 0;
        for seed in 0..400 {
            let mut series = autoregressive(0.5, 1000, seed);
            for (n, value) in series.iter_mut().enumerate() {
                *value += 20.0 * (-(n as f64) / 30.0).exp();
            }
            let steady = steady_state(&series, 0.95).unwrap();
            assert!(steady.settled && (50..300).contains(&steady.discarded));
            covered += u32::from(steady.interval.mean.abs() < steady.interval.half_width);
        }
        assert!((364..=392).contains(&covered), "{covered} of 400");
    }
}
