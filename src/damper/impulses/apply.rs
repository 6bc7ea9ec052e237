//! What the impulses of a step leave: accelerations and loads that hold over it, and the forces that the
//! next step starts from.

use super::{ImpulseSolver, SolverStep};
use crate::cavity::Cavity;
use crate::contact::{ContactForce, HeldForce, WallLoad};
use crate::damper::engine::Engine;
use crate::damper::neighbours::NeighbourList;
use crate::damper::state::Space;
use crate::detector::Detector;
use crate::law::{ImpulseLaw, at_most};
use crate::mount::Mount;
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

impl<C: Cavity, L: ImpulseLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Turns impulses into accelerations of the particles and loads on the walls, and keeps the forces of
    /// the contacts.
    pub(super) fn apply<S: Space>(
        &mut self,
        step: &SolverStep,
        solver: &mut ImpulseSolver<S>,
    ) -> Result<(), StepError> {
        let [slope, curvature] = self.accelerate(step, solver);
        if step.parameters.energy_bound && slope + curvature > 0.0 {
            self.bound_energy(step, solver, [slope, curvature]);
        }
        // Not a number times zero is none.
        if !(slope * 0.0 == 0.0 && curvature * 0.0 == 0.0) {
            self.check_accelerations()?;
        }
        self.load_walls(step, solver);
        self.store_forces(step, solver);
        self.accelerate_mount(self.time);
        Ok(())
    }

    fn load_walls<S: Space>(&mut self, step: &SolverStep, solver: &ImpulseSolver<S>) {
        self.wall_loads.fill(WallLoad::default());
        for number in solver.pairs..solver.constraints.len() {
            let constraint = &solver.constraints[number];
            let [index, cavity] = constraint.bodies.map(|body| body as usize);
            let force = solver.force(number, step.time_step);
            let normal = S::in_space(constraint.normal);
            let arm = normal * -(constraint.lever * self.particles.radius[index]);
            let place = solver.predicted.get(index) - solver.containers.each[cavity].origin + arm;
            let push = normal * force.normal + force.tangential;
            let wall = solver.infos[number].wall as usize;
            self.wall_loads[wall].react(push, force.couple, place);
        }
    }

    /// Keeps forces in the lists of their contacts, but for those that one solve settles anyway.
    fn store_forces<S: Space>(&mut self, step: &SolverStep, solver: &ImpulseSolver<S>) {
        let stamp = self.model.stamp.wrapping_add(1);
        let mut coupled = solver.coupled.iter().peekable();
        let mut ends = solver.list_ends.iter();
        let mut keep = |list: &mut NeighbourList<L>| {
            let end = ends.next().map_or(0, |end| *end as u32);
            while let Some(number) = coupled.next_if(|number| **number < end) {
                let number = *number as usize;
                if solver.constraints[number].impulse > 0.0 {
                    let info = &solver.infos[number];
                    let force = solver.force(number, step.time_step);
                    let held = HeldForce {
                        force,
                        load: at_most(force.normal, info.before),
                        gravity: info.speed_gain / step.time_step,
                    };
                    list.keep(info.candidate, stamp, &held);
                }
            }
        };
        for block in &mut self.blocks {
            keep(&mut block.pairs);
            keep(&mut block.halo);
        }
        for block in &mut self.blocks {
            keep(&mut block.walls);
        }
    }
}
