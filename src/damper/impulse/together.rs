//! Impulses of all joints from the same velocities, those at the start of the step.

use glam::DVec3;

use super::joint::{Joint, Joints};
use crate::cavity::Cavity;
use crate::contact::{Contact, ContactForce};
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
        let mut power = 0.0;
        let mut any = false;
        self.joints.visit(
            &self.world,
            &self.particles.species,
            |law, kind, contact, joint| {
                if !joint.remembers {
                    return ContactForce::default();
                }
                let answer = law.carry(kind, contact, &mut joint.memory, 1.0);
                joint.remembers = answer != ContactForce::default();
                if !joint.remembers {
                    joint.memory = L::Memory::default();
                    return answer;
                }
                any = true;
                let force = contact.normal * answer.normal + answer.tangential;
                let spin = contact.spins[0] - contact.spins[1];
                power += force.dot(contact.velocity_ahead) + answer.couple.dot(spin);
                answer
            },
        );
        if !any {
            return false;
        }
        self.push_all();
        let (slope, curvature) = (power * time_step, self.energy_of_blows(time_step));
        if slope + curvature <= 0.0 {
            return true;
        }
        let part = (-0.5 * slope / curvature).max(0.0);
        self.start_impulses(time_step);
        self.joints.visit(
            &self.world,
            &self.particles.species,
            |law, kind, contact, joint| {
                if joint.remembers {
                    law.carry(kind, contact, &mut joint.memory, part)
                } else {
                    ContactForce::default()
                }
            },
        );
        self.push_all();
        true
    }

    /// Strikes all contacts, and advances what they remember with the velocities after the impulses.
    pub(super) fn strike_at_once(&mut self) {
        let species = &self.particles.species;
        self.joints
            .visit(&self.world, species, |law, kind, contact, joint| {
                law.force(kind, contact, &joint.memory)
            });
        self.push_all();
        if Candidates::<L>::REMEMBERS {
            let species = &self.particles.species;
            self.joints
                .visit(&self.world, species, |law, kind, contact, joint| {
                    joint.memory = law.advance(kind, contact, &joint.memory);
                    joint.remembers = true;
                    ContactForce::default()
                });
        }
    }

    /// Gives all bodies what their joints answered.
    fn push_all(&mut self) {
        let joints = &mut self.joints;
        for (joint, answer) in joints.pairs.iter().zip(&joints.answers) {
            let (force, first, second) = joint.resolve(answer);
            let [i, j] = joint.bodies.map(|slot| slot as usize);
            joints.movers[i].take(force, first);
            joints.movers[j].take(-force, second);
        }
        let pairs = joints.pairs.len();
        for number in 0..joints.walls.len() {
            let answer = self.joints.answers[pairs + number];
            if answer != ContactForce::default() {
                self.push_wall(number, &answer);
            }
        }
        self.move_containers();
        let joints = &mut self.joints;
        if !joints.given.is_empty() {
            joints.given.copy_from_slice(&joints.answers);
        }
    }

    /// Kinetic energy in J of what the impulses so far have added to all velocities.
    fn energy_of_blows(&self, time_step: f64) -> f64 {
        let (joints, particles) = (&self.joints, &self.particles);
        let mut twice = 0.0;
        for (n, mover) in joints.movers.iter().enumerate() {
            let gain = mover.velocity - particles.velocity.get(n);
            let turn = mover.spin - particles.spin.get(n);
            twice += gain.length_squared() / particles.inverse_mass[n]
                + turn.length_squared() / particles.inverse_inertia[n];
        }
        for (room, container) in self.world.rooms.iter().zip(&joints.containers) {
            let first = room.first_wall as usize;
            let walls = &self.wall_loads[first..first + room.cavity.walls() as usize];
            let load: DVec3 = walls.iter().map(|wall| wall.force).sum();
            twice += load.dot(container.velocity - room.motion.velocity) * time_step;
        }
        0.5 * twice
    }
}

impl<L: ContactLaw> Joints<L> {
    /// Notes the answer to every joint's contact.
    fn visit<C>(
        &mut self,
        world: &World<C, L>,
        species: &[u32],
        mut answer: impl FnMut(&L, &L::Coefficients, &Contact, &mut Joint<L::Memory>) -> ContactForce,
    ) {
        let only = world.coefficients.only_pair();
        self.answers.clear();
        for (number, joint) in self.pairs.iter_mut().enumerate() {
            let contact = joint.between(
                joint.bodies.map(|slot| &self.movers[slot as usize]),
                &self.containers[joint.cavity as usize],
            );
            let kind = only.unwrap_or_else(|| &self.kinds[number]);
            self.answers.push(answer(&world.law, kind, &contact, joint));
        }
        for joint in &mut self.walls {
            let contact = joint.at_wall(
                &self.movers[joint.bodies[0] as usize],
                &self.containers[joint.cavity as usize],
            );
            let kind = world.coefficients.wall(species[joint.bodies[0] as usize]);
            self.answers.push(answer(&world.law, kind, &contact, joint));
        }
    }
}
