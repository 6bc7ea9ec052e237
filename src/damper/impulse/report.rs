//! What observers are told of impulses.

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
        let joints = &self.joints;
        let number = |slot: u32| self.particles.number[slot as usize] as usize;
        let mut given = joints.given.iter();
        for (joint, given) in joints.pairs.joints.iter().zip(&mut given) {
            if *given == ContactForce::default() {
                continue;
            }
            let [before, after] = [&joints.starts, &joints.movers]
                .map(|movers| joint.between::<false>(movers, &joints.containers));
            observer.contact(&ContactEvent {
                particle: number(joint.bodies[0]),
                partner: Partner::Particle(number(joint.bodies[1])),
                cavity: joint.cavity as usize,
                ..impulse(before, *given, &after)
            });
        }
        for (joint, given) in joints.walls.joints.iter().zip(&mut given) {
            if *given == ContactForce::default() {
                continue;
            }
            let [slot, wall] = joint.bodies;
            let cavity = joint.cavity as usize;
            let room = &self.world.rooms[cavity];
            let yielded = joints.containers[cavity].velocity - room.motion.velocity;
            let mut before = joint.at_wall::<false>(&joints.starts, &joints.containers);
            before.velocity += yielded;
            before.velocity_ahead += yielded;
            let after = joint.at_wall::<false>(&joints.movers, &joints.containers);
            observer.contact(&ContactEvent {
                particle: number(slot),
                partner: Partner::Wall(wall - room.first_wall),
                cavity,
                ..impulse(before, *given, &after)
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
