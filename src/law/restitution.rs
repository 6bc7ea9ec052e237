use super::{ContactLaw, Evaluation, LawError};
use crate::contact::{Bodies, Contact, ContactForce};
use crate::error::{Bound, ValueError};
use crate::material::Materials;

mod impulse;

pub use impulse::{RestingForce, RestitutionCoefficients};

/// A step moves a particle at the reference speed by at most this fraction of the smaller radius.
const TRAVEL: f64 = 0.2;

/// Bodies are struck ahead up to this multiple of the reference speed.
const TOP_SPEED: f64 = 5.0;

/// The restitution coefficient turned into a force over one step (the paper's Sec. 4.3), for any
/// masses: the coarse law.
///
/// Two bodies that touch and approach at speed v are given the impulse J = m* (1 + e) v along the
/// normal (Eqs 10 and 11, where the wall yields as its mount does), as the force J/dt held over the
/// step (Eq. 12). As it stands in the paper the law lets resting particles sink, by g dt/(1 + e) in
/// velocity and layer, until they leave through the floor. The default form differs in this:
///
/// - Bodies are struck when they will touch within (1 + e)/2 of a step. Over the step of an impact they
///   come closer by (1 - e)/2 of what they would without, so that no impact of two bodies makes an
///   overlap of more than (1 - e) v dt.
/// - Contacts are struck one after the other, to and fro, each with the velocities that those before
///   it left.
/// - At a wall the impulse also takes up what gravity and the container's motion add over the step, so
///   that a resting particle rests.
/// - The bodies part at e times the approach speed v or e times the speed that would have made their
///   overlap within one step, whichever is larger, but at no more than v: no impact gains energy.
/// - Slow contacts rest. What a particle gains in free fall over the step, w = |g - a| dt under gravity g
///   in a container of acceleration a, and what the contact would gain if it were not borne, F dt/m*
///   with the force F that it bears at rest, make bodies approach that lie on each other: up to
///   v0 = 2 (w + F dt/m*) nothing rebounds, from 2 v0 on everything, and in between e is multiplied by
///   2 (1 - v0/v). In free flight e is therefore exact above 4 w, 4 mm/s at steps of 0.1 ms under gravity,
///   and at all speeds without it.
/// - A resting contact starts the step from the force that it bore in the last, as far as it takes
///   energy from the bed, and gives back what is too much: a pile at rest does not move at all. It is
///   trusted to bear twice what it was in the step before, and its own weight, so that an impact is
///   not taken for rest, and half of a change is believed per step. Overlaps beyond 3 % of the radius
///   are given back by a tenth per step, at w/5 at the most, and those beyond 5 % at v - w.
/// - Coulomb friction: the tangential impulse ends the slip if it can, and is mu J otherwise; it
///   turns the particles. Where the materials resist rolling, a couple of at most `mu_r r* J` does so;
///   the two are found together, so that what they can hold rests.
///
/// [`literal`](Self::literal) is the paper's form.
#[derive(Debug, Clone, PartialEq)]
pub struct RestitutionImpulse {
    materials: Materials,
    reference_speed: f64,
    friction: bool,
    literal: bool,
}

impl RestitutionImpulse {
    /// The law for bodies of `materials`, in its default form.
    #[must_use]
    pub fn new(materials: impl Into<Materials>) -> Self {
        Self {
            materials: materials.into(),
            reference_speed: 1.0,
            friction: true,
            literal: false,
        }
    }

    /// Eqs (10) to (12) as they are printed: all contacts from the same velocities, no friction, no
    /// spin, and nothing to keep resting particles from sinking. It loses particles: build the damper
    /// with [`contained(false)`](crate::Builder::contained) and an infinite
    /// [`overlap_limit`](crate::Builder::overlap_limit).
    #[must_use]
    pub fn literal(materials: impl Into<Materials>) -> Self {
        Self {
            friction: false,
            literal: true,
            ..Self::new(materials)
        }
    }

    /// The same law with or without friction and the spin that comes of it.
    #[must_use]
    pub const fn friction(mut self, friction: bool) -> Self {
        self.friction = friction;
        self
    }

    /// The same law for relative speeds about `speed` (m/s; 1 unless set), which bounds the time step.
    ///
    /// # Errors
    /// If the speed is not positive and finite.
    pub fn reference_speed(mut self, speed: f64) -> Result<Self, ValueError> {
        self.reference_speed = Bound::Positive.check("reference speed (m/s)", speed)?;
        Ok(self)
    }
}

impl ContactLaw for RestitutionImpulse {
    type Coefficients = RestitutionCoefficients;
    type Memory = RestingForce;

    fn coefficients(&self, bodies: &Bodies) -> Result<Self::Coefficients, LawError> {
        let Bodies { first, second } = bodies;
        for material in [first.material, second.material] {
            self.materials
                .get(material)
                .ok_or(LawError::UnknownMaterial(material))?;
        }
        let interaction = self
            .materials
            .interaction(first.material, second.material)
            .ok_or(LawError::UnknownMaterial(second.material))?
            .checked()?;
        Ok(RestitutionCoefficients::new(
            bodies,
            &interaction,
            self.friction,
        ))
    }

    #[inline]
    fn force(
        &self,
        own: &Self::Coefficients,
        contact: &Contact,
        held: &RestingForce,
    ) -> ContactForce {
        if self.literal {
            own.literal(contact)
        } else {
            self.strike(own, contact, &mut { *held })
        }
    }

    #[inline(always)]
    fn carry(
        &self,
        own: &Self::Coefficients,
        contact: &Contact,
        held: &mut RestingForce,
        part: f64,
    ) -> ContactForce {
        own.carry(contact, held, part)
    }

    #[inline(always)]
    fn strike(
        &self,
        own: &Self::Coefficients,
        contact: &Contact,
        held: &mut RestingForce,
    ) -> ContactForce {
        if own.may_rest(contact, held) {
            own.rest(contact, held)
        } else {
            own.rebound(contact, held)
        }
    }

    fn evaluation(&self) -> Evaluation {
        if self.literal {
            Evaluation::Simultaneous
        } else {
            Evaluation::Sequential
        }
    }

    fn reach(&self, time_step: f64) -> f64 {
        if self.literal {
            0.0
        } else {
            TOP_SPEED * self.reference_speed * time_step
        }
    }

    fn tell_memory(&self, memory: &RestingForce, tell: &mut dyn FnMut(f64)) {
        memory.tell(tell);
    }

    fn design_speed(&self) -> f64 {
        self.reference_speed
    }

    fn time_step_limit(&self, own: &Self::Coefficients) -> f64 {
        TRAVEL * own.smaller_radius() / self.reference_speed
    }
}
