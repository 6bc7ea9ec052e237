//! The results of the benchmarks as a table and two pictures: time per particle of a detection and of
//! a step, against the number of particles.
//!
//! `cargo bench && cargo run --release --example benches` leaves `target/benches/benches.csv`,
//! `detect.svg` and `step.svg`. The machine should have nothing else to do while it measures.

#[path = "support/chart.rs"]
mod chart;
#[path = "support/output.rs"]
mod output;

use std::cmp::Ordering;
use std::env;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use chart::{Chart, Line};
use clap::Parser;
use plotters::prelude::SeriesLabelPosition;
use serde_json::Value;

type Failure = Box<dyn Error + Send + Sync>;

/// Results of `cargo bench`, as a table and pictures.
#[derive(Debug, Parser)]
struct Options {
    /// Draws nothing, and is content with it, if no benchmark has run.
    #[arg(long)]
    quick: bool,
}

/// One benchmark's result.
#[derive(Debug, PartialEq, PartialOrd)]
struct Measured {
    group: String,
    function: String,
    particles: u64,
    /// Median time of an iteration in ns, divided by the number of particles.
    nanoseconds: f64,
}

impl Measured {
    /// Nothing for benchmarks whose throughput is not in particles.
    fn read(directory: &Path) -> Result<Option<Self>, Failure> {
        let file = |name| -> Result<Value, Failure> {
            Ok(serde_json::from_str(&fs::read_to_string(
                directory.join(name),
            )?)?)
        };
        let (id, estimates) = (file("benchmark.json")?, file("estimates.json")?);
        let text = |value: &Value| value.as_str().map(str::to_owned);
        Ok((|| {
            let elements = id["throughput"]["Elements"].as_f64();
            let elements = elements.filter(|&elements| elements > 0.0)?;
            Some(Self {
                group: text(&id["group_id"])?,
                function: text(&id["function_id"])?,
                particles: id["value_str"].as_str()?.parse().ok()?,
                nanoseconds: estimates["median"]["point_estimate"].as_f64()? / elements,
            })
        })())
    }

    /// The results at any depth below `directory`, each in a directory `new`.
    fn collect(directory: &Path, results: &mut Vec<Self>) -> Result<(), Failure> {
        let newest = directory.join("new");
        if newest.join("benchmark.json").exists() {
            results.extend(Self::read(&newest)?);
            return Ok(());
        }
        for entry in fs::read_dir(directory)? {
            let path = entry?.path();
            if path.is_dir() {
                Self::collect(&path, results)?;
            }
        }
        Ok(())
    }
}

/// Where criterion leaves its results.
fn criterion_home() -> PathBuf {
    let target = || {
        env::var_os("CARGO_TARGET_DIR").map_or_else(
            || Path::new(env!("CARGO_MANIFEST_DIR")).join("target"),
            PathBuf::from,
        )
    };
    env::var_os("CRITERION_HOME").map_or_else(|| target().join("criterion"), PathBuf::from)
}

/// Number of particles that the legend reaches to at the most.
const LEGEND_ENDS: f64 = 1000.0;

/// Lines of one colour, one for each group.
struct Curve {
    label: &'static str,
    colour: usize,
    functions: &'static [&'static str],
}

const fn curve(label: &'static str, colour: usize, functions: &'static [&'static str]) -> Curve {
    Curve {
        label,
        colour,
        functions,
    }
}

struct Picture {
    file: &'static str,
    title: &'static str,
    time: &'static str,
    /// Part of the height that the legend, at the left, leaves to the points below it.
    below_legend: f64,
    /// Groups and the length of their dashes.
    groups: [(&'static str, i32); 3],
    curves: &'static [Curve],
}

const DETECT: Picture = Picture {
    file: "detect.svg",
    title: "Contact detection, dense beds (solid: in the plane, dashed: in space)",
    time: "time per particle and detection (ns)",
    below_legend: 0.8,
    groups: [
        ("detect/slot", 0),
        ("detect/planar_dense", 0),
        ("detect/space_dense", 6),
    ],
    curves: &[
        curve("all pairs", 0, &["all_pairs"]),
        curve("cell grid", 2, &["cells_32x20", "cell_grid"]),
        curve("linked cells", 1, &["linked_cells"]),
    ],
};

const STEP: Picture = Picture {
    file: "step.svg",
    title: "Steps of shaken beds (solid: in the plane, dashed: in space)",
    time: "time per particle and step (ns)",
    below_legend: 0.6,
    groups: [("step/slot", 0), ("step/plane", 0), ("step/space", 6)],
    curves: &[
        curve(
            "HertzTsuji, RK4, all pairs",
            0,
            &["hertz_tsuji_rk4_all_pairs"],
        ),
        curve("HertzTsuji, RK4", 6, &["hertz_tsuji_rk4"]),
        curve("HertzTsuji, Verlet", 1, &["hertz_tsuji_verlet"]),
        curve("HertzMindlin, RK4", 5, &["hertz_mindlin_rk4"]),
        curve("HertzMindlin, Verlet", 2, &["hertz_mindlin_verlet"]),
        curve("RestitutionImpulse, RK4", 7, &["restitution_rk4"]),
        curve("RestitutionImpulse, Verlet", 3, &["restitution_verlet"]),
        curve(
            "RestitutionImpulse, Verlet, cell grid",
            4,
            &["restitution_verlet_cells_32x20"],
        ),
    ],
};

impl Picture {
    fn draw(&self, directory: &Path, results: &[Measured]) -> Result<(), Failure> {
        let mut lines: Vec<Line> = Vec::new();
        for curve in self.curves {
            let mut label = curve.label;
            for (group, dash) in self.groups {
                let points: Vec<_> = results
                    .iter()
                    .filter(|result| result.group == group)
                    .filter(|result| curve.functions.contains(&result.function.as_str()))
                    .map(|result| (result.particles as f64, result.nanoseconds))
                    .collect();
                if !points.is_empty() {
                    lines.push(Line {
                        label: std::mem::take(&mut label).to_owned(),
                        colour: curve.colour,
                        dash,
                        marked: true,
                        points,
                    });
                }
            }
        }
        if lines.is_empty() {
            println!("nothing was measured for {}", self.file);
            return Ok(());
        }
        let points = || lines.iter().flat_map(|line| &line.points);
        let least = points().fold([f64::INFINITY; 2], |[x, y], at| [x.min(at.0), y.min(at.1)]);
        let most = points().fold([0.0; 2], |[x, y], at| [at.0.max(x), at.1.max(y)]);
        let left = points().filter(|at| at.0 < LEGEND_ENDS).map(|at| at.1);
        let left = left.fold(least[1], f64::max);
        let bottom = 0.7 * least[1];
        let above_left = bottom * (left / bottom).powf(1.0 / self.below_legend);
        let path = directory.join(self.file);
        Chart {
            title: self.title,
            axes: ["number of particles N", self.time],
            x: 0.5 * least[0]..1.6 * most[0],
            y: bottom..above_left.max(1.5 * most[1]),
            logarithmic: [true; 2],
            legend: SeriesLabelPosition::UpperLeft,
        }
        .draw(&path, &lines)?;
        output::say_where("picture", &path);
        Ok(())
    }
}

fn main() -> Result<(), Failure> {
    let options = Options::parse();
    let (home, mut results) = (criterion_home(), Vec::new());
    if home.is_dir() {
        Measured::collect(&home, &mut results)?;
    }
    if results.is_empty() {
        let nothing = format!("no results in {}: run `cargo bench` first", home.display());
        if options.quick {
            println!("nothing to draw yet, {nothing}");
            return Ok(());
        }
        return Err(nothing.into());
    }
    results.sort_by(|a, b| a.partial_cmp(b).unwrap_or(Ordering::Equal));

    println!("{:45} {:>9}  ns per particle", "benchmark", "N");
    for result in &results {
        let name = format!("{}/{}", result.group, result.function);
        println!(
            "{name:45} {:9}  {:15.2}",
            result.particles, result.nanoseconds
        );
    }
    let directory = output::directory("benches")?;
    let rows = results.iter().map(|result| {
        let Measured {
            group,
            function,
            particles,
            nanoseconds,
        } = result;
        format!("{group},{function},{particles},{nanoseconds:.3}")
    });
    let columns = "group,function,particles,ns_per_particle";
    output::write_table(&directory.join("benches.csv"), columns, rows)?;
    for picture in [DETECT, STEP] {
        picture.draw(&directory, &results)?;
    }
    Ok(())
}
