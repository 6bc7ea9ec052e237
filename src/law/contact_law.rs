//! The traits of contact laws. What a law is names its kind, and a kind what a law of it is: they stand
//! together because each is defined by the others.

use super::{LawError, SolverParameters};
use crate::contact::{Bodies, Contact, ContactForce, HeldForce, Onset, Stored};

/// What every contact law has, whichever its kind.
///
/// # Using
/// [`HertzTsuji`](crate::HertzTsuji) is the strict law of the paper,
/// [`RestitutionImpulse`](crate::RestitutionImpulse) the one that allows a coarser step. Pass one to
/// [`Damper::builder`](crate::Damper::builder). An [`EitherLaw`](crate::EitherLaw) is chosen at run time.
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

/// A contact law that answers with a force, a function of the instant: it is asked at every stage of an
/// integrator.
///
/// # Using
/// [`HertzTsuji`](crate::HertzTsuji) is the paper's; [`HertzMindlin`](crate::HertzMindlin) has a
/// tangential spring besides.
///
/// # Implementing
/// 1. [`force`](Self::force) is called for touching bodies alone (overlap > 0). It answers with the
///    force on the first body; the engine turns it into opposite forces, and into torques at
///    levers that sum to the distance of the centres (friction keeps angular momentum). It must
///    be a function of its arguments: same arguments, same bits. Where bodies move in a plane it may leave out
///    what is zero there ([`Contact::planar`]).
/// 2. A law whose contacts have a past names it as [`Memory`](Self::Memory). A contact starts with
///    the default; [`advance`](Self::advance) is called once per accepted step for each contact
///    that touches, and a contact that separates forgets. A law without memory uses `()` and pays
///    nothing.
/// 3. Velocities can be predicted with the forces of the step before: a force that damps strongly should
///    then be worked out with the velocity that it leaves itself ([`Contact::correction`], and what
///    [`HertzTsuji`](crate::HertzTsuji#impacts-in-few-steps) does with it).
/// 4. Forces are taken step by step, and what they miss of an impact where it begins and ends between
///    two of them can be made up for: see [`at_onset`](Self::at_onset).
/// 5. [`tell_memory`](Self::tell_memory) and [`recall_memory`](Self::recall_memory) turn a memory into
///    numbers and back, to the bit: dampers whose law has both can be written from a list of unlike ones.
/// 6. [`stored`](Self::stored) tells energy that a contact holds from energy that it has lost. It is
///    asked only by observers; by default all of the force's work counts as lost, or as a negative
///    loss where it is given back.
///
/// A linear spring and dashpot, complete:
/// ```
/// use particle_damper::{Bodies, Contact, ContactForce, ContactLaw, ForceLaw, Forces, LawError};
/// use glam::DVec3;
///
/// struct SpringDashpot {
///     stiffness: f64, // N/m
///     damping: f64,   // N s/m
/// }
///
/// impl ContactLaw for SpringDashpot {
///     type Kind = Forces;
///     type Coefficients = f64; // longest step, s
///
///     fn coefficients(&self, bodies: &Bodies) -> Result<f64, LawError> {
///         let half_period = std::f64::consts::PI * (bodies.effective_mass() / self.stiffness).sqrt();
///         Ok(half_period / 5.0)
///     }
///     fn time_step_limit(&self, longest: &f64) -> f64 {
///         *longest
///     }
/// }
///
/// impl ForceLaw for SpringDashpot {
///     type Memory = ();
///
///     fn force(&self, _: &f64, contact: &Contact, _: &()) -> ContactForce {
///         let normal = self.stiffness * contact.overlap + self.damping * contact.approach_speed();
///         ContactForce::new(normal.max(0.0), DVec3::ZERO)
///     }
/// }
/// ```
pub trait ForceLaw: ContactLaw<Kind = Forces> {
    /// What a contact remembers from step to step; `()` for nothing.
    type Memory: Copy + Default + PartialEq + Send + Sync;

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

    /// Whether [`at_onset`](Self::at_onset) is to be asked.
    #[inline]
    fn corrects_onset(&self) -> bool {
        false
    }

    /// The force, and what the contact remembers, where the bodies may have met or may part within
    /// the step ([`Onset::is_near`]). Asked instead of [`force`](Self::force) and
    /// [`advance`](Self::advance) if the law [asks for it](Self::corrects_onset): a contact sets in between two
    /// evaluations, and if its force starts like a power p of time they miss an impulse of the power
    /// p + 1 of the step.
    fn at_onset(
        &self,
        coefficients: &Self::Coefficients,
        contact: &Contact,
        memory: &Self::Memory,
        _onset: &Onset,
    ) -> (ContactForce, Self::Memory) {
        (
            self.force(coefficients, contact, memory),
            self.advance(coefficients, contact, memory),
        )
    }

    /// Tells every number that a contact remembers, for the digest by which a
    /// [`Snapshot`](crate::Snapshot) finds out that it was changed on the way, and for
    /// [snapshots](crate::AnySnapshot) that are written whatever the law. What is not told may change
    /// unnoticed; nothing is unless set.
    fn tell_memory(&self, _memory: &Self::Memory, _tell: &mut dyn FnMut(f64)) {}

    /// The memory whose numbers [`tell_memory`](Self::tell_memory) has told: takes as many of them as were
    /// told for it. None if they are too few, or if memories cannot be had back from numbers, as is taken
    /// for granted of one that holds any data unless this is set.
    fn recall_memory(&self, _told: &mut dyn Iterator<Item = f64>) -> Option<Self::Memory> {
        (size_of::<Self::Memory>() == 0).then(Self::Memory::default)
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

    /// Whether the answers for two bodies can have a [`couple`](ContactForce::couple). A law that says
    /// no is spared the work: the engine passes over the couples.
    #[inline]
    fn has_couple(&self, _coefficients: &Self::Coefficients) -> bool {
        true
    }
}

/// A contact law that gives numbers: how bodies rebound and what friction they have. From them the
/// contact dynamics solver works out the impulses of all contacts together, once a step, and holds them
/// over it.
///
/// # Using
/// [`RestitutionImpulse`](crate::RestitutionImpulse) is the paper's approximate law. What the solver does,
/// and its numbers, are on [`SolverParameters`].
///
/// # Implementing
/// 1. [`restitution`](Self::restitution) is asked once a step of each contact whose bodies approach faster
///    than the restitution threshold; slower ones come to rest on each other.
/// 2. [`friction`](Self::friction) and [`rolling_arm`](Self::rolling_arm) are asked of every contact; both
///    are zero unless given.
/// 3. All three must be functions of their arguments: same arguments, same bits.
/// 4. The solver's parameters are its defaults unless the law has [its own](Self::solver).
///
/// Restitution that falls with the speed of approach, e = exp(-v/v0), complete:
/// ```
/// use particle_damper::{Bodies, ContactLaw, ImpulseLaw, Impulses, LawError};
///
/// struct Fading {
///     speed: f64, // v0, m/s
///     friction: f64,
/// }
///
/// impl ContactLaw for Fading {
///     type Kind = Impulses;
///     type Coefficients = f64; // longest step, s
///
///     fn coefficients(&self, bodies: &Bodies) -> Result<f64, LawError> {
///         Ok(0.1 * bodies.first.radius / self.speed)
///     }
///     fn time_step_limit(&self, longest: &f64) -> f64 {
///         *longest
///     }
/// }
///
/// impl ImpulseLaw for Fading {
///     fn restitution(&self, _: &f64, approach_speed: f64) -> f64 {
///         (-approach_speed / self.speed).exp()
///     }
///     fn friction(&self, _: &f64) -> f64 {
///         self.friction
///     }
/// }
/// ```
pub trait ImpulseLaw: ContactLaw<Kind = Impulses> {
    /// Restitution coefficient, 0 to 1, of bodies that approach each other along the normal at
    /// `approach_speed` (m/s, positive). An answer outside that range counts as the nearer end of it.
    fn restitution(&self, coefficients: &Self::Coefficients, approach_speed: f64) -> f64;

    /// Coefficient of sliding friction, not negative.
    #[inline]
    fn friction(&self, _coefficients: &Self::Coefficients) -> f64 {
        0.0
    }

    /// Lever in m, not negative, by which the normal force resists rolling: the couple is this times the
    /// force at the most.
    #[inline]
    fn rolling_arm(&self, _coefficients: &Self::Coefficients) -> f64 {
        0.0
    }

    /// What the contact dynamics solver is set to.
    fn solver(&self) -> SolverParameters {
        SolverParameters::default()
    }
}

/// The [kind](ContactLaw::Kind) of a [`ForceLaw`]: forces at every stage of an integrator.
#[derive(Debug, Clone, Copy)]
pub enum Forces {}

/// The [kind](ContactLaw::Kind) of an [`ImpulseLaw`]: impulses, worked out once a step and held over it.
#[derive(Debug, Clone, Copy)]
pub enum Impulses {}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Forces {}
    impl Sealed for super::Impulses {}
}

/// The kind of the contact law `L`: [`Forces`] or [`Impulses`], and no other.
pub trait LawKind<L: ?Sized>: sealed::Sealed {
    /// What a contact remembers from step to step: what a force law [says](ForceLaw::Memory), or the
    /// [force](HeldForce) that the contact bore over the step, from which the next one starts.
    type Memory: Copy + Default + PartialEq + Send + Sync;

    /// Whether contact forces hold over a step.
    const HELD: bool;

    /// Tells every number of a memory, as far as the law does.
    #[doc(hidden)]
    fn tell_memory(law: &L, memory: &Self::Memory, tell: &mut dyn FnMut(f64));

    /// The memory of which the next numbers were told, as far as the law can recall it.
    #[doc(hidden)]
    fn recall_memory(law: &L, told: &mut dyn Iterator<Item = f64>) -> Option<Self::Memory>;

    /// Takes a law of this kind to the method for it.
    #[doc(hidden)]
    fn accept<V: LawVisitor<L>>(visitor: V) -> V::Output;
}

/// What is done in one way under a force law and in another under an impulse law.
pub trait LawVisitor<L: ?Sized> {
    /// What comes of it.
    type Output;

    /// Under a force law.
    fn forces(self) -> Self::Output
    where
        L: ForceLaw;

    /// Under an impulse law.
    fn impulses(self) -> Self::Output
    where
        L: ImpulseLaw;
}

impl<L: ForceLaw + ?Sized> LawKind<L> for Forces {
    type Memory = L::Memory;

    const HELD: bool = false;

    fn tell_memory(law: &L, memory: &Self::Memory, tell: &mut dyn FnMut(f64)) {
        law.tell_memory(memory, tell);
    }

    fn recall_memory(law: &L, told: &mut dyn Iterator<Item = f64>) -> Option<Self::Memory> {
        law.recall_memory(told)
    }

    fn accept<V: LawVisitor<L>>(visitor: V) -> V::Output {
        visitor.forces()
    }
}

impl<L: ImpulseLaw + ?Sized> LawKind<L> for Impulses {
    type Memory = HeldForce;

    const HELD: bool = true;

    fn tell_memory(_law: &L, memory: &Self::Memory, tell: &mut dyn FnMut(f64)) {
        memory.tell(tell);
    }

    fn recall_memory(_law: &L, told: &mut dyn Iterator<Item = f64>) -> Option<Self::Memory> {
        HeldForce::recall(told)
    }

    fn accept<V: LawVisitor<L>>(visitor: V) -> V::Output {
        visitor.impulses()
    }
}

/// What contacts under the law `L` remember from step to step: what a [`Snapshot`](crate::Snapshot) of its
/// damper holds.
pub type ContactMemory<L> = <<L as ContactLaw>::Kind as LawKind<L>>::Memory;

/// A law that is borrowed or boxed is the law.
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

        impl<$($lifetime,)? L: ForceLaw + ?Sized> ForceLaw for $reference {
            type Memory = L::Memory;

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
            fn corrects_onset(&self) -> bool {
                (**self).corrects_onset()
            }

            fn at_onset(
                &self,
                coefficients: &Self::Coefficients,
                contact: &Contact,
                memory: &Self::Memory,
                onset: &Onset,
            ) -> (ContactForce, Self::Memory) {
                (**self).at_onset(coefficients, contact, memory, onset)
            }

            fn tell_memory(&self, memory: &Self::Memory, tell: &mut dyn FnMut(f64)) {
                (**self).tell_memory(memory, tell);
            }

            fn recall_memory(&self, told: &mut dyn Iterator<Item = f64>) -> Option<Self::Memory> {
                (**self).recall_memory(told)
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
            fn has_couple(&self, coefficients: &Self::Coefficients) -> bool {
                (**self).has_couple(coefficients)
            }
        }

        impl<$($lifetime,)? L: ImpulseLaw + ?Sized> ImpulseLaw for $reference {
            #[inline]
            fn restitution(&self, coefficients: &Self::Coefficients, approach_speed: f64) -> f64 {
                (**self).restitution(coefficients, approach_speed)
            }

            #[inline]
            fn friction(&self, coefficients: &Self::Coefficients) -> f64 {
                (**self).friction(coefficients)
            }

            #[inline]
            fn rolling_arm(&self, coefficients: &Self::Coefficients) -> f64 {
                (**self).rolling_arm(coefficients)
            }

            fn solver(&self) -> SolverParameters {
                (**self).solver()
            }
        }
    };
}

forward_law!(['a] &'a L);
forward_law!(['a] &'a mut L);
forward_law!([] Box<L>);
