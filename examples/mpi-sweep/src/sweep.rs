//! What is measured: the sweep, its points, and how one of them is measured.

use std::any::Any;
use std::fmt::{Debug, Display};
use std::num::NonZeroU32;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};

use clap::{Args, ValueEnum};
use particle_damper::{
    ContactLaw, EffectiveFields, HertzMindlin, HertzTsuji, Material, Particle, ResponseCurve,
    RestitutionImpulse, Slot, ValueError,
};
use serde::{Deserialize, Serialize};

use crate::record::{Outcome, Point, Record, Task, exact};
use crate::values::Values;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Response curves: the paper's oscillator, driven by a force.
    Responses,
    /// Effective fields: the container moved by itself.
    Fields,
}

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

/// The paper's damper, measured at every combination of number of particles, seed, amplitude and frequency.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sweep {
    /// What is measured.
    #[arg(long, value_enum, default_value = "responses")]
    pub of: Kind,
    /// Contact law.
    #[arg(long, value_enum, default_value = "restitution")]
    pub law: Law,
    /// Longest time step in s.
    #[arg(long, default_value_t = 1e-4, default_value_ifs([
        ("law", "hertz-tsuji", "2e-5"), ("law", "hertz-mindlin", "2e-5"),
    ]))]
    pub time_step: f64,
    /// Numbers of particles.
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "0,20,40,60",
        default_value_if("of", "fields", "20,60")
    )]
    pub particles: Vec<usize>,
    /// Seeds of the fillings.
    #[arg(long, value_delimiter = ',', default_value = "1")]
    pub seeds: Vec<u64>,
    /// Amplitudes, of the force in N or of the container's motion in m: numbers, or FROM:TO:COUNT evenly
    /// spaced, separated by commas.
    #[arg(long, default_value = "0.25", default_value_ifs([
        ("of", "fields", "0.005:0.04:8"),
    ]))]
    pub amplitudes: Values,
    /// Frequencies in Hz, likewise.
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

impl Sweep {
    /// All units of work, in the order of the results.
    pub fn tasks(&self) -> Vec<Task> {
        let law = RestitutionImpulse::new(Material::acrylic());
        let points: Vec<Point> = match self.of {
            Kind::Responses => {
                let points = self.curve(law).points();
                points.into_iter().map(Point::Response).collect()
            }
            Kind::Fields => {
                let points = self.fields(law).points();
                let of = |&particles| {
                    let points = points.iter();
                    points.map(move |&at| Point::Field { particles, at })
                };
                self.particles.iter().flat_map(of).collect()
            }
        };
        let points = points.into_iter().enumerate();
        points
            .map(|(number, point)| Task { number, point })
            .collect()
    }

    pub(crate) fn curve<L>(&self, law: L) -> ResponseCurve<L> {
        ResponseCurve::new(law)
            .time_step(self.time_step)
            .periods(self.discarded, self.averaged.get())
            .particles(self.particles.iter().copied())
            .seeds(self.seeds.iter().copied())
            .amplitudes(self.amplitudes.0.iter().copied())
            .frequencies(self.frequencies.0.iter().copied())
    }

    /// Without particles.
    pub(crate) fn fields<L>(&self, law: L) -> EffectiveFields<L, Slot> {
        EffectiveFields::new(law, Slot::paper())
            .time_step(self.time_step)
            .periods(self.discarded, self.averaged.get())
            .seeds(self.seeds.iter().copied())
            .amplitudes(self.amplitudes.0.iter().copied())
            .frequencies(self.frequencies.0.iter().copied())
    }

    /// Measures a point by itself. Whatever goes wrong is part of what is returned.
    pub fn measure(&self, task: Task) -> Record {
        let Task { number, point } = task;
        let acrylic = Material::acrylic();
        let measured = catch_unwind(AssertUnwindSafe(|| match self.law {
            Law::Restitution => self.under(RestitutionImpulse::new(acrylic), point),
            Law::HertzTsuji => self.under(HertzTsuji::new(acrylic), point),
            Law::HertzMindlin => self.under(HertzMindlin::new(acrylic), point),
        }));
        let measured = measured.unwrap_or_else(|panic| Err(message(&*panic)));
        Record {
            number,
            point,
            outcome: measured.unwrap_or_else(Outcome::Failed),
        }
    }

    /// All that is set, by the options and by what is above, as a text.
    pub fn settings(&self) -> String {
        let acrylic = Material::acrylic();
        match self.law {
            Law::Restitution => self.set(RestitutionImpulse::new(acrylic)),
            Law::HertzTsuji => self.set(HertzTsuji::new(acrylic)),
            Law::HertzMindlin => self.set(HertzMindlin::new(acrylic)),
        }
    }

    fn set<L: Debug>(&self, law: L) -> String {
        match self.of {
            Kind::Responses => format!("{:?}", self.curve(law)),
            Kind::Fields => format!("{:?} {:?}", self.fields(law), grain()),
        }
    }

    fn under<L: ContactLaw + Clone>(&self, law: L, point: Point) -> Result<Outcome, String> {
        match point {
            Point::Response(at) => {
                let response = self.curve(law).measure(at, |_| ControlFlow::Continue(()));
                let response = response.map_err(|error| reason(&error, &at))?;
                exact(response).map(Outcome::Response)
            }
            Point::Field { particles, at } => {
                let grain = grain().map_err(|error| error.to_string())?;
                let fields = self.fields(law).with(particles, grain);
                let measurement = fields.measure(at, |_| ControlFlow::Continue(()));
                let measurement = measurement.map_err(|error| reason(&error, &at))?;
                exact(measurement).map(Outcome::Field)
            }
        }
    }
}

/// A grain of the fields' beds.
fn grain() -> Result<Particle, ValueError> {
    Particle::new(3e-3, 0.2e-3)
}

/// What an error says, without the point that it begins with: it is told anyway.
fn reason(error: &impl Display, at: &impl Display) -> String {
    let (error, at) = (error.to_string(), at.to_string());
    let rest = error.strip_prefix(&at).unwrap_or(&error);
    rest.trim_start_matches([',', ':', ' ']).to_owned()
}

/// What a panic said.
fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    format!("panicked: {}", text.unwrap_or("without a message"))
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use particle_damper::fields::Cell;

    use super::*;

    #[derive(Parser)]
    struct Options {
        #[command(flatten)]
        sweep: Sweep,
        #[arg(long)]
        quick: bool,
    }

    fn sweep(options: &[&str]) -> Sweep {
        let start = ["test", "--quick", "--particles=20", "--seeds=1,2"];
        let options = Options::parse_from(start.iter().chain(options));
        assert!(options.quick);
        options.sweep
    }

    /// Measured one by one and through text, the results are those of the library's own runs.
    #[test]
    fn results_are_those_of_the_library() {
        let law = || RestitutionImpulse::new(Material::acrylic());
        let own = |sweep: &Sweep| -> Vec<Outcome> {
            let tasks = sweep.tasks().into_iter();
            let lines = tasks.map(|task| serde_json::to_string(&sweep.measure(task)).unwrap());
            let records = lines.map(|line| serde_json::from_str::<Record>(&line).unwrap());
            records.map(|record| record.outcome).collect()
        };
        let responses = sweep(&["--frequencies=5,17.3"]);
        let curve = responses.curve(law()).run(|_| ControlFlow::Continue(()));
        let outcomes = curve.unwrap().into_iter().map(Box::new);
        assert_eq!(
            own(&responses),
            outcomes.map(Outcome::Response).collect::<Vec<_>>()
        );

        let fields = sweep(&["--of=fields", "--frequencies=6,8", "--amplitudes=0.01,0.03"]);
        let whole = fields.fields(law());
        let whole = whole.with(20, Particle::new(3e-3, 0.2e-3).unwrap());
        let cells = whole.run(|_| ControlFlow::Continue(())).unwrap();
        let measurements: Vec<_> = own(&fields)
            .into_iter()
            .map(|outcome| match outcome {
                Outcome::Field(measurement) => *measurement,
                other => panic!("{other:?}"),
            })
            .collect();
        let pooled = measurements.chunks(2).filter_map(Cell::pooled);
        assert_eq!(pooled.collect::<Vec<_>>(), cells);
    }

    #[test]
    fn defaults_follow_the_law_and_the_kind() {
        assert!(sweep(&[]).time_step > sweep(&["--law=hertz-mindlin"]).time_step);
        assert!(sweep(&[]).amplitudes.0 == [0.25]);
        assert_eq!(sweep(&["--of=fields"]).amplitudes.0.len(), 8);
    }
}
