//! Work on long columns and many blocks: on all threads of the current pool with the feature `rayon`,
//! in turn without it. The results are the same bits.

use std::sync::{Mutex, PoisonError};

/// Scratch that threads borrow: as many pieces of it as work at a time.
#[derive(Debug)]
pub(crate) struct Pool<T>(Mutex<Vec<T>>);

impl<T> Pool<T> {
    /// A pool with one piece.
    pub(crate) fn new(piece: T) -> Self {
        Self(Mutex::new(vec![piece]))
    }

    /// Does `work` with a piece that nobody else has.
    pub(crate) fn with<R>(&self, work: impl FnOnce(&mut T) -> R) -> R
    where
        T: Default,
    {
        let pieces = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let mut piece = pieces().pop().unwrap_or_default();
        let result = work(&mut piece);
        pieces().push(piece);
        result
    }

    /// The sum of what `measure` tells of the pieces.
    pub(crate) fn sum(&self, measure: impl Fn(&T) -> usize) -> usize {
        let pieces = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        pieces.iter().map(measure).sum()
    }
}

impl<T: Clone> Clone for Pool<T> {
    fn clone(&self) -> Self {
        let pieces = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        Self(Mutex::new(pieces.clone()))
    }
}

/// Columns no longer than this are not worth a second thread.
#[cfg(feature = "rayon")]
const PIECE: usize = 16_384;

/// Does both, at the same time if there are threads for it.
#[cfg(feature = "rayon")]
fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    rayon::join(first, second)
}

/// Does both.
#[cfg(not(feature = "rayon"))]
fn both<A, B>(first: impl FnOnce() -> A, second: impl FnOnce() -> B) -> (A, B) {
    (first(), second())
}

/// Does `work` for every item with its part of `parts`, and tells whether it was good for each. `split`
/// divides parts into those of the items that it is shown, and those of the ones behind.
pub(crate) fn for_each<T: Send, P: Send>(
    items: &mut [T],
    parts: P,
    split: &(impl Fn(P, &[T]) -> (P, P) + Sync),
    work: &(impl Fn(&mut T, P) -> bool + Sync),
) -> bool {
    match items {
        [] => true,
        [item] => work(item, parts),
        _ => {
            let (first, second) = items.split_at_mut(items.len() / 2);
            let (own, rest) = split(parts, first);
            let (first, second) = both(
                || for_each(first, own, split, work),
                || for_each(second, rest, split, work),
            );
            first && second
        }
    }
}

/// Changes each number of a column by the ones in the same place of another.
pub(crate) fn update(values: &mut [f64], by: &[f64], change: impl Fn(&mut f64, f64) + Sync + Copy) {
    let work = |values: &mut [f64], by: &[f64]| {
        for (value, by) in values.iter_mut().zip(by) {
            change(value, *by);
        }
    };
    #[cfg(feature = "rayon")]
    if values.len() > PIECE {
        use rayon::prelude::*;
        let pieces = values.par_chunks_mut(PIECE).zip(by.par_chunks(PIECE));
        pieces.for_each(|(values, by)| work(values, by));
        return;
    }
    work(values, by);
}

/// Changes each two numbers in the same place of two columns by that of a third.
pub(crate) fn update_two(
    first: &mut [f64],
    second: &mut [f64],
    by: &[f64],
    change: impl Fn(&mut f64, &mut f64, f64) + Sync + Copy,
) {
    let work = |first: &mut [f64], second: &mut [f64], by: &[f64]| {
        for ((first, second), by) in first.iter_mut().zip(second).zip(by) {
            change(first, second, *by);
        }
    };
    #[cfg(feature = "rayon")]
    if first.len() > PIECE {
        use rayon::prelude::*;
        let pieces = first
            .par_chunks_mut(PIECE)
            .zip(second.par_chunks_mut(PIECE));
        let pieces = pieces.zip(by.par_chunks(PIECE));
        pieces.for_each(|((first, second), by)| work(first, second, by));
        return;
    }
    work(first, second, by);
}

/// Changes each number of a column by the ones in the same place of two others.
pub(crate) fn update_by_two(
    values: &mut [f64],
    by: &[f64],
    and: &[f64],
    change: impl Fn(&mut f64, f64, f64) + Sync + Copy,
) {
    let work = |values: &mut [f64], by: &[f64], and: &[f64]| {
        for ((value, by), and) in values.iter_mut().zip(by).zip(and) {
            change(value, *by, *and);
        }
    };
    #[cfg(feature = "rayon")]
    if values.len() > PIECE {
        use rayon::prelude::*;
        let pieces = values.par_chunks_mut(PIECE).zip(by.par_chunks(PIECE));
        let pieces = pieces.zip(and.par_chunks(PIECE));
        pieces.for_each(|((values, by), and)| work(values, by, and));
        return;
    }
    work(values, by, and);
}
