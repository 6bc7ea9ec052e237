use super::{mean, squares};

/// Values to a group.
const GROUP: usize = 5;
/// Fewer groups than this have no start and no rest.
const LEAST_GROUPS: usize = 4;

/// Where the start of a series ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Truncation {
    /// After so many values; those behind them may be averaged.
    After(usize),
    /// Not in the first half of the series, which is still on its way, or shorter than 20 values: run
    /// longer.
    RunLonger,
}

/// How much of the start of `series` to drop, by MSER-5: of means of five values each, the cut is where the
/// rest has the smallest sum of squares about its mean, over the square of its number. (White, Simulation
/// 69 (1997) 323, doi 10.1177/003754979706900601; White, Cobb & Spratt 2000, doi 10.1109/WSC.2000.899952.)
///
/// Only cuts in the first half are looked at. If the smallest value lies at the end of that range, nothing
/// says that it is the smallest of all.
///
/// ```
/// use particle_damper::statistics::{Truncation, truncation};
///
/// let falls_and_stays: Vec<f64> = (0..100_u8).map(|n| -f64::from(n.min(30))).collect();
/// assert_eq!(truncation(&falls_and_stays), Truncation::After(30));
/// let falls: Vec<f64> = (0..100_u8).map(|n| -f64::from(n)).collect();
/// assert_eq!(truncation(&falls), Truncation::RunLonger);
/// ```
#[must_use]
pub fn truncation(series: &[f64]) -> Truncation {
    let groups: Vec<f64> = series.chunks_exact(GROUP).map(mean).collect();
    if groups.len() < LEAST_GROUPS {
        return Truncation::RunLonger;
    }
    let last = groups.len() / 2;
    // From the back: each group in turn joins the mean and the sum of squares (Welford).
    let tail = &groups[last..];
    let mut mean = mean(tail);
    let mut sum = squares(tail, mean);
    let mut count = tail.len() as f64;
    let (mut least, mut cut) = (sum / (count * count), last);
    for (number, group) in groups[..last].iter().enumerate().rev() {
        count += 1.0;
        let excess = group - mean;
        mean += excess / count;
        sum += excess * (group - mean);
        let value = sum / (count * count);
        // Of equals the first: a constant series is not cut.
        if value <= least {
            (least, cut) = (value, number);
        }
    }
    if cut < last {
        Truncation::After(GROUP * cut)
    } else {
        Truncation::RunLonger
    }
}

#[cfg(test)]
mod tests {
    use super::super::series::autoregressive;
    use super::*;

    /// The definition, with no sum carried on.
    fn by_definition(series: &[f64]) -> Truncation {
        let groups: Vec<f64> = series.chunks_exact(5).map(mean).collect();
        let last = groups.len() / 2;
        let value = |cut: usize| {
            let rest = &groups[cut..];
            squares(rest, mean(rest)) / (rest.len() as f64).powi(2)
        };
        let best = (0..=last).min_by(|a, b| value(*a).total_cmp(&value(*b)));
        match best.unwrap() {
            cut if cut < last => Truncation::After(5 * cut),
            _ => Truncation::RunLonger,
        }
    }

    /// An exponential of ten times the innovation, which is below the noise after 300 to 500 values.
    #[test]
    fn a_start_in_noise_is_cut_where_it_drowns() {
        for seed in 0..100 {
            let mut series = autoregressive(0.9, 4000, seed);
            for (n, value) in series.iter_mut().enumerate() {
                *value += 10.0 * (-(n as f64) / 200.0).exp();
            }
            let found = truncation(&series);
            assert_eq!(found, by_definition(&series));
            let Truncation::After(cut) = found else {
                panic!("seed {seed}: {found:?}");
            };
            assert!((100..=600).contains(&cut), "seed {seed}: {cut}");
        }
    }

    #[test]
    fn a_drift_is_told_to_run_longer_and_a_constant_is_kept_whole() {
        let rise: Vec<f64> = (0..200).map(f64::from).collect();
        assert_eq!(truncation(&rise), Truncation::RunLonger);
        let fading: Vec<f64> = (0..400).map(|n| (-f64::from(n) / 40.0).exp()).collect();
        assert_eq!(truncation(&fading), Truncation::RunLonger);
        assert_eq!(truncation(&[0.1; 203]), Truncation::After(0));
        assert_eq!(truncation(&[0.1; 19]), Truncation::RunLonger);
        assert_eq!(truncation(&[]), Truncation::RunLonger);
    }
}
