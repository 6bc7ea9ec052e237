//! Independent pieces of work spread over all cores.

use std::error::Error;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

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
