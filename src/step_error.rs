//! Why a step could not be taken, and what lies behind it.

use std::fmt;

use glam::{DQuat, DVec3};

use crate::detector::DetectorError;
use crate::error::ValueError;
use crate::law::LawError;

/// Why a particle has left its cavity, or is pressed into something.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Cause {
    /// The mount has run away, and its container with it.
    Mount {
        /// Number of the coordinate that moves fastest.
        coordinate: usize,
        /// Its value.
        value: f64,
        /// Its rate.
        rate: f64,
    },
    /// The container is moved too fast or by leaps.
    Container {
        /// Its velocity in m/s.
        velocity: DVec3,
        /// What it has moved by in the step, m.
        way: f64,
    },
    /// The container turns too fast or by leaps.
    Rotation {
        /// Its angular velocity in rad/s.
        angular_velocity: DVec3,
        /// What it has turned by in the step, rad.
        angle: f64,
    },
    /// A particle moves far faster than the contact law is set up for.
    Speed {
        /// Number of the particle.
        particle: usize,
        /// Its speed relative to its container, m/s.
        speed: f64,
        /// The speed that the law is set up for, m/s.
        reference: f64,
    },
    /// None of these.
    Unknown {
        /// The speed of the fastest particle relative to its container, m/s.
        speed: f64,
    },
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mount {
                coordinate,
                value,
                rate,
            } => write!(
                f,
                "the mount runs away, coordinate {coordinate} is at {value} with a rate of {rate}; check its equations or shorten the step"
            ),
            Self::Container { velocity, way } => write!(
                f,
                "the container moves at {velocity} m/s, by {way} m in the step; check what drives it, or shorten the interval"
            ),
            Self::Rotation {
                angular_velocity,
                angle,
            } => write!(
                f,
                "the container turns at {angular_velocity} rad/s, by {angle} rad in the step; check what drives it, or shorten the interval"
            ),
            Self::Speed {
                particle,
                speed,
                reference,
            } => write!(
                f,
                "particle {particle} moves at {speed} m/s and the contact law is set up for {reference} m/s; raise its reference speed"
            ),
            Self::Unknown { speed } => write!(
                f,
                "the fastest particle moves at {speed} m/s; a shorter step may help"
            ),
        }
    }
}

/// Why a step could not be taken. The damper's state is then undefined until a snapshot is restored.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// A particle's position, velocity, force or torque is no longer finite.
    #[error("particle {particle} is not finite: position {position}, acceleration {acceleration}")]
    NotFinite {
        /// Number of the particle.
        particle: usize,
        /// Its position in the fixed frame in m.
        position: DVec3,
        /// Its acceleration in m/s^2.
        acceleration: DVec3,
    },
    /// The centre of a particle has passed a wall.
    #[error("particle {particle} has left the cavity through wall {wall}, at {position}: {cause}")]
    Escaped {
        /// Number of the particle.
        particle: usize,
        /// Number of the wall.
        wall: u32,
        /// Its position in the container's frame in m.
        position: DVec3,
        /// What may lie behind it.
        cause: Cause,
    },
    /// Two bodies overlap by more than the stated bound.
    #[error(
        "particle {particle} overlaps {other} by {overlap} m; the limit is {limit} m: {cause}. A shorter \
         step helps; under an impulse law more sweeps, where heavy bodies press on light ones; under a \
         force law a stiffer material"
    )]
    Overlap {
        /// Number of the particle.
        particle: usize,
        /// What it overlaps.
        other: super::Partner,
        /// Overlap in m.
        overlap: f64,
        /// The bound in m.
        limit: f64,
        /// What may lie behind it.
        cause: Cause,
    },
    /// A container has left the course with which it began the step by so much that its walls may have
    /// passed over particles.
    #[error(
        "the container of cavity {cavity} is {off} m off the course that it began the step with, {limit} m at most can be followed: {cause}"
    )]
    Jump {
        /// Number of the cavity.
        cavity: usize,
        /// How far it is off in m.
        off: f64,
        /// The bound in m: half the radius of the smallest particle.
        limit: f64,
        /// What lies behind it.
        cause: Cause,
    },
    /// The velocity of a prescribed motion is not the rate of its position.
    #[error(
        "the velocity of the container of cavity {cavity} is not the rate of its position: {velocity} against {rate} m/s"
    )]
    NotItsRate {
        /// Number of the cavity.
        cavity: usize,
        /// Its velocity in m/s, on the mean of the step.
        velocity: DVec3,
        /// Way over time in the step, m/s.
        rate: DVec3,
    },
    /// The angular velocity of a prescribed motion is not the rate of its orientation.
    #[error(
        "the angular velocity of the container of cavity {cavity} is not the rate of its orientation: {angular_velocity} against {rate} rad/s"
    )]
    TurnsOtherwise {
        /// Number of the cavity.
        cavity: usize,
        /// Its angular velocity in rad/s, on the mean of the step.
        angular_velocity: DVec3,
        /// Turn over time in the step, rad/s.
        rate: DVec3,
    },
    /// A container's orientation is no rotation (a unit quaternion to within a thousandth), or its angular
    /// velocity is not finite.
    #[error(
        "the container of cavity {cavity} stands at {orientation} and turns with {angular_velocity} rad/s: the one has to be a unit quaternion, the other finite"
    )]
    Orientation {
        /// Number of the cavity.
        cavity: usize,
        /// Its orientation.
        orientation: DQuat,
        /// Its angular velocity in rad/s.
        angular_velocity: DVec3,
    },
    /// The container of a planar cavity turns about another axis than z.
    #[error(
        "the container of cavity {cavity} is turned out of the plane z = 0 of a planar cavity: {orientation}, {angular_velocity} rad/s"
    )]
    TurnsOutOfPlane {
        /// Number of the cavity.
        cavity: usize,
        /// Its orientation.
        orientation: DQuat,
        /// Its angular velocity in rad/s.
        angular_velocity: DVec3,
    },
    /// The mount's coordinates are no longer finite.
    #[error("the mount runs away: coordinate {coordinate} is at {value} with a rate of {rate}")]
    Mount {
        /// Number of the coordinate.
        coordinate: usize,
        /// Its value.
        value: f64,
        /// Its rate.
        rate: f64,
    },
    /// A particle moves so far relative to its container in a step that it could pass others, a wall or an
    /// [obstacle](crate::Cavity::thickness) unseen: under an impulse law by more than its radius. A shorter
    /// step follows it.
    #[error(
        "particle {particle} moves at {speed} m/s relative to its container, too far in a step of \
         {time_step} s, which follows {limit} m/s at most: {cause}"
    )]
    TooFast {
        /// Number of the particle.
        particle: usize,
        /// Its speed relative to the container in m/s.
        speed: f64,
        /// The step in s.
        time_step: f64,
        /// The greatest speed in m/s that the step follows.
        limit: f64,
        /// What may be behind it.
        cause: Cause,
    },
    /// The container's motion is no longer finite.
    #[error("the motion of the container of cavity {cavity} is not finite: {position}, {velocity}")]
    Container {
        /// Number of the cavity.
        cavity: usize,
        /// Position in m.
        position: DVec3,
        /// Velocity in m/s.
        velocity: DVec3,
    },
    /// The container of a planar cavity has left the plane.
    #[error(
        "the container of cavity {cavity} leaves the plane z = 0 of a planar cavity: {position}, {velocity}"
    )]
    OutOfPlane {
        /// Number of the cavity.
        cavity: usize,
        /// Position in m.
        position: DVec3,
        /// Velocity in m/s.
        velocity: DVec3,
    },
    /// The detector proposed a pair that does not exist.
    #[error("the detector proposed the pair {first}, {second} in a bed of {particles}")]
    InvalidPair {
        /// The lower number.
        first: u32,
        /// The higher number.
        second: u32,
        /// How many particles there are.
        particles: usize,
    },
    /// The detector cannot serve the bed at the speeds that it has.
    #[error(transparent)]
    Detector(#[from] DetectorError),
    /// The law refused two bodies that met for the first time.
    #[error(transparent)]
    Law(#[from] LawError),
    /// A number that the host handed in is outside its range.
    #[error(transparent)]
    Value(#[from] ValueError),
}
