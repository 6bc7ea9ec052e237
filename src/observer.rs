//! Observers: what watches a step from outside.

use crate::contact::{Contact, ContactForce};
use crate::damper::Partner;

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
    /// The contact at the end of the step; for an impulse law, at the start, when it is struck.
    pub contact: Contact,
    /// The force on the particle.
    pub force: ContactForce,
}

/// Watches steps from outside. `()` watches nothing and costs nothing; a pair `(A, B)` is both.
///
/// # Using
/// Pass one to [`Damper::step_watched`](crate::Damper::step_watched).
///
/// # Implementing
/// 1. [`wants_contacts`](Self::wants_contacts) is constant over a step. Only if it is true,
/// 2. [`contact`](Self::contact) is called once per accepted step for each touching contact, in
///    canonical order.
pub trait Observer {
    /// Whether contacts are to be reported.
    fn wants_contacts(&self) -> bool {
        false
    }

    /// A contact of the step.
    fn contact(&mut self, _event: &ContactEvent) {}
}

impl Observer for () {}

impl<O: Observer + ?Sized> Observer for &mut O {
    fn wants_contacts(&self) -> bool {
        (**self).wants_contacts()
    }

    fn contact(&mut self, event: &ContactEvent) {
        (**self).contact(event);
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
}
