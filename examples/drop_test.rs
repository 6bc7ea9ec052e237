//! From a drop test to the constants of a contact law: a simulated ball bounces on a plate, a microphone and
//! a camera record it with noise, and the fit gives restitution and the paper's `c_p` back.
//!
//! `cargo run --release --example drop_test` leaves `target/drop_test/times.csv`, `heights.csv` and a picture.
//! Recordings of your own: `-- --times FILE` with a time (s) in each line, `-- --heights FILE` with a time (s)
//! and a height (m), separated by a comma; a first line that holds no numbers is passed over.

#[path = "support/chart.rs"]
mod chart;
#[path = "support/output.rs"]
mod output;

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use chart::{Chart, Line};
use clap::Parser;
use particle_damper::drop_test::{DropFit, DropTest, Fitted, HeightFit};
use particle_damper::glam::dvec3;
use particle_damper::{
    AllPairs, Bodies, Body, Cuboid, Damper, Damping, HertzTsuji, Material, Materials, Particle,
};
use plotters::prelude::SeriesLabelPosition;

type Failure = Box<dyn Error + Send + Sync>;

const RADIUS: f64 = 3e-3;
const MASS: f64 = 0.2e-3;

/// Restitution and damping coefficient from a drop test.
#[derive(Debug, Parser)]
struct Options {
    /// Times at which the ball was heard, in s.
    #[arg(long)]
    times: Option<PathBuf>,
    /// Times in s and heights in m, separated by a comma.
    #[arg(long)]
    heights: Option<PathBuf>,
    /// Standard deviation of the simulated microphone's times in s.
    #[arg(long, default_value_t = 2e-4)]
    time_noise: f64,
    /// Standard deviation of the simulated camera's heights in m.
    #[arg(long, default_value_t = 3e-4)]
    height_noise: f64,
    /// Nothing is left out: it is short.
    #[arg(long)]
    quick: bool,
}

/// The lines of numbers of a file.
fn read(path: &PathBuf) -> Result<Vec<Vec<f64>>, Failure> {
    let text = fs::read_to_string(path)?;
    let numbers = |line: &str| line.split(',').map(|word| word.trim().parse()).collect();
    let mut lines = Vec::new();
    for (n, line) in text.lines().enumerate() {
        match numbers(line) {
            Ok(values) => lines.push(values),
            Err(_) if n == 0 || line.trim().is_empty() => {}
            Err(error) => return Err(format!("line {}: {line:?}: {error}", n + 1).into()),
        }
    }
    Ok(lines)
}

/// Column `n` of such lines.
fn column(lines: &[Vec<f64>], n: usize) -> Result<Vec<f64>, Failure> {
    let values = lines.iter().map(|line| line.get(n).copied());
    let values: Option<Vec<f64>> = values.collect();
    values.ok_or_else(|| format!("a line has no column {}", n + 1).into())
}

/// Onsets of impacts (s), and heights (s, m) at 500 pictures a second, of a ball that falls by 0.1 m.
fn simulate(law: HertzTsuji) -> Result<(Vec<f64>, Vec<[f64; 2]>), Failure> {
    let start = dvec3(0.05, RADIUS + 0.1, 0.05);
    let mut damper = Damper::builder(Cuboid::new(dvec3(0.1, 0.2, 0.1))?, law)
        .detector(AllPairs)
        .particles([Particle::new(RADIUS, MASS)?.at(start)])
        .time_step(5e-6)
        .build()?;
    let (mut impacts, mut trace, mut touching) = (Vec::new(), Vec::new(), false);
    for step in 0..220_000_u32 {
        if step % 400 == 0 {
            let height = damper.particle(0).map_or(0.0, |ball| ball.position.y);
            trace.push([damper.time(), height]);
        }
        damper.step()?;
        let touches = damper.contacts() > 0;
        if touches && !touching {
            impacts.push(damper.time());
        }
        touching = touches;
    }
    // The last bounces are lost in noise.
    impacts.truncate(9);
    Ok((impacts, trace))
}

/// Normal random numbers of variance one: the same in every run.
fn noise() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        let mut sum = -6.0;
        for _ in 0..12 {
            state = state.wrapping_mul(6_364_136_223_846_793_005);
            state = state.wrapping_add(1_442_695_040_888_963_407);
            sum += (state >> 11) as f64 / (1_u64 << 53) as f64;
        }
        sum
    }
}

fn show(what: &str, unit: &str, found: Fitted, right: f64) {
    let Fitted {
        value, low, high, ..
    } = found;
    println!(
        "  {what:<22}{value:9.4}  {low:9.4} to {high:9.4} {unit:<9} simulated with {right:.4}"
    );
}

fn main() -> Result<(), Failure> {
    let options = Options::parse();
    let acrylic = Material::acrylic();
    let law = HertzTsuji::new(acrylic);
    let plate = Bodies::new(
        Body::sphere(RADIUS, MASS, Materials::FIRST),
        Body::wall(Materials::FIRST),
    );
    let impact = law.elastic_impact(&plate, 1.0)?;
    let right = [
        acrylic.interaction.restitution,
        law.damping_coefficient(&plate)?,
    ];

    let directory = output::directory("drop_test")?;
    let (mut times, mut trace) = simulate(law)?;
    let mut random = noise();
    for time in &mut times {
        *time += options.time_noise * random();
    }
    for at in &mut trace {
        at[1] += options.height_noise * random();
    }
    if let Some(path) = &options.times {
        times = column(&read(path)?, 0)?;
    }
    if let Some(path) = &options.heights {
        let lines = read(path)?;
        let heights = column(&lines, 0)?.into_iter().zip(column(&lines, 1)?);
        trace = heights.map(|(time, height)| [time, height]).collect();
    }
    let rows = times.iter().map(|time| format!("{time:.6}"));
    output::write_table(&directory.join("times.csv"), "time_s", rows)?;
    let rows = trace
        .iter()
        .map(|[time, height]| format!("{time:.6},{height:.6}"));
    output::write_table(&directory.join("heights.csv"), "time_s,height_m", rows)?;

    // Contacts under this law last for 0.14 ms, a little more with damping.
    let test = DropTest::new()
        .damping(Damping::Viscoelastic)
        .contact_duration(impact.duration())?;
    let heard = test.times(&times)?;
    println!(
        "\n{} impacts heard, {:.2} ms RMS off the fit:",
        times.len(),
        1e3 * heard.rms_residual()
    );
    show("restitution at 1 m/s", "", heard.restitution, right[0]);
    show(
        "c_p of ball and plate",
        "N s/m^1.5",
        heard.damping_coefficient(&impact),
        right[1],
    );
    println!("    impact    speed after it  off the fit");
    for impact in &heard.impacts {
        println!(
            "    {:.4} s  {:.3} m/s       {:+.2} ms",
            impact.time,
            impact.speed,
            1e3 * impact.residual
        );
    }
    let [seconds, heights] = [0, 1].map(|n| trace.iter().map(|at| at[n]).collect::<Vec<f64>>());
    let seen = test.heights(&seconds, &heights)?;
    println!("\n{} peaks seen:", seen.peaks.len());
    show(
        "restitution at 1 m/s",
        "",
        seen.contact.restitution,
        right[0],
    );
    show(
        "c_p of ball and plate",
        "N s/m^1.5",
        seen.contact.damping_coefficient(&impact),
        right[1],
    );
    show("scale of heights", "", seen.scale, 1.0);
    println!("    peak      height          off the fit");
    for peak in &seen.peaks {
        let residuals = [peak.time_residual, peak.height_residual].map(|off| 1e3 * off);
        println!(
            "    {:.4} s  {:.4} m        {:+.2} ms, {:+.2} mm",
            peak.time, peak.height, residuals[0], residuals[1]
        );
    }

    draw(&directory.join("heights.svg"), &trace, &heard, &seen)
}

/// The trace, and what was fitted to it and to the sound.
fn draw(path: &Path, trace: &[[f64; 2]], heard: &DropFit, seen: &HeightFit) -> Result<(), Failure> {
    let points = trace
        .iter()
        .map(|[time, height]| (*time, 1e3 * height))
        .collect();
    let peaks = seen.peaks.iter().map(|peak| (peak.time, 1e3 * peak.height));
    let floor = 1e3 * seen.floor.value;
    let impacts = heard.impacts.iter().map(|impact| (impact.time, floor));
    let last = trace.last().map_or(1.0, |at| at[0]);
    let top = trace.iter().fold(0.0_f64, |top, at| top.max(1e3 * at[1]));
    Chart {
        title: "A drop test, and what was fitted to it",
        axes: ["time t (s)", "height in the trace (mm)"],
        x: 0.0..last,
        y: floor - 0.05 * top..1.1 * top,
        logarithmic: [false; 2],
        legend: SeriesLabelPosition::UpperRight,
    }
    .draw(
        path,
        &[
            Line::through("camera", 0, points),
            Line::points("peaks, fitted", 2, peaks.collect()),
            Line::points("impacts, fitted to the microphone", 1, impacts.collect()),
        ],
    )?;
    output::say_where("picture", path);
    Ok(())
}
