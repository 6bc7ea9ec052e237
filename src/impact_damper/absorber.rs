use std::f64::consts::PI;

use super::loss;
use crate::error::{Bound, ValueError};

/// A point of the backbone of an impact absorber on an oscillator.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct AbsorberPoint {
    /// Frequency over that with the ball fixed.
    pub frequency: f64,
    /// Half the clearance over the amplitude at resonance with the ball fixed.
    pub clearance: f64,
}

/// An oscillator with a ball in a box, at resonance, with two impacts per cycle, to one harmonic: where it is
/// if its amplitude is `amplitude` times half the clearance. `mass_ratio` is the ball's part of the whole mass,
/// `damping_ratio` that of the oscillator with the ball fixed. Without gravity and friction. None where the
/// motion does not exist.
///
/// Weidemann et al., Nonlinear Dyn. 2025, doi 10.1007/s11071-025-10928-4. It says where the motion exists, not
/// that it is stable: at a mass ratio of 0.02, a damping ratio of 1e-3 and e 0.8 it is not at clearances of
/// 0.07, 0.15 and 0.3 on the backbone, and what happens instead is irregular and smaller.
///
/// # Errors
/// If the mass ratio is not between 0 and 1 (both excluded), amplitude or damping ratio is not positive, or
/// restitution is not in 0 to 1 (excluded).
pub fn absorber(
    mass_ratio: f64,
    damping_ratio: f64,
    restitution: f64,
    amplitude: f64,
) -> Result<Option<AbsorberPoint>, ValueError> {
    let xi = Bound::Positive.check("amplitude over half the clearance", amplitude)?;
    let damping = Bound::Positive.check("damping ratio", damping_ratio)?;
    Bound::Above(0.0).check("mass ratio", mass_ratio)?;
    let eps = Bound::Below(1.0).check("mass ratio", mass_ratio)?;
    Bound::Below(1.0).check("restitution", restitution)?;
    let rho = 2.0 * loss(restitution)? / PI;
    let square = 1.0 + rho * rho;
    let root = square * xi * xi - rho * rho;
    if root < 0.0 {
        return Ok(None);
    }
    let theta = (1.0 + root.sqrt()) / square;
    let cosine = (theta - 1.0) / xi;
    if cosine.abs() > 1.0 {
        return Ok(None);
    }
    // The ball's part of the force, over half the clearance.
    let ball = 8.0 * eps * theta / (PI * PI);
    let inertia = (1.0 - eps) * xi + ball * cosine;
    if inertia <= 0.0 {
        return Ok(None);
    }
    let r = (xi / inertia).sqrt();
    let sine = (1.0 - cosine * cosine).sqrt();
    let resistance = 2.0 * damping * r * xi + ball * r * r * sine;
    Ok(Some(AbsorberPoint {
        frequency: r,
        clearance: 2.0 * damping / resistance,
    }))
}

/// The largest clearance at which an absorber has a steady motion with two impacts per cycle at resonance:
/// half of it over the amplitude at resonance with the ball fixed, which is 1/(2 `damping_ratio`) of the
/// static deflection. Arguments, limits and source as for [`absorber`].
///
/// # Errors
/// As for [`absorber`].
///
/// ```
/// use particle_damper::impact_damper::largest_clearance;
///
/// let largest = largest_clearance(0.02, 1e-3, 0.8)?;
/// assert!((largest - 0.33866).abs() < 1e-5);
/// # Ok::<(), particle_damper::ValueError>(())
/// ```
pub fn largest_clearance(
    mass_ratio: f64,
    damping_ratio: f64,
    restitution: f64,
) -> Result<f64, ValueError> {
    const STEPS: i32 = 2000;
    let at = |log: f64| -> Result<f64, ValueError> {
        let point = absorber(mass_ratio, damping_ratio, restitution, libm::exp(log))?;
        Ok(point.map_or(0.0, |point| point.clearance))
    };
    // The motion begins at rho/sqrt(1 + rho^2) of half the clearance.
    let rho = 2.0 * loss(restitution)? / PI;
    let begin = libm::log(rho / libm::hypot(1.0, rho) * (1.0 + 1e-12));
    let step = (libm::log(1e3) - begin) / f64::from(STEPS);
    let mut best = (0.0, begin);
    for n in 0..=STEPS {
        let log = begin + step * f64::from(n);
        let clearance = at(log)?;
        if clearance > best.0 {
            best = (clearance, log);
        }
    }
    // Golden section between the neighbours.
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut low, mut high) = ((best.1 - step).max(begin), best.1 + step);
    for _ in 0..60 {
        let width = golden * (high - low);
        if at(high - width)? > at(low + width)? {
            high = low + width;
        } else {
            low = high - width;
        }
    }
    Ok(best.0.max(at(f64::midpoint(low, high))?))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The condition of resonance, written out with complex numbers as it is published.
    #[test]
    fn points_of_the_backbone_fulfil_the_balance() {
        for (eps, damping, e, xi) in [
            (0.02, 1e-3, 0.8, 0.5),
            (0.1, 0.01, 0.3, 2.0),
            (0.05, 5e-3, 0.0, 1.0),
        ] {
            let point = absorber(eps, damping, e, xi).unwrap().unwrap();
            let r = point.frequency;
            let rho = 2.0 * (1.0 - e) / (1.0 + e) / PI;
            let theta =
                (1.0 + ((1.0 + rho * rho) * xi * xi - rho * rho).sqrt()) / (1.0 + rho * rho);
            let angle = ((theta - 1.0) / xi).acos();
            let ball = 8.0 * eps * theta * r * r / (PI * PI);
            let real = (1.0 - (1.0 - eps) * r * r) * xi - ball * angle.cos();
            let imaginary = 2.0 * damping * r * xi + ball * angle.sin();
            assert!(real.abs() < 1e-12, "{real}");
            assert!((2.0 * damping / imaginary / point.clearance - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn the_largest_clearance_is_not_exceeded_on_the_backbone() {
        for (eps, damping, e) in [
            (0.02, 1e-3, 0.8),
            (0.1, 0.02, 0.5),
            (0.01, 5e-3, 0.0),
            (0.02, 1e-3, 0.95),
        ] {
            let largest = largest_clearance(eps, damping, e).unwrap();
            let mut seen = 0.0_f64;
            for n in 1..20_000 {
                let xi = 1e-3 * f64::from(n);
                if let Some(point) = absorber(eps, damping, e, xi).unwrap() {
                    seen = seen.max(point.clearance);
                }
            }
            assert!(
                seen <= largest * (1.0 + 1e-9) && seen > 0.95 * largest,
                "{seen} {largest}"
            );
        }
        assert!(largest_clearance(0.0, 1e-3, 0.8).is_err());
        assert!(largest_clearance(0.02, 1e-3, 1.0).is_err());
        assert!(absorber(0.02, 1e-3, 0.8, 0.01).unwrap().is_none());
    }
}
