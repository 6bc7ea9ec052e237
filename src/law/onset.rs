//! Onset correction: the first and the last step of a contact's force.
//!
//! Bodies meet and part between two evaluations. The force sets in like a power p of time, 3/2 of a
//! spring, 1/2 or 1/4 of damping, and is not smooth there: whatever the integrator, forces taken at
//! intervals h miss the impulse F0 t^p by F0 h^(p+1) zeta(-p, x), with the Hurwitz zeta function and
//! the time x h from first touch to the first evaluation (Navot 1961, doi 10.1002/sapm1961401271). The
//! one evaluation that is within h of the touch can make up for that. What is left is of order h^2 and
//! better, where it was h^(5/4) to h^(5/2).
//!
//! Where bodies never pull each other, the force ends before the contact does: when spring and dashpot are equal it
//! is cut off with a kink, which costs an error of order h^2 that depends on the phase. The force until then is that
//! of a power of the spring and one of the dashpot less the pull that is not there, whose impulse is known; so the
//! last evaluation before the cut makes up for it by the same sums.
//!
//! The mean restitution over the phase of first touch would be as right without it. What it is for is
//! the spread: at six steps to a contact, with restitutions from 0.3 to 0.95, that of the farthest phase
//! is off by 0.009 instead of 0.060. Its price is 5 to 10 % of the time of a step.

use super::damping::{Damping, Ending};
use super::exponent::Exponent;
use super::normal::{Normal, NormalCoefficients, NormalForce};
use crate::contact::{Contact, Onset};
use crate::numbers::{at_least, at_most};

/// Relative error of an overlap against the way in a step. Overlaps are differences of coordinates, of some
/// 0.1 m to 1e-17 m, and ways of interest are 1e-10 m or more.
const ROUNDING: f64 = 1e-6;

/// Where a contact begins, its speed falls during the step like an exponential rather than a line. Of
/// 0, 0.1 ... 0.6 this part leaves the least mean error of restitutions from 0.3 to 0.95 at 4.5 and at
/// 6 steps to a contact: 1.5 % and 0.5 % of the restitution, with either damping.
const SLOWED: f64 = 0.5;

/// How often the end of a pull is worked out: with three rounds the restitution is within 0.1 % of that
/// with twenty.
const ENDINGS: usize = 3;

/// What evaluations see of a spring and a dashpot where a contact begins or ends.
#[derive(Debug, Clone, Copy)]
struct Sampled {
    own: NormalCoefficients,
    damping: Damping,
}

impl Sampled {
    /// Force of the spring (N) and damping force per speed (N s/m) that the evaluation at `part` of a
    /// step after the touch has to give, if the bodies come by `way` (m) in a step.
    fn at(&self, way: f64, part: f64) -> (f64, f64) {
        let NormalCoefficients {
            stiffness, damping, ..
        } = self.own;
        let exponent = self.damping.exponent();
        let spring =
            stiffness * Exponent::ThreeHalves.of(way) * Exponent::ThreeHalves.sampled(part);
        (spring, damping * exponent.of(way) * exponent.sampled(part))
    }

    /// What the last evaluation before the force is cut off at zero has to give more than the force, in N. The
    /// bodies part at `speed` (m/s), by `way` (m) in a step, and still overlap by `overlap` (m).
    fn until_cut(&self, speed: f64, way: f64, overlap: f64) -> f64 {
        let NormalCoefficients {
            stiffness, damping, ..
        } = self.own;
        // The overlap at which spring and dashpot are equal, and when before its end that is, in steps.
        let power = self.damping.exponent();
        let cut = self.damping.balance(damping * speed / stiffness);
        let (part, rest) = (overlap / way, cut / way);
        if rest > 1.0 || part > rest + 1.0 {
            return 0.0;
        }
        let missed = |power: Exponent| power.of(way) * power.missed(part);
        let spring = Exponent::ThreeHalves;
        // Sampled to the end of the overlap; but from the cut on there is no pull.
        stiffness * missed(spring) - damping * speed * missed(power)
            + stiffness * spring.of(cut) * rest * (power.integral() - spring.integral())
    }

    /// The first force of a contact. `gain` is the speed that a force takes away until the end of the
    /// step, per unit of it.
    fn first(&self, coming: f64, way: f64, part: f64, gain: f64) -> f64 {
        let (spring, resistance) = self.at(way, part);
        // The dashpot acts from the touch to half a step from now, with this mean.
        let slowing = resistance * gain / (part + 0.5);
        (spring + resistance * coming) / (1.0 + slowing / (1.0 + SLOWED * slowing))
    }
}

impl NormalForce {
    /// The normal force where the bodies may have met or may part within a step h of now, with what
    /// evaluations h apart miss made up for; `before` (N) was that at the end of the step before.
    pub(super) fn at_onset(
        &self,
        coefficients: &NormalCoefficients,
        contact: &Contact,
        before: f64,
        onset: &Onset,
    ) -> Normal {
        let mut normal = self.at(coefficients, contact, before);
        let own = coefficients.yielding(self.damping, contact);
        let (overlap, h) = (contact.overlap, onset.time_step);
        // The mean speed since the step began, which is that of touch if they touched since; before its
        // end they may have touched in the step before, and the speed at its start is nearer.
        let back = if contact.elapsed < h { 1.0 } else { 0.5 } * contact.elapsed;
        // A wall that yields gives way to the force that it bore.
        let acceleration = onset.acceleration + before * contact.wall_inverse_mass;
        let coming = contact.approach_speed() + back * acceleration;
        let gain = own.inverse_mass * contact.correction;
        let damping = self.damping;
        let sampled = Sampled { own, damping };
        let way = coming * h;
        // To within rounding, what tells whether they touched already as the step began is whether they
        // were slowed down then.
        let part = overlap / way;
        let in_step = if (part - 1.0).abs() < ROUNDING {
            acceleration < 0.5 * own.inverse_mass * sampled.first(coming, way, 0.0, gain)
        } else {
            overlap < way
        };
        if in_step {
            normal.force = sampled.first(coming, way, part, gain);
            return normal;
        }
        if contact.approach_speed() > 0.0 {
            return normal;
        }
        let leaving = |force: f64| force * h * own.inverse_mass - coming;
        let speed = leaving(normal.force);
        let mut way = speed * h;
        if self.ending == Ending::NeverPulling && gain > 0.0 {
            if way > 0.0 && normal.force > 0.0 {
                let more = sampled.until_cut(speed, way, overlap);
                normal.force = self.ended(normal.force + more);
            }
            return normal;
        }
        if overlap > way {
            return normal;
        }
        // Where velocities are not predicted, the spring alone is made up for.
        if gain == 0.0 {
            let spring = Exponent::ThreeHalves;
            let more = own.stiffness * spring.of(way) * spring.missed(overlap / way);
            normal.force = self.ended(normal.force + more);
            return normal;
        }
        // A pull ends as a contact sets in. It slows the bodies down, and so its end depends on it.
        let speed = contact.approach_speed() + before * gain;
        for _ in 0..ENDINGS {
            let part = at_most(overlap / way, 1.0);
            let (spring, resistance) = sampled.at(way, part);
            let slowing = resistance * gain * (2.0 - 1.0 / (part + 0.5));
            normal.force = (spring + resistance * speed) / (1.0 + slowing);
            way = at_least(leaving(normal.force) * h, overlap);
        }
        normal
    }
}
