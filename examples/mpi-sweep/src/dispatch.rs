//! Tasks are handed out one by one, to whoever is free.

use std::error::Error;

use crate::record::{Record, Task};

pub type Failure = Box<dyn Error + Send + Sync>;

/// Those who measure, numbered from 0.
pub trait Workers {
    fn count(&self) -> usize;

    /// Gives a task to a worker who has none.
    fn hand(&mut self, worker: usize, task: Task) -> Result<(), Failure>;

    /// Waits for the next worker to finish.
    fn next(&mut self) -> Result<(usize, Record), Failure>;
}

/// Has all tasks done, in this order. `finished` hears of each as soon as it is done.
pub fn work_off(
    tasks: Vec<Task>,
    workers: &mut impl Workers,
    mut finished: impl FnMut(Record) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut tasks = tasks.into_iter();
    let mut busy = 0;
    for worker in 0..workers.count() {
        if let Some(task) = tasks.next() {
            workers.hand(worker, task)?;
            busy += 1;
        }
    }
    while busy > 0 {
        let (worker, record) = workers.next()?;
        match tasks.next() {
            Some(task) => workers.hand(worker, task)?,
            None => busy -= 1,
        }
        finished(record)?;
    }
    Ok(())
}
