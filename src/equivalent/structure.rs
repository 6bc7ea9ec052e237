use std::f64::consts::TAU;
use std::ops::{Add, Div, Mul};

use crate::error::{Bound, ValueError};
use crate::mount::SingleDof;

/// A complex number.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Complex {
    pub(super) re: f64,
    pub(super) im: f64,
}

impl Complex {
    pub(super) const fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    pub(super) fn abs(self) -> f64 {
        libm::hypot(self.re, self.im)
    }

    fn times(self, factor: f64) -> Self {
        Self::new(self.re * factor, self.im * factor)
    }
}

impl Add for Complex {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl Mul for Complex {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::new(
            self.re * other.re - self.im * other.im,
            self.re * other.im + self.im * other.re,
        )
    }
}

impl Div for Complex {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let conjugate = Self::new(other.re, -other.im);
        let square = other.re * other.re + other.im * other.im;
        (self * conjugate).times(1.0 / square)
    }
}

/// A mode of a structure without the damper's grains (the container's mass included).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    /// Modal mass in kg.
    pub mass: f64,
    /// Natural frequency in Hz.
    pub frequency: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Mode shape at the damper, along its motion.
    pub at_damper: f64,
    /// Mode shape where the force acts, along it.
    pub at_force: f64,
    /// Mode shape at the point that is watched.
    pub at_watch: f64,
}

impl Mode {
    /// Modal displacement over modal force at an angular frequency (rad/s), m/N.
    fn receptance(&self, w: f64) -> Complex {
        let natural = TAU * self.frequency;
        let stiffness = self.mass * (natural * natural - w * w);
        let damping = 2.0 * self.mass * self.damping_ratio * natural * w;
        Complex::new(1.0, 0.0) / Complex::new(stiffness, damping)
    }
}

/// A linear structure that carries a damper, by its modes.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalStructure {
    modes: Vec<Mode>,
}

impl ModalStructure {
    /// A mass on a spring: its force acts on the mass, and that is what is watched. A base that moves by Y
    /// sin w t is a force of Y (K^2 + (C w)^2)^(1/2).
    ///
    /// # Errors
    /// If the oscillator has no stiffness.
    pub fn oscillator<E>(oscillator: &SingleDof<E>) -> Result<Self, ValueError> {
        let (m, k, c) = (
            oscillator.mass(),
            oscillator.stiffness(),
            oscillator.damping(),
        );
        let stiffness = Bound::Positive.check("stiffness of the primary system (N/m)", k)?;
        let natural = (stiffness / m).sqrt();
        Self::modes([Mode {
            mass: m,
            frequency: natural / TAU,
            damping_ratio: c / (2.0 * m * natural),
            at_damper: 1.0,
            at_force: 1.0,
            at_watch: 1.0,
        }])
    }

    /// A set of modes.
    ///
    /// # Errors
    /// If there is none, or a mode's mass or frequency is not positive, its damping ratio is negative, or a
    /// number is not finite.
    pub fn modes(modes: impl IntoIterator<Item = Mode>) -> Result<Self, ValueError> {
        let modes: Vec<Mode> = modes.into_iter().collect();
        Bound::AtLeast(1.0).check("number of modes", modes.len() as f64)?;
        for mode in &modes {
            Bound::Positive.check("modal mass (kg)", mode.mass)?;
            Bound::Positive.check("natural frequency (Hz)", mode.frequency)?;
            Bound::NonNegative.check("damping ratio", mode.damping_ratio)?;
            for shape in [mode.at_damper, mode.at_force, mode.at_watch] {
                Bound::Finite.check("mode shape", shape)?;
            }
        }
        Ok(Self { modes })
    }

    /// Displacement at one point over force at another, whose mode shapes are given, m/N.
    fn receptance(&self, w: f64, shapes: impl Fn(&Mode) -> f64) -> Complex {
        let sum = |sum: Complex, mode: &Mode| sum + mode.receptance(w).times(shapes(mode));
        self.modes.iter().fold(Complex::default(), sum)
    }

    /// Of the damper to a force at the damper.
    pub(super) fn at_damper(&self, w: f64) -> Complex {
        self.receptance(w, |mode| mode.at_damper * mode.at_damper)
    }

    /// Of the damper to the driving force, which is that of the force's point to one at the damper.
    pub(super) fn to_damper(&self, w: f64) -> Complex {
        self.receptance(w, |mode| mode.at_damper * mode.at_force)
    }

    /// Of the point that is watched to the driving force.
    pub(super) fn to_watch(&self, w: f64) -> Complex {
        self.receptance(w, |mode| mode.at_watch * mode.at_force)
    }

    /// Of the point that is watched to a force at the damper.
    pub(super) fn damper_to_watch(&self, w: f64) -> Complex {
        self.receptance(w, |mode| mode.at_watch * mode.at_damper)
    }

    /// What the structure has of moving mass at the damper, in its liveliest mode, kg.
    pub(super) fn mass_at_damper(&self) -> f64 {
        let mass = |mode: &Mode| mode.mass / (mode.at_damper * mode.at_damper);
        self.modes.iter().map(mass).fold(f64::INFINITY, f64::min)
    }

    /// Angular frequencies in rad/s within which resonances of the structure with a mass on it are sought:
    /// from zero to the lowest natural frequency, or beyond it where the mass is negative.
    pub(super) fn lowest(&self) -> f64 {
        let frequency = |mode: &Mode| TAU * mode.frequency;
        self.modes
            .iter()
            .map(frequency)
            .fold(f64::INFINITY, f64::min)
    }
}
