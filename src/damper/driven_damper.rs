//! Dampers of unlike make behind one trait.

use super::snapshot::{AnySnapshot, RestoreError};
use super::{Damper, Reaction, Recorded};
use crate::cavity::Cavity;
use crate::detector::Detector;
use crate::integrator::Integrator;
use crate::law::{ContactLaw, ContactMemory};
use crate::mount::{Driven, Motion};
use crate::step_error::StepError;

/// A damper that a host drives, whatever it is made of: so that a host keeps dampers of unlike cavities and
/// laws in one list.
///
/// # Using
/// Every [`Damper`] on a [`Driven`] mount is one, and so is a [`Recorded`] one. What is asked of the trait is
/// what the methods of the same name give, to the bit.
///
/// ```
/// use particle_damper::glam::DVec3;
/// use particle_damper::{
///     Cuboid, Damper, DrivenDamper, HertzTsuji, Material, Motion, RestitutionImpulse, Slot,
/// };
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let soft = RestitutionImpulse::new(Material::acrylic());
/// let stiff = HertzTsuji::new(Material::acrylic());
/// let mut dampers: Vec<Box<dyn DrivenDamper>> = vec![
///     Box::new(Damper::builder(Cuboid::new(DVec3::splat(0.04))?, soft).time_step(1e-4).build()?),
///     Box::new(Damper::builder(Slot::paper(), stiff).time_step(1e-5).build()?),
/// ];
/// let end = Motion::at(DVec3::Y * 1e-4, DVec3::Y * 0.2);
/// for damper in &mut dampers {
///     let reaction = damper.drive(end, 1e-3)?;
///     assert_eq!(damper.reaction(), reaction);
/// }
/// # Ok(())
/// # }
/// ```
///
/// # Implementing
/// A wrapper around a damper forwards; it may add what it likes before and after.
pub trait DrivenDamper {
    /// As [`Damper::drive`].
    ///
    /// # Errors
    /// As [`Damper::drive`].
    fn drive(&mut self, end: Motion, interval: f64) -> Result<Reaction, StepError>;

    /// As [`Damper::drive_to`].
    ///
    /// # Errors
    /// As [`Damper::drive_to`].
    fn drive_to(&mut self, end: Motion, time: f64) -> Result<Reaction, StepError>;

    /// What the particles did to the container over the last drive.
    fn reaction(&self) -> Reaction;

    /// Position and velocity of the container.
    fn container(&self) -> Motion;

    /// Simulated time in s.
    fn time(&self) -> f64;

    /// The state of the damper.
    fn snapshot(&mut self) -> AnySnapshot;

    /// Puts the damper into the state of `snapshot`, from which it goes on to the same bits.
    ///
    /// # Errors
    /// As [`Damper::restore`]; also if the snapshot is of a damper whose contacts remember something else.
    fn restore(&mut self, snapshot: &AnySnapshot) -> Result<(), RestoreError>;
}

impl<C, L, D, I> DrivenDamper for Damper<C, L, Driven, D, I>
where
    C: Cavity,
    L: ContactLaw,
    ContactMemory<L>: 'static,
    D: Detector,
    I: Integrator,
{
    fn drive(&mut self, end: Motion, interval: f64) -> Result<Reaction, StepError> {
        Self::drive(self, end, interval)
    }

    fn drive_to(&mut self, end: Motion, time: f64) -> Result<Reaction, StepError> {
        Self::drive_to(self, end, time)
    }

    fn reaction(&self) -> Reaction {
        Self::reaction(self, 0).unwrap_or_default()
    }

    fn container(&self) -> Motion {
        Self::container(self, 0).unwrap_or_default()
    }

    fn time(&self) -> f64 {
        Self::time(self)
    }

    fn snapshot(&mut self) -> AnySnapshot {
        AnySnapshot::new(Self::snapshot(self), &self.engine.model.law)
    }

    fn restore(&mut self, snapshot: &AnySnapshot) -> Result<(), RestoreError> {
        let snapshot = snapshot.typed(self)?;
        Self::restore(self, &snapshot)
    }
}

impl<C, L, D, I> DrivenDamper for Recorded<C, L, D, I>
where
    C: Cavity,
    L: ContactLaw,
    ContactMemory<L>: 'static,
    D: Detector,
    I: Integrator,
{
    fn drive(&mut self, end: Motion, interval: f64) -> Result<Reaction, StepError> {
        Self::drive(self, end, interval)
    }

    fn drive_to(&mut self, end: Motion, time: f64) -> Result<Reaction, StepError> {
        Self::drive_to(self, end, time)
    }

    fn reaction(&self) -> Reaction {
        self.damper().reaction(0).unwrap_or_default()
    }

    fn container(&self) -> Motion {
        self.damper().container(0).unwrap_or_default()
    }

    fn time(&self) -> f64 {
        self.damper().time()
    }

    fn snapshot(&mut self) -> AnySnapshot {
        let snapshot = Self::snapshot(self);
        AnySnapshot::new(snapshot, &self.damper().engine.model.law)
    }

    fn restore(&mut self, snapshot: &AnySnapshot) -> Result<(), RestoreError> {
        let snapshot = snapshot.typed(self.damper())?;
        Self::restore(self, &snapshot)
    }
}
