//! From periods to a response.

use super::period::{Period, Sums};
use super::point::HalfWidths;
use crate::periods::{CONFIDENCE, Looks, Periods};
use crate::statistics::{half_width, steady_state};

/// What the averaged periods say, over the structure's unit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Averages {
    pub(super) rms_zero: f64,
    pub(super) rms_mean: f64,
    pub(super) mean: f64,
    pub(super) first_harmonic: f64,
    pub(super) phase_lag: f64,
    pub(super) half_widths: Option<HalfWidths>,
    pub(super) settled: bool,
    pub(super) discarded: u32,
    pub(super) averaged: u32,
}

impl Averages {
    /// Averages over `history` but for the periods `discarded`, whose sum is `total`.
    fn new(history: &[Sums], discarded: usize, total: &Sums, unit: f64, settled: bool) -> Self {
        let kept = &history[discarded..];
        let [mean, square] = total.means();
        let [sine, cosine] = total.harmonic();
        let mut averages = Self {
            rms_zero: square.sqrt() / unit,
            rms_mean: (square - mean * mean).max(0.0).sqrt() / unit,
            mean: mean / unit,
            first_harmonic: libm::hypot(sine, cosine) / unit,
            phase_lag: libm::atan2(-cosine, sine),
            half_widths: None,
            settled,
            discarded: discarded as u32,
            averaged: kept.len() as u32,
        };
        averages.half_widths = averages.half_widths(&periods(kept, unit));
        averages
    }

    fn half_widths(&self, kept: &[Period]) -> Option<HalfWidths> {
        let of = |value: &dyn Fn(&Period) -> f64| {
            let values: Vec<f64> = kept.iter().map(value).collect();
            half_width(&values, CONFIDENCE).ok()
        };
        // Of the root of a mean: over twice the root.
        let of_root = |root: f64, width: f64| {
            if root > 0.0 { 0.5 * width / root } else { 0.0 }
        };
        let mean = self.mean;
        let variance = |p: &Period| p.mean_square - 2.0 * mean * p.mean + mean * mean;
        // Along the mean phase.
        let (sine, cosine) = libm::sincos(self.phase_lag);
        let along = |p: &Period| p.in_phase * cosine - p.quadrature * sine;
        Some(HalfWidths {
            rms_zero: of_root(self.rms_zero, of(&|p| p.mean_square)?),
            rms_mean: of_root(self.rms_mean, of(&variance)?),
            mean: of(&|p| p.mean)?,
            first_harmonic: of(&along)?,
        })
    }
}

fn periods(history: &[Sums], unit: f64) -> Vec<Period> {
    let numbered = (1..).zip(history);
    let periods = numbered.map(|(number, sums)| Period::new(number, sums, unit));
    periods.collect()
}

/// The periods of a point as they come in.
#[derive(Debug)]
pub(super) struct History {
    periods: Periods,
    unit: f64,
    done: Vec<Sums>,
    total: Sums,
    looks: Looks,
}

impl History {
    pub(super) fn new(periods: Periods, unit: f64) -> Self {
        Self {
            periods,
            unit,
            done: Vec::new(),
            total: Sums::default(),
            looks: Looks::default(),
        }
    }

    /// The sum of samples over all periods that are averaged for sure, if the next period is one.
    pub(super) fn total(&mut self) -> Option<&mut Sums> {
        match self.periods {
            Periods::Fixed { discarded, .. } if self.done.len() >= discarded as usize => {
                Some(&mut self.total)
            }
            _ => None,
        }
    }

    /// Takes up a period, and says what it was.
    pub(super) fn push(&mut self, sums: Sums) -> Period {
        self.done.push(sums);
        Period::new(self.done.len() as u64, &sums, self.unit)
    }

    /// The averages, if no more periods are needed.
    pub(super) fn averages(&mut self) -> Option<Averages> {
        let done = self.done.len() as u64;
        let last = done >= self.periods.most();
        match self.periods {
            Periods::Fixed { discarded, .. } => last.then(|| self.fixed(discarded as usize)),
            Periods::Until { half_width, .. } => {
                if !(self.looks.are_due(done) || last) {
                    return None;
                }
                let averages = self.so_far();
                let width = averages.half_widths.map(|widths| widths.rms_mean);
                let sure = width.is_some_and(|width| width <= half_width * averages.rms_mean);
                (last || averages.settled && sure).then_some(averages)
            }
        }
    }

    fn fixed(&self, discarded: usize) -> Averages {
        let kept = self.amplitudes(discarded);
        let settled = steady_state(&kept, CONFIDENCE).is_ok_and(|steady| steady.settled);
        Averages::new(&self.done, discarded, &self.total, self.unit, settled)
    }

    fn so_far(&self) -> Averages {
        let (discarded, settled) = steady_state(&self.amplitudes(0), CONFIDENCE)
            .map_or((0, false), |steady| (steady.discarded, steady.settled));
        let mut total = Sums::default();
        for sums in &self.done[discarded..] {
            total.join(sums);
        }
        Averages::new(&self.done, discarded, &total, self.unit, settled)
    }

    /// Each period's RMS about its mean.
    fn amplitudes(&self, discarded: usize) -> Vec<f64> {
        let kept = periods(&self.done[discarded..], self.unit);
        kept.iter().map(Period::rms).collect()
    }
}
