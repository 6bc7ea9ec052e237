//! A large bed in a container that is shaken up and down, timed.
//!
//! `cargo run --release --example bed -- scene.txt --steps 25000` reads a start state: a first line
//! `DIM N WIDTH HEIGHT DEPTH DIAMETER DENSITY`, then `x y z vx vy vz wx wy wz` for each sphere (SI,
//! origin in a corner of the box, z = 0 if `DIM` is 2). Without a file it stacks spheres itself:
//! `--particles 1000000 --dimension 3 --before 500 --steps 100`. With the feature `rayon` a bed of more
//! than 4096 particles uses all cores (as many as `RAYON_NUM_THREADS` says).
//!
//! The whole container moves along y, against gravity, with 10 mm at 6 Hz, and starts from rest at its
//! lowest point, as LAMMPS's `wiggle` does: y = 10 mm (1 - cos(2 pi 6 Hz t)). Spheres are of
//! E = 0.4 GPa, nu = 0.3, mu = 0.2, e = 0.75; the time step is 20 microseconds, or `--time-step`: engines
//! are compared at steps that give a restitution as good (`restitution -- --as-good-as`).

use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{Parser, ValueEnum};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    Cavity, ContactLaw, Cuboid, Damper, Damping, Ending, HertzMindlin, HertzTsuji, LinkedCells,
    Material, Motion, Particle, Prescribed, RestitutionImpulse, Skin, Slot,
};

type Failure = Box<dyn Error>;

/// Frequency in Hz and amplitude in m of the container.
const FREQUENCY: f64 = 6.0;
const AMPLITUDE: f64 = 0.01;
const TIME_STEP: f64 = 2e-5;

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Law {
    /// Hertz contacts, friction with a tangential spring.
    Mindlin,
    /// Hertz contacts, sliding friction.
    Sliding,
    /// One impulse per contact and step.
    Impulse,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Dashpot {
    /// Grows with the square root of the overlap.
    Viscoelastic,
    /// Grows with its fourth root.
    Tsuji,
}

/// A shaken bed, timed.
#[derive(Debug, Parser)]
struct Options {
    /// Start state; without it spheres are stacked.
    scene: Option<PathBuf>,
    /// Particles of a box that is stacked.
    #[arg(long, default_value_t = 1000)]
    particles: usize,
    /// 2 for a box one particle deep, 3 for a cube.
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u8).range(2..=3))]
    dimension: u8,
    #[arg(long, value_enum, default_value_t = Law::Mindlin)]
    law: Law,
    #[arg(long, value_enum, default_value_t = Dashpot::Tsuji)]
    damping: Dashpot,
    /// Contacts pull the bodies back towards their end, as LAMMPS's do.
    #[arg(long)]
    pulling: bool,
    /// Steps that are taken before the clock starts.
    #[arg(long, default_value_t = 20)]
    before: u64,
    /// Steps that are timed.
    #[arg(long, default_value_t = 25_000)]
    steps: u64,
    /// Length of a step in s.
    #[arg(long, default_value_t = TIME_STEP)]
    time_step: f64,
    /// Skin of the neighbour lists in radii.
    #[arg(long, default_value_t = 1.0 / 3.0)]
    skin: f64,
    /// A hundred steps.
    #[arg(long)]
    quick: bool,
}

/// A box and the spheres in it.
struct Scene {
    planar: bool,
    size: DVec3,
    particles: Vec<Particle>,
}

impl Scene {
    fn read(path: &Path) -> Result<Self, Failure> {
        let text = fs::read_to_string(path)?;
        let mut rows = text.lines().map(|line| {
            let numbers = line.split_whitespace().map(str::parse);
            numbers.collect::<Result<Vec<f64>, _>>()
        });
        let head = rows.next().ok_or("an empty scene")??;
        let &[dimension, count, width, height, depth, diameter, density] = &head[..] else {
            return Err("DIM N WIDTH HEIGHT DEPTH DIAMETER DENSITY expected".into());
        };
        let sphere = Particle::with_density(0.5 * diameter, density)?;
        let particles = rows
            .map(|row| {
                let &[x, y, z, vx, vy, vz, wx, wy, wz] = &row?[..] else {
                    return Err(Failure::from("x y z vx vy vz wx wy wz expected"));
                };
                let sphere = sphere.at(dvec3(x, y, z)).moving(dvec3(vx, vy, vz));
                Ok(sphere.spinning(dvec3(wx, wy, wz)))
            })
            .collect::<Result<Vec<_>, _>>()?;
        if particles.len() != count as usize {
            return Err(format!("{count} spheres promised, {} found", particles.len()).into());
        }
        let planar = match dimension as u32 {
            2 => true,
            3 => false,
            _ => return Err(format!("2 or 3 dimensions expected, not {dimension}").into()),
        };
        Ok(Self {
            planar,
            size: dvec3(width, height, depth),
            particles,
        })
    }

    /// A box that `count` spheres fill to 60 %, stacked from the floor in rows that just do not touch.
    fn stacked(planar: bool, count: usize) -> Result<Self, Failure> {
        let sphere = Particle::new(3e-3, 2e-4)?;
        let diameter = 2.0 * sphere.radius;
        let volume = PI / 6.0 * diameter.powi(3);
        let size = if planar {
            (count as f64 / 100.0).sqrt() * dvec3(0.060, 0.096, 0.0)
        } else {
            DVec3::splat((count as f64 * volume / 0.36).cbrt())
        };
        let pitch = diameter * (1.0 + 1e-5);
        let layers = if planar { 1 } else { (size.z / pitch) as u32 };
        let rows = 0..(size.y / pitch * 1.15) as u32;
        let places = rows.flat_map(|row| {
            let shift = 0.5 * pitch * f64::from(1 + row % 2);
            let columns = ((size.x - shift - 0.5 * pitch) / pitch) as u32 + 1;
            let y = pitch * (0.5 + 0.75_f64.sqrt() * f64::from(row));
            (0..layers).flat_map(move |layer| {
                let z = if planar {
                    0.0
                } else {
                    pitch * (0.5 + f64::from(layer))
                };
                (0..columns).map(move |column| dvec3(shift + pitch * f64::from(column), y, z))
            })
        });
        let particles: Vec<_> = places.take(count).map(|place| sphere.at(place)).collect();
        if particles.len() < count {
            return Err(format!("{count} spheres do not fit into the box").into());
        }
        Ok(Self {
            planar,
            size,
            particles,
        })
    }
}

impl Options {
    fn run(&self) -> Result<(), Failure> {
        let scene = match &self.scene {
            Some(path) => Scene::read(path)?,
            None => Scene::stacked(self.dimension == 2, self.particles)?,
        };
        let (size, particles) = (scene.size, scene.particles);
        if scene.planar {
            self.shake_by_law(Slot::new(size.x, size.y)?, particles)
        } else {
            self.shake_by_law(Cuboid::new(size)?, particles)
        }
    }

    fn shake_by_law<C: Cavity>(&self, cavity: C, particles: Vec<Particle>) -> Result<(), Failure> {
        let damping = match self.damping {
            Dashpot::Viscoelastic => Damping::Viscoelastic,
            Dashpot::Tsuji => Damping::Tsuji,
        };
        let ending = if self.pulling {
            Ending::PullingAllowed
        } else {
            Ending::NeverPulling
        };
        let spheres = Material::acrylic();
        match self.law {
            Law::Mindlin => self.shake(
                cavity,
                HertzMindlin::new(spheres).damping(damping).ending(ending),
                particles,
            ),
            Law::Sliding => self.shake(
                cavity,
                HertzTsuji::new(spheres).damping(damping).ending(ending),
                particles,
            ),
            Law::Impulse => self.shake(cavity, RestitutionImpulse::new(spheres), particles),
        }
    }

    fn shake<C: Cavity, L: ContactLaw>(
        &self,
        cavity: C,
        law: L,
        particles: Vec<Particle>,
    ) -> Result<(), Failure> {
        let steps = if self.quick { 100 } else { self.steps };
        let count = particles.len() as f64;
        let shaken = |time: f64| {
            let (sine, cosine) = (TAU * FREQUENCY * time).sin_cos();
            Motion::at(
                AMPLITUDE * (1.0 - cosine) * DVec3::Y,
                TAU * FREQUENCY * AMPLITUDE * sine * DVec3::Y,
            )
        };
        let mut damper = Damper::builder(cavity, law)
            .mount(Prescribed(shaken))
            .detector(Skin::new(LinkedCells::new(), self.skin)?)
            .particles(particles)
            .time_step(self.time_step)
            .build()?;
        for _ in 0..self.before {
            damper.step()?;
        }
        let lists = damper.detections();
        let (mut contacts, mut work) = (0, 0.0);
        let start = Instant::now();
        for _ in 0..steps {
            damper.step()?;
            contacts += damper.contacts();
            let force = damper.reaction(0).unwrap_or_default().force;
            work -= force.y * shaken(damper.time()).velocity.y * self.time_step;
        }
        let seconds = start.elapsed().as_secs_f64();
        let (particle_steps, simulated) = (count * steps as f64, steps as f64 * self.time_step);
        let cycles = simulated * FREQUENCY;
        println!("particles              {count}");
        println!("steps                  {steps}");
        println!(
            "ns/particle/step       {:.2}",
            1e9 * seconds / particle_steps
        );
        println!(
            "ms/particle/second     {:.3}",
            1e3 * seconds / (count * simulated)
        );
        println!(
            "contacts/particle      {:.3}",
            contacts as f64 / particle_steps
        );
        println!("list rebuilds          {}", damper.detections() - lists);
        println!(
            "work/cycle             {:.4} mJ over {cycles:.2} cycles",
            1e3 * work / cycles
        );
        println!(
            "memory/particle        {:.0} B",
            damper.memory_bytes() as f64 / count
        );
        Ok(())
    }
}

fn main() -> Result<(), Failure> {
    Options::parse().run()
}
