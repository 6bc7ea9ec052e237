//! The engine: everything of a damper but its integrator and its clock.

use super::forces::Forces;
use super::impulses::ContactSolver;
use super::neighbours::Neighbours;
use super::state::State;
use crate::law::ContactLaw;

/// The state, and the stages that change it.
#[derive(Clone)]
pub(crate) struct Engine<C, L: ContactLaw, M: ?Sized, D> {
    pub(crate) neighbours: Neighbours<L, D>,
    pub(crate) forces: Forces<L>,
    /// None under a force law.
    pub(crate) impulses: Option<ContactSolver>,
    /// Last, because its mount is.
    pub(crate) state: State<C, L, M>,
}

impl<C, L: ContactLaw, M, D> Engine<C, L, M, D> {
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
