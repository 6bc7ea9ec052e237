//! How two bodies meet and part: from positions to overlap and slip, from the answer of a law to forces
//! and torques.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use glam::DVec3;

use super::space::Space;
use crate::contact::{ContactForce, WallLoad};

/// Normal, and overlap in m, of two spheres whose centres are `towards` apart, from the second to the
/// first. Coincident centres have no normal and feel no force.
#[inline(always)]
pub(crate) fn normal_and_overlap<S: Space>(towards: DVec3, radii: [f64; 2]) -> (DVec3, f64) {
    let distance = towards.length();
    let inverse = 1.0 / (distance + f64::MIN_POSITIVE);
    let normal = S::flattened(towards * inverse);
    (normal, radii[0] + radii[1] - distance)
}

/// Distances of two centres from the point at which the bodies touch, m: in the middle of the overlap,
/// where bodies of one stiffness meet (Hertz). They sum to the distance of the centres, whatever the
/// overlap, so that friction keeps angular momentum.
#[inline(always)]
pub(crate) fn levers(radii: [f64; 2], overlap: f64) -> [f64; 2] {
    radii.map(|radius| radius - 0.5 * overlap)
}

/// Velocity of one surface relative to the other in m/s. `velocity` is that of the first centre
/// relative to the second body; a wall has no lever.
#[inline(always)]
pub(crate) fn surface_velocity<S: Space>(
    normal: DVec3,
    velocity: DVec3,
    spins: [DVec3; 2],
    levers: [f64; 2],
) -> DVec3 {
    let turning = spins[0] * levers[0] + spins[1] * levers[1];
    S::flattened(velocity - turning.cross(normal))
}

/// Force on the first of two bodies, and torques on both. Without `COUPLE` the answer has none.
#[inline(always)]
pub(crate) fn force_and_torques<S: Space, const COUPLE: bool>(
    normal: DVec3,
    levers: [f64; 2],
    answer: &ContactForce,
) -> (DVec3, [DVec3; 2]) {
    let tangential = S::flattened(answer.tangential);
    let turn = tangential.cross(normal);
    let [mut first, mut second] = levers.map(|lever| turn * lever);
    if COUPLE {
        first += answer.couple;
        second -= answer.couple;
    }
    (normal * answer.normal + tangential, [first, second])
}

/// Adds to the load on a wall the reaction to `push` on a particle, with the couple `couple` besides, at `arm`
/// from the container's origin.
#[inline(always)]
pub(crate) fn react<S: Space>(load: &mut WallLoad, push: DVec3, couple: DVec3, arm: S::Vector) {
    let push = S::vector(push);
    load.force = S::in_space(S::vector(load.force) - push);
    let torque = S::moment(arm, push) + S::spin(couple);
    load.torque = S::spin_in_space(S::spin(load.torque) - torque);
}
