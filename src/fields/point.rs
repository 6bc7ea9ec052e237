use std::f64::consts::TAU;
use std::fmt;

use super::BedState;
use crate::observer::ComplexPower;

/// One point of the fields: a run of its own, whatever other points there are.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Point {
    /// Amplitude A of the container's motion in m.
    pub amplitude: f64,
    /// Its frequency f in Hz.
    pub frequency: f64,
    /// Seed of the filling.
    pub seed: u64,
}

impl Point {
    /// Angular frequency w in rad/s.
    #[must_use]
    pub const fn angular_frequency(&self) -> f64 {
        TAU * self.frequency
    }
}

impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            amplitude,
            frequency,
            seed,
        } = self;
        write!(f, "{amplitude} m at {frequency} Hz, seed {seed}")
    }
}

/// What happened in one period of a point.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Cycle {
    /// From the first harmonic of the force on the particles.
    pub power: ComplexPower,
    /// What the contacts lost, J.
    pub contact_loss: f64,
    /// By how much the particles' energy grew, J: the rest of the energy of the cycle.
    pub gain: f64,
    /// Impacts on each wall.
    pub impacts: Vec<u64>,
    /// What the bed did.
    pub state: BedState,
}

/// What was measured at a point, period by period.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Measurement {
    /// Where it was measured.
    pub point: Point,
    /// Mass of the particles in kg.
    pub bed_mass: f64,
    /// Length of a step in s.
    pub time_step: f64,
    /// All periods but the first, in which the bed starts and which is never counted.
    pub cycles: Vec<Cycle>,
    /// How many of these count as the start.
    pub discarded: usize,
    /// Whether the start is over. If not, nothing says that intervals hold: run longer.
    pub settled: bool,
    /// The largest overlap of the whole run in m.
    pub max_overlap: f64,
}

impl Measurement {
    /// The periods that count.
    #[must_use]
    pub fn kept(&self) -> &[Cycle] {
        self.cycles.get(self.discarded..).unwrap_or_default()
    }
}
