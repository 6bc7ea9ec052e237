use super::{ContactLaw, ForceLaw, ImpulseLaw, LawError, LawKind, SolverParameters};
use crate::contact::{Bodies, Contact, ContactForce, Onset, Stored};

/// One of two contact laws of one kind, chosen at run time; of more than two if they are nested.
///
/// Laws that keep the same for two bodies and for a contact can be boxed like every other part. Mostly they
/// do not: [`Coefficients`](ContactLaw::Coefficients) and [`Memory`](ForceLaw::Memory) lie side by side in
/// memory, contact by contact, and a box that hid their types would have to look for each of them elsewhere.
/// An `EitherLaw` keeps them where they are.
///
/// The bits are those of the law that was chosen. It costs a look at each contact which law that is, and the
/// memories of both. Where laws of unlike kinds are to choose from, so is the damper: see
/// [`DrivenDamper`](crate::DrivenDamper).
///
/// ```
/// use particle_damper::{Damper, EitherLaw, HertzMindlin, HertzTsuji, Material, Slot};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let chosen = "mindlin"; // read from a file
/// let law = match chosen {
///     "mindlin" => EitherLaw::First(HertzMindlin::new(Material::acrylic())),
///     _ => EitherLaw::Second(HertzTsuji::new(Material::acrylic())),
/// };
/// let damper = Damper::builder(Slot::paper(), law).time_step(1e-5).build()?;
/// # Ok(())
/// # }
/// ```
///
/// All the force laws that a program knows, behind one type and chosen by name:
/// ```
/// use particle_damper::{Damping, EitherLaw, Friction, HertzMindlin, HertzTsuji, Material};
/// # use particle_damper::{Bodies, Contact, ContactForce, ContactLaw, ForceLaw, Forces, LawError};
/// # struct Spring;
/// # impl ContactLaw for Spring {
/// #     type Kind = Forces;
/// #     type Coefficients = ();
/// #     fn coefficients(&self, _: &Bodies) -> Result<(), LawError> { Ok(()) }
/// # }
/// # impl ForceLaw for Spring {
/// #     type Memory = ();
/// #     fn force(&self, (): &(), contact: &Contact, (): &()) -> ContactForce {
/// #         ContactForce::new(1e4 * contact.overlap, particle_damper::glam::DVec3::ZERO)
/// #     }
/// # }
///
/// type AnyForceLaw = EitherLaw<HertzTsuji, EitherLaw<HertzMindlin, Spring>>; // `Spring` is the program's own
///
/// fn named(name: &str, material: Material) -> Option<AnyForceLaw> {
///     let tsuji = HertzTsuji::new(material);
///     Some(match name {
///         "paper" => EitherLaw::First(tsuji),
///         "printed friction" => EitherLaw::First(tsuji.friction(Friction::as_printed())),
///         "tsuji" => EitherLaw::First(tsuji.damping(Damping::Tsuji)),
///         "mindlin" => EitherLaw::Second(EitherLaw::First(HertzMindlin::new(material))),
///         "spring" => EitherLaw::Second(EitherLaw::Second(Spring)),
///         _ => return None,
///     })
/// }
/// assert!(named("mindlin", Material::acrylic()).is_some());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EitherLaw<A, B> {
    /// The first.
    First(A),
    /// The second.
    Second(B),
}

use EitherLaw::{First, Second};

impl<A, B> ContactLaw for EitherLaw<A, B>
where
    A: ContactLaw,
    B: ContactLaw<Kind = A::Kind>,
    A::Kind: LawKind<Self>,
{
    type Kind = A::Kind;
    type Coefficients = EitherLaw<A::Coefficients, B::Coefficients>;

    fn coefficients(&self, bodies: &Bodies) -> Result<Self::Coefficients, LawError> {
        Ok(match self {
            First(law) => First(law.coefficients(bodies)?),
            Second(law) => Second(law.coefficients(bodies)?),
        })
    }

    fn design_speed(&self) -> f64 {
        match self {
            First(law) => law.design_speed(),
            Second(law) => law.design_speed(),
        }
    }

    fn time_step_limit(&self, coefficients: &Self::Coefficients) -> f64 {
        match (self, coefficients) {
            (First(law), First(own)) => law.time_step_limit(own),
            (Second(law), Second(own)) => law.time_step_limit(own),
            _ => NONE,
        }
    }
}

/// What a law answers to the other law's coefficients, which it never gave out.
const NONE: f64 = f64::NAN;

impl<A, B> ForceLaw for EitherLaw<A, B>
where
    A: ForceLaw,
    B: ForceLaw,
{
    /// That of the law which was not chosen stays as it starts.
    type Memory = (A::Memory, B::Memory);

    #[inline]
    fn force(
        &self,
        coefficients: &Self::Coefficients,
        contact: &Contact,
        memory: &Self::Memory,
    ) -> ContactForce {
        match (self, coefficients) {
            (First(law), First(own)) => law.force(own, contact, &memory.0),
            (Second(law), Second(own)) => law.force(own, contact, &memory.1),
            _ => ContactForce::new(NONE, contact.normal),
        }
    }

    #[inline]
    fn advance(
        &self,
        coefficients: &Self::Coefficients,
        contact: &Contact,
        memory: &Self::Memory,
    ) -> Self::Memory {
        match (self, coefficients) {
            (First(law), First(own)) => (law.advance(own, contact, &memory.0), memory.1),
            (Second(law), Second(own)) => (memory.0, law.advance(own, contact, &memory.1)),
            _ => *memory,
        }
    }

    #[inline]
    fn corrects_onset(&self) -> bool {
        match self {
            First(law) => law.corrects_onset(),
            Second(law) => law.corrects_onset(),
        }
    }

    fn at_onset(
        &self,
        coefficients: &Self::Coefficients,
        contact: &Contact,
        memory: &Self::Memory,
        onset: &Onset,
    ) -> (ContactForce, Self::Memory) {
        match (self, coefficients) {
            (First(law), First(own)) => {
                let (force, after) = law.at_onset(own, contact, &memory.0, onset);
                (force, (after, memory.1))
            }
            (Second(law), Second(own)) => {
                let (force, after) = law.at_onset(own, contact, &memory.1, onset);
                (force, (memory.0, after))
            }
            _ => (ContactForce::new(NONE, contact.normal), *memory),
        }
    }

    fn tell_memory(&self, memory: &Self::Memory, tell: &mut dyn FnMut(f64)) {
        match self {
            First(law) => law.tell_memory(&memory.0, tell),
            Second(law) => law.tell_memory(&memory.1, tell),
        }
    }

    fn recall_memory(&self, told: &mut dyn Iterator<Item = f64>) -> Option<Self::Memory> {
        Some(match self {
            First(law) => (law.recall_memory(told)?, B::Memory::default()),
            Second(law) => (A::Memory::default(), law.recall_memory(told)?),
        })
    }

    fn stored(
        &self,
        coefficients: &Self::Coefficients,
        contact: &Contact,
        memory: &Self::Memory,
    ) -> Stored {
        match (self, coefficients) {
            (First(law), First(own)) => law.stored(own, contact, &memory.0),
            (Second(law), Second(own)) => law.stored(own, contact, &memory.1),
            _ => Stored::default(),
        }
    }

    #[inline]
    fn has_couple(&self, coefficients: &Self::Coefficients) -> bool {
        match (self, coefficients) {
            (First(law), First(own)) => law.has_couple(own),
            (Second(law), Second(own)) => law.has_couple(own),
            _ => true,
        }
    }
}

impl<A, B> ImpulseLaw for EitherLaw<A, B>
where
    A: ImpulseLaw,
    B: ImpulseLaw,
{
    #[inline]
    fn restitution(&self, coefficients: &Self::Coefficients, approach_speed: f64) -> f64 {
        match (self, coefficients) {
            (First(law), First(own)) => law.restitution(own, approach_speed),
            (Second(law), Second(own)) => law.restitution(own, approach_speed),
            _ => NONE,
        }
    }

    #[inline]
    fn friction(&self, coefficients: &Self::Coefficients) -> f64 {
        match (self, coefficients) {
            (First(law), First(own)) => law.friction(own),
            (Second(law), Second(own)) => law.friction(own),
            _ => NONE,
        }
    }

    #[inline]
    fn rolling_arm(&self, coefficients: &Self::Coefficients) -> f64 {
        match (self, coefficients) {
            (First(law), First(own)) => law.rolling_arm(own),
            (Second(law), Second(own)) => law.rolling_arm(own),
            _ => NONE,
        }
    }

    fn solver(&self) -> SolverParameters {
        match self {
            First(law) => law.solver(),
            Second(law) => law.solver(),
        }
    }
}
