//! Blocks: runs of particles whose contacts are found and evaluated together.
//!
//! A sum of floating-point numbers depends on the order of its terms, and results may not depend on how many
//! threads there are. So blocks depend on the bed alone, and the order in which the forces on a particle are
//! summed on the blocks: the contacts within a block; those of its particles with later blocks, from which
//! the later ones get halo forces; its walls; and at last, in the order of the blocks, the halo forces that
//! earlier ones sent. Whichever thread evaluates a block, and when, the sums are the same bits; and no two
//! threads write to one particle. It is the spatial decomposition with ghost particles of large molecular
//! dynamics (S. Plimpton, J. Comput. Phys. 117 (1995) 1-19, doi 10.1006/jcph.1995.1039) with blocks where
//! that has processors.

use std::ops::Range;

use glam::DVec3;

use super::history::ContactRecord;
use super::list::NeighbourList;
use crate::cavity::Cavity;
use crate::contact::Partner;
use crate::damper::state::{Compartment, Plane, Rows, Space, StateView, Volume};
use crate::law::{ContactLaw, ContactMemory};

/// How many particles make a block at the least; a bed of no more is one block.
pub(crate) const BLOCK: usize = 4096;

/// How many make one at the most: columns of a larger one leave the nearer caches.
const LARGEST_BLOCK: usize = 16_384;

/// How many blocks there are before they grow beyond the least: work for as many threads.
const BLOCKS: usize = 16;

/// How many particles make a block in a bed of `particles`. The larger blocks are, the fewer contacts lie
/// across two of them.
pub(crate) fn block_size(particles: usize) -> usize {
    (particles / BLOCKS).clamp(BLOCK, LARGEST_BLOCK)
}

/// How many candidates there is room for from the start. The count of a small bed fluctuates: room for
/// as many as it has when it is dense spares it the allocations that would follow.
pub(crate) const fn room_for(particles: usize) -> usize {
    if particles < BLOCK { 4 * particles } else { 0 }
}

/// Blocks for `count` particles.
pub(crate) fn make_blocks<L: ContactLaw>(count: usize) -> Vec<Block<L>> {
    let size = block_size(count);
    (0..count)
        .step_by(size)
        .map(|start| Block::new(start..count.min(start + size)))
        .collect()
}

/// The particle and the partner of the deepest contact, or of a contact that must not be.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactId {
    pub(crate) index: usize,
    pub(crate) partner: Partner,
}

/// What candidates are listed from.
pub(crate) struct Listing<'a, C, L: ContactLaw> {
    pub(crate) view: &'a StateView<'a, C, L>,
    /// Starts of the rows of partners, by lower index, and the end of the last.
    pub(crate) rows: &'a [u32],
    /// Where each particle is in its container's frame.
    pub(crate) local: &'a [DVec3],
    /// Gap in m up to which candidates are listed, besides the margin.
    pub(crate) listed_distance: f64,
}

/// What contacts remember: of pairs, and of walls.
pub(crate) type ContactHistory<L> = [Vec<ContactRecord<ContactMemory<L>>>; 2];

/// Room for what contacts of a block remember in a bed of `particles`.
pub(crate) fn history_buffers<M>(particles: usize) -> [Vec<ContactRecord<M>>; 2] {
    [(); 2].map(|()| Vec::with_capacity(room_for(particles)))
}

/// Memory in bytes that `history` has reserved.
pub(crate) fn reserved_by<M>(memories: &[Vec<ContactRecord<M>>; 2]) -> usize {
    size_of::<ContactRecord<M>>() * memories.iter().map(Vec::capacity).sum::<usize>()
}

/// A run of particles with its candidates, and what its last evaluation found.
#[derive(Clone)]
pub(crate) struct Block<L: ContactLaw> {
    pub(crate) indices: Range<usize>,
    pub(crate) pairs: NeighbourList<L>,
    pub(crate) halo: NeighbourList<L>,
    pub(crate) walls: NeighbourList<L>,
    pub(crate) contacts: usize,
    pub(crate) largest_overlap: f64,
    pub(crate) escaped: Option<ContactId>,
}

impl<L: ContactLaw> Block<L> {
    pub(crate) fn new(indices: Range<usize>) -> Self {
        let (mut pairs, mut near) = (NeighbourList::default(), NeighbourList::default());
        pairs.reserve_all(room_for(indices.len()));
        near.reserve_all(room_for(indices.len()));
        Self {
            indices,
            pairs,
            halo: NeighbourList::default(),
            walls: near,
            contacts: 0,
            largest_overlap: 0.0,
            escaped: None,
        }
    }

    /// Narrow phase: lists the pairs that touch. Returns whether the candidates can be trusted, which
    /// they can while no particle has moved by half the margin from its `reference`.
    pub(crate) fn narrow<C: Cavity>(
        &mut self,
        view: &StateView<'_, C, L>,
        reference: Rows<'_>,
        prediction_distance: f64,
    ) -> bool {
        let mut trusted = true;
        for compartment in view.compartments {
            let own = compartment.indices_in(&self.indices);
            let (now, then) = (view.position.part(own.clone()), reference.part(own.clone()));
            let limit = 0.25 * compartment.margin * compartment.margin;
            let origin = compartment.motion.position;
            trusted &= if compartment.turned {
                all_within_turned(compartment, own.len(), [now, then], limit)
            } else if view.planar {
                all_within::<Plane>(now, then, origin, limit)
            } else {
                all_within::<Volume>(now, then, origin, limit)
            };
        }
        for list in [&mut self.pairs, &mut self.halo] {
            if view.planar {
                find_pairs::<C, L, Plane>(view, list, prediction_distance);
            } else {
                find_pairs::<C, L, Volume>(view, list, prediction_distance);
            }
        }

        if view.planar {
            find_walls::<C, L, Plane>(view, &mut self.walls, prediction_distance);
        } else {
            find_walls::<C, L, Volume>(view, &mut self.walls, prediction_distance);
        }
        trusted
    }

    /// Forgets what the last evaluation found.
    pub(crate) const fn clear_results(&mut self) {
        self.contacts = 0;
        self.largest_overlap = 0.0;
        self.escaped = None;
    }

    /// How many contacts are within the law's reach.
    pub(crate) const fn contact_count(&self) -> usize {
        self.pairs.contacts.len() + self.halo.contacts.len() + self.walls.contacts.len()
    }

    /// The pairs in contact, with their overlaps.
    pub(crate) fn overlapping_pairs<C: Cavity>(
        &self,
        view: &StateView<'_, C, L>,
    ) -> impl Iterator<Item = (f64, usize, usize)> {
        let lists = [&self.pairs, &self.halo];
        let bodies = lists.into_iter().flat_map(|list| list.contacts.bodies());
        bodies.map(|[i, j]| {
            let (i, j) = (*i as usize, *j as usize);
            let distance = view.position.get(i).distance(view.position.get(j));
            (view.radius[i] + view.radius[j] - distance, i, j)
        })
    }

    /// The walls in contact, with their overlaps.
    pub(crate) fn overlapping_walls<C: Cavity>(
        &self,
        view: &StateView<'_, C, L>,
    ) -> impl Iterator<Item = (f64, usize, u32)> {
        self.walls.contacts.bodies().iter().map(|[index, wall]| {
            let index = *index as usize;
            let distance = view.wall_point(*wall, view.position.get(index)).distance;
            (view.radius[index] - distance, index, *wall)
        })
    }

    /// The deepest contact of the block.
    pub(crate) fn deepest<C: Cavity>(&self, view: &StateView<'_, C, L>) -> Option<ContactId> {
        let pairs = self.overlapping_pairs(view).map(|(overlap, index, other)| {
            let partner = Partner::Particle(view.id[other] as usize);
            (overlap, ContactId { index, partner })
        });
        let walls = self.overlapping_walls(view).map(|(overlap, index, wall)| {
            let partner = Partner::Wall(wall - view.compartment_of_wall(wall).first_wall);
            (overlap, ContactId { index, partner })
        });
        let deepest = pairs.chain(walls).max_by(|a, b| a.0.total_cmp(&b.0));
        deepest.map(|(_, place)| place)
    }

    /// Memory in bytes that the block has reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        let lists = [&self.pairs, &self.halo, &self.walls];
        lists
            .map(NeighbourList::reserved_bytes)
            .iter()
            .sum::<usize>()
    }
}

/// Lists the pairs in contact.
#[inline(always)]
fn find_pairs<C, L: ContactLaw, S: Space>(
    view: &StateView<'_, C, L>,
    list: &mut NeighbourList<L>,
    prediction_distance: f64,
) {
    let position = &S::rows(view.position.flat())[..view.radius.len()];
    let nearer = |[i, j]: [u32; 2], square: f64| {
        let apart = S::from_row(position[i as usize]) - S::from_row(position[j as usize]);
        S::dot(apart, apart) < square
    };

    if let Some(radius) = view.coefficients.only_radius() {
        let limit = radius + radius + prediction_distance;
        let square = limit * limit;
        list.find_alike(|bodies| nearer(bodies, square));
    } else {
        list.find(|bodies, touching| {
            let limit = touching + prediction_distance;
            nearer(bodies, limit * limit)
        });
    }
}

/// Lists the walls in contact.
#[inline(always)]
fn find_walls<C: Cavity, L: ContactLaw, S: Space>(
    view: &StateView<'_, C, L>,
    list: &mut NeighbourList<L>,
    prediction_distance: f64,
) {
    let position = S::rows(view.position.flat());
    list.find(|[i, wall], touching| {
        let position = S::in_space(S::from_row(position[i as usize]));
        view.wall_point(wall, position).distance < touching + prediction_distance
    });
}

/// Whether all of `count` points are near to where they were, seen from a container that is turned.
fn all_within_turned(
    compartment: &Compartment,
    count: usize,
    [now, then]: [Rows<'_>; 2],
    limit: f64,
) -> bool {
    (0..count).all(|n| {
        let moved = compartment.to_local(now.get(n)) - then.get(n);
        moved.length_squared() <= limit
    })
}

/// Whether all points `now` are nearer to those `then`, seen from `origin`, than the root of `limit`.
fn all_within<S: Space>(now: Rows<'_>, then: Rows<'_>, origin: DVec3, limit: f64) -> bool {
    let (now, then) = (S::rows(now.flat()), S::rows(then.flat()));
    let origin = S::vector(origin);
    let mut within = true;
    for (now, then) in now.iter().zip(then) {
        let moved = S::from_row(*now) - origin - S::from_row(*then);
        within &= S::dot(moved, moved) <= limit;
    }
    within
}
