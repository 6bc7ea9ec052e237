//! Classes of size.

use super::lattice::Lattice;
use crate::detector::Bed;

/// The most levels. The last one holds whatever is smaller.
const MOST: usize = 8;

/// The most cells per particle. More of them are emptier, but have to be swept.
const CELLS_PER_PARTICLE: usize = 4;

/// The particles of similar size, and the cells for them.
#[derive(Debug, Clone)]
pub(super) struct Level {
    /// The largest radius in m.
    pub(super) largest: f64,
    /// The least edge of a cell in m.
    pub(super) edge: f64,
    pub(super) most_cells: usize,
    pub(super) lattice: Lattice,
}

impl Level {
    /// The levels of a bed, from coarse to fine. Each holds radii down to half the largest one that
    /// it could hold; there are none without particles, except the first.
    pub(super) fn split(bed: &Bed<'_>) -> Vec<Self> {
        let top = bed.largest_radius();
        let mut largest = [0.0_f64; MOST];
        let mut counts = [0_usize; MOST];
        for &radius in bed.radii() {
            let mut level = 0;
            let mut half = 0.5 * top;
            while radius <= half && level + 1 < MOST {
                level += 1;
                half *= 0.5;
            }
            largest[level] = largest[level].max(radius);
            counts[level] += 1;
        }
        let mut levels = Vec::new();
        for (level, (largest, count)) in largest.into_iter().zip(counts).enumerate() {
            if count > 0 || level == 0 {
                levels.push(Self {
                    largest,
                    edge: 2.0 * largest + bed.margin(),
                    most_cells: (CELLS_PER_PARTICLE * count).clamp(1, 1 << 28),
                    lattice: Lattice::default(),
                });
            }
        }
        levels
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn split(radii: &[f64]) -> Vec<f64> {
        let positions = vec![DVec3::ZERO; radii.len()];
        let bed = Bed::new(&positions, radii, [DVec3::ZERO, DVec3::ONE]);
        let levels = Level::split(&bed);
        levels.iter().map(|level| level.largest).collect()
    }

    #[test]
    fn similar_sizes_share_a_level() {
        assert_eq!(split(&[1.0, 0.51, 0.7]), [1.0]);
    }

    #[test]
    fn levels_follow_the_sizes_present() {
        assert_eq!(split(&[0.1, 1.0, 0.12, 0.9, 0.4]), [1.0, 0.4, 0.12]);
        assert_eq!(split(&[]), [0.0]);
        assert_eq!(split(&[1.0, 1e-6, 1e-9, 0.0]), [1.0, 1e-6]);
    }
}
