//! Driving: a host program moves the container, and gets the reaction back.

use super::state::checked;
use super::{Damper, Reaction};
use crate::cavity::Cavity;
use crate::detector::Detector;
use crate::error::Bound;
use crate::integrator::Integrator;
use crate::law::ContactLaw;
use crate::mount::{Driven, Motion};
use crate::observer::Observer;
use crate::step_error::StepError;

/// The most steps of one call: an interval in a wrong unit is an error, and not a call that never ends.
const MOST_STEPS: f64 = 1e9;

impl<C, L, D, I> Damper<C, L, Driven, D, I>
where
    C: Cavity,
    L: ContactLaw,
    D: Detector,
    I: Integrator,
{
    /// Moves the container to `end` within `interval` (s), in as many steps as it takes to stay
    /// within the time step, and returns what the particles did to it: force and torque at the end, impulse
    /// and angular impulse over the interval.
    ///
    /// An interval that is a difference of two times carries their rounding. One that is off from a
    /// multiple of the time step by less than that (2e-9 s, of times up to 1e7 s, and a hundredth of the
    /// time step at the most) is taken for the multiple: the number of steps and their bits do not
    /// depend on when a run begins. The damper's time stays that close to the sum of the intervals.
    ///
    /// # Errors
    /// If the interval is not positive or longer than a thousand million steps, or the motion is not
    /// finite; else as [`step`](Self::step).
    pub fn drive(&mut self, end: Motion, interval: f64) -> Result<Reaction, StepError> {
        self.drive_watched(end, interval, &mut ())
    }

    /// As [`drive`](Self::drive), under the eyes of `observer`.
    ///
    /// # Errors
    /// As [`drive`](Self::drive).
    pub fn drive_watched(
        &mut self,
        end: Motion,
        interval: f64,
        observer: &mut dyn Observer,
    ) -> Result<Reaction, StepError> {
        Bound::Positive.check("interval (s)", interval)?;
        Bound::AtMost(MOST_STEPS * self.time_step).check("interval (s)", interval)?;
        let planar = self.engine.state.planar;
        let end = checked(end, 0, planar)?;
        let cut = self.clock.cut(interval, self.time_step);
        let duration = cut.steps as f64 * cut.step;
        let course = Driven::between(self.container(0).unwrap_or_default(), end, duration);
        self.reset_impulses();
        for number in 1..=cut.steps {
            let next = course.at_part(number as f64 / cut.steps as f64);
            let from = self.container(0).unwrap_or_default();
            self.mount.head_for(self.clock.time(), cut.step, from, next);
            self.advance(cut.step, observer)?;
        }
        Ok(self.reaction(0).unwrap_or_default())
    }

    /// Moves the container to `end` at `time` (s) on the host's clock, which the damper's own
    /// [was set to](crate::Builder::start_time) at the start; else as [`drive`](Self::drive).
    ///
    /// ```
    /// # use particle_damper::{Damper, HertzTsuji, Material, Motion, Slot, glam::DVec3};
    /// let mut damper = Damper::builder(Slot::paper(), HertzTsuji::new(Material::acrylic()))
    ///     .time_step(1e-4)
    ///     .start_time(3600.0)
    ///     .build()?;
    /// let up = Motion::at(DVec3::Y * 1e-3, DVec3::Y);
    /// damper.drive_to(up, 3600.001)?; // ten steps
    /// assert!((damper.time() - 3600.001).abs() < 2e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the time is not after the damper's, or the interval is longer than a thousand million steps;
    /// else as [`drive`](Self::drive).
    pub fn drive_to(&mut self, end: Motion, time: f64) -> Result<Reaction, StepError> {
        self.drive_to_watched(end, time, &mut ())
    }

    /// As [`drive_to`](Self::drive_to), under the eyes of `observer`.
    ///
    /// # Errors
    /// As [`drive_to`](Self::drive_to).
    pub fn drive_to_watched(
        &mut self,
        end: Motion,
        time: f64,
        observer: &mut dyn Observer,
    ) -> Result<Reaction, StepError> {
        let now = self.clock.host_time();
        Bound::Above(now).check("time (s)", time)?;
        self.drive_watched(end, time - now, observer)
    }
}
