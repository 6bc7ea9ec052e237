//! What the impulses of a step leave: accelerations and loads that hold over it, and the forces that the
//! next step starts from.

use super::{ImpulseSolver, SolverStep};
use crate::contact::{ContactForce, HeldForce, WallLoad};
use crate::damper::neighbours::{Block, NeighbourList};
use crate::damper::state::{Space, State, react};
use crate::law::ImpulseLaw;
use crate::numbers::at_most;
use crate::step_error::StepError;

impl<S: Space> ImpulseSolver<S> {
    /// The impulses of a constraint as forces over `time_step` (s).
    pub(super) fn force(&self, number: usize, time_step: f64) -> ContactForce {
        let mut force = self.constraints[number].force(time_step);
        if let Some(rolling) = self.rolling.get(number) {
            force.couple = S::spin_in_space(rolling.impulse) / time_step;
        }
        force
    }
}

impl<S: Space> ImpulseSolver<S> {
    /// Turns impulses into accelerations of the particles and loads on the walls, and keeps the forces of
    /// the contacts.
    pub(super) fn apply<L: ImpulseLaw>(
        &mut self,
        step: &SolverStep,
        state: &mut State,
        blocks: &mut [Block<L>],
    ) -> Result<(), StepError> {
        let [slope, curvature] = self.accelerate(step, state);
        if step.parameters.energy_bound && slope + curvature > 0.0 {
            self.bound_energy(step, state, [slope, curvature]);
        }
        // Not a number times zero is none.
        if !(slope * 0.0 == 0.0 && curvature * 0.0 == 0.0) {
            state.check_accelerations()?;
        }
        self.load_walls(step, state);
        self.store_forces(step, blocks);
        // Back from the prediction: the mount is where the step begins.
        let starts = &self.containers.starts;
        for (compartment, start) in state.compartments.iter_mut().zip(starts) {
            compartment.place(*start);
        }
        Ok(())
    }

    fn load_walls(&self, step: &SolverStep, state: &mut State) {
        state.wall_loads.fill(WallLoad::default());
        for number in self.pairs..self.constraints.len() {
            let constraint = &self.constraints[number];
            let [index, cavity] = constraint.bodies.map(|body| body as usize);
            let force = self.force(number, step.time_step);
            let normal = S::in_space(constraint.normal);
            let arm = normal * -(constraint.lever * state.particles.radius[index]);
            let place = self.predicted.get(index) - self.containers.each[cavity].origin + arm;
            let push = normal * force.normal + force.tangential;
            let wall = self.infos[number].wall as usize;
            let load = &mut state.wall_loads[wall];
            react::<S>(load, push, force.couple, S::vector(place));
        }
    }

    /// Keeps forces in the lists of their contacts, but for those that one solve settles anyway.
    fn store_forces<L: ImpulseLaw>(&self, step: &SolverStep, blocks: &mut [Block<L>]) {
        let time_step = step.time_step;
        let (constraints, infos) = (&*self.constraints, &self.infos[..self.constraints.len()]);
        let mut coupled = self.coupled.as_slice();
        let mut ends = self.list_ends.iter();
        let mut keep = move |list: &mut NeighbourList<L>| {
            let end = ends.next().map_or(0, |end| *end as u32);
            list.forget();
            let own;
            (own, coupled) = coupled.split_at(coupled.partition_point(|number| *number < end));
            for number in own.iter().map(|number| *number as usize) {
                if constraints[number].impulse > 0.0 {
                    let info = &infos[number];
                    let force = self.force(number, time_step);
                    let held = HeldForce {
                        force,
                        load: at_most(force.normal, info.before),
                        gravity: info.speed_gain / time_step,
                    };
                    list.remember(info.candidate, &held);
                }
            }
        };
        for block in &mut *blocks {
            keep(&mut block.pairs);
            keep(&mut block.halo);
        }
        for block in &mut *blocks {
            keep(&mut block.walls);
        }
    }
}
