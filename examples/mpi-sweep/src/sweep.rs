//! What is measured: the curve, its points, and what comes of a point.

use std::any::Any;
use std::num::NonZeroU32;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};

use clap::{Args, ValueEnum};
use particle_damper::response::{Point, Response};
use particle_damper::{
    ContactLaw, HertzMindlin, HertzTsuji, Material, ResponseCurve, RestitutionImpulse,
};
use serde::{Deserialize, Serialize};

use crate::values::Values;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Law {
    /// The coarse law, by the coefficient of restitution.
    Restitution,
    /// The strict law of the paper.
    HertzTsuji,
    /// The strict law with Mindlin's tangential stiffness.
    HertzMindlin,
}

/// The paper's damper, measured at every combination of number of particles, seed and frequency.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sweep {
    /// Contact law.
    #[arg(long, value_enum, default_value = "restitution")]
    pub law: Law,
    /// Longest time step in s.
    #[arg(long, default_value_t = 1e-4, default_value_ifs([
        ("law", "hertz-tsuji", "2e-5"), ("law", "hertz-mindlin", "2e-5"),
    ]))]
    pub time_step: f64,
    /// Amplitude of the force in N.
    #[arg(long, default_value_t = 0.25)]
    pub force: f64,
    /// Numbers of particles.
    #[arg(long, value_delimiter = ',', default_value = "0,20,40,60")]
    pub particles: Vec<usize>,
    /// Seeds of the fillings.
    #[arg(long, value_delimiter = ',', default_value = "1")]
    pub seeds: Vec<u64>,
    /// Frequencies in Hz: numbers, or FROM:TO:COUNT evenly spaced, separated by commas.
    #[arg(
        long,
        default_value = "4:8:41",
        default_value_if("quick", "true", "5:7:3")
    )]
    pub frequencies: Values,
    /// Periods discarded.
    #[arg(long, default_value_t = 20, default_value_if("quick", "true", "5"))]
    pub discarded: u32,
    /// Periods averaged.
    #[arg(long, default_value = "40", default_value_if("quick", "true", "10"))]
    pub averaged: NonZeroU32,
}

/// A unit of work: a point and its number in the sweep.
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
    Response(Response),
    /// Why there is none.
    Failed(String),
}

impl Sweep {
    /// All units of work, in the order of the results.
    pub fn tasks(&self) -> Vec<Task> {
        let curve = self.curve(RestitutionImpulse::new(Material::acrylic()));
        let points = curve.points().into_iter().enumerate();
        points
            .map(|(number, point)| Task { number, point })
            .collect()
    }

    fn curve<L>(&self, law: L) -> ResponseCurve<L> {
        ResponseCurve::new(law)
            .force(self.force)
            .time_step(self.time_step)
            .periods(self.discarded, self.averaged.get())
            .particles(self.particles.iter().copied())
            .seeds(self.seeds.iter().copied())
            .frequencies(self.frequencies.0.iter().copied())
    }

    /// Measures a point by itself. Whatever goes wrong is part of what is returned.
    pub fn measure(&self, task: Task) -> Record {
        let Task { number, point } = task;
        let measured = catch_unwind(AssertUnwindSafe(|| self.response(point)));
        let outcome = match measured {
            Ok(Ok(response)) => Outcome::Response(response),
            Ok(Err(error)) => Outcome::Failed(error),
            Err(panic) => Outcome::Failed(format!("panicked: {}", message(&*panic))),
        };
        Record {
            number,
            point,
            outcome,
        }
    }

    fn response(&self, point: Point) -> Result<Response, String> {
        let acrylic = Material::acrylic();
        match self.law {
            Law::Restitution => self.under(RestitutionImpulse::new(acrylic), point),
            Law::HertzTsuji => self.under(HertzTsuji::new(acrylic), point),
            Law::HertzMindlin => self.under(HertzMindlin::new(acrylic), point),
        }
    }

    fn under<L: ContactLaw + Clone>(&self, law: L, point: Point) -> Result<Response, String> {
        let response = self
            .curve(law)
            .measure(point, |_| ControlFlow::Continue(()))
            .map_err(|error| error.to_string())?;
        // What goes through a file must come back to the last bit: a NaN would not.
        let text = serde_json::to_string(&response).map_err(|error| error.to_string())?;
        match serde_json::from_str(&text) {
            Ok(back) if response == back => Ok(response),
            _ => Err(format!("{point}: a number is not finite: {response:?}")),
        }
    }
}

/// What a panic said.
fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("without a message")
}

impl Task {
    /// Likely time that it takes, in any unit: the oscillator costs as much as a few particles.
    pub fn work(&self) -> f64 {
        (self.point.particles as f64 + 4.0) / self.point.frequency
    }
}
