use std::ops::ControlFlow;

use super::{Point, Response, ResponseCurve, ResponseError, Structure};
use crate::cavity::Cavity;
use crate::detector::Detector;
use crate::integrator::Integrator;
use crate::law::ContactLaw;
use crate::tasks::{Ledger, Standing, by_period, spread};

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

/// Hands what the books say to the caller's callback.
pub(super) fn telling<F>(
    mut progress: F,
) -> impl FnMut(Standing, Option<&Response>) -> ControlFlow<()> + Send
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
        let all_work = points.iter().map(cost).sum();
        let ledger = Ledger::new(points.len(), all_work, telling(progress));
        let cancelled = ResponseError::Cancelled;
        spread(&points, cost, &cancelled, ledger, |point, hear| {
            let cost = (self.periods.most(), point.work());
            by_period(cost, cancelled.clone(), hear, |each_period| {
                self.measure(*point, |_| each_period())
            })
        })
    }
}
