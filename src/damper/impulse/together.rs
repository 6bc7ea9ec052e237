//! Impulses that do not wait for each other: what contacts carry over from the step before, and those
//! of laws that take all contacts at once.

use super::joint::{Joints, kind_of_pair};
use crate::cavity::Cavity;
use crate::damper::candidates::Candidates;
use crate::damper::engine::Engine;
use crate::damper::scene::World;
use crate::detector::Detector;
use crate::law::ContactLaw;
use crate::mount::Mount;

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Gives what contacts carry over from the step before: all of it, if that leaves no more kinetic
    /// energy at the end of the step than without, else the part that leaves least. Energies are those
    /// of motion relative to the containers, which contacts can but lessen. Returns whether there was
    /// anything to give: what contacts at rest gave in the step before, they are likely to give again.
    pub(super) fn carry_impulses(&mut self, time_step: f64) -> bool {
        if !self.carry(1.0) {
            return false;
        }
        let [slope, curvature] = self.energy_of_blows(time_step);
        if slope + curvature <= 0.0 {
            return true;
        }
        self.start_impulses();
        self.carry((-0.5 * slope / curvature).max(0.0))
    }

    /// Gives `part` of what contacts carry over, and tells whether there was anything.
    fn carry(&mut self, part: f64) -> bool {
        let world = &self.world;
        let mut any = if world.planar() {
            self.joints.carry_pairs::<C, true>(world, part)
        } else {
            self.joints.carry_pairs::<C, false>(world, part)
        };
        for number in 0..self.joints.walls.joints.len() {
            let joints = &mut self.joints;
            let joint = &mut joints.walls.joints[number];
            let memory = &mut joints.walls.memories[number];
            if !joint.remembers {
                continue;
            }
            let contact = joint.at_wall::<false>(&joints.starts, &joints.containers);
            let species = self.particles.species[joint.bodies[0] as usize];
            let kind = self.world.coefficients.wall(species);
            let answer = self.world.law.carry(kind, &contact, memory, part);
            if joint.goes_on(&answer, memory) {
                any = true;
                self.push_wall::<false>(number, &answer);
            }
        }
        self.move_containers();
        any
    }

    /// How the kinetic energy in J of what the impulses so far have added to all velocities grows with
    /// a part of them: in proportion, and with the square. It is that at the end of the step, relative
    /// to the containers as they would be without impulses.
    fn energy_of_blows(&self, time_step: f64) -> [f64; 2] {
        let joints = &self.joints;
        let (mut slope, mut curvature) = (0.0, 0.0);
        for (room, container) in self.world.rooms.iter().zip(&joints.containers) {
            let ahead = container.surroundings.ahead - room.motion.velocity;
            let starts = &joints.starts[room.slots.clone()];
            for (start, mover) in starts.iter().zip(&joints.movers[room.slots.clone()]) {
                let (mass, inertia) = (time_step / start.gain, time_step / start.turn);
                let gain = (mover.velocity - start.velocity) * mass;
                let turn = (mover.spin - start.spin) * inertia;
                slope += gain.dot(start.velocity + ahead) + turn.dot(start.spin);
                curvature += 0.5
                    * (gain.dot(mover.velocity - start.velocity)
                        + turn.dot(mover.spin - start.spin));
            }
            let yielded = container.velocity - room.motion.velocity;
            curvature += 0.5 * room.load(&self.wall_loads).dot(yielded) * time_step;
        }
        [slope, curvature]
    }

    /// Strikes all contacts, and advances what they remember with the velocities after the impulses.
    pub(super) fn strike_at_once(&mut self) {
        self.joints.strike_pairs_at_once(&self.world);
        for number in 0..self.joints.walls.joints.len() {
            let joints = &self.joints;
            let joint = &joints.walls.joints[number];
            let memory = &joints.walls.memories[number];
            let contact = joint.at_wall::<false>(&joints.starts, &joints.containers);
            let species = self.particles.species[joint.bodies[0] as usize];
            let kind = self.world.coefficients.wall(species);
            let answer = self.world.law.force(kind, &contact, memory);
            self.push_wall::<false>(number, &answer);
        }
        self.move_containers();
        if !Candidates::<L>::REMEMBERS {
            return;
        }
        let world = &self.world;
        let joints = &mut self.joints;
        for (number, (joint, memory)) in joints.pairs.iter_mut().enumerate() {
            let contact = joint.between::<false>(&joints.movers, &joints.containers);
            let kind = kind_of_pair(world, &joints.kinds, number);
            *memory = world.law.advance(kind, &contact, memory);
            joint.remembers = true;
        }
        for (joint, memory) in joints.walls.iter_mut() {
            let contact = joint.at_wall::<false>(&joints.movers, &joints.containers);
            let kind = world
                .coefficients
                .wall(self.particles.species[joint.bodies[0] as usize]);
            *memory = world.law.advance(kind, &contact, memory);
            joint.remembers = true;
        }
    }
}

impl<L: ContactLaw> Joints<L> {
    fn carry_pairs<C: Cavity, const PLANAR: bool>(
        &mut self,
        world: &World<C, L>,
        part: f64,
    ) -> bool {
        let mut any = false;
        for number in 0..self.pairs.joints.len() {
            let joint = &mut self.pairs.joints[number];
            let memory = &mut self.pairs.memories[number];
            if !joint.remembers {
                continue;
            }
            let contact = joint.between::<PLANAR>(&self.starts, &self.containers);
            let kind = kind_of_pair(world, &self.kinds, number);
            let answer = world.law.carry(kind, &contact, memory, part);
            if joint.goes_on(&answer, memory) {
                any = true;
                self.push_pair::<PLANAR>(number, &answer);
            }
        }
        any
    }

    fn strike_pairs_at_once<C: Cavity>(&mut self, world: &World<C, L>) {
        for number in 0..self.pairs.joints.len() {
            let joint = &self.pairs.joints[number];
            let memory = &self.pairs.memories[number];
            let contact = joint.between::<false>(&self.starts, &self.containers);
            let kind = kind_of_pair(world, &self.kinds, number);
            let answer = world.law.force(kind, &contact, memory);
            self.push_pair::<false>(number, &answer);
        }
    }
}
