//! How what a contact remembers follows its bodies.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use glam::DVec3;

use crate::contact::Contact;

/// A vector that lay in the tangent plane when memory was advanced, in the tangent plane of now. It is laid
/// into the plane and stretched to the length that it had, which leaves its direction good to the first
/// order of the step; and it turns about the normal as the two bodies do on the mean.
#[inline(always)]
pub(super) fn turned(vector: DVec3, contact: &Contact) -> DVec3 {
    let normal = contact.normal;
    let off = vector.dot(normal);
    let flat = contact.flattened(vector - off * normal);
    // The root of 1 + (off/left)^2, its Pade approximant: a root and a quotient less.
    let (left, off) = (4.0 * flat.length_squared() + f64::MIN_POSITIVE, off * off);
    // Cayley's form of a turn: of the right length whatever the angle, of the angle to third order.
    let half = 0.25 * contact.elapsed * (contact.spins[0] + contact.spins[1]).dot(normal);
    let (along, across) = (1.0 - half * half, 2.0 * half);
    let whole = contact.flattened(flat * along + normal.cross(flat) * across);
    whole * ((left + 3.0 * off) / ((left + off) * (1.0 + half * half)))
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
            load = turned(load, &contact(dvec3(cosine, sine, 0.0), spin, dt));
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
            load = turned(load, &contact(DVec3::X, spin, dt));
        }
        assert!((load - DVec3::Z * 0.5).length() < 1e-6, "{load}");
        assert!((load.length() / 0.5 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_does_not_turn_keeps_its_bits() {
        let load = dvec3(0.0, 0.3, -0.17);
        assert_eq!(turned(load, &contact(DVec3::X, DVec3::Z, 1e-4)), load);
        assert_eq!(
            turned(DVec3::ZERO, &contact(DVec3::X, DVec3::X, 1e-4)),
            DVec3::ZERO
        );
    }
}
