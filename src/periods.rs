//! The periods of a harmonic motion that a point of a curve or field takes: how many, and of how many steps.

use crate::error::{Bound, ValueError};

/// Of the intervals that say how sure a mean over periods is.
pub(crate) const CONFIDENCE: f64 = 0.95;

/// Periods at the least that tell whether a point has settled.
const LEAST: f64 = 20.0;

/// How many periods a point takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Periods {
    Fixed { discarded: u32, averaged: u32 },
    Until { half_width: f64, most: u32 },
}

impl Default for Periods {
    fn default() -> Self {
        Self::Fixed {
            discarded: 20,
            averaged: 40,
        }
    }
}

impl Periods {
    /// The most that a point may take.
    pub(crate) const fn most(self) -> u64 {
        match self {
            Self::Fixed {
                discarded,
                averaged,
            } => discarded as u64 + averaged as u64,
            Self::Until { most, .. } => most as u64,
        }
    }

    /// Refuses numbers that are out of range.
    pub(crate) fn check(self) -> Result<(), ValueError> {
        match self {
            Self::Fixed { averaged, .. } => {
                Bound::AtLeast(1.0).check("periods averaged", f64::from(averaged))?;
            }
            Self::Until { half_width, most } => {
                Bound::Positive.check("half-width asked for", half_width)?;
                Bound::AtLeast(LEAST).check("periods at most", f64::from(most))?;
            }
        }
        Ok(())
    }
}

/// When it is looked whether a point may end: an interval that is looked at after every period is found narrow
/// by chance.
#[derive(Debug)]
pub(crate) struct Looks {
    next: u64,
}

impl Default for Looks {
    fn default() -> Self {
        Self { next: 40 }
    }
}

impl Looks {
    /// Whether it is time after the periods `done`; then the next look comes a quarter of them later.
    pub(crate) fn are_due(&mut self, done: u64) -> bool {
        let due = done >= self.next;
        if due {
            self.next = (done as f64 * 1.25) as u64;
        }
        due
    }
}

/// How many steps of at most `longest` (s), and `least` at the least, make up a period.
pub(crate) fn steps_per_period(
    frequency: f64,
    longest: f64,
    least: f64,
) -> Result<u64, ValueError> {
    // A hair of tolerance, so that a step that divides the period is taken as it is.
    let steps = (1.0 / (frequency * longest) * (1.0 - 1e-9)).ceil();
    // Beyond, steps could no longer be counted exactly.
    Bound::AtMost(1e12).check("steps per period", steps)?;
    Ok(steps.max(least) as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_divide_the_period_and_are_no_longer_than_asked() {
        let steps = |frequency, longest| steps_per_period(frequency, longest, 21.0);
        assert_eq!(steps(5.0, 1e-4).unwrap(), 2000);
        assert_eq!(steps(6.0, 1e-4).unwrap(), 1667);
        assert_eq!(steps(8.0, 2e-5).unwrap(), 6250);
        assert_eq!(steps(1.0, 10.0).unwrap(), 21);
        assert_eq!(steps_per_period(1.0, 10.0, 40.0).unwrap(), 40);
        assert!(steps(1.0, 1e-15).is_err());
    }
}
