//! What observers are told of impulses.

use super::joint::{Container, Joints, Mover};
use crate::cavity::Cavity;
use crate::contact::{Contact, ContactForce, Stored};
use crate::damper::Partner;
use crate::damper::engine::Engine;
use crate::detector::Detector;
use crate::law::ContactLaw;
use crate::mount::Mount;
use crate::observer::{ContactEvent, Observer};

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Tells `observer` of every contact that was struck, with the sum of what it was given.
    pub(super) fn report_impulses<O: Observer>(&self, observer: &mut O) {
        let Joints {
            pairs,
            walls,
            movers,
            containers,
            given,
            ..
        } = &self.joints;
        let particles = &self.particles;
        let number = |slot: u32| particles.number[slot as usize] as usize;
        let after = |slot: u32| movers[slot as usize];
        let before = |slot: u32| Mover {
            velocity: particles.velocity.get(slot as usize),
            spin: particles.spin.get(slot as usize),
            ..after(slot)
        };
        let mut given = given.iter();
        for (joint, given) in pairs.iter().zip(&mut given) {
            if *given == ContactForce::default() {
                continue;
            }
            let cavity = joint.cavity as usize;
            let contact = |mover: &dyn Fn(u32) -> Mover| {
                let [first, second] = joint.bodies.map(mover);
                joint.between([&first, &second], &containers[cavity])
            };
            observer.contact(&ContactEvent {
                particle: number(joint.bodies[0]),
                partner: Partner::Particle(number(joint.bodies[1])),
                cavity,
                ..impulse(contact(&before), *given, &contact(&after))
            });
        }
        for (joint, given) in walls.iter().zip(&mut given) {
            if *given == ContactForce::default() {
                continue;
            }
            let [slot, wall] = joint.bodies;
            let cavity = joint.cavity as usize;
            let room = &self.world.rooms[cavity];
            let container = &containers[cavity];
            let start = Container {
                velocity: room.motion.velocity,
                ..*container
            };
            let contact = joint.at_wall(&before(slot), &start);
            let after = joint.at_wall(&after(slot), container);
            observer.contact(&ContactEvent {
                particle: number(slot),
                partner: Partner::Wall(wall - room.first_wall),
                cavity,
                ..impulse(contact, *given, &after)
            });
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
