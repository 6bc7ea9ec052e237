//! Impulse laws: one evaluation at the start of a step, held over the step.

use glam::DVec3;

use super::Partner;
use super::block::Block;
use super::candidates::Candidates;
use super::engine::Engine;
use super::error::StepError;
use super::scene::{Grain, PairContact, Scene, WallLoad, wall_contact};
use super::smallest_radius;
use crate::cavity::Cavity;
use crate::contact::ContactForce;
use crate::detector::Detector;
use crate::law::{ContactLaw, Evaluation};
use crate::mount::Mount;
use crate::observer::Observer;

mod carry;
mod pass;
mod report;

use pass::Pass;

/// How often the contacts are gone through at the most.
const ROUNDS: usize = 16;

/// How often they are gone through if some bear what they bore in the step before.
const RESTING_ROUNDS: usize = 4;

/// Approach within a step, as a part of what a particle gains in free fall, that needs no further
/// round of a bed at rest.
const STILL: f64 = 0.02;

/// Approach in the first round, as a multiple of what a particle gains in free fall, from which a bed is
/// not taken for one at rest.
const STIRRED: f64 = 20.0;

/// Approach within a step, as a fraction of the smallest radius, that needs no further round.
const NEGLIGIBLE_APPROACH: f64 = 0.01;

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Strikes all contacts, and leaves the accelerations that hold over a step of `time_step`.
    ///
    /// Where contacts follow one another, each sees the velocities that those before it left.
    pub(crate) fn strike<O: Observer>(
        &mut self,
        time_step: f64,
        observer: &mut O,
    ) -> Result<(), StepError> {
        self.place_containers(self.time)?;
        self.find_contacts(true)?;
        for block in &mut self.blocks {
            block.forget();
        }
        self.prepare_impulses(time_step, observer.wants_contacts());
        if self.world.law.evaluation() == Evaluation::Sequential {
            let resting = Candidates::<L>::REMEMBERS && self.carry_impulses(time_step);
            self.strike_in_rounds(time_step, resting);
        } else {
            self.pass(Pass::Simultaneous, time_step);
            self.advance_memories(time_step);
        }
        for block in &mut self.blocks {
            block.contacts = block.contacts_in_reach();
        }
        if observer.wants_contacts() {
            self.report_impulses(time_step, observer);
        }
        self.hold(time_step)?;
        self.world.stamp = self.world.stamp.wrapping_add(1);
        self.accelerate_mount(self.time);
        self.check_overlaps()
    }

    /// Rounds to and fro, so that an impulse crosses the bed in one step whichever way it goes, until
    /// what is left of the approach cannot make a notable overlap.
    fn strike_in_rounds(&mut self, time_step: f64, mut resting: bool) {
        let negligible = NEGLIGIBLE_APPROACH * smallest_radius(&self.particles.kinds) / time_step;
        let fall = self.scratch.fall.iter().copied().fold(0.0, f64::max);
        for round in 0..ROUNDS {
            let ascending = round.is_multiple_of(2);
            let passed = self.pass(Pass::Sequential { ascending }, time_step);
            resting &= passed.approach < STIRRED * fall;
            let still = !resting || round + 1 >= RESTING_ROUNDS || passed.approach < STILL * fall;
            if passed.approach < negligible && still {
                break;
            }
        }
    }

    /// Sets the working velocities, and looks ahead to what the containers gain over the step.
    fn prepare_impulses(&mut self, time_step: f64, watched: bool) {
        self.wall_loads.fill(WallLoad::default());
        self.accelerate_mount(self.time);
        let degrees = self.mount.degrees();
        let state = &self.mount_state;
        let coordinates = &state.position[..degrees];
        let rates = &state.velocity[..degrees];
        let scratch = &mut self.scratch;
        scratch.start_from(&self.particles);

        let ahead = rates
            .iter()
            .zip(&state.acceleration)
            .map(|(v, a)| v + a * time_step);
        scratch.rates.clear();
        scratch.rates.extend(ahead);
        scratch.gain.clear();
        scratch.fall.clear();
        scratch.origin.clear();
        let end = self.time + time_step;
        for (cavity, room) in self.world.rooms.iter().enumerate() {
            let ahead = self.mount.motion(end, coordinates, &scratch.rates, cavity);
            let gain = ahead.velocity - room.motion.velocity;
            scratch.gain.push(gain);
            scratch.origin.push(room.motion.position);
            scratch
                .fall
                .push((self.gravity * time_step - gain).length());
        }
        scratch.rates.clear();
        scratch.rates.extend_from_slice(rates);

        scratch.given.clear();
        if watched {
            let contacts = self.blocks.iter().map(Block::contacts_in_reach).sum();
            scratch.given.resize(contacts, ContactForce::default());
        }
    }

    /// Refuses particles that a container has left behind in the step: where it moves by more than a
    /// radius, the walls that meet them are not looked at before the next.
    pub(crate) fn check_left_behind(&self) -> Result<(), StepError> {
        let radius = smallest_radius(&self.particles.kinds);
        for (room, origin) in self.world.rooms.iter().zip(&self.scratch.origin) {
            let position = room.motion.position;
            if !self.contained || position.distance(*origin) <= radius {
                continue;
            }
            for slot in room.slots.clone() {
                let point = self.particles.position.get(slot) - position;
                let outside = |wall: &u32| room.cavity.wall(*wall, point).distance < 0.0;
                if let Some(wall) = (0..room.cavity.walls()).find(outside) {
                    return Err(self.escaped(slot, Partner::Wall(wall)));
                }
            }
        }
        Ok(())
    }

    /// Advances the memory of all contacts, with the velocities after the impulses.
    fn advance_memories(&mut self, time_step: f64) {
        if !Candidates::<L>::REMEMBERS {
            return;
        }
        let particles = &self.particles;
        let scene = self.world.scene(particles, time_step);
        let (velocity, spin) = (&self.scratch.velocity, &self.scratch.spin);
        let struck = |slot: usize| struck(&scene, slot, velocity, spin);
        let next = scene.stamp.wrapping_add(1);
        for block in &mut self.blocks {
            for list in [&mut block.pairs, &mut block.border] {
                for number in 0..list.contacts.len() {
                    let touch = list.touch(number);
                    let [i, j] = touch.bodies.map(|slot| slot as usize);
                    let pair = PairContact::new(&struck(i), &struck(j), time_step);
                    let own = list.prepared(touch.place);
                    let kinds = (particles.species[i], particles.species[j]);
                    let kind = scene.coefficients.pair(kinds.0, kinds.1, own);
                    let memory = list.memory(touch.place, scene.stamp);
                    let memory = scene.law.advance(&kind, &pair.contact, &memory);
                    list.keep(touch.place, next, memory);
                }
            }
            let walls = &mut block.walls;
            for number in 0..walls.contacts.len() {
                let touch = walls.touch(number);
                let (slot, wall) = (touch.bodies[0] as usize, touch.bodies[1]);
                let grain = struck(slot);
                let point = scene.wall_point(wall, grain.position);
                let container = scene.room_of_wall(wall).motion.velocity;
                let contact = wall_contact(&grain, &point, container, time_step);
                let kind = scene.coefficients.wall(particles.species[slot]);
                let memory = walls.memory(touch.place, scene.stamp);
                let memory = scene.law.advance(kind, &contact, &memory);
                walls.keep(touch.place, next, memory);
            }
        }
    }

    /// Turns the velocities after the impulses into accelerations that lead to them.
    fn hold(&mut self, time_step: f64) -> Result<(), StepError> {
        let (scratch, particles) = (&self.scratch, &mut self.particles);
        let rate = 1.0 / time_step;
        let struck = scratch.velocity.iter().zip(particles.velocity.iter());
        let struck = struck.map(|(struck, before)| (struck - before) * rate + self.gravity);
        particles.acceleration.assign(struck);
        let turned = scratch.spin.iter().zip(particles.spin.iter());
        let turned = turned.map(|(turned, before)| (turned - before) * rate);
        particles.angular_acceleration.assign(turned);
        if particles.acceleration.is_finite() && particles.angular_acceleration.is_finite() {
            Ok(())
        } else {
            self.check_accelerations()
        }
    }
}

/// The particle in a slot with other velocities than the scene's own.
fn struck<C: Cavity, L: ContactLaw>(
    scene: &Scene<'_, C, L>,
    slot: usize,
    velocity: &[DVec3],
    spin: &[DVec3],
) -> Grain {
    Grain {
        velocity: velocity[slot],
        spin: spin[slot],
        ..scene.grain(slot)
    }
}
