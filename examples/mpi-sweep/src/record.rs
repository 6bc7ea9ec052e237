//! Units of work and what comes of them, as they go through files and messages.

use std::fmt;

use particle_damper::fields::{self, Measurement};
use particle_damper::response::{self, Response};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// Where something is measured, by itself.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum Point {
    Response(response::Point),
    Field { particles: usize, at: fields::Point },
}

/// A point and its number in the sweep.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Task {
    pub number: usize,
    pub point: Point,
}

/// What came of a task.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    pub number: usize,
    pub point: Point,
    pub outcome: Outcome,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    Response(Box<Response>),
    Field(Box<Measurement>),
    /// Why there is nothing.
    Failed(String),
}

impl Point {
    /// Likely time that it takes, in any unit: what carries the particles costs as much as a few of them.
    pub fn work(&self) -> f64 {
        let (particles, frequency) = match self {
            Self::Response(point) => (point.particles, point.frequency),
            Self::Field { particles, at } => (*particles, at.frequency),
        };
        (particles as f64 + 4.0) / frequency
    }
}

impl Outcome {
    pub const fn failed(&self) -> bool {
        matches!(self, Self::Failed(_))
    }
}

impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Response(point) => write!(f, "{point}"),
            Self::Field { particles, at } => write!(f, "{particles} particles, {at}"),
        }
    }
}

/// A result that comes back from its text to the last bit. One with a number that is not finite does not.
pub fn exact<T>(result: T) -> Result<Box<T>, String>
where
    T: fmt::Debug + PartialEq + Serialize + DeserializeOwned,
{
    let text = serde_json::to_string(&result).map_err(|error| error.to_string())?;
    match serde_json::from_str::<T>(&text) {
        Ok(back) if back == result => Ok(Box::new(result)),
        _ => Err(format!("a number is not finite: {result:?}")),
    }
}
