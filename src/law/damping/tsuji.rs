//! Impacts with F = k d^(3/2) + c d^(1/4) d', c = alpha sqrt(m* k).
//!
//! The speed as a function of d^(5/4) is that of a linear oscillator with the damping ratio
//! zeta = alpha/sqrt 5, which gives every answer in closed form.

use std::f64::consts::PI;

use super::{Ending, root};

/// ln e of an impact that ends where the force vanishes.
fn log_never_pulling(zeta: f64) -> f64 {
    let s = ((1.0 - zeta) * (1.0 + zeta)).abs().sqrt();
    let angle_over_s = if s < 1e-6 {
        1.0 / zeta
    } else if zeta < 1.0 {
        libm::atan2(s, zeta) / s
    } else {
        libm::asinh(s) / s
    };
    -2.0 * zeta * angle_over_s
}

/// Restitution coefficient of an impact with the damping number `alpha`, finite and not negative.
pub(super) fn restitution(alpha: f64, ending: Ending) -> f64 {
    let zeta = alpha / 5.0_f64.sqrt();
    match ending {
        Ending::NeverPulling => libm::exp(log_never_pulling(zeta)),
        Ending::PullingAllowed if zeta < 1.0 => libm::exp(-PI * zeta / (1.0 - zeta * zeta).sqrt()),
        Ending::PullingAllowed => 0.0,
    }
}

/// The damping number with a restitution coefficient of 0.001 to 1.
pub(super) fn number(target: f64, ending: Ending) -> f64 {
    if target >= 1.0 {
        return 0.0; // Not the -0 of the forms below: its reciprocal bounds the time step.
    }
    let log = libm::log(target);
    let zeta = match ending {
        Ending::PullingAllowed => -log / (PI * PI + log * log).sqrt(),
        Ending::NeverPulling => root(|zeta| log_never_pulling(zeta) - log),
    };
    zeta * 5.0_f64.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn numbers_of_known_restitutions() {
        assert_abs_diff_eq!(
            number(0.75, Ending::NeverPulling),
            0.217_251,
            epsilon = 6e-7
        );
        assert_abs_diff_eq!(number(0.5, Ending::NeverPulling), 0.570_814, epsilon = 6e-7);
        let log = 0.5_f64.ln();
        let antypov = -5.0_f64.sqrt() * log / (PI * PI + log * log).sqrt();
        assert_abs_diff_eq!(
            number(0.5, Ending::PullingAllowed),
            antypov,
            epsilon = 1e-15
        );
    }

    #[test]
    fn restitution_is_continuous_through_critical_damping() {
        let at = |zeta: f64| log_never_pulling(zeta).exp();
        assert_abs_diff_eq!(at(1.0), (-2.0_f64).exp(), epsilon = 1e-15);
        for step in [1e-3, 1e-6, 1e-9, 1e-12, 1e-13] {
            assert_abs_diff_eq!(at(1.0 - step), at(1.0 + step), epsilon = step);
        }
    }

    #[test]
    fn restitution_falls_without_end_when_nothing_pulls() {
        let ladder: Vec<f64> = (0..=300)
            .map(|n| restitution(0.1 * f64::from(n), Ending::NeverPulling))
            .collect();
        assert!(ladder.is_sorted_by(|a, b| a > b) && ladder[300] > 0.0);
        assert!(restitution(3.0, Ending::PullingAllowed) <= 0.0);
    }

    #[test]
    fn no_damping_is_a_positive_zero() {
        for ending in [Ending::NeverPulling, Ending::PullingAllowed] {
            assert_eq!(number(1.0, ending).to_bits(), 0.0_f64.to_bits());
        }
    }
}
