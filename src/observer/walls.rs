use glam::DVec3;

use super::{ContactEvent, Observer, StepReport};
use crate::contact::Partner;

/// What happened at one wall.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct WallRecord {
    /// Number of the cavity.
    pub cavity: usize,
    /// Number of the wall.
    pub wall: u32,
    /// Force of the particles on the wall at the end of the last step, in N; of an impulse law, over
    /// the step.
    pub force: DVec3,
    /// Largest length of that force so far, in N.
    pub peak: f64,
    /// Impulse on the wall so far, in N s: the sum of force times time step.
    pub impulse: DVec3,
    /// How many contacts have begun.
    pub impacts: u64,
}

/// Records force, impulse and impacts for each wall.
///
/// An impact is a contact that did not touch (under an impulse law: was not struck) in the step
/// before.
#[derive(Debug, Clone, Default)]
pub struct WallRecorder {
    time: f64,
    records: Vec<WallRecord>,
    /// Cavity, wall and particle of each contact, in ascending order.
    before: Vec<(usize, u32, usize)>,
    now: Vec<(usize, u32, usize)>,
}

impl WallRecorder {
    /// A recorder that has seen nothing yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The records, by cavity and wall; none before the first step.
    #[must_use]
    pub fn records(&self) -> &[WallRecord] {
        &self.records
    }

    /// Starts the records afresh: peaks, impulses and counts. Contacts that go on are no new impacts.
    pub fn reset(&mut self) {
        self.time = 0.0;
        for record in &mut self.records {
            *record = WallRecord {
                cavity: record.cavity,
                wall: record.wall,
                force: record.force,
                ..WallRecord::default()
            };
        }
    }

    /// Where the record of a wall stands among all.
    pub(super) fn place(&self, cavity: usize, wall: u32) -> Option<usize> {
        let is_it = |record: &WallRecord| record.cavity == cavity && record.wall == wall;
        self.records.iter().position(is_it)
    }

    /// The record of a wall.
    #[must_use]
    pub fn wall(&self, cavity: usize, wall: u32) -> Option<&WallRecord> {
        self.records.get(self.place(cavity, wall)?)
    }

    /// The mean force on a wall over the time watched, in N.
    #[must_use]
    pub fn mean_force(&self, cavity: usize, wall: u32) -> Option<DVec3> {
        let record = self.wall(cavity, wall)?;
        (self.time > 0.0).then(|| record.impulse / self.time)
    }
}

impl Observer for WallRecorder {
    fn wants_contacts(&self) -> bool {
        true
    }

    fn contact(&mut self, event: &ContactEvent) {
        if let Partner::Wall(wall) = event.partner {
            self.now.push((event.cavity, wall, event.particle));
        }
    }

    fn step(&mut self, report: &StepReport<'_>) {
        if self.records.is_empty() {
            for cavity in 0..report.cavities() {
                self.records
                    .extend((0..report.walls(cavity)).map(|wall| WallRecord {
                        cavity,
                        wall,
                        ..WallRecord::default()
                    }));
            }
        }
        self.time += report.time_step();
        self.now.sort_unstable();
        self.now.dedup();
        for record in &mut self.records {
            let load = report.wall_load(record.cavity, record.wall);
            record.force = load.unwrap_or_default().force;
            record.peak = record.peak.max(record.force.length());
            record.impulse += record.force * report.time_step();
            let begun = self.now.iter().filter(|contact| {
                (contact.0, contact.1) == (record.cavity, record.wall)
                    && self.before.binary_search(contact).is_err()
            });
            record.impacts += begun.count() as u64;
        }
        std::mem::swap(&mut self.before, &mut self.now);
        self.now.clear();
    }
}
