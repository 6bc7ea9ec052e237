// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use glam::{DMat3, DVec2, DVec3};

use super::Space;
use crate::damper::state::vectors::scale;
use crate::numbers::{at_least, at_most};

/// The plane z = 0. A tangent is the component along the normal turned by a quarter.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Plane;

impl Space for Plane {
    const PLANAR: bool = true;
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

    fn accelerate(
        forces: &mut [[f64; 2]],
        torques: &mut [f64],
        inverses: [&[f64]; 2],
        gravity: DVec3,
    ) -> bool {
        let torques = torques.as_chunks_mut().0;
        scale(forces, inverses[0], [gravity.x, gravity.y]) & scale(torques, inverses[1], [0.0])
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
    fn swing(spin: f64, arm: DVec2) -> DVec2 {
        arm.perp() * spin
    }

    #[inline(always)]
    fn moment(arm: DVec2, force: DVec2) -> f64 {
        arm.perp_dot(force)
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
