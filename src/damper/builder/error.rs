use crate::step_error::StepError;
use std::fmt;

use glam::DVec3;

use crate::detector::DetectorError;
use crate::error::ValueError;
use crate::excitation::Jump;
use crate::law::LawError;

/// What sets the longest time step of a damper.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum StepBound {
    /// The contact of two particles under the contact law.
    Pair {
        /// Number of a particle.
        first: usize,
        /// Number of another of the kind that it meets, or of the same one if it is the only one.
        second: usize,
    },
    /// The contact of a particle and a wall under the contact law.
    Wall {
        /// Number of the particle.
        particle: usize,
    },
    /// The mount: 20 steps to a period of its highest natural frequency.
    NaturalFrequency {
        /// The frequency in Hz.
        frequency: f64,
    },
    /// The excitation: ten steps to its shortest feature.
    Feature {
        /// How long it takes, s.
        duration: f64,
    },
}

impl fmt::Display for StepBound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pair { first, second } if first == second => {
                write!(f, "the contact law for two particles like {first}")
            }
            Self::Pair { first, second } => {
                write!(f, "the contact law for particles like {first} and {second}")
            }
            Self::Wall { particle } => {
                write!(f, "the contact law for particle {particle} at a wall")
            }
            Self::NaturalFrequency { frequency } => write!(
                f,
                "the mount, whose natural frequency of {frequency} Hz 20 steps to a period keep to 0.5 %"
            ),
            Self::Feature { duration } => write!(
                f,
                "the excitation, of whose shortest feature of {duration} s ten steps keep the impulse to 1 %"
            ),
        }
    }
}

/// Why a damper could not be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// A number outside its range.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// The law refused two bodies of the bed.
    #[error(transparent)]
    Law(#[from] LawError),
    /// The detector cannot serve the bed.
    #[error(transparent)]
    Detector(#[from] DetectorError),
    /// A number of a particle is outside its range.
    #[error("particle {particle}: {error}")]
    Particle {
        /// Number of the particle.
        particle: usize,
        /// What is wrong with it.
        error: ValueError,
    },
    /// A particle overlaps another by more than the builder allows.
    #[error("particles {first} and {second} overlap by {overlap} m; at most {limit} m is allowed")]
    InitialOverlap {
        /// Number of the first particle.
        first: usize,
        /// Number of the second particle.
        second: usize,
        /// Overlap in m.
        overlap: f64,
        /// Largest overlap allowed in m.
        limit: f64,
    },
    /// A particle reaches into a wall by more than the builder allows, or stands outside.
    #[error(
        "particle {particle} at {position} overlaps wall {wall} by {overlap} m; at most {limit} m is allowed"
    )]
    OutsideCavity {
        /// Number of the particle.
        particle: usize,
        /// Its position in the container's frame in m.
        position: DVec3,
        /// Number of the wall.
        wall: u32,
        /// Overlap in m.
        overlap: f64,
        /// Largest overlap allowed in m.
        limit: f64,
    },
    /// A particle is too large for its cavity.
    #[error(
        "particle {particle} of diameter {diameter} m does not fit into a cavity {extent} m across"
    )]
    TooLarge {
        /// Number of the particle.
        particle: usize,
        /// Its diameter in m.
        diameter: f64,
        /// The cavity's least extent in m.
        extent: f64,
    },
    /// A particle is larger than a hollow edge of its cavity is round: it would touch one wall at two points.
    #[error(
        "particle {particle} of radius {radius} m does not fit into edges rounded by {rounding} m"
    )]
    TooLargeForEdge {
        /// Number of the particle.
        particle: usize,
        /// Its radius in m.
        radius: f64,
        /// The [rounding](crate::Cavity::rounding) of the cavity in m.
        rounding: f64,
    },
    /// A particle, a velocity, gravity or the mount leaves the plane of a planar cavity.
    #[error("{quantity} {value} leaves the plane z = 0 of a planar cavity")]
    OutOfPlane {
        /// What leaves the plane.
        quantity: &'static str,
        /// Its offending value.
        value: DVec3,
    },
    /// A particle in a cavity that the damper does not have.
    #[error("particle {particle} is in cavity {cavity}, and there are {cavities}")]
    UnknownCavity {
        /// Number of the particle.
        particle: usize,
        /// The cavity asked for.
        cavity: u32,
        /// How many cavities there are.
        cavities: usize,
    },
    /// The time step is longer than some part can bear.
    #[error("time step {time_step} s is too long: at most {limit} s is borne by {bound}")]
    TimeStepTooLong {
        /// The step asked for in s.
        time_step: f64,
        /// The longest step in s.
        limit: f64,
        /// What sets the limit.
        bound: StepBound,
    },
    /// A mount whose coordinates no load on a container moves: it lacks
    /// [`Mount::accelerate`](crate::Mount::accelerate), or its containers do not follow its coordinates.
    #[error(
        "the mount has {degrees} coordinates, and no load on a container moves any: its accelerations \
         must depend on the loads"
    )]
    ImmovableMount {
        /// How many coordinates the mount has.
        degrees: usize,
    },
    /// The base of the mount jumps.
    #[error(
        "the base jumps at {} s, by {} m and {} m/s; what it does beyond a record can be chosen (`Sampled::beyond`)",
        .0.time, .0.value, .0.rate
    )]
    BaseJumps(Jump),
    /// Neither one detector for each cavity, nor one that can be copied.
    #[error("there are {cavities} cavities and {detectors} detectors; each cavity needs its own")]
    DetectorCount {
        /// How many detectors were given.
        detectors: usize,
        /// How many cavities there are.
        cavities: usize,
    },
    /// More walls than a damper can keep account of.
    #[error("{count} walls are more than the limit of {limit}")]
    TooManyWalls {
        /// How many walls all cavities have.
        count: u64,
        /// How many are allowed.
        limit: u64,
    },
    /// The first evaluation failed.
    #[error(transparent)]
    Start(#[from] StepError),
    /// No time step was given, and no part sets a limit to derive one from.
    #[error("no time step was given, and neither contact law nor mount limit it")]
    NoTimeStep,
    /// More particles than 32-bit numbers can count.
    #[error("{count} particles are more than the limit of {limit}")]
    TooManyParticles {
        /// How many were given.
        count: usize,
        /// How many are allowed.
        limit: usize,
    },
}
