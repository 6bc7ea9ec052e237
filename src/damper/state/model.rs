//! The rules that contacts follow, and the walls that bound them.

use super::coefficients::Coefficients;
use crate::law::ContactLaw;

/// What a damper is made of that decides its contacts, and that a step does not change.
#[derive(Debug, Clone)]
pub(crate) struct Model<C, L: ContactLaw> {
    pub(crate) law: L,
    pub(crate) coefficients: Coefficients<L::Coefficients>,
    /// One for each compartment.
    pub(crate) cavities: Vec<C>,
}
