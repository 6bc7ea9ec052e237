//! Contact laws of one's own, one of each kind, tried out on a ball that is thrown at a wall.
//!
//! A force law: the spring is stiffer when a contact opens than when it closes (Walton & Braun 1986,
//! doi 10.1122/1.549893), and the restitution coefficient is the root of the ratio, at any speed. An
//! impulse law: restitution falls as v^(-1/4), as that of metals does once they yield (Johnson, Contact
//! Mechanics, 1985, Eq. 11.47). Beside them the paper's strict law with both its dampings, and the coarse
//! law that follows viscoelastic damping.
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
    Bodies, Contact, ContactForce, ContactLaw, Damper, Damping, ForceLaw, Forces, HertzTsuji,
    ImpulseLaw, Impulses, LawError, Material, Particle, RestitutionImpulse, Slot,
};
use plotters::prelude::SeriesLabelPosition;

type Failure = Box<dyn Error + Send + Sync>;

struct WaltonBraun {
    loading: f64,   // N/m
    unloading: f64, // N/m, not less
}

impl ContactLaw for WaltonBraun {
    type Kind = Forces;
    /// The longest time step in s.
    type Coefficients = f64;

    fn coefficients(&self, bodies: &Bodies) -> Result<f64, LawError> {
        Ok(0.1 * (bodies.effective_mass() / self.unloading).sqrt())
    }

    fn time_step_limit(&self, longest: &f64) -> f64 {
        *longest
    }
}

impl ForceLaw for WaltonBraun {
    /// The greatest overlap so far in m.
    type Memory = f64;

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
}

struct Yielding {
    restitution: f64, // at 1 m/s
}

impl ContactLaw for Yielding {
    type Kind = Impulses;
    /// The longest time step in s: a tenth of a radius at 1 m/s.
    type Coefficients = f64;

    fn coefficients(&self, bodies: &Bodies) -> Result<f64, LawError> {
        Ok(0.1 * bodies.first.radius.min(bodies.second.radius))
    }

    fn time_step_limit(&self, longest: &f64) -> f64 {
        *longest
    }
}

impl ImpulseLaw for Yielding {
    fn restitution(&self, _: &f64, approach_speed: f64) -> f64 {
        (self.restitution * approach_speed.powf(-0.25)).min(1.0)
    }
}

/// Speed after over speed before a ball meets a wall at `speed` (m/s), in steps of `time_step` (s).
fn restitution<L: ContactLaw>(law: L, time_step: f64, speed: f64) -> Result<f64, Failure> {
    let ball = Particle::new(3e-3, 0.2e-3)?;
    let ball = ball.at(DVec3::new(3.01e-3, 0.03, 0.0));
    let mut damper = Damper::builder(Slot::paper(), law)
        .particles([ball.moving(DVec3::NEG_X * speed)])
        .gravity(DVec3::ZERO)
        .time_step(time_step)
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
        "yielding, impulses",
        "as c d^(1/2) d', impulses",
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
        let (fine, coarse) = (1e-6, 1e-4);
        let yielding = Yielding { restitution: 0.68 };
        let viscoelastic = RestitutionImpulse::viscoelastic(Material::acrylic());
        let found = [
            restitution(spring, fine, speed)?,
            restitution(strict().damping(Damping::Viscoelastic), fine, speed)?,
            restitution(strict().damping(Damping::Tsuji), fine, speed)?,
            restitution(yielding, coarse, speed)?,
            restitution(viscoelastic, coarse, speed)?,
        ];
        let columns = found.map(|e| format!(",{e:.4}")).concat();
        rows.push(format!("{speed:.4}{columns}"));
        for (line, e) in lines.iter_mut().zip(found) {
            line.points.push((speed, e));
        }
    }
    let directory = output::directory("custom_law")?;
    let columns = "speed_m_s,walton_braun,viscoelastic,tsuji,yielding,coarse_viscoelastic";
    output::write_table(&directory.join("restitution.csv"), columns, rows)?;
    let path = directory.join("restitution.svg");
    Chart {
        title: "A ball of 3 mm thrown at a wall",
        axes: ["impact speed (m/s)", "restitution coefficient"],
        x: 0.045..2.2,
        y: 0.55..1.0,
        logarithmic: [true, false],
        legend: SeriesLabelPosition::UpperRight,
    }
    .draw(&path, &lines)?;
    output::say_where("picture", &path);
    Ok(())
}
