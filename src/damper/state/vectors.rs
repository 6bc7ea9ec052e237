//! Columns of vectors.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::ops::Range;

use glam::DVec3;

/// Which components of the vectors of a column are not always zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Axes {
    /// All of them.
    #[default]
    Space,
    /// x and y: places and velocities in the plane z = 0.
    Plane,
    /// z: rotation in that plane.
    Normal,
}

impl Axes {
    /// How many components that are.
    const fn width(self) -> usize {
        match self {
            Self::Space => 3,
            Self::Plane => 2,
            Self::Normal => 1,
        }
    }
}

/// A column of vectors, one after the other. Components that are always zero are left out.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Vectors {
    values: Vec<f64>,
    axes: Axes,
}

impl Vectors {
    /// A column of `count` zeros.
    pub(crate) fn zeros(axes: Axes, count: usize) -> Self {
        let values = vec![0.0; axes.width() * count];
        Self { values, axes }
    }

    /// How many vectors there are.
    pub(crate) const fn len(&self) -> usize {
        self.values.len() / self.axes.width()
    }

    /// How many numbers make a vector.
    pub(crate) const fn width(&self) -> usize {
        self.axes.width()
    }

    /// The numbers one after the other.
    pub(crate) fn flat(&self) -> &[f64] {
        &self.values
    }

    /// The same to be changed.
    pub(crate) fn flat_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// The vectors to be read.
    #[inline(always)]
    pub(crate) fn rows(&self) -> Rows<'_> {
        Rows {
            values: &self.values,
            axes: self.axes,
        }
    }

    /// A vector.
    #[inline]
    pub(crate) fn get(&self, n: usize) -> DVec3 {
        self.rows().get(n)
    }

    /// Sets a vector; what is always zero stays so.
    #[inline]
    pub(crate) fn set(&mut self, n: usize, vector: DVec3) {
        match self.axes {
            Axes::Space => self.values[3 * n..3 * n + 3].copy_from_slice(&vector.to_array()),
            Axes::Plane => self.values[2 * n..2 * n + 2].copy_from_slice(&[vector.x, vector.y]),
            Axes::Normal => self.values[n] = vector.z,
        }
    }

    /// The vectors.
    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = DVec3> {
        (0..self.len()).map(|n| self.get(n))
    }

    /// Sets all vectors, of which there are as many.
    pub(crate) fn assign(&mut self, vectors: impl IntoIterator<Item = DVec3>) {
        for (n, vector) in (0..self.len()).zip(vectors) {
            self.set(n, vector);
        }
    }

    /// Fills the column with its vectors at the places `from`.
    pub(crate) fn permute(&mut self, from: &[usize]) {
        let moved: Vec<DVec3> = from.iter().map(|place| self.get(*place)).collect();
        self.assign(moved);
    }

    /// Memory in bytes that the column has reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        size_of::<f64>() * self.values.capacity()
    }
}

/// Multiplies each vector by the factor in the same place, and adds `shift`. Returns whether all
/// vectors are finite then.
pub(crate) fn scale<const WIDTH: usize>(
    vectors: &mut [[f64; WIDTH]],
    factors: &[f64],
    shift: [f64; WIDTH],
) -> bool {
    // Zero times a number is zero, unless the number is not finite.
    let mut zeros = [0; WIDTH];
    for (vector, factor) in vectors.iter_mut().zip(factors) {
        for ((value, shift), zero) in vector.iter_mut().zip(shift).zip(&mut zeros) {
            *value = *value * factor + shift;
            *zero |= (*value * 0.0).to_bits();
        }
    }
    let signs = (-0.0_f64).to_bits();
    zeros.iter().all(|zero| zero & !signs == 0)
}

/// The vectors of a column, to be read.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rows<'a> {
    values: &'a [f64],
    axes: Axes,
}

impl<'a> Rows<'a> {
    /// A vector.
    #[inline(always)]
    pub(crate) fn get(&self, n: usize) -> DVec3 {
        match self.axes {
            Axes::Space => DVec3::from_array(self.values.as_chunks().0[n]),
            Axes::Plane => {
                let [x, y] = self.values.as_chunks().0[n];
                DVec3::new(x, y, 0.0)
            }
            Axes::Normal => DVec3::new(0.0, 0.0, self.values[n]),
        }
    }

    /// The numbers one after the other.
    pub(crate) const fn flat(&self) -> &'a [f64] {
        self.values
    }

    /// Those at some indices.
    pub(crate) fn part(&self, indices: Range<usize>) -> Self {
        let width = self.axes.width();
        let values = &self.values[width * indices.start..width * indices.end];
        Self { values, ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    #[test]
    fn what_is_set_comes_back_but_for_what_is_always_zero() {
        let vector = dvec3(1.0, 2.0, 3.0);
        for (axes, kept) in [
            (Axes::Space, vector),
            (Axes::Plane, dvec3(1.0, 2.0, 0.0)),
            (Axes::Normal, dvec3(0.0, 0.0, 3.0)),
        ] {
            let mut column = Vectors::zeros(axes, 3);
            column.set(1, vector);
            assert_eq!(column.get(1), kept);
            assert_eq!(
                column.iter().collect::<Vec<_>>(),
                [DVec3::ZERO, kept, DVec3::ZERO]
            );
        }
    }
}
