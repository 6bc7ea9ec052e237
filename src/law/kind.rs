//! The two kinds of contact law, as types.

use super::{ContactLaw, ForceLaw, ImpulseLaw};
use crate::contact::HeldForce;

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
