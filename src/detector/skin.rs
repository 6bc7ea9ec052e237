use super::{Bed, Detector, DetectorError, Pairs};
use crate::error::{Bound, ValueError};

/// Makes the proposals of another detector last over many steps (Verlet's neighbour list).
///
/// The inner detector is asked for every pair with a gap below the skin, and is not asked again
/// until some particle has moved by half the skin: until then no other pair can touch. A thick skin
/// is rebuilt rarely and lists many pairs that do not touch; 0.1 to 0.4 radii is usual.
///
/// L. Verlet, Phys. Rev. 159 (1967) 98-103, doi 10.1103/PhysRev.159.98.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Skin<D> {
    inner: D,
    thickness: f64,
}

impl<D> Skin<D> {
    /// A skin around `inner`, whose own skin it replaces. `thickness` is counted in radii of the
    /// smallest particle.
    ///
    /// # Errors
    /// If the thickness is not positive and finite.
    pub fn new(inner: D, thickness: f64) -> Result<Self, ValueError> {
        Ok(Self {
            inner,
            thickness: Bound::Positive.check("skin (smallest radii)", thickness)?,
        })
    }

    /// The detector inside.
    #[must_use]
    pub const fn inner(&self) -> &D {
        &self.inner
    }
}

impl<D: Default> Default for Skin<D> {
    /// A skin of a third of the smallest radius.
    fn default() -> Self {
        Self {
            inner: D::default(),
            thickness: 1.0 / 3.0,
        }
    }
}

impl<D: Detector> Detector for Skin<D> {
    fn prepare(&mut self, bed: &Bed<'_>) -> Result<(), DetectorError> {
        self.inner.prepare(bed)
    }

    fn detect(&mut self, bed: &Bed<'_>, pairs: &mut Pairs) {
        self.inner.detect(bed, pairs);
    }

    fn skin(&self, radius: f64) -> f64 {
        self.thickness * radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::AllPairs;

    #[test]
    fn a_skin_has_to_be_positive() {
        for skin in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
            assert!(Skin::new(AllPairs, skin).is_err(), "{skin}");
        }
    }

    #[test]
    fn the_outer_skin_counts() {
        let inner = Skin::new(AllPairs, 0.1).unwrap();
        let outer = Skin::new(inner, 0.2).unwrap();
        assert_eq!(outer.skin(1e-3).to_bits(), 2e-4_f64.to_bits());
        assert_eq!(outer.inner().skin(1e-3).to_bits(), 1e-4_f64.to_bits());
    }
}
