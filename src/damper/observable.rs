//! What can be seen of a damper between steps.

use glam::DVec3;

use super::engine::Engine;
use crate::cavity::Cavity;
use crate::contact::WallLoad;
use crate::detector::Detector;
use crate::law::{ContactLaw, LawKind};
use crate::mount::{Motion, Mount, MountEnergy};
use crate::observer::Observable;
use crate::particle::Particle;

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Observable for Engine<C, L, M, D> {
    fn count(&self) -> usize {
        self.particles.len()
    }

    fn particle(&self, number: usize) -> Option<Particle> {
        let index = *self.particles.index_of.get(number)? as usize;
        let cavity = self.model.cavity_of(index) as u32;
        Some(self.particles.particle(index, cavity))
    }

    fn cavities(&self) -> usize {
        self.model.compartments.len()
    }

    fn container(&self, cavity: usize) -> Option<Motion> {
        (cavity < self.cavities()).then(|| {
            self.mount
                .motion(self.time, self.coordinates(), self.rates(), cavity)
        })
    }

    fn load(&self, cavity: usize) -> Option<DVec3> {
        self.loads.get(cavity).copied()
    }

    fn walls(&self, cavity: usize) -> u32 {
        let compartment = self.model.compartments.get(cavity);
        compartment.map_or(0, |compartment| compartment.cavity.walls())
    }

    fn wall_load(&self, cavity: usize, wall: u32) -> Option<WallLoad> {
        let compartment = self.model.compartments.get(cavity)?;
        let load = (compartment.first_wall + wall) as usize;
        (wall < compartment.cavity.walls()).then(|| self.wall_loads[load])
    }

    fn wall_name(&self, cavity: usize, wall: u32) -> Option<&'static str> {
        let compartment = self.model.compartments.get(cavity)?;
        (wall < compartment.cavity.walls()).then(|| compartment.cavity.wall_name(wall))
    }

    fn coordinates(&self) -> &[f64] {
        &self.mount_state.position[..self.mount.degrees()]
    }

    fn rates(&self) -> &[f64] {
        &self.mount_state.velocity[..self.mount.degrees()]
    }

    fn mount_energy(&self) -> MountEnergy {
        self.mount
            .energy(self.time, self.coordinates(), self.rates())
    }

    fn gravity(&self) -> DVec3 {
        self.gravity
    }

    fn holds_forces(&self) -> bool {
        L::Kind::HELD
    }

    fn contacts(&self) -> usize {
        self.blocks.iter().map(|block| block.contacts).sum()
    }

    fn largest_overlap(&self) -> f64 {
        let overlaps = self.blocks.iter().map(|block| block.largest_overlap);
        overlaps.fold(0.0, f64::max)
    }
}
