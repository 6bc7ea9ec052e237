//! What can be seen of a damper between steps.

use glam::DVec3;

use super::engine::Engine;
use super::state::MountCoordinates;
use crate::cavity::Cavity;
use crate::contact::WallLoad;
use crate::law::ContactLaw;
use crate::mount::{Load, Motion, Mount, MountEnergy};
use crate::observer::Observable;
use crate::particle::Particle;

/// A damper between steps, to be looked at.
pub(crate) struct Observed<'a, C, L: ContactLaw> {
    engine: &'a Engine<C, L>,
    mount: &'a dyn Mount,
}

impl<'a, C, L: ContactLaw> Observed<'a, C, L> {
    pub(crate) const fn new(engine: &'a Engine<C, L>, mount: &'a dyn Mount) -> Self {
        Self { engine, mount }
    }
}

impl<C: Cavity, L: ContactLaw> Observable for Observed<'_, C, L> {
    fn count(&self) -> usize {
        self.engine.state.particles.len()
    }

    fn particle(&self, number: usize) -> Option<Particle> {
        let index = *self.engine.state.particles.index_of.get(number)? as usize;
        let cavity = self.engine.state.cavity_of(index) as u32;
        Some(self.engine.state.particles.particle(index, cavity))
    }

    fn cavities(&self) -> usize {
        self.engine.state.compartments.len()
    }

    fn container(&self, cavity: usize) -> Option<Motion> {
        (cavity < self.cavities()).then(|| {
            let [x, v] = self.engine.state.mount_state();
            let motion = self.mount.motion(self.engine.state.time, x, v, cavity);
            motion.normalized().unwrap_or(motion)
        })
    }

    fn load(&self, cavity: usize) -> Option<Load> {
        self.engine.state.loads.get(cavity).copied()
    }

    fn impulse(&self, cavity: usize) -> Option<DVec3> {
        let sums = &self.engine.state.mount_coordinates.velocity[self.engine.state.degrees..];
        let before =
            MountCoordinates::impulse_among(&self.engine.state.step_start.impulses, cavity)?;
        Some(MountCoordinates::impulse_among(sums, cavity)? - before)
    }

    fn walls(&self, cavity: usize) -> u32 {
        let compartment = self.engine.state.compartments.get(cavity);
        compartment.map_or(0, |compartment| compartment.walls)
    }

    fn wall_load(&self, cavity: usize, wall: u32) -> Option<WallLoad> {
        let compartment = self.engine.state.compartments.get(cavity)?;
        let load = (compartment.first_wall + wall) as usize;
        (wall < compartment.walls).then(|| self.engine.state.wall_loads[load])
    }

    fn wall_name(&self, cavity: usize, wall: u32) -> Option<&str> {
        let cavity = self.engine.model.cavities.get(cavity)?;
        (wall < cavity.walls()).then(|| cavity.wall_name(wall))
    }

    fn coordinates(&self) -> &[f64] {
        self.engine.state.mount_state()[0]
    }

    fn rates(&self) -> &[f64] {
        self.engine.state.mount_state()[1]
    }

    fn mount_energy(&self) -> MountEnergy {
        let [x, v] = self.engine.state.mount_state();
        self.mount.energy(self.engine.state.time, x, v)
    }

    fn gravity(&self) -> DVec3 {
        self.engine.state.gravity
    }

    fn holds_forces(&self) -> bool {
        self.engine.state.holds_forces
    }

    fn contacts(&self) -> usize {
        self.engine.neighbours.contacts()
    }

    fn largest_overlap(&self) -> f64 {
        self.engine.neighbours.largest_overlap()
    }
}
