//! Forces of a force law: every contact is evaluated, and forces become accelerations.
//!
//! In: the state, and the lists of contacts. Out: accelerations of the particles, loads on the walls, and what
//! contacts remember. Called at every stage of an integrator.

mod batch;
mod evaluate;
mod report;

pub(crate) use batch::Batch;
