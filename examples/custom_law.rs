//! A contact law of one's own, tried out on a ball that is thrown at a wall.
//!
//! The spring is stiffer when a contact opens than when it closes (Walton & Braun 1986,
//! doi 10.1122/1.549893): the restitution coefficient is the root of the ratio, at any speed. Beside
//! it the paper's strict law with both its dampings.
//! `cargo run --release --example custom_law` leaves `target/custom_law/restitution.csv` and `.svg`.

#![allow(clippy::print_stdout)]

#[path = "support/chart.rs"]
mod chart;
#[path = "support/output.rs"]
mod output;

use std::error::Error;

use chart::{Chart, Line};
use particle_damper::glam::DVec3;
use particle_damper::{
    Bodies, Contact, ContactForce, ContactLaw, Damper, Damping, HertzTsuji, LawError, Material,
    Particle, Slot,
};
use plotters::prelude::SeriesLabelPosition;

type Failure = Box<dyn Error + Send + Sync>;

struct WaltonBraun {
    loading: f64,   // N/m
    unloading: f64, // N/m, not less
}

impl ContactLaw for WaltonBraun {
    /// The longest time step in s.
    type Coefficients = f64;
    /// The greatest overlap so far in m.
    type Memory = f64;

    fn coefficients(&self, bodies: &Bodies) -> Result<f64, LawError> {
        Ok(0.1 * (bodies.effective_mass() / self.unloading).sqrt())
    }

    fn force(&self, _: &f64, contact: &Contact, deepest: &f64) -> ContactForce {
        let deepest = deepest.max(contact.overlap);
        let left = deepest * (1.0 - self.loading / self.unloading);
        let closing = self.loading * contact.overlap;
        let opening = self.unloading * (contact.overlap - left);
        ContactForce::new(closing.min(opening).max(0.0), DVec3::ZERO)
    }

    fn advance(&self, _: &f64, contact: &Contact, deepest: &f64) -> f64 {
        deepest.max(contact.overlap)
    }

    fn time_step_limit(&self, longest: &f64) -> f64 {
        *longest
    }
}

/// Speed after over speed before a ball meets a wall at `speed` (m/s).
fn restitution<L: ContactLaw>(law: L, speed: f64) -> Result<f64, Failure> {
    let ball = Particle::new(3e-3, 0.2e-3)?;
    let ball = ball.at(DVec3::new(3.01e-3, 0.03, 0.0));
    let mut damper = Damper::builder(Slot::paper(), law)
        .particles([ball.moving(DVec3::NEG_X * speed)])
        .gravity(DVec3::ZERO)
        .time_step(1e-6)
        .build()?;
    let gone = |ball: &Particle| ball.velocity.x > 0.0 && ball.position.x > 3.0e-3;
    loop {
        damper.step()?;
        if let Some(ball) = damper.particle(0).filter(gone) {
            return Ok(ball.velocity.x / speed);
        }
    }
}

fn main() -> Result<(), Failure> {
    let points = if std::env::args().any(|argument| argument == "--quick") {
        5
    } else {
        25
    };
    let names = [
        "Walton & Braun, k2/k1 = 3/2",
        "c d^(1/2) d'",
        "c d^(1/4) d'",
    ];
    let mut lines: Vec<Line> = Vec::new();
    for (colour, label) in names.into_iter().enumerate() {
        let (label, points) = (label.into(), Vec::new());
        lines.push(Line {
            label,
            colour,
            dash: 0,
            marked: true,
            points,
        });
    }
    let mut rows = Vec::new();
    for point in 0..points {
        let speed = 0.05 * 40_f64.powf(f64::from(point) / f64::from(points - 1));
        let spring = WaltonBraun {
            loading: 9e4,
            unloading: 13.5e4,
        };
        let strict = || HertzTsuji::new(Material::acrylic());
        let found = [
            restitution(spring, speed)?,
            restitution(strict().damping(Damping::Viscoelastic), speed)?,
            restitution(strict().damping(Damping::Tsuji), speed)?,
        ];
        rows.push(format!(
            "{speed:.4},{:.4},{:.4},{:.4}",
            found[0], found[1], found[2]
        ));
        for (line, e) in lines.iter_mut().zip(found) {
            line.points.push((speed, e));
        }
    }
    let directory = output::directory("custom_law")?;
    let columns = "speed_m_s,walton_braun,viscoelastic,tsuji";
    output::write_table(&directory.join("restitution.csv"), columns, rows)?;
    let path = directory.join("restitution.svg");
    Chart {
        title: "A ball of 3 mm thrown at a wall",
        axes: ["impact speed (m/s)", "restitution coefficient"],
        x: 0.045..2.2,
        y: 0.6..0.95,
        logarithmic: [true, false],
        legend: SeriesLabelPosition::UpperRight,
    }
    .draw(&path, &lines)?;
    output::say_where("picture", &path);
    Ok(())
}
