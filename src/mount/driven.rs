use super::{Motion, Mount};

/// The part of an interval that rounding of the time may leave at its end.
const ROUNDING: f64 = 1e-6;

/// A container moved from outside: a host program hands in position and velocity at the end of each
/// step ([`Damper::drive`](crate::Damper::drive)), and gets the reaction back. Within the step the
/// container follows the cubic that has both motions at its ends.
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
        let excess_from = self.from.velocity * h - step;
        let excess_to = self.to.velocity * h - step;
        let bend = excess_from * (s * (1.0 - s) * (1.0 - s)) - excess_to * (s * s * (1.0 - s));
        let slope = excess_from * ((1.0 - s) * (1.0 - 3.0 * s)) - excess_to * (s * (2.0 - 3.0 * s));
        Motion::at(self.from.position + step * s + bend, (step + slope) / h)
    }
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
}
