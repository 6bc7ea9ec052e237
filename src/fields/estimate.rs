use super::point::{Cycle, Measurement};
use crate::periods::CONFIDENCE;
use crate::statistics::{half_width, student_t};

/// A mean over periods and seeds, and how sure it is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Estimate {
    /// The mean over seeds of the means over periods.
    pub value: f64,
    /// With a confidence of 95 % the mean of endless runs is within this of the value: by the periods of
    /// each run (the wider of batch means and autocorrelation), or by the seeds' means if there are three or more and these
    /// say that it is wider. None of fewer than 4 periods.
    pub half_width: Option<f64>,
    /// How far the mean of the farthest seed is from the value. Much more than the half-width, and seeds
    /// end in different motions: several of them coexist.
    pub spread: f64,
}

impl Estimate {
    /// A value that is not in doubt.
    #[must_use]
    pub const fn known(value: f64) -> Self {
        Self {
            value,
            half_width: Some(0.0),
            spread: 0.0,
        }
    }
}

/// The mean of a value of cycles over runs that all have some.
pub(super) fn estimate(runs: &[&Measurement], value: &dyn Fn(&Cycle) -> f64) -> Estimate {
    let count = runs.len() as f64;
    let (mut means, mut squares) = (Vec::with_capacity(runs.len()), Some(0.0));
    for run in runs {
        let series: Vec<f64> = run.kept().iter().map(value).collect();
        means.push(series.iter().sum::<f64>() / series.len() as f64);
        let width = half_width(&series, CONFIDENCE).ok();
        squares = squares.and_then(|sum: f64| width.map(|width| sum + width * width));
    }
    let mean = means.iter().sum::<f64>() / count;
    let deviations = means.iter().map(|own| (own - mean).abs());
    let spread = deviations.clone().fold(0.0, f64::max);
    let mut half_width = squares.map(|sum| sum.sqrt() / count);
    if let (true, Some(width)) = (runs.len() >= 3, half_width.as_mut()) {
        let variance = deviations.map(|off| off * off).sum::<f64>() / (count - 1.0);
        let student = student_t(CONFIDENCE, count - 1.0).unwrap_or(f64::INFINITY);
        *width = width.max(student * (variance / count).sqrt());
    }
    Estimate {
        value: mean,
        half_width,
        spread,
    }
}
