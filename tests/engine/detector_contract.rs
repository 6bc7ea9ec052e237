//! The contract of `Detector`, held against every detector by one body: exactly the pairs that
//! testing each pair gives, each once.

use particle_damper::glam::DVec3;
use particle_damper::{
    AllPairs, Bed, CellGrid, Counted, Detector, DetectorError, LinkedCells, Neighbourhood, Pairs,
    Skin,
};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// A bed at two instants.
#[derive(Debug, Clone)]
struct Case {
    planar: bool,
    bounds: [DVec3; 2],
    radii: Vec<f64>,
    instants: [Vec<DVec3>; 2],
    margin: f64,
    cells: [usize; 3],
}

impl Case {
    fn bed(&self, instant: usize) -> Bed<'_> {
        Bed::new(&self.instants[instant], &self.radii, self.bounds)
            .in_plane(self.planar)
            .with_margin(self.margin)
    }
}

/// Where a centre goes.
#[derive(Debug, Clone, Copy)]
enum Place {
    /// Anywhere in the box.
    Inside([f64; 3]),
    /// Up to so many box sizes outside.
    Outside([f64; 3], f64),
    /// At a node of the square lattice that fills the box with touching particles of the base
    /// radius, so that gaps vanish up to rounding.
    Node([f64; 3]),
    /// Where the particle before is.
    Same,
    /// At a distance of this many base radii from the particle before.
    Near([f64; 3], f64),
}

fn place() -> impl Strategy<Value = Place> {
    let unit = || [0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64];
    prop_oneof![
        8 => unit().prop_map(Place::Inside),
        2 => (unit(), prop_oneof![Just(1.1), Just(3.0), Just(1e6)])
            .prop_map(|(at, far)| Place::Outside(at, far)),
        2 => unit().prop_map(Place::Node),
        1 => Just(Place::Same),
        4 => (unit(), prop_oneof![Just(2.0), 0.1..2.2]).prop_map(|(at, far)| Place::Near(at, far)),
    ]
}

fn positions(places: &[Place], bounds: [DVec3; 2], radius: f64, planar: bool) -> Vec<DVec3> {
    let [lower, upper] = bounds;
    let mut last = lower;
    let mut positions = Vec::new();
    for &place in places {
        let mut at = match place {
            Place::Inside(at) => lower + DVec3::from_array(at) * (upper - lower),
            Place::Outside(at, far) => {
                lower + (DVec3::from_array(at) * 2.0 - 0.5) * far * (upper - lower)
            }
            Place::Node(at) => {
                let cells = (upper - lower) / (2.0 * radius);
                lower + ((DVec3::from_array(at) * cells).floor() + 0.5) * (2.0 * radius)
            }
            Place::Same => last,
            Place::Near(at, far) => {
                let mut away = DVec3::from_array(at) - 0.5;
                if planar {
                    away.z = 0.0;
                }
                last + away.normalize_or(DVec3::X) * far * radius
            }
        };
        if planar {
            at.z = 0.0;
        }
        positions.push(at);
        last = at;
    }
    positions
}

fn case() -> impl Strategy<Value = Case> {
    let cells = prop_oneof![
        Just([20, 32, 20]),
        Just([40, 64, 40]),
        Just([80, 128, 5]),
        Just([1, 1, 1]),
        Just([200, 1, 3]),
        [1..60_usize, 1..60_usize, 1..30_usize],
    ];
    let size = prop_oneof![
        2 => Just([0.060, 0.096, 0.060]),
        1 => [0.01..0.1, 0.01..0.1, 0.01..0.1],
    ];
    let particle = || (place(), place(), 0.0..1.0_f64);
    (
        any::<bool>(),
        cells,
        size,
        prop_oneof![Just(1.0), Just(1.5), Just(10.0)],
        prop_oneof![2 => Just(0.0), 1 => 0.0..2e-3],
        prop_oneof![Just(0.0), -1.0..1.0],
        prop_oneof![1 => vec(particle(), 0..4), 4 => vec(particle(), 0..61)],
    )
        .prop_map(|(planar, cells, size, ratio, margin, shift, particles)| {
            let shift = DVec3::new(shift, -0.3 * shift, if planar { 0.0 } else { shift });
            let mut size = DVec3::from_array(size);
            if planar {
                size.z = 0.0;
            }
            let bounds = [shift, shift + size];
            let radius: f64 = 0.003;
            let radii = particles
                .iter()
                .map(|&(_, _, at)| radius * f64::powf(ratio, 1.0 - 2.0 * at))
                .collect();
            let now: Vec<_> = particles.iter().map(|p| p.0).collect();
            let then: Vec<_> = particles.iter().map(|p| p.1).collect();
            let centres = |places: &[_]| positions(places, bounds, radius, planar);
            Case {
                planar,
                bounds,
                radii,
                instants: [centres(&now), centres(&then)],
                margin,
                cells,
            }
        })
}

/// The pairs with a gap below the margin, from the definition.
fn touching(bed: &Bed<'_>) -> Vec<[u32; 2]> {
    let mut found = Vec::new();
    for a in 0..bed.len() {
        for b in a + 1..bed.len() {
            if bed.are_near(a, b) {
                found.push([a as u32, b as u32]);
            }
        }
    }
    found
}

fn proposals(detector: &mut impl Detector, bed: &Bed<'_>) -> Vec<[u32; 2]> {
    let mut pairs = Pairs::default();
    detector.detect(bed, &mut pairs);
    let mut found = pairs.as_slice().to_vec();
    found.sort_unstable();
    found
}

/// The contract. The first instant comes again at the end, to show that nothing stays behind.
fn holds<D: Detector>(mut detector: D, case: &Case) -> Result<(), TestCaseError> {
    detector.prepare(&case.bed(0)).unwrap();
    for instant in [0, 1, 0] {
        let bed = case.bed(instant);
        let found = proposals(&mut detector, &bed);
        prop_assert!(
            found.windows(2).all(|pair| pair[0] != pair[1]),
            "a pair came twice"
        );
        let near: Vec<_> = found
            .into_iter()
            .filter(|&[a, b]| bed.are_near(a as usize, b as usize))
            .collect();
        prop_assert_eq!(near, touching(&bed));
    }
    Ok(())
}

/// Every detector of the crate tests distances, so that lists stay short.
fn proposes_no_more<D: Detector>(mut detector: D, case: &Case) -> Result<(), TestCaseError> {
    let bed = case.bed(1);
    detector.prepare(&bed).unwrap();
    prop_assert_eq!(proposals(&mut detector, &bed), touching(&bed));
    Ok(())
}

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(0x5eed),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

macro_rules! contract {
    ($($name:ident: $detector:expr;)*) => {$(
        mod $name {
            use super::*;

            proptest! {
                #![proptest_config(config(3000))]

                #[test]
                fn finds_every_pair_once(case in case()) {
                    let make: fn(&Case) -> _ = $detector;
                    holds(make(&case), &case)?;
                    proposes_no_more(make(&case), &case)?;
                }
            }
        }
    )*};
}

contract! {
    all_pairs: |_| AllPairs;
    cell_grid: |case| CellGrid::new(case.cells[0], case.cells[1]).unwrap();
    cell_grid_in_space: |case| CellGrid::in_space(case.cells).unwrap();
    paper_grid: |_| CellGrid::paper();
    linked_cells: |_| LinkedCells::new();
    skin: |_| Skin::new(LinkedCells::new(), 0.3).unwrap();
    counted: |_| Counted::new(CellGrid::paper());
    boxed: |_| Box::new(LinkedCells::new()) as Box<dyn Detector>;
}

proptest! {
    #![proptest_config(config(3000))]

    #[test]
    fn the_papers_neighbourhood_counts_what_it_misses(case in case()) {
        let mut grid = CellGrid::in_space(case.cells)
            .unwrap()
            .with_neighbourhood(Neighbourhood::Paper);
        let mut missed = 0;
        grid.prepare(&case.bed(0)).unwrap();
        for instant in [0, 1] {
            let bed = case.bed(instant);
            let found = proposals(&mut grid, &bed);
            let touching = touching(&bed);
            prop_assert!(found.iter().all(|pair| touching.binary_search(pair).is_ok()));
            prop_assert!(found.windows(2).all(|pair| pair[0] != pair[1]));
            missed += touching.len() - found.len();
        }
        prop_assert_eq!(grid.missed(), missed as u64);
    }

    #[test]
    fn one_detector_serves_one_bed_after_another(cases in vec(case(), 1..4)) {
        let mut grid = CellGrid::paper();
        let mut cells = LinkedCells::new();
        for case in &cases {
            holds(&mut grid, case)?;
            holds(&mut cells, case)?;
        }
    }
}

#[test]
fn grids_that_cannot_be_are_refused() {
    assert!(matches!(CellGrid::new(0, 1), Err(DetectorError::Value(_))));
    assert!(matches!(CellGrid::new(1, 0), Err(DetectorError::Value(_))));
    assert!(CellGrid::in_space([1, 1, 0]).is_err());
    assert_eq!(
        CellGrid::new(10_000, 10_000).unwrap_err().to_string(),
        "a grid of 100020001 cells is too large to hold; the limit is 16777216"
    );
    assert!(matches!(
        CellGrid::in_space([usize::MAX; 3]),
        Err(DetectorError::TooManyCells { limit, .. }) if limit == CellGrid::MAX_CELLS
    ));
    assert!(CellGrid::new(4095, 4095).is_ok());
}

/// Found by a search: centres on the borders of cells, a diameter less one rounding apart, whose
/// coordinates round to cells that are farther apart than a diameter.
#[test]
fn rounding_at_the_borders_of_cells_loses_nothing() {
    for (lower, width, cells, per_diameter, centres) in [
        (
            -0.274_703_587_447_073_8,
            0.764_156_254_138_079_9,
            10_u32,
            3.0,
            [-0.007_248_898_498_745_826, 0.221_997_977_742_678_13],
        ),
        (
            -0.870_694_714_249_749_9,
            0.882_180_664_320_026_4,
            40,
            2.0,
            [-0.330_359_057_353_733_7, -0.286_250_024_137_732_43],
        ),
        (
            -0.558_245_934_222_825_6,
            0.854_453_359_406_675_1,
            33,
            1.0,
            [-0.156_911_780_562_114_58, -0.131_019_254_519_488_07],
        ),
    ] {
        let bounds = [DVec3::X * lower, DVec3::new(lower + width, 1.0, 0.0)];
        let radius = per_diameter * (bounds[1].x - bounds[0].x) / f64::from(cells) / 2.0;
        let centres = centres.map(|x| DVec3::X * x);
        let radii = [radius; 2];
        let bed = Bed::new(&centres, &radii, bounds).in_plane(true);
        assert_eq!(touching(&bed), [[0, 1]]);
        let mut grid = CellGrid::new(cells as usize, 1).unwrap();
        grid.prepare(&bed).unwrap();
        assert_eq!(proposals(&mut grid, &bed), [[0, 1]]);
    }
}

/// A chain of particles that barely touch: any cell shorter than a diameter would separate some.
#[test]
fn linked_cells_are_no_shorter_than_the_contact_distance() {
    for axis in DVec3::AXES {
        let chain: Vec<_> = (0..2000)
            .map(|number| axis * f64::from(number) * (2.0 - 1e-6))
            .collect();
        for smallest in [1.0, 0.3] {
            let mut radii = vec![1.0; chain.len()];
            radii[0] = smallest;
            let bounds = [DVec3::ZERO, axis * 4000.0];
            let bed = Bed::new(&chain, &radii, bounds);
            let mut cells = LinkedCells::new();
            cells.prepare(&bed).unwrap();
            assert_eq!(proposals(&mut cells, &bed), touching(&bed));
        }
    }
}

#[test]
fn unprepared_detectors_are_slow_but_exact() {
    let positions: Vec<_> = (0..20).map(|x| DVec3::X * f64::from(x)).collect();
    let radii = [0.51; 20];
    let bed = Bed::new(&positions, &radii, [DVec3::ZERO, DVec3::ONE]);
    assert_eq!(proposals(&mut CellGrid::paper(), &bed), touching(&bed));
    assert_eq!(proposals(&mut LinkedCells::new(), &bed), touching(&bed));
}

#[test]
fn an_open_box_and_a_lost_particle_are_served() {
    let positions = [
        DVec3::splat(f64::NAN),
        DVec3::ZERO,
        DVec3::splat(1e-3),
        DVec3::splat(f64::INFINITY),
        DVec3::splat(1e300),
    ];
    let radii = [0.003; 5];
    let open = [DVec3::NEG_INFINITY, DVec3::INFINITY];
    for bounds in [open, [DVec3::ZERO, DVec3::ONE]] {
        let bed = Bed::new(&positions, &radii, bounds);
        let mut grid = CellGrid::in_space([7, 7, 7]).unwrap();
        grid.prepare(&bed).unwrap();
        assert_eq!(proposals(&mut grid, &bed), [[1, 2]]);
        let mut cells = LinkedCells::new();
        cells.prepare(&bed).unwrap();
        assert_eq!(proposals(&mut cells, &bed), [[1, 2]]);
    }
}
