use super::Point;
use crate::damper::BuildError;
use crate::error::ValueError;
use crate::filling::FillingError;
use crate::step_error::StepError;

/// Why a field was not measured: as [`ResponseError`](crate::response::ResponseError), but for what only sweeps and
/// structures can get wrong.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FieldError {
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
    /// The callback asked to stop.
    #[error("cancelled")]
    Cancelled,
}
