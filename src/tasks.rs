//! Tasks that do not depend on each other, such as the points of a curve: done on all threads of the current
//! pool with the feature `rayon`, in turn without it. The results are the same bits.

use std::ops::ControlFlow;

/// How far tasks have come.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Standing {
    /// Part of the work that is done, 0 to 1.
    pub(crate) fraction: f64,
    /// How many points are finished.
    pub(crate) finished: usize,
    /// How many points there are.
    pub(crate) points: usize,
}

/// What a task tells of itself, with the work that is off the list.
pub(crate) enum Told<'a, P> {
    /// A period is done, and so much work with it.
    Period(f64),
    /// A point is finished, and so much work not needed.
    Point(&'a P, f64),
}

/// Keeps the books of tasks and tells the callback.
pub(crate) struct Ledger<F> {
    tell: F,
    all_work: f64,
    work: f64,
    points: usize,
    finished: usize,
}

impl<F> Ledger<F> {
    /// Books of `points` that take `all_work` together, in any unit.
    pub(crate) const fn new(points: usize, all_work: f64, tell: F) -> Self {
        Self {
            tell,
            all_work,
            work: 0.0,
            points,
            finished: 0,
        }
    }

    fn take<P>(&mut self, told: &Told<'_, P>) -> ControlFlow<()>
    where
        F: FnMut(Standing, Option<&P>) -> ControlFlow<()>,
    {
        let latest = match *told {
            Told::Period(work) => {
                self.work += work;
                None
            }
            Told::Point(point, left) => {
                self.work += left;
                self.finished += 1;
                Some(point)
            }
        };
        let standing = Standing {
            fraction: if self.finished == self.points {
                1.0
            } else {
                (self.work / self.all_work).min(1.0)
            },
            finished: self.finished,
            points: self.points,
        };
        (self.tell)(standing, latest)
    }
}

/// Who hears what a task tells, and may cancel it.
pub(crate) type Hear<'a, P> = dyn FnMut(&Told<'_, P>) -> ControlFlow<()> + 'a;

/// Measures a point that takes so many periods at the `most`, each so much `work`, and tells of every period and of
/// its end; `cancelled` is the error of one that is told to stop there.
pub(crate) fn by_period<P, E>(
    (most, work): (u64, f64),
    cancelled: E,
    hear: &mut Hear<'_, P>,
    measure: impl FnOnce(&mut dyn FnMut() -> ControlFlow<()>) -> Result<P, E>,
) -> Result<P, E> {
    let mut left = most;
    let point = measure(&mut || {
        left -= 1;
        hear(&Told::Period(work))
    })?;
    if hear(&Told::Point(&point, work * left as f64)).is_break() {
        return Err(cancelled);
    }
    Ok(point)
}

/// Does all tasks, and gives what comes of them in their order.
#[cfg(not(feature = "rayon"))]
pub(crate) fn spread<T, P, R, E, F>(
    tasks: &[T],
    _cost: impl Fn(&T) -> f64,
    _cancelled: &E,
    mut ledger: Ledger<F>,
    work: impl Fn(&T, &mut Hear<'_, P>) -> Result<R, E>,
) -> Result<Vec<R>, E>
where
    F: FnMut(Standing, Option<&P>) -> ControlFlow<()>,
{
    let mut hear = |told: &Told<'_, P>| ledger.take(told);
    tasks.iter().map(|task| work(task, &mut hear)).collect()
}

/// Does all tasks, and gives what comes of them in their order; `cancelled` is the error of one that was told to
/// stop.
#[cfg(feature = "rayon")]
pub(crate) fn spread<T, P, R, E, F>(
    tasks: &[T],
    cost: impl Fn(&T) -> f64,
    cancelled: &E,
    ledger: Ledger<F>,
    work: impl Fn(&T, &mut Hear<'_, P>) -> Result<R, E> + Sync,
) -> Result<Vec<R>, E>
where
    T: Sync,
    R: Send,
    E: Clone + PartialEq + Send + Sync,
    F: FnMut(Standing, Option<&P>) -> ControlFlow<()> + Send,
{
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
    use std::sync::{Mutex, PoisonError};

    use rayon::iter::{ParallelBridge, ParallelIterator};

    let ledger = Mutex::new(ledger);
    let stopped = AtomicBool::new(false);
    // The lowest number of a task that failed: those after it are of no account.
    let failed = AtomicUsize::new(usize::MAX);
    let tell = |told: &Told<'_, P>| {
        let mut ledger = ledger.lock().unwrap_or_else(PoisonError::into_inner);
        if stopped.load(Relaxed) {
            return ControlFlow::Break(());
        }
        let answer = ledger.take(told);
        stopped.fetch_or(answer.is_break(), Relaxed);
        answer
    };
    // The longest first, one at a time to whoever is free.
    let mut order: Vec<usize> = (0..tasks.len()).collect();
    order.sort_by(|a, b| cost(&tasks[*b]).total_cmp(&cost(&tasks[*a])));
    let mut results: Vec<(usize, Result<R, E>)> = order
        .into_iter()
        .par_bridge()
        .map(|number| {
            let result = work(&tasks[number], &mut |told| {
                if failed.load(Relaxed) < number {
                    return ControlFlow::Break(());
                }
                tell(told)
            });
            if result.as_ref().is_err_and(|error| error != cancelled) {
                failed.fetch_min(number, Relaxed);
            }
            (number, result)
        })
        .collect();
    results.sort_by_key(|(number, _)| *number);
    if stopped.load(Relaxed) {
        return Err(cancelled.clone());
    }
    results.into_iter().map(|(_, result)| result).collect()
}
