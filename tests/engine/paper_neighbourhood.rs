//! The paper's neighbourhood of 20 cells misses contacts, and the grid says how many.

use particle_damper::glam::DVec3;
use particle_damper::{Bed, CellGrid, Detector, Neighbourhood, Pairs};

/// Numbers between 0 and 1 (Marsaglia 2003, doi 10.18637/jss.v008.i14).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The part of pairs of random direction in the paper's slot, overlapping by so many radii, that
/// are missed.
fn missed_part(across: usize, up: usize, overlap: f64) -> f64 {
    const RADIUS: f64 = 0.003;
    const TRIALS: u32 = 400_000;
    let bounds = [DVec3::ZERO, DVec3::new(0.060, 0.096, 0.0)];
    let radii = [RADIUS; 2];
    let mut grid = CellGrid::new(across, up)
        .unwrap()
        .with_neighbourhood(Neighbourhood::Paper);
    let mut random = Random(0x5eed);
    let mut pairs = Pairs::default();
    for trial in 0..TRIALS {
        let angle = std::f64::consts::TAU * random.next();
        let distance = RADIUS * (2.0 - overlap);
        let centre = DVec3::new(
            0.01 + 0.04 * random.next(),
            0.01 + 0.07 * random.next(),
            0.0,
        );
        let half = 0.5 * distance * DVec3::new(angle.cos(), angle.sin(), 0.0);
        let positions = [centre - half, centre + half];
        let bed = Bed::new(&positions, &radii, bounds).in_plane(true);
        if trial == 0 {
            grid.prepare(&bed).unwrap();
        }
        pairs.clear();
        grid.detect(&bed, &mut pairs);
    }
    grid.missed() as f64 / f64::from(TRIALS)
}

/// Two centres dx and dy apart, in cells as long as r, are in cells adjacent along x with the
/// probability (2 - dx / r)(1 - dy / r); averaged over all directions.
fn missed_part_expected(overlap: f64) -> f64 {
    const STEPS: u32 = 100_000;
    let quarter = std::f64::consts::FRAC_PI_2;
    let mut sum = 0.0;
    for step in 0..STEPS {
        let angle = quarter * (f64::from(step) + 0.5) / f64::from(STEPS);
        let [along, across] = [angle.cos(), angle.sin()].map(|part| (2.0 - overlap) * part);
        sum += (2.0 - along).clamp(0.0, 1.0) * (1.0 - across).max(0.0);
    }
    2.0 * sum / f64::from(STEPS)
}

#[test]
fn the_papers_neighbourhood_misses_contacts_on_the_coarse_grid() {
    for (overlap, published) in [(1e-9, 0.014), (0.04, 0.028)] {
        let missed = missed_part(20, 32, overlap);
        let expected = missed_part_expected(overlap);
        assert!((expected - published).abs() < 5e-4, "{expected}");
        assert!((missed - expected).abs() < 8e-4, "{missed}");
    }
}

#[test]
fn the_papers_neighbourhood_misses_nothing_on_finer_grids() {
    for [across, up] in [[40, 64], [80, 128]] {
        assert!(missed_part(across, up, 1e-9) <= 0.0);
        assert!(missed_part(across, up, 0.04) <= 0.0);
    }
}
