use std::ops::ControlFlow;

use super::{Point, Response, ResponseCurve, ResponseError};
use crate::cavity::Cavity;
use crate::detector::Detector;
use crate::integrator::Integrator;
use crate::law::ContactLaw;

/// How far a curve has come.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Progress<'a> {
    /// Part of the work that is done, 0 to 1, by the time that points are likely to take.
    pub fraction: f64,
    /// How many points are finished.
    pub finished: usize,
    /// How many points there are.
    pub points: usize,
    /// The point that has just been finished.
    pub latest: Option<&'a Response>,
}

/// Keeps the books of a sweep and tells the callback.
struct Ledger<F> {
    tell: F,
    work_per_period: Vec<f64>,
    all_work: f64,
    work: f64,
    finished: usize,
}

impl<F: FnMut(&Progress<'_>) -> ControlFlow<()>> Ledger<F> {
    fn new(points: &[Point], periods: u64, tell: F) -> Self {
        let work_per_period: Vec<f64> = points.iter().map(|point| point.work()).collect();
        Self {
            all_work: work_per_period.iter().sum::<f64>() * periods as f64,
            tell,
            work_per_period,
            work: 0.0,
            finished: 0,
        }
    }

    fn report(&mut self, latest: Option<&Response>) -> ControlFlow<()> {
        let points = self.work_per_period.len();
        (self.tell)(&Progress {
            fraction: if self.finished == points {
                1.0
            } else {
                (self.work / self.all_work).min(1.0)
            },
            finished: self.finished,
            points,
            latest,
        })
    }

    fn period(&mut self, number: usize) -> ControlFlow<()> {
        self.work += self.work_per_period[number];
        self.report(None)
    }

    fn point(&mut self, response: &Response) -> ControlFlow<()> {
        self.finished += 1;
        self.report(Some(response))
    }
}

impl Point {
    /// Likely work for one period, in any unit: the oscillator costs as much as a few particles.
    fn work(self) -> f64 {
        (self.particles as f64 + 4.0) / self.frequency
    }
}

impl<L, C, D, I> ResponseCurve<L, C, D, I>
where
    L: ContactLaw + Clone,
    C: Cavity + Clone + Sync,
    D: Detector + Clone + Sync,
    I: Integrator + Clone + Sync,
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
        let ledger = Ledger::new(&points, self.periods_per_point(), progress);
        self.measure_all(&points, ledger)
    }

    #[cfg(not(feature = "rayon"))]
    fn measure_all<F>(
        &self,
        points: &[Point],
        mut ledger: Ledger<F>,
    ) -> Result<Vec<Response>, ResponseError>
    where
        F: FnMut(&Progress<'_>) -> ControlFlow<()> + Send,
    {
        let mut responses = Vec::with_capacity(points.len());
        for (number, &point) in points.iter().enumerate() {
            let response = self.measure(point, |_| ledger.period(number))?;
            if ledger.point(&response).is_break() {
                return Err(ResponseError::Cancelled);
            }
            responses.push(response);
        }
        Ok(responses)
    }

    #[cfg(feature = "rayon")]
    fn measure_all<F>(
        &self,
        points: &[Point],
        ledger: Ledger<F>,
    ) -> Result<Vec<Response>, ResponseError>
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
        let told = |tell: &dyn Fn(&mut Ledger<F>) -> ControlFlow<()>| {
            let mut ledger = ledger.lock().unwrap_or_else(PoisonError::into_inner);
            if cancelled.load(Relaxed) {
                return ControlFlow::Break(());
            }
            let answer = tell(&mut ledger);
            cancelled.fetch_or(answer.is_break(), Relaxed);
            answer
        };
        // The longest first, one at a time to whoever is free.
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by(|a, b| points[*b].work().total_cmp(&points[*a].work()));
        let mut results: Vec<(usize, Result<Response, ResponseError>)> = order
            .into_iter()
            .par_bridge()
            .map(|number| {
                let result = self.measure(points[number], |_| {
                    if failed.load(Relaxed) < number {
                        return ControlFlow::Break(());
                    }
                    told(&|ledger| ledger.period(number))
                });
                match &result {
                    // The answer to a finished point shows in `cancelled`.
                    Ok(response) => drop(told(&|ledger| ledger.point(response))),
                    Err(ResponseError::Cancelled) => {}
                    Err(_) => drop(failed.fetch_min(number, Relaxed)),
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
}
