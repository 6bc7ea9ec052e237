use crate::law::{Damping, Ending};

/// A ball that bounces straight up and down on a floor: how it flies, and what an impact leaves of its
/// speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounces {
    /// m/s^2.
    pub(super) gravity: f64,
    /// Speed at which drag balances weight in m/s; infinite without air.
    pub(super) terminal: f64,
    pub(super) damping: Damping,
    pub(super) ending: Ending,
    /// Speed in m/s at which the damping number is meant.
    pub(super) reference: f64,
}

impl Bounces {
    /// Restitution at an impact speed (m/s) for a damping number at the reference speed. A fit may ask for
    /// less than none, as noise has it: energy is then gained as it is lost at the opposite number.
    pub(super) fn restitution(&self, number: f64, speed: f64) -> f64 {
        let here = self.damping.at_speed(number, speed / self.reference);
        let size = here.abs().min(100.0);
        let lost = 1.0 - self.damping.restitution(size, self.ending).unwrap_or(0.0);
        1.0 - lost.copysign(here)
    }

    fn resisted(&self) -> bool {
        self.terminal.is_finite()
    }

    /// Time (s) up to the peak, for a speed (m/s) upwards.
    pub(super) fn ascent(&self, speed: f64) -> f64 {
        if self.resisted() {
            self.terminal / self.gravity * libm::atan(speed / self.terminal)
        } else {
            speed / self.gravity
        }
    }

    /// Time (s) from one impact to the next.
    pub(super) fn flight(&self, speed: f64) -> f64 {
        let descent = if self.resisted() {
            self.terminal / self.gravity * libm::asinh(speed / self.terminal)
        } else {
            speed / self.gravity
        };
        self.ascent(speed) + descent
    }

    /// Height (m) of the peak.
    pub(super) fn height(&self, speed: f64) -> f64 {
        let square = speed * speed;
        if self.resisted() {
            let terminal = self.terminal * self.terminal;
            0.5 * terminal / self.gravity * libm::log1p(square / terminal)
        } else {
            0.5 * square / self.gravity
        }
    }

    /// The speed (m/s) of the next impact.
    pub(super) fn landing(&self, speed: f64) -> f64 {
        speed / libm::hypot(1.0, speed / self.terminal)
    }

    /// Speeds (m/s) upwards, from the first, `first`, on.
    pub(super) fn speeds(&self, number: f64, first: f64) -> impl Iterator<Item = f64> {
        std::iter::successors(Some(first), move |speed| {
            let landing = self.landing(*speed);
            Some(landing * self.restitution(number, landing))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Flight under quadratic drag against small steps of the classical Runge-Kutta method.
    #[test]
    fn flights_under_drag_are_those_of_the_equation_of_motion() {
        let bounces = Bounces {
            gravity: 9.81,
            terminal: 8.0,
            damping: Damping::Tsuji,
            ending: Ending::NeverPulling,
            reference: 1.0,
        };
        let start = 3.0;
        let rate = |v: f64| -9.81 * (1.0 + v * v.abs() / 64.0);
        let (mut t, mut x, mut v, h) = (0.0, 0.0_f64, start, 1e-5);
        let (mut peak, mut top) = (0.0, 0.0);
        loop {
            let (k1, l1) = (v, rate(v));
            let (k2, l2) = (v + 0.5 * h * l1, rate(v + 0.5 * h * l1));
            let (k3, l3) = (v + 0.5 * h * l2, rate(v + 0.5 * h * l2));
            let (k4, l4) = (v + h * l3, rate(v + h * l3));
            let before = (x, v);
            x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
            v += h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
            t += h;
            if before.1 > 0.0 && v <= 0.0 {
                (peak, top) = (t, x);
            }
            if x <= 0.0 {
                break;
            }
        }
        assert!((bounces.ascent(start) - peak).abs() < 2e-5);
        assert!((bounces.height(start) - top).abs() < 1e-6);
        assert!((bounces.flight(start) - t).abs() < 2e-5);
        assert!((bounces.landing(start) + v).abs() < 2e-4);
    }

    #[test]
    fn thin_air_is_no_air() {
        let thin = Bounces {
            gravity: 9.81,
            terminal: 1e5,
            damping: Damping::Viscoelastic,
            ending: Ending::NeverPulling,
            reference: 1.0,
        };
        let none = Bounces {
            terminal: f64::INFINITY,
            ..thin
        };
        assert!((thin.flight(2.0) - none.flight(2.0)).abs() < 1e-9);
        assert!((thin.height(2.0) - none.height(2.0)).abs() < 1e-9);
        assert!((none.landing(2.0) - 2.0).abs() < 1e-15);
        // Slower impacts return more, and noise may ask for a gain.
        let returned = |speed| none.restitution(0.3, speed);
        assert!(returned(0.1) > returned(1.0) && returned(1.0) > returned(3.0));
        assert!(none.restitution(-0.1, 1.0) > 1.0);
    }
}
