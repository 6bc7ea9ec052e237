use std::ops::ControlFlow;

use super::{Cell, EffectiveFields, FieldError, Measurement, Point};
use crate::cavity::Cavity;
use crate::detector::Detector;
use crate::integrator::Integrator;
use crate::law::ContactLaw;

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

/// Keeps the books of a run and tells the callback.
struct Ledger<F> {
    tell: F,
    all_work: f64,
    work: f64,
    points: usize,
    finished: usize,
}

impl<F: FnMut(&Progress<'_>) -> ControlFlow<()>> Ledger<F> {
    /// Takes up work that is done, or no longer needed.
    fn take(&mut self, work: f64, latest: Option<&Measurement>) -> ControlFlow<()> {
        self.work += work;
        self.finished += usize::from(latest.is_some());
        (self.tell)(&Progress {
            fraction: if self.finished == self.points {
                1.0
            } else {
                (self.work / self.all_work).min(1.0)
            },
            finished: self.finished,
            points: self.points,
            latest,
        })
    }
}

/// Who hears of work that is done and of a point that is finished, and may cancel.
type Hear<'a> = dyn FnMut(f64, Option<&Measurement>) -> ControlFlow<()> + 'a;

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
        let ledger = Ledger {
            tell: progress,
            all_work: points.iter().map(|point| self.work(point)).sum::<f64>() * most as f64,
            work: 0.0,
            points: points.len(),
            finished: 0,
        };
        self.spread(&points, ledger, |point, hear| {
            let mut left = most;
            let measurement = self.measure(*point, |_| {
                left -= 1;
                hear(self.work(point), None)
            })?;
            let unneeded = self.work(point) * left as f64;
            if hear(unneeded, Some(&measurement)).is_break() {
                return Err(FieldError::Cancelled);
            }
            Ok(measurement)
        })
    }

    /// Likely work for a period of a point, in any unit.
    fn work(&self, point: &Point) -> f64 {
        (self.bed_size().0 as f64 + 4.0) / point.frequency
    }

    /// Does all points, and gives what comes of them in their order.
    #[cfg(not(feature = "rayon"))]
    // The form with several threads asks for the work of each point.
    #[allow(clippy::unused_self)]
    fn spread<F>(
        &self,
        points: &[Point],
        mut ledger: Ledger<F>,
        measure: impl Fn(&Point, &mut Hear<'_>) -> Result<Measurement, FieldError> + Sync,
    ) -> Result<Vec<Measurement>, FieldError>
    where
        F: FnMut(&Progress<'_>) -> ControlFlow<()> + Send,
    {
        let mut hear = |work: f64, latest: Option<&Measurement>| ledger.take(work, latest);
        points
            .iter()
            .map(|point| measure(point, &mut hear))
            .collect()
    }

    /// Does all points, and gives what comes of them in their order.
    #[cfg(feature = "rayon")]
    fn spread<F>(
        &self,
        points: &[Point],
        ledger: Ledger<F>,
        measure: impl Fn(&Point, &mut Hear<'_>) -> Result<Measurement, FieldError> + Sync,
    ) -> Result<Vec<Measurement>, FieldError>
    where
        F: FnMut(&Progress<'_>) -> ControlFlow<()> + Send,
    {
        use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
        use std::sync::{Mutex, PoisonError};

        use rayon::iter::{ParallelBridge, ParallelIterator};

        let ledger = Mutex::new(ledger);
        let cancelled = AtomicBool::new(false);
        // The lowest number of a point that failed: those after it are of no account.
        let failed = AtomicUsize::new(usize::MAX);
        let tell = |work: f64, latest: Option<&Measurement>| {
            let mut ledger = ledger.lock().unwrap_or_else(PoisonError::into_inner);
            if cancelled.load(Relaxed) {
                return ControlFlow::Break(());
            }
            let answer = ledger.take(work, latest);
            cancelled.fetch_or(answer.is_break(), Relaxed);
            answer
        };
        // The longest first, one at a time to whoever is free.
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by(|a, b| self.work(&points[*b]).total_cmp(&self.work(&points[*a])));
        let mut results: Vec<(usize, Result<Measurement, FieldError>)> = order
            .into_iter()
            .par_bridge()
            .map(|number| {
                let result = measure(&points[number], &mut |work, latest| {
                    if failed.load(Relaxed) < number {
                        return ControlFlow::Break(());
                    }
                    tell(work, latest)
                });
                if !matches!(result, Ok(_) | Err(FieldError::Cancelled)) {
                    failed.fetch_min(number, Relaxed);
                }
                (number, result)
            })
            .collect();
        results.sort_by_key(|(number, _)| *number);
        if cancelled.load(Relaxed) {
            return Err(FieldError::Cancelled);
        }
        results.into_iter().map(|(_, result)| result).collect()
    }
}
