//! The engine: everything of a damper but its clock and the parts that a step asks.

use super::forces::Forces;
use super::impulses::ContactSolver;
use super::neighbours::Neighbours;
use super::state::{Model, State};
use crate::law::ContactLaw;

/// The model and the state, and the stages that change it. Compiled for each kind of cavity and contact law,
/// which innermost loops ask; once for all mounts, detectors, integrators and observers.
#[derive(Clone)]
pub(crate) struct Engine<C, L: ContactLaw> {
    pub(crate) model: Model<C, L>,
    pub(crate) state: State,
    pub(crate) neighbours: Neighbours<L>,
    pub(crate) forces: Forces<L>,
    /// None under a force law.
    pub(crate) impulses: Option<ContactSolver>,
}

impl<C, L: ContactLaw> Engine<C, L> {
    /// Memory in bytes that is reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        let impulses = self.impulses.as_ref();
        self.state.particles.reserved_bytes()
            + self.state.previous.reserved_bytes()
            + self.neighbours.reserved_bytes()
            + self.forces.reserved_bytes()
            + impulses.map_or(0, ContactSolver::reserved_bytes)
    }
}
