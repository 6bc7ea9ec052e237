use std::f64::consts::TAU;

use glam::DVec3;

/// The component of a vector at one angular frequency w: Re (re + i im) e^(iwt).
///
/// ```
/// use particle_damper::Phasor;
/// use particle_damper::glam::DVec3;
///
/// let sine = Phasor::new(DVec3::ZERO, DVec3::NEG_Y); // sin wt along y
/// assert_eq!(sine.derivative(2.0), Phasor::new(DVec3::Y * 2.0, DVec3::ZERO)); // 2 cos wt
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Phasor {
    /// Amplitude of cos wt.
    pub re: DVec3,
    /// Amplitude of -sin wt.
    pub im: DVec3,
}

impl Phasor {
    /// The component re cos wt - im sin wt.
    #[must_use]
    pub const fn new(re: DVec3, im: DVec3) -> Self {
        Self { re, im }
    }

    /// The rate of change at the angular frequency w (rad/s): i w times the component.
    #[must_use]
    pub fn derivative(self, angular_frequency: f64) -> Self {
        Self::new(-angular_frequency * self.im, angular_frequency * self.re)
    }

    /// The square of the amplitude: the sum of those of both parts.
    #[must_use]
    pub fn norm_squared(&self) -> f64 {
        self.re.length_squared() + self.im.length_squared()
    }

    /// Takes up a value at the angle wt (rad), by a weight.
    pub(super) fn add(&mut self, value: DVec3, angle: f64) {
        let (sine, cosine) = libm::sincos(angle);
        self.re += value * cosine;
        self.im -= value * sine;
    }

    pub(super) fn scaled(self, by: f64) -> Self {
        Self::new(self.re * by, self.im * by)
    }
}

/// The complex power P = F V*/2 that a container gives what is in it, and what follows from it for a
/// designer.
///
/// V is the first harmonic of the container's velocity, F that of the force of the host on the damper's
/// particles: the opposite of the particles' force on the container. The weight of the empty container
/// is not in it, so all masses here are the bed's.
///
/// | quantity | from P | a rigid mass m | a dashpot c to a fixed floor |
/// |---|---|---|---|
/// | [energy per cycle](Self::energy_per_cycle) | (2 pi/w) Re P | 0 | pi c w X^2 |
/// | [apparent mass](Self::apparent_mass) | 2 Im P/(w V^2) | m | 0 |
/// | [viscous coefficient](Self::viscous_coefficient) | 2 Re P/V^2 | 0 | c |
/// | [loss factor](Self::loss_factor) | Re P/Im P | 0 | none |
///
/// # Signs
/// Re P is positive where the particles take energy from the host. The apparent mass is positive where
/// they push against the container's acceleration, as a mass does. It passes zero where the bed is
/// struck in phase with the velocity (one ball in a box of clear travel d: at A = d (1 - e)/(pi (1 + e)),
/// where the loss over m A^2 w^2 is largest), and is negative in smaller motion, where the bed pushes like a spring.
/// There the ratio of loss to mass means nothing, though the loss itself is at its best: compare energies
/// or viscous coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ComplexPower {
    /// Angular frequency w in rad/s.
    pub angular_frequency: f64,
    /// Amplitude |V| of the container's velocity in m/s.
    pub speed: f64,
    /// Re P in W, the mean power that the particles take.
    pub active: f64,
    /// Im P in W.
    pub reactive: f64,
}

impl ComplexPower {
    /// The power of the first harmonics of `force` (N, of the host on the damper) and of the container's
    /// `velocity` (m/s) at the angular frequency w (rad/s).
    ///
    /// ```
    /// use particle_damper::glam::DVec3;
    /// use particle_damper::{ComplexPower, Phasor};
    ///
    /// // x = A sin wt moves a mass of 0.3 kg.
    /// let (a, w) = (2e-3, 50.0);
    /// let velocity = Phasor::new(DVec3::ZERO, DVec3::NEG_X * a).derivative(w);
    /// let acceleration = velocity.derivative(w);
    /// let force = Phasor::new(0.3 * acceleration.re, 0.3 * acceleration.im);
    /// let power = ComplexPower::new(force, velocity, w);
    /// assert!((power.apparent_mass() - 0.3).abs() < 1e-15);
    /// assert_eq!(power.energy_per_cycle(), 0.0);
    /// ```
    #[must_use]
    pub fn new(force: Phasor, velocity: Phasor, angular_frequency: f64) -> Self {
        Self {
            angular_frequency,
            speed: velocity.norm_squared().sqrt(),
            active: 0.5 * (force.re.dot(velocity.re) + force.im.dot(velocity.im)),
            reactive: 0.5 * (force.im.dot(velocity.re) - force.re.dot(velocity.im)),
        }
    }

    /// Energy that the particles take in a cycle, in J: E = (2 pi/w) Re P.
    #[must_use]
    pub fn energy_per_cycle(&self) -> f64 {
        TAU / self.angular_frequency * self.active
    }

    /// Mass in kg that resists the container's acceleration as the particles do: 2 Im P/(w |V|^2); zero
    /// without motion.
    #[must_use]
    pub fn apparent_mass(&self) -> f64 {
        self.per_square(2.0 * self.reactive / self.angular_frequency)
    }

    /// Coefficient c (N s/m) of a dashpot between the container and a fixed floor that takes as much:
    /// 2 Re P/|V|^2; zero without motion.
    #[must_use]
    pub fn viscous_coefficient(&self) -> f64 {
        self.per_square(2.0 * self.active)
    }

    /// Loss factor eta = Re P/Im P. None where the apparent mass is zero or negative: the ratio diverges
    /// there and changes its sign, and says nothing of the damping.
    #[must_use]
    pub fn loss_factor(&self) -> Option<f64> {
        (self.reactive > 0.0).then(|| self.active / self.reactive)
    }

    /// Energy per cycle over the kinetic energy m |V|^2/2 that a bed of `mass` m (kg) has when it moves
    /// along; zero without motion. At most 8 for a mass that does not rebound and travels from wall to
    /// wall.
    #[must_use]
    pub fn normalised_loss(&self, mass: f64) -> f64 {
        self.per_square(2.0 * self.energy_per_cycle() / mass)
    }

    /// What the damper adds to the damping ratio of an oscillator of `mass` M (kg) and the natural angular
    /// frequency w_n (rad/s): c/(2 M w_n). It holds while the damper is light against the oscillator.
    #[must_use]
    pub fn added_damping_ratio(&self, mass: f64, natural_angular_frequency: f64) -> f64 {
        self.viscous_coefficient() / (2.0 * mass * natural_angular_frequency)
    }

    fn per_square(&self, numerator: f64) -> f64 {
        let square = self.speed * self.speed;
        if square > 0.0 {
            numerator / square
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use glam::dvec3;

    /// The power of forces sampled over whole periods, x = A sin(wt + phase) along `axis`.
    fn sampled(
        w: f64,
        phase: f64,
        axis: DVec3,
        force: impl Fn(f64, f64, f64) -> f64,
    ) -> ComplexPower {
        let (amplitude, samples) = (3e-3, 4000);
        let [mut f, mut v] = [Phasor::default(); 2];
        for n in 0..samples {
            let t = 3.0 * TAU / w * (f64::from(n) + 0.5) / f64::from(samples);
            let (sine, cosine) = (w * t + phase).sin_cos();
            let [x, rate, acceleration] =
                [sine, w * cosine, -w * w * sine].map(|of| amplitude * of);
            f.add(axis * force(x, rate, acceleration), w * t);
            v.add(axis * rate, w * t);
        }
        let scale = 2.0 / f64::from(samples);
        ComplexPower::new(f.scaled(scale), v.scaled(scale), w)
    }

    #[test]
    fn a_rigid_mass_a_dashpot_and_a_spring_are_what_they_are() {
        let axis = dvec3(0.6, 0.0, 0.8);
        for (w, phase) in [(3.0, 0.0), (40.0, 1.2), (700.0, -2.5)] {
            let mass = sampled(w, phase, axis, |_, _, a| 0.7 * a);
            assert_relative_eq!(mass.apparent_mass(), 0.7, max_relative = 1e-12);
            assert!(mass.viscous_coefficient().abs() < 1e-12 * w);
            let dashpot = sampled(w, phase, axis, |_, v, _| 0.2 * v);
            assert_relative_eq!(dashpot.viscous_coefficient(), 0.2, max_relative = 1e-12);
            assert!(dashpot.apparent_mass().abs() < 1e-12);
            let energy = TAU / 2.0 * 0.2 * w * 3e-3 * 3e-3;
            assert_relative_eq!(dashpot.energy_per_cycle(), energy, max_relative = 1e-12);
            let spring = sampled(w, phase, axis, |x, _, _| 5.0 * x);
            assert_relative_eq!(spring.apparent_mass(), -5.0 / (w * w), max_relative = 1e-9);
            assert_eq!(spring.loss_factor(), None);
            // The mean of a force is no part of it.
            let pushed = sampled(w, phase, axis, |_, v, _| 9.0 + 0.2 * v);
            assert_relative_eq!(pushed.viscous_coefficient(), 0.2, max_relative = 1e-10);
        }
    }

    /// m_a + c/(iw) = m (k + iwc)/(k - m w^2 + iwc), below and above the resonance.
    #[test]
    fn a_mass_on_a_spring_inside_is_the_dynamic_vibration_absorber() {
        let (m, k, c) = (0.05, 200.0, 0.3);
        for w in [10.0, 50.0, 63.0, 64.0, 90.0, 400.0] {
            let (below, size) = ([k, w * c], [k - m * w * w, w * c]);
            let square = size[0] * size[0] + size[1] * size[1];
            let expected = [
                m * (below[0] * size[0] + below[1] * size[1]) / square,
                m * (below[1] * size[0] - below[0] * size[1]) / square,
            ];
            // Force on the host's side: i w times the transfer times the velocity.
            let velocity = Phasor::new(DVec3::X * 0.4, DVec3::X * -0.2);
            let momentum = Phasor::new(
                velocity.re * expected[0] - velocity.im * expected[1],
                velocity.im * expected[0] + velocity.re * expected[1],
            );
            let power = ComplexPower::new(momentum.derivative(w), velocity, w);
            assert_relative_eq!(power.apparent_mass(), expected[0], max_relative = 1e-12);
            assert_relative_eq!(
                power.viscous_coefficient(),
                -w * expected[1],
                max_relative = 1e-12
            );
            assert!(power.active > 0.0);
        }
    }

    #[test]
    fn no_motion_divides_by_nothing() {
        let power = ComplexPower::new(Phasor::default(), Phasor::default(), 10.0);
        let numbers = [power.apparent_mass(), power.viscous_coefficient()];
        assert!(numbers.iter().all(|number| number.to_bits() == 0));
        assert_eq!(power.normalised_loss(0.1).to_bits(), 0);
        assert_eq!(power.loss_factor(), None);
    }
}
