//! Snapshots whose type does not tell what contacts remember.

use std::any::Any;
use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

use super::{RestoreError, Snapshot};
use crate::damper::Damper;
use crate::law::{ContactLaw, ContactMemory};

#[cfg(feature = "serde")]
mod written;

/// A [`Snapshot`] of a damper of any make: what [`DrivenDamper`](crate::DrivenDamper) takes and goes back to.
///
/// With the feature `serde` it can be written and read like a [`Snapshot`], whatever the damper's law, so
/// that a host puts the snapshots of unlike dampers into one file. What contacts remember is then written as
/// the numbers that the law [tells](crate::ForceLaw::tell_memory), and had back
/// [from them](crate::ForceLaw::recall_memory). Writing fails under a law that remembers something and
/// cannot do both to the bit; the crate's own laws can.
///
/// ```
/// use particle_damper::{
///     AnySnapshot, Cuboid, Damper, DrivenDamper, HertzTsuji, Material, RestitutionImpulse, Slot, glam::DVec3,
/// };
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let soft = RestitutionImpulse::new(Material::acrylic());
/// let stiff = HertzTsuji::new(Material::acrylic());
/// let mut dampers: Vec<Box<dyn DrivenDamper>> = vec![
///     Box::new(Damper::builder(Cuboid::new(DVec3::splat(0.04))?, soft).time_step(1e-4).build()?),
///     Box::new(Damper::builder(Slot::paper(), stiff).time_step(1e-5).build()?),
/// ];
/// let snapshots: Vec<AnySnapshot> = dampers.iter_mut().map(|damper| damper.snapshot()).collect();
/// # #[cfg(feature = "serde")]
/// # let snapshots: Vec<AnySnapshot> = {
/// // With the feature `serde`, in one file:
/// let file = postcard::to_stdvec(&snapshots)?;
/// // and in another process, which has built the same dampers:
/// let snapshots: Vec<AnySnapshot> = postcard::from_bytes(&file)?;
/// # snapshots };
/// for (damper, snapshot) in dampers.iter_mut().zip(&snapshots) {
///     damper.restore(snapshot)?;
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Clone)]
pub struct AnySnapshot(Form);

#[derive(Clone)]
enum Form {
    Taken(Arc<dyn Taken>),
    #[cfg(feature = "serde")]
    Read(Arc<written::Written>),
}

/// A snapshot as it was taken, whatever contacts remember.
trait Taken: Any + Send + Sync {
    fn time(&self) -> f64;

    #[cfg(feature = "serde")]
    fn written(&self) -> Option<written::Written>;
}

/// A snapshot, and the memories in it as numbers if they can be had back.
struct Typed<Memory> {
    snapshot: Snapshot<Memory>,
    #[cfg(feature = "serde")]
    told: Option<Vec<f64>>,
}

impl<Memory: Send + Sync + 'static> Taken for Typed<Memory> {
    fn time(&self) -> f64 {
        self.snapshot.time()
    }

    #[cfg(feature = "serde")]
    fn written(&self) -> Option<written::Written> {
        Some(written::Written::new(&self.snapshot, self.told.clone()?))
    }
}

impl AnySnapshot {
    /// Keeps a snapshot of a damper under `law`.
    #[cfg_attr(not(feature = "serde"), allow(unused_variables))]
    pub(crate) fn new<L: ContactLaw>(snapshot: Snapshot<ContactMemory<L>>, law: &L) -> Self
    where
        ContactMemory<L>: 'static,
    {
        Self(Form::Taken(Arc::new(Typed {
            #[cfg(feature = "serde")]
            told: written::told(&snapshot, law),
            snapshot,
        })))
    }

    /// Simulated time in s.
    #[must_use]
    pub fn time(&self) -> f64 {
        match &self.0 {
            Form::Taken(taken) => taken.time(),
            #[cfg(feature = "serde")]
            Form::Read(written) => written.time(),
        }
    }

    /// The snapshot, with what contacts of `damper` remember.
    #[cfg_attr(not(feature = "serde"), allow(unused_variables))]
    pub(crate) fn typed<C, L: ContactLaw, M, D, I>(
        &self,
        damper: &Damper<C, L, M, D, I>,
    ) -> Result<Cow<'_, Snapshot<ContactMemory<L>>>, RestoreError>
    where
        ContactMemory<L>: 'static,
    {
        match &self.0 {
            Form::Taken(taken) => {
                let taken: &dyn Any = &**taken;
                let own = taken.downcast_ref::<Typed<ContactMemory<L>>>();
                let own = own.ok_or(RestoreError::OtherSetup {
                    quantity: "contact law",
                })?;
                Ok(Cow::Borrowed(&own.snapshot))
            }
            #[cfg(feature = "serde")]
            Form::Read(written) => written.recalled(damper).map(Cow::Owned),
        }
    }
}

impl fmt::Debug for AnySnapshot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AnySnapshot")
            .field("time", &self.time())
            .finish_non_exhaustive()
    }
}
