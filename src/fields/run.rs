use std::ops::ControlFlow;

use super::{Cell, EffectiveFields, FieldError, Measurement, Point};
use crate::cavity::Cavity;
use crate::detector::Detector;
use crate::integrator::Integrator;
use crate::law::ContactLaw;
use crate::tasks::{Ledger, Standing, by_period, spread};

/// How far fields have come.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Progress<'a> {
    /// Part of the work that is done, 0 to 1, by the time that points are likely to take, if none ends before
    /// its most periods.
    pub fraction: f64,
    /// How many points are finished.
    pub finished: usize,
    /// How many points there are.
    pub points: usize,
    /// The point that has just been finished.
    pub latest: Option<&'a Measurement>,
}

/// Hands what the books say to the caller's callback.
fn telling<F>(
    mut progress: F,
) -> impl FnMut(Standing, Option<&Measurement>) -> ControlFlow<()> + Send
where
    F: FnMut(&Progress<'_>) -> ControlFlow<()> + Send,
{
    move |standing, latest| {
        progress(&Progress {
            fraction: standing.fraction,
            finished: standing.finished,
            points: standing.points,
            latest,
        })
    }
}

impl<L, C, D, I> EffectiveFields<L, C, D, I>
where
    L: ContactLaw + Clone,
    C: Cavity + Clone + Sync,
    D: Detector + Clone + Sync,
    I: Integrator + Clone + Sync,
{
    /// Measures all [`points`](Self::points), and makes a cell of those that differ by their seed alone: cells
    /// of one frequency follow each other by amplitude, in the order in which these were given.
    ///
    /// `progress` is called after every period of every point and after every point; it breaks to cancel.
    /// With the feature `rayon` points are measured on all threads of the current pool, and `progress` is
    /// called from any of them, one at a time; the cells are the same to the bit, and in the same order.
    ///
    /// # Errors
    /// That of the first point, in their order, that [cannot be measured](Self::measure);
    /// [`FieldError::Cancelled`] when `progress` breaks.
    pub fn run<F>(&self, progress: F) -> Result<Vec<Cell>, FieldError>
    where
        F: FnMut(&Progress<'_>) -> ControlFlow<()> + Send,
    {
        let measurements = self.measure_all(progress)?;
        let seeds = self.seeds_per_cell().max(1);
        Ok(measurements
            .chunks(seeds)
            .filter_map(Cell::pooled)
            .collect())
    }

    /// As [`run`](Self::run), with what was measured at each point instead of cells.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn measure_all<F>(&self, progress: F) -> Result<Vec<Measurement>, FieldError>
    where
        F: FnMut(&Progress<'_>) -> ControlFlow<()> + Send,
    {
        self.check()?;
        let points = self.points();
        let most = self.periods.most() + 1;
        let work = |point: &Point| self.work(point);
        let all_work = points.iter().map(work).sum::<f64>() * most as f64;
        let ledger = Ledger::new(points.len(), all_work, telling(progress));
        let cancelled = FieldError::Cancelled;
        spread(&points, work, &cancelled, ledger, |point, hear| {
            let cost = (most, work(point));
            by_period(cost, cancelled.clone(), hear, |each_period| {
                self.measure(*point, |_| each_period())
            })
        })
    }

    /// Likely work for a period of a point, in any unit.
    fn work(&self, point: &Point) -> f64 {
        (self.bed_size().0 as f64 + 4.0) / point.frequency
    }
}
