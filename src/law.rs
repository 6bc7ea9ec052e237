//! Contact laws: what two bodies that touch do to each other.
//!
//! There are two kinds, told apart by type. A [`ForceLaw`] answers with a force at every stage of an
//! integrator. An [`ImpulseLaw`] gives numbers (restitution, friction, rolling resistance), from which
//! the contact dynamics solver works out impulses, once a step. Both are a [`ContactLaw`], which is all
//! that a [`Damper`](crate::Damper) asks for.

use crate::error::ValueError;
use crate::material::MaterialId;

#[cfg(test)]
mod collision;
mod contact_law;
mod damping;
mod either;
mod exponent;
mod friction;
mod hertz;
mod hertz_mindlin;
mod hertz_tsuji;
mod normal;
mod onset;
mod restitution;
mod solver_parameters;
mod tangent;

pub(crate) use contact_law::LawVisitor;
pub use contact_law::{ContactLaw, ContactMemory, ForceLaw, Forces, ImpulseLaw, Impulses, LawKind};
pub use damping::{Damping, Ending};
pub use either::EitherLaw;
pub use friction::Friction;
pub use hertz::ElasticImpact;
pub use hertz_mindlin::{HertzMindlin, TangentialSpring};
pub use hertz_tsuji::HertzTsuji;
pub use normal::NormalHistory;
pub use restitution::{RestitutionCoefficients, RestitutionImpulse};
pub use solver_parameters::{SolverParameters, SweepOrder};

/// Why a law refused a pair of bodies.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LawError {
    /// A body is of a material that the law's table does not hold.
    #[error("the contact law knows no material number {}", .0.0)]
    UnknownMaterial(MaterialId),
    /// A number that the law works with is outside its range.
    #[error(transparent)]
    Value(#[from] ValueError),
}
