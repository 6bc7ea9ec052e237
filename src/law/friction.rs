use glam::DVec3;

use super::tangent::Tangent;
use crate::numbers::at_least;

use crate::contact::{Bodies, Contact};
use crate::error::{Bound, ValueError};
use crate::material::Interaction;

/// Slip velocity per unit tangential impulse between solid spheres, times m*: a sphere's centre
/// yields by 1/m, its surface by r^2/(2/5 m r^2) more.
pub(super) const SLIP_INVERSE_MASS: f64 = 3.5;

/// The part of a slip (or of a relative spin) that friction may take away in one step. One half
/// keeps every integrator stable and leaves room for several contacts on one particle.
pub(super) const PART_PER_STEP: f64 = 0.5;

/// Stands for zero in a denominator: too small to matter, too large to make anything overflow.
const TINY: f64 = 1e-150;

/// Sliding friction without memory, `f_t = -mu f_n v_t / max(|v_t|, v_r)`: the paper's Eq. (5) with
/// a slip speed `v_r` below which it fades.
///
/// `f_t` is the tangential force on the first body (N), `v_t` its slip (m/s), `f_n` the normal force
/// (N) where it pushes, `mu` the pair's friction coefficient. At zero slip the force is zero in every
/// form. It opposes the slip always, so it only takes energy out of the motion.
///
/// [`stopping`](Self::stopping) is the default. The printed form, `v_r = 0`, overshoots: with a time
/// step `dt` it reverses any slip under `3.5 mu f_n dt / m*` that it should have stopped, and at a
/// coarse step a rough wall shakes what rests or rolls on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    slip_speed: f64,
    stops: bool,
}

impl Default for Friction {
    fn default() -> Self {
        Self::stopping()
    }
}

impl Friction {
    /// The printed form with a force that never takes away more than half of the slip in one time
    /// step: what Eq. (5) tends to as the step shrinks, without its chatter.
    ///
    /// `v_r = 2 * 3.5 mu f_n t / m*`, with the time `t` since the step began and the effective mass
    /// `m*`: solid spheres slip by `3.5 / m*` per unit impulse.
    #[must_use]
    pub const fn stopping() -> Self {
        Self {
            slip_speed: TINY,
            stops: true,
        }
    }

    /// Eq. (5) as printed, of the same size at any slip: `v_r = 0`.
    #[must_use]
    pub const fn as_printed() -> Self {
        Self {
            slip_speed: TINY,
            stops: false,
        }
    }

    /// Proportional to slip below `slip_speed` (m/s), or below the `v_r` of
    /// [`stopping`](Self::stopping) where that is larger.
    ///
    /// What should stick creeps at up to `slip_speed`: choose it well below the speeds of interest.
    ///
    /// # Errors
    /// If `slip_speed` is not positive.
    pub fn regularised(slip_speed: f64) -> Result<Self, ValueError> {
        let slip_speed = Bound::Positive.check("slip speed (m/s)", slip_speed)?;
        Ok(Self {
            slip_speed: slip_speed.max(TINY),
            stops: true,
        })
    }

    /// Prepares for two bodies that meet with `interaction`.
    pub(super) fn coefficients(self, bodies: &Bodies, interaction: &Interaction) -> Grip {
        let stop = SLIP_INVERSE_MASS / (PART_PER_STEP * bodies.effective_mass());
        Grip {
            friction: interaction.friction,
            stop: if self.stops { stop } else { 0.0 },
            rolling: Rolling::new(bodies, interaction),
        }
    }

    /// The tangential force on the first body under the normal force `pressing` (N, not negative).
    #[inline(always)]
    pub(super) fn force(self, grip: &Grip, contact: &Contact, pressing: f64) -> DVec3 {
        if contact.planar {
            self.tangential::<f64>(grip, contact, pressing)
        } else {
            self.tangential::<DVec3>(grip, contact, pressing)
        }
    }

    #[inline(always)]
    fn tangential<T: Tangent>(self, grip: &Grip, contact: &Contact, pressing: f64) -> DVec3 {
        let slip = T::slip(contact);
        let limit = grip.friction * pressing;
        let fades = at_least(contact.elapsed * limit * grip.stop, self.slip_speed);
        (slip * (-limit / at_least(slip.length(), fades))).in_space(contact)
    }
}

/// What friction needs to know of two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grip {
    friction: f64,
    /// Twice the slip velocity per unit impulse, in 1/kg; zero if friction need not stop.
    stop: f64,
    pub(super) rolling: Rolling,
}

/// Rolling resistance of constant couple, `-mu_r r* f_n w / max(|w|, w_r)` with the relative spin `w`
/// of the bodies (rad/s). Below `w_r` it fades, so that it takes away half of `w` in a time step at
/// the most. Ai et al. 2011, doi 10.1016/j.powtec.2010.09.030, model A.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rolling {
    /// `mu_r r*` in m.
    arm: f64,
    /// Twice the relative spin per unit angular impulse, in 1/(kg m^2).
    stop: f64,
}

impl Rolling {
    pub(super) fn new(bodies: &Bodies, interaction: &Interaction) -> Self {
        let yielding = |body: &crate::Body| 1.0 / (0.4 * body.mass * body.radius * body.radius);
        Self {
            arm: interaction.rolling_friction * bodies.effective_radius(),
            stop: (yielding(&bodies.first) + yielding(&bodies.second)) / PART_PER_STEP,
        }
    }

    /// Whether there is any.
    pub(super) const fn resists(&self) -> bool {
        self.arm != 0.0
    }

    /// The couple on the first body under the normal force `pressing` (N, not negative).
    #[inline(always)]
    pub(super) fn couple(&self, contact: &Contact, pressing: f64) -> DVec3 {
        if self.arm == 0.0 {
            return DVec3::ZERO;
        }
        let spin = contact.spins[0] - contact.spins[1];
        let limit = self.arm * pressing;
        let fades = at_least(contact.elapsed * limit * self.stop, TINY);
        spin * (-limit / at_least(spin.length(), fades))
    }
}

/// The factor that cuts `force` down to the length `limit` (not negative).
#[inline(always)]
pub(super) fn share(force: impl Tangent, limit: f64) -> f64 {
    limit / at_least(at_least(force.length(), limit), TINY)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Body;
    use crate::material::Materials;
    use approx::assert_relative_eq;
    use glam::dvec3;

    fn grip(friction: Friction) -> Grip {
        let bodies = Bodies::new(
            Body::sphere(3e-3, 2e-4, Materials::FIRST),
            Body::wall(Materials::FIRST),
        );
        let interaction = Interaction::new(0.75, 0.2).unwrap();
        friction.coefficients(&bodies, &interaction.with_rolling_friction(0.01).unwrap())
    }

    fn sliding(slip: DVec3, elapsed: f64) -> Contact {
        let mut contact = Contact::new(DVec3::Y, 1e-6, slip - 0.3 * DVec3::Y);
        contact.elapsed = elapsed;
        contact
    }

    #[test]
    fn the_printed_force_is_mu_times_the_normal_force_against_the_slip() {
        let law = Friction::as_printed();
        let slip = dvec3(0.03, 0.0, -0.04);
        let force = law.force(&grip(law), &sliding(slip, 1e-5), 10.0);
        assert!((force + slip / 0.05 * 2.0).length() < 1e-14);
    }

    #[test]
    fn no_slip_no_force_and_no_nan() {
        for law in [
            Friction::as_printed(),
            Friction::stopping(),
            Friction::regularised(1e-3).unwrap(),
        ] {
            for elapsed in [0.0, 1e-5] {
                for (slip, pressing) in [(0.0, 1e9), (0.0, 0.0), (1e-200, 1.0), (1e3, 0.0)] {
                    let contact = sliding(slip * DVec3::X, elapsed);
                    let force = law.force(&grip(law), &contact, pressing);
                    assert!(force.length() < 1e-40, "{law:?} {slip} {pressing}: {force}");
                }
            }
        }
    }

    #[test]
    fn a_step_takes_away_half_of_a_small_slip_at_the_most() {
        let law = Friction::stopping();
        let (dt, slip) = (1e-5, 1e-3);
        let force = law.force(&grip(law), &sliding(slip * DVec3::X, dt), 10.0);
        assert_relative_eq!(
            -force.x * dt * SLIP_INVERSE_MASS / 2e-4,
            0.5 * slip,
            max_relative = 1e-14
        );
    }

    #[test]
    fn regularised_friction_is_a_ramp_up_to_the_slip_speed() {
        let law = Friction::regularised(0.1).unwrap();
        let at = |slip: f64| {
            -law.force(&grip(law), &sliding(slip * DVec3::X, 0.0), 10.0)
                .x
        };
        assert_relative_eq!(at(0.025), 0.5, max_relative = 1e-14);
        assert_relative_eq!(at(0.1), 2.0, max_relative = 1e-14);
        assert_relative_eq!(at(7.0), 2.0, max_relative = 1e-14);
        assert!(Friction::regularised(0.0).is_err());
    }

    #[test]
    fn rolling_resistance_opposes_the_relative_spin_and_stops_it_softly() {
        let rolling = grip(Friction::default()).rolling;
        let mut contact = sliding(DVec3::ZERO, 1e-5);
        assert_eq!(rolling.couple(&contact, 10.0), DVec3::ZERO);
        contact.spins = [5e3 * DVec3::Z, DVec3::ZERO];
        let couple = rolling.couple(&contact, 10.0);
        assert_relative_eq!(couple.z, -0.01 * 3e-3 * 10.0, max_relative = 1e-14);
        contact.spins = [DVec3::ZERO, 1e-3 * DVec3::Z];
        let couple = rolling.couple(&contact, 10.0);
        let inertia = 0.4 * 2e-4 * 3e-3 * 3e-3;
        assert_relative_eq!(couple.z * 1e-5 / inertia, 0.5e-3, max_relative = 1e-12);
    }

    #[test]
    fn cutting_shortens_and_never_lengthens() {
        assert_relative_eq!(share(4.0 * DVec3::X, 2.0), 0.5);
        assert_relative_eq!(share(3.0 * DVec3::X, 4.0), 1.0);
        assert_relative_eq!(share(3.0 * DVec3::X, 0.0), 0.0);
        assert_relative_eq!(share(DVec3::ZERO, 0.0), 0.0);
    }
}
