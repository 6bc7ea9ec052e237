use super::exponent::Exponent;
use super::hertz::ElasticImpact;
use crate::error::{Bound, ValueError};

mod tsuji;
mod viscoelastic;

/// How the normal damping force grows with the overlap d; d' is the rate of overlap.
///
/// Each has one dimensionless *damping number* that alone decides the restitution coefficient e of
/// an impact. Both conventions use the effective mass m* of the two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Damping {
    /// F = k d^(3/2) + c d^(1/2) d', the paper's Eq. (4). The restitution coefficient falls slowly
    /// with the impact speed v through the damping number beta = c m*^(-2/5) k^(-3/5) v^(1/5), so
    /// that e is met exactly at a reference speed alone. Kuwabara & Kono 1987,
    /// doi 10.1143/JJAP.26.1230; Mueller & Poeschel 2011, doi 10.1103/PhysRevE.84.021302.
    #[default]
    Viscoelastic,
    /// F = k d^(3/2) + c d^(1/4) d' with the damping number alpha = c/sqrt(m* k): the restitution
    /// coefficient is the same at all speeds. Tsuji et al. 1992, doi 10.1016/0032-5910(92)88030-L;
    /// closed form of Antypov & Elliott 2011, doi 10.1209/0295-5075/94/50004. The polynomial
    /// alpha(e) that is often printed goes with m = 2 m* and misses e by a factor sqrt 2 in alpha.
    Tsuji,
}

/// Where a contact ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ending {
    /// When damping would turn the force into a pull: the normal force is cut off at zero.
    #[default]
    NeverPulling,
    /// When the overlap is back at zero: towards the end of an impact the bodies pull each other.
    PullingAllowed,
}

impl Damping {
    /// The least restitution coefficient that a damping number is given for. Zero would take
    /// infinite damping.
    pub const LEAST_RESTITUTION: f64 = 1e-3;

    /// Restitution coefficient of an impact with a damping number: of beta by integration to twelve
    /// digits, of alpha in closed form.
    ///
    /// # Errors
    /// If `number` is not in 0 to 100.
    pub fn restitution(self, number: f64, ending: Ending) -> Result<f64, ValueError> {
        let number = Bound::Within(0.0, 100.0).check("damping number", number)?;
        Ok(match self {
            Self::Viscoelastic => viscoelastic::restitution(number, ending),
            Self::Tsuji => tsuji::restitution(number, ending),
        })
    }

    /// The damping number that gives a restitution coefficient.
    ///
    /// # Errors
    /// If `restitution` is not in [`LEAST_RESTITUTION`](Self::LEAST_RESTITUTION) to 1.
    ///
    /// ```
    /// use particle_damper::{Damping, Ending};
    ///
    /// # fn main() -> Result<(), particle_damper::ValueError> {
    /// let beta = Damping::Viscoelastic.number(0.5, Ending::NeverPulling)?;
    /// assert!((beta - 0.698041).abs() < 1e-6);
    /// # Ok(())
    /// # }
    /// ```
    pub fn number(self, restitution: f64, ending: Ending) -> Result<f64, ValueError> {
        let restitution = Bound::Within(Self::LEAST_RESTITUTION, 1.0).check(
            "restitution under a strict contact law (RestitutionImpulse takes any)",
            restitution,
        )?;
        Ok(match self {
            Self::Viscoelastic => viscoelastic::number(restitution, ending),
            Self::Tsuji => tsuji::number(restitution, ending),
        })
    }

    /// The damping coefficient c that a damping number means for an impact, in N s/m^(3/2)
    /// (viscoelastic) or N s/m^(5/4) (Tsuji).
    #[must_use]
    pub fn coefficient(self, number: f64, impact: &ElasticImpact) -> f64 {
        let (k, m, v) = (impact.stiffness(), impact.effective_mass(), impact.speed());
        match self {
            Self::Viscoelastic => number * libm::pow(m * m * k * k * k / v, 0.2),
            Self::Tsuji => number * (m * k).sqrt(),
        }
    }

    /// The damping number of the same bodies at `ratio` times the impact speed: restitution at other speeds
    /// follows from it.
    #[must_use]
    pub fn at_speed(self, number: f64, ratio: f64) -> f64 {
        match self {
            Self::Viscoelastic => number * libm::pow(ratio, 0.2),
            Self::Tsuji => number,
        }
    }

    /// What a damping coefficient is multiplied by where the effective mass is `part` of what it was, so
    /// that the damping number stays.
    #[inline]
    pub(super) fn of_mass(self, part: f64) -> f64 {
        match self {
            Self::Viscoelastic => fifth_root(part * part),
            Self::Tsuji => part.sqrt(),
        }
    }

    /// The overlap (m) at which spring and dashpot balance between bodies that part, where `ratio` is the damping
    /// coefficient times the speed over the stiffness of the spring.
    #[inline]
    pub(super) fn balance(self, ratio: f64) -> f64 {
        match self {
            Self::Viscoelastic => ratio,
            Self::Tsuji => fifth_root(ratio * ratio * ratio * ratio),
        }
    }

    /// Exponent of the overlap that the force grows with.
    pub(super) const fn exponent(self) -> Exponent {
        match self {
            Self::Viscoelastic => Exponent::Half,
            Self::Tsuji => Exponent::Quarter,
        }
    }

    /// The greatest damping rate (damping force over m* d', 1/s) in an impact, from above: damping
    /// alone stops the bodies no later than elasticity alone does.
    pub(super) fn greatest_rate(self, coefficient: f64, impact: &ElasticImpact) -> f64 {
        let stops_at = 1.0 / (coefficient / (impact.effective_mass() * impact.speed()));
        let depth = match self {
            Self::Viscoelastic => libm::cbrt(1.5 * stops_at).min(impact.overlap().sqrt()),
            Self::Tsuji => libm::pow(1.25 * stops_at, 0.2).min(impact.overlap().sqrt().sqrt()),
        };
        coefficient * depth / impact.effective_mass()
    }
}

/// The fifth root of a positive number, to two units in the last place: by Halley's method, which takes a
/// third of the work of a power. It is asked for at every evaluation of a contact with a wall that yields.
#[inline(always)]
fn fifth_root(number: f64) -> f64 {
    /// Four fifths of the bits of 1, less what makes the first guess right on the mean: to 4 %.
    const SHIFT: u64 = 0x3325_E000_0000_0000;
    let mut root = f64::from_bits(number.to_bits() / 5 + SHIFT);
    for _ in 0..3 {
        let square = root * root;
        let power = square * square * root;
        root += root * ((number - power) / (3.0 * power + 2.0 * number));
    }
    root
}

/// Where a function that falls without end from a positive value at zero is zero: regula falsi in
/// the Illinois form.
fn root(value: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    let (mut at_low, mut at_high) = (value(low), value(high));
    while at_high > 0.0 {
        (low, at_low) = (high, at_high);
        high *= 4.0;
        at_high = value(high);
    }
    let mut middle = low;
    let mut rose = None;
    for _ in 0..100 {
        middle = low + (high - low) * (at_low / (at_low - at_high));
        let at_middle = value(middle);
        if at_middle.abs() < 1e-14 || high - low < 1e-15 * high {
            break;
        }
        let rises = at_middle > 0.0;
        if rises {
            (low, at_low) = (middle, at_middle);
        } else {
            (high, at_high) = (middle, at_middle);
        }
        // An end that stays twice would stay for ever: it counts half.
        if rose == Some(rises) {
            *(if rises { &mut at_high } else { &mut at_low }) *= 0.5;
        }
        rose = Some(rises);
    }
    middle
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn every_restitution_has_its_number_and_the_number_gives_it_back() {
        for damping in [Damping::Viscoelastic, Damping::Tsuji] {
            for ending in [Ending::NeverPulling, Ending::PullingAllowed] {
                for e in [1e-3, 0.01, 0.1, 0.3, 0.5, 0.75, 0.9, 0.99, 0.999_999, 1.0] {
                    let number = damping.number(e, ending).unwrap();
                    let back = damping.restitution(number, ending).unwrap();
                    assert_relative_eq!(back, e, max_relative = 1e-11);
                }
                assert!(damping.number(1.0, ending).unwrap().abs() < 1e-15);
            }
        }
    }

    #[test]
    fn the_fifth_root_is_that_of_the_power() {
        for n in 0..2000 {
            let number = libm::exp(-0.02 * f64::from(n));
            let root = fifth_root(number);
            assert_relative_eq!(root, libm::pow(number, 0.2), max_relative = 5e-16);
        }
    }

    #[test]
    fn restitution_zero_is_refused_with_the_bound() {
        let refused = Damping::Tsuji
            .number(0.0, Ending::NeverPulling)
            .unwrap_err();
        assert_eq!(
            refused.to_string(),
            "restitution under a strict contact law (RestitutionImpulse takes any) must lie in [0.001, 1], not 0"
        );
        assert!(
            Damping::Viscoelastic
                .restitution(-0.1, Ending::NeverPulling)
                .is_err()
        );
    }

    /// The paper's Table 1: spheres of 3 mm and 0.2 g, e 0.75 at 1 m/s.
    #[test]
    fn coefficients_of_table_1() {
        let beta = Damping::Viscoelastic
            .number(0.75, Ending::NeverPulling)
            .unwrap();
        let wall = ElasticImpact::new(1.605_048e7, 2e-4, 1.0).unwrap();
        let pair = ElasticImpact::new(1.134_940e7, 1e-4, 1.0).unwrap();
        let at = |impact| Damping::Viscoelastic.coefficient(beta, &impact);
        assert_relative_eq!(at(wall), 183.41, max_relative = 3e-5);
        assert_relative_eq!(at(pair), 112.9, max_relative = 5e-4);
    }

    #[test]
    fn restitution_falls_with_speed_under_viscoelastic_damping() {
        let beta = Damping::Viscoelastic
            .number(0.75, Ending::NeverPulling)
            .unwrap();
        let at = |speed: f64| {
            Damping::Viscoelastic
                .restitution(
                    Damping::Viscoelastic.at_speed(beta, speed),
                    Ending::NeverPulling,
                )
                .unwrap()
        };
        assert_relative_eq!(at(0.1), 0.83077, max_relative = 1e-5);
        assert_relative_eq!(at(3.0), 0.70242, max_relative = 1e-5);
    }
}
