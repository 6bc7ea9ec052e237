//! Impulse laws: one evaluation at the start of a step, held over the step.

use glam::{DMat3, DVec3};

use super::Partner;
use super::block::Place;
use super::engine::Engine;
use super::error::StepError;
use super::scene::WallLoad;
use super::smallest_radius;
use crate::cavity::Cavity;
use crate::contact::{Contact, ContactForce, Stored};
use crate::detector::Detector;
use crate::law::{ContactLaw, Evaluation};
use crate::mount::Mount;
use crate::observer::{ContactEvent, Observer};

/// How often the contacts are gone through at the most.
const ROUNDS: usize = 4;

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
            block.contacts = block.touching().0.len() + block.touching().1.len();
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
        let scene = self.world.scene(&self.particles, time_step);
        let (velocity, spin) = (&mut self.scratch.velocity, &mut self.scratch.spin);
        for block in &mut self.blocks {
            let count = block.touching().0.len();
            for turn in 0..count {
                let index = if round.is_multiple_of(2) {
                    turn
                } else {
                    count - 1 - turn
                };
                let touch = block.touching().0[index];
                let (i, j) = (touch.first as usize, touch.second as usize);
                let mut pair = if sequential {
                    scene.pair_with(i, j, velocity, spin)
                } else {
                    scene.pair(i, j)
                };
                pair.contact.mobility =
                    DMat3::from_diagonal(DVec3::splat(particles.inverse_mass[j]));
                let list = block.list_of_pair(index);
                let kinds = (particles.species[i], particles.species[j]);
                let kind = scene
                    .coefficients
                    .pair(kinds.0, kinds.1, list.prepared(touch.place));
                let memory = list.memory(touch.place, scene.stamp);
                let answer = scene.law.force(&kind, &pair.contact, &memory);
                let memory = scene.law.advance(&kind, &pair.contact, &memory);
                list.keep(touch.place, scene.stamp.wrapping_add(1), memory);

                if answer.normal > 0.0 {
                    largest = largest.max(pair.contact.approach_speed());
                }
                block.largest_overlap = block.largest_overlap.max(pair.contact.overlap);
                let watched = answer.normal > 0.0 && observer.wants_contacts();
                let before = watched.then(|| scene.pair_with(i, j, velocity, spin).contact);
                let (force, first, second) = pair.resolve(&answer);
                velocity[i] += force * (time_step * particles.inverse_mass[i]);
                velocity[j] -= force * (time_step * particles.inverse_mass[j]);
                spin[i] += first * (time_step * particles.inverse_inertia[i]);
                spin[j] += second * (time_step * particles.inverse_inertia[j]);
                if let Some(before) = before {
                    let after = scene.pair_with(i, j, velocity, spin).contact;
                    let event = struck(pair.contact, answer, &before, &after);
                    observer.contact(&ContactEvent {
                        particle: particles.number[i] as usize,
                        partner: Partner::Particle(particles.number[j] as usize),
                        cavity: self.world.rooms.partition_point(|room| room.slots.end <= i),
                        ..event
                    });
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
            for index in 0..block.touching().1.len() {
                let touch = block.touching().1[index];
                let (slot, wall) = (touch.first as usize, touch.second);
                let cavity = scene.cavity_of_wall(wall);
                let room = &self.world.rooms[cavity];
                let working = |velocity: &[DVec3], spin: &[DVec3], rates: &[f64]| {
                    let coordinates = &self.mount_state.position[..degrees];
                    let container = self.mount.motion(self.time, coordinates, rates, cavity);
                    let (velocity, spin) = (velocity[slot], spin[slot]);
                    scene.wall_with(slot, wall, velocity, spin, container.velocity)
                };
                let (distance, mut contact) = if sequential {
                    working(velocity, spin, rates)
                } else {
                    scene.wall(slot, wall)
                };
                contact.velocity_ahead = contact.velocity + gravity - self.scratch.gain[cavity];
                contact.mobility = self.mount.mobility(cavity);
                let kind = scene.coefficients.wall(particles.species[slot]);
                let memory = block.walls.memory(touch.place, scene.stamp);
                let answer = scene.law.force(kind, &contact, &memory);
                let memory = scene.law.advance(kind, &contact, &memory);
                block
                    .walls
                    .keep(touch.place, scene.stamp.wrapping_add(1), memory);

                if answer.normal > 0.0 {
                    largest = largest.max(contact.approach_speed());
                }
                block.largest_overlap = block.largest_overlap.max(contact.overlap);
                let partner = Partner::Wall(wall - room.first_wall);
                if distance < 0.0 {
                    block.escaped = Some(Place { slot, partner });
                }
                let watched = answer.normal > 0.0 && observer.wants_contacts();
                let before = watched.then(|| working(velocity, spin, rates).1);
                let force = contact.normal * answer.normal + answer.tangential;
                let arm = contact.normal * -particles.radius[slot];
                let torque = arm.cross(answer.tangential) + answer.couple;
                velocity[slot] += force * (time_step * particles.inverse_mass[slot]);
                spin[slot] += torque * (time_step * particles.inverse_inertia[slot]);
                self.mount.strike(cavity, -force * time_step, rates);
                let place = particles.position[slot] - room.motion.position + arm;
                self.wall_loads[wall as usize].react(force, answer.couple, place);
                if let Some(before) = before {
                    let after = working(velocity, spin, rates).1;
                    let event = struck(contact, answer, &before, &after);
                    observer.contact(&ContactEvent {
                        particle: particles.number[slot] as usize,
                        partner,
                        cavity,
                        ..event
                    });
                }
            }
        }
        largest
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
        }
        if sum.is_finite() {
            Ok(())
        } else {
            self.check_accelerations()
        }
    }
}

/// What an observer is told of an impulse that has changed the working velocities from those of
/// `before` to those of `after`; who was struck is left open.
fn struck(
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
