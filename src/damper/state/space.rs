//! The plane z = 0 and space: what a vector, a tangent and a spin are in each.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Mul, Sub, SubAssign};

use glam::{DMat3, DVec2, DVec3};

use crate::law::{at_least, at_most};

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

    fn dot(a: Self::Vector, b: Self::Vector) -> f64;
    fn spin_dot(a: Self::Spin, b: Self::Spin) -> f64;
    fn transform(matrix: &DMat3, vector: Self::Vector) -> Self::Vector;
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

/// The plane z = 0. A tangent is the component along the normal turned by a quarter.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Plane;

impl Space for Plane {
    const WIDTH: usize = 2;
    type Vector = DVec2;
    type Tangent = f64;
    type Spin = f64;
    type Row = [f64; 2];
    type SpinRow = f64;

    #[inline(always)]
    fn rows(column: &[f64]) -> &[[f64; 2]] {
        column.as_chunks().0
    }

    #[inline(always)]
    fn rows_mut(column: &mut [f64]) -> &mut [[f64; 2]] {
        column.as_chunks_mut().0
    }

    #[inline(always)]
    fn spin_rows(column: &[f64]) -> &[f64] {
        column
    }

    #[inline(always)]
    fn spin_rows_mut(column: &mut [f64]) -> &mut [f64] {
        column
    }

    #[inline(always)]
    fn from_row(row: [f64; 2]) -> DVec2 {
        DVec2::from_array(row)
    }

    #[inline(always)]
    fn row(vector: DVec2) -> [f64; 2] {
        vector.to_array()
    }

    #[inline(always)]
    fn from_spin_row(row: f64) -> f64 {
        row
    }

    #[inline(always)]
    fn spin_row(spin: f64) -> f64 {
        spin
    }

    #[inline(always)]
    fn vector(vector: DVec3) -> DVec2 {
        vector.truncate()
    }

    #[inline(always)]
    fn in_space(vector: DVec2) -> DVec3 {
        vector.extend(0.0)
    }

    #[inline(always)]
    fn spin(spin: DVec3) -> f64 {
        spin.z
    }

    #[inline(always)]
    fn spin_in_space(spin: f64) -> DVec3 {
        DVec3::new(0.0, 0.0, spin)
    }

    #[inline(always)]
    fn dot(a: DVec2, b: DVec2) -> f64 {
        a.dot(b)
    }

    #[inline(always)]
    fn spin_dot(a: f64, b: f64) -> f64 {
        a * b
    }

    #[inline(always)]
    fn transform(matrix: &DMat3, vector: DVec2) -> DVec2 {
        matrix.x_axis.truncate() * vector.x + matrix.y_axis.truncate() * vector.y
    }

    #[inline(always)]
    fn slip(normal: DVec2, velocity: DVec2, _along: f64, turning: f64) -> f64 {
        normal.perp_dot(velocity) - turning
    }

    #[inline(always)]
    fn tangent(normal: DVec2, vector: DVec2) -> f64 {
        normal.perp_dot(vector)
    }

    #[inline(always)]
    fn across(normal: DVec2, tangent: f64) -> DVec2 {
        normal.perp() * tangent
    }

    #[inline(always)]
    fn turn(_normal: DVec2, tangent: f64) -> f64 {
        -tangent
    }

    #[inline(always)]
    fn shorten(tangent: f64, length: f64) -> f64 {
        at_most(at_least(tangent, -length), length)
    }

    #[inline(always)]
    fn shorten_spin(spin: f64, length: f64) -> f64 {
        Self::shorten(spin, length)
    }
}

/// All three dimensions. A tangent is a vector across the normal.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Volume;

impl Space for Volume {
    const WIDTH: usize = 3;
    type Vector = DVec3;
    type Tangent = DVec3;
    type Spin = DVec3;
    type Row = [f64; 3];
    type SpinRow = [f64; 3];

    #[inline(always)]
    fn rows(column: &[f64]) -> &[[f64; 3]] {
        column.as_chunks().0
    }

    #[inline(always)]
    fn rows_mut(column: &mut [f64]) -> &mut [[f64; 3]] {
        column.as_chunks_mut().0
    }

    #[inline(always)]
    fn spin_rows(column: &[f64]) -> &[[f64; 3]] {
        column.as_chunks().0
    }

    #[inline(always)]
    fn spin_rows_mut(column: &mut [f64]) -> &mut [[f64; 3]] {
        column.as_chunks_mut().0
    }

    #[inline(always)]
    fn from_row(row: [f64; 3]) -> DVec3 {
        DVec3::from_array(row)
    }

    #[inline(always)]
    fn row(vector: DVec3) -> [f64; 3] {
        vector.to_array()
    }

    #[inline(always)]
    fn from_spin_row(row: [f64; 3]) -> DVec3 {
        DVec3::from_array(row)
    }

    #[inline(always)]
    fn spin_row(spin: DVec3) -> [f64; 3] {
        spin.to_array()
    }

    #[inline(always)]
    fn vector(vector: DVec3) -> DVec3 {
        vector
    }

    #[inline(always)]
    fn in_space(vector: DVec3) -> DVec3 {
        vector
    }

    #[inline(always)]
    fn spin(spin: DVec3) -> DVec3 {
        spin
    }

    #[inline(always)]
    fn spin_in_space(spin: DVec3) -> DVec3 {
        spin
    }

    #[inline(always)]
    fn dot(a: DVec3, b: DVec3) -> f64 {
        a.dot(b)
    }

    #[inline(always)]
    fn spin_dot(a: DVec3, b: DVec3) -> f64 {
        a.dot(b)
    }

    #[inline(always)]
    fn transform(matrix: &DMat3, vector: DVec3) -> DVec3 {
        *matrix * vector
    }

    #[inline(always)]
    fn slip(normal: DVec3, velocity: DVec3, along: f64, turning: DVec3) -> DVec3 {
        velocity - normal * along - turning.cross(normal)
    }

    #[inline(always)]
    fn tangent(normal: DVec3, vector: DVec3) -> DVec3 {
        vector - normal * vector.dot(normal)
    }

    #[inline(always)]
    fn across(_normal: DVec3, tangent: DVec3) -> DVec3 {
        tangent
    }

    #[inline(always)]
    fn turn(normal: DVec3, tangent: DVec3) -> DVec3 {
        tangent.cross(normal)
    }

    #[inline(always)]
    fn shorten(tangent: DVec3, length: f64) -> DVec3 {
        let square = tangent.length_squared();
        // Not the other way round: a length that is no number has to show.
        if square <= length * length {
            tangent
        } else {
            tangent * (length / square.sqrt())
        }
    }

    #[inline(always)]
    fn shorten_spin(spin: DVec3, length: f64) -> DVec3 {
        Self::shorten(spin, length)
    }
}
