//! Going through all joints once.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use super::joint::{Joints, kind_of_pair};
use super::{STILL, STIRRED};
use crate::cavity::Cavity;
use crate::contact::ContactForce;
use crate::damper::engine::Engine;
use crate::damper::scene::World;
use crate::detector::Detector;
use crate::law::{ContactLaw, at_least};
use crate::mount::Mount;

/// A round through the joints.
#[derive(Debug, Clone, Copy)]
pub(super) struct Round {
    /// Counted from zero.
    pub(super) number: u8,
    /// Speed in m/s that needs no further round if it is given.
    pub(super) negligible: f64,
    /// Whether contacts at rest get a further round.
    pub(super) resting: bool,
}

impl Round {
    /// Whether it asks for a further round that `speed` (m/s) was given, where a free particle gains
    /// `fall` (m/s) over the step.
    #[inline(always)]
    pub(super) fn notes(&self, speed: f64, fall: f64) -> bool {
        let at_rest = STILL * fall <= speed && speed < STIRRED * fall;
        speed >= self.negligible || self.resting && at_rest
    }
}

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Strikes pairs of which a particle was notably changed since the round before began, to and fro,
    /// then all walls, each with the velocities that those before it left. Returns the largest speed in
    /// m/s along the normal that particles were given relative to each other, or to a wall.
    pub(super) fn strike_in_turn(&mut self, round: &Round) -> f64 {
        if self.world.planar() {
            self.strike_all::<true>(round)
        } else {
            self.strike_all::<false>(round)
        }
    }

    fn strike_all<const PLANAR: bool>(&mut self, round: &Round) -> f64 {
        let mut largest = self.joints.strike_pairs::<C, PLANAR>(&self.world, round);
        for number in 0..self.joints.walls.joints.len() {
            largest = at_least(self.strike_wall::<PLANAR>(number, round), largest);
        }
        largest
    }

    #[inline(always)]
    fn strike_wall<const PLANAR: bool>(&mut self, number: usize, round: &Round) -> f64 {
        let joints = &mut self.joints;
        let joint = &mut joints.walls.joints[number];
        let memory = &mut joints.walls.memories[number];
        let contact = joint.at_wall::<PLANAR>(&joints.movers, &joints.containers);
        let slot = joint.bodies[0] as usize;
        let kind = self.world.coefficients.wall(self.particles.species[slot]);
        let answer = self.world.law.strike(kind, &contact, memory);
        if answer == ContactForce::default() {
            return 0.0;
        }
        joint.remembers = true;
        self.push_wall::<PLANAR>(number, &answer);
        self.move_containers();
        let joints = &mut self.joints;
        let speed = answer.normal.abs() * joints.movers[slot].gain;
        if round.notes(speed, contact.fall) {
            joints.changed[slot] = round.number + 1;
        }
        speed
    }

    /// Gives a particle and a wall what their joint answers.
    #[inline(always)]
    pub(super) fn push_wall<const PLANAR: bool>(&mut self, number: usize, answer: &ContactForce) {
        let joints = &mut self.joints;
        let joint = &joints.walls.joints[number];
        let (force, [torque, _]) = joint.resolve::<PLANAR>(answer);
        let (slot, wall) = (joint.bodies[0] as usize, joint.bodies[1] as usize);
        let cavity = joint.cavity as usize;
        joints.movers[slot].take::<PLANAR>(force, torque);
        let container = &joints.containers[cavity];
        let impulse = -force * container.surroundings.time_step;
        self.mount.strike(cavity, impulse, &mut joints.rates);
        let arm = joint.normal * -joint.radii[0];
        let place = self.particles.position.get(slot) - container.origin + arm;
        self.wall_loads[wall].react(force, answer.couple, place);
        let number = joints.pairs.joints.len() + number;
        if let Some(given) = joints.given.get_mut(number) {
            given.add(answer);
        }
    }

    /// Gives the containers the velocities that the mount's coordinates have. One without coordinates does
    /// not yield.
    pub(super) fn move_containers(&mut self) {
        let degrees = self.mount.degrees();
        if degrees == 0 {
            return;
        }
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
        round: &Round,
    ) -> f64 {
        let mut largest = 0.0;
        let count = self.pairs.joints.len();
        for turn in 0..count {
            let number = if round.number.is_multiple_of(2) {
                turn
            } else {
                count - 1 - turn
            };
            let changed = |slot: u32| self.changed[slot as usize] >= round.number;
            let [first, second] = self.pairs.joints[number].bodies.map(changed);
            if first || second {
                let speed = self.strike_pair::<C, PLANAR>(world, number, round);
                largest = at_least(speed, largest);
            }
        }
        largest
    }

    #[inline(always)]
    fn strike_pair<C: Cavity, const PLANAR: bool>(
        &mut self,
        world: &World<C, L>,
        number: usize,
        round: &Round,
    ) -> f64 {
        let joint = &mut self.pairs.joints[number];
        let memory = &mut self.pairs.memories[number];
        let contact = joint.between::<PLANAR>(&self.movers, &self.containers);
        let kind = kind_of_pair(world, &self.kinds, number);
        let answer = world.law.strike(kind, &contact, memory);
        if answer == ContactForce::default() {
            return 0.0;
        }
        joint.remembers = true;
        let bodies = joint.bodies;
        let gain = self.push_pair::<PLANAR>(number, &answer);
        let speed = answer.normal.abs() * gain;
        if round.notes(speed, contact.fall) {
            for slot in bodies {
                self.changed[slot as usize] = round.number + 1;
            }
        }
        speed
    }

    /// Gives two particles what their joint answers. Returns what relative velocity a force in N along
    /// the normal gives them, 1/kg s.
    #[inline(always)]
    pub(super) fn push_pair<const PLANAR: bool>(
        &mut self,
        number: usize,
        answer: &ContactForce,
    ) -> f64 {
        let joint = &self.pairs.joints[number];
        let (force, [first, second]) = joint.resolve::<PLANAR>(answer);
        let [i, j] = joint.bodies.map(|slot| slot as usize);
        self.movers[i].take::<PLANAR>(force, first);
        self.movers[j].take::<PLANAR>(-force, second);
        if let Some(given) = self.given.get_mut(number) {
            given.add(answer);
        }
        self.movers[i].gain + self.movers[j].gain
    }
}
