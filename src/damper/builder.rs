use glam::DVec3;

use super::block::BLOCK;
use super::clock::Clock;
use super::coefficients::Coefficients;
use super::engine::{Engine, MountState, Scratch};
use super::error::BuildError;
use super::particles::Particles;
use super::scene::{Room, WallLoad, World};
use super::setup::Setup;
use super::{Damper, smallest_radius};
use crate::cavity::Cavity;
use crate::detector::{Bed, Detector, LinkedCells, Skin};
use crate::error::Bound;
use crate::integrator::{Integrator, Stage, VelocityVerlet};
use crate::law::{ContactLaw, Evaluation};
use crate::material::{MaterialId, Materials};
use crate::mount::{Driven, Motion, Mount};
use crate::particle::Particle;

/// Overlaps up to this fraction of the smallest radius are taken for contacts of a settled bed.
const INITIAL_OVERLAP: f64 = 0.05;

/// Candidates without a skin are listed up to this fraction of the smallest radius, so that they
/// last over the stages of a step.
const STAGE_MARGIN: f64 = 0.05;

/// Puts a [`Damper`] together.
#[derive(Debug, Clone)]
#[must_use]
pub struct Builder<C, L, M = Driven, D = Skin<LinkedCells>, I = VelocityVerlet> {
    cavities: Vec<C>,
    law: L,
    mount: M,
    detector: D,
    integrator: I,
    gravity: DVec3,
    time_step: Option<f64>,
    wall_material: MaterialId,
    particles: Vec<Particle>,
    initial_overlap: f64,
    overlap_limit: f64,
    contained: bool,
}

impl<C, L> Builder<C, L> {
    pub(crate) fn new(cavity: C, law: L) -> Self {
        Self {
            cavities: vec![cavity],
            law,
            mount: Driven::default(),
            detector: Skin::default(),
            integrator: VelocityVerlet::default(),
            gravity: DVec3::NEG_Y * 9.81,
            time_step: None,
            wall_material: Materials::FIRST,
            particles: Vec::new(),
            initial_overlap: INITIAL_OVERLAP,
            overlap_limit: 1.0,
            contained: true,
        }
    }
}

impl<C, L, M, D, I> Builder<C, L, M, D, I> {
    /// What the container is mounted on.
    pub fn mount<N: Mount>(self, mount: N) -> Builder<C, L, N, D, I> {
        self.with(|parts| (mount, parts.1, parts.2))
    }

    /// How contacts are found. Every detector gives the same trajectory to the bit.
    pub fn detector<E: Detector>(self, detector: E) -> Builder<C, L, M, E, I> {
        self.with(|parts| (parts.0, detector, parts.2))
    }

    /// How time is integrated.
    pub fn integrator<J: Integrator>(self, integrator: J) -> Builder<C, L, M, D, J> {
        self.with(|parts| (parts.0, parts.1, integrator))
    }

    /// The same builder with other parts.
    fn with<N, E, J>(self, change: impl FnOnce((M, D, I)) -> (N, E, J)) -> Builder<C, L, N, E, J> {
        let (mount, detector, integrator) = change((self.mount, self.detector, self.integrator));
        Builder {
            cavities: self.cavities,
            law: self.law,
            mount,
            detector,
            integrator,
            gravity: self.gravity,
            time_step: self.time_step,
            wall_material: self.wall_material,
            particles: self.particles,
            initial_overlap: self.initial_overlap,
            overlap_limit: self.overlap_limit,
            contained: self.contained,
        }
    }

    /// One more cavity on the mount; particles name theirs ([`Particle::in_cavity`]).
    pub fn another_cavity(mut self, cavity: C) -> Self {
        self.cavities.push(cavity);
        self
    }

    /// Acceleration of gravity in m/s^2; 9.81 against y unless set.
    pub const fn gravity(mut self, gravity: DVec3) -> Self {
        self.gravity = gravity;
        self
    }

    /// Length of a step in s; half of what the law allows unless set.
    pub const fn time_step(mut self, time_step: f64) -> Self {
        self.time_step = Some(time_step);
        self
    }

    /// Material of the walls; the first of the law's table unless set.
    pub const fn walls_of(mut self, material: MaterialId) -> Self {
        self.wall_material = material;
        self
    }

    /// Adds particles, with positions in their container's frame.
    pub fn particles(mut self, particles: impl IntoIterator<Item = Particle>) -> Self {
        self.particles.extend(particles);
        self
    }

    /// Largest overlap at the start, as a fraction of the smallest radius; 0.05 unless set.
    pub const fn initial_overlap(mut self, fraction: f64) -> Self {
        self.initial_overlap = fraction;
        self
    }

    /// Overlap at which a step reports an error, as a fraction of the smallest radius; 1 unless set.
    pub const fn overlap_limit(mut self, fraction: f64) -> Self {
        self.overlap_limit = fraction;
        self
    }

    /// Whether a particle whose centre passes a wall is an error (the default), or merely
    /// [counted](Damper::outside).
    pub const fn contained(mut self, contained: bool) -> Self {
        self.contained = contained;
        self
    }
}

impl<C, L, M, D, I> Builder<C, L, M, D, I>
where
    C: Cavity,
    L: ContactLaw,
    M: Mount,
    D: Detector + Clone,
    I: Integrator,
{
    /// Checks everything, and builds the damper.
    ///
    /// # Errors
    /// A [`BuildError`] for the first thing that cannot be: it holds the value and the bound.
    pub fn build(mut self) -> Result<Damper<C, L, M, D, I>, BuildError> {
        self.check_numbers()?;
        self.check_particles()?;
        let numbers = self.order_by_cavity();
        let particles = Particles::new(&self.particles, numbers);
        let coefficients = Coefficients::new(&self.law, &particles.kinds, self.wall_material)?;
        let time_step = self.choose_time_step(coefficients.time_step_limit(&self.law)?)?;
        let smallest = smallest_radius(&particles.kinds);
        let reach = self.law.reach(time_step);
        let rooms = self.rooms(smallest);
        let walls = Engine::<C, L, M, D>::wall_count(&rooms);
        let mut engine = Engine {
            mount_state: MountState::new(&self.mount, rooms.len()),
            detectors: vec![self.detector; rooms.len()],
            mount: self.mount,
            gravity: self.gravity,
            blocks: Engine::<C, L, M, D>::make_blocks(particles.len(), walls),
            particles,
            scratch: Scratch::default(),
            wall_loads: vec![WallLoad::default(); walls],
            loads: vec![DVec3::ZERO; rooms.len()],
            world: World {
                law: self.law,
                coefficients,
                room_of_wall: room_of_wall(&rooms),
                rooms,
                reach,
                stamp: 0,
            },
            time: 0.0,
            detections: 0,
            overlap_limit: self.overlap_limit * smallest,
            contained: self.contained,
        };
        engine.start(self.initial_overlap * smallest)?;
        Ok(Damper {
            setup: Setup::new(&engine, time_step),
            engine,
            integrator: self.integrator,
            clock: Clock::default(),
            time_step,
        })
    }

    fn check_numbers(&self) -> Result<(), BuildError> {
        for component in self.gravity.to_array() {
            Bound::Finite.check("gravity (m/s^2)", component)?;
        }
        if let Some(time_step) = self.time_step {
            Bound::Positive.check("time step (s)", time_step)?;
        }
        Bound::NonNegative.check(
            "initial overlap (fraction of a radius)",
            self.initial_overlap,
        )?;
        if self.overlap_limit.is_nan() || self.overlap_limit <= 0.0 {
            Bound::Positive.check("overlap limit (fraction of a radius)", self.overlap_limit)?;
        }
        if self.cavities.iter().any(Cavity::is_planar) {
            in_plane("gravity", self.gravity)?;
        }
        Ok(())
    }

    fn check_particles(&self) -> Result<(), BuildError> {
        let limit = u32::MAX as usize - BLOCK;
        if self.particles.len() > limit {
            return Err(BuildError::TooManyParticles {
                count: self.particles.len(),
                limit,
            });
        }
        for (number, particle) in self.particles.iter().enumerate() {
            check_particle(particle).map_err(|error| BuildError::Particle {
                particle: number,
                error,
            })?;
            let Some(cavity) = self.cavities.get(particle.cavity as usize) else {
                return Err(BuildError::UnknownCavity {
                    particle: number,
                    cavity: particle.cavity,
                    cavities: self.cavities.len(),
                });
            };
            if cavity.is_planar() {
                in_plane("particle position", particle.position)?;
                in_plane("particle velocity", particle.velocity)?;
                for spin in [particle.spin.x, particle.spin.y] {
                    if spin != 0.0 {
                        return Err(BuildError::OutOfPlane {
                            quantity: "particle spin",
                            value: particle.spin,
                        });
                    }
                }
            }
            let [low, high] = cavity.bounds();
            let extent = high - low;
            let room = if cavity.is_planar() {
                extent.x.min(extent.y)
            } else {
                extent.min_element()
            };
            if 2.0 * particle.radius > room {
                return Err(BuildError::TooLarge {
                    particle: number,
                    diameter: 2.0 * particle.radius,
                    room,
                });
            }
        }
        Ok(())
    }

    /// Orders the particles by cavity; returns their numbers.
    fn order_by_cavity(&mut self) -> Vec<u32> {
        let mut numbers: Vec<u32> = (0..self.particles.len() as u32).collect();
        numbers.sort_by_key(|number| self.particles[*number as usize].cavity);
        self.particles = numbers
            .iter()
            .map(|number| self.particles[*number as usize])
            .collect();
        numbers
    }

    fn choose_time_step(&self, limit: f64) -> Result<f64, BuildError> {
        match self.time_step {
            Some(time_step) if time_step > limit => {
                Err(BuildError::TimeStepTooLong { time_step, limit })
            }
            Some(time_step) => Ok(time_step),
            None if limit.is_finite() => Ok(0.5 * limit),
            None => Err(BuildError::NoTimeStep),
        }
    }

    fn rooms(&mut self, smallest_radius: f64) -> Vec<Room<C>> {
        let margin = if smallest_radius.is_finite() {
            let skin = self.detector.skin(smallest_radius);
            skin.max(STAGE_MARGIN * smallest_radius)
        } else {
            0.0
        };
        let (mut slot, mut wall) = (0, 0);
        let mut rooms = Vec::new();
        for (number, cavity) in std::mem::take(&mut self.cavities).into_iter().enumerate() {
            let own = |particle: &&Particle| particle.cavity as usize == number;
            let end = slot + self.particles.iter().filter(own).count();
            let walls = cavity.walls();
            rooms.push(Room {
                cavity,
                slots: slot..end,
                first_wall: wall,
                motion: Motion::default(),
                margin,
            });
            slot = end;
            wall += walls;
        }
        rooms
    }
}

/// Number of the room of each wall.
fn room_of_wall<C: Cavity>(rooms: &[Room<C>]) -> Vec<u32> {
    let rooms = rooms.iter().zip(0..);
    rooms
        .flat_map(|(room, number)| (0..room.cavity.walls()).map(move |_| number))
        .collect()
}

fn check_particle(particle: &Particle) -> Result<(), crate::ValueError> {
    Bound::Positive.check("radius (m)", particle.radius)?;
    Bound::Positive.check("mass (kg)", particle.mass)?;
    for (quantity, vector) in [
        ("position (m)", particle.position),
        ("velocity (m/s)", particle.velocity),
        ("spin (rad/s)", particle.spin),
    ] {
        for component in vector.to_array() {
            Bound::Finite.check(quantity, component)?;
        }
    }
    Ok(())
}

fn in_plane(quantity: &'static str, value: DVec3) -> Result<(), BuildError> {
    if value.z == 0.0 {
        Ok(())
    } else {
        Err(BuildError::OutOfPlane { quantity, value })
    }
}

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Places the containers and the particles in them, refuses overlaps of more than `allowed` (m),
    /// and evaluates the first accelerations.
    fn start(&mut self, allowed: f64) -> Result<(), BuildError> {
        for room in &self.world.rooms {
            if room.cavity.is_planar() {
                // A mount that leaves the plane shows it in how it yields.
                let mobility = self.mount.mobility(0);
                in_plane("axis of the mount", mobility.z_axis + mobility.row(2))?;
            }
        }
        self.place_containers(0.0)?;
        for (room, detector) in self.world.rooms.iter().zip(&mut self.detectors) {
            if room.cavity.is_planar() {
                in_plane("position of the container", room.motion.position)?;
                in_plane("velocity of the container", room.motion.velocity)?;
            }
            let slots = room.slots.clone();
            let bed = Bed::new(
                &self.particles.position[slots.clone()],
                &self.particles.radius[slots],
                room.cavity.bounds(),
            )
            .in_plane(room.cavity.is_planar())
            .with_margin(room.margin + self.world.reach);
            detector.prepare(&bed)?;
        }
        for room in &self.world.rooms {
            for position in &mut self.particles.position[room.slots.clone()] {
                *position += room.motion.position;
            }
        }
        self.find_contacts(true)?;
        self.check_initial_overlaps(allowed)?;
        if self.world.law.evaluation() == Evaluation::EveryStage {
            self.evaluate(0.0, 0.0, Stage::Trial, false, &mut ())?;
        } else {
            self.accelerate_mount(0.0);
        }
        Ok(())
    }

    fn check_initial_overlaps(&self, limit: f64) -> Result<(), BuildError> {
        let scene = self.world.scene(&self.particles, 0.0);
        for touch in self.blocks.iter().flat_map(|block| block.touching().0) {
            let (first, second) = (touch.first as usize, touch.second as usize);
            let overlap = scene.pair(first, second).contact.overlap;
            if overlap > limit {
                return Err(BuildError::InitialOverlap {
                    first: self.particles.number[first] as usize,
                    second: self.particles.number[second] as usize,
                    overlap,
                    limit,
                });
            }
        }
        for touch in self.blocks.iter().flat_map(|block| block.touching().1) {
            let (slot, wall) = (touch.first as usize, touch.second);
            let room = scene.room_of_wall(wall);
            let overlap = scene.wall_overlap(slot, wall);
            if overlap > limit {
                return Err(BuildError::OutsideCavity {
                    particle: self.particles.number[slot] as usize,
                    position: self.particles.position[slot] - room.motion.position,
                    wall: wall - room.first_wall,
                    overlap,
                    limit,
                });
            }
        }
        Ok(())
    }
}
