//! Neighbours: which bodies might touch (broad phase), which do (narrow phase), and what their contacts remember.
//!
//! In: positions, and the proposals of the [`Detectors`]. Out: for each block of particles, lists of contacts in the
//! one order in which they are evaluated. Called at each evaluation of forces, and once a step under an impulse
//! law; a list is made anew only when some particle has moved by half of its compartment's margin.

use glam::DVec3;

use crate::damper::state::{Particles, Vectors};
use crate::detector::Pairs;
use crate::law::ContactLaw;
use crate::parallel::Pool;

mod block;
mod columns;
mod contacts;
mod detection;
mod findings;
mod history;
mod list;
mod memories;
mod rebuild;
mod sort;

pub(crate) use block::{BLOCK, Block, ContactHistory, ContactId};
use block::{history_buffers, make_blocks, reserved_by, room_for};
pub(crate) use columns::make_room;
pub(crate) use detection::Detectors;
pub(crate) use history::ContactRecord;
pub(crate) use list::{NeighbourList, Run};
pub(crate) use memories::LONGEST_RUN;

/// The broad and the narrow phase, and what they have found.
#[derive(Clone)]
pub(crate) struct Neighbours<L: ContactLaw> {
    pub(crate) blocks: Vec<Block<L>>,
    /// Gap in m up to which bodies count as in contact: zero under a force law.
    prediction_distance: f64,
    /// Gap in m up to which candidates are listed, besides the margin.
    listed_distance: f64,
    /// Whether the candidates may still be used.
    listed: bool,
    proposals: Pairs,
    /// Proposals by their lower index: ends of the rows, and the higher indices.
    rows: Vec<u32>,
    partners: Vec<u32>,
    /// Where each particle was in its container's frame when the candidates were listed.
    reference: Vectors,
    /// The same while candidates are listed, for detectors.
    local: Vec<DVec3>,
    /// What contacts of a block remember while they are listed anew.
    history_pool: Pool<ContactHistory<L>>,
    /// How often candidates have been listed.
    pub(crate) detections: u64,
    /// Steps since a large bed was sorted.
    pub(crate) since_sort: u32,
}

impl<L: ContactLaw> Neighbours<L> {
    /// Nothing found yet of `particles`.
    pub(crate) fn new(particles: &Particles) -> Self {
        let count = particles.len();
        let mut neighbours = Self {
            blocks: make_blocks(count),
            prediction_distance: 0.0,
            listed_distance: 0.0,
            listed: false,
            proposals: Pairs::default(),
            rows: Vec::new(),
            partners: Vec::with_capacity(room_for(count)),
            reference: particles.position.clone(),
            local: Vec::new(),
            history_pool: Pool::new(history_buffers(count)),
            detections: 0,
            since_sort: 0,
        };
        neighbours.proposals.reserve(room_for(count));
        neighbours
    }

    /// Memory in bytes that is reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        let blocks = self.blocks.iter().map(Block::reserved_bytes);
        size_of::<DVec3>() * self.local.capacity()
            + size_of::<u32>() * (self.rows.capacity() + self.partners.capacity())
            + self.reference.reserved_bytes()
            + self.proposals.reserved_bytes()
            + self.history_pool.sum(reserved_by)
            + blocks.sum::<usize>()
    }
}
