//! Restitution and damping from a drop test: a ball bounces on a plate, and a microphone or a camera tells
//! when, or how high.
//!
//! Between two impacts a ball flies for T = 2 v/g, with v the speed that the first has left it: so the times
//! of the bounces tell restitution, and heights do so besides. A [`DropTest`] says what is known of the
//! experiment and which damping is fitted; [`times`](DropTest::times) and [`heights`](DropTest::heights) fit
//! it, all bounces at once, by least squares. A [`DropFit`] gives restitution, the damping number and the
//! damping coefficient of a strict law, with intervals, and what the fit leaves.
//!
//! ```
//! use particle_damper::drop_test::DropTest;
//! use particle_damper::{Bodies, Body, Damping, HertzTsuji, Material, Materials};
//!
//! // Seconds at which a ball was heard.
//! let heard = [0.101, 0.2527, 0.3663, 0.4512, 0.5156, 0.5632];
//! let fit = DropTest::new().times(&heard)?;
//! assert!((fit.restitution.value - 0.75).abs() < 0.01);
//! assert!(fit.restitution.low < 0.75 && fit.restitution.high > 0.75);
//!
//! // The c_p of the paper's Eq. (4): k and the effective mass are the law's.
//! let fit = DropTest::new().damping(Damping::Viscoelastic).times(&heard)?;
//! let ball = Body::sphere(3e-3, 2e-4, Materials::FIRST);
//! let plate = Bodies::new(ball, Body::wall(Materials::FIRST));
//! let impact = HertzTsuji::new(Material::acrylic()).elastic_impact(&plate, 1.0)?;
//! let c = fit.damping_coefficient(&impact);
//! assert!(c.low < c.value && c.value < c.high);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What it takes, and what it does not see
//! - **Gravity** does not enter where restitution is constant and there is no drag: ratios of flights alone
//!   count. Under viscoelastic damping it sets the speeds, v = g T/2: an error of 10 % in g changes a damping
//!   number by 2 %.
//! - **Drag** makes restitution come out too low, by the part (1 + e^2)/4 (v/v_t)^2 at an impact speed v,
//!   where v_t is the speed at which drag balances the weight: 2 % for a table-tennis ball (9 m/s) at 2 m/s,
//!   4e-4 for an acrylic ball of 6 mm (13 m/s) at 0.5 m/s with e 0.75. [`DropTest::terminal_speed`] takes it
//!   into account, as drag that grows with the square of the speed.
//! - **Contacts last**: a microphone hears impacts begin, so that an interval is a flight and a contact.
//!   [`DropTest::contact_duration`] takes it off ([`ElasticImpact::duration`](crate::ElasticImpact::duration)
//!   says how long).
//! - **Errors of times** are taken for independent and equally large. The last bounces then tell little, and
//!   do no harm; but a bounce that was missed, or counted twice, does. It shows in the residuals.
//! - **Spin and tilt**: a ball that leaves the vertical keeps energy that the times do not show.

mod bounces;
mod fit;
mod heights;
mod least_squares;
mod times;
mod trace;

pub use fit::{DropFit, Fitted, HeightFit, Impact, Peak};

use crate::error::{Bound, ValueError};
use crate::law::{Damping, Ending};
use bounces::Bounces;

/// What is known of a drop test, and what is fitted to it.
///
/// Unless set otherwise: g 9.81 m/s^2, no drag, contacts that take no time, restitution that is the same at
/// all speeds ([`Damping::Tsuji`]), contacts that [never pull](Ending::NeverPulling), 1 m/s as reference
/// speed, intervals that hold the true value in 95 of 100 tests.
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use]
pub struct DropTest {
    bounces: Bounces,
    contact_duration: f64,
    confidence: f64,
}

/// Why a drop test tells nothing.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DropTestError {
    /// A number outside its range.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// Too few bounces, or in a height trace too few whole flights with samples enough that stand out of the
    /// noise.
    #[error("{found} {what}, but the fit takes {least}")]
    TooFew {
        /// What there is too few of.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many it takes.
        least: usize,
    },
    /// Times that do not rise.
    #[error("time {index} is {time} s, not after the {before} s before it")]
    NotRising {
        /// Which time, from zero.
        index: usize,
        /// The time in s.
        time: f64,
        /// The time before it in s.
        before: f64,
    },
    /// Not as many heights as times.
    #[error("{times} times, but {heights} heights")]
    Lengths {
        /// How many times there are.
        times: usize,
        /// How many heights there are.
        heights: usize,
    },
    /// No ball that bounces as the model has it comes near these numbers.
    #[error("no bouncing ball fits the data; a bounce missed or counted twice does this")]
    NoFit,
}

impl Default for DropTest {
    fn default() -> Self {
        Self {
            bounces: Bounces {
                gravity: 9.81,
                terminal: f64::INFINITY,
                damping: Damping::Tsuji,
                ending: Ending::NeverPulling,
                reference: 1.0,
            },
            contact_duration: 0.0,
            confidence: 0.95,
        }
    }
}

impl DropTest {
    /// A drop test at 9.81 m/s^2 without drag.
    pub fn new() -> Self {
        Self::default()
    }

    /// The same under `gravity` (m/s^2).
    ///
    /// # Errors
    /// If it is not positive and finite.
    pub fn gravity(mut self, gravity: f64) -> Result<Self, ValueError> {
        self.bounces.gravity = Bound::Positive.check("gravity (m/s^2)", gravity)?;
        Ok(self)
    }

    /// The same with drag that grows as the square of the speed and balances the weight at `speed` (m/s).
    ///
    /// # Errors
    /// If it is not positive and finite.
    pub fn terminal_speed(mut self, speed: f64) -> Result<Self, ValueError> {
        self.bounces.terminal = Bound::Positive.check("terminal speed (m/s)", speed)?;
        Ok(self)
    }

    /// The same with contacts that last for `duration` (s). It counts for [`times`](Self::times) and
    /// [`heights`](Self::heights) alike.
    ///
    /// # Errors
    /// If it is negative or not finite.
    pub fn contact_duration(mut self, duration: f64) -> Result<Self, ValueError> {
        self.contact_duration = Bound::NonNegative.check("contact duration (s)", duration)?;
        Ok(self)
    }

    /// The same with a form of damping: it says how restitution depends on the speed.
    pub const fn damping(mut self, damping: Damping) -> Self {
        self.bounces.damping = damping;
        self
    }

    /// The same with another end of contacts, for what a damping number means.
    pub const fn ending(mut self, ending: Ending) -> Self {
        self.bounces.ending = ending;
        self
    }

    /// The same with another speed (m/s) that restitution and damping number are given for.
    ///
    /// # Errors
    /// If it is not positive and finite.
    pub fn reference_speed(mut self, speed: f64) -> Result<Self, ValueError> {
        self.bounces.reference = Bound::Positive.check("reference impact speed (m/s)", speed)?;
        Ok(self)
    }

    /// The same with another confidence of intervals.
    ///
    /// # Errors
    /// If it is not between 0 and 1.
    pub fn confidence(mut self, confidence: f64) -> Result<Self, ValueError> {
        Bound::Above(0.0).check("confidence", confidence)?;
        self.confidence = Bound::Below(1.0).check("confidence", confidence)?;
        Ok(self)
    }
}

/// Refuses times that are not finite or do not rise.
fn check_times(times: &[f64]) -> Result<(), DropTestError> {
    for (n, &time) in times.iter().enumerate() {
        Bound::Finite.check("time (s)", time)?;
        let before = n.checked_sub(1).map_or(f64::NEG_INFINITY, |n| times[n]);
        if time <= before {
            return Err(DropTestError::NotRising {
                index: n,
                time,
                before,
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
