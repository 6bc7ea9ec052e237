//! Contact laws: the force between two bodies that touch.

mod restitution;

pub use restitution::{RestingForce, RestitutionCoefficients, RestitutionImpulse};

use crate::contact::{Bodies, Contact, ContactForce, Edge, Stored};
use crate::error::ValueError;
use crate::material::MaterialId;

#[cfg(test)]
mod collision;
mod damping;
mod edge;
mod friction;
mod hertz;
mod hertz_mindlin;
mod hertz_tsuji;
mod normal;

pub use damping::{Damping, Ending};
pub use friction::Friction;
pub use hertz::ElasticImpact;
pub use hertz_mindlin::{HertzMindlin, TangentialSpring};
pub use hertz_tsuji::HertzTsuji;
pub use normal::NormalHistory;

/// The greater of two numbers, `least` if either is not one. One instruction where `f64::max` takes
/// five.
#[inline(always)]
pub(crate) const fn at_least(value: f64, least: f64) -> f64 {
    if value > least { value } else { least }
}

/// The lesser of two numbers, `most` if either is not one.
#[inline(always)]
const fn at_most(value: f64, most: f64) -> f64 {
    if value < most { value } else { most }
}

/// When a law may be evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Evaluation {
    /// A stiff force: a function of the instant, evaluated at every stage of an integrator.
    EveryStage,
    /// An impulse, spread over one step: evaluated once, at the start of the step, for all contacts
    /// from the same velocities, and held.
    Simultaneous,
    /// An impulse as above, but for one contact after the other: each sees the velocities that the
    /// ones before it left. Pairs come first, walls last; several rounds are made, and what a contact
    /// remembers changes as it is [struck](ContactLaw::strike).
    Sequential,
}

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

/// The force between two bodies that touch.
///
/// # Using
/// [`HertzTsuji`] is the strict law of the paper,
/// [`RestitutionImpulse`] the one that allows a coarser step. Pass one to
/// [`Damper::builder`](crate::Damper::builder).
///
/// # Implementing
/// 1. [`coefficients`](Self::coefficients) is called for every combination of radius, mass and
///    material that can meet, before the first step. Do there whatever does not depend on the
///    motion, and refuse there what cannot be right.
/// 2. [`force`](Self::force) is called for touching bodies alone (overlap > 0, or above minus the
///    law's [`reach`](Self::reach)). It answers with the
///    force on the first body; the engine turns it into opposite forces and into torques. It must
///    be a function of its arguments: same arguments, same bits.
/// 3. A law whose contacts have a past names it as [`Memory`](Self::Memory). A contact starts with
///    the default; [`advance`](Self::advance) is called once per accepted step for each contact
///    that touches, and a contact that separates forgets. A law without memory uses `()` and pays
///    nothing.
/// 4. An impulse law says so in [`evaluation`](Self::evaluation) and answers with the impulse divided
///    by [`Contact::elapsed`] (the paper's Eq. 12).
/// 5. [`time_step_limit`](Self::time_step_limit) is the longest step that the law can bear; a builder
///    refuses a longer one.
/// 6. Velocities can be predicted with the forces of the step before: a force that damps strongly should
///    then be worked out with the velocity that it leaves itself ([`Contact::correction`], and what
///    [`HertzTsuji`](HertzTsuji#impacts-in-few-steps) does with it).
/// 7. Forces are taken step by step, and what they miss of an impact where it begins and ends between
///    two of them can be made up for: see [`at_edge`](Self::at_edge).
/// 8. An impulse law whose contacts can rest may [carry](Self::carry) impulses over from step to step,
///    and take back in [`strike`](Self::strike) what it gave before.
/// 9. [`stored`](Self::stored) tells energy that a contact holds from energy that it has lost. It is
///    asked only by observers; by default all of the force's work counts as lost, or as a negative
///    loss where it is given back.
///
/// A linear spring and dashpot, complete:
/// ```
/// use particle_damper::{Bodies, Contact, ContactForce, ContactLaw, LawError};
/// use glam::DVec3;
///
/// struct SpringDashpot {
///     stiffness: f64, // N/m
///     damping: f64,   // N s/m
/// }
///
/// impl ContactLaw for SpringDashpot {
///     type Coefficients = f64; // longest step, s
///     type Memory = ();
///
///     fn coefficients(&self, bodies: &Bodies) -> Result<f64, LawError> {
///         let half_period = std::f64::consts::PI * (bodies.effective_mass() / self.stiffness).sqrt();
///         Ok(half_period / 5.0)
///     }
///     fn force(&self, _: &f64, contact: &Contact, _: &()) -> ContactForce {
///         let normal = self.stiffness * contact.overlap + self.damping * contact.approach_speed();
///         ContactForce::new(normal.max(0.0), DVec3::ZERO)
///     }
///     fn time_step_limit(&self, longest: &f64) -> f64 {
///         *longest
///     }
/// }
/// ```
pub trait ContactLaw: Sync {
    /// What the law prepares for two bodies that can meet.
    type Coefficients: Copy + std::fmt::Debug + Send + Sync;

    /// What a contact remembers from step to step; `()` for nothing.
    type Memory: Copy + Default + std::fmt::Debug + PartialEq + Send + Sync;

    /// Prepares for two bodies.
    ///
    /// # Errors
    /// If the law has no answer for them: an unknown material, a number out of range.
    fn coefficients(&self, bodies: &Bodies) -> Result<Self::Coefficients, LawError>;

    /// The force on the first body of `contact`, in N and N m.
    fn force(
        &self,
        coefficients: &Self::Coefficients,
        contact: &Contact,
        memory: &Self::Memory,
    ) -> ContactForce;

    /// What the contact remembers at the end of the step, from `memory` at its start and the
    /// contact at its end.
    #[inline]
    fn advance(
        &self,
        _coefficients: &Self::Coefficients,
        _contact: &Contact,
        memory: &Self::Memory,
    ) -> Self::Memory {
        *memory
    }

    /// Whether [`at_edge`](Self::at_edge) is to be asked.
    #[inline]
    fn has_edges(&self) -> bool {
        false
    }

    /// The force, and what the contact remembers, where the bodies may have met or may part within
    /// the step ([`Edge::is_near`]). Asked instead of [`force`](Self::force) and
    /// [`advance`](Self::advance) if the law [has edges](Self::has_edges) to be mended: a contact sets in between two
    /// evaluations, and if its force starts like a power p of time they miss an impulse of the power
    /// p + 1 of the step.
    fn at_edge(
        &self,
        coefficients: &Self::Coefficients,
        contact: &Contact,
        memory: &Self::Memory,
        _edge: &Edge,
    ) -> (ContactForce, Self::Memory) {
        (
            self.force(coefficients, contact, memory),
            self.advance(coefficients, contact, memory),
        )
    }

    /// The force that a contact of a [`Sequential`](Evaluation::Sequential) law starts the step with,
    /// before any is struck: `part` of what its memory of the step before suggests. Asked once with 1, of
    /// contacts that remember something, with the velocities at the start of the step; and once more,
    /// with the memory that this left and a part below 1/2, if the bed would gain energy. None unless
    /// set, which makes the contact forget.
    #[inline]
    fn carry(
        &self,
        _coefficients: &Self::Coefficients,
        _contact: &Contact,
        _memory: &mut Self::Memory,
        _part: f64,
    ) -> ContactForce {
        ContactForce::default()
    }

    /// What a [`Sequential`](Evaluation::Sequential) law adds to the force on the first body each time
    /// that it comes to a contact in a step. It may change the memory along with it;
    /// [`advance`](Self::advance) is not called for such a law. Unless set, the force and no more.
    #[inline]
    fn strike(
        &self,
        coefficients: &Self::Coefficients,
        contact: &Contact,
        memory: &mut Self::Memory,
    ) -> ContactForce {
        self.force(coefficients, contact, memory)
    }

    /// What the contact holds and can give back, with what it remembers at the end of the step.
    fn stored(
        &self,
        _coefficients: &Self::Coefficients,
        _contact: &Contact,
        _memory: &Self::Memory,
    ) -> Stored {
        Stored::default()
    }

    /// When the law may be evaluated.
    #[inline]
    fn evaluation(&self) -> Evaluation {
        Evaluation::EveryStage
    }

    /// The gap in m up to which contacts of a step of `time_step` (s) are evaluated; zero, unless the
    /// law acts on bodies that are about to touch. Their overlap is negative.
    fn reach(&self, _time_step: f64) -> f64 {
        0.0
    }

    /// Whether the answers for two bodies can have a [`couple`](ContactForce::couple). A law that says
    /// no is spared the work: the engine passes over the couples.
    #[inline]
    fn has_couple(&self, _coefficients: &Self::Coefficients) -> bool {
        true
    }

    /// The longest time step in s that two bodies bear under this law.
    fn time_step_limit(&self, _coefficients: &Self::Coefficients) -> f64 {
        f64::INFINITY
    }
}

macro_rules! forward_law {
    ($reference:ty) => {
        impl<L: ContactLaw + ?Sized> ContactLaw for $reference {
            type Coefficients = L::Coefficients;
            type Memory = L::Memory;

            fn coefficients(&self, bodies: &Bodies) -> Result<Self::Coefficients, LawError> {
                (**self).coefficients(bodies)
            }

            #[inline]
            fn force(
                &self,
                coefficients: &Self::Coefficients,
                contact: &Contact,
                memory: &Self::Memory,
            ) -> ContactForce {
                (**self).force(coefficients, contact, memory)
            }

            #[inline]
            fn advance(
                &self,
                coefficients: &Self::Coefficients,
                contact: &Contact,
                memory: &Self::Memory,
            ) -> Self::Memory {
                (**self).advance(coefficients, contact, memory)
            }

            #[inline]
            fn has_couple(&self, coefficients: &Self::Coefficients) -> bool {
                (**self).has_couple(coefficients)
            }

            #[inline]
            fn has_edges(&self) -> bool {
                (**self).has_edges()
            }

            fn at_edge(
                &self,
                coefficients: &Self::Coefficients,
                contact: &Contact,
                memory: &Self::Memory,
                edge: &Edge,
            ) -> (ContactForce, Self::Memory) {
                (**self).at_edge(coefficients, contact, memory, edge)
            }

            #[inline]
            fn carry(
                &self,
                coefficients: &Self::Coefficients,
                contact: &Contact,
                memory: &mut Self::Memory,
                part: f64,
            ) -> ContactForce {
                (**self).carry(coefficients, contact, memory, part)
            }

            #[inline]
            fn strike(
                &self,
                coefficients: &Self::Coefficients,
                contact: &Contact,
                memory: &mut Self::Memory,
            ) -> ContactForce {
                (**self).strike(coefficients, contact, memory)
            }

            fn stored(
                &self,
                coefficients: &Self::Coefficients,
                contact: &Contact,
                memory: &Self::Memory,
            ) -> Stored {
                (**self).stored(coefficients, contact, memory)
            }

            #[inline]
            fn evaluation(&self) -> Evaluation {
                (**self).evaluation()
            }

            fn reach(&self, time_step: f64) -> f64 {
                (**self).reach(time_step)
            }

            fn time_step_limit(&self, coefficients: &Self::Coefficients) -> f64 {
                (**self).time_step_limit(coefficients)
            }
        }
    };
}

forward_law!(&L);
forward_law!(&mut L);
forward_law!(Box<L>);
