//! What the impulses of a step leave: accelerations and loads that hold over it, and the forces that the
//! next step starts from.

use super::{Stages, Step};
use crate::cavity::Cavity;
use crate::contact::{ContactForce, HeldForce};
use crate::damper::candidates::Candidates;
use crate::damper::engine::Engine;
use crate::damper::error::StepError;
use crate::damper::scene::WallLoad;
use crate::damper::space::Space;
use crate::detector::Detector;
use crate::law::{ImpulseLaw, at_most};
use crate::mount::Mount;

impl<S: Space> Stages<S> {
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
        step: &Step,
        stages: &mut Stages<S>,
    ) -> Result<(), StepError> {
        let [slope, curvature] = self.accelerate(step, stages);
        if step.parameters.energy_bound && slope + curvature > 0.0 {
            self.bound_energy(step, stages, [slope, curvature]);
        }
        // Not a number times zero is none.
        if !(slope * 0.0 == 0.0 && curvature * 0.0 == 0.0) {
            self.check_accelerations()?;
        }
        self.load_walls(step, stages);
        self.keep_forces(step, stages);
        self.accelerate_mount(self.time);
        Ok(())
    }

    fn load_walls<S: Space>(&mut self, step: &Step, stages: &Stages<S>) {
        self.wall_loads.fill(WallLoad::default());
        for number in stages.pairs..stages.constraints.len() {
            let constraint = &stages.constraints[number];
            let [slot, cavity] = constraint.bodies.map(|body| body as usize);
            let force = stages.force(number, step.time_step);
            let normal = S::in_space(constraint.normal);
            let arm = normal * -(constraint.lever * self.particles.radius[slot]);
            let place = stages.predicted.get(slot) - stages.containers.each[cavity].origin + arm;
            let push = normal * force.normal + force.tangential;
            let wall = stages.marks[number].wall as usize;
            self.wall_loads[wall].react(push, force.couple, place);
        }
    }

    /// Keeps forces in the lists of their contacts, but for those that one solve settles anyway.
    fn keep_forces<S: Space>(&mut self, step: &Step, stages: &Stages<S>) {
        let stamp = self.world.stamp.wrapping_add(1);
        let mut shared = stages.shared.iter().peekable();
        let mut ends = stages.ends.iter();
        let mut keep = |list: &mut Candidates<L>| {
            let end = ends.next().map_or(0, |end| *end as u32);
            while let Some(number) = shared.next_if(|number| **number < end) {
                let number = *number as usize;
                if stages.constraints[number].impulse > 0.0 {
                    let mark = &stages.marks[number];
                    let force = stages.force(number, step.time_step);
                    let held = HeldForce {
                        force,
                        load: at_most(force.normal, mark.before),
                        gravity: mark.fall / step.time_step,
                    };
                    list.keep(mark.place, stamp, &held);
                }
            }
        };
        for block in &mut self.blocks {
            keep(&mut block.pairs);
            keep(&mut block.border);
        }
        for block in &mut self.blocks {
            keep(&mut block.walls);
        }
    }
}
