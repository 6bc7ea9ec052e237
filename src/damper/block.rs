//! Blocks: runs of slots whose contacts are found and evaluated together.
//!
//! Blocks depend on the bed alone, never on how many threads there are, and so does the order in
//! which forces are summed: the contacts within a block, those of its particles with later blocks,
//! its walls, and at last what earlier blocks send over.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::ops::Range;

use glam::DVec3;

use super::Partner;
use super::candidates::{Candidates, Remembered, Touch};
use super::scene::{PairContact, Scene, WallLoad, wall_contact};
use crate::cavity::Cavity;
use crate::contact::{Contact, ContactForce, Edge};
use crate::law::{ContactLaw, LawError};
use crate::observer::{ContactEvent, Observer};

/// How many slots make a block: its columns fit into a second-level cache.
pub(crate) const BLOCK: usize = 4096;

/// How many candidates there is room for from the start. The count of a small bed fluctuates: room for
/// as many as it has when it is dense spares it the allocations that would follow.
pub(crate) const fn room_for(particles: usize) -> usize {
    if particles < BLOCK { 4 * particles } else { 0 }
}

/// What a block sends to a particle of a later one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Parcel {
    pub(crate) slot: u32,
    pub(crate) force: DVec3,
    pub(crate) torque: DVec3,
}

/// The particle and the partner of the deepest contact, or of a contact that must not be.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    pub(crate) slot: usize,
    pub(crate) partner: Partner,
}

/// A run of slots with its candidates, its scratch, and what its last evaluation found.
#[derive(Debug, Clone)]
pub(crate) struct Block<L: ContactLaw> {
    pub(crate) slots: Range<usize>,
    pub(crate) pairs: Candidates<L>,
    pub(crate) border: Candidates<L>,
    pub(crate) walls: Candidates<L>,
    pub(crate) parcels: Vec<Parcel>,
    pub(crate) loads: Vec<WallLoad>,
    pub(crate) contacts: usize,
    pub(crate) largest_overlap: f64,
    pub(crate) escaped: Option<Place>,
}

impl<L: ContactLaw> Block<L> {
    pub(crate) fn new(slots: Range<usize>, walls: usize) -> Self {
        let (mut pairs, mut near) = (Candidates::default(), Candidates::default());
        pairs.reserve(room_for(slots.len()));
        near.reserve(room_for(slots.len()));
        Self {
            slots,
            pairs,
            border: Candidates::default(),
            walls: near,
            parcels: Vec::new(),
            loads: vec![WallLoad::default(); walls],
            contacts: 0,
            largest_overlap: 0.0,
            escaped: None,
        }
    }

    /// Empties the lists; what their contacts remember is added to `pairs` and to `walls`.
    pub(crate) fn clear(&mut self, stamp: u32, memory: &mut [Vec<Remembered<L::Memory>>; 2]) {
        let [pairs, walls] = memory;
        self.pairs.clear(stamp, pairs);
        self.border.clear(stamp, pairs);
        self.walls.clear(stamp, walls);
    }

    /// Adds what the contacts of step `stamp` remember to `memory`, of pairs and of walls.
    pub(crate) fn remember(&self, stamp: u32, memory: &mut [Vec<Remembered<L::Memory>>; 2]) {
        let [pairs, walls] = memory;
        self.pairs.remember(stamp, pairs);
        self.border.remember(stamp, pairs);
        self.walls.remember(stamp, walls);
    }

    /// Makes finished lists ready for use, but for what the law has to [`prepare`](Self::prepare).
    pub(crate) fn finish<C: Cavity>(
        &mut self,
        scene: &Scene<'_, C, L>,
        memory: &[Vec<Remembered<L::Memory>>; 2],
    ) {
        let [pairs, walls] = memory;
        self.pairs.finish(scene.stamp, pairs);
        self.border.finish(scene.stamp, pairs);
        self.walls.finish(scene.stamp, walls);
        self.parcels.reserve(self.border.candidates());
    }

    /// Asks the law for the pairs of finished lists.
    pub(crate) fn prepare<C: Cavity>(&mut self, scene: &Scene<'_, C, L>) -> Result<(), LawError> {
        for list in [&mut self.pairs, &mut self.border] {
            list.prepare(scene.law, scene.coefficients, scene.species)?;
        }
        Ok(())
    }

    /// Narrow phase: lists the pairs that touch. Returns whether the candidates can be trusted, which
    /// they can while no particle has moved by half the margin from its `reference`.
    pub(crate) fn narrow<C: Cavity>(
        &mut self,
        scene: &Scene<'_, C, L>,
        reference: &[DVec3],
    ) -> bool {
        let mut trusted = true;
        for room in scene.rooms {
            let own = room.slots_in(&self.slots);
            let limit = 0.25 * room.margin * room.margin;
            let origin = room.motion.position;
            let moved = scene.position[own.clone()].iter().zip(&reference[own]);
            for (position, reference) in moved {
                trusted &= (*position - origin - *reference).length_squared() <= limit;
            }
        }
        let position = scene.position;
        for list in [&mut self.pairs, &mut self.border] {
            list.find(|i, j| position[i].distance_squared(position[j as usize]));
            list.take_roots();
        }
        self.walls
            .find(|i, wall| scene.wall_point(wall, position[i]).distance);
        trusted
    }

    /// Forgets what the last evaluation found.
    pub(crate) const fn forget(&mut self) {
        self.contacts = 0;
        self.largest_overlap = 0.0;
        self.escaped = None;
    }

    /// Evaluates all contacts of the block. `force` and `torque` are those of its own slots.
    /// With `END`, contacts advance their memory to step `scene.stamp + 1`.
    pub(crate) fn evaluate<C: Cavity, O: Observer, const END: bool>(
        &mut self,
        scene: &Scene<'_, C, L>,
        force: &mut [DVec3],
        torque: &mut [DVec3],
        observer: &mut O,
    ) {
        force.fill(DVec3::ZERO);
        torque.fill(DVec3::ZERO);
        self.loads.fill(WallLoad::default());
        self.parcels.clear();
        self.forget();
        self.contacts = self.contacts_in_reach();
        self.evaluate_pairs::<C, O, END>(scene, force, torque, observer);
        self.evaluate_border::<C, O, END>(scene, force, torque, observer);
        self.evaluate_walls::<C, O, END>(scene, force, torque, observer);
    }

    fn evaluate_pairs<C: Cavity, O: Observer, const END: bool>(
        &mut self,
        scene: &Scene<'_, C, L>,
        force: &mut [DVec3],
        torque: &mut [DVec3],
        observer: &mut O,
    ) {
        let base = self.slots.start;
        let torque = &mut torque[..force.len()];
        let deliver = |touch: &Touch, push: DVec3, turns: [DVec3; 2]| {
            let (i, j) = (touch.first as usize - base, touch.second as usize - base);
            if i < force.len() && j < force.len() {
                force[i] += push;
                torque[i] += turns[0];
                force[j] -= push;
                torque[j] += turns[1];
            }
        };
        let pairs = &mut self.pairs;
        let deepest = answer_pairs::<C, L, O, END>(scene, pairs, observer, deliver);
        self.largest_overlap = self.largest_overlap.max(deepest);
    }

    fn evaluate_border<C: Cavity, O: Observer, const END: bool>(
        &mut self,
        scene: &Scene<'_, C, L>,
        force: &mut [DVec3],
        torque: &mut [DVec3],
        observer: &mut O,
    ) {
        let base = self.slots.start;
        let parcels = &mut self.parcels;
        let deliver = |touch: &Touch, push: DVec3, turns: [DVec3; 2]| {
            let i = touch.first as usize - base;
            force[i] += push;
            torque[i] += turns[0];
            parcels.push(Parcel {
                slot: touch.second,
                force: -push,
                torque: turns[1],
            });
        };
        let border = &mut self.border;
        let deepest = answer_pairs::<C, L, O, END>(scene, border, observer, deliver);
        self.largest_overlap = self.largest_overlap.max(deepest);
    }

    fn evaluate_walls<C: Cavity, O: Observer, const END: bool>(
        &mut self,
        scene: &Scene<'_, C, L>,
        force: &mut [DVec3],
        torque: &mut [DVec3],
        observer: &mut O,
    ) {
        let base = self.slots.start;
        for number in 0..self.walls.contacts.len() {
            let touch = self.walls.touch(number);
            let (slot, wall) = (touch.first as usize, touch.second);
            let grain = scene.grain(slot);
            let point = scene.wall_point(wall, grain.position);
            let container = scene.room_of_wall(wall).moving(scene.elapsed);
            let contact = wall_contact(&grain, &point, container, scene.elapsed);
            let kind = scene.coefficients.wall(scene.species[slot]);
            let answer = answer::<L, END>(
                [scene.stamp, touch.place],
                scene.law,
                &mut self.walls,
                kind,
                &contact,
                scene.time_step,
            );
            self.largest_overlap = self.largest_overlap.max(contact.overlap);
            let push = contact.normal * answer.normal + answer.tangential;
            let arm = contact.normal * -scene.radius[slot];
            force[slot - base] += push;
            torque[slot - base] += arm.cross(answer.tangential) + answer.couple;
            let room = scene.room_of_wall(wall);
            let place = scene.position[slot] - room.motion.position + arm;
            self.loads[wall as usize].react(push, answer.couple, place);
            if point.distance < 0.0 {
                self.escaped = Some(Place {
                    slot,
                    partner: Partner::Wall(wall - room.first_wall),
                });
            }
            if END && observer.wants_contacts() {
                report_wall(scene, &self.walls, touch, &contact, &answer, observer);
            }
        }
    }

    /// How many contacts are within the law's reach.
    pub(crate) const fn contacts_in_reach(&self) -> usize {
        self.pairs.contacts.len() + self.border.contacts.len() + self.walls.contacts.len()
    }

    /// The pairs in contact, with their overlaps.
    pub(crate) fn overlapping_pairs<C: Cavity>(
        &self,
        scene: &Scene<'_, C, L>,
    ) -> impl Iterator<Item = (f64, usize, usize)> {
        self.pairs
            .touching()
            .chain(self.border.touching())
            .map(|touch| {
                let (i, j) = (touch.first as usize, touch.second as usize);
                (scene.radius[i] + scene.radius[j] - touch.distance, i, j)
            })
    }

    /// The walls in contact, with their overlaps.
    pub(crate) fn overlapping_walls<C: Cavity>(
        &self,
        scene: &Scene<'_, C, L>,
    ) -> impl Iterator<Item = (f64, usize, u32)> {
        self.walls.touching().map(|touch| {
            let slot = touch.first as usize;
            (scene.radius[slot] - touch.distance, slot, touch.second)
        })
    }

    /// The deepest contact of the block.
    pub(crate) fn deepest<C: Cavity>(&self, scene: &Scene<'_, C, L>) -> Option<Place> {
        let pairs = self.overlapping_pairs(scene).map(|(overlap, slot, other)| {
            let partner = Partner::Particle(scene.number[other] as usize);
            (overlap, Place { slot, partner })
        });
        let walls = self.overlapping_walls(scene).map(|(overlap, slot, wall)| {
            let partner = Partner::Wall(wall - scene.room_of_wall(wall).first_wall);
            (overlap, Place { slot, partner })
        });
        let deepest = pairs.chain(walls).max_by(|a, b| a.0.total_cmp(&b.0));
        deepest.map(|(_, place)| place)
    }

    /// Memory in bytes that the block has reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        let lists = [&self.pairs, &self.border, &self.walls];
        lists.map(Candidates::reserved_bytes).iter().sum::<usize>()
            + size_of::<Parcel>() * self.parcels.capacity()
    }
}

/// The law's answer to a contact; at the end of a step the contact's memory advances.
#[inline(always)]
fn answer<L: ContactLaw, const END: bool>(
    [stamp, place]: [u32; 2],
    law: &L,
    list: &mut Candidates<L>,
    kind: &L::Coefficients,
    contact: &Contact,
    time_step: f64,
) -> ContactForce {
    let memory = list.memory(place, stamp);
    if law.has_edges() && Edge::is_near(contact.overlap, contact.approach_speed(), time_step) {
        let acceleration = contact.acceleration.dot(contact.normal);
        let edge = Edge::new(time_step, acceleration);
        let (answer, memory) = law.at_edge(kind, contact, &memory, &edge);
        if END {
            list.keep(place, stamp.wrapping_add(1), memory);
        }
        return answer;
    }
    let answer = law.force(kind, contact, &memory);
    if END {
        let memory = law.advance(kind, contact, &memory);
        list.keep(place, stamp.wrapping_add(1), memory);
    }
    answer
}

/// Has the law answer the contacts of touching pairs, and delivers force on the first body and torques
/// on both. Returns the largest overlap.
#[inline(always)]
fn answer_pairs<C: Cavity, L: ContactLaw, O: Observer, const END: bool>(
    scene: &Scene<'_, C, L>,
    list: &mut Candidates<L>,
    observer: &mut O,
    mut deliver: impl FnMut(&Touch, DVec3, [DVec3; 2]),
) -> f64 {
    // Columns of one length, so that one comparison stands for all their bounds.
    let count = scene.position.len();
    let even = Scene {
        velocity: &scene.velocity[..count],
        spin: &scene.spin[..count],
        acceleration: &scene.acceleration[..count],
        angular_acceleration: &scene.angular_acceleration[..count],
        radius: &scene.radius[..count],
        species: &scene.species[..count],
        ..*scene
    };
    let watched = END && observer.wants_contacts();
    let mut deepest = 0.0_f64;
    for number in 0..list.contacts.len() {
        let touch = list.touch(number);
        let (i, j) = (touch.first as usize, touch.second as usize);
        if i >= count || j >= count {
            continue;
        }
        let pair = PairContact::new(&even.grain(i), &even.grain(j), &touch, even.elapsed);
        let own = list.prepared(touch.place);
        let (first, second) = (even.species[i], even.species[j]);
        let kind = even.coefficients.pair(first, second, own);
        let (law, at) = (scene.law, [scene.stamp, touch.place]);
        let answer = answer::<L, END>(at, law, list, &kind, &pair.contact, scene.time_step);
        deepest = deepest.max(pair.contact.overlap);
        let (push, first, second) = pair.resolve(&answer);
        deliver(&touch, push, [first, second]);
        if watched {
            report_pair(scene, list, touch, &pair.contact, &answer, observer);
        }
    }
    deepest
}

/// Tells `observer` of a pair in `list`.
#[cold]
fn report_pair<C: Cavity, L: ContactLaw>(
    scene: &Scene<'_, C, L>,
    list: &Candidates<L>,
    touch: Touch,
    contact: &Contact,
    force: &ContactForce,
    observer: &mut impl Observer,
) {
    let (slot, other) = (touch.first as usize, touch.second as usize);
    let prepared = list.prepared(touch.place);
    let (first, second) = (scene.species[slot], scene.species[other]);
    let kind = scene.coefficients.pair(first, second, prepared);
    let memory = list.memory(touch.place, scene.stamp.wrapping_add(1));
    observer.contact(&ContactEvent {
        particle: scene.number[slot] as usize,
        partner: Partner::Particle(scene.number[other] as usize),
        cavity: scene.rooms.partition_point(|room| room.slots.end <= slot),
        contact: *contact,
        force: *force,
        stored: scene.law.stored(&kind, contact, &memory),
        working_velocity: contact.velocity,
        working_spin: contact.spins[0] - contact.spins[1],
    });
}

/// Tells `observer` of a contact with a wall in `list`.
#[cold]
fn report_wall<C: Cavity, L: ContactLaw>(
    scene: &Scene<'_, C, L>,
    list: &Candidates<L>,
    touch: Touch,
    contact: &Contact,
    force: &ContactForce,
    observer: &mut impl Observer,
) {
    let (slot, wall) = (touch.first as usize, touch.second);
    let kind = scene.coefficients.wall(scene.species[slot]);
    let memory = list.memory(touch.place, scene.stamp.wrapping_add(1));
    observer.contact(&ContactEvent {
        particle: scene.number[slot] as usize,
        partner: Partner::Wall(wall - scene.room_of_wall(wall).first_wall),
        cavity: scene.cavity_of_wall(wall),
        contact: *contact,
        force: *force,
        stored: scene.law.stored(kind, contact, &memory),
        working_velocity: contact.velocity,
        working_spin: contact.spins[0],
    });
}
