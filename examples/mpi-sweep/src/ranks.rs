//! Workers that are ranks of MPI: rank 0 hands out, gathers and measures as well, on a thread.
//!
//! Messages are JSON. The first to each rank is the sweep, those that follow are tasks; an empty one
//! sends it home. Ranks look for messages once in a while: one that waits leaves its core to others.

use std::thread;
use std::time::Duration;

use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, Destination, Source};

use crate::dispatch::{Failure, Workers};
use crate::record::{Record, Task};
use crate::sweep::Sweep;
use crate::threads::Threads;

/// Between looks.
const INTERVAL: Duration = Duration::from_millis(1);

pub struct Ranks<'a> {
    own: Threads,
    world: &'a SimpleCommunicator,
}

impl<'a> Ranks<'a> {
    /// Tells all ranks what the sweep is.
    pub fn start(world: &'a SimpleCommunicator, sweep: &Sweep) -> Result<Self, Failure> {
        let message = serde_json::to_vec(sweep)?;
        for rank in 1..world.size() {
            world.process_at_rank(rank).send(&message[..]);
        }
        Ok(Self {
            own: Threads::start(sweep, 1),
            world,
        })
    }
}

impl Workers for Ranks<'_> {
    fn count(&self) -> usize {
        self.world.size() as usize
    }

    fn hand(&mut self, worker: usize, task: Task) -> Result<(), Failure> {
        if worker == 0 {
            return self.own.hand(0, task);
        }
        let message = serde_json::to_vec(&task)?;
        self.world.process_at_rank(worker as i32).send(&message[..]);
        Ok(())
    }

    fn next(&mut self) -> Result<(usize, Record), Failure> {
        loop {
            if let Some(report) = self.own.reported() {
                return Ok(report);
            }
            if let Some((rank, message)) = received(self.world) {
                return Ok((rank as usize, serde_json::from_slice(&message)?));
            }
            thread::sleep(INTERVAL);
        }
    }
}

/// A message to this rank, if there is one already, and who sent it.
fn received(world: &SimpleCommunicator) -> Option<(i32, Vec<u8>)> {
    let status = world.any_process().immediate_probe()?;
    let rank = status.source_rank();
    let (message, _) = world.process_at_rank(rank).receive_vec();
    Some((rank, message))
}

/// What ranks other than 0 do.
pub fn serve(world: &SimpleCommunicator) -> Result<(), Failure> {
    let order = || {
        loop {
            match received(world) {
                Some((_, message)) if message.is_empty() => return None,
                Some((_, message)) => return Some(message),
                None => thread::sleep(INTERVAL),
            }
        }
    };
    let Some(message) = order() else {
        return Ok(());
    };
    let sweep: Sweep = serde_json::from_slice(&message)?;
    while let Some(message) = order() {
        let record = sweep.measure(serde_json::from_slice(&message)?);
        let report = serde_json::to_vec(&record)?;
        world.process_at_rank(0).send(&report[..]);
    }
    Ok(())
}

/// Sends all ranks home.
pub fn dismiss(world: &SimpleCommunicator) {
    for rank in 1..world.size() {
        world.process_at_rank(rank).send(&[] as &[u8]);
    }
}
