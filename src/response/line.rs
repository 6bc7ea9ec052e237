use std::fmt;

use super::Point;

/// What a sweep goes through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Swept {
    /// The amplitude of the drive.
    Amplitude,
    /// The frequency of the drive.
    Frequency,
}

/// One line of a sweep, up and down: a unit of work by itself, as its points hang together.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Line {
    /// Number of particles N, in each cavity.
    pub particles: usize,
    /// Seed of the initial filling.
    pub seed: u64,
    /// What is swept.
    pub swept: Swept,
    /// The other one: the frequency in Hz where the amplitude is swept, else the amplitude.
    pub other: f64,
}

impl Line {
    pub(super) fn at(&self, value: f64) -> Point {
        let (amplitude, frequency) = match self.swept {
            Swept::Amplitude => (value, self.other),
            Swept::Frequency => (self.other, value),
        };
        Point {
            particles: self.particles,
            seed: self.seed,
            amplitude,
            frequency,
        }
    }
}

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            particles,
            seed,
            swept,
            other,
        } = self;
        write!(f, "{particles} particles, seed {seed}, ")?;
        match swept {
            Swept::Amplitude => write!(f, "{other} Hz"),
            Swept::Frequency => write!(f, "amplitude {other}"),
        }
    }
}
