use std::ops::ControlFlow;

use super::{Point, Response, ResponseCurve, ResponseError, Structure};
use crate::cavity::Cavity;
use crate::detector::Detector;
use crate::integrator::Integrator;
use crate::law::ContactLaw;

/// How far a curve has come.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Progress<'a> {
    /// Part of the work that is done, 0 to 1, by the time that points are likely to take, if none ends
    /// before its most periods.
    pub fraction: f64,
    /// How many points are finished.
    pub finished: usize,
    /// How many points there are.
    pub points: usize,
    /// The point that has just been finished.
    pub latest: Option<&'a Response>,
}

/// What a unit of work tells of itself.
pub(super) enum Told<'a> {
    /// A period is done, and so much work with it.
    Period(f64),
    /// A point is finished, and so much work not needed.
    Point(&'a Response, f64),
}

/// Keeps the books of a run and tells the callback.
pub(super) struct Ledger<F> {
    tell: F,
    all_work: f64,
    work: f64,
    points: usize,
    finished: usize,
}

impl<F: FnMut(&Progress<'_>) -> ControlFlow<()>> Ledger<F> {
    pub(super) const fn new(points: usize, all_work: f64, tell: F) -> Self {
        Self {
            tell,
            all_work,
            work: 0.0,
            points,
            finished: 0,
        }
    }

    fn take(&mut self, told: &Told<'_>) -> ControlFlow<()> {
        let latest = match *told {
            Told::Period(work) => {
                self.work += work;
                None
            }
            Told::Point(response, left) => {
                self.work += left;
                self.finished += 1;
                Some(response)
            }
        };
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

/// Who hears what a unit of work tells, and may cancel it.
pub(super) type Hear<'a> = dyn FnMut(&Told<'_>) -> ControlFlow<()> + 'a;

impl Point {
    /// Likely work for one period, in any unit: the oscillator costs as much as a few particles.
    pub(super) fn work(self) -> f64 {
        (self.particles as f64 + 4.0) / self.frequency
    }
}

impl<L, C, D, I, S> ResponseCurve<L, C, D, I, S>
where
    L: ContactLaw + Clone,
    C: Cavity + Clone + Sync,
    D: Detector + Clone + Sync,
    I: Integrator + Clone + Sync,
    S: Structure + Sync,
{
    /// Measures all [`points`](Self::points), in their order.
    ///
    /// `progress` is called after every period of every point and after every point; it breaks to
    /// cancel. With the feature `rayon` points are measured on all threads of the current pool, and
    /// `progress` is called from any of them, one at a time; the responses are the same to the bit,
    /// and in the same order.
    ///
    /// # Errors
    /// That of the first point, in their order, that [cannot be measured](Self::measure);
    /// [`ResponseError::Cancelled`] when `progress` breaks.
    pub fn run<F>(&self, progress: F) -> Result<Vec<Response>, ResponseError>
    where
        F: FnMut(&Progress<'_>) -> ControlFlow<()> + Send,
    {
        self.check()?;
        let points = self.points();
        let cost = |point: &Point| point.work() * self.periods.most() as f64;
        let ledger = Ledger::new(points.len(), points.iter().map(cost).sum(), progress);
        spread(&points, cost, ledger, |point, hear| {
            let mut left = self.periods.most();
            let response = self.measure(*point, |_| {
                left -= 1;
                hear(&Told::Period(point.work()))
            })?;
            let unneeded = point.work() * left as f64;
            if hear(&Told::Point(&response, unneeded)).is_break() {
                return Err(ResponseError::Cancelled);
            }
            Ok(response)
        })
    }
}

/// Does all units of work, and gives what comes of them in their order.
#[cfg(not(feature = "rayon"))]
pub(super) fn spread<U: Sync, R: Send, F>(
    units: &[U],
    _cost: impl Fn(&U) -> f64,
    mut ledger: Ledger<F>,
    work: impl Fn(&U, &mut Hear<'_>) -> Result<R, ResponseError> + Sync,
) -> Result<Vec<R>, ResponseError>
where
    F: FnMut(&Progress<'_>) -> ControlFlow<()> + Send,
{
    let mut hear = |told: &Told<'_>| ledger.take(told);
    units.iter().map(|unit| work(unit, &mut hear)).collect()
}

/// Does all units of work, and gives what comes of them in their order.
#[cfg(feature = "rayon")]
pub(super) fn spread<U: Sync, R: Send, F>(
    units: &[U],
    cost: impl Fn(&U) -> f64,
    ledger: Ledger<F>,
    work: impl Fn(&U, &mut Hear<'_>) -> Result<R, ResponseError> + Sync,
) -> Result<Vec<R>, ResponseError>
where
    F: FnMut(&Progress<'_>) -> ControlFlow<()> + Send,
{
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
    use std::sync::{Mutex, PoisonError};

    use rayon::iter::{ParallelBridge, ParallelIterator};

    let ledger = Mutex::new(ledger);
    let cancelled = AtomicBool::new(false);
    // The lowest number of a unit that failed: those after it are of no account.
    let failed = AtomicUsize::new(usize::MAX);
    let tell = |told: &Told<'_>| {
        let mut ledger = ledger.lock().unwrap_or_else(PoisonError::into_inner);
        if cancelled.load(Relaxed) {
            return ControlFlow::Break(());
        }
        let answer = ledger.take(told);
        cancelled.fetch_or(answer.is_break(), Relaxed);
        answer
    };
    // The longest first, one at a time to whoever is free.
    let mut order: Vec<usize> = (0..units.len()).collect();
    order.sort_by(|a, b| cost(&units[*b]).total_cmp(&cost(&units[*a])));
    let mut results: Vec<(usize, Result<R, ResponseError>)> = order
        .into_iter()
        .par_bridge()
        .map(|number| {
            let result = work(&units[number], &mut |told| {
                if failed.load(Relaxed) < number {
                    return ControlFlow::Break(());
                }
                tell(told)
            });
            if !matches!(result, Ok(_) | Err(ResponseError::Cancelled)) {
                failed.fetch_min(number, Relaxed);
            }
            (number, result)
        })
        .collect();
    results.sort_by_key(|(number, _)| *number);
    if cancelled.load(Relaxed) {
        return Err(ResponseError::Cancelled);
    }
    results.into_iter().map(|(_, result)| result).collect()
}
