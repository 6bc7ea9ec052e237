//! Going through all joints once.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use super::joint::Joints;
use crate::cavity::Cavity;
use crate::contact::ContactForce;
use crate::damper::engine::Engine;
use crate::damper::scene::World;
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
        let world = &self.world;
        let mut change = if world.planar() {
            self.joints.strike_pairs::<C, true>(world, ascending)
        } else {
            self.joints.strike_pairs::<C, false>(world, ascending)
        };
        for number in 0..self.joints.walls.len() {
            change = larger(change, self.strike_wall(number));
        }
        change
    }

    fn strike_wall(&mut self, number: usize) -> f64 {
        let joints = &mut self.joints;
        let joint = &mut joints.walls[number];
        let contact = joint.at_wall(&joints.movers, &joints.containers);
        let slot = joint.bodies[0] as usize;
        let kind = self.world.coefficients.wall(self.particles.species[slot]);
        let answer = self.world.law.strike(kind, &contact, &mut joint.memory);
        if answer == ContactForce::default() {
            return 0.0;
        }
        joint.remembers = true;
        let gain = joints.movers[slot].gain;
        self.push_wall(number, &answer);
        self.move_containers();
        answer.normal.abs() * gain
    }

    /// Gives a particle and a wall what their joint answers.
    pub(super) fn push_wall(&mut self, number: usize, answer: &ContactForce) {
        let joints = &mut self.joints;
        let joint = &joints.walls[number];
        let (force, torque, _) = joint.resolve::<false>(answer);
        let (slot, wall) = (joint.bodies[0] as usize, joint.bodies[1] as usize);
        let cavity = joint.cavity as usize;
        joints.movers[slot].take::<false>(force, torque);
        let container = &joints.containers[cavity];
        let impulse = -force * container.surroundings.time_step;
        self.mount.strike(cavity, impulse, &mut joints.rates);
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
            let rates = &joints.rates;
            let motion = self.mount.motion(self.time, coordinates, rates, cavity);
            container.velocity = motion.velocity;
        }
    }
}

impl<L: ContactLaw> Joints<L> {
    #[inline(never)]
    fn strike_pairs<C: Cavity, const PLANAR: bool>(
        &mut self,
        world: &World<C, L>,
        ascending: bool,
    ) -> f64 {
        let mut change = 0.0;
        let count = self.pairs.len();
        for turn in 0..count {
            let number = if ascending { turn } else { count - 1 - turn };
            change = larger(change, self.strike_pair::<C, PLANAR>(world, number));
        }
        change
    }

    #[inline(always)]
    fn strike_pair<C: Cavity, const PLANAR: bool>(
        &mut self,
        world: &World<C, L>,
        number: usize,
    ) -> f64 {
        let joint = &mut self.pairs[number];
        let contact = joint.between::<PLANAR>(&self.movers, &self.containers);
        let only = world.coefficients.only_pair();
        let kind = only.unwrap_or_else(|| &self.kinds[number]);
        let answer = world.law.strike(kind, &contact, &mut joint.memory);
        if answer == ContactForce::default() {
            return 0.0;
        }
        joint.remembers = true;
        let gain = self.push_pair::<PLANAR>(number, &answer);
        answer.normal.abs() * gain
    }

    /// Gives two particles what their joint answers. Returns what relative velocity a force in N along
    /// the normal gives them, 1/kg s.
    #[inline(always)]
    pub(super) fn push_pair<const PLANAR: bool>(
        &mut self,
        number: usize,
        answer: &ContactForce,
    ) -> f64 {
        let joint = &self.pairs[number];
        let (force, first, second) = joint.resolve::<PLANAR>(answer);
        let [i, j] = joint.bodies.map(|slot| slot as usize);
        self.movers[i].take::<PLANAR>(force, first);
        self.movers[j].take::<PLANAR>(-force, second);
        if let Some(given) = self.given.get_mut(number) {
            given.add(answer);
        }
        self.movers[i].gain + self.movers[j].gain
    }
}
