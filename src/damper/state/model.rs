//! The rules that contacts follow, and where.

use super::coefficients::Coefficients;
use super::compartment::Compartment;
use crate::cavity::Cavity;
use crate::law::ContactLaw;

/// The rules that contacts follow, and the compartments that they happen in.
#[derive(Debug, Clone)]
pub(crate) struct Model<C, L: ContactLaw> {
    pub(crate) law: L,
    pub(crate) coefficients: Coefficients<L::Coefficients>,
    pub(crate) compartments: Vec<Compartment<C>>,
    /// Number of the compartment of each wall.
    pub(crate) compartment_of_wall: Vec<u32>,
}

impl<C, L: ContactLaw> Model<C, L> {
    /// Whether everything moves in the plane z = 0.
    pub(crate) fn planar(&self) -> bool
    where
        C: Cavity,
    {
        self.compartments
            .iter()
            .all(|compartment| compartment.cavity.is_planar())
    }

    /// Number of the cavity whose particle is at `index`.
    pub(crate) fn cavity_of(&self, index: usize) -> usize {
        self.compartments
            .partition_point(|compartment| compartment.indices.end <= index)
    }
}
