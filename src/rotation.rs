//! Rotations as rotation vectors: the axis, as long as the angle (rad).

use glam::{DQuat, DVec3};

/// Squares of angles below which series serve: there, the terms that they leave out are below 1e-15 of the
/// whole, and above it, what cancels in the closed forms costs no more than 1e-12.
const SMALL: f64 = 1e-3;

/// The rotation by a vector.
pub(crate) fn exp(vector: DVec3) -> DQuat {
    let square = vector.length_squared();
    let (share, cosine) = if square < SMALL {
        let share = 0.5 - square * (1.0 / 48.0 - square * (1.0 / 3840.0 - square / 645_120.0));
        (share, libm::cos(0.5 * square.sqrt()))
    } else {
        let angle = square.sqrt();
        (libm::sin(0.5 * angle) / angle, libm::cos(0.5 * angle))
    };
    let DVec3 { x, y, z } = vector * share;
    DQuat::from_xyzw(x, y, z, cosine)
}

/// The vector of a rotation, no longer than pi.
pub(crate) fn log(rotation: DQuat) -> DVec3 {
    let axis = DVec3::new(rotation.x, rotation.y, rotation.z);
    let (axis, cosine) = if rotation.w < 0.0 {
        (-axis, -rotation.w)
    } else {
        (axis, rotation.w)
    };
    let sine = axis.length();
    if sine > 0.0 {
        axis * (2.0 * libm::atan2(sine, cosine) / sine)
    } else {
        DVec3::ZERO
    }
}

/// Angular velocity of the rotation by `vector`, which changes at `rate`: the left Jacobian of
/// [`exp`].
pub(crate) fn angular_velocity(vector: DVec3, rate: DVec3) -> DVec3 {
    let square = vector.length_squared();
    let [first, second] = if square < SMALL {
        [
            0.5 - square * (1.0 / 24.0 - square / 720.0),
            1.0 / 6.0 - square * (1.0 / 120.0 - square / 5040.0),
        ]
    } else {
        let angle = square.sqrt();
        [
            (1.0 - libm::cos(angle)) / square,
            (angle - libm::sin(angle)) / (square * angle),
        ]
    };
    let across = vector.cross(rate);
    rate + across * first + vector.cross(across) * second
}

/// The rate at which `vector` has to change for the rotation by it to have the angular velocity
/// `turning`: the inverse of [`angular_velocity`].
pub(crate) fn rate(vector: DVec3, turning: DVec3) -> DVec3 {
    let square = vector.length_squared();
    let second = if square < SMALL {
        1.0 / 12.0 + square * (1.0 / 720.0 + square / 30_240.0)
    } else {
        let half = 0.5 * square.sqrt();
        (1.0 - half * libm::cos(half) / libm::sin(half)) / square
    };
    let across = vector.cross(turning);
    turning - across * 0.5 + vector.cross(across) * second
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, dvec2, dvec3};
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn vectors_come_back_and_turn_as_glam_has_it(
            axis in prop::array::uniform3(-1.0..1.0_f64),
            angle in prop::sample::select(vec![0.0, 1e-9, 1e-4, 0.0316, 0.0317, 0.5, 3.0]),
            rate_of in prop::array::uniform3(-2.0..2.0_f64),
        ) {
            let vector = DVec3::from(axis).normalize_or(DVec3::X) * angle;
            let rotation = exp(vector);
            let known = DQuat::from_scaled_axis(vector);
            prop_assert!((rotation - known).length() < 1e-15);
            prop_assert!((log(rotation) - vector).length() < 1e-14);
            prop_assert!((log(-rotation) - vector).length() < 1e-14);

            let change = DVec3::from(rate_of);
            let turning = angular_velocity(vector, change);
            prop_assert!((rate(vector, turning) - change).length() < 1e-12);
            let h = 1e-5;
            let (before, after) = (exp(vector - change * h), exp(vector + change * h));
            let measured = log(after * before.conjugate()) / (2.0 * h);
            prop_assert!((measured - turning).length() < 1e-8, "{measured} {turning}");
        }
    }

    #[test]
    fn a_rotation_in_the_plane_has_nothing_else() {
        let rotation = exp(dvec3(0.0, 0.0, 2.0));
        assert_eq!(dvec2(rotation.x, rotation.y), DVec2::ZERO);
        let vector = log(rotation);
        assert_eq!(vector.truncate(), DVec2::ZERO);
        let turning = angular_velocity(vector, DVec3::Z * 3.0);
        assert_eq!(turning, DVec3::Z * 3.0);
        assert_eq!(rate(vector, turning), DVec3::Z * 3.0);
    }
}
