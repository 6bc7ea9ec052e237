use std::f64::consts::PI;

use super::loss;
use crate::equivalent::{Effect, Field};
use crate::error::{Bound, ValueError};

/// One ball between the walls of a heavy box that moves as A sin w t, without gravity and friction, with two
/// impacts per cycle.
///
/// With c = (1 - e)/(1 + e), D = d/A and R = sqrt(1 + (2 c/pi)^2) impacts are at the phase
/// phi = atan(2 c/pi) + acos(-c D/(pi R)), the ball flies at u A w with u = (D + 2 sin phi)/pi, the loss per
/// cycle is 4 c u^2 m A^2 w^2 and the apparent mass (4/pi) u sin phi m. The motion exists for
/// D < sqrt(pi^2/c^2 + 4), and is stable for D > (pi - 4/pi)/sqrt(c^2 + 4/pi^2). In a slow downward sweep the
/// ball falls off where it ends to exist. Masri & Caughey 1966,
/// doi 10.1115/1.3625084, with the mass of the box gone to infinity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OneBall {
    mass: f64,
    loss: f64,
    clearance: f64,
}

impl OneBall {
    /// A ball of `mass` (kg) and `restitution` that has `clearance` (m) to fly.
    ///
    /// # Errors
    /// If mass or clearance is not positive, or restitution is not in 0 to 1.
    pub fn new(mass: f64, restitution: f64, clearance: f64) -> Result<Self, ValueError> {
        Ok(Self {
            mass: Bound::Positive.check("mass of the ball (kg)", mass)?,
            loss: loss(restitution)?,
            clearance: Bound::Positive.check("clearance (m)", clearance)?,
        })
    }

    /// The clearance in m.
    #[must_use]
    pub const fn clearance(&self) -> f64 {
        self.clearance
    }
}

impl Field for OneBall {
    /// The amplitudes (m) at which the motion exists and is stable.
    fn amplitudes(&self, _angular_frequency: f64) -> [f64; 2] {
        let c = self.loss;
        let most = libm::hypot(PI / c, 2.0);
        let least = (PI - 4.0 / PI) / libm::hypot(c, 2.0 / PI);
        [self.clearance / most, self.clearance / least]
    }

    fn bed_mass(&self) -> f64 {
        self.mass
    }

    fn at(&self, amplitude: f64, angular_frequency: f64) -> Result<Effect, ValueError> {
        let w = Bound::Positive.check("angular frequency (rad/s)", angular_frequency)?;
        let [low, high] = self.amplitudes(w);
        let within =
            "amplitude (m) at which a ball hits both walls once a cycle, in a stable motion";
        let amplitude = Bound::Within(low, high).check(within, amplitude)?;
        let (c, relative) = (self.loss, self.clearance / amplitude);
        let phase_of_loss = 2.0 * c / PI;
        let cosine = -c * relative / (PI * libm::hypot(1.0, phase_of_loss));
        // Rounding may take it past the end at which the ball falls off.
        let phase = libm::atan(phase_of_loss) + libm::acos(cosine.max(-1.0));
        let sine = libm::sin(phase);
        let speed = (relative + 2.0 * sine) / PI;
        let force = 4.0 / PI * speed * self.mass * amplitude * w * w;
        Ok(Effect {
            apparent_mass: 4.0 / PI * speed * sine * self.mass,
            viscous_coefficient: 4.0 / PI * c * speed * speed * self.mass * w,
            // Blows to and fro have all odd harmonics alike.
            third_harmonic: Some(force),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loss_and_apparent_mass_are_the_published_ones() {
        let ball = OneBall::new(1.0, 0.5, 5.0).unwrap();
        let effect = ball.at(1.0, 1.0).unwrap();
        assert!((PI * effect.viscous_coefficient - 5.632_319).abs() < 1e-6);
        assert!((effect.apparent_mass - 1.906_270).abs() < 1e-6);
        // First and third harmonic of blows to and fro are alike.
        let first = libm::hypot(effect.apparent_mass, effect.viscous_coefficient);
        assert!((first - effect.third_harmonic.unwrap()).abs() < 1e-12);
    }

    #[test]
    fn amplitudes_at_which_there_is_no_such_motion_are_refused() {
        let ball = OneBall::new(1.0, 0.5, 5.0).unwrap();
        let [low, high] = ball.amplitudes(1.0);
        assert!((low - 5.0 / (9.0 * PI * PI + 4.0).sqrt()).abs() < 1e-12);
        for end in [low, high] {
            assert!(ball.at(end, 1.0).unwrap().viscous_coefficient.is_finite());
        }
        assert!(ball.at(0.99 * low, 1.0).is_err() && ball.at(1.01 * high, 1.0).is_err());
        // A ball that loses nothing has no lower end.
        let elastic = OneBall::new(1.0, 1.0, 5.0).unwrap();
        assert!(elastic.amplitudes(1.0)[0].abs() < 1e-15);
        assert!(elastic.at(0.1, 1.0).unwrap().viscous_coefficient.abs() < 1e-15);
    }
}
