//! What can be seen of a damper between steps.

use glam::DVec3;

use super::engine::Engine;
use super::state::MountCoordinates;
use crate::cavity::Cavity;
use crate::contact::WallLoad;
use crate::detector::Detector;
use crate::law::{ContactLaw, LawKind};
use crate::mount::{Load, Motion, Mount, MountEnergy};
use crate::observer::Observable;
use crate::particle::Particle;

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Observable for Engine<C, L, M, D> {
    fn count(&self) -> usize {
        self.state.particles.len()
    }

    fn particle(&self, number: usize) -> Option<Particle> {
        let index = *self.state.particles.index_of.get(number)? as usize;
        let cavity = self.state.model.cavity_of(index) as u32;
        Some(self.state.particles.particle(index, cavity))
    }

    fn cavities(&self) -> usize {
        self.state.model.compartments.len()
    }

    fn container(&self, cavity: usize) -> Option<Motion> {
        (cavity < self.cavities()).then(|| {
            let (x, v) = (self.coordinates(), self.rates());
            let motion = self.state.mount.motion(self.state.time, x, v, cavity);
            motion.normalized().unwrap_or(motion)
        })
    }

    fn load(&self, cavity: usize) -> Option<Load> {
        self.state.loads.get(cavity).copied()
    }

    fn impulse(&self, cavity: usize) -> Option<DVec3> {
        let sums = &self.state.mount_coordinates.velocity[self.state.mount.degrees()..];
        let before = MountCoordinates::impulse_among(&self.state.step_start.impulses, cavity)?;
        Some(MountCoordinates::impulse_among(sums, cavity)? - before)
    }

    fn walls(&self, cavity: usize) -> u32 {
        let compartment = self.state.model.compartments.get(cavity);
        compartment.map_or(0, |compartment| compartment.cavity.walls())
    }

    fn wall_load(&self, cavity: usize, wall: u32) -> Option<WallLoad> {
        let compartment = self.state.model.compartments.get(cavity)?;
        let load = (compartment.first_wall + wall) as usize;
        (wall < compartment.cavity.walls()).then(|| self.state.wall_loads[load])
    }

    fn wall_name(&self, cavity: usize, wall: u32) -> Option<&str> {
        let compartment = self.state.model.compartments.get(cavity)?;
        (wall < compartment.cavity.walls()).then(|| compartment.cavity.wall_name(wall))
    }

    fn coordinates(&self) -> &[f64] {
        &self.state.mount_coordinates.position[..self.state.mount.degrees()]
    }

    fn rates(&self) -> &[f64] {
        &self.state.mount_coordinates.velocity[..self.state.mount.degrees()]
    }

    fn mount_energy(&self) -> MountEnergy {
        self.state
            .mount
            .energy(self.state.time, self.coordinates(), self.rates())
    }

    fn gravity(&self) -> DVec3 {
        self.state.gravity
    }

    fn holds_forces(&self) -> bool {
        L::Kind::HELD
    }

    fn contacts(&self) -> usize {
        self.neighbours
            .blocks
            .iter()
            .map(|block| block.contacts)
            .sum()
    }

    fn largest_overlap(&self) -> f64 {
        let overlaps = self
            .neighbours
            .blocks
            .iter()
            .map(|block| block.largest_overlap);
        overlaps.fold(0.0, f64::max)
    }
}
