//! What observers are told of impulses.

use glam::{DMat3, DVec3};

use super::struck;
use crate::cavity::Cavity;
use crate::contact::{Contact, ContactForce, Stored};
use crate::damper::Partner;
use crate::damper::engine::Engine;
use crate::damper::scene::{Grain, PairContact, wall_contact};
use crate::damper::vectors::vector;
use crate::detector::Detector;
use crate::law::ContactLaw;
use crate::mount::Mount;
use crate::observer::{ContactEvent, Observer};

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Tells `observer` of every contact that was struck, with the sum of what it was given.
    pub(super) fn report_impulses<O: Observer>(&self, time_step: f64, observer: &mut O) {
        let particles = &self.particles;
        let scene = self.world.scene(particles, time_step);
        let scratch = &self.scratch;
        let coordinates = &self.mount_state.position[..self.mount.degrees()];
        let before = |slot| scene.grain(slot);
        let after = |slot| struck(&scene, slot, &scratch.velocity, &scratch.spin);
        let mut given = scratch.given.iter();
        for block in &self.blocks {
            for list in [&block.pairs, &block.border] {
                for (touch, given) in list.touching().zip(&mut given) {
                    if *given == ContactForce::default() {
                        continue;
                    }
                    let [i, j] = touch.bodies.map(|slot| slot as usize);
                    let pair = |first: Grain, second: Grain| {
                        let mut pair = PairContact::new(&first, &second, time_step);
                        let inverse_mass = DVec3::splat(particles.inverse_mass[j]);
                        pair.contact.mobility = DMat3::from_diagonal(inverse_mass);
                        pair.contact.fall = scratch.fall[self.world.cavity_of(i)];
                        pair.contact
                    };
                    let contact = pair(before(i), before(j));
                    observer.contact(&ContactEvent {
                        particle: particles.number[i] as usize,
                        partner: Partner::Particle(particles.number[j] as usize),
                        cavity: self.world.cavity_of(i),
                        ..impulse(contact, *given, &pair(after(i), after(j)))
                    });
                }
            }
            for (touch, given) in block.walls.touching().zip(&mut given) {
                if *given == ContactForce::default() {
                    continue;
                }
                let (slot, wall) = (touch.bodies[0] as usize, touch.bodies[1]);
                let cavity = scene.cavity_of_wall(wall);
                let room = &self.world.rooms[cavity];
                let point = scene.wall_point(wall, vector(&scene.position, slot));
                let at_wall = |grain: Grain, container: DVec3| {
                    let mut contact = wall_contact(&grain, &point, container, time_step);
                    let fall = self.gravity * time_step - scratch.gain[cavity];
                    contact.velocity_ahead = contact.velocity + fall;
                    contact.fall = scratch.fall[cavity];
                    contact.mobility = self.mount.mobility(cavity);
                    contact
                };
                let contact = at_wall(before(slot), room.motion.velocity);
                let rates = &scratch.rates;
                let container = self.mount.motion(self.time, coordinates, rates, cavity);
                observer.contact(&ContactEvent {
                    particle: particles.number[slot] as usize,
                    partner: Partner::Wall(wall - room.first_wall),
                    cavity,
                    ..impulse(contact, *given, &at_wall(after(slot), container.velocity))
                });
            }
        }
    }
}

/// What an observer is told of a contact that was given `force` over the step, which all impulses
/// together have changed from `contact` to `after`; who it was is left open.
fn impulse(contact: Contact, force: ContactForce, after: &Contact) -> ContactEvent {
    // Half of what the step adds by itself goes before the impulses: then the energies of impulses,
    // gravity and the container's motion add up to the change over the step.
    let ahead = contact.velocity_ahead - contact.velocity;
    let spin = |contact: &Contact| contact.spins[0] - contact.spins[1];
    ContactEvent {
        particle: 0,
        partner: Partner::Wall(0),
        cavity: 0,
        contact,
        force,
        stored: Stored::default(),
        working_velocity: 0.5 * (contact.velocity + after.velocity + ahead),
        working_spin: 0.5 * (spin(&contact) + spin(after)),
    }
}
