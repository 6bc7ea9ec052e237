//! What lies behind a step that cannot be taken: whoever is found out of place is rarely to blame.

use std::fmt;

use glam::DVec3;

use super::engine::Engine;
use super::error::StepError;
use crate::cavity::Cavity;
use crate::detector::Detector;
use crate::law::ContactLaw;
use crate::mount::{Motion, Mount};
use crate::observer::Observable;

/// How far a container may leave the course that it begins a step with, in radii of the smallest particle.
const JUMP: f64 = 0.5;

/// How far a container may move in a step, in the same measure, before it is held to be the cause of what
/// happens to particles.
const FAST: f64 = 0.1;

/// Speeds up to this multiple of what the contact law is set up for are borne.
const ABOVE: f64 = 2.0;

/// What position and velocity of a prescribed motion may differ by over a step, in parts of its way. A kink
/// in the midst of a step makes half of it.
const RATE: f64 = 0.5;

/// The same in radii of the smallest particle, for motions that hardly move.
const STILL: f64 = 1e-4;

/// Why a particle has left its cavity, or is pressed into something.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Cause {
    /// The mount has run away, and its container with it.
    Mount {
        /// Number of the coordinate that moves fastest.
        coordinate: usize,
        /// Its value.
        value: f64,
        /// Its rate.
        rate: f64,
    },
    /// The container is moved too fast or by leaps.
    Container {
        /// Its velocity in m/s.
        velocity: DVec3,
        /// What it has moved by in the step, m.
        way: f64,
    },
    /// A particle moves far faster than the contact law is set up for.
    Speed {
        /// Number of the particle.
        particle: usize,
        /// Its speed relative to its container, m/s.
        speed: f64,
        /// The speed that the law is set up for, m/s.
        reference: f64,
    },
    /// None of these.
    Unknown {
        /// The speed of the fastest particle relative to its container, m/s.
        speed: f64,
    },
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mount {
                coordinate,
                value,
                rate,
            } => write!(
                f,
                "the mount runs away, coordinate {coordinate} is at {value} with a rate of {rate}; check its equations or shorten the step"
            ),
            Self::Container { velocity, way } => write!(
                f,
                "the container moves at {velocity} m/s, by {way} m in the step; check what drives it, or shorten the interval"
            ),
            Self::Speed {
                particle,
                speed,
                reference,
            } => write!(
                f,
                "particle {particle} moves at {speed} m/s and the contact law is set up for {reference} m/s; raise its reference speed"
            ),
            Self::Unknown { speed } => write!(
                f,
                "the fastest particle moves at {speed} m/s; a shorter step may help"
            ),
        }
    }
}

/// How a step began.
#[derive(Debug, Clone, Default)]
pub(crate) struct Begin {
    /// Motions of the containers.
    motions: Vec<Motion>,
    /// Length of the step, s.
    time_step: f64,
}

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Keeps how a step of `time_step` (s) begins.
    pub(crate) fn begin(&mut self, time_step: f64) {
        self.begin.time_step = time_step;
        self.begin.motions.clear();
        let motions = self.world.rooms.iter().map(|room| room.motion);
        self.begin.motions.extend(motions);
    }

    /// What may be behind particles out of place.
    pub(crate) fn cause(&self) -> Cause {
        let radius = self.particles.smallest_radius;
        let reference = self.world.law.design_speed();
        let borne = ABOVE * reference;
        let rooms = self.world.rooms.iter().zip(&self.begin.motions);
        let far =
            rooms.map(|(room, start)| (room.motion, room.motion.position.distance(start.position)));
        let fastest = far.max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((motion, way)) = fastest
            && (way > FAST * radius || motion.velocity.length() > borne)
        {
            let velocity = motion.velocity;
            return self.runaway().unwrap_or(Cause::Container { velocity, way });
        }
        let (slot, speed) = self.fastest();
        if speed > borne {
            return Cause::Speed {
                particle: self.particles.number[slot] as usize,
                speed,
                reference,
            };
        }
        Cause::Unknown { speed }
    }

    /// The coordinate of the mount that moves fastest.
    fn runaway(&self) -> Option<Cause> {
        let rates = self.rates().iter().enumerate();
        let (coordinate, rate) = rates.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        Some(Cause::Mount {
            coordinate,
            value: self.coordinates()[coordinate],
            rate: *rate,
        })
    }

    /// Slot and speed of the particle that is fastest relative to its container.
    fn fastest(&self) -> (usize, f64) {
        let mut fastest = (0, 0.0);
        for room in &self.world.rooms {
            for slot in room.slots.clone() {
                let velocity = self.particles.velocity.get(slot) - room.motion.velocity;
                if velocity.length() > fastest.1 {
                    fastest = (slot, velocity.length());
                }
            }
        }
        fastest
    }

    /// Refuses a container that has left the course with which it began the step by so much that its walls
    /// may have passed over particles.
    pub(crate) fn check_course(&self) -> Result<(), StepError> {
        let limit = JUMP * self.particles.smallest_radius;
        for (cavity, (room, start)) in self.world.rooms.iter().zip(&self.begin.motions).enumerate()
        {
            let course = start.velocity * self.begin.time_step;
            let off = (room.motion.position - start.position - course).length();
            if off > limit {
                let way = room.motion.position.distance(start.position);
                let velocity = room.motion.velocity;
                let cause = self.runaway();
                return Err(StepError::Jump {
                    cavity,
                    off,
                    limit,
                    cause: cause.unwrap_or(Cause::Container { velocity, way }),
                });
            }
        }
        Ok(())
    }

    /// Refuses the velocity of a prescribed motion that is not the rate of its position.
    pub(crate) fn check_rates(&self) -> Result<(), StepError> {
        if self.mount.degrees() > 0 {
            return Ok(());
        }
        let radius = self.particles.smallest_radius.min(f64::MAX);
        let time_step = self.begin.time_step;
        for (cavity, (room, start)) in self.world.rooms.iter().zip(&self.begin.motions).enumerate()
        {
            let way = room.motion.position - start.position;
            let velocity = (start.velocity + room.motion.velocity) * 0.5;
            let fastest = start.velocity.length().max(room.motion.velocity.length());
            let off = (way - velocity * time_step).length();
            // A leap is told as such.
            if way.length() <= JUMP * radius
                && off > RATE * fastest * time_step * (1.0 + 1e-9) + STILL * radius
            {
                return Err(StepError::NotItsRate {
                    cavity,
                    velocity,
                    rate: way / time_step,
                });
            }
        }
        Ok(())
    }
}
