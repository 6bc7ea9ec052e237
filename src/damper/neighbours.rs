//! Neighbours: which bodies might touch (broad phase), which do (narrow phase), and what their contacts remember.
//!
//! In: positions, and the proposals of the detectors. Out: for each block of particles, lists of contacts in the
//! one order in which they are evaluated. Called at each evaluation of forces, and once a step under an impulse
//! law; a list is made anew only when some particle has moved by half of its compartment's margin.

mod block;
mod detection;
mod list;
mod rebuild;
mod sort;

pub(crate) use block::{
    BLOCK, Block, ContactHistory, ContactId, HaloForce, block_size, history_buffers, reserved_by,
};
pub(crate) use detection::Scratch;
pub(crate) use list::{ContactRecord, NeighbourList};
