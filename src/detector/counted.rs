use super::{Bed, Detector, DetectorError, Pairs};

/// Counts what another detector does, and is otherwise that detector.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counted<D> {
    inner: D,
    detections: u64,
    proposals: u64,
}

impl<D> Counted<D> {
    /// Counts what `inner` does from now on.
    #[must_use]
    pub const fn new(inner: D) -> Self {
        Self {
            inner,
            detections: 0,
            proposals: 0,
        }
    }

    /// The detector inside.
    #[must_use]
    pub const fn inner(&self) -> &D {
        &self.inner
    }

    /// How often it was asked for pairs.
    #[must_use]
    pub const fn detections(&self) -> u64 {
        self.detections
    }

    /// How many pairs it has proposed in all.
    #[must_use]
    pub const fn proposals(&self) -> u64 {
        self.proposals
    }
}

impl<D: Detector> Detector for Counted<D> {
    fn prepare(&mut self, bed: &Bed<'_>) -> Result<(), DetectorError> {
        self.inner.prepare(bed)
    }

    fn detect(&mut self, bed: &Bed<'_>, pairs: &mut Pairs) {
        let before = pairs.as_slice().len();
        self.inner.detect(bed, pairs);
        self.detections += 1;
        self.proposals += (pairs.as_slice().len() - before) as u64;
    }

    fn skin(&self, radius: f64) -> f64 {
        self.inner.skin(radius)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::{AllPairs, Skin};

    #[test]
    fn detections_and_proposals_are_counted() {
        let positions = [DVec3::ZERO, DVec3::X, DVec3::splat(5.0)];
        let radii = [0.6; 3];
        let bed = Bed::new(&positions, &radii, [DVec3::ZERO, DVec3::splat(6.0)]);
        let mut counted = Counted::new(AllPairs);
        counted.prepare(&bed).unwrap();
        let mut pairs = Pairs::default();
        for _ in 0..3 {
            pairs.clear();
            counted.detect(&bed, &mut pairs);
        }
        assert_eq!(pairs.as_slice(), [[0, 1]]);
        assert_eq!([counted.detections(), counted.proposals()], [3, 3]);
    }

    #[test]
    fn the_skin_shows_through() {
        let counted = Counted::new(Skin::new(AllPairs, 0.2).unwrap());
        assert_eq!(counted.skin(1e-3).to_bits(), 2e-4_f64.to_bits());
    }
}
