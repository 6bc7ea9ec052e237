use super::{StatisticsError, check, mean, squares, student_t};

/// The least number of values that an interval is made from.
pub(super) const LEAST: usize = 4;

/// A mean and how sure it is.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Interval {
    /// The mean of the series.
    pub mean: f64,
    /// The mean of an endless series is within this of [`mean`](Self::mean), with the confidence asked for.
    pub half_width: f64,
    /// How many independent values the series is worth.
    pub effective: f64,
}

/// The mean of `series` with an interval by batch means: the series is cut into batches as long as the root
/// of its length, whose means are taken for independent, and Student's t is taken with one degree of
/// freedom less than there are batches. Values that do not fill a batch are left out of these at the front.
///
/// The interval is good if values resemble each other over much less than a batch.
///
/// # Errors
/// If there are fewer than 4 values, one is not finite, or the confidence is not between 0 and 1 (both
/// excluded).
///
/// ```
/// use particle_damper::statistics::batch_means;
///
/// let series: Vec<f64> = (0..900_u32).map(|n| f64::from(n * n % 7)).collect();
/// let interval = batch_means(&series, 0.95)?;
/// assert!((interval.mean - 2.0).abs() < interval.half_width);
/// # Ok::<(), particle_damper::statistics::StatisticsError>(())
/// ```
pub fn batch_means(series: &[f64], confidence: f64) -> Result<Interval, StatisticsError> {
    check(series, LEAST, confidence)?;
    let count = series.len() as f64;
    let length = count.sqrt() as usize;
    let batches: Vec<f64> = series.rchunks_exact(length).map(mean).collect();
    let degrees = batches.len() as f64 - 1.0;
    let deviation = squares(&batches, mean(&batches)) / degrees;
    let variance_of_mean = deviation * length as f64 / count;
    Ok(interval(
        series,
        variance_of_mean,
        student_t(confidence, degrees)?,
    ))
}

/// The mean of `series` with an interval by its autocorrelation: the number of values is taken for n / g,
/// with g one and twice the sum of the autocorrelations, of two neighbouring lags at a time as long as
/// they are positive together and do not rise again (the initial monotone sequence of Geyer, Stat. Sci. 7
/// (1992) 473, doi 10.1214/ss/1177011137).
///
/// # Errors
/// As [`batch_means`].
pub fn autocorrelation(series: &[f64], confidence: f64) -> Result<Interval, StatisticsError> {
    check(series, LEAST, confidence)?;
    let count = series.len() as f64;
    let mean = mean(series);
    let deviations: Vec<f64> = series.iter().map(|value| value - mean).collect();
    let covariance = |lag: usize| -> f64 {
        let later = deviations.iter().skip(lag);
        let products = deviations.iter().zip(later).map(|(a, b)| a * b);
        products.sum::<f64>() / count
    };
    // The variance times g.
    let mut sum = -covariance(0);
    let mut last = f64::INFINITY;
    for lag in (0..series.len()).step_by(2) {
        let pair = (covariance(lag) + covariance(lag + 1)).min(last);
        if pair <= 0.0 {
            break;
        }
        sum += 2.0 * pair;
        last = pair;
    }
    // What alternates may come out worth more than its number: not more than all of it is claimed.
    let variance = covariance(0);
    let sum = sum.max(variance);
    let effective = if sum > 0.0 {
        count * variance / sum
    } else {
        count
    };
    let degrees = (effective - 1.0).max(1.0);
    let variance_of_mean = sum / (count - 1.0);
    Ok(interval(
        series,
        variance_of_mean,
        student_t(confidence, degrees)?,
    ))
}

/// The interval of a mean of known variance.
fn interval(series: &[f64], variance_of_mean: f64, student: f64) -> Interval {
    let count = series.len() as f64;
    let mean = mean(series);
    let variance = squares(series, mean) / (count - 1.0);
    Interval {
        mean,
        half_width: student * variance_of_mean.sqrt(),
        effective: if variance_of_mean > 0.0 {
            (variance / variance_of_mean).clamp(1.0, count)
        } else {
            count
        },
    }
}

#[cfg(test)]
mod tests {
    use super::super::series::autoregressive;
    use super::*;

    type Method = fn(&[f64], f64) -> Result<Interval, StatisticsError>;
    const METHODS: [Method; 2] = [batch_means, autocorrelation];

    /// How many of 400 intervals hold the true mean, zero, and the mean of the numbers of values that an
    /// independent one is worth.
    fn covered(method: Method, phi: f64, count: usize) -> (u32, f64) {
        let (mut covered, mut inefficiency) = (0, 0.0);
        for seed in 0..400 {
            let series = autoregressive(phi, count, seed);
            let interval = method(&series, 0.95).unwrap();
            covered += u32::from(interval.mean.abs() < interval.half_width);
            inefficiency += count as f64 / interval.effective / 400.0;
        }
        (covered, inefficiency)
    }

    /// g = (1 + phi) / (1 - phi); 91 to 97 % of 400 are 364 to 388.
    #[test]
    fn intervals_cover_an_autoregressive_mean_as_often_as_they_say() {
        for method in METHODS {
            for (phi, g) in [(0.9, 19.0), (0.0, 1.0), (0.5, 3.0)] {
                let (covered, inefficiency) = covered(method, phi, 4000);
                assert!((364..=388).contains(&covered), "{phi}: {covered} of 400");
                let off = (inefficiency / g - 1.0).abs();
                assert!(off < 0.2, "{phi}: {inefficiency}, not {g}");
            }
        }
    }

    #[test]
    fn a_constant_series_divides_by_nothing() {
        for method in METHODS {
            for count in [4, 5, 17, 400] {
                let interval = method(&vec![0.1; count], 0.95).unwrap();
                assert_eq!(interval.mean.to_bits(), 0.1_f64.to_bits());
                assert!(interval.half_width.abs() < f64::MIN_POSITIVE);
                assert!((interval.effective - count as f64).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn an_alternating_series_is_worth_no_more_than_its_number() {
        let series: Vec<f64> = (0..400).map(|n| f64::from(n % 2)).collect();
        for method in METHODS {
            let interval = method(&series, 0.95).unwrap();
            assert!((interval.mean - 0.5).abs() < 1e-12);
            assert!(interval.effective <= 400.0);
            assert!(interval.half_width.is_finite());
        }
    }

    #[test]
    fn too_little_and_unusable_numbers_are_refused() {
        for method in METHODS {
            assert_eq!(
                method(&[1.0; 3], 0.95),
                Err(StatisticsError::TooShort {
                    values: 3,
                    least: 4
                })
            );
            let broken = [1.0, 2.0, f64::NAN, 3.0];
            assert!(matches!(
                method(&broken, 0.95),
                Err(StatisticsError::Value(_))
            ));
            assert!(method(&[1.0; 9], 1.0).is_err());
        }
    }
}
