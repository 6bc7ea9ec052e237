//! Contact laws: what two bodies that touch do to each other.
//!
//! There are two kinds, told apart by type. A [`ForceLaw`] answers with a force at every stage of an
//! integrator. An [`ImpulseLaw`] gives numbers (restitution, friction, rolling resistance), from which
//! the contact dynamics solver works out impulses, once a step. Both are a [`ContactLaw`], which is all
//! that a [`Damper`](crate::Damper) asks for.

use crate::contact::Bodies;
use crate::error::ValueError;
use crate::material::MaterialId;

#[cfg(test)]
mod collision;
mod damping;
mod either;
mod exponent;
mod force_law;
mod friction;
mod hertz;
mod hertz_mindlin;
mod hertz_tsuji;
mod impulse_law;
mod kind;
mod normal;
mod onset;
mod restitution;
mod solver_parameters;
mod turn;

pub use damping::{Damping, Ending};
pub use either::EitherLaw;
pub use force_law::ForceLaw;
pub use friction::Friction;
pub use hertz::ElasticImpact;
pub use hertz_mindlin::{HertzMindlin, TangentialSpring};
pub use hertz_tsuji::HertzTsuji;
pub use impulse_law::ImpulseLaw;
pub(crate) use kind::LawVisitor;
pub use kind::{ContactMemory, Forces, Impulses, LawKind};
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

/// What every contact law has, whichever its kind.
///
/// # Using
/// [`HertzTsuji`] is the strict law of the paper, [`RestitutionImpulse`] the one that allows a coarser
/// step. Pass one to [`Damper::builder`](crate::Damper::builder). An [`EitherLaw`] is chosen at run time.
///
/// # Implementing
/// 1. Choose the [kind](Self::Kind): [`Forces`], and implement [`ForceLaw`] as well; or [`Impulses`],
///    and implement [`ImpulseLaw`]. Their pages have complete laws.
/// 2. [`coefficients`](Self::coefficients) is called for every combination of radius, mass and
///    material that can meet, before the first step. Do there whatever does not depend on the
///    motion, and refuse there what cannot be right.
/// 3. [`time_step_limit`](Self::time_step_limit) is the longest step that the law can bear; a builder
///    refuses a longer one.
pub trait ContactLaw: Sync {
    /// [`Forces`] or [`Impulses`].
    type Kind: LawKind<Self>;

    /// What the law prepares for two bodies that can meet.
    type Coefficients: Copy + Send + Sync;

    /// Prepares for two bodies.
    ///
    /// # Errors
    /// If the law has no answer for them: an unknown material, a number out of range.
    fn coefficients(&self, bodies: &Bodies) -> Result<Self::Coefficients, LawError>;

    /// The impact speed in m/s that the law is set up for, above which its answers are worth less. An error
    /// names a particle that is faster. Infinite unless stated.
    fn design_speed(&self) -> f64 {
        f64::INFINITY
    }

    /// The longest time step in s that two bodies bear under this law.
    fn time_step_limit(&self, _coefficients: &Self::Coefficients) -> f64 {
        f64::INFINITY
    }
}

macro_rules! forward_law {
    ([$($lifetime:lifetime)?] $reference:ty) => {
        impl<$($lifetime,)? L: ContactLaw + ?Sized> ContactLaw for $reference
        where
            L::Kind: LawKind<$reference>,
        {
            type Kind = L::Kind;
            type Coefficients = L::Coefficients;

            fn coefficients(&self, bodies: &Bodies) -> Result<Self::Coefficients, LawError> {
                (**self).coefficients(bodies)
            }

            fn design_speed(&self) -> f64 {
                (**self).design_speed()
            }

            fn time_step_limit(&self, coefficients: &Self::Coefficients) -> f64 {
                (**self).time_step_limit(coefficients)
            }
        }
    };
}

forward_law!(['a] &'a L);
forward_law!(['a] &'a mut L);
forward_law!([] Box<L>);
