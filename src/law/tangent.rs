//! What lies in the tangent plane of a contact: slip, and what friction remembers.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::ops::{Add, Mul};

use glam::DVec3;

use crate::contact::Contact;

/// A tangent of a contact: a vector across its normal. Where bodies move in the plane z = 0 it is one number,
/// the component along the normal turned by a quarter about z.
pub(super) trait Tangent: Copy + Add<Output = Self> + Mul<f64, Output = Self> {
    /// Tangential part of the velocity of a contact, in m/s.
    fn slip(contact: &Contact) -> Self;

    /// A tangent of when memory was advanced, as it has turned with the contact since.
    fn turned(self, contact: &Contact) -> Self;

    fn length(self) -> f64;

    /// The vector in space.
    fn in_space(self, contact: &Contact) -> DVec3;

    /// What is remembered of a tangent: in the plane the number is the z.
    fn from_memory(memory: DVec3) -> Self;

    /// What is remembered next, after `memory`.
    fn remembered(self, memory: DVec3) -> DVec3;
}

/// In space.
impl Tangent for DVec3 {
    #[inline(always)]
    fn slip(contact: &Contact) -> Self {
        contact.slip()
    }

    /// It is laid into the plane and stretched to the length that it had, which leaves its direction good to the
    /// first order of the step; and it turns about the normal as the two bodies do on the mean.
    #[inline(always)]
    fn turned(self, contact: &Contact) -> Self {
        let normal = contact.normal;
        let off = self.dot(normal);
        let flat = self - off * normal;
        // The angle to third order.
        let tangent = 0.5 * contact.elapsed * (contact.spins[0] + contact.spins[1]).dot(normal);
        let turned = flat + normal.cross(flat) * tangent;
        // The root of 1 + missing/square, by its Pade approximant: to a part in 1e15 where the contact turns
        // by 0.03 rad. What stood upright on the plane has no direction in it, and hardly any length then.
        let (square, off) = (tangent * tangent, off * off);
        let left = self.length_squared() - off;
        let before = left * (4.0 + square) + (3.0 * off + f64::MIN_POSITIVE);
        let after = left * (4.0 + 3.0 * square) + (off + f64::MIN_POSITIVE);
        turned * (before / after)
    }

    #[inline(always)]
    fn length(self) -> f64 {
        Self::length(self)
    }

    #[inline(always)]
    fn in_space(self, _: &Contact) -> DVec3 {
        self
    }

    #[inline(always)]
    fn from_memory(memory: DVec3) -> Self {
        memory
    }

    #[inline(always)]
    fn remembered(self, _: DVec3) -> DVec3 {
        self
    }
}

/// In the plane.
impl Tangent for f64 {
    #[inline(always)]
    fn slip(contact: &Contact) -> Self {
        let [normal, velocity] = [contact.normal, contact.velocity].map(DVec3::truncate);
        normal.perp_dot(velocity)
    }

    #[inline(always)]
    fn turned(self, _: &Contact) -> Self {
        self
    }

    #[inline(always)]
    fn length(self) -> f64 {
        self.abs()
    }

    #[inline(always)]
    fn in_space(self, contact: &Contact) -> DVec3 {
        (contact.normal.truncate().perp() * self).extend(0.0)
    }

    #[inline(always)]
    fn from_memory(memory: DVec3) -> Self {
        memory.z
    }

    /// What is zero is copied: constants would keep the compiler from answering several contacts at a time.
    #[inline(always)]
    fn remembered(self, memory: DVec3) -> DVec3 {
        DVec3 { z: self, ..memory }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, TAU};

    use glam::dvec3;

    use super::*;

    fn contact(normal: DVec3, spin: DVec3, elapsed: f64) -> Contact {
        let mut contact = Contact::new(normal, 1e-4, DVec3::ZERO);
        contact.spins = [spin; 2];
        contact.elapsed = elapsed;
        contact
    }

    /// The load of a pair that turned once had 0.9945 of its length.
    #[test]
    fn a_pair_that_turns_once_keeps_what_it_bears() {
        let (steps, dt) = (3600, 1e-4);
        let spin = DVec3::Z * (TAU / (f64::from(steps) * dt));
        let start = dvec3(0.0, 0.3, 0.4);
        let mut load = start;
        for step in 1..=steps {
            let (sine, cosine) = (spin.z * dt * f64::from(step)).sin_cos();
            load = load.turned(&contact(dvec3(cosine, sine, 0.0), spin, dt));
            assert!((load.length() / 0.5 - 1.0).abs() < 1e-12, "{step}: {load}");
        }
        // Its direction is good to the first order of the step.
        assert!((load - start).length() < 2e-3, "{load}");
    }

    /// What a pair bore stayed behind when it turned about the line of its centres.
    #[test]
    fn a_pair_that_turns_about_its_normal_takes_along_what_it_bears() {
        let (steps, dt) = (1000, 1e-4);
        let spin = DVec3::X * (FRAC_PI_2 / (f64::from(steps) * dt));
        let mut load = DVec3::Y * 0.5;
        for _ in 0..steps {
            load = load.turned(&contact(DVec3::X, spin, dt));
        }
        assert!((load - DVec3::Z * 0.5).length() < 1e-6, "{load}");
        assert!((load.length() / 0.5 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_does_not_turn_keeps_its_bits() {
        let load = dvec3(0.0, 0.3, -0.17);
        assert_eq!(load.turned(&contact(DVec3::X, DVec3::Z, 1e-4)), load);
        assert_eq!(
            DVec3::ZERO.turned(&contact(DVec3::X, DVec3::X, 1e-4)),
            DVec3::ZERO
        );
    }
}
