//! What lies behind a step that cannot be taken: whoever is found out of place is rarely to blame.

use glam::DVec3;

use super::{Compartment, State};
use crate::mount::Motion;
use crate::rotation::{exp, log};
use crate::step_error::{Cause, StepError};

/// How far a container may leave the course that it begins a step with, in radii of the smallest particle. A
/// wall that leaps by less than a radius leaves the centre of a grain that touches it on its own side, where
/// its overlap still tells which way is out; half of that is for grains that the wall had pressed before.
const JUMP: f64 = 0.5;

/// How far a container may move in a step, in the same measure, before it is held to be the cause of what
/// happens to particles: half of what the coarse law lets a grain move at the speed that it is set up for.
/// This and the next only decide which cause an error names, as `tests/errors/causes.rs` wants them named.
const FAST: f64 = 0.1;

/// Speeds up to this multiple of what the contact law is set up for are borne: at twice the speed a Hertzian
/// contact is shorter by 2^(1/5), 13 %, and steps that were right for it still are.
const ABOVE: f64 = 2.0;

/// What the way of a prescribed motion and the mean of its velocities at both ends of a step may differ by,
/// in parts of the greatest of both velocities and their difference, times the step. A kink anywhere in the
/// step, between velocities v and w, makes up to |v - w|/2, which is where it lies at one of the ends; a
/// smooth motion of twenty steps to a period makes (2 pi/20)^2/12, less than one hundredth.
const RATE: f64 = 0.5;

/// The same in radii of the smallest particle, for motions that hardly move: a grain of the paper's on its
/// floor overlaps by 0.8e-4 (2.5e-7 m of 3e-3 m), and what moves a wall by no more is lost in that.
const STILL: f64 = 1e-4;

/// How a step began.
#[derive(Debug, Clone, Default)]
pub(crate) struct StepStart {
    /// Motions of the containers.
    motions: Vec<Motion>,
    /// The sums of impulses on the containers, three numbers each, N s.
    pub(crate) impulses: Vec<f64>,
}

impl State {
    /// Begins a step of `time_step` (s).
    pub(crate) fn begin_step(&mut self, time_step: f64) {
        self.time_step = time_step;
        self.step_start.motions.clear();
        let motions = self
            .compartments
            .iter()
            .map(|compartment| compartment.motion);
        self.step_start.motions.extend(motions);
        let impulses = &self.mount_coordinates.velocity[self.degrees..];
        self.step_start.impulses.clear();
        self.step_start.impulses.extend_from_slice(impulses);
    }

    /// What may be behind particles out of place.
    pub(crate) fn cause(&self) -> Cause {
        let radius = self.particles.smallest_radius;
        let reference = self.design_speed;
        let borne = ABOVE * reference;
        let compartments = self.compartments.iter().zip(&self.step_start.motions);
        let far = compartments.map(|(compartment, start)| {
            let motion = compartment.motion;
            let way = motion.position.distance(start.position);
            let angle = turn(start, &motion).length();
            (compartment, motion, [way, angle * compartment.reach()])
        });
        let fastest = far.max_by(|a, b| (a.2[0] + a.2[1]).total_cmp(&(b.2[0] + b.2[1])));
        if let Some((compartment, motion, [way, swept])) = fastest {
            let velocity = motion.velocity;
            let angular_velocity = motion.angular_velocity;
            let reach = compartment.reach();
            if way > FAST * radius || velocity.length() > borne {
                return self.runaway().unwrap_or(Cause::Container { velocity, way });
            }
            if swept > FAST * radius || angular_velocity.length() * reach > borne {
                let angle = swept / reach;
                return self.runaway().unwrap_or(Cause::Rotation {
                    angular_velocity,
                    angle,
                });
            }
        }
        let (index, speed) = self.fastest();
        if speed > borne {
            return Cause::Speed {
                particle: self.particles.id[index] as usize,
                speed,
                reference,
            };
        }
        Cause::Unknown { speed }
    }

    /// The coordinate of the mount that moves fastest.
    fn runaway(&self) -> Option<Cause> {
        let [coordinates, rates] = self.mount_state();
        let rates = rates.iter().enumerate();
        let (coordinate, rate) = rates.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        Some(Cause::Mount {
            coordinate,
            value: coordinates[coordinate],
            rate: *rate,
        })
    }

    /// Index and speed of the particle that is fastest relative to its container.
    fn fastest(&self) -> (usize, f64) {
        let mut fastest = (0, 0.0);
        for compartment in &self.compartments {
            for index in compartment.indices.clone() {
                let position = || self.particles.position.get(index);
                let velocity = self.particles.velocity.get(index);
                let velocity = compartment.relative(position, velocity);
                if velocity.length() > fastest.1 {
                    fastest = (index, velocity.length());
                }
            }
        }
        fastest
    }

    /// Refuses a container that has left the course with which it began the step by so much that its walls
    /// may have passed over particles.
    pub(crate) fn check_course(&self) -> Result<(), StepError> {
        let limit = JUMP * self.particles.smallest_radius;
        for (cavity, (compartment, start)) in self
            .compartments
            .iter()
            .zip(&self.step_start.motions)
            .enumerate()
        {
            let course = start.velocity * self.time_step;
            let off = (compartment.motion.position - start.position - course).length();
            if off > limit {
                let way = compartment.motion.position.distance(start.position);
                let velocity = compartment.motion.velocity;
                let cause = self.runaway();
                return Err(StepError::Jump {
                    cavity,
                    off,
                    limit,
                    cause: cause.unwrap_or(Cause::Container { velocity, way }),
                });
            }
            if compartment.turned {
                self.check_turn(cavity, compartment, start, limit)?;
            }
        }
        Ok(())
    }

    /// The same of its orientation: by what the farthest point of the cavity leaves its course.
    fn check_turn(
        &self,
        cavity: usize,
        compartment: &Compartment,
        start: &Motion,
        limit: f64,
    ) -> Result<(), StepError> {
        let motion = &compartment.motion;
        let course = exp(start.angular_velocity * self.time_step) * start.orientation;
        let off = turn(&start.turned(course, DVec3::ZERO), motion).length() * compartment.reach();
        if off <= limit {
            return Ok(());
        }
        let cause = self.runaway();
        Err(StepError::Jump {
            cavity,
            off,
            limit,
            cause: cause.unwrap_or(Cause::Rotation {
                angular_velocity: motion.angular_velocity,
                angle: turn(start, motion).length(),
            }),
        })
    }

    /// Refuses the velocity of a prescribed motion that is not the rate of its position.
    pub(crate) fn check_rates(&self) -> Result<(), StepError> {
        if self.degrees > 0 {
            return Ok(());
        }
        let radius = self.particles.smallest_radius.min(f64::MAX);
        let time_step = self.time_step;
        for (cavity, (compartment, start)) in self
            .compartments
            .iter()
            .zip(&self.step_start.motions)
            .enumerate()
        {
            let way = compartment.motion.position - start.position;
            let velocity = (start.velocity + compartment.motion.velocity) * 0.5;
            let fastest = greatest([start.velocity, compartment.motion.velocity]);
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
            if compartment.turned {
                self.check_angular_rate(cavity, compartment, start)?;
            }
        }
        Ok(())
    }

    /// The same of its orientation, at the farthest point of the cavity.
    fn check_angular_rate(
        &self,
        cavity: usize,
        compartment: &Compartment,
        start: &Motion,
    ) -> Result<(), StepError> {
        let motion = &compartment.motion;
        let radius = self.particles.smallest_radius.min(f64::MAX);
        let reach = compartment.reach();
        let angle = turn(start, motion);
        let both = [start.angular_velocity, motion.angular_velocity];
        let angular_velocity = (both[0] + both[1]) * 0.5;
        let fastest = greatest(both);
        let off = (angle - angular_velocity * self.time_step).length() * reach;
        if angle.length() * reach <= JUMP * radius
            && off > RATE * fastest * reach * self.time_step * (1.0 + 1e-9) + STILL * radius
        {
            return Err(StepError::TurnsOtherwise {
                cavity,
                angular_velocity,
                rate: angle / self.time_step,
            });
        }
        Ok(())
    }

    /// Refuses particles that could pass through an obstacle of their cavity in the step and not be seen: a
    /// step that ends in it, or as deep as an overlap may not be on either side, is an error.
    pub(crate) fn check_passages(&self) -> Result<(), StepError> {
        let time_step = self.time_step;
        for compartment in &self.compartments {
            let thickness = compartment.thickness;
            if !(self.contained && thickness < f64::INFINITY) {
                continue;
            }
            for index in compartment.indices.clone() {
                let velocity = self.particles.velocity.get(index);
                let position = || self.particles.position.get(index);
                let speed = compartment.relative(position, velocity).length();
                let off = (self.particles.radius[index] - self.overlap_limit).max(0.0);
                let limit = (thickness + 2.0 * off) / time_step;
                if speed > limit {
                    return Err(StepError::TooFast {
                        particle: self.particles.id[index] as usize,
                        speed,
                        time_step,
                        limit,
                        cause: self.cause(),
                    });
                }
            }
        }
        Ok(())
    }
}

/// The greatest length of two vectors and their difference.
fn greatest([first, second]: [DVec3; 2]) -> f64 {
    let lengths = [first, second, second - first].map(DVec3::length);
    lengths.into_iter().fold(0.0, f64::max)
}

/// The rotation vector from one motion to another, rad.
fn turn(from: &Motion, to: &Motion) -> DVec3 {
    log(to.orientation * from.orientation.conjugate())
}
