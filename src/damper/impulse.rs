//! Impulse laws: one evaluation at the start of a step, held over the step.

use glam::{DMat3, DVec3};

use super::Partner;
use super::block::Place;
use super::candidates::Candidates;
use super::engine::Engine;
use super::error::StepError;
use super::scene::{Grain, PairContact, Scene, WallLoad, wall_contact};
use super::smallest_radius;
use crate::cavity::Cavity;
use crate::contact::{Contact, ContactForce, Stored};
use crate::detector::Detector;
use crate::law::{ContactLaw, Evaluation};
use crate::mount::Mount;
use crate::observer::{ContactEvent, Observer};

/// How often the contacts are gone through at the most.
const ROUNDS: usize = 16;

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
        self.prepare_impulses(time_step);
        self.strike_in_rounds(time_step, observer);
        self.advance_memories(time_step);
        self.hold(time_step)?;
        self.world.stamp = self.world.stamp.wrapping_add(1);
        self.accelerate_mount(self.time);
        self.check_overlaps()
    }

    /// Rounds to and fro, so that an impulse crosses the bed in one step whichever way it goes, until
    /// what is left of the approach cannot make a notable overlap.
    fn strike_in_rounds<O: Observer>(&mut self, time_step: f64, observer: &mut O) {
        let sequential = self.world.law.evaluation() == Evaluation::Sequential;
        let negligible = NEGLIGIBLE_APPROACH * smallest_radius(&self.particles.kinds) / time_step;
        for round in 0..if sequential { ROUNDS } else { 1 } {
            let pairs = self.strike_pairs(round, time_step, observer);
            let walls = self.strike_walls(time_step, observer);
            if pairs.max(walls) < negligible {
                break;
            }
        }
        for block in &mut self.blocks {
            block.contacts = block.contacts_in_reach();
        }
    }

    /// Sets the working velocities, and looks ahead to what the containers gain over the step.
    fn prepare_impulses(&mut self, time_step: f64) {
        self.wall_loads.fill(WallLoad::default());
        self.accelerate_mount(self.time);
        let degrees = self.mount.degrees();
        let state = &self.mount_state;
        let coordinates = &state.position[..degrees];
        let rates = &state.velocity[..degrees];
        let scratch = &mut self.scratch;
        scratch.velocity.clone_from(&self.particles.velocity);
        scratch.spin.clone_from(&self.particles.spin);

        let ahead = rates
            .iter()
            .zip(&state.acceleration)
            .map(|(v, a)| v + a * time_step);
        scratch.rates.clear();
        scratch.rates.extend(ahead);
        scratch.gain.clear();
        let end = self.time + time_step;
        for (cavity, room) in self.world.rooms.iter().enumerate() {
            let ahead = self.mount.motion(end, coordinates, &scratch.rates, cavity);
            scratch.gain.push(ahead.velocity - room.motion.velocity);
        }
        scratch.rates.clear();
        scratch.rates.extend_from_slice(rates);
    }

    /// Strikes all pairs, in even rounds in ascending order, in odd ones in descending order. Returns
    /// the largest approach speed met.
    fn strike_pairs<O: Observer>(&mut self, round: usize, time_step: f64, observer: &mut O) -> f64 {
        let mut largest = 0.0_f64;
        let sequential = self.world.law.evaluation() == Evaluation::Sequential;
        let particles = &self.particles;
        let scene = self.world.scene(particles, time_step);
        let (velocity, spin) = (&mut self.scratch.velocity, &mut self.scratch.spin);
        let ascending = round.is_multiple_of(2);
        for block in &mut self.blocks {
            let mut lists = [&block.pairs, &block.border];
            if !ascending {
                lists.reverse();
            }
            for list in lists {
                let count = list.contacts.len();
                for turn in 0..count {
                    let touch = list.touch(if ascending { turn } else { count - 1 - turn });
                    let (i, j) = (touch.first as usize, touch.second as usize);
                    let working = |velocity: &[DVec3], spin: &[DVec3]| {
                        let struck = |slot| struck(&scene, slot, velocity, spin);
                        PairContact::new(&struck(i), &struck(j), &touch, time_step)
                    };
                    let mut pair = if sequential {
                        working(velocity, spin)
                    } else {
                        working(scene.velocity, scene.spin)
                    };
                    let inverse_mass = DVec3::splat(particles.inverse_mass[j]);
                    pair.contact.mobility = DMat3::from_diagonal(inverse_mass);
                    let own = list.prepared(touch.place);
                    let (first, second) = (particles.species[i], particles.species[j]);
                    let kind = scene.coefficients.pair(first, second, own);
                    let memory = list.memory(touch.place, scene.stamp);
                    let answer = scene.law.force(&kind, &pair.contact, &memory);

                    block.largest_overlap = block.largest_overlap.max(pair.contact.overlap);
                    if answer == ContactForce::default() {
                        continue;
                    }
                    largest = largest.max(pair.contact.approach_speed());
                    let watched = observer.wants_contacts();
                    let before = watched.then(|| working(velocity, spin).contact);
                    let (force, first, second) = pair.resolve(&answer);
                    velocity[i] += force * (time_step * particles.inverse_mass[i]);
                    velocity[j] -= force * (time_step * particles.inverse_mass[j]);
                    spin[i] += first * (time_step * particles.inverse_inertia[i]);
                    spin[j] += second * (time_step * particles.inverse_inertia[j]);
                    if let Some(before) = before {
                        let after = working(velocity, spin).contact;
                        observer.contact(&ContactEvent {
                            particle: particles.number[i] as usize,
                            partner: Partner::Particle(particles.number[j] as usize),
                            cavity: self.world.cavity_of(i),
                            ..impulse(pair.contact, answer, &before, &after)
                        });
                    }
                }
            }
        }
        largest
    }

    /// Strikes all walls. Returns the largest approach speed met.
    fn strike_walls<O: Observer>(&mut self, time_step: f64, observer: &mut O) -> f64 {
        let mut largest = 0.0_f64;
        let sequential = self.world.law.evaluation() == Evaluation::Sequential;
        let degrees = self.mount.degrees();
        let particles = &self.particles;
        let scene = self.world.scene(&self.particles, time_step);
        let (velocity, spin) = (&mut self.scratch.velocity, &mut self.scratch.spin);
        let rates = &mut self.scratch.rates;
        let gravity = self.gravity * time_step;
        for block in &mut self.blocks {
            for number in 0..block.walls.contacts.len() {
                let touch = block.walls.touch(number);
                let (slot, wall) = (touch.first as usize, touch.second);
                let cavity = scene.cavity_of_wall(wall);
                let room = &self.world.rooms[cavity];
                let point = scene.wall_point(wall, scene.position[slot]);
                let working = |velocity: &[DVec3], spin: &[DVec3], rates: &[f64]| {
                    let coordinates = &self.mount_state.position[..degrees];
                    let container = self.mount.motion(self.time, coordinates, rates, cavity);
                    let grain = struck(&scene, slot, velocity, spin);
                    wall_contact(&grain, &point, [container.velocity, DVec3::ZERO], time_step)
                };
                let mut contact = if sequential {
                    working(velocity, spin, rates)
                } else {
                    wall_contact(
                        &struck(&scene, slot, scene.velocity, scene.spin),
                        &point,
                        [room.motion.velocity, DVec3::ZERO],
                        time_step,
                    )
                };
                contact.velocity_ahead = contact.velocity + gravity - self.scratch.gain[cavity];
                contact.mobility = self.mount.mobility(cavity);
                let kind = scene.coefficients.wall(particles.species[slot]);
                let memory = block.walls.memory(touch.place, scene.stamp);
                let answer = scene.law.force(kind, &contact, &memory);

                block.largest_overlap = block.largest_overlap.max(contact.overlap);
                let partner = Partner::Wall(wall - room.first_wall);
                if point.distance < 0.0 {
                    block.escaped = Some(Place { slot, partner });
                }
                if answer == ContactForce::default() {
                    continue;
                }
                largest = largest.max(contact.approach_speed());
                let watched = observer.wants_contacts();
                let before = watched.then(|| working(velocity, spin, rates));
                let force = contact.normal * answer.normal + answer.tangential;
                let arm = contact.normal * -particles.radius[slot];
                let torque = arm.cross(answer.tangential) + answer.couple;
                velocity[slot] += force * (time_step * particles.inverse_mass[slot]);
                spin[slot] += torque * (time_step * particles.inverse_inertia[slot]);
                self.mount.strike(cavity, -force * time_step, rates);
                let place = particles.position[slot] - room.motion.position + arm;
                self.wall_loads[wall as usize].react(force, answer.couple, place);
                if let Some(before) = before {
                    let after = working(velocity, spin, rates);
                    observer.contact(&ContactEvent {
                        particle: particles.number[slot] as usize,
                        partner,
                        cavity,
                        ..impulse(contact, answer, &before, &after)
                    });
                }
            }
        }
        largest
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
                    let (i, j) = (touch.first as usize, touch.second as usize);
                    let pair = PairContact::new(&struck(i), &struck(j), &touch, time_step);
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
                let grain = struck(touch.first as usize);
                let point = scene.wall_point(touch.second, grain.position);
                let container = scene.room_of_wall(touch.second).motion.velocity;
                let container = [container, DVec3::ZERO];
                let contact = wall_contact(&grain, &point, container, time_step);
                let kind = scene
                    .coefficients
                    .wall(particles.species[touch.first as usize]);
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
        let mut sum = DVec3::ZERO;
        for (n, acceleration) in particles.acceleration.iter_mut().enumerate() {
            *acceleration = (scratch.velocity[n] - particles.velocity[n]) * rate + self.gravity;
            sum += *acceleration;
        }
        for (n, acceleration) in particles.angular_acceleration.iter_mut().enumerate() {
            *acceleration = (scratch.spin[n] - particles.spin[n]) * rate;
            sum += *acceleration;
        }
        if sum.is_finite() {
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
        acceleration: DVec3::ZERO,
        angular_acceleration: DVec3::ZERO,
        ..scene.grain(slot)
    }
}

/// What an observer is told of an impulse that has changed the working velocities from those of
/// `before` to those of `after`; who was struck is left open.
fn impulse(
    contact: Contact,
    force: ContactForce,
    before: &Contact,
    after: &Contact,
) -> ContactEvent {
    // Half of what the step adds by itself goes before the impulse: then the energies of impulses,
    // gravity and the container's motion add up to the change over the step.
    let ahead = contact.velocity_ahead - contact.velocity;
    ContactEvent {
        particle: 0,
        partner: Partner::Wall(0),
        cavity: 0,
        contact,
        force,
        stored: Stored::default(),
        working_velocity: 0.5 * (before.velocity + after.velocity + ahead),
        working_spin: 0.5 * (before.spins[0] - before.spins[1] + (after.spins[0] - after.spins[1])),
    }
}
