//! The compartments of the bed: a cavity each, with the particles in it and the container around it.

use std::ops::Range;

use glam::{DMat3, DVec3};

use crate::cavity::Cavity;
use crate::contact::WallLoad;
use crate::mount::Motion;

/// A cavity with the particles in it.
#[derive(Debug, Clone)]
pub(crate) struct Compartment<C> {
    pub(crate) cavity: C,
    /// Indices of its particles.
    pub(crate) indices: Range<usize>,
    /// Number of its first wall among the walls of all cavities.
    pub(crate) first_wall: u32,
    /// Where its container is, and how it moves.
    pub(crate) motion: Motion,
    /// Inverse effective mass of the container: velocity that it gains per unit impulse, 1/kg.
    pub(crate) inverse_mass: DMat3,
    /// How much farther than the law's reach candidates are listed, m: they can be trusted while no
    /// particle has moved by half of it.
    pub(crate) margin: f64,
}

impl<C: Cavity> Compartment<C> {
    /// Force of the particles on the container in N, from the loads on the walls of all cavities.
    pub(crate) fn load(&self, walls: &[WallLoad]) -> DVec3 {
        let first = self.first_wall as usize;
        let own = &walls[first..first + self.cavity.walls() as usize];
        own.iter().map(|wall| wall.force).sum()
    }
}

impl<C> Compartment<C> {
    /// Velocity along `normal` that the container gains per unit impulse along it, 1/kg.
    #[inline(always)]
    pub(crate) fn inverse_mass_along(&self, normal: DVec3) -> f64 {
        normal.dot(self.inverse_mass * normal)
    }

    /// The greatest velocity that the container gains per unit impulse in any direction, from above
    /// (Gershgorin), 1/kg.
    pub(crate) fn greatest_inverse_mass(&self) -> f64 {
        let rows = [0, 1, 2].map(|row| self.inverse_mass.row(row).abs().element_sum());
        rows.into_iter().fold(0.0, f64::max)
    }

    /// The indices among `indices` whose particles are in this compartment.
    pub(crate) fn indices_in(&self, indices: &Range<usize>) -> Range<usize> {
        let start = self.indices.start.clamp(indices.start, indices.end);
        start..self.indices.end.clamp(start, indices.end)
    }
}
