//! What observers are told of contacts that were evaluated.

use std::ops::Range;

use super::evaluate::acceleration_of_pair;
use crate::cavity::Cavity;
use crate::damper::Partner;
use crate::damper::candidates::Candidates;
use crate::damper::chunk::Chunk;
use crate::damper::scene::Scene;
use crate::law::ForceLaw;
use crate::observer::{ContactEvent, Observer};

/// Tells `observer` of the pairs in `chunk`, which are in `list`.
#[cold]
pub(super) fn report_pairs<C: Cavity, L: ForceLaw>(
    scene: &Scene<'_, C, L>,
    list: &Candidates<L>,
    chunk: &Chunk<L>,
    run: Range<usize>,
    observer: &mut impl Observer,
) {
    for (n, number) in run.enumerate() {
        let bodies = list.contacts.bodies()[number];
        let place = list.contacts.places()[number];
        let (slot, other) = (bodies[0] as usize, bodies[1] as usize);
        let prepared = list.prepared(place);
        let (first, second) = (scene.species[slot], scene.species[other]);
        let kind = scene.coefficients.pair(first, second, prepared);
        let acceleration = acceleration_of_pair(scene, bodies);
        let (contact, force, memory) =
            chunk.ask::<true>(scene.law, &kind, n, scene.moment, acceleration);
        observer.contact(&ContactEvent {
            particle: scene.number[slot] as usize,
            partner: Partner::Particle(scene.number[other] as usize),
            cavity: scene.rooms.partition_point(|room| room.slots.end <= slot),
            contact,
            force,
            stored: scene.law.stored(&kind, &contact, &memory),
            working_velocity: contact.velocity,
            working_spin: contact.spins[0] - contact.spins[1],
        });
    }
}

/// Tells `observer` of the contacts with walls in `chunk`.
#[cold]
pub(super) fn report_walls<C: Cavity, L: ForceLaw>(
    scene: &Scene<'_, C, L>,
    list: &Candidates<L>,
    chunk: &Chunk<L>,
    run: Range<usize>,
    observer: &mut impl Observer,
) {
    for (n, [slot, wall]) in list.contacts.bodies()[run].iter().enumerate() {
        let (slot, wall) = (*slot as usize, *wall);
        let kind = scene.coefficients.wall(scene.species[slot]);
        let acceleration = scene.acceleration.get(slot);
        let (contact, force, memory) =
            chunk.ask::<false>(scene.law, kind, n, scene.moment, acceleration);
        observer.contact(&ContactEvent {
            particle: scene.number[slot] as usize,
            partner: Partner::Wall(wall - scene.room_of_wall(wall).first_wall),
            cavity: scene.cavity_of_wall(wall),
            contact,
            force,
            stored: scene.law.stored(kind, &contact, &memory),
            working_velocity: contact.velocity,
            working_spin: contact.spins[0],
        });
    }
}
