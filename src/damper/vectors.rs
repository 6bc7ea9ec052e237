//! Columns of vectors.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

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

/// The components of a column, each in a slice; empty where they are all zero.
pub(crate) type Components<'a> = [&'a [f64]; 3];

/// A column of vectors: all their x, then all their y, then all their z. What is always zero is left
/// out.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Vectors {
    values: Vec<f64>,
    count: usize,
    axes: Axes,
}

impl Vectors {
    /// A column of `count` zeros.
    pub(crate) fn zeros(axes: Axes, count: usize) -> Self {
        let components = match axes {
            Axes::Space => 3,
            Axes::Plane => 2,
            Axes::Normal => 1,
        };
        Self {
            values: vec![0.0; components * count],
            count,
            axes,
        }
    }

    /// How many vectors there are.
    pub(crate) const fn len(&self) -> usize {
        self.count
    }

    /// The numbers one after the other, component by component.
    pub(crate) fn flat(&self) -> &[f64] {
        &self.values
    }

    /// The same to be changed.
    pub(crate) fn flat_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// The components.
    #[inline(always)]
    pub(crate) fn components(&self) -> Components<'_> {
        let values = self.values.as_slice();
        match self.axes {
            Axes::Space => {
                let (x, rest) = values.split_at(self.count);
                let (y, z) = rest.split_at(self.count);
                [x, y, z]
            }
            Axes::Plane => {
                let (x, y) = values.split_at(self.count);
                [x, y, &[]]
            }
            Axes::Normal => [&[], &[], values],
        }
    }

    /// The components to be changed.
    #[inline(always)]
    pub(crate) fn components_mut(&mut self) -> [&mut [f64]; 3] {
        let values = self.values.as_mut_slice();
        match self.axes {
            Axes::Space => {
                let (x, rest) = values.split_at_mut(self.count);
                let (y, z) = rest.split_at_mut(self.count);
                [x, y, z]
            }
            Axes::Plane => {
                let (x, y) = values.split_at_mut(self.count);
                [x, y, &mut []]
            }
            Axes::Normal => [&mut [], &mut [], values],
        }
    }

    /// A vector.
    #[inline]
    pub(crate) fn get(&self, n: usize) -> DVec3 {
        vector(&self.components(), n)
    }

    /// Sets a vector; what is always zero stays so.
    #[inline]
    pub(crate) fn set(&mut self, n: usize, vector: DVec3) {
        let components = self.components_mut();
        for (component, value) in components.into_iter().zip(vector.to_array()) {
            if let Some(old) = component.get_mut(n) {
                *old = value;
            }
        }
    }

    /// The vectors.
    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = DVec3> {
        let components = self.components();
        (0..self.count).map(move |n| vector(&components, n))
    }

    /// Sets all vectors, of which there are as many.
    pub(crate) fn assign(&mut self, vectors: impl IntoIterator<Item = DVec3>) {
        for (n, vector) in vectors.into_iter().enumerate().take(self.count) {
            self.set(n, vector);
        }
    }

    /// Whether all numbers are finite.
    pub(crate) fn is_finite(&self) -> bool {
        // Zero times a number is zero, unless the number is not finite. Four sums, to be vectors.
        let (fours, rest) = self.values.as_chunks::<4>();
        let mut sums = [0.0; 4];
        for four in fours {
            for (sum, value) in sums.iter_mut().zip(four) {
                *sum += value * 0.0;
            }
        }
        sums.iter().chain(rest).all(|value| value.is_finite())
    }

    /// Memory in bytes that the column has reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        size_of::<f64>() * self.values.capacity()
    }
}

/// The vector of a number, zero where there are no components.
#[inline(always)]
pub(crate) fn vector(components: &Components<'_>, n: usize) -> DVec3 {
    DVec3::from_array(components.map(|component| component.get(n).copied().unwrap_or(0.0)))
}

/// A velocity, force or direction. If `PLANAR`, it is in the plane z = 0, and the compiler sees so.
#[inline(always)]
pub(crate) const fn polar<const PLANAR: bool>(vector: DVec3) -> DVec3 {
    let z = if PLANAR { 0.0 } else { vector.z };
    DVec3::new(vector.x, vector.y, z)
}

/// A spin or torque. If `PLANAR`, it turns in that plane, and the compiler sees so.
#[inline(always)]
pub(crate) const fn axial<const PLANAR: bool>(vector: DVec3) -> DVec3 {
    if PLANAR {
        DVec3::new(0.0, 0.0, vector.z)
    } else {
        vector
    }
}

/// The same parts of all components.
#[inline(always)]
pub(crate) fn part<'a>(
    components: &Components<'a>,
    slots: std::ops::Range<usize>,
) -> Components<'a> {
    components.map(|component| component.get(slots.clone()).unwrap_or(&[]))
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
            assert!(column.is_finite());
            column.set(2, DVec3::NAN);
            assert!(!column.is_finite());
        }
    }
}
