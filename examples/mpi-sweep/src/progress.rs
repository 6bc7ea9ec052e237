//! How far a sweep has come, on standard error.

use std::fmt;
use std::time::{Duration, Instant};

use crate::record::{Outcome, Record, Task};

/// At most one line in so long a time, for the sake of logs.
const INTERVAL: Duration = Duration::from_secs(1);

pub struct Progress {
    /// Work of each task of the sweep, by number.
    work: Vec<f64>,
    to_do: f64,
    done: f64,
    tasks: usize,
    finished: usize,
    failed: usize,
    started: Instant,
    told: Option<Instant>,
}

impl Progress {
    /// Of these `tasks`, out of `all` of the sweep.
    pub fn new(all: &[Task], tasks: &[Task]) -> Self {
        Self {
            work: all.iter().map(|task| task.point.work()).collect(),
            to_do: tasks.iter().map(|task| task.point.work()).sum(),
            done: 0.0,
            tasks: tasks.len(),
            finished: 0,
            failed: 0,
            started: Instant::now(),
            told: None,
        }
    }

    /// Takes up what has been finished. Failures are told at once; they took no time to speak of.
    pub fn finished(&mut self, record: &Record) {
        let work = self.work[record.number];
        self.finished += 1;
        match &record.outcome {
            Outcome::Failed(reason) => {
                self.failed += 1;
                self.to_do -= work;
                eprintln!("failed: {}: {reason}", record.point);
            }
            _ => self.done += work,
        }
        let due = self.told.is_none_or(|told| told.elapsed() > INTERVAL);
        if due || self.finished == self.tasks {
            eprintln!("{self}");
            self.told = Some(Instant::now());
        }
    }

    /// By the likely work of what is left.
    fn time_left(&self) -> f64 {
        let left = (self.to_do - self.done).max(0.0);
        self.started.elapsed().as_secs_f64() * left / self.done
    }
}

impl fmt::Display for Progress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {} points", self.finished, self.tasks)?;
        if self.finished == self.tasks {
            write!(f, " in {:.1} s", self.started.elapsed().as_secs_f64())?;
        } else if self.done > 0.0 {
            write!(f, ", {} %, ", (100.0 * self.done / self.to_do) as u32)?;
            let seconds = self.time_left().ceil() as u64;
            let (hours, minutes) = (seconds / 3600, seconds / 60 % 60);
            write!(f, "{hours}:{minutes:02}:{:02} left", seconds % 60)?;
        }
        if self.failed > 0 {
            write!(f, ", {} failed", self.failed)?;
        }
        Ok(())
    }
}
