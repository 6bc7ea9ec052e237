//! Workers that are threads of this process.

use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;

use crate::dispatch::{Failure, Workers};
use crate::record::{Record, Task};
use crate::sweep::Sweep;

type Report = (usize, Record);

pub struct Threads {
    orders: Vec<Sender<Task>>,
    reports: Receiver<Report>,
}

impl Threads {
    /// Starts them. They end with this value.
    pub fn start(sweep: &Sweep, count: usize) -> Self {
        let sweep = Arc::new(sweep.clone());
        let (report, reports) = mpsc::channel();
        let worker = |number| {
            let (order, orders) = mpsc::channel();
            let (sweep, report) = (Arc::clone(&sweep), report.clone());
            thread::spawn(move || work(number, &sweep, &orders, &report));
            order
        };
        Self {
            orders: (0..count).map(worker).collect(),
            reports,
        }
    }

    /// The next report, if there is one already.
    #[cfg(feature = "mpi")]
    pub fn reported(&self) -> Option<Report> {
        self.reports.try_recv().ok()
    }
}

fn work(number: usize, sweep: &Sweep, orders: &Receiver<Task>, report: &Sender<Report>) {
    for task in orders {
        if report.send((number, sweep.measure(task))).is_err() {
            return;
        }
    }
}

impl Workers for Threads {
    fn count(&self) -> usize {
        self.orders.len()
    }

    fn hand(&mut self, worker: usize, task: Task) -> Result<(), Failure> {
        Ok(self.orders[worker].send(task)?)
    }

    fn next(&mut self) -> Result<Report, Failure> {
        Ok(self.reports.recv()?)
    }
}
