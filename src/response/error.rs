use super::Point;
use crate::damper::{BuildError, RestoreError};
use crate::error::ValueError;
use crate::filling::FillingError;
use crate::step_error::StepError;

/// Why a response was not measured.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ResponseError {
    /// A number outside its range.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// The cavity does not hold the particles.
    #[error("{point}: {error}")]
    Filling {
        /// The point that was to be measured.
        point: Point,
        /// What is wrong.
        error: FillingError,
    },
    /// The damper could not be built.
    #[error("{point}: {error}")]
    Build {
        /// The point that was to be measured.
        point: Point,
        /// What is wrong.
        error: Box<BuildError>,
    },
    /// A step could not be taken.
    #[error("{point}, after {time} s: {error}")]
    Step {
        /// The point that was being measured.
        point: Point,
        /// Simulated time in s.
        time: f64,
        /// What happened.
        error: Box<StepError>,
    },
    /// The structure has no such thing as it watches.
    #[error("{point}: the structure has not what is watched of it")]
    Unwatched {
        /// The point that was to be measured.
        point: Point,
    },
    /// The damper of a sweep's next point cannot take over the state of the last one's.
    #[error("{point}: {error}")]
    Sweep {
        /// The point that was to be measured.
        point: Point,
        /// What differs.
        error: Box<RestoreError>,
    },
    /// The callback asked to stop.
    #[error("cancelled")]
    Cancelled,
}
