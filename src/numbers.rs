//! Small functions of numbers.

use glam::DVec3;

/// The greater of two numbers, `least` if either is not one. One instruction where `f64::max` takes
/// five.
#[inline(always)]
pub(crate) const fn at_least(value: f64, least: f64) -> f64 {
    if value > least { value } else { least }
}

/// The lesser of two numbers, `most` if either is not one.
#[inline(always)]
pub(crate) const fn at_most(value: f64, most: f64) -> f64 {
    if value < most { value } else { most }
}

/// The vector that the next three numbers make; none if they are fewer.
pub(crate) fn vector(numbers: &mut dyn Iterator<Item = f64>) -> Option<DVec3> {
    Some(DVec3::new(
        numbers.next()?,
        numbers.next()?,
        numbers.next()?,
    ))
}
