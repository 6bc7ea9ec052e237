//! Contact detectors: time per detection, against the number of particles.
//!
//! Groups: the paper's slot; what a wrapper adds; then large beds, loose (5 % of the room is filled)
//! and dense (60 %, in the plane 75 %), planar and in space, with a margin of 0.2 radii as inside a
//! skin; and a dense one of radii from 1 to 10. Particle numbers are shuffled, as mixing leaves them.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use particle_damper::glam::DVec3;
use particle_damper::{
    AllPairs, Bed, CellGrid, Counted, Detector, LinkedCells, Neighbourhood, Pairs, Skin,
};

const RADIUS: f64 = 0.003;

/// Numbers between 0 and 1 (Marsaglia 2003, doi 10.18637/jss.v008.i14).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            items.swap(last, (self.next() * (last + 1) as f64) as usize);
        }
    }
}

struct Filling {
    planar: bool,
    margin: f64,
    bounds: [DVec3; 2],
    positions: Vec<DVec3>,
    radii: Vec<f64>,
}

impl Filling {
    /// `count` places on a lattice of close packing, stretched to fill the part `filled` of a box
    /// that is as high as wide, and shaken a little.
    fn new(count: usize, planar: bool, filled: f64, margin: f64) -> Self {
        let pitch = RADIUS
            * if planar {
                2.0 * (0.9069 / filled).sqrt()
            } else {
                2.0 * (0.7405 / filled).cbrt()
            };
        let side = if planar {
            (count as f64).sqrt()
        } else {
            (count as f64).cbrt()
        }
        .ceil() as usize;
        let step = DVec3::new(1.0, 0.75_f64.sqrt(), (2.0 / 3.0_f64).sqrt());
        let mut random = Random(0x5eed);
        let shake = 0.5 * (pitch - 2.0 * RADIUS).max(0.0);
        let mut positions: Vec<_> = (0..count)
            .map(|number| {
                let [x, y, z] = if planar {
                    [number % side, number / side, 0]
                } else {
                    [number % side, number / side % side, number / side / side]
                };
                let across = 0.5 * ((y + z) % 2) as f64;
                let up = if z % 2 == 1 { 1.0 / 3.0 } else { 0.0 };
                let node = DVec3::new(x as f64 + across, y as f64 + up, z as f64) * step * pitch;
                let away = DVec3::new(random.next(), random.next(), random.next()) - 0.5;
                RADIUS + node + away * shake
            })
            .map(|at| if planar { at.with_z(0.0) } else { at })
            .collect();
        random.shuffle(&mut positions);
        let top = positions.iter().fold(DVec3::ZERO, |top, &at| top.max(at));
        let rim = if planar {
            DVec3::new(RADIUS, RADIUS, 0.0)
        } else {
            DVec3::splat(RADIUS)
        };
        Self {
            planar,
            margin,
            bounds: [DVec3::ZERO, top + rim],
            radii: vec![RADIUS; count],
            positions,
        }
    }

    /// Beds as in the paper: `count` particles in its slot, in close rows on the floor.
    fn slot(count: usize) -> Self {
        let mut filling = Self::new(count, true, 0.87, 0.0);
        let mut random = Random(0x5eed);
        for (number, position) in filling.positions.iter_mut().enumerate() {
            let [x, y] = [number % 9, number / 9].map(|index| index as f64 + 0.5);
            let away = DVec3::new(random.next(), random.next(), 0.0) - DVec3::new(0.5, 0.5, 0.0);
            *position = DVec3::new(x * 0.00666, y * 0.0062, 0.0) + 0.0006 * away;
        }
        random.shuffle(&mut filling.positions);
        filling.bounds = [DVec3::ZERO, DVec3::new(0.060, 0.096, 0.0)];
        filling
    }

    /// A dense bed of radii from a tenth to the whole: each place of a large particle is left to it
    /// or filled with 8, 125 or 1000 smaller ones.
    fn mixed(count: usize) -> Self {
        let mut filling = Self::new((count / 150).max(27), false, 0.6, 0.0);
        let places = std::mem::take(&mut filling.positions);
        let mut particles = Vec::new();
        let mut random = Random(0x5eed);
        for place in places.into_iter().cycle() {
            let split = [1, 2, 5, 10][(random.next() * 4.0) as usize];
            let radius = RADIUS / f64::from(split);
            for cell in 0..split * split * split {
                let [x, y, z] = [cell % split, cell / split % split, cell / split / split];
                let corner = DVec3::new(f64::from(x), f64::from(y), f64::from(z)) * 2.0 + 1.0;
                particles.push((place - RADIUS + corner * radius, radius));
            }
            if particles.len() >= count {
                break;
            }
        }
        particles.truncate(count);
        random.shuffle(&mut particles);
        (filling.positions, filling.radii) = particles.into_iter().unzip();
        filling
    }

    fn bed(&self) -> Bed<'_> {
        Bed::new(&self.positions, &self.radii, self.bounds)
            .in_plane(self.planar)
            .with_margin(self.margin)
    }
}

fn measure<D: Detector>(
    c: &mut Criterion,
    group: &str,
    name: &str,
    mut detector: D,
    filling: &Filling,
) {
    let bed = filling.bed();
    detector.prepare(&bed).unwrap();
    let mut pairs = Pairs::default();
    let mut group = c.benchmark_group(format!("detect/{group}"));
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(400))
        .throughput(Throughput::Elements(bed.len() as u64))
        .bench_function(BenchmarkId::new(name, bed.len()), |bencher| {
            bencher.iter(|| {
                pairs.clear();
                detector.detect(black_box(&bed), &mut pairs);
                black_box(pairs.as_slice().len())
            });
        });
    group.finish();
}

fn slot(c: &mut Criterion) {
    for count in [20, 40, 60, 80, 100] {
        let filling = Filling::slot(count);
        let grid = |across, up| CellGrid::new(across, up).unwrap();
        let paper = CellGrid::paper().with_neighbourhood(Neighbourhood::Paper);
        measure(c, "slot", "all_pairs", AllPairs, &filling);
        measure(c, "slot", "cells_32x20", CellGrid::paper(), &filling);
        measure(c, "slot", "cells_32x20_paper", paper, &filling);
        measure(c, "slot", "cells_64x40", grid(40, 64), &filling);
        measure(c, "slot", "cells_128x80", grid(80, 128), &filling);
        measure(c, "slot", "linked_cells", LinkedCells::new(), &filling);
    }
}

fn large(c: &mut Criterion) {
    for (group, planar, filled) in [
        ("planar_loose", true, 0.05),
        ("planar_dense", true, 0.75),
        ("space_loose", false, 0.05),
        ("space_dense", false, 0.60),
    ] {
        for count in [1_000, 10_000, 100_000, 1_000_000] {
            let filling = Filling::new(count, planar, filled, 0.2 * RADIUS);
            every(c, group, &filling);
        }
    }
    for count in [1_000, 10_000, 100_000, 1_000_000] {
        every(c, "space_mixed", &Filling::mixed(count));
    }
}

/// The cell grid with cells as long as the largest radius, or as many as it can hold.
fn grid(filling: &Filling) -> CellGrid {
    let size = filling.bounds[1] - filling.bounds[0];
    let cells = |edge: f64| (size / edge).ceil().max(DVec3::ONE);
    let mut edge = RADIUS;
    while (cells(edge) + 1.0).element_product() > CellGrid::MAX_CELLS as f64 {
        edge *= 1.1;
    }
    CellGrid::in_space(cells(edge).to_array().map(|along| along as usize)).unwrap()
}

fn every(c: &mut Criterion, group: &str, filling: &Filling) {
    if filling.positions.len() <= 10_000 {
        measure(c, group, "all_pairs", AllPairs, filling);
    }
    // Hundreds of small particles share the neighbourhood of a large one.
    if group != "space_mixed" || filling.positions.len() <= 10_000 {
        measure(c, group, "cell_grid", grid(filling), filling);
    }
    measure(c, group, "linked_cells", LinkedCells::new(), filling);
}

/// What the wrappers add to the detector inside.
fn wrapped(c: &mut Criterion) {
    let filling = Filling::slot(60);
    let skin = Skin::new(LinkedCells::new(), 0.2).unwrap();
    measure(c, "wrapped", "linked_cells", LinkedCells::new(), &filling);
    measure(c, "wrapped", "skin", skin, &filling);
    measure(
        c,
        "wrapped",
        "counted",
        Counted::new(LinkedCells::new()),
        &filling,
    );
}

criterion_group!(benches, slot, wrapped, large);
criterion_main!(benches);
