//! Sums of forces and torques, which become accelerations.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::ops::Range;

use glam::DVec3;

use crate::damper::state::{Space, StateView};
use crate::law::ContactLaw;

/// Where the forces and torques on the particles of a block are summed up.
pub(super) struct Sums<'a, S: Space> {
    forces: &'a mut [S::Row],
    torques: &'a mut [S::SpinRow],
    /// Index of the block's first particle.
    start: usize,
}

impl<'a, S: Space> Sums<'a, S> {
    /// Sums in two columns, for the particles from `start` on.
    pub(super) fn new(force: &'a mut [f64], torque: &'a mut [f64], start: usize) -> Self {
        let forces = S::rows_mut(force);
        // Columns of one length, so that one comparison stands for both bounds.
        let torques = &mut S::spin_rows_mut(torque)[..forces.len()];
        Self {
            forces,
            torques,
            start,
        }
    }

    /// Adds a force and a torque on the particle at `index`.
    #[inline(always)]
    pub(super) fn add(&mut self, index: usize, force: DVec3, torque: DVec3) {
        let n = index - self.start;
        self.forces[n] = S::row(S::from_row(self.forces[n]) + S::vector(force));
        self.torques[n] = S::spin_row(S::from_spin_row(self.torques[n]) + S::spin(torque));
    }

    /// Turns the sums, which are those of the particles at `indices`, into accelerations. Returns whether
    /// all are finite.
    pub(super) fn accelerate<C, L: ContactLaw>(
        self,
        view: &StateView<'_, C, L>,
        indices: Range<usize>,
        gravity: DVec3,
    ) -> bool {
        let inverses = [
            &view.inverse_mass[indices.clone()],
            &view.inverse_inertia[indices],
        ];
        S::accelerate(self.forces, self.torques, inverses, gravity)
    }
}
