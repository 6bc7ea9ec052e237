//! Closed forms for impact dampers: rules of thumb for the clearance, and exact motions to hold a design
//! against.
//!
//! A clearance d is the whole free travel: room less what the bed, or the ball, takes of it. The box moves
//! by x = A sin w t.
//!
//! | what | rule |
//! |---|---|
//! | a ball in a heavy box takes out most at | [d = pi A (1 + e)/(1 - e)](ball_clearance) |
//! | a bed that does not rebound, at | [d = pi A](bed_clearance) |
//! | a bed is thrown as one body above, and scattered like a gas below | [A = d/pi](collecting_amplitude) |
//! | an absorber on a lightly damped oscillator must not have more than | [`largest_clearance`] |
//!
//! The first two are for boxes that do not feel the damper; on a structure that does, A is what is left with
//! the damper at work, not what there was without. [`OneBall`] has what such a ball does at any amplitude, and
//! is a field for an [`EquivalentDamper`](crate::equivalent::EquivalentDamper).
//!
//! ```
//! use particle_damper::impact_damper::{ball_clearance, bed_clearance};
//!
//! // What is wanted to stay of a vibration: 2 mm. Balls of restitution 0.75, or a bed of many.
//! assert!((ball_clearance(2e-3, 0.75)? - 43.98e-3).abs() < 1e-5);
//! assert!((bed_clearance(2e-3)? - 6.28e-3).abs() < 1e-5);
//! # Ok::<(), particle_damper::ValueError>(())
//! ```

mod absorber;
mod one_ball;

pub use absorber::{AbsorberPoint, absorber, largest_clearance};
pub use one_ball::OneBall;

use std::f64::consts::PI;

use crate::error::{Bound, ValueError};

/// The clearance (m) at which one ball of `restitution` e takes most out of a heavy box of amplitude
/// `amplitude` (m): d = pi A (1 + e)/(1 - e), where it hits the walls at their greatest speed. The loss per
/// cycle is then 4 (1 + e)/(1 - e) m A^2 w^2. Without gravity and friction.
///
/// The best is next to nothing: the ball falls off if A is less by the part (2/pi^2) ((1 - e)/(1 + e))^2,
/// 0.4 % at e 0.75, and then takes out far less. Less clearance is safer than more.
///
/// # Errors
/// If the amplitude is not positive, or the restitution is not in 0 to 1 (excluded).
pub fn ball_clearance(amplitude: f64, restitution: f64) -> Result<f64, ValueError> {
    let c = loss(restitution)?;
    Bound::Below(1.0).check("restitution", restitution)?;
    Ok(bed_clearance(amplitude)? / c)
}

/// The clearance (m) at which a bed that does not rebound takes most out of a heavy box of amplitude
/// `amplitude` (m): d = pi A, with a loss of 4 m A^2 w^2 per cycle. Beds of many grains collect at the walls
/// so, whatever the restitution of a grain. Without gravity; Bannerman et al. 2011,
/// doi 10.1103/PhysRevE.84.011301.
///
/// # Errors
/// If the amplitude is not positive.
pub fn bed_clearance(amplitude: f64) -> Result<f64, ValueError> {
    Ok(PI * Bound::Positive.check("amplitude (m)", amplitude)?)
}

/// The amplitude (m) above which a bed with `clearance` (m) collects at the walls and is thrown as one body,
/// A = d/pi. Below it is scattered like a gas, and takes out far less.
///
/// # Errors
/// If the clearance is not positive.
pub fn collecting_amplitude(clearance: f64) -> Result<f64, ValueError> {
    Ok(Bound::Positive.check("clearance (m)", clearance)? / PI)
}

/// (1 - e)/(1 + e).
fn loss(restitution: f64) -> Result<f64, ValueError> {
    let e = Bound::Within(0.0, 1.0).check("restitution", restitution)?;
    Ok((1.0 - e) / (1.0 + e))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equivalent::Field;

    /// The rule is where the closed form has its largest loss.
    #[test]
    fn the_best_clearance_for_a_ball_is_where_its_loss_is_largest() {
        for e in [0.0, 0.3, 0.6, 0.9] {
            let best = ball_clearance(1e-3, e).unwrap();
            let loss = |clearance: f64| {
                let ball = OneBall::new(1e-2, e, clearance).unwrap();
                ball.at(1e-3, 100.0).unwrap().viscous_coefficient
            };
            assert!(loss(best) > loss(0.999 * best) && loss(best) > loss(1.0002 * best));
            let ball = OneBall::new(1e-2, e, best).unwrap();
            assert!(ball.at(1e-3, 100.0).unwrap().apparent_mass.abs() < 1e-12);
        }
        assert!((ball_clearance(1e-3, 0.0).unwrap() - bed_clearance(1e-3).unwrap()).abs() < 1e-18);
    }

    #[test]
    fn what_has_no_clearance_is_refused() {
        assert!(ball_clearance(1e-3, 1.0).is_err() && ball_clearance(1e-3, -0.1).is_err());
        assert!(bed_clearance(0.0).is_err() && collecting_amplitude(f64::NAN).is_err());
        assert!((collecting_amplitude(PI).unwrap() - 1.0).abs() < 1e-15);
    }
}
