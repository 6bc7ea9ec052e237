//! The engine: everything of a damper but its integrator. It keeps the candidates fresh and turns
//! the state into accelerations.

use glam::{DMat3, DVec3};

use super::block::{Block, Memories, Place, block_size, room_for};
use super::cause::Begin;
use super::chunk::Moment;
use super::contact_dynamics::ContactSolver;
use super::error::StepError;
use super::particles::Particles;
use super::scene::{Room, Scene, WallLoad, World};
use super::vectors::Vectors;
use crate::cavity::Cavity;
use crate::detector::{Detector, Pairs};
use crate::integrator::Stage;
use crate::law::{ContactLaw, ForceLaw, ImpulseLaw, LawKind, LawVisitor};
use crate::mount::{self, Motion, Mount};
use crate::observer::{Observable, Observer};
use crate::parallel::{Pool, for_each};

/// Coordinates of the mount, followed by three per cavity whose velocity sums up the impulse on its
/// container. Integrating them along with the rest makes that impulse exactly the momentum that the
/// particles lost, whatever the integrator.
#[derive(Debug, Clone, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct MountState {
    pub(crate) position: Vec<f64>,
    pub(crate) velocity: Vec<f64>,
    pub(crate) acceleration: Vec<f64>,
}

impl MountState {
    pub(crate) fn new<M: Mount>(mount: &M, cavities: usize) -> Self {
        let degrees = mount.degrees();
        let mut state = Self {
            position: vec![0.0; degrees + 3 * cavities],
            velocity: vec![0.0; degrees + 3 * cavities],
            acceleration: vec![0.0; degrees + 3 * cavities],
        };
        mount.start(
            &mut state.position[..degrees],
            &mut state.velocity[..degrees],
        );
        state
    }
}

/// What stays between steps only to save work.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scratch {
    pub(crate) proposals: Pairs,
    /// Proposals by their lower slot: ends of the rows, and the higher slots.
    pub(crate) rows: Vec<u32>,
    pub(crate) partners: Vec<u32>,
    /// Where each particle was in its container's frame when the candidates were listed.
    pub(crate) reference: Vectors,
    /// The same while candidates are listed, for detectors.
    pub(crate) local: Vec<DVec3>,
    /// Whether the candidates may still be used.
    pub(crate) listed: bool,
    /// Accelerations and angular accelerations as the evaluation before the last left them. The next
    /// one sums up forces there, and they change places.
    pub(crate) previous: [Vectors; 2],
    /// The same of the mount's coordinates.
    pub(crate) previous_of_mount: Vec<f64>,
}

impl Scratch {
    /// Scratch for a bed of `particles` and for `coordinates` of the mount.
    pub(crate) fn new(particles: &Particles, coordinates: usize) -> Self {
        let room = room_for(particles.len());
        let mut scratch = Self {
            reference: particles.position.clone(),
            previous: [
                particles.acceleration.clone(),
                particles.angular_acceleration.clone(),
            ],
            previous_of_mount: vec![0.0; coordinates],
            ..Self::default()
        };
        scratch.proposals.reserve(room);
        scratch.partners.reserve(room);
        scratch
    }

    /// Memory in bytes that it has reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        size_of::<DVec3>() * self.local.capacity()
            + size_of::<u32>() * (self.rows.capacity() + self.partners.capacity())
            + self.reference.reserved_bytes()
            + self
                .previous
                .each_ref()
                .map(Vectors::reserved_bytes)
                .iter()
                .sum::<usize>()
            + self.proposals.reserved_bytes()
    }
}

/// A damper without its integrator.
#[derive(Debug, Clone)]
pub(crate) struct Engine<C, L: ContactLaw, M, D> {
    pub(crate) world: World<C, L>,
    pub(crate) mount: M,
    pub(crate) gravity: DVec3,
    pub(crate) detectors: Vec<D>,
    pub(crate) particles: Particles,
    pub(crate) mount_state: MountState,
    pub(crate) blocks: Vec<Block<L>>,
    pub(crate) scratch: Scratch,
    /// What contacts of a block remember while they are listed anew.
    pub(crate) memories: Pool<Memories<L>>,
    /// What impulses are worked out with; none under a force law.
    pub(crate) solver: Option<ContactSolver>,
    /// Loads of the particles on each wall, all cavities in turn.
    pub(crate) wall_loads: Vec<WallLoad>,
    /// Forces of the particles on each container.
    pub(crate) loads: Vec<DVec3>,
    pub(crate) time: f64,
    /// How the step began.
    pub(crate) begin: Begin,
    pub(crate) detections: u64,
    /// Steps since a large bed was sorted.
    pub(crate) since_sort: u32,
    pub(crate) overlap_limit: f64,
    pub(crate) contained: bool,
}

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// How many walls all cavities have.
    pub(crate) fn wall_count(rooms: &[Room<C>]) -> usize {
        rooms.iter().map(|room| room.cavity.walls() as usize).sum()
    }

    /// Blocks for `count` slots.
    pub(crate) fn make_blocks(count: usize, walls: usize) -> Vec<Block<L>> {
        let size = block_size(count);
        (0..count)
            .step_by(size)
            .map(|start| Block::new(start..count.min(start + size), walls))
            .collect()
    }

    /// Moves the containers to where the mount has them at `time`.
    pub(crate) fn place_containers(&mut self, time: f64) -> Result<(), StepError> {
        let degrees = self.mount.degrees();
        let coordinates = &self.mount_state.position[..degrees];
        let velocities = &self.mount_state.velocity[..degrees];
        let mut both = coordinates.iter().zip(velocities);
        if let Some(coordinate) = both.position(|(x, v)| !(x.is_finite() && v.is_finite())) {
            return Err(StepError::Mount {
                coordinate,
                value: coordinates[coordinate],
                rate: velocities[coordinate],
            });
        }
        for (cavity, room) in self.world.rooms.iter_mut().enumerate() {
            let Motion { position, velocity } =
                self.mount.motion(time, coordinates, velocities, cavity);
            if !(position.is_finite() && velocity.is_finite()) {
                return Err(StepError::Container {
                    cavity,
                    position,
                    velocity,
                });
            }
            if room.cavity.is_planar() && (position.z != 0.0 || velocity.z != 0.0) {
                return Err(StepError::OutOfPlane {
                    cavity,
                    position,
                    velocity,
                });
            }
            room.motion = Motion { position, velocity };
        }
        Ok(())
    }

    /// Refuses positions that are not finite.
    pub(crate) fn check_finite(&self) -> Result<(), StepError> {
        let bad = self
            .particles
            .position
            .iter()
            .position(|position| !position.is_finite());
        bad.map_or(Ok(()), |slot| Err(self.not_finite(slot)))
    }

    fn not_finite(&self, slot: usize) -> StepError {
        StepError::NotFinite {
            particle: self.particles.number[slot] as usize,
            position: self.particles.position.get(slot),
            acceleration: self.particles.acceleration.get(slot),
        }
    }

    /// Forces of a stiff law: evaluates the contacts, and turns forces into accelerations.
    fn evaluate_contacts<O: Observer, const END: bool>(
        &mut self,
        moment: Moment,
        observer: &mut O,
    ) -> Result<(), StepError>
    where
        L: ForceLaw,
    {
        let [mut force, mut torque] = std::mem::take(&mut self.scratch.previous);
        let scene = Scene {
            moment,
            ..self.world.scene(&self.particles, moment.elapsed)
        };
        let widths = (force.width(), torque.width());
        let sums = (force.flat_mut(), torque.flat_mut());
        let gravity = self.gravity;
        let mut finite = true;
        if END && observer.wants_contacts() {
            let (mut forces, mut torques) = sums;
            for block in &mut self.blocks {
                let (force, torque);
                (force, forces) = forces.split_at_mut(widths.0 * block.slots.len());
                (torque, torques) = torques.split_at_mut(widths.1 * block.slots.len());
                finite &= block.evaluate::<C, O, END>(&scene, gravity, (force, torque), observer);
            }
        } else {
            let split = |(forces, torques), blocks: &[Block<L>]| {
                let count: usize = blocks.iter().map(|block| block.slots.len()).sum();
                let (force, forces) = <[f64]>::split_at_mut(forces, widths.0 * count);
                let (torque, torques) = <[f64]>::split_at_mut(torques, widths.1 * count);
                ((force, torque), (forces, torques))
            };
            finite = for_each(&mut self.blocks, sums, &split, &|block, sums| {
                block.evaluate::<C, (), END>(&scene, gravity, sums, &mut ())
            });
        }
        for parcel in self.blocks.iter().flat_map(|block| &block.parcels) {
            let slot = parcel.slot as usize;
            let gain = parcel.force * self.particles.inverse_mass[slot];
            let turn = parcel.torque * self.particles.inverse_inertia[slot];
            let (gain, turn) = (force.get(slot) + gain, torque.get(slot) + turn);
            finite &= gain.is_finite() && turn.is_finite();
            force.set(slot, gain);
            torque.set(slot, turn);
        }
        let particles = &mut self.particles;
        self.scratch.previous = [
            std::mem::replace(&mut particles.acceleration, force),
            std::mem::replace(&mut particles.angular_acceleration, torque),
        ];

        self.wall_loads.fill(WallLoad::default());
        for block in &self.blocks {
            for (total, load) in self.wall_loads.iter_mut().zip(&block.loads) {
                total.add(load);
            }
        }
        if !finite {
            self.check_accelerations()?;
        }
        self.check_overlaps()
    }

    pub(crate) fn check_accelerations(&self) -> Result<(), StepError> {
        let particles = &self.particles;
        let turning = particles.angular_acceleration.iter();
        let mut both = particles.acceleration.iter().zip(turning);
        let bad = both.position(|(a, turning)| !(a.is_finite() && turning.is_finite()));
        bad.map_or(Ok(()), |slot| Err(self.not_finite(slot)))
    }

    /// Refuses overlaps past the bound, and particles behind a wall if they are to be contained.
    pub(crate) fn check_overlaps(&self) -> Result<(), StepError> {
        for block in &self.blocks {
            if let (true, Some(Place { slot, partner })) = (self.contained, block.escaped) {
                return Err(self.escaped(slot, partner));
            }
            if block.largest_overlap.is_nan() || block.largest_overlap > self.overlap_limit {
                return Err(self.overlaps(block));
            }
        }
        Ok(())
    }

    pub(crate) fn escaped(&self, slot: usize, partner: super::Partner) -> StepError {
        let room = &self.world.rooms[self.world.cavity_of(slot)];
        StepError::Escaped {
            particle: self.particles.number[slot] as usize,
            wall: match partner {
                super::Partner::Wall(wall) => wall,
                super::Partner::Particle(_) => 0,
            },
            position: self.particles.position.get(slot) - room.motion.position,
            cause: self.cause(),
        }
    }

    fn overlaps(&self, block: &Block<L>) -> StepError {
        let scene = self.world.scene(&self.particles, 0.0);
        let place = block.deepest(&scene);
        let (slot, other) = place.map_or((block.slots.start, super::Partner::Wall(0)), |place| {
            (place.slot, place.partner)
        });
        StepError::Overlap {
            particle: self.particles.number[slot] as usize,
            other,
            overlap: block.largest_overlap,
            limit: self.overlap_limit,
            cause: self.cause(),
        }
    }

    /// The mount's accelerations under the loads on the walls.
    pub(crate) fn accelerate_mount(&mut self, time: f64) {
        for (room, load) in self.world.rooms.iter().zip(&mut self.loads) {
            *load = room.load(&self.wall_loads);
        }
        let degrees = self.mount.degrees();
        let state = &mut self.mount_state;
        let (accelerations, impulses) = state.acceleration.split_at_mut(degrees);
        for (impulse, load) in impulses.chunks_exact_mut(3).zip(&self.loads) {
            impulse.copy_from_slice(&load.to_array());
        }
        self.mount.accelerate(
            time,
            &state.position[..degrees],
            &state.velocity[..degrees],
            &self.loads,
            accelerations,
        );
    }

    /// Accelerations of the current state at `time`, `elapsed` after memories were advanced.
    pub(crate) fn evaluate<O: Observer>(
        &mut self,
        time: f64,
        elapsed: f64,
        stage: Stage,
        afresh: bool,
        observer: &mut O,
    ) -> Result<(), StepError> {
        self.place_containers(time)?;
        L::Kind::accept(EvaluateForces {
            engine: self,
            elapsed,
            stage,
            afresh,
            observer,
        })?;
        let previous = &mut self.scratch.previous_of_mount;
        previous.copy_from_slice(&self.mount_state.acceleration);
        self.accelerate_mount(time);
        Ok(())
    }

    /// Velocity of the second of two containers per unit impulse on the first, 1/kg, row by row.
    pub(crate) fn container_responses(&self) -> Vec<DMat3> {
        let cavities = self.world.rooms.len();
        mount::responses(
            &self.mount,
            self.time,
            self.coordinates(),
            self.rates(),
            cavities,
        )
    }

    /// Begins a step of `time_step` (s): an impulse law works out what holds over it.
    pub(crate) fn begin_step<O: Observer>(
        &mut self,
        time_step: f64,
        observer: &mut O,
    ) -> Result<(), StepError> {
        L::Kind::accept(BeginStep {
            engine: self,
            time_step,
            observer,
        })
    }

    /// Ends a step.
    pub(crate) const fn end_step(&mut self) {
        self.world.stamp = self.world.stamp.wrapping_add(1);
    }
}

/// Forces of the current state: worked out anew under a force law, held under an impulse law.
struct EvaluateForces<'a, E, O> {
    engine: &'a mut E,
    elapsed: f64,
    stage: Stage,
    afresh: bool,
    observer: &'a mut O,
}

impl<C, L, M, D, O> LawVisitor<L> for EvaluateForces<'_, Engine<C, L, M, D>, O>
where
    C: Cavity,
    L: ContactLaw,
    M: Mount,
    D: Detector,
    O: Observer,
{
    type Output = Result<(), StepError>;

    fn forces(self) -> Self::Output
    where
        L: ForceLaw,
    {
        self.engine.find_contacts(self.afresh)?;
        let predicted = self.stage == Stage::Predicted;
        let moment = Moment {
            elapsed: self.elapsed,
            correction: if predicted { 0.5 * self.elapsed } else { 0.0 },
            time_step: self.engine.world.time_step,
        };
        match self.stage {
            Stage::Trial => self.engine.evaluate_contacts::<(), false>(moment, &mut ()),
            Stage::End | Stage::Predicted => self
                .engine
                .evaluate_contacts::<O, true>(moment, self.observer),
        }
    }

    fn impulses(self) -> Self::Output
    where
        L: ImpulseLaw,
    {
        Ok(())
    }
}

/// The beginning of a step: where an impulse law works out what holds over it.
struct BeginStep<'a, E, O> {
    engine: &'a mut E,
    time_step: f64,
    observer: &'a mut O,
}

impl<C, L, M, D, O> LawVisitor<L> for BeginStep<'_, Engine<C, L, M, D>, O>
where
    C: Cavity,
    L: ContactLaw,
    M: Mount,
    D: Detector,
    O: Observer,
{
    type Output = Result<(), StepError>;

    fn forces(self) -> Self::Output
    where
        L: ForceLaw,
    {
        self.engine.world.time_step = self.time_step;
        Ok(())
    }

    fn impulses(self) -> Self::Output
    where
        L: ImpulseLaw,
    {
        self.engine.solve_contacts(self.time_step, self.observer)
    }
}
