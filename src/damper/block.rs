//! Blocks: runs of slots whose contacts are found and evaluated together.
//!
//! Blocks depend on the bed alone, never on how many threads there are, and so does the order in
//! which forces are summed: the contacts within a block, those of its particles with later blocks,
//! its walls, and at last what earlier blocks send over.

use std::ops::Range;

use glam::DVec3;

use super::Partner;
use super::candidates::{Candidates, Remembered, Touch};
use super::scene::{PairContact, Scene, WallLoad};
use crate::cavity::Cavity;
use crate::contact::{Contact, ContactForce};
use crate::law::{ContactLaw, LawError};
use crate::observer::{ContactEvent, Observer};

/// How many slots make a block: its columns fit into a second-level cache.
pub(crate) const BLOCK: usize = 4096;

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
    touching: Vec<Touch>,
    /// Ends of the runs of touching pairs, pairs across the border, and walls.
    touching_pairs: usize,
    touching_border: usize,
    touching_walls: usize,
    pub(crate) parcels: Vec<Parcel>,
    pub(crate) loads: Vec<WallLoad>,
    pub(crate) contacts: usize,
    pub(crate) largest_overlap: f64,
    pub(crate) escaped: Option<Place>,
}

impl<L: ContactLaw> Block<L> {
    pub(crate) fn new(slots: Range<usize>, walls: usize) -> Self {
        let first = slots.start as u32;
        Self {
            slots,
            pairs: Candidates::new(first),
            border: Candidates::new(first),
            walls: Candidates::new(first),
            touching: Vec::new(),
            touching_pairs: 0,
            touching_border: 0,
            touching_walls: 0,
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

    /// Makes finished lists ready for use.
    pub(crate) fn finish<C: Cavity>(
        &mut self,
        scene: &Scene<'_, C, L>,
        memory: &[Vec<Remembered<L::Memory>>; 2],
    ) -> Result<(), LawError> {
        let [pairs, walls] = memory;
        self.pairs.recall(scene.stamp, pairs);
        self.border.recall(scene.stamp, pairs);
        self.walls.recall(scene.stamp, walls);
        for list in [&mut self.pairs, &mut self.border] {
            list.prepare(scene.law, scene.coefficients, scene.species)?;
        }
        let candidates = self.pairs.len() + self.border.len() + self.walls.len();
        self.touching.resize(candidates + 1, Touch::default());
        self.parcels.reserve(self.border.len());
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
            let from = room.slots.start.max(self.slots.start);
            let to = room.slots.end.min(self.slots.end);
            if from >= to {
                continue;
            }
            let limit = 0.25 * room.margin * room.margin;
            let origin = room.motion.position;
            for (position, reference) in scene.position[from..to].iter().zip(&reference[from..to]) {
                trusted &= (*position - origin - *reference).length_squared() <= limit;
            }
        }
        let touching = &mut self.touching;
        let pair = |first, second| scene.is_reached(first, second as usize);
        self.touching_pairs = list_touching(&self.pairs, touching, 0, pair);
        self.touching_border = list_touching(&self.border, touching, self.touching_pairs, pair);
        let wall = |slot, wall| scene.wall(slot, wall).1.overlap > -scene.reach;
        self.touching_walls = list_touching(&self.walls, touching, self.touching_border, wall);
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
        self.contacts = self.touching_walls;
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
        for touch in &self.touching[..self.touching_pairs] {
            let (pair, answer) = answer_pair::<C, L, END>(scene, &mut self.pairs, *touch);
            self.largest_overlap = self.largest_overlap.max(pair.contact.overlap);
            let (push, first, second) = pair.resolve(&answer);
            let (i, j) = (touch.first as usize - base, touch.second as usize - base);
            force[i] += push;
            torque[i] += first;
            force[j] -= push;
            torque[j] += second;
            if END && observer.wants_contacts() {
                report_pair(scene, &self.pairs, *touch, &pair.contact, &answer, observer);
            }
        }
    }

    fn evaluate_border<C: Cavity, O: Observer, const END: bool>(
        &mut self,
        scene: &Scene<'_, C, L>,
        force: &mut [DVec3],
        torque: &mut [DVec3],
        observer: &mut O,
    ) {
        let base = self.slots.start;
        for touch in &self.touching[self.touching_pairs..self.touching_border] {
            let (pair, answer) = answer_pair::<C, L, END>(scene, &mut self.border, *touch);
            self.largest_overlap = self.largest_overlap.max(pair.contact.overlap);
            let (push, first, second) = pair.resolve(&answer);
            let i = touch.first as usize - base;
            force[i] += push;
            torque[i] += first;
            self.parcels.push(Parcel {
                slot: touch.second,
                force: -push,
                torque: second,
            });
            if END && observer.wants_contacts() {
                report_pair(
                    scene,
                    &self.border,
                    *touch,
                    &pair.contact,
                    &answer,
                    observer,
                );
            }
        }
    }

    fn evaluate_walls<C: Cavity, O: Observer, const END: bool>(
        &mut self,
        scene: &Scene<'_, C, L>,
        force: &mut [DVec3],
        torque: &mut [DVec3],
        observer: &mut O,
    ) {
        let base = self.slots.start;
        for touch in &self.touching[self.touching_border..self.touching_walls] {
            let (slot, wall) = (touch.first as usize, touch.second);
            let (distance, contact) = scene.wall(slot, wall);
            let kind = scene.coefficients.wall(scene.species[slot]);
            let answer = answer::<L, END>(
                scene.stamp,
                scene.law,
                &mut self.walls,
                touch.place,
                kind,
                &contact,
            );
            self.largest_overlap = self.largest_overlap.max(contact.overlap);
            let push = contact.normal * answer.normal + answer.tangential;
            let arm = contact.normal * -scene.radius[slot];
            force[slot - base] += push;
            torque[slot - base] += arm.cross(answer.tangential) + answer.couple;
            let room = scene.room_of_wall(wall);
            let place = scene.position[slot] - room.motion.position + arm;
            self.loads[wall as usize].react(push, answer.couple, place);
            if distance < 0.0 {
                self.escaped = Some(Place {
                    slot,
                    partner: Partner::Wall(wall - room.first_wall),
                });
            }
            if END && observer.wants_contacts() {
                report_wall(scene, &self.walls, *touch, &contact, &answer, observer);
            }
        }
    }

    /// The deepest contact of the block.
    pub(crate) fn deepest<C: Cavity>(&self, scene: &Scene<'_, C, L>) -> Option<Place> {
        let (pairs, walls) = self.touching();
        let pairs = pairs.iter().map(|touch| {
            let (slot, other) = (touch.first as usize, touch.second as usize);
            let partner = Partner::Particle(scene.number[other] as usize);
            let overlap = scene.pair(slot, other).contact.overlap;
            (overlap, Place { slot, partner })
        });
        let walls = walls.iter().map(|touch| {
            let (slot, wall) = (touch.first as usize, touch.second);
            let partner = Partner::Wall(wall - scene.room_of_wall(wall).first_wall);
            let overlap = scene.wall(slot, wall).1.overlap;
            (overlap, Place { slot, partner })
        });
        let deepest = pairs.chain(walls).max_by(|a, b| a.0.total_cmp(&b.0));
        deepest.map(|(_, place)| place)
    }

    /// The touching pairs, first those within the block and then those across its border, and the
    /// touching walls.
    pub(crate) fn touching(&self) -> (&[Touch], &[Touch]) {
        self.touching[..self.touching_walls].split_at(self.touching_border)
    }

    /// The list that a touching pair stands in.
    pub(crate) const fn list_of_pair(&mut self, index: usize) -> &mut Candidates<L> {
        if index < self.touching_pairs {
            &mut self.pairs
        } else {
            &mut self.border
        }
    }

    /// Memory in bytes that the block has reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        let lists = [&self.pairs, &self.border, &self.walls];
        lists.map(Candidates::reserved_bytes).iter().sum::<usize>()
            + size_of::<Touch>() * self.touching.capacity()
            + size_of::<Parcel>() * self.parcels.capacity()
    }
}

/// Lists the candidates that touch, from place `found` on; returns where the list ends.
#[inline]
fn list_touching<L: ContactLaw>(
    candidates: &Candidates<L>,
    touching: &mut [Touch],
    mut found: usize,
    touches: impl Fn(usize, u32) -> bool,
) -> usize {
    for (first, place, partners) in candidates.rows() {
        for (place, second) in (place..).zip(partners) {
            let second = *second;
            // Written before it is known whether it counts: no branch to mispredict.
            touching[found] = Touch {
                first,
                second,
                place,
            };
            found += usize::from(touches(first as usize, second));
        }
    }
    found
}

/// The law's answer to a contact; at the end of a step the contact's memory advances.
#[inline]
fn answer<L: ContactLaw, const END: bool>(
    stamp: u32,
    law: &L,
    list: &mut Candidates<L>,
    place: u32,
    kind: &L::Coefficients,
    contact: &Contact,
) -> ContactForce {
    let memory = list.memory(place, stamp);
    let answer = law.force(kind, contact, &memory);
    if END {
        let memory = law.advance(kind, contact, &memory);
        list.keep(place, stamp.wrapping_add(1), memory);
    }
    answer
}

/// The contact of a touching pair, and the law's answer.
#[inline]
fn answer_pair<C: Cavity, L: ContactLaw, const END: bool>(
    scene: &Scene<'_, C, L>,
    list: &mut Candidates<L>,
    touch: Touch,
) -> (PairContact, ContactForce) {
    let (i, j) = (touch.first as usize, touch.second as usize);
    let pair = scene.pair(i, j);
    let kinds = (scene.species[i], scene.species[j]);
    let kind = scene
        .coefficients
        .pair(kinds.0, kinds.1, list.prepared(touch.place));
    let (stamp, law) = (scene.stamp, scene.law);
    let answer = answer::<L, END>(stamp, law, list, touch.place, &kind, &pair.contact);
    (pair, answer)
}

/// Tells `observer` of a pair in `list`.
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
