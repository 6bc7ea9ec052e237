//! Blocks: runs of slots whose contacts are found and evaluated together.
//!
//! Blocks depend on the bed alone, never on how many threads there are, and so does the order in
//! which forces are summed: the contacts within a block, those of its particles with later blocks,
//! its walls, and at last what earlier blocks send over.

use std::ops::Range;

use glam::DVec3;

use super::Partner;
use super::candidates::{Candidates, Remembered};
use super::chunk::Chunk;
use super::scene::{Scene, WallLoad};
use super::vectors::Rows;
use crate::cavity::Cavity;
use crate::law::{ContactLaw, ContactMemory};

mod evaluate;
mod list;
mod report;

/// How many slots make a block at the least; a bed of no more is one block.
pub(crate) const BLOCK: usize = 4096;

/// How many make one at the most: columns of a larger one leave the nearer caches.
const LARGEST_BLOCK: usize = 16_384;

/// How many blocks there are before they grow beyond the least: work for as many threads.
const BLOCKS: usize = 16;

/// How many slots make a block in a bed of `particles`. The larger blocks are, the fewer contacts lie
/// across two of them.
pub(crate) fn block_size(particles: usize) -> usize {
    (particles / BLOCKS).clamp(BLOCK, LARGEST_BLOCK)
}

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
    /// Starts of the rows of partners, by lower slot, and the end of the last.
    pub(crate) rows: &'a [u32],
    /// Where each particle is in its container's frame.
    pub(crate) local: &'a [DVec3],
}

/// What contacts remember: of pairs, and of walls.
pub(crate) type Memories<L> = [Vec<Remembered<ContactMemory<L>>>; 2];

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

    /// Narrow phase: lists the pairs that touch. Returns whether the candidates can be trusted, which
    /// they can while no particle has moved by half the margin from its `reference`.
    pub(crate) fn narrow<C: Cavity>(
        &mut self,
        scene: &Scene<'_, C, L>,
        reference: Rows<'_>,
    ) -> bool {
        let mut trusted = true;
        for room in scene.rooms {
            let own = room.slots_in(&self.slots);
            let (now, then) = (scene.position.part(own.clone()), reference.part(own));
            let limit = 0.25 * room.margin * room.margin;
            let origin = room.motion.position;
            trusted &= if scene.planar {
                within::<true>(now, then, origin, limit)
            } else {
                within::<false>(now, then, origin, limit)
            };
        }
        for list in [&mut self.pairs, &mut self.border] {
            if scene.planar {
                find_pairs::<C, L, true>(scene, list);
            } else {
                find_pairs::<C, L, false>(scene, list);
            }
        }
        let reach = scene.reach;
        self.walls.find(|i, wall, touching| {
            let position = scene.position.get(i);
            scene.wall_point(wall, position).distance < touching + reach
        });
        trusted
    }

    /// Forgets what the last evaluation found.
    pub(crate) const fn forget(&mut self) {
        self.contacts = 0;
        self.largest_overlap = 0.0;
        self.escaped = None;
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
            let distance = scene.position.get(i).distance(scene.position.get(j));
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
            let distance = scene.wall_point(*wall, scene.position.get(slot)).distance;
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

/// Lists the pairs in contact.
#[inline(always)]
fn find_pairs<C, L: ContactLaw, const PLANAR: bool>(
    scene: &Scene<'_, C, L>,
    list: &mut Candidates<L>,
) {
    let position = scene.position.polar::<PLANAR>(scene.radius.len());
    let reach = scene.reach;
    list.find(|i, j, touching| {
        let limit = touching + reach;
        position.get(i).distance_squared(position.get(j as usize)) < limit * limit
    });
}

/// Whether all points `now` are nearer to those `then`, seen from `origin`, than the root of `limit`.
fn within<const PLANAR: bool>(now: Rows<'_>, then: Rows<'_>, origin: DVec3, limit: f64) -> bool {
    let count = now.len();
    let (now, then) = (now.polar::<PLANAR>(count), then.polar::<PLANAR>(count));
    let mut within = true;
    for n in 0..count {
        within &= (now.get(n) - origin - then.get(n)).length_squared() <= limit;
    }
    within
}
