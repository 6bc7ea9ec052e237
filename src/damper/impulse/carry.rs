//! A first guess: what contacts at rest gave in the step before, they are likely to give again.

use glam::DVec3;

use super::pass::Pass;
use crate::cavity::Cavity;
use crate::contact::ContactForce;
use crate::damper::engine::Engine;
use crate::damper::scene::WallLoad;
use crate::detector::Detector;
use crate::law::ContactLaw;
use crate::mount::Mount;

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Gives what contacts carry over from the step before: all of it, if that leaves no more kinetic
    /// energy at the end of the step than without, else the part that leaves least. Energies are those
    /// of motion relative to the containers, which contacts can but lessen.
    pub(super) fn carry_impulses(&mut self, time_step: f64) -> bool {
        let stamp = self.world.stamp;
        let passed = self.pass(Pass::Carried { part: 1.0, stamp }, time_step);
        if !passed.any {
            return false;
        }
        let (slope, curvature) = (passed.power * time_step, self.energy_of_blows(time_step));
        if slope + curvature <= 0.0 {
            return true;
        }
        let part = (-0.5 * slope / curvature).max(0.0);
        self.take_back_all();
        let stamp = stamp.wrapping_add(1);
        self.pass(Pass::Carried { part, stamp }, time_step).any
    }

    /// Kinetic energy in J of what the impulses so far have added to all velocities.
    fn energy_of_blows(&self, time_step: f64) -> f64 {
        let (scratch, particles) = (&self.scratch, &self.particles);
        let mut twice = 0.0;
        for (n, velocity) in scratch.velocity.iter().enumerate() {
            let gain = *velocity - particles.velocity.get(n);
            let turn = scratch.spin[n] - particles.spin.get(n);
            twice += gain.length_squared() / particles.inverse_mass[n]
                + turn.length_squared() / particles.inverse_inertia[n];
        }
        let coordinates = &self.mount_state.position[..self.mount.degrees()];
        for (cavity, room) in self.world.rooms.iter().enumerate() {
            let first = room.first_wall as usize;
            let walls = &self.wall_loads[first..first + room.cavity.walls() as usize];
            let load: DVec3 = walls.iter().map(|wall| wall.force).sum();
            let rates = &scratch.rates;
            let motion = self.mount.motion(self.time, coordinates, rates, cavity);
            twice += load.dot(motion.velocity - room.motion.velocity) * time_step;
        }
        0.5 * twice
    }

    /// Starts the step's impulses afresh.
    fn take_back_all(&mut self) {
        let scratch = &mut self.scratch;
        scratch.start_from(&self.particles);
        scratch.rates.clear();
        let rates = &self.mount_state.velocity[..self.mount.degrees()];
        scratch.rates.extend_from_slice(rates);
        scratch.given.fill(ContactForce::default());
        self.wall_loads.fill(WallLoad::default());
    }
}
