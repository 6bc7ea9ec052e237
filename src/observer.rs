//! Observers: what watches a step from outside.

use glam::DVec3;

use crate::contact::{Contact, ContactForce, Partner, Stored};

mod complex_power;
mod energy;
mod events;
mod extremes;
mod harmonics;
mod regime;
mod step_report;
mod walls;

pub use complex_power::{ComplexPower, Phasor};
pub use energy::{Account, Energies, EnergyLedger, Losses};
pub use events::{EventLog, LoggedContact};
pub use extremes::Extremes;
pub use harmonics::Harmonics;
pub use regime::BedRegime;
pub(crate) use step_report::Observable;
pub use step_report::StepReport;
pub use walls::{WallRecord, WallRecorder};

/// A contact of an accepted step, as an observer sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ContactEvent {
    /// Number of the first particle: the force is the one on it.
    pub particle: usize,
    /// What it touches.
    pub partner: Partner,
    /// Number of the cavity.
    pub cavity: usize,
    /// The contact: under a force law at the end of the step. Under an impulse law at its start, but with
    /// the normal where contacts are looked for, at its midpoint unless the
    /// [solver](crate::SolverParameters::prediction) is set otherwise; the overlap is along that normal, and
    /// negative if the bodies touch only within the step.
    pub contact: Contact,
    /// The force on the particle: under a force law that at the end of the step, under an impulse law the
    /// impulse over the time step, which holds over it.
    pub force: ContactForce,
    /// What the contact holds at the end of the step and can give back; nothing under an impulse law.
    pub stored: Stored,
    /// The relative surface velocity (m/s) that the force works on. Under an impulse law it is the mean of
    /// those at the start and at the end of the step: `force` times it times the time step is exactly the
    /// energy that the contact gives. Else it is the velocity of `contact`.
    pub working_velocity: DVec3,
    /// The angular velocity (rad/s) of the first body relative to the second that the couple works
    /// on, likewise.
    pub working_spin: DVec3,
}

/// Watches steps from outside. `()` watches nothing and costs nothing; a pair `(A, B)` is both.
///
/// # Using
/// Pass one to [`Damper::step_watched`](crate::Damper::step_watched). The crate has an
/// [`EnergyLedger`], [`Harmonics`], an [`EventLog`], a [`WallRecorder`], [`Extremes`] and [`BedRegime`].
///
/// # Implementing
/// 1. [`wants_contacts`](Self::wants_contacts) is constant over a step. Only if it is true,
/// 2. [`contact`](Self::contact) is called once per step for each contact, in an order that depends on the
///    state alone: under a force law for each that touches, under an impulse law for each that was given
///    an impulse. What the event holds under each kind is said at its fields.
/// 3. [`step`](Self::step) is called once at the end of each accepted step, after its contacts; a
///    [drive](crate::Damper::drive) of several steps calls it for each.
///
/// An observer never changes the trajectory. The height of the lowest particle:
/// ```
/// use particle_damper::{StepReport, Observer};
///
/// struct Lowest(f64);
///
/// impl Observer for Lowest {
///     fn step(&mut self, report: &StepReport<'_>) {
///         let heights = report.particles().map(|particle| particle.position.y);
///         self.0 = heights.fold(f64::INFINITY, f64::min);
///     }
/// }
/// ```
pub trait Observer {
    /// Whether contacts are to be reported.
    fn wants_contacts(&self) -> bool {
        false
    }

    /// A contact of the step.
    fn contact(&mut self, _event: &ContactEvent) {}

    /// The end of a step.
    fn step(&mut self, _report: &StepReport<'_>) {}
}

impl Observer for () {}

impl<O: Observer + ?Sized> Observer for &mut O {
    fn wants_contacts(&self) -> bool {
        (**self).wants_contacts()
    }

    fn contact(&mut self, event: &ContactEvent) {
        (**self).contact(event);
    }

    fn step(&mut self, report: &StepReport<'_>) {
        (**self).step(report);
    }
}

impl<A: Observer, B: Observer> Observer for (A, B) {
    fn wants_contacts(&self) -> bool {
        self.0.wants_contacts() || self.1.wants_contacts()
    }

    fn contact(&mut self, event: &ContactEvent) {
        if self.0.wants_contacts() {
            self.0.contact(event);
        }
        if self.1.wants_contacts() {
            self.1.contact(event);
        }
    }

    fn step(&mut self, report: &StepReport<'_>) {
        self.0.step(report);
        self.1.step(report);
    }
}
