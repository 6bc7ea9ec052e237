//! Restitution that fades with the speed of approach, as under viscoelastic damping.
//!
//! There it depends on beta v^(1/5) alone (Ramirez et al. 1999, doi 10.1103/PhysRevE.60.4465), and is a
//! smooth function of the root of that, s = (beta v^(1/5))^(1/2) (Mueller & Poeschel 2011,
//! doi 10.1103/PhysRevE.84.021302). So few values of it tell the rest: it is interpolated between those at
//! Chebyshev's points.

use crate::error::ValueError;
use crate::law::damping::{Damping, Ending};

/// How many values are interpolated between: the error is below 1e-4 for restitutions from 0.05 on.
const POINTS: usize = 9;

/// Speeds over the reference speed that the values span, slower and faster.
const SPAN: [f64; 2] = [1e-3, 1e2];

/// Restitution against speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fading {
    reference_speed: f64,
    /// Values at Chebyshev's points of (v/v0)^(1/10) between the ends of the span.
    values: [f64; POINTS],
}

/// The ends of the span in (v/v0)^(1/10).
fn ends() -> [f64; 2] {
    SPAN.map(|ratio| libm::pow(ratio, 0.1))
}

/// Chebyshev's points of the second kind between -1 and 1.
fn point(n: usize) -> f64 {
    libm::cos(std::f64::consts::PI * n as f64 / (POINTS - 1) as f64)
}

impl Fading {
    /// The damping number `number` at `reference_speed` (m/s).
    pub(super) fn new(number: f64, reference_speed: f64) -> Result<Self, ValueError> {
        let [low, high] = ends();
        let mut values = [0.0; POINTS];
        for (n, value) in values.iter_mut().enumerate() {
            let root = 0.5 * (low + high) + 0.5 * (high - low) * point(n);
            *value = Damping::Viscoelastic
                .restitution((number * root * root).min(100.0), Ending::NeverPulling)?;
        }
        Ok(Self {
            reference_speed,
            values,
        })
    }

    /// Restitution at a speed (m/s): the barycentric formula (Berrut & Trefethen 2004,
    /// doi 10.1137/S0036144502417715). Beyond the span it is that at its end.
    pub(super) fn at(&self, speed: f64) -> f64 {
        let [low, high] = ends();
        let root = libm::pow(speed / self.reference_speed, 0.1).clamp(low, high);
        let place = (2.0 * root - low - high) / (high - low);
        let (mut above, mut below) = (0.0, 0.0);
        for (n, value) in self.values.iter().enumerate() {
            let apart = place - point(n);
            if apart == 0.0 {
                return *value;
            }
            let end = n == 0 || n == POINTS - 1;
            let sign = if n.is_multiple_of(2) { 1.0 } else { -1.0 };
            let weight = sign * if end { 0.5 } else { 1.0 } / apart;
            above += weight * value;
            below += weight;
        }
        above / below
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_that_of_viscoelastic_damping_at_every_speed() {
        for e in [0.05, 0.2, 0.5, 0.75, 0.95, 1.0] {
            let number = Damping::Viscoelastic
                .number(e, Ending::NeverPulling)
                .unwrap();
            let fading = Fading::new(number, 0.7).unwrap();
            for step in 0..=100 {
                let ratio = SPAN[0] * (SPAN[1] / SPAN[0]).powf(f64::from(step) / 100.0);
                let exact = Damping::Viscoelastic
                    .restitution(number * ratio.powf(0.2), Ending::NeverPulling)
                    .unwrap();
                let found = fading.at(0.7 * ratio);
                assert!(
                    (found - exact).abs() < 1e-4,
                    "{e} at {ratio}: {found}, {exact}"
                );
            }
            assert!((fading.at(0.7) - e).abs() < 1e-4);
            assert!((fading.at(1e6) - fading.at(0.7 * SPAN[1])).abs() < 1e-12);
        }
    }
}
