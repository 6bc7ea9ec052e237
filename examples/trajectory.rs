//! Every particle's way through a shaken box, for other programs: a table, and a series of VTK files
//! that `ParaView` opens (glyphs of type sphere, scaled by the radius).
//!
//! A recorder watches from outside: the loop knows nothing of files.
//! `cargo run --release --example trajectory` leaves `target/trajectory/trajectory.csv` and
//! `bed_0000.vtk` and so on.

#![allow(clippy::print_stdout)]

#[path = "support/output.rs"]
mod output;

use std::error::Error;
use std::f64::consts::TAU;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    Cuboid, Damper, Filling, Material, Motion, Observer, Particle, Prescribed, RestitutionImpulse,
    StepReport,
};

type Failure = Box<dyn Error + Send + Sync>;

/// Keeps the bed every so often.
struct Recorder {
    interval: f64, // s
    frames: Vec<(f64, Vec<Particle>)>,
}

impl Observer for Recorder {
    fn step(&mut self, report: &StepReport<'_>) {
        // Half a step of tolerance, for the rounding of the time.
        let due = self.frames.len() as f64 * self.interval - 0.5 * report.time_step();
        if report.time() >= due {
            self.frames
                .push((report.time(), report.particles().collect()));
        }
    }
}

/// One vector a line.
fn write_vectors(
    file: &mut impl Write,
    bed: &[Particle],
    of: impl Fn(&Particle) -> DVec3,
) -> io::Result<()> {
    bed.iter().try_for_each(|particle| {
        let [x, y, z] = of(particle).to_array();
        writeln!(file, "{x:e} {y:e} {z:e}")
    })
}

/// One bed as points with radius, velocity and spin, in the legacy format of VTK (The VTK User's Guide,
/// "VTK File Formats").
fn write_vtk(path: &Path, time: f64, bed: &[Particle]) -> io::Result<()> {
    let count = bed.len();
    let mut file = BufWriter::new(File::create(path)?);
    writeln!(file, "# vtk DataFile Version 3.0\nparticles at {time:.4} s")?;
    writeln!(file, "ASCII\nDATASET POLYDATA\nPOINTS {count} double")?;
    write_vectors(&mut file, bed, |particle| particle.position)?;
    writeln!(file, "VERTICES {count} {}", 2 * count)?;
    for number in 0..count {
        writeln!(file, "1 {number}")?;
    }
    writeln!(file, "POINT_DATA {count}")?;
    writeln!(file, "SCALARS radius double 1\nLOOKUP_TABLE default")?;
    for particle in bed {
        writeln!(file, "{:e}", particle.radius)?;
    }
    writeln!(file, "VECTORS velocity double")?;
    write_vectors(&mut file, bed, |particle| particle.velocity)?;
    writeln!(file, "VECTORS spin double")?;
    write_vectors(&mut file, bed, |particle| particle.spin)?;
    file.flush()
}

fn main() -> Result<(), Failure> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let cavity = Cuboid::new(dvec3(0.04, 0.05, 0.04))?;
    let filling = Filling::new(1)
        .with(120, Particle::new(2e-3, 0.06e-3)?)
        .with(30, Particle::new(3e-3, 0.2e-3)?);
    let (amplitude, omega) = (4e-3, TAU * 12.0);
    let shaken = Prescribed(move |time: f64| {
        Motion::at(
            DVec3::Y * amplitude * (omega * time).sin(),
            DVec3::Y * amplitude * omega * (omega * time).cos(),
        )
    });
    let mut damper = Damper::builder(cavity, RestitutionImpulse::new(Material::acrylic()))
        .mount(shaken)
        .particles(filling.fill(&cavity)?)
        .time_step(1e-4)
        .build()?;
    let mut recorder = Recorder {
        interval: 5e-3,
        frames: Vec::new(),
    };
    for _ in 0..if quick { 1000 } else { 10_000 } {
        damper.step_watched(&mut recorder)?;
    }

    let directory = output::directory("trajectory")?;
    let rows = recorder.frames.iter().flat_map(|(time, bed)| {
        let row = move |(n, particle): (usize, &Particle)| {
            let [x, y, z] = particle.position.to_array();
            let [u, v, w] = particle.velocity.to_array();
            let radius = particle.radius;
            format!("{time:.4},{n},{radius},{x:.6},{y:.6},{z:.6},{u:.5},{v:.5},{w:.5}")
        };
        bed.iter().enumerate().map(row)
    });
    let heading = "time_s,particle,radius_m,x_m,y_m,z_m,u_m_s,v_m_s,w_m_s";
    output::write_table(&directory.join("trajectory.csv"), heading, rows)?;
    for (number, (time, bed)) in recorder.frames.iter().enumerate() {
        write_vtk(&directory.join(format!("bed_{number:04}.vtk")), *time, bed)?;
    }
    output::say_where("series", &directory.join("bed_0000.vtk"));
    Ok(())
}
