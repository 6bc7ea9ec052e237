//! Where the energy goes: the shares that the structure's damping, impacts and friction have in what
//! is lost, against frequency, for the paper's damper with 20 particles.
//!
//! `cargo run --release --example energy` leaves `target/energy/energy.csv` and `.svg`.

#[path = "support/chart.rs"]
mod chart;
#[path = "support/output.rs"]
mod output;

use std::error::Error;

use chart::{Chart, Line};
use particle_damper::excitation::Harmonic;
use particle_damper::{
    Damper, EnergyLedger, Filling, HertzTsuji, Material, Particle, SingleDof, Slot,
};
use plotters::prelude::SeriesLabelPosition;

type Failure = Box<dyn Error + Send + Sync>;

const TIME_STEP: f64 = 2e-5;
const SINKS: [&str; 5] = [
    "structure",
    "impacts of particles",
    "friction of particles",
    "impacts on walls",
    "friction on walls",
];

/// The account of `counted` periods at `frequency` (Hz), after as many that are discarded.
fn account(frequency: f64, counted: u32) -> Result<EnergyLedger, Failure> {
    let cavity = Slot::paper();
    let bed = Filling::new(1).with(20, Particle::new(3e-3, 0.2e-3)?);
    let force = Harmonic::new(0.25, frequency)?;
    let mut damper = Damper::builder(cavity, HertzTsuji::new(Material::acrylic()))
        .mount(SingleDof::paper().excited_by(force))
        .particles(bed.fill(&cavity)?)
        .time_step(TIME_STEP)
        .build()?;
    let steps = (f64::from(counted) / frequency / TIME_STEP).round() as u64;
    for _ in 0..steps {
        damper.step()?;
    }
    let mut ledger = EnergyLedger::new();
    for _ in 0..steps {
        damper.step_watched(&mut ledger)?;
    }
    Ok(ledger)
}

fn main() -> Result<(), Failure> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let (counted, points) = if quick { (4, 4) } else { (20, 32) };
    let mut rows = Vec::new();
    let mut lines = SINKS.map(|label| (label, Vec::new()));
    for point in 0..=points {
        let frequency = 4.0 + 4.0 * f64::from(point) / f64::from(points);
        let ledger = account(frequency, counted)?;
        let losses = ledger.losses();
        let sinks = [
            ledger.structure_loss(),
            losses.pair_normal,
            losses.pair_friction,
            losses.wall_normal,
            losses.wall_friction,
        ];
        let lost: f64 = sinks.iter().sum();
        let power = lost * frequency / f64::from(counted);
        let shares = sinks.map(|sink| 100.0 * sink / lost);
        for ((_, points), share) in lines.iter_mut().zip(shares) {
            points.push((frequency, share));
        }
        let shares = shares.map(|share| format!("{share:.3}")).join(",");
        let unaccounted = ledger.residual() / lost;
        let stepped = ledger.integration_loss() / lost;
        println!(
            "{frequency:5.3} Hz  {power:.3e} W  {shares} %  unaccounted {unaccounted:.1e}, \
             taken by the time step {stepped:.1e}"
        );
        rows.push(format!("{frequency},{power},{shares}"));
    }
    let directory = output::directory("energy")?;
    let columns = format!("frequency (Hz),lost (W),{} (%)", SINKS.join(" (%),"));
    output::write_table(&directory.join("energy.csv"), &columns, rows)?;
    let lines = lines
        .into_iter()
        .enumerate()
        .map(|(colour, (label, points))| Line {
            label: label.to_owned(),
            colour,
            dash: 0,
            marked: true,
            points,
        });
    let chart = Chart {
        title: "Where the energy goes",
        axes: ["frequency (Hz)", "share of the loss (%)"],
        x: 4.0..8.0,
        y: 0.0..100.0,
        logarithmic: [false, false],
        legend: SeriesLabelPosition::UpperRight,
    };
    let picture = directory.join("energy.svg");
    chart.draw(&picture, &lines.collect::<Vec<_>>())?;
    output::say_where("picture", &picture);
    Ok(())
}
