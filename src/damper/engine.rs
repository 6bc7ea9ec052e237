//! The engine: everything of a damper but its integrator. It keeps the candidates fresh and turns
//! the state into accelerations.

use crate::contact::Partner;
use crate::damper::neighbours::Scratch;
use crate::damper::state::MountState;
use glam::{DMat3, DVec3};

use super::impulses::ContactSolver;
use super::neighbours::{Block, ContactHistory, ContactId, block_size};
use super::state::{Compartment, Model, Particles, StateView, StepTime};
use super::step::StepStart;
use crate::cavity::Cavity;
use crate::contact::WallLoad;
use crate::detector::Detector;
use crate::integrator::Stage;
use crate::law::{ContactLaw, ForceLaw, ImpulseLaw, LawKind, LawVisitor};
use crate::mount::{self, Motion, Mount};
use crate::observer::{Observable, Observer};
use crate::parallel::{Pool, for_each};
use crate::step_error::StepError;

/// A damper without its integrator.
#[derive(Debug, Clone)]
pub(crate) struct Engine<C, L: ContactLaw, M, D> {
    pub(crate) model: Model<C, L>,
    pub(crate) mount: M,
    pub(crate) gravity: DVec3,
    pub(crate) detectors: Vec<D>,
    pub(crate) particles: Particles,
    pub(crate) mount_state: MountState,
    pub(crate) blocks: Vec<Block<L>>,
    pub(crate) scratch: Scratch,
    /// What contacts of a block remember while they are listed anew.
    pub(crate) history_pool: Pool<ContactHistory<L>>,
    /// What impulses are worked out with; none under a force law.
    pub(crate) solver: Option<ContactSolver>,
    /// Loads of the particles on each wall, all cavities in turn.
    pub(crate) wall_loads: Vec<WallLoad>,
    /// Forces of the particles on each container.
    pub(crate) loads: Vec<DVec3>,
    pub(crate) time: f64,
    /// How the step began.
    pub(crate) step_start: StepStart,
    pub(crate) detections: u64,
    /// Steps since a large bed was sorted.
    pub(crate) since_sort: u32,
    pub(crate) overlap_limit: f64,
    pub(crate) contained: bool,
}

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// How many walls all cavities have.
    pub(crate) fn wall_count(compartments: &[Compartment<C>]) -> usize {
        compartments
            .iter()
            .map(|compartment| compartment.cavity.walls() as usize)
            .sum()
    }

    /// Blocks for `count` particles.
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
        for (cavity, compartment) in self.model.compartments.iter_mut().enumerate() {
            let Motion { position, velocity } =
                self.mount.motion(time, coordinates, velocities, cavity);
            if !(position.is_finite() && velocity.is_finite()) {
                return Err(StepError::Container {
                    cavity,
                    position,
                    velocity,
                });
            }
            if compartment.cavity.is_planar() && (position.z != 0.0 || velocity.z != 0.0) {
                return Err(StepError::OutOfPlane {
                    cavity,
                    position,
                    velocity,
                });
            }
            compartment.motion = Motion { position, velocity };
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
        bad.map_or(Ok(()), |index| Err(self.not_finite(index)))
    }

    fn not_finite(&self, index: usize) -> StepError {
        StepError::NotFinite {
            particle: self.particles.id[index] as usize,
            position: self.particles.position.get(index),
            acceleration: self.particles.acceleration.get(index),
        }
    }

    /// Forces of a stiff law: evaluates the contacts, and turns forces into accelerations.
    fn evaluate_contacts<O: Observer, const END: bool>(
        &mut self,
        step_time: StepTime,
        observer: &mut O,
    ) -> Result<(), StepError>
    where
        L: ForceLaw,
    {
        let [mut force, mut torque] = std::mem::take(&mut self.scratch.previous);
        let view = StateView {
            step_time,
            ..self.model.view(&self.particles, step_time.elapsed)
        };
        let widths = (force.width(), torque.width());
        let sums = (force.flat_mut(), torque.flat_mut());
        let gravity = self.gravity;
        let mut finite = true;
        if END && observer.wants_contacts() {
            let (mut forces, mut torques) = sums;
            for block in &mut self.blocks {
                let (force, torque);
                (force, forces) = forces.split_at_mut(widths.0 * block.indices.len());
                (torque, torques) = torques.split_at_mut(widths.1 * block.indices.len());
                finite &= block.evaluate::<C, O, END>(&view, gravity, (force, torque), observer);
            }
        } else {
            let split = |(forces, torques), blocks: &[Block<L>]| {
                let count: usize = blocks.iter().map(|block| block.indices.len()).sum();
                let (force, forces) = <[f64]>::split_at_mut(forces, widths.0 * count);
                let (torque, torques) = <[f64]>::split_at_mut(torques, widths.1 * count);
                ((force, torque), (forces, torques))
            };
            finite = for_each(&mut self.blocks, sums, &split, &|block, sums| {
                block.evaluate::<C, (), END>(&view, gravity, sums, &mut ())
            });
        }
        for halo_force in self.blocks.iter().flat_map(|block| &block.halo_forces) {
            let index = halo_force.index as usize;
            let gain = halo_force.force * self.particles.inverse_mass[index];
            let turn = halo_force.torque * self.particles.inverse_inertia[index];
            let (gain, turn) = (force.get(index) + gain, torque.get(index) + turn);
            finite &= gain.is_finite() && turn.is_finite();
            force.set(index, gain);
            torque.set(index, turn);
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
        bad.map_or(Ok(()), |index| Err(self.not_finite(index)))
    }

    /// Refuses overlaps past the bound, and particles behind a wall if they are to be contained.
    pub(crate) fn check_overlaps(&self) -> Result<(), StepError> {
        for block in &self.blocks {
            if let (true, Some(ContactId { index, partner })) = (self.contained, block.escaped) {
                return Err(self.escaped(index, partner));
            }
            if block.largest_overlap.is_nan() || block.largest_overlap > self.overlap_limit {
                return Err(self.overlaps(block));
            }
        }
        Ok(())
    }

    pub(crate) fn escaped(&self, index: usize, partner: Partner) -> StepError {
        let compartment = &self.model.compartments[self.model.cavity_of(index)];
        StepError::Escaped {
            particle: self.particles.id[index] as usize,
            wall: match partner {
                Partner::Wall(wall) => wall,
                Partner::Particle(_) => 0,
            },
            position: self.particles.position.get(index) - compartment.motion.position,
            cause: self.cause(),
        }
    }

    fn overlaps(&self, block: &Block<L>) -> StepError {
        let view = self.model.view(&self.particles, 0.0);
        let place = block.deepest(&view);
        let (index, other) = place.map_or((block.indices.start, Partner::Wall(0)), |place| {
            (place.index, place.partner)
        });
        StepError::Overlap {
            particle: self.particles.id[index] as usize,
            other,
            overlap: block.largest_overlap,
            limit: self.overlap_limit,
            cause: self.cause(),
        }
    }

    /// The mount's accelerations under the loads on the walls.
    pub(crate) fn accelerate_mount(&mut self, time: f64) {
        for (compartment, load) in self.model.compartments.iter().zip(&mut self.loads) {
            *load = compartment.load(&self.wall_loads);
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

    /// Accelerations of the current state at `time`, `elapsed` after the contact history was advanced.
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
        let cavities = self.model.compartments.len();
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
        self.model.stamp = self.model.stamp.wrapping_add(1);
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
        let step_time = StepTime {
            elapsed: self.elapsed,
            correction: if predicted { 0.5 * self.elapsed } else { 0.0 },
            time_step: self.engine.model.time_step,
        };
        match self.stage {
            Stage::Trial => self
                .engine
                .evaluate_contacts::<(), false>(step_time, &mut ()),
            Stage::End | Stage::Predicted => self
                .engine
                .evaluate_contacts::<O, true>(step_time, self.observer),
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
        self.engine.model.time_step = self.time_step;
        Ok(())
    }

    fn impulses(self) -> Self::Output
    where
        L: ImpulseLaw,
    {
        self.engine.solve_contacts(self.time_step, self.observer)
    }
}
