//! The plane z = 0 and space: what a vector, a tangent and a spin are in each.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Mul, Sub, SubAssign};

use glam::{DMat3, DVec2, DVec3};

mod plane;
mod volume;

pub(crate) use plane::Plane;
pub(crate) use volume::Volume;

/// What adds up and is multiplied by numbers.
pub(crate) trait Linear:
    Copy
    + Default
    + Debug
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + SubAssign
    + Mul<f64, Output = Self>
    + Send
    + Sync
{
}

impl Linear for f64 {}
impl Linear for DVec2 {}
impl Linear for DVec3 {}

/// Where bodies move.
pub(crate) trait Space: Copy + Debug + Default + Send + Sync + 'static {
    /// Whether it is the plane.
    const PLANAR: bool;
    /// How many numbers make a vector.
    const WIDTH: usize;
    /// Velocities, directions, forces.
    type Vector: Linear;
    /// What lies in the tangent plane of a contact: slip, friction.
    type Tangent: Linear;
    /// Rotation.
    type Spin: Linear;
    /// A vector, and a spin, in a column of numbers.
    type Row: Copy;
    type SpinRow: Copy;

    fn rows(column: &[f64]) -> &[Self::Row];
    fn rows_mut(column: &mut [f64]) -> &mut [Self::Row];
    fn spin_rows(column: &[f64]) -> &[Self::SpinRow];
    fn spin_rows_mut(column: &mut [f64]) -> &mut [Self::SpinRow];
    fn from_row(row: Self::Row) -> Self::Vector;
    fn row(vector: Self::Vector) -> Self::Row;
    fn from_spin_row(row: Self::SpinRow) -> Self::Spin;
    fn spin_row(spin: Self::Spin) -> Self::SpinRow;

    fn vector(vector: DVec3) -> Self::Vector;
    fn in_space(vector: Self::Vector) -> DVec3;
    fn spin(spin: DVec3) -> Self::Spin;
    fn spin_in_space(spin: Self::Spin) -> DVec3;

    /// A vector as it is here, in space: the compiler sees what is always zero.
    #[inline(always)]
    fn flattened(vector: DVec3) -> DVec3 {
        Self::in_space(Self::vector(vector))
    }
    /// A spin, likewise.
    #[inline(always)]
    fn flattened_spin(spin: DVec3) -> DVec3 {
        Self::spin_in_space(Self::spin(spin))
    }

    /// Turns forces and torques, in place, into accelerations: multiplies them by the inverses of mass and
    /// moment of inertia, and adds `gravity` (m/s^2). Returns whether all are finite.
    fn accelerate(
        forces: &mut [Self::Row],
        torques: &mut [Self::SpinRow],
        inverses: [&[f64]; 2],
        gravity: DVec3,
    ) -> bool;

    fn dot(a: Self::Vector, b: Self::Vector) -> f64;
    fn spin_dot(a: Self::Spin, b: Self::Spin) -> f64;
    fn transform(matrix: &DMat3, vector: Self::Vector) -> Self::Vector;
    /// Vector product of a spin and a vector: velocity at an arm.
    fn swing(spin: Self::Spin, arm: Self::Vector) -> Self::Vector;
    /// Vector product of an arm and a force: the torque of the force.
    fn moment(arm: Self::Vector, force: Self::Vector) -> Self::Spin;
    /// Tangential part of `velocity` - `turning` x `normal`, where `along` is the part of `velocity` along
    /// the normal.
    fn slip(
        normal: Self::Vector,
        velocity: Self::Vector,
        along: f64,
        turning: Self::Spin,
    ) -> Self::Tangent;
    /// Tangential part of a vector.
    fn tangent(normal: Self::Vector, vector: Self::Vector) -> Self::Tangent;
    /// A tangent as a vector.
    fn across(normal: Self::Vector, tangent: Self::Tangent) -> Self::Vector;
    /// Vector product of a tangent and the normal.
    fn turn(normal: Self::Vector, tangent: Self::Tangent) -> Self::Spin;
    /// A tangent, cut down to a length (not negative).
    fn shorten(tangent: Self::Tangent, length: f64) -> Self::Tangent;
    /// A spin, likewise.
    fn shorten_spin(spin: Self::Spin, length: f64) -> Self::Spin;
}
