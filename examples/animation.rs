//! A moving picture of the bed over one period of its steady state, that any browser shows.
//!
//! The picture is a drawing with its motion written into it (SVG, SMIL): sharp at any size, a few
//! hundred kilobytes, and no library needed. A stroke on each particle shows how it turns.
//! `cargo run --release --example animation` leaves `target/animation/bed.svg`, and
//! the container's height in `container.csv`.

#![allow(clippy::print_stdout)]

#[path = "support/output.rs"]
mod output;

use std::error::Error;
use std::fmt::Write as _;
use std::fs;

use particle_damper::excitation::Harmonic;
use particle_damper::{Damper, Filling, Material, Particle, RestitutionImpulse, SingleDof, Slot};

type Failure = Box<dyn Error + Send + Sync>;

const FRAMES: usize = 60;
const FREQUENCY: f64 = 6.0; // Hz
/// Seconds that a period takes on the screen.
const SHOWN: f64 = 4.0;

/// One body over all frames, in mm: place on the picture, and angle in degrees.
#[derive(Default)]
struct Track {
    places: Vec<(f64, f64)>,
    angles: Vec<f64>,
}

impl Track {
    /// The motion as an element of SVG, around `drawing`.
    fn draw(&self, picture: &mut String, drawing: &str) {
        let animate = |kind: &str, values: &str| {
            format!(
                "<animateTransform attributeName=\"transform\" type=\"{kind}\" dur=\"{SHOWN}s\" \
                 repeatCount=\"indefinite\" values=\"{values}\"/>"
            )
        };
        let (mut places, mut angles) = (String::new(), String::new());
        for ((x, y), angle) in self.places.iter().zip(&self.angles) {
            let _ = write!(places, "{x:.2} {y:.2};");
            let _ = write!(angles, "{angle:.0};");
        }
        let (places, angles) = (animate("translate", &places), animate("rotate", &angles));
        // Where it is for a viewer that shows no motion.
        let (x, y) = self.places.first().copied().unwrap_or_default();
        let _ = writeln!(
            picture,
            "<g transform=\"translate({x:.2} {y:.2})\">{places}<g>{angles}{drawing}</g></g>"
        );
    }
}

fn main() -> Result<(), Failure> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let filling = Filling::new(3)
        .with(30, Particle::new(3e-3, 0.2e-3)?)
        .with(20, Particle::new(2e-3, 0.06e-3)?);
    let period = 1.0 / FREQUENCY;
    let steps = (period / FRAMES as f64 / 1e-4).ceil();
    let mut damper = Damper::builder(Slot::paper(), RestitutionImpulse::new(Material::acrylic()))
        .mount(SingleDof::paper().excited_by(Harmonic::new(0.25, FREQUENCY)?))
        .particles(filling.fill(&Slot::paper())?)
        .time_step(period / FRAMES as f64 / steps)
        .build()?;
    let before = if quick { 4 } else { 30 };
    for _ in 0..before * FRAMES * steps as usize {
        damper.step()?;
    }

    let mut tracks: Vec<Track> = Vec::new();
    tracks.resize_with(damper.len(), Track::default);
    let mut container = Track::default();
    for _ in 0..FRAMES {
        let y = damper
            .container(0)
            .map_or(0.0, |container| container.position.y);
        container.places.push((0.0, -1e3 * y));
        container.angles.push(0.0);
        for (track, particle) in tracks.iter_mut().zip(damper.particles()) {
            let place = particle.position * 1e3;
            track.places.push((place.x, -place.y));
            // Upwards on the screen is against its y.
            let turn = -particle.spin.z.to_degrees() * period / FRAMES as f64;
            let last = track.angles.last().copied().unwrap_or(0.0);
            track.angles.push(last + turn);
        }
        for _ in 0..steps as usize {
            damper.step()?;
        }
    }

    let mut picture = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-8 -128 76 160\" width=\"456\">\n\
         <rect x=\"-8\" y=\"-128\" width=\"76\" height=\"160\" fill=\"#fbfaf7\"/>\n",
    );
    let walls = "<rect y=\"-96\" width=\"60\" height=\"96\" fill=\"#eef2f6\" stroke=\"#33414e\" \
                 stroke-width=\"1\"/>";
    container.draw(&mut picture, walls);
    for (track, particle) in tracks.iter().zip(damper.particles()) {
        let r = 1e3 * particle.radius;
        let colour = if r > 2.5 { "#0072b2" } else { "#e69f00" };
        let ball = format!(
            "<circle r=\"{r}\" fill=\"{colour}\"/><path d=\"M0 0H{r}\" stroke=\"#fff\" \
             stroke-width=\"0.5\"/>"
        );
        track.draw(&mut picture, &ball);
    }
    picture.push_str("</svg>\n");
    let directory = output::directory("animation")?;
    let rows = container.places.iter().enumerate();
    let rows = rows.map(|(frame, (_, y))| format!("{:.3},{:.4}", frame as f64 / FRAMES as f64, -y));
    output::write_table(&directory.join("container.csv"), "period,height_mm", rows)?;
    let path = directory.join("bed.svg");
    fs::write(&path, picture)?;
    output::say_where("picture", &path);
    Ok(())
}
