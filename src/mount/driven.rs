use glam::{DQuat, DVec3};

use super::{Motion, Mount};
use crate::rotation::{angular_velocity, exp, log, rate};

/// The part of an interval that rounding of the time may leave at its end: far above that of sums of parts of
/// it, 1e-16, and far below the least distance of two stages of an integrator, a half.
const ROUNDING: f64 = 1e-6;

/// A container moved from outside: a host program hands in its motion at the end of each step
/// ([`Damper::drive`](crate::Damper::drive)), and gets the reaction back. Within the step the container
/// follows the cubic that has both motions at its ends. Where it turns, it does so at the mean of both
/// angular velocities, and by a rotation vector that is a cubic besides: a steady rotation is exact, by
/// however many revolutions, and what is left may be up to half of one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Driven {
    begin: f64,
    duration: f64,
    from: Motion,
    to: Motion,
}

impl Driven {
    /// A container that stays where `motion` puts it until it is driven.
    #[must_use]
    pub const fn at(motion: Motion) -> Self {
        Self {
            begin: 0.0,
            duration: 0.0,
            from: motion,
            to: motion,
        }
    }

    /// A course from `from` to `to` within `duration` (s).
    pub(crate) const fn between(from: Motion, to: Motion, duration: f64) -> Self {
        Self {
            begin: 0.0,
            duration,
            from,
            to,
        }
    }

    /// Heads from `from` at `begin` for `to` at `begin + duration`.
    pub(crate) const fn head_for(&mut self, begin: f64, duration: f64, from: Motion, to: Motion) {
        *self = Self {
            begin,
            duration,
            from,
            to,
        };
    }

    /// The motion when the part `s` of the course is behind: the cubic Hermite, written around the
    /// straight line so that a steady motion is exact.
    #[inline]
    pub(crate) fn at_part(&self, s: f64) -> Motion {
        if s >= 1.0 {
            return self.to;
        }
        let h = self.duration;
        let step = self.to.position - self.from.position;
        let velocities = [self.from.velocity, self.to.velocity];
        let (bend, slope) = bend(s, step, velocities.map(|velocity| velocity * h));
        let place = Motion::at(self.from.position + step * s + bend, (step + slope) / h);
        if self.turns() {
            let (orientation, angular_velocity) = self.turn_at(s);
            place.turned(orientation, angular_velocity)
        } else {
            place.turned(self.to.orientation, DVec3::ZERO)
        }
    }

    /// Whether the container turns on the way.
    fn turns(&self) -> bool {
        let Self { from, to, .. } = self;
        from.orientation != to.orientation
            || from.angular_velocity != DVec3::ZERO
            || to.angular_velocity != DVec3::ZERO
    }

    /// Orientation and angular velocity when the part `s` of the course is behind.
    fn turn_at(&self, s: f64) -> (DQuat, DVec3) {
        let Self { from, to, .. } = self;
        let h = self.duration;
        let mean = (from.angular_velocity + to.angular_velocity) * 0.5;
        let steady = |part: f64| exp(mean * (h * part)) * from.orientation;
        // What is left after the steady rotation, and its rates at both ends.
        let rest = log(to.orientation * steady(1.0).conjugate());
        let left = to.angular_velocity - exp(rest) * mean;
        let rates = [from.angular_velocity - mean, rate(rest, left)];
        let (bend, slope) = bend(s, rest, rates.map(|rate| rate * h));
        let vector = rest * s + bend;
        let besides = exp(vector);
        let turning = angular_velocity(vector, (rest + slope) / h) + besides * mean;
        ((besides * steady(s)).normalize(), turning)
    }
}

/// How far the cubic Hermite is off the straight line that goes by `step` when the part `s` is behind, and
/// the same of its slope, both per length of the course; `ends` are the slopes at the ends.
#[inline]
fn bend(s: f64, step: DVec3, ends: [DVec3; 2]) -> (DVec3, DVec3) {
    let [from, to] = ends.map(|end| end - step);
    (
        from * (s * (1.0 - s) * (1.0 - s)) - to * (s * s * (1.0 - s)),
        from * ((1.0 - s) * (1.0 - 3.0 * s)) - to * (s * (2.0 - 3.0 * s)),
    )
}

impl Mount for Driven {
    #[inline]
    fn motion(&self, time: f64, _x: &[f64], _v: &[f64], _cavity: usize) -> Motion {
        let h = self.duration;
        // The very end to the bit, so that a damper that is restored starts from the same.
        let rounding = ROUNDING * h + 4.0 * f64::EPSILON * time.abs();
        if self.begin + h - time <= rounding {
            return self.to;
        }
        self.at_part(((time - self.begin) / h).clamp(0.0, 1.0))
    }

    fn resume(&mut self, motions: &[Motion]) {
        *self = Self::at(motions.first().copied().unwrap_or_default());
    }
}

/// A container that follows a function of time.
///
/// ```
/// use glam::DVec3;
/// use particle_damper::mount::{Motion, Prescribed};
///
/// let (amplitude, omega) = (0.01, 37.7);
/// let shaken = Prescribed(move |t: f64| {
///     let (sine, cosine) = (omega * t).sin_cos();
///     Motion::at(DVec3::Y * amplitude * sine, DVec3::Y * amplitude * omega * cosine)
/// });
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Prescribed<F>(pub F);

impl<F: Fn(f64) -> Motion> Mount for Prescribed<F> {
    #[inline]
    fn motion(&self, time: f64, _x: &[f64], _v: &[f64], _cavity: usize) -> Motion {
        (self.0)(time)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn the_cubic_has_the_given_motions_at_its_ends_and_a_steady_one_between() {
        let mut mount = Driven::default();
        let to = Motion::at(DVec3::new(0.1, 0.2, 0.0), DVec3::new(-1.0, 3.0, 0.0));
        mount.head_for(2.0, 0.5, Motion::default(), to);
        let end = mount.motion(2.5, &[], &[], 0);
        assert_eq!(end, to);
        let just_before = mount.motion(2.5 - 1e-6, &[], &[], 0);
        assert!((just_before.position - to.position).length() < 4e-6);
        assert!((just_before.velocity - to.velocity).length() < 1e-4);
        assert_eq!(mount.motion(2.0, &[], &[], 0), Motion::default());

        let steady = DVec3::X * 2.0;
        let through = |position| Motion::at(position, steady);
        mount.head_for(0.0, 0.5, through(DVec3::ZERO), through(DVec3::X));
        let middle = mount.motion(0.2, &[], &[], 0);
        assert!((middle.position - DVec3::X * 0.4).length() < 1e-15);
        assert!((middle.velocity - steady).length() < 1e-14);
    }
    /// Angular velocity is the rate of the orientation all along, and has the given values at the ends.
    #[test]
    fn a_turn_is_smooth_and_has_the_given_motions_at_its_ends() {
        let start = DQuat::from_rotation_x(0.4);
        for (angle, spins) in [
            (
                0.7,
                [DVec3::new(1.0, -2.0, 0.5), DVec3::new(-0.5, 3.0, 1.0)],
            ),
            (2.8, [DVec3::ZERO, DVec3::ZERO]),
            (0.0, [DVec3::Y * 40.0, DVec3::new(3.0, 41.0, 0.0)]),
        ] {
            let from = Motion::at(DVec3::ZERO, DVec3::ZERO).turned(start, spins[0]);
            let steady = exp((spins[0] + spins[1]) * 0.25);
            let end = DQuat::from_rotation_y(angle) * steady * start;
            let to = Motion::at(DVec3::X, DVec3::ZERO).turned(end, spins[1]);
            let course = Driven::between(from, to, 0.5);
            let first = course.at_part(0.0);
            assert!((first.orientation - start).length() < 1e-15);
            assert!((first.angular_velocity - spins[0]).length() < 1e-13);
            let last = course.at_part(1.0 - 1e-12);
            assert!(last.orientation.angle_between(end) < 1e-9);
            assert!((last.angular_velocity - spins[1]).length() < 1e-9);
            for part in [0.1, 0.35, 0.62, 0.9] {
                let h = 1e-5;
                let [before, after] = [part - h, part + h].map(|s| course.at_part(s).orientation);
                let measured = log(after * before.conjugate()) / (2.0 * h * 0.5);
                let stated = course.at_part(part).angular_velocity;
                assert!(
                    (measured - stated).length() < 1e-6,
                    "{part}: {measured} {stated}"
                );
            }
        }
    }

    #[test]
    fn a_steady_rotation_of_many_turns_is_followed() {
        let spin = DVec3::new(0.0, 100.0, 0.0);
        let from = Motion::default().turned(DQuat::IDENTITY, spin);
        let to = Motion::default().turned(exp(spin * 0.5), spin);
        let quarter = Driven::between(from, to, 0.5).at_part(0.25);
        assert!((quarter.orientation.dot(exp(spin * 0.125)).abs() - 1.0).abs() < 1e-14);
        assert!((quarter.angular_velocity - spin).length() < 1e-11);
    }
}
