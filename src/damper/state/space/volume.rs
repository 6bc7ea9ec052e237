// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use glam::{DMat3, DVec3};

use super::Space;
use crate::damper::state::vectors::scale;

/// All three dimensions. A tangent is a vector across the normal.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Volume;

impl Space for Volume {
    const PLANAR: bool = false;
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

    fn accelerate(
        forces: &mut [[f64; 3]],
        torques: &mut [[f64; 3]],
        inverses: [&[f64]; 2],
        gravity: DVec3,
    ) -> bool {
        scale(forces, inverses[0], gravity.to_array()) & scale(torques, inverses[1], [0.0; 3])
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
    fn swing(spin: DVec3, arm: DVec3) -> DVec3 {
        spin.cross(arm)
    }

    #[inline(always)]
    fn moment(arm: DVec3, force: DVec3) -> DVec3 {
        arm.cross(force)
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
