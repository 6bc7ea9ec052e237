//! Impacts with F = k d^(3/2) + c d^(1/2) d'.
//!
//! In units of length (m* v^2/k)^(2/5) and speed v the overlap u obeys u" + u^(3/2) + beta u^(1/2)
//! u' = 0, u = 0 and u' = 1 at first touch. With u = q^2 and dt = 2 q ds this turns into
//! dq/ds = w, dw/ds = -2 q^2 (q^2 + beta w), which is smooth throughout and has a Taylor series by
//! recurrence.

use super::{Ending, root};

/// Terms of a series.
const ORDER: usize = 24;

/// The impact from one moment on, as polynomials in s.
struct Series {
    q: [f64; ORDER + 1],
    w: [f64; ORDER + 1],
}

impl Series {
    fn new(q0: f64, w0: f64, beta: f64) -> Self {
        let mut q = [0.0; ORDER + 1];
        let mut w = [0.0; ORDER + 1];
        let mut overlap = [0.0; ORDER];
        let mut force = [0.0; ORDER];
        (q[0], w[0]) = (q0, w0);
        for n in 0..ORDER {
            overlap[n] = (0..=n).map(|i| q[i] * q[n - i]).sum();
            force[n] = overlap[n] + beta * w[n];
            let product: f64 = (0..=n).map(|i| overlap[i] * force[n - i]).sum();
            let next = (n + 1) as f64;
            q[n + 1] = w[n] / next;
            w[n + 1] = -2.0 * product / next;
        }
        Self { q, w }
    }

    /// How far the series can be trusted to rounding. At first touch as few as every fifth term is
    /// other than zero; towards a late end all are small.
    fn reach(&self, beta: f64) -> f64 {
        let scale = self.w[0].abs().max(self.q[0] * self.q[0] / (1.0 + beta));
        (ORDER - 5..=ORDER)
            .flat_map(|n| [(n, self.q[n]), (n, self.w[n])])
            .map(|(n, term)| libm::pow(1e-17 * scale / term.abs(), 1.0 / n as f64))
            .fold(f64::MAX, f64::min)
    }

    fn at(&self, s: f64) -> (f64, f64) {
        let sum = |terms: &[f64]| terms.iter().rev().fold(0.0, |sum, term| sum * s + term);
        (sum(&self.q), sum(&self.w))
    }
}

/// Restitution coefficient of an impact with the damping number `beta`, finite and not negative.
pub(super) fn restitution(beta: f64, ending: Ending) -> f64 {
    let over = |(q, w): (f64, f64)| {
        q <= 0.0 || (ending == Ending::NeverPulling && q * q + beta * w <= 0.0)
    };
    let (mut q, mut w) = (0.0, 1.0);
    loop {
        let series = Series::new(q, w, beta);
        let reach = series.reach(beta);
        (q, w) = series.at(reach);
        if over((q, w)) {
            // The speed is stationary where the contact ends: half the digits are enough for s.
            let (mut before, mut after) = (0.0, reach);
            for _ in 0..40 {
                let middle = 0.5 * (before + after);
                if over(series.at(middle)) {
                    after = middle;
                } else {
                    before = middle;
                }
            }
            return -series.at(after).1;
        }
    }
}

/// The damping number with a restitution coefficient of 0.001 to 1.
pub(super) fn number(target: f64, ending: Ending) -> f64 {
    if target >= 1.0 {
        return 0.0;
    }
    root(|beta| libm::log(restitution(beta, ending) / target))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    /// Fine fixed steps of the classical Runge-Kutta method on the equation as first written.
    fn restitution_by_brute_force(beta: f64, ending: Ending) -> f64 {
        let force = |u: f64, v: f64| -(u.max(0.0).powf(1.5) + beta * u.max(0.0).sqrt() * v);
        let (mut u, mut v, h) = (0.0_f64, 1.0_f64, 2e-5);
        loop {
            let (k1, l1) = (v, force(u, v));
            let (k2, l2) = (v + 0.5 * h * l1, force(u + 0.5 * h * k1, v + 0.5 * h * l1));
            let (k3, l3) = (v + 0.5 * h * l2, force(u + 0.5 * h * k2, v + 0.5 * h * l2));
            let (k4, l4) = (v + h * l3, force(u + h * k3, v + h * l3));
            u += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
            v += h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
            if u <= 0.0 || (ending == Ending::NeverPulling && u + beta * v <= 0.0) {
                return -v;
            }
        }
    }

    #[test]
    fn restitution_agrees_with_a_brute_force_integration() {
        for ending in [Ending::NeverPulling, Ending::PullingAllowed] {
            for beta in [0.01, 0.1, 0.7, 2.5] {
                let brute = restitution_by_brute_force(beta, ending);
                assert_abs_diff_eq!(restitution(beta, ending), brute, epsilon = 1e-7);
            }
        }
    }

    #[test]
    fn restitution_of_published_damping_numbers() {
        for (beta, ending, e) in [
            (0.1, Ending::NeverPulling, 0.892_859),
            (0.3, Ending::NeverPulling, 0.722_085),
            (1.0, Ending::NeverPulling, 0.393_931),
            (0.1, Ending::PullingAllowed, 0.892_148),
            (1.0, Ending::PullingAllowed, 0.331_165),
        ] {
            assert_abs_diff_eq!(restitution(beta, ending), e, epsilon = 6e-7);
        }
        assert_abs_diff_eq!(number(0.9, Ending::NeverPulling), 0.092_838, epsilon = 6e-7);
        assert_abs_diff_eq!(number(0.5, Ending::NeverPulling), 0.698_041, epsilon = 6e-7);
    }

    /// Mueller & Poeschel 2011, doi 10.1103/PhysRevE.84.021302, Pade form for weak damping.
    #[test]
    fn restitution_of_weak_damping_follows_the_pade_form() {
        for beta in [1e-4, 1e-3, 0.01, 0.1, 0.2] {
            let s = f64::sqrt(beta);
            let numerator = 1.0 + 0.501_086 * s;
            let pade = numerator
                / (numerator + 1.15345 * beta + 0.577_977 * s.powi(3) + 0.532_178 * s.powi(4));
            assert_abs_diff_eq!(
                restitution(beta, Ending::NeverPulling),
                pade,
                epsilon = 3e-4
            );
        }
    }

    #[test]
    fn restitution_is_one_without_damping_and_falls_to_nothing() {
        for ending in [Ending::NeverPulling, Ending::PullingAllowed] {
            assert_abs_diff_eq!(restitution(0.0, ending), 1.0, epsilon = 1e-13);
            let ladder: Vec<f64> = (0..=100)
                .map(|n| restitution(f64::from(n), ending))
                .collect();
            assert!(ladder.is_sorted_by(|a, b| a > b) && ladder[100] > 0.0 && ladder[100] < 1e-3);
        }
    }
}
