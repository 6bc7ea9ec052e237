//! Recording a host's session, and playing it again.

use std::collections::BTreeSet;
use std::fmt;

use super::{RestoreError, Snapshot};
use crate::cavity::Cavity;
use crate::damper::{Damper, Reaction};
use crate::detector::{Detector, LinkedCells, Skin};
use crate::digest::Digest;
use crate::integrator::{Integrator, VelocityVerlet};
use crate::law::{ContactLaw, ContactMemory, LawKind};
use crate::mount::{Driven, Motion};
use crate::step_error::StepError;

/// What a host did to a damper: the snapshot it began with, every input, and digests of what came of
/// it. With the feature `serde` it can be written and read, so that a report of something gone wrong
/// becomes one file.
///
/// ```
/// use particle_damper::{Damper, HertzTsuji, Material, Motion, Particle, Recorded, Slot, glam::DVec3};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let build = || {
///     let grain = Particle::new(3e-3, 2e-4)?.at(DVec3::new(0.05, 0.01, 0.0));
///     let builder = Damper::builder(Slot::paper(), HertzTsuji::new(Material::acrylic()));
///     Ok::<_, Box<dyn std::error::Error>>(builder.particles([grain]).build()?)
/// };
/// let mut host = Recorded::new(build()?, 10);
/// for n in 1..100 {
///     host.drive(Motion::at(DVec3::Y * 1e-4 * f64::from(n), DVec3::Y * 0.1), 1e-3)?;
/// }
/// assert_eq!(host.recording().replay(&mut build()?)?, None);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Recording<Memory> {
    start: Snapshot<Memory>,
    events: Vec<Event<Memory>>,
}

impl<Memory> fmt::Debug for Recording<Memory> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Recording")
            .field("start", &self.start)
            .field("drives", &self.drives())
            .finish_non_exhaustive()
    }
}

/// What happened.
#[derive(Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Event<Memory> {
    /// The container was moved; with the digest of the answer, none if it was an error.
    Drive {
        end: Motion,
        until: Until,
        answer: Option<Digest>,
    },
    /// The state was digested.
    State(Digest),
    /// A snapshot was taken.
    Snapshot,
    /// The damper was restored to the snapshot of this number.
    Restore(u32),
    /// It was restored to one that was not taken in this session.
    RestoreOther(Box<Snapshot<Memory>>),
}

/// How long the container was moved.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Until {
    Interval(f64),
    Time(f64),
}

/// Why a recording came out otherwise, or could not be played.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReplayError {
    /// From here on the bits are others.
    #[error("the bits part in drive {drive}, which ends at {time} s")]
    Parted {
        /// Number of the drive, from 1.
        drive: usize,
        /// Simulated time at its end, s.
        time: f64,
    },
    /// A snapshot does not fit the damper.
    #[error("after {drives} drives: {error}")]
    Restore {
        /// How many drives went before.
        drives: usize,
        /// What is wrong.
        error: RestoreError,
    },
    /// The recording goes back to a snapshot that it does not hold.
    #[error("the recording is damaged: there is no snapshot {number}")]
    NoSnapshot {
        /// Number of the snapshot.
        number: u32,
    },
}

/// A driven damper that records what its host does.
#[derive(Clone)]
pub struct Recorded<C, L: ContactLaw, D = Skin<LinkedCells>, I = VelocityVerlet> {
    damper: Damper<C, L, Driven, D, I>,
    recording: Recording<ContactMemory<L>>,
    /// Digests of the snapshots taken.
    marks: Vec<Digest>,
    every: u32,
    since: u32,
}

impl<C, L: ContactLaw, D, I> fmt::Debug for Recorded<C, L, D, I> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Recorded")
            .field("damper", &self.damper)
            .field("drives", &self.recording.drives())
            .finish_non_exhaustive()
    }
}

impl<C, L, D, I> Recorded<C, L, D, I>
where
    C: Cavity,
    L: ContactLaw,
    D: Detector,
    I: Integrator,
{
    /// Records `damper` from now on, with a digest of its state after `every` drives (none if zero), and of
    /// the reaction after each.
    pub fn new(damper: Damper<C, L, Driven, D, I>, every: u32) -> Self {
        let recording = Recording {
            start: damper.snapshot(),
            events: Vec::new(),
        };
        Self {
            damper,
            recording,
            marks: Vec::new(),
            every,
            since: 0,
        }
    }

    /// The damper, to look at.
    pub const fn damper(&self) -> &Damper<C, L, Driven, D, I> {
        &self.damper
    }

    /// What was recorded.
    pub const fn recording(&self) -> &Recording<ContactMemory<L>> {
        &self.recording
    }

    /// As [`Damper::drive`].
    ///
    /// # Errors
    /// As [`Damper::drive`].
    pub fn drive(&mut self, end: Motion, interval: f64) -> Result<Reaction, StepError> {
        self.record(end, Until::Interval(interval))
    }

    /// As [`Damper::drive_to`].
    ///
    /// # Errors
    /// As [`Damper::drive_to`].
    pub fn drive_to(&mut self, end: Motion, time: f64) -> Result<Reaction, StepError> {
        self.record(end, Until::Time(time))
    }

    fn record(&mut self, end: Motion, until: Until) -> Result<Reaction, StepError> {
        let outcome = drive(&mut self.damper, end, until);
        let answer = outcome.as_ref().ok().map(digest);
        let events = &mut self.recording.events;
        events.push(Event::Drive { end, until, answer });
        self.since += 1;
        if self.since == self.every && outcome.is_ok() {
            events.push(Event::State(self.damper.snapshot().own_digest()));
            self.since = 0;
        }
        outcome
    }

    /// As [`Damper::snapshot`].
    #[must_use]
    pub fn snapshot(&mut self) -> Snapshot<ContactMemory<L>> {
        let snapshot = self.damper.snapshot();
        self.marks.push(snapshot.own_digest());
        self.recording.events.push(Event::Snapshot);
        snapshot
    }

    /// As [`Damper::restore`].
    ///
    /// # Errors
    /// As [`Damper::restore`].
    pub fn restore(&mut self, snapshot: &Snapshot<ContactMemory<L>>) -> Result<(), RestoreError> {
        self.damper.restore(snapshot)?;
        let own = snapshot.own_digest();
        let mark = self.marks.iter().rposition(|mark| *mark == own);
        self.recording.events.push(match mark {
            Some(number) => Event::Restore(number as u32),
            None => Event::RestoreOther(Box::new(snapshot.clone())),
        });
        Ok(())
    }
}

impl<Memory: Clone> Recording<Memory> {
    /// Does again to `damper`, which has to be set up as the recorded one was, what the host did. Returns
    /// the last error of a drive, if it was not followed by another.
    ///
    /// # Errors
    /// If the bits part, or a snapshot does not fit. The damper is then where it happened.
    pub fn replay<C, L, D, I>(
        &self,
        damper: &mut Damper<C, L, Driven, D, I>,
    ) -> Result<Option<StepError>, ReplayError>
    where
        C: Cavity,
        L: ContactLaw,
        L::Kind: LawKind<L, Memory = Memory>,
        D: Detector,
        I: Integrator,
    {
        let unfit = |drives| move |error| ReplayError::Restore { drives, error };
        damper.restore(&self.start).map_err(unfit(0))?;
        let returns: BTreeSet<u32> = self.events.iter().filter_map(Event::restores).collect();
        let (mut drives, mut marks, mut kept, mut failure) = (0, 0, Vec::new(), None);
        for event in &self.events {
            match event {
                Event::Drive { end, until, answer } => {
                    drives += 1;
                    let outcome = drive(damper, *end, *until);
                    let same = outcome.as_ref().ok().map(digest) == *answer;
                    same.then_some(())
                        .ok_or_else(|| parted(drives, damper.time()))?;
                    failure = outcome.err();
                }
                Event::State(digest) => {
                    let same = damper.snapshot().own_digest() == *digest;
                    same.then_some(())
                        .ok_or_else(|| parted(drives, damper.time()))?;
                }
                Event::Snapshot => {
                    // Most are never gone back to.
                    if returns.contains(&marks) {
                        kept.push((marks, damper.snapshot()));
                    }
                    marks += 1;
                }
                Event::Restore(number) => {
                    let mark = kept.iter().rfind(|(own, _)| own == number);
                    let (_, snapshot) = mark.ok_or(ReplayError::NoSnapshot { number: *number })?;
                    damper.restore(snapshot).map_err(unfit(drives))?;
                }
                Event::RestoreOther(snapshot) => damper.restore(snapshot).map_err(unfit(drives))?,
            }
        }
        Ok(failure)
    }
}

impl<Memory> Recording<Memory> {
    /// How often the container was moved.
    #[must_use]
    pub fn drives(&self) -> usize {
        let drives = self.events.iter();
        drives
            .filter(|event| matches!(event, Event::Drive { .. }))
            .count()
    }
}

impl<Memory> Event<Memory> {
    const fn restores(&self) -> Option<u32> {
        match self {
            Self::Restore(number) => Some(*number),
            _ => None,
        }
    }
}

const fn parted(drive: usize, time: f64) -> ReplayError {
    ReplayError::Parted { drive, time }
}

fn drive<C, L, D, I>(
    damper: &mut Damper<C, L, Driven, D, I>,
    end: Motion,
    until: Until,
) -> Result<Reaction, StepError>
where
    C: Cavity,
    L: ContactLaw,
    D: Detector,
    I: Integrator,
{
    match until {
        Until::Interval(interval) => damper.drive(end, interval),
        Until::Time(time) => damper.drive_to(end, time),
    }
}

fn digest(reaction: &Reaction) -> Digest {
    let mut digest = Digest::default();
    digest.vectors(&[
        reaction.force,
        reaction.impulse,
        reaction.torque,
        reaction.angular_impulse,
    ]);
    digest
}
