use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

use super::check_confidence;
use crate::error::{Bound, ValueError};

/// From here on the expansion about the normal distribution is good to 1e-9.
const MANY: f64 = 200.0;

/// Student's t: what a value of t exceeds in size with the probability 1 - `confidence` only, at `degrees`
/// of freedom (a whole number; what is left over is dropped). 2.262 at 0.95 and 9.
///
/// The distribution is the finite sum of Abramowitz & Stegun 26.7.3 and 26.7.4, found back by bisection;
/// beyond 200 degrees the expansion 26.7.5.
///
/// # Errors
/// If the confidence is not between 0 and 1 (both excluded), or there is less than one degree of freedom.
pub fn student_t(confidence: f64, degrees: f64) -> Result<f64, ValueError> {
    check_confidence(confidence)?;
    let degrees = Bound::AtLeast(1.0)
        .check("degrees of freedom", degrees)?
        .floor();
    if degrees > MANY {
        return Ok(expansion(confidence, degrees));
    }
    let angle = bisect(FRAC_PI_2, |angle| {
        within(angle, degrees as u32) < confidence
    });
    Ok(degrees.sqrt() * libm::tan(angle))
}

/// Where in 0 to `high` a condition ends that holds from zero on.
fn bisect(mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let mut low = 0.0;
    // So many halves reach the last bit of a number between one and two.
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Probability that t is less than sqrt(`degrees`) tan(`angle`) in size.
fn within(angle: f64, degrees: u32) -> f64 {
    let (sine, cosine) = libm::sincos(angle);
    let odd = degrees % 2 == 1;
    let mut term = if odd { cosine } else { 1.0 };
    let mut sum = 0.0;
    // Terms in powers of the cosine up to `degrees` - 2.
    let mut power = u32::from(odd);
    while power + 2 <= degrees {
        sum += term;
        term *= f64::from(power + 1) / f64::from(power + 2) * cosine * cosine;
        power += 2;
    }
    if odd {
        (angle + sine * sum) * (2.0 / PI)
    } else {
        sine * sum
    }
}

/// Student's t by the expansion in the inverse of the `degrees`.
fn expansion(confidence: f64, degrees: f64) -> f64 {
    let x = bisect(40.0, |x| libm::erf(x / SQRT_2) < confidence);
    let y = x * x;
    let first = (y + 1.0) * x / 4.0;
    let second = ((5.0 * y + 16.0) * y + 3.0) * x / 96.0;
    let third = (((3.0 * y + 19.0) * y + 17.0) * y - 15.0) * x / 384.0;
    x + (first + (second + third / degrees) / degrees) / degrees
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abramowitz & Stegun, table 26.10, and the normal distribution.
    #[test]
    fn quantiles_are_those_of_the_tables() {
        for (confidence, degrees, expected, tolerance) in [
            (0.95, 1.0, 12.706, 5e-4),
            (0.95, 2.0, 4.303, 5e-4),
            (0.95, 3.0, 3.182, 5e-4),
            (0.95, 9.0, 2.262, 5e-4),
            (0.95, 30.0, 2.042, 5e-4),
            (0.95, 120.0, 1.980, 5e-4),
            (0.99, 4.0, 4.604, 5e-4),
            (0.8, 7.0, 1.415, 5e-4),
            (0.5, 5.9, 0.727, 5e-4),
            (0.95, 1e9, 1.959_964, 1e-6),
        ] {
            let t = student_t(confidence, degrees).unwrap();
            let off = (t - expected).abs();
            assert!(off < tolerance, "{confidence} {degrees}: {t}");
        }
    }

    #[test]
    fn sum_and_expansion_agree_where_they_meet() {
        for confidence in [0.5, 0.9, 0.95, 0.99] {
            let t = student_t(confidence, MANY).unwrap();
            assert!((t - expansion(confidence, MANY)).abs() < 1e-8);
        }
    }

    #[test]
    fn what_is_no_probability_is_refused() {
        for confidence in [0.0, 1.0, -0.1, f64::NAN] {
            assert!(student_t(confidence, 5.0).is_err());
        }
        assert!(student_t(0.95, 0.9).is_err());
    }
}
