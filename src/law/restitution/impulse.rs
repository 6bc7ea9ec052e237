//! What two bodies do to each other in one step.

use glam::DVec3;

use crate::contact::{Bodies, Contact, ContactForce};
use crate::material::Interaction;

/// Fraction of the overlap that a contact without restitution gives back per step.
const SETTLING: f64 = 0.02;

/// Bodies that approach by no more than so many times what they would gain in a step without the contact
/// may be at rest.
const REST: f64 = 2.0;

/// A contact is trusted to bear so many times what it was in the step before, and the weight of its
/// bodies.
const GROWTH: f64 = 2.0;

/// Part of what the load on a resting contact seems to have changed by that is believed in a step. With
/// all of it, what stopped a blow once would be carried on as a load, and a pile would swing for ever.
const BELIEF: f64 = 0.5;

/// Part of their overlap by which resting bodies part per step.
const LIFT: f64 = 0.1;

/// The speed at which they do so at the most, as a part of what they gain in a step of free fall. Faster,
/// bodies that have no room would be pushed to and fro.
const LIFT_SPEED: f64 = 0.2;

/// Overlap that resting bodies keep, as a part of the smaller radius.
const KEPT: f64 = 0.03;

/// Overlap, as a part of the smaller radius, beyond which bodies that come faster than one step of free
/// fall part by that much slower at the most: a bed that is pressed for long does not sink into itself.
const DEEP: f64 = 0.05;

/// What [`RestitutionImpulse`](crate::RestitutionImpulse) prepares for two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestitutionCoefficients {
    restitution: f64,
    friction: f64,
    /// Rolling friction coefficient times the effective radius, m.
    rolling_arm: f64,
    /// Relative velocity per unit impulse along the normal, but for what the mount of a wall yields,
    /// 1/kg.
    yielding: f64,
    /// The same across it, where spin adds to it, 1/kg.
    turning: f64,
    /// Whether the second body is a wall, which may yield.
    at_wall: bool,
    /// Sum of the inverse moments of inertia, 1/(kg m^2).
    inverse_inertia: f64,
    /// Relative spin per unit tangential impulse, and slip per unit angular impulse, in 1/(kg m).
    coupling: f64,
    smaller_radius: f64,
}

/// The force that holds bodies at rest on each other under
/// [`RestitutionImpulse`](crate::RestitutionImpulse): what a contact remembers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RestingForce {
    /// Along the normal, in N.
    normal: f64,
    /// Across it, in N.
    tangential: DVec3,
    /// The couple of rolling resistance, in N m.
    couple: DVec3,
    /// What the contact has borne along the normal in this step besides, rebounds apart, in N.
    borne: f64,
    /// The acceleration that made it bear so much: of free fall in the container's frame, in m/s^2.
    weight: f64,
    /// What it is trusted to bear at rest, in N.
    bearing: f64,
}

impl RestingForce {
    /// Tells every number.
    pub(super) fn tell(&self, tell: &mut dyn FnMut(f64)) {
        let vectors = [self.tangential, self.couple].map(|vector| vector.to_array());
        let numbers = [self.normal, self.borne, self.weight, self.bearing];
        vectors.into_iter().flatten().chain(numbers).for_each(tell);
    }
}

/// Inverse moment of inertia of a solid sphere, 1/(kg m^2); zero for a wall.
fn inverse_inertia(radius: f64, mass: f64) -> f64 {
    2.5 / (mass * radius * radius)
}

impl RestingForce {
    const fn set(&mut self, force: &ContactForce) {
        self.normal = force.normal;
        self.tangential = force.tangential;
        self.couple = force.couple;
    }

    const fn force(&self) -> ContactForce {
        ContactForce {
            normal: self.normal,
            tangential: self.tangential,
            couple: self.couple,
        }
    }
}

impl RestitutionCoefficients {
    pub(super) fn new(bodies: &Bodies, interaction: &Interaction, slides: bool) -> Self {
        let Bodies { first, second } = bodies;
        let slides = f64::from(slides);
        Self {
            restitution: interaction.restitution,
            friction: slides * interaction.friction,
            rolling_arm: slides * interaction.rolling_friction * bodies.effective_radius(),
            yielding: 1.0 / first.mass + 1.0 / second.mass,
            turning: 3.5 / first.mass + 3.5 / second.mass,
            at_wall: bodies.at_wall(),
            inverse_inertia: inverse_inertia(first.radius, first.mass)
                + inverse_inertia(second.radius, second.mass),
            coupling: 2.5 / (first.mass * first.radius) - 2.5 / (second.mass * second.radius),
            smaller_radius: first.radius.min(second.radius),
        }
    }

    pub(super) const fn smaller_radius(&self) -> f64 {
        self.smaller_radius
    }

    /// Relative velocity per unit impulse along the normal, 1/kg.
    #[inline(always)]
    fn yielding(&self, contact: &Contact) -> f64 {
        if self.at_wall {
            self.yielding + contact.normal.dot(contact.mobility * contact.normal)
        } else {
            self.yielding
        }
    }

    /// Relative surface velocity per unit impulse across the normal, along `slip`, 1/kg.
    #[inline(always)]
    fn turning(&self, contact: &Contact, slip: DVec3) -> f64 {
        if self.at_wall {
            let along = slip.dot(contact.mobility * slip);
            self.turning + along / slip.length_squared().max(f64::MIN_POSITIVE)
        } else {
            self.turning
        }
    }

    /// How long before they touch bodies are struck, s.
    #[inline]
    fn early(&self, contact: &Contact) -> f64 {
        0.5 * (1.0 + self.restitution) * contact.elapsed
    }

    /// Eqs (10) to (12).
    pub(super) fn literal(&self, contact: &Contact) -> ContactForce {
        let approach = contact.approach_speed().max(0.0);
        let impulse = (1.0 + self.restitution) * approach / self.yielding(contact);
        ContactForce::new(impulse / contact.elapsed, DVec3::ZERO)
    }

    /// Whether bodies approach so slowly that they may be at rest.
    #[inline]
    pub(super) fn may_rest(&self, contact: &Contact, held: &RestingForce) -> bool {
        let approach = contact.approach_speed();
        approach <= REST * contact.fall
            || held.bearing > 0.0 && approach <= self.slow(contact, held)
    }

    /// The approach speed up to which bodies may be at rest, m/s.
    #[inline]
    fn slow(&self, contact: &Contact, held: &RestingForce) -> f64 {
        if held.bearing == 0.0 {
            return REST * contact.fall;
        }
        let load = held.bearing * contact.elapsed * self.yielding(contact);
        REST * (contact.fall + load)
    }

    /// An impact.
    #[inline(always)]
    pub(super) fn rebound(&self, contact: &Contact, held: &mut RestingForce) -> ContactForce {
        let normal = contact.normal;
        let approach = contact.approach_speed();
        let ahead = -contact.velocity_ahead.dot(normal);
        if ahead <= 0.0 || contact.overlap < -self.early(contact) * approach.max(ahead) {
            return ContactForce::default();
        }
        let elastic = approach.min(2.0 * (approach - self.slow(contact, held)));
        let rebound = self.restitution * elastic.max(0.0);
        // A completely inelastic impact leaves no speed: the half step that it may come late does not
        // count as sunk, and only what presses on is lifted, by no more than it presses.
        let rate = 1.0 / contact.elapsed;
        let sunk = (contact.overlap * rate - 0.5 * approach.max(0.0)).max(0.0);
        let lifting = (SETTLING * sunk).min(ahead);
        let parting = self.restitution * contact.overlap.max(0.0) * rate;
        let correction = parting.min(approach).max(lifting);
        let force = rate / self.yielding(contact);
        held.borne += ahead * force;
        held.weight = contact.fall * rate;
        let pressing = (ahead + rebound.max(correction)) * force;
        let slip = contact.velocity_ahead + ahead * normal;
        self.hold(contact, pressing, slip, &ContactForce::default())
    }

    /// What bodies at rest on each other, which give each other `held` so far, add to it: what ends
    /// their approach and slip, as far as the sum pushes and is within reach of friction.
    #[inline(always)]
    pub(super) fn rest(&self, contact: &Contact, held: &mut RestingForce) -> ContactForce {
        let before = held.force();
        let ahead = -contact.velocity_ahead.dot(contact.normal);
        if before.normal == 0.0 {
            let nearing = contact.approach_speed().max(ahead).max(0.0);
            if contact.overlap < -self.early(contact) * nearing {
                return ContactForce::default();
            }
        }
        let sunk = contact.overlap - KEPT * self.smaller_radius;
        let lift = if sunk > 0.0 {
            let deep = sunk - (DEEP - KEPT) * self.smaller_radius;
            let rate = LIFT / contact.elapsed;
            let slow = (rate * sunk).min(LIFT_SPEED * contact.fall);
            slow.max((ahead - contact.fall).min(rate * deep))
        } else {
            0.0
        };
        let rate = 1.0 / contact.elapsed;
        let normal = before.normal + (ahead + lift) * (rate / self.yielding(contact));
        if normal <= 0.0 {
            held.set(&ContactForce::default());
        } else {
            let slip = contact.velocity_ahead + ahead * contact.normal;
            held.set(&self.hold(contact, normal, slip, &before));
            held.weight = contact.fall * rate;
        }
        ContactForce {
            normal: held.normal - before.normal,
            tangential: held.tangential - before.tangential,
            couple: held.couple - before.couple,
        }
    }

    /// Part of what bodies gave each other in the step before, if they are still at rest.
    #[inline(always)]
    pub(super) fn carry(
        &self,
        contact: &Contact,
        held: &mut RestingForce,
        part: f64,
    ) -> ContactForce {
        if part < 1.0 {
            held.normal *= part;
            held.tangential *= part;
            held.couple *= part;
            return held.force();
        }
        // What parts faster than it may approach at rest, or stands farther off than a step of free fall
        // explains, is not at rest.
        let gap = self.early(contact) * REST * contact.fall;
        if contact.approach_speed() < -self.slow(contact, held) || contact.overlap < -gap {
            return ContactForce::default();
        }
        let weight = contact.fall / contact.elapsed;
        let change = if held.weight > 0.0 {
            weight / held.weight
        } else {
            0.0
        };
        let borne = change * (held.borne + held.normal);
        let own = weight / self.yielding(contact);
        let before = change * held.bearing;
        let load = borne.min(GROWTH * before + own);
        held.bearing = before + BELIEF * (load - before);
        held.borne = 0.0;
        held.weight = weight;
        held.tangential *= change;
        held.couple *= change;
        held.normal = held.bearing;
        let across = held.tangential - held.tangential.dot(contact.normal) * contact.normal;
        held.tangential = cut(across, self.friction * held.normal);
        held.couple = cut(held.couple, self.rolling_arm * held.normal);
        held.force()
    }

    /// The force that presses with `normal` (N) and adds to `before` what ends `slip`, and rolling where
    /// the bodies resist it, as far as friction and rolling resistance reach.
    #[inline(always)]
    fn hold(
        &self,
        contact: &Contact,
        normal: f64,
        slip: DVec3,
        before: &ContactForce,
    ) -> ContactForce {
        let mut force = ContactForce::new(normal, DVec3::ZERO);
        let turning = self.turning(contact, slip) * contact.elapsed;
        if self.rolling_arm > 0.0 {
            let [tangential, couple] = self.roll(contact, [normal, turning], slip, before);
            force.tangential = tangential;
            force.couple = couple;
        } else if self.friction > 0.0 {
            let sticking = before.tangential - slip * (1.0 / turning);
            force.tangential = cut(sticking, self.friction * normal);
        }
        force
    }

    /// Tangential force and couple, `before` included, that end slip and rolling (relative spin)
    /// together, as far as friction and rolling resistance reach under the force `normal` (N).
    /// `turning` is slip per unit tangential force over the step in m/s/N.
    #[inline(always)]
    fn roll(
        &self,
        contact: &Contact,
        [normal, turning]: [f64; 2],
        slip: DVec3,
        before: &ContactForce,
    ) -> [DVec3; 2] {
        let (across, along) = (self.friction * normal, self.rolling_arm * normal);
        let dt = contact.elapsed;
        let (coupling, inverse_inertia) = (self.coupling * dt, self.inverse_inertia * dt);
        // Spins and couples turned into the tangent plane: a quarter turn about the normal.
        let rolling = (contact.spins[0] - contact.spins[1]).cross(contact.normal);
        let turned = before.couple.cross(contact.normal);
        let determinant = turning * inverse_inertia - coupling * coupling;
        let stop = turned - (slip * coupling + rolling * turning) / determinant;
        let mut turn = cut(stop, along);
        let mut push = before.tangential + ((turn - turned) * coupling - slip) / turning;
        if push.length_squared() > across * across {
            push = cut(push, across);
            let given = push - before.tangential;
            turn = cut(
                turned + (given * coupling - rolling) / inverse_inertia,
                along,
            );
        }
        [push, contact.normal.cross(turn)]
    }
}

/// `vector`, cut down to `length` (not negative).
#[inline(always)]
fn cut(vector: DVec3, length: f64) -> DVec3 {
    let square = vector.length_squared();
    if square > length * length {
        vector * (length / square.sqrt())
    } else {
        vector
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::contact::Body;
    use crate::material::Materials;

    const STEP: f64 = 1e-4;
    const FALL: f64 = 9.81 * STEP;

    fn at_wall(restitution: f64) -> RestitutionCoefficients {
        let sphere = Body::sphere(3e-3, 2e-4, Materials::FIRST);
        let bodies = Bodies::new(sphere, Body::wall(Materials::FIRST));
        let interaction = Interaction::new(restitution, 0.2).unwrap();
        RestitutionCoefficients::new(&bodies, &interaction, true)
    }

    /// A sphere that comes down on a floor under gravity.
    fn falling(speed: f64) -> Contact {
        let mut contact = Contact::new(DVec3::Y, 0.0, DVec3::NEG_Y * speed);
        contact.velocity_ahead = DVec3::NEG_Y * (speed + FALL);
        contact.fall = FALL;
        contact.elapsed = STEP;
        contact
    }

    /// Speed over approach speed after the step.
    fn rebound(own: &RestitutionCoefficients, speed: f64) -> f64 {
        let (contact, mut held) = (falling(speed), RestingForce::default());
        let force = if own.may_rest(&contact, &held) {
            own.rest(&contact, &mut held)
        } else {
            own.rebound(&contact, &mut held)
        };
        (force.normal * STEP / 2e-4 - speed - FALL) / speed
    }

    #[test]
    fn the_restitution_is_that_asked_for_from_four_times_the_fall_in_a_step() {
        let own = at_wall(0.75);
        for times in [4.0, 5.0, 100.0, 1000.0] {
            assert_relative_eq!(rebound(&own, times * FALL), 0.75, epsilon = 1e-12);
        }
        for times in [0.1, 1.0, 2.0] {
            assert!(rebound(&own, times * FALL).abs() < 1e-12);
        }
        assert_relative_eq!(rebound(&own, 3.0 * FALL), 0.5, epsilon = 1e-12);
    }

    /// What a contact at rest remembers, and its force in N.
    fn at_rest(own: &RestitutionCoefficients) -> (RestingForce, ContactForce) {
        let (contact, mut held) = (falling(0.0), RestingForce::default());
        own.rest(&contact, &mut held);
        for _ in 0..60 {
            let carried = own.carry(&contact, &mut held, 1.0);
            let mut after = contact;
            after.velocity_ahead += DVec3::Y * (carried.normal * STEP / 2e-4);
            own.rest(&after, &mut held);
        }
        let force = held.force();
        (held, force)
    }

    #[test]
    fn a_body_at_rest_is_carried_and_given_nothing_more() {
        let own = at_wall(0.75);
        let (mut held, weight) = at_rest(&own);
        assert_relative_eq!(weight.normal, 2e-4 * 9.81, epsilon = 1e-15);
        let contact = falling(0.0);
        let carried = own.carry(&contact, &mut held, 1.0);
        assert_relative_eq!(carried.normal, weight.normal, epsilon = 1e-15);
        let mut after = contact;
        after.velocity += DVec3::Y * FALL;
        after.velocity_ahead += DVec3::Y * FALL;
        assert!(own.rest(&after, &mut held).normal.abs() < 1e-15);
    }

    #[test]
    fn a_floor_that_falls_away_takes_back_what_was_carried() {
        let own = at_wall(0.75);
        let (mut held, _) = at_rest(&own);
        let mut contact = falling(0.0);
        contact.velocity = DVec3::Y * FALL;
        contact.velocity_ahead = DVec3::Y * 3.0 * FALL;
        let carried = own.carry(&contact, &mut held, 1.0);
        assert!(carried.normal > 0.0);
        let taken = own.rest(&contact, &mut held);
        assert_relative_eq!(taken.normal, -carried.normal);
    }

    #[test]
    fn bodies_apart_carry_nothing() {
        let own = at_wall(0.75);
        let (mut held, _) = at_rest(&own);
        let mut contact = falling(0.0);
        contact.overlap = -2.0 * FALL * STEP;
        assert_eq!(own.carry(&contact, &mut held, 1.0), ContactForce::default());
    }

    #[test]
    fn an_impact_is_not_taken_for_rest() {
        let own = at_wall(0.0);
        let mut held = RestingForce::default();
        own.rebound(&falling(1.0), &mut held);
        let carried = own.carry(&falling(0.0), &mut held, 1.0);
        assert_relative_eq!(carried.normal, 0.5 * 2e-4 * 9.81, epsilon = 1e-12);
    }
}
