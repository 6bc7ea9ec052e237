use glam::DVec3;

use super::{ContactLaw, Evaluation, LawError};
use crate::contact::{Bodies, Contact, ContactForce};
use crate::error::{Bound, ValueError};
use crate::material::Materials;

/// A step moves a particle at the reference speed by at most this fraction of the smaller radius.
const TRAVEL: f64 = 0.2;

/// Fraction of the overlap that a contact without restitution gives back per step.
const SETTLING: f64 = 0.02;

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
/// - The bodies part at e times the approach speed or e times the speed that would have made their
///   overlap within one step, whichever is larger: resting particles come out of each other again,
///   and no impact gains energy by it.
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

/// What [`RestitutionImpulse`] prepares for two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestitutionCoefficients {
    restitution: f64,
    friction: f64,
    /// Rolling friction coefficient times the effective radius, m.
    rolling_arm: f64,
    /// 1/m of the first body, 1/kg.
    inverse_mass: f64,
    /// What spin adds to the inverse mass in the tangent plane, 1/kg.
    turning: f64,
    /// Sum of the inverse moments of inertia, 1/(kg m^2).
    inverse_inertia: f64,
    /// Relative spin per unit tangential impulse, and slip per unit angular impulse, in 1/(kg m).
    coupling: f64,
    smaller_radius: f64,
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

impl RestitutionCoefficients {
    /// Tangential and angular impulse that end slip and rolling together, as far as `impulse` (N s)
    /// along the normal lets friction and rolling resistance reach. `yielding` is slip per unit
    /// tangential impulse in 1/kg.
    fn roll(&self, contact: &Contact, slip: DVec3, yielding: f64, impulse: f64) -> [DVec3; 2] {
        let (across, along) = (self.friction * impulse, self.rolling_arm * impulse);
        let (normal, coupling) = (contact.normal, self.coupling);
        // Spins and couples turned into the tangent plane: a quarter turn about the normal.
        let rolling = (contact.spins[0] - contact.spins[1]).cross(normal);
        let determinant = yielding * self.inverse_inertia - coupling * coupling;
        let stop = -(slip * coupling + rolling * yielding) / determinant;
        let mut turn = stop.clamp_length_max(along);
        let mut push = (turn * coupling - slip) / yielding;
        if push.length() > across {
            push = push.clamp_length_max(across);
            turn = (push * coupling - rolling) / self.inverse_inertia;
            turn = turn.clamp_length_max(along);
        }
        [push, normal.cross(turn)]
    }
}

/// Inverse moment of inertia of a solid sphere, 1/(kg m^2); zero for a wall.
fn inverse_inertia(radius: f64, mass: f64) -> f64 {
    2.5 / (mass * radius * radius)
}

impl ContactLaw for RestitutionImpulse {
    type Coefficients = RestitutionCoefficients;
    type Memory = ();

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
        let slides = f64::from(self.friction);
        Ok(RestitutionCoefficients {
            restitution: interaction.restitution,
            friction: slides * interaction.friction,
            rolling_arm: slides * interaction.rolling_friction * bodies.effective_radius(),
            inverse_mass: 1.0 / first.mass,
            turning: 2.5 / first.mass + 2.5 / second.mass,
            inverse_inertia: inverse_inertia(first.radius, first.mass)
                + inverse_inertia(second.radius, second.mass),
            coupling: 2.5 / (first.mass * first.radius) - 2.5 / (second.mass * second.radius),
            smaller_radius: first.radius.min(second.radius),
        })
    }

    #[inline]
    fn force(&self, own: &Self::Coefficients, contact: &Contact, (): &()) -> ContactForce {
        let rate = 1.0 / contact.elapsed;
        let normal = contact.normal;
        let yielding = |along: DVec3| own.inverse_mass + along.dot(contact.mobility * along);
        let approach = contact.approach_speed();
        if self.literal {
            let impulse = (1.0 + own.restitution) * approach.max(0.0) / yielding(normal);
            return ContactForce::new(impulse * rate, DVec3::ZERO);
        }
        let ahead = -contact.velocity_ahead.dot(normal);
        let early = 0.5 * (1.0 + own.restitution) * contact.elapsed;
        if ahead <= 0.0 || contact.overlap < -early * approach.max(ahead) {
            return ContactForce::default();
        }
        let rebound = own.restitution * approach.max(0.0);
        // A completely inelastic impact leaves no speed: the half step that it may come late does not
        // count as sunk, and only what presses on is lifted, by no more than it presses.
        let sunk = (contact.overlap * rate - 0.5 * approach.max(0.0)).max(0.0);
        let lifting = (SETTLING * sunk).min(ahead);
        let correction = (own.restitution * contact.overlap.max(0.0) * rate).max(lifting);
        let impulse = (ahead + rebound.max(correction)) / yielding(normal);
        let mut force = ContactForce::new(impulse * rate, DVec3::ZERO);
        let slip = contact.velocity_ahead + ahead * normal;
        let speed = slip.length();
        if own.friction > 0.0 && speed > 0.0 {
            let direction = slip / speed;
            let sticking = speed / (yielding(direction) + own.turning);
            force.tangential = direction * (-rate * sticking.min(own.friction * impulse));
        }
        if own.rolling_arm > 0.0 {
            let direction = slip.try_normalize().unwrap_or_default();
            let yielding = yielding(direction) + own.turning;
            let [tangential, couple] = own.roll(contact, slip, yielding, impulse);
            force.tangential = tangential * rate;
            force.couple = couple * rate;
        }
        force
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

    fn time_step_limit(&self, own: &Self::Coefficients) -> f64 {
        TRAVEL * own.smaller_radius / self.reference_speed
    }
}
