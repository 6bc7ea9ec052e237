//! A mount of one's own: a cantilever reduced to its first three modes, with dampers at its tip.
//!
//! Free decay with the grains loose in one cavity, loose in two cavities of half the width (a
//! multi-unit damper, after Saeki 2005), and with their weight fixed.
//! `cargo run --release --example beam` leaves `target/beam/beam.csv`, `decay.svg` and `loss.svg`.

#![allow(clippy::print_stdout)]

#[path = "support/chart.rs"]
mod chart;
#[path = "support/output.rs"]
mod output;

use std::error::Error;

use chart::{Chart, Line};
use particle_damper::glam::DVec3;
use particle_damper::{
    Damper, Filling, Load, Material, Motion, Mount, Particle, RestitutionImpulse, Slot,
};
use plotters::prelude::SeriesLabelPosition;

type Failure = Box<dyn Error + Send + Sync>;

const MODES: usize = 3;
const GRAINS: usize = 60;
const GRAIN: f64 = 0.2e-3; // kg

/// A cantilever in its first modes, scaled so that each modal mass is 1 kg: then every mode has the
/// same size at the tip, 2 over the square root of the beam's mass.
struct Beam {
    omega: [f64; MODES], // rad/s
    tip: [f64; MODES],   // 1/sqrt(kg)
    damping: f64,        // of critical
    load: f64,           // mass fixed to the tip, kg
    release: f64,        // displacement of the tip at the start, m
}

impl Beam {
    /// A steel strip of 400 x 50 x 3 mm.
    fn steel(load: f64, release: f64) -> Self {
        let (length, width, height) = (0.4, 0.05, 3e-3_f64);
        let mass: f64 = 7850.0 * length * width * height;
        let bending = 210e9 * width * height.powi(3) / 12.0;
        let frequency = |b: f64| b * b * (bending / (mass * length.powi(3))).sqrt();
        let tip = 2.0 / mass.sqrt();
        Self {
            omega: [1.875_104, 4.694_091, 7.854_757].map(frequency),
            tip: [tip, -tip, tip],
            damping: 5e-4,
            load,
            release,
        }
    }

    fn at_tip(&self, modes: &[f64]) -> f64 {
        self.tip
            .iter()
            .zip(modes)
            .map(|(tip, mode)| tip * mode)
            .sum()
    }
}

impl Mount for Beam {
    fn degrees(&self) -> usize {
        MODES
    }

    fn start(&self, coordinates: &mut [f64], _velocities: &mut [f64]) {
        coordinates[0] = self.release / self.tip[0];
    }

    fn motion(&self, _time: f64, q: &[f64], v: &[f64], _cavity: usize) -> Motion {
        Motion::at(DVec3::Y * self.at_tip(q), DVec3::Y * self.at_tip(v))
    }

    fn accelerate(&self, _time: f64, q: &[f64], v: &[f64], loads: &[Load], a: &mut [f64]) {
        let force: f64 = loads.iter().map(|load| load.force.y).sum();
        for (n, omega) in self.omega.iter().enumerate() {
            let spring = omega * omega * q[n] + 2.0 * self.damping * omega * v[n];
            a[n] = self.tip[n] * force - spring;
        }
        // The load's inertia, a force on the tip like any other.
        let bare: f64 = self.tip.iter().map(|tip| tip * tip).sum();
        let inertia = self.load * self.at_tip(a) / (1.0 + self.load * bare);
        for (n, tip) in self.tip.iter().enumerate() {
            a[n] -= tip * inertia;
        }
    }

    fn highest_frequency(&self) -> f64 {
        self.omega[MODES - 1] / std::f64::consts::TAU
    }
}

/// The displacement of the tip (m) over time (s), with `units` cavities of loose grains.
fn decay(units: usize, duration: f64) -> Result<Vec<(f64, f64)>, Failure> {
    let fixed = if units == 0 {
        GRAIN * GRAINS as f64
    } else {
        0.0
    };
    let cavity = Slot::new(0.096 / units.max(1) as f64, 0.06)?;
    let law = RestitutionImpulse::new(Material::acrylic());
    let mut builder = Damper::builder(cavity, law)
        .mount(Beam::steel(0.05 + fixed, 0.02))
        .time_step(1e-4);
    for unit in 0..units {
        let grain = Particle::new(3e-3, GRAIN)?.in_cavity(unit as u32);
        let filling = Filling::new(1).with(GRAINS / units, grain);
        builder = builder.particles(filling.fill(&cavity)?);
        if unit > 0 {
            builder = builder.another_cavity(cavity);
        }
    }
    let mut damper = builder.build()?;
    let mut record = Vec::new();
    while damper.time() < duration {
        damper.step()?;
        let tip = damper.container(0).unwrap_or_default();
        record.push((damper.time(), tip.position.y));
    }
    Ok(record)
}

/// Amplitude (half of peak to peak, mm) and loss factor of each swing: the logarithmic decrement
/// over pi.
fn loss_factors(record: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut swings = Vec::new();
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    for pair in record.windows(2) {
        if pair[0].1 < 0.0 && pair[1].1 >= 0.0 {
            swings.push(0.5e3 * (high - low));
            (low, high) = (0.0, 0.0);
        }
        low = low.min(pair[1].1);
        high = high.max(pair[1].1);
    }
    // Over as many swings as it takes to lose a tenth, so that higher modes and single clashes do not
    // show.
    let lost = |(n, first): (usize, &f64)| {
        let later = swings
            .iter()
            .skip(n)
            .position(|swing| *swing < 0.9 * first)?;
        let last = swings[n + later];
        let decrement = (first / last).ln() / (later as f64 * std::f64::consts::PI);
        Some(((first * last).sqrt(), decrement))
    };
    swings.iter().enumerate().skip(1).filter_map(lost).collect()
}

fn main() -> Result<(), Failure> {
    let duration = if std::env::args().any(|argument| argument == "--quick") {
        1.0
    } else {
        4.0
    };
    let (mut decays, mut losses, mut rows) = (Vec::new(), Vec::new(), Vec::new());
    for (units, label) in [(0, "weight fixed"), (1, "one cavity"), (2, "two cavities")] {
        let record = decay(units, duration)?;
        let loss = loss_factors(&record);
        let greatest = loss
            .iter()
            .fold((0.0, 0.0), |a, b| if b.1 > a.1 { *b } else { a });
        println!(
            "{label:13} greatest loss factor {:.4} at {:.2} mm",
            greatest.1, greatest.0
        );
        rows.extend(
            loss.iter()
                .map(|(a, eta)| format!("{units},{a:.5},{eta:.6}")),
        );
        let line = |points, marked| Line {
            label: label.into(),
            colour: units,
            dash: 0,
            marked,
            points,
        };
        let shown = record.iter().step_by(10).map(|(t, y)| (*t, 1e3 * y));
        decays.push(line(shown.collect(), false));
        losses.push(line(loss, false));
    }
    let directory = output::directory("beam")?;
    output::write_table(
        &directory.join("beam.csv"),
        "units,amplitude_mm,loss_factor",
        rows,
    )?;
    for (name, axes, x, y, logarithmic, lines) in [
        (
            "decay.svg",
            ["time t (s)", "tip (mm)"],
            0.0..duration,
            -21.0..21.0,
            [false; 2],
            &decays,
        ),
        (
            "loss.svg",
            ["amplitude (mm)", "loss factor"],
            1.0..25.0,
            5e-4..0.1,
            [true; 2],
            &losses,
        ),
    ] {
        let path = directory.join(name);
        Chart {
            title: "Free decay of a cantilever with 60 grains at its tip",
            axes,
            x,
            y,
            logarithmic,
            legend: SeriesLabelPosition::LowerMiddle,
        }
        .draw(&path, lines)?;
        output::say_where("picture", &path);
    }
    Ok(())
}
