//! The one error that every constructor shares: a number outside its range.

use std::fmt;

/// The range that a number has to lie in.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Bound {
    /// Any finite number.
    Finite,
    /// Finite and greater than zero.
    Positive,
    /// Finite and not below zero.
    NonNegative,
    /// From the first number to the second, both included.
    Within(f64, f64),
    /// Finite and greater than the number.
    Above(f64),
    /// Finite and less than the number.
    Below(f64),
    /// Finite and not greater than the number.
    AtMost(f64),
    /// Finite and not less than the number.
    AtLeast(f64),
}

impl Bound {
    /// Whether `value` lies in the range. NaN lies in none.
    #[must_use]
    pub fn admits(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Finite => true,
                Self::Positive => value > 0.0,
                Self::NonNegative => value >= 0.0,
                Self::Within(low, high) => (low..=high).contains(&value),
                Self::Above(low) => value > low,
                Self::Below(high) => value < high,
                Self::AtMost(high) => value <= high,
                Self::AtLeast(low) => value >= low,
            }
    }

    /// `value` if it lies in the range.
    ///
    /// # Errors
    /// A [`ValueError`] that holds `quantity`, `value` and the bound.
    ///
    /// ```
    /// use particle_damper::Bound;
    /// assert!(Bound::Positive.check("radius", 3e-3).is_ok());
    /// let refused = Bound::Within(0.0, 1.0).check("restitution", 1.2).unwrap_err();
    /// assert_eq!(refused.to_string(), "restitution must lie in [0, 1], not 1.2");
    /// ```
    pub fn check(self, quantity: &'static str, value: f64) -> Result<f64, ValueError> {
        if self.admits(value) {
            Ok(value)
        } else {
            Err(ValueError {
                quantity,
                value,
                bound: self,
            })
        }
    }
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finite => write!(f, "must be finite"),
            Self::Positive => write!(f, "must be positive and finite"),
            Self::NonNegative => write!(f, "must be finite and not negative"),
            Self::Within(low, high) => write!(f, "must lie in [{low}, {high}]"),
            Self::Above(low) => write!(f, "must be finite and above {low}"),
            Self::Below(high) => write!(f, "must be finite and below {high}"),
            Self::AtMost(high) => write!(f, "must be finite and at most {high}"),
            Self::AtLeast(low) => write!(f, "must be finite and at least {low}"),
        }
    }
}

/// A number outside its range: which quantity, its value and the bound it broke.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{quantity} {bound}, not {value}")]
#[non_exhaustive]
pub struct ValueError {
    /// The name of the quantity, with its unit where it has one.
    pub quantity: &'static str,
    /// The value that was refused.
    pub value: f64,
    /// The bound that the value broke.
    pub bound: Bound,
}
