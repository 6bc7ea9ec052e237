//! Forces of a force law: every contact is evaluated, and forces become accelerations.
//!
//! In: the state, and the lists of contacts. Out: accelerations of the particles, loads on the walls, and what
//! contacts remember. Called at every stage of an integrator.

use super::neighbours::Block;
use super::state::{Model, State, StateView, StepTime};
use crate::cavity::Cavity;
use crate::contact::WallLoad;
use crate::law::{ContactLaw, ForceLaw};
use crate::observer::Observer;
use crate::parallel::for_each;
use crate::step_error::StepError;

mod batch;
mod evaluate;
mod report;
mod sums;

use evaluate::BlockForces;

/// What forces are evaluated with: scratch for each block.
#[derive(Clone)]
pub(crate) struct Forces<L: ContactLaw> {
    blocks: Vec<BlockForces<L>>,
}

impl<L: ContactLaw> Forces<L> {
    /// Scratch for `blocks` blocks in cavities of so many `walls`.
    pub(crate) fn new(blocks: usize, walls: usize) -> Self {
        let scratch = (0..blocks).map(|_| BlockForces::new(walls));
        Self {
            blocks: scratch.collect(),
        }
    }

    /// Memory in bytes that is reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        self.blocks.iter().map(BlockForces::reserved_bytes).sum()
    }
}

impl<L: ForceLaw> Forces<L> {
    /// Evaluates the contacts of all `blocks` at a time of the step, and sets accelerations and loads on
    /// walls. With `END`, contacts advance their memory, and `observer` is told of them.
    pub(crate) fn evaluate<C: Cavity, const END: bool>(
        &mut self,
        model: &Model<C, L>,
        state: &mut State,
        blocks: &mut [Block<L>],
        step_time: StepTime,
        observer: &mut dyn Observer,
    ) -> Result<(), StepError> {
        let [mut force, mut torque] = std::mem::take(&mut state.previous.particles);
        let view = StateView {
            step_time,
            ..state.view(model, step_time.elapsed)
        };
        let widths = (force.width(), torque.width());
        let sums = (force.flat_mut(), torque.flat_mut());
        let gravity = state.gravity;
        let mut finite = true;
        if END && observer.wants_contacts() {
            let (mut forces, mut torques) = sums;
            for (block, scratch) in blocks.iter_mut().zip(&mut self.blocks) {
                let (force, torque);
                (force, forces) = forces.split_at_mut(widths.0 * block.indices.len());
                (torque, torques) = torques.split_at_mut(widths.1 * block.indices.len());
                let sums = (force, torque);
                finite &= scratch.evaluate::<C, END>(block, &view, gravity, sums, observer);
            }
        } else {
            let split = |((forces, torques), scratch), blocks: &[Block<L>]| {
                let (own, others) = <[BlockForces<L>]>::split_at_mut(scratch, blocks.len());
                let count: usize = blocks.iter().map(|block| block.indices.len()).sum();
                let (force, forces) = <[f64]>::split_at_mut(forces, widths.0 * count);
                let (torque, torques) = <[f64]>::split_at_mut(torques, widths.1 * count);
                (((force, torque), own), ((forces, torques), others))
            };
            let parts = (sums, self.blocks.as_mut_slice());
            finite = for_each(blocks, parts, &split, &|block, (sums, scratch)| {
                scratch.iter_mut().all(|scratch| {
                    let sums = (&mut *sums.0, &mut *sums.1);
                    scratch.evaluate::<C, END>(block, &view, gravity, sums, &mut ())
                })
            });
        }
        for halo_force in self.blocks.iter().flat_map(|block| &block.halo_forces) {
            let index = halo_force.index as usize;
            let gain = halo_force.force * state.particles.inverse_mass[index];
            let turn = halo_force.torque * state.particles.inverse_inertia[index];
            let (gain, turn) = (force.get(index) + gain, torque.get(index) + turn);
            finite &= gain.is_finite() && turn.is_finite();
            force.set(index, gain);
            torque.set(index, turn);
        }
        let particles = &mut state.particles;
        state.previous.particles = [
            std::mem::replace(&mut particles.acceleration, force),
            std::mem::replace(&mut particles.angular_acceleration, torque),
        ];

        state.wall_loads.fill(WallLoad::default());
        for block in &self.blocks {
            for (total, load) in state.wall_loads.iter_mut().zip(&block.loads) {
                total.add(load);
            }
        }
        if !finite {
            state.check_accelerations()?;
        }
        Ok(())
    }
}
