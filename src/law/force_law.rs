use super::{ContactLaw, Forces};
use crate::contact::{Contact, ContactForce, Onset, Stored};

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
///    be a function of its arguments: same arguments, same bits.
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

macro_rules! forward_law {
    ($reference:ty) => {
        impl<L: ForceLaw + ?Sized> ForceLaw for $reference {
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
    };
}

forward_law!(&L);
forward_law!(&mut L);
forward_law!(Box<L>);
