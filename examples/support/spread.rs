//! Independent pieces of work spread over all cores.

use std::error::Error;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use crate::progress;

/// Does `work` for 0 to `count` on all cores, under a bar, and gives what comes of it in this order.
#[allow(dead_code)] // Shared by the examples, each of which uses a part.
pub(crate) fn all<T: Send>(
    count: usize,
    work: impl Fn(usize) -> Result<T, Box<dyn Error + Send + Sync>> + Sync,
) -> Result<Vec<T>, Box<dyn Error + Send + Sync>> {
    let order: Vec<usize> = (0..count).collect();
    let bar = progress::bar(count as u64);
    let mut found: Vec<Option<T>> = order.iter().map(|_| None).collect();
    spread(&order, work, |number, result| {
        found[number] = Some(result);
        bar.inc(1);
    })?;
    bar.finish_and_clear();
    Ok(found.into_iter().flatten().collect())
}

/// Does `work` for the numbers in `order`, each taken by whichever thread is free, and tells
/// `finished` on the calling thread as they come in. The first error ends it.
pub(crate) fn spread<T: Send>(
    order: &[usize],
    work: impl Fn(usize) -> Result<T, Box<dyn Error + Send + Sync>> + Sync,
    mut finished: impl FnMut(usize, T),
) -> Result<(), Box<dyn Error + Send + Sync>> {
    let next = AtomicUsize::new(0);
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let (sender, receiver) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..threads.min(order.len()) {
            let (sender, next, work) = (sender.clone(), &next, &work);
            scope.spawn(move || {
                while let Some(&number) = order.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if sender.send((number, work(number))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(sender);
        for (number, result) in receiver {
            finished(number, result?);
        }
        Ok(())
    })
}
