//! Going through all joints once.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use crate::cavity::Cavity;
use crate::contact::ContactForce;
use crate::damper::engine::Engine;
use crate::detector::Detector;
use crate::law::ContactLaw;
use crate::mount::Mount;

/// The larger of two speeds, of which neither is a NaN.
#[inline(always)]
const fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Strikes all pairs, then all walls, each with the velocities that those before it left. Returns
    /// the largest speed in m/s along the normal that particles were given relative to each other, or
    /// to a wall.
    pub(super) fn strike_in_turn(&mut self, ascending: bool) -> f64 {
        let mut change = 0.0;
        for turn in 0..self.joints.pairs.len() {
            let number = if ascending {
                turn
            } else {
                self.joints.pairs.len() - 1 - turn
            };
            change = larger(change, self.strike_pair(number));
        }
        for number in 0..self.joints.walls.len() {
            change = larger(change, self.strike_wall(number));
        }
        change
    }

    #[inline(always)]
    fn strike_pair(&mut self, number: usize) -> f64 {
        let world = &self.world;
        let joints = &mut self.joints;
        let joint = &mut joints.pairs[number];
        let contact = joint.between(
            joint.bodies.map(|slot| &joints.movers[slot as usize]),
            &joints.containers[joint.cavity as usize],
        );
        let only = world.coefficients.only_pair();
        let kind = only.unwrap_or_else(|| &joints.kinds[number]);
        let answer = world.law.strike(kind, &contact, &mut joint.memory);
        if answer == ContactForce::default() {
            return 0.0;
        }
        joint.remembers = true;
        let (force, first, second) = joint.resolve(&answer);
        let [i, j] = joint.bodies.map(|slot| slot as usize);
        joints.movers[i].take(force, first);
        joints.movers[j].take(-force, second);
        let gain = joints.movers[i].gain + joints.movers[j].gain;
        if let Some(given) = joints.given.get_mut(number) {
            given.add(&answer);
        }
        answer.normal.abs() * gain
    }

    fn strike_wall(&mut self, number: usize) -> f64 {
        let joints = &mut self.joints;
        let joint = &mut joints.walls[number];
        let contact = joint.at_wall(
            &joints.movers[joint.bodies[0] as usize],
            &joints.containers[joint.cavity as usize],
        );
        let species = self.particles.species[joint.bodies[0] as usize];
        let kind = self.world.coefficients.wall(species);
        let answer = self.world.law.strike(kind, &contact, &mut joint.memory);
        if answer == ContactForce::default() {
            return 0.0;
        }
        joint.remembers = true;
        let gain = joints.movers[joint.bodies[0] as usize].gain;
        self.push_wall(number, &answer);
        self.move_containers();
        answer.normal.abs() * gain
    }

    /// Gives a particle and a wall what their joint answers.
    pub(super) fn push_wall(&mut self, number: usize, answer: &ContactForce) {
        let joints = &mut self.joints;
        let joint = &joints.walls[number];
        let (force, torque, _) = joint.resolve(answer);
        let (slot, wall) = (joint.bodies[0] as usize, joint.bodies[1] as usize);
        let cavity = joint.cavity as usize;
        joints.movers[slot].take(force, torque);
        let container = &joints.containers[cavity];
        let impulse = -force * container.air[1].time_step;
        let degrees = joints.rates.as_mut_slice();
        self.mount.strike(cavity, impulse, degrees);
        let arm = joint.normal * -joint.radii[0];
        let place = self.particles.position.get(slot) - container.origin + arm;
        self.wall_loads[wall].react(force, answer.couple, place);
        let number = joints.pairs.len() + number;
        if let Some(given) = joints.given.get_mut(number) {
            given.add(answer);
        }
    }

    /// Gives the containers the velocities that the mount's coordinates have.
    pub(super) fn move_containers(&mut self) {
        let degrees = self.mount.degrees();
        let coordinates = &self.mount_state.position[..degrees];
        let joints = &mut self.joints;
        for (cavity, container) in joints.containers.iter_mut().enumerate() {
            let motion = self
                .mount
                .motion(self.time, coordinates, &joints.rates, cavity);
            container.velocity = motion.velocity;
        }
    }
}
