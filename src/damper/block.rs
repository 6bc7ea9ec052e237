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
use super::candidates::{Candidates, Remembered, make_room, pair};
use super::chunk::{CHUNK, Chunk};
use super::scene::{Scene, WallLoad};
use super::vectors::{Components, part, vector};
use crate::cavity::Cavity;
use crate::law::{ContactLaw, LawError};
use crate::observer::Observer;

mod report;

use report::{report_pairs, report_walls};

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

/// What candidates are listed from.
pub(crate) struct Listing<'a, C, L: ContactLaw> {
    pub(crate) scene: &'a Scene<'a, C, L>,
    /// Gap in m up to which contacts are evaluated.
    pub(crate) reach: f64,
    /// Starts of the rows of partners, by lower slot, and the end of the last.
    pub(crate) rows: &'a [u32],
    /// Where each particle is in its container's frame.
    pub(crate) local: &'a [DVec3],
}

/// What contacts remember: of pairs, and of walls.
pub(crate) type Memories<L> = [Vec<Remembered<<L as ContactLaw>::Memory>>; 2];

/// Room for what contacts of a block remember in a bed of `particles`.
pub(crate) fn memories<M>(particles: usize) -> [Vec<Remembered<M>>; 2] {
    [(); 2].map(|()| Vec::with_capacity(room_for(particles)))
}

/// Memory in bytes that `memories` have reserved.
pub(crate) fn reserved_by<M>(memories: &[Vec<Remembered<M>>; 2]) -> usize {
    size_of::<Remembered<M>>() * memories.iter().map(Vec::capacity).sum::<usize>()
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
    chunk: Box<Chunk<L>>,
}

impl<L: ContactLaw> Block<L> {
    pub(crate) fn new(slots: Range<usize>, walls: usize) -> Self {
        let (mut pairs, mut near) = (Candidates::default(), Candidates::default());
        pairs.reserve_all(room_for(slots.len()));
        near.reserve_all(room_for(slots.len()));
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
            chunk: Box::default(),
        }
    }

    /// Lists candidates anew, and hands over what contacts remember: what the block's own do, which goes
    /// by way of `buffer`, unless it is `saved`, in ascending order. `partners` are those in the rows of
    /// the block's slots.
    pub(crate) fn relist<C: Cavity>(
        &mut self,
        listing: &Listing<'_, C, L>,
        partners: &mut [u32],
        saved: Option<&Memories<L>>,
        buffer: &mut Memories<L>,
    ) {
        let memory = if let Some(all) = saved {
            self.own(all)
        } else {
            buffer.iter_mut().for_each(Vec::clear);
            make_room(&mut buffer[0], self.pairs.entries() + self.border.entries());
            make_room(&mut buffer[1], self.walls.entries());
            self.remember(listing.scene.stamp, buffer);
            buffer[0].sort_unstable_by_key(Remembered::pair);
            buffer.each_ref().map(Vec::as_slice)
        };
        self.pairs.clear();
        self.border.clear();
        self.walls.clear();
        self.list(listing, partners);
        self.finish(listing.scene.stamp, memory);
    }

    /// Adds what the contacts of step `stamp` remember to `memory`.
    pub(crate) fn remember(&self, stamp: u32, memory: &mut Memories<L>) {
        let [pairs, walls] = memory;
        self.pairs.remember(stamp, pairs);
        self.border.remember(stamp, pairs);
        self.walls.remember(stamp, walls);
    }

    /// What `memory`, in ascending order, holds of the block's contacts.
    fn own<'a>(&self, memory: &'a Memories<L>) -> [&'a [Remembered<L::Memory>]; 2] {
        let slots = [self.slots.start as u32, self.slots.end as u32];
        let own = |all: &'a [Remembered<L::Memory>], slot: fn(&Remembered<L::Memory>) -> u32| {
            let [start, end] = slots.map(|end| all.partition_point(|own| slot(own) < end));
            &all[start..end]
        };
        [
            own(&memory[0], |contact| contact.pair().0),
            own(&memory[1], |contact| contact.wall().0),
        ]
    }

    /// Fills the empty lists.
    fn list<C: Cavity>(&mut self, listing: &Listing<'_, C, L>, partners: &mut [u32]) {
        let Listing {
            scene,
            reach,
            rows,
            local,
        } = *listing;
        let begin = rows[self.slots.start];
        let beyond = |partner: &&u32| **partner as usize >= self.slots.end;
        let border = partners.iter().filter(beyond).count();
        self.border.reserve(border);
        self.pairs.reserve(partners.len() - border);
        for slot in self.slots.clone() {
            let row = (rows[slot] - begin) as usize..(rows[slot + 1] - begin) as usize;
            let partners = &mut partners[row];
            partners.sort_unstable();
            let mut last = None;
            let each_once = |partner: &u32| last.replace(*partner) != Some(*partner);
            for partner in partners.iter().copied().filter(each_once) {
                let other = partner as usize;
                let reach = scene.radius[slot] + scene.radius[other] + reach;
                let list = if other < self.slots.end {
                    &mut self.pairs
                } else {
                    &mut self.border
                };
                // The one with the lower number comes first, wherever it stands.
                if scene.number[slot] < scene.number[other] {
                    list.push(slot as u32, partner, reach * reach);
                } else {
                    list.push(partner, slot as u32, reach * reach);
                }
            }
        }
        for room in scene.rooms {
            for slot in room.slots_in(&self.slots) {
                let reach = scene.radius[slot] + reach;
                for wall in 0..room.cavity.walls() {
                    let point = room.cavity.wall(wall, local[slot]);
                    if point.distance < reach + room.margin {
                        self.walls.push(slot as u32, room.first_wall + wall, reach);
                    }
                }
            }
        }
    }

    /// Makes filled lists ready for use, but for what the law has to [`prepare`](Self::prepare).
    fn finish(&mut self, stamp: u32, [pairs, walls]: [&[Remembered<L::Memory>]; 2]) {
        self.pairs.finish(stamp, pairs, pair);
        self.border.finish(stamp, pairs, pair);
        self.walls.finish(stamp, walls, |slot, wall| (slot, wall));
        make_room(&mut self.parcels, self.border.candidates());
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
        reference: &Components<'_>,
    ) -> bool {
        let mut trusted = true;
        for room in scene.rooms {
            let own = room.slots_in(&self.slots);
            let (now, then) = (part(&scene.position, own.clone()), part(reference, own));
            let limit = 0.25 * room.margin * room.margin;
            trusted &= within(now, then, room.motion.position, limit);
        }
        let [x, y, z] = scene.position;
        let y = &y[..x.len()];
        for list in [&mut self.pairs, &mut self.border] {
            let square = |i: usize, j: usize| {
                let (x, y) = (x[i] - x[j], y[i] - y[j]);
                x * x + y * y
            };
            if scene.planar {
                list.find(|i, j| square(i, j as usize));
            } else {
                let z = &z[..x.len()];
                list.find(|i, j| {
                    let z = z[i] - z[j as usize];
                    square(i, j as usize) + z * z
                });
            }
        }
        self.walls.find(|i, wall| {
            let position = vector(&scene.position, i);
            scene.wall_point(wall, position).distance
        });
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
        mut force: [&mut [f64]; 3],
        mut torque: [&mut [f64]; 3],
        observer: &mut O,
    ) {
        for component in &mut force {
            component.fill(0.0);
        }
        for component in &mut torque {
            component.fill(0.0);
        }
        self.loads.fill(WallLoad::default());
        self.parcels.clear();
        self.forget();
        self.contacts = self.contacts_in_reach();
        if scene.planar {
            let sums = Sums::<true>::new(force, torque);
            self.evaluate_lists::<C, O, END, true>(scene, sums, observer);
        } else {
            let sums = Sums::<false>::new(force, torque);
            self.evaluate_lists::<C, O, END, false>(scene, sums, observer);
        }
    }

    fn evaluate_lists<C: Cavity, O: Observer, const END: bool, const PLANAR: bool>(
        &mut self,
        scene: &Scene<'_, C, L>,
        mut sums: Sums<'_, PLANAR>,
        observer: &mut O,
    ) {
        let base = self.slots.start;
        let chunk = &mut *self.chunk;
        let mut deepest = 0.0_f64;
        let list = &mut self.pairs;
        for run in runs(list.contacts.len()) {
            answer_pairs::<C, L, END, PLANAR>(scene, list, chunk, run.clone());
            deepest = deepest.max(chunk.largest_overlap());
            let bodies = &list.contacts.bodies()[run.clone()];
            for (n, [i, j]) in bodies.iter().take(CHUNK).enumerate() {
                let (i, j) = (*i as usize - base, *j as usize - base);
                let (push, [first, second]) = (chunk.push(n), chunk.torques(n));
                sums.add(i, push, first);
                sums.add(j, -push, second);
            }
            if END && observer.wants_contacts() {
                report_pairs(scene, list, chunk, run, observer);
            }
        }
        let list = &mut self.border;
        for run in runs(list.contacts.len()) {
            answer_pairs::<C, L, END, PLANAR>(scene, list, chunk, run.clone());
            deepest = deepest.max(chunk.largest_overlap());
            for (n, [i, j]) in list.contacts.bodies()[run.clone()].iter().enumerate() {
                let (push, [first, second]) = (chunk.push(n), chunk.torques(n));
                let both = [(*i, push, first), (*j, -push, second)];
                for (slot, force, torque) in both {
                    if self.slots.contains(&(slot as usize)) {
                        sums.add(slot as usize - base, force, torque);
                    } else {
                        self.parcels.push(Parcel {
                            slot,
                            force,
                            torque,
                        });
                    }
                }
            }
            if END && observer.wants_contacts() {
                report_pairs(scene, list, chunk, run, observer);
            }
        }
        let list = &mut self.walls;
        for run in runs(list.contacts.len()) {
            answer_walls::<C, L, END, PLANAR>(scene, list, chunk, run.clone());
            deepest = deepest.max(chunk.largest_overlap());
            for (n, [slot, wall]) in list.contacts.bodies()[run.clone()].iter().enumerate() {
                let (push, [turn, _]) = (chunk.push(n), chunk.torques(n));
                let slot = *slot as usize;
                sums.add(slot - base, push, turn);
                let room = scene.room_of_wall(*wall);
                let place = vector(&scene.position, slot) - room.motion.position;
                self.loads[*wall as usize].react(push, turn, place);
                if chunk.overlap(n) > scene.radius[slot] {
                    let partner = Partner::Wall(wall - room.first_wall);
                    self.escaped = Some(Place { slot, partner });
                }
            }
            if END && observer.wants_contacts() {
                report_walls(scene, list, chunk, run, observer);
            }
        }
        self.largest_overlap = deepest;
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
        let lists = [&self.pairs, &self.border];
        let bodies = lists.into_iter().flat_map(|list| list.contacts.bodies());
        bodies.map(|[i, j]| {
            let (i, j) = (*i as usize, *j as usize);
            let distance = vector(&scene.position, i).distance(vector(&scene.position, j));
            (scene.radius[i] + scene.radius[j] - distance, i, j)
        })
    }

    /// The walls in contact, with their overlaps.
    pub(crate) fn overlapping_walls<C: Cavity>(
        &self,
        scene: &Scene<'_, C, L>,
    ) -> impl Iterator<Item = (f64, usize, u32)> {
        self.walls.contacts.bodies().iter().map(|[slot, wall]| {
            let slot = *slot as usize;
            let distance = scene
                .wall_point(*wall, vector(&scene.position, slot))
                .distance;
            (scene.radius[slot] - distance, slot, *wall)
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

/// Where the forces and torques on the particles of a block are summed up. With `PLANAR` forces have
/// no z, and torques nothing else.
struct Sums<'a, const PLANAR: bool> {
    force: [&'a mut [f64]; 3],
    torque: [&'a mut [f64]; 3],
}

impl<'a, const PLANAR: bool> Sums<'a, PLANAR> {
    fn new(force: [&'a mut [f64]; 3], torque: [&'a mut [f64]; 3]) -> Self {
        // Columns of one length, so that one comparison stands for all their bounds.
        let count = force[0].len();
        let even = |column: &'a mut [f64], used: bool| &mut column[..if used { count } else { 0 }];
        let [x, y, z] = force;
        let force = [even(x, true), even(y, true), even(z, !PLANAR)];
        let [x, y, z] = torque;
        let torque = [even(x, !PLANAR), even(y, !PLANAR), even(z, true)];
        Self { force, torque }
    }

    #[inline(always)]
    fn add(&mut self, n: usize, force: DVec3, torque: DVec3) {
        self.force[0][n] += force.x;
        self.force[1][n] += force.y;
        self.torque[2][n] += torque.z;
        if !PLANAR {
            self.force[2][n] += force.z;
            self.torque[0][n] += torque.x;
            self.torque[1][n] += torque.y;
        }
    }
}

/// Whether all points `now` are nearer to those `then`, seen from `origin`, than the root of `limit`.
fn within(now: Components<'_>, then: Components<'_>, origin: DVec3, limit: f64) -> bool {
    let [x, y, z] = now;
    let count = x.len();
    let moved = |n: usize, now: &[f64], then: &[f64], origin: f64| {
        let moved = now[n] - origin - then[n];
        moved * moved
    };
    let (y, then_x, then_y) = (&y[..count], &then[0][..count], &then[1][..count]);
    let mut within = true;
    if z.is_empty() {
        for n in 0..count {
            let square = moved(n, x, then_x, origin.x) + moved(n, y, then_y, origin.y);
            within &= square <= limit;
        }
    } else {
        let (z, then_z) = (&z[..count], &then[2][..count]);
        for n in 0..count {
            let square = moved(n, x, then_x, origin.x) + moved(n, y, then_y, origin.y);
            within &= square + moved(n, z, then_z, origin.z) <= limit;
        }
    }
    within
}

/// Runs of at most [`CHUNK`] contacts, one after the other.
fn runs(contacts: usize) -> impl Iterator<Item = Range<usize>> {
    let starts = (0..contacts).step_by(CHUNK);
    starts.map(move |start| start..contacts.min(start + CHUNK))
}

/// Has the law answer a run of touching pairs.
#[inline(always)]
fn answer_pairs<C: Cavity, L: ContactLaw, const END: bool, const PLANAR: bool>(
    scene: &Scene<'_, C, L>,
    list: &mut Candidates<L>,
    chunk: &mut Chunk<L>,
    run: Range<usize>,
) {
    let bodies = &list.contacts.bodies()[run.clone()];
    let places = &list.contacts.places()[run.clone()];
    chunk.gather_pairs::<C, PLANAR>(scene, bodies);
    list.recall(run.clone(), scene.stamp, chunk.memory_mut());
    let kinds = bodies.iter().zip(places).map(|([i, j], place)| {
        let first = scene.species[*i as usize];
        let second = scene.species[*j as usize];
        let own = list.prepared(*place);
        scene.coefficients.pair(first, second, own)
    });
    let only = scene.coefficients.only_pair();
    chunk.answer::<true, END, PLANAR>(scene.law, only, kinds, scene.elapsed);
    if scene.law.has_edges() {
        let acceleration = |n: usize| acceleration_of_pair(scene, bodies[n]);
        chunk.mend_edges::<true, END>(scene.law, only, scene.moment(), acceleration);
    }
    if END {
        list.keep_run(run, scene.stamp.wrapping_add(1), chunk.advanced());
    }
}

/// Has the law answer a run of touching walls.
#[inline(always)]
fn answer_walls<C: Cavity, L: ContactLaw, const END: bool, const PLANAR: bool>(
    scene: &Scene<'_, C, L>,
    list: &mut Candidates<L>,
    chunk: &mut Chunk<L>,
    run: Range<usize>,
) {
    let bodies = &list.contacts.bodies()[run.clone()];
    chunk.gather_walls::<C>(scene, bodies);
    list.recall(run.clone(), scene.stamp, chunk.memory_mut());
    let kinds = bodies.iter().map(|[slot, _]| {
        let species = scene.species[*slot as usize];
        *scene.coefficients.wall(species)
    });
    let only = scene.coefficients.only_wall();
    chunk.answer::<false, END, PLANAR>(scene.law, only, kinds, scene.elapsed);
    if scene.law.has_edges() {
        let acceleration = |n: usize| vector(&scene.acceleration, bodies[n][0] as usize);
        chunk.mend_edges::<false, END>(scene.law, only, scene.moment(), acceleration);
    }
    if END {
        list.keep_run(run, scene.stamp.wrapping_add(1), chunk.advanced());
    }
}

/// How the centre of the first body was accelerated relative to that of the second when forces were
/// evaluated last, in m/s^2.
fn acceleration_of_pair<C: Cavity, L: ContactLaw>(
    scene: &Scene<'_, C, L>,
    bodies: [u32; 2],
) -> DVec3 {
    let [first, second] = bodies.map(|slot| vector(&scene.acceleration, slot as usize));
    first - second
}
