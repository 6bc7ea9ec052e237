//! Steps of a damper: time per step against the number of particles, under every law and integrator.
//!
//! Groups: the paper's slot at 6 Hz, with the detector that is the default, and with the paper's; and
//! large boxes in the plane and in space with dense beds, shaken up and down.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use particle_damper::excitation::Harmonic;
use particle_damper::glam::DVec3;
use particle_damper::mount::Motion;
use particle_damper::{
    AllPairs, Cavity, CellGrid, ContactLaw, Cuboid, Damper, Detector, Filling, HertzMindlin,
    HertzTsuji, Integrator, LinkedCells, Material, Mount, Particle, Prescribed, RestitutionImpulse,
    RungeKutta4, SingleDof, Skin, Slot, VelocityVerlet,
};

const STRICT: f64 = 2e-5;
const COARSE: f64 = 1e-4;

/// Measures steps of a damper that has run for a while already.
fn measure<C, L, M, D, I>(
    c: &mut Criterion,
    id: (&str, &str),
    mut damper: Damper<C, L, M, D, I>,
    before: f64,
) where
    C: Cavity,
    L: ContactLaw,
    M: Mount,
    D: Detector,
    I: Integrator,
{
    let (group, name) = id;
    let mut group = c.benchmark_group(format!("step/{group}"));
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500))
        .throughput(Throughput::Elements(damper.len() as u64))
        .bench_function(BenchmarkId::new(name, damper.len()), |bencher| {
            // Only once, and not for benchmarks that a filter leaves out.
            while damper.time() < before {
                damper.step().unwrap();
            }
            bencher.iter(|| damper.step().unwrap());
        });
    group.finish();
}

/// The paper's system with `count` particles.
fn slot<L: ContactLaw, D: Detector + Clone, I: Integrator>(
    parts: (L, D, I),
    time_step: f64,
    count: usize,
) -> Damper<Slot, L, SingleDof<Harmonic>, D, I> {
    let (law, detector, integrator) = parts;
    let cavity = Slot::paper();
    let sphere = Particle::new(3e-3, 0.2e-3).unwrap();
    Damper::builder(cavity, law)
        .mount(SingleDof::paper().excited_by(Harmonic::new(0.25, 6.0).unwrap()))
        .detector(detector)
        .integrator(integrator)
        .particles(Filling::new(1).with(count, sphere).fill(&cavity).unwrap())
        .time_step(time_step)
        .build()
        .unwrap()
}

fn paper(c: &mut Criterion) {
    let acrylic = Material::acrylic();
    let skin = Skin::<LinkedCells>::default;
    let (verlet, rk4) = (VelocityVerlet::default, RungeKutta4::default);
    for count in [20, 60, 100] {
        let tsuji = || HertzTsuji::new(acrylic);
        let impulse = || RestitutionImpulse::new(acrylic);
        let damper = slot((tsuji(), skin(), verlet()), STRICT, count);
        measure(c, ("slot", "hertz_tsuji_verlet"), damper, 1.0);
        let damper = slot((tsuji(), skin(), rk4()), STRICT, count);
        measure(c, ("slot", "hertz_tsuji_rk4"), damper, 1.0);
        let damper = slot((tsuji(), AllPairs, rk4()), STRICT, count);
        measure(c, ("slot", "hertz_tsuji_rk4_all_pairs"), damper, 1.0);
        let damper = slot(
            (HertzMindlin::new(acrylic), skin(), verlet()),
            STRICT,
            count,
        );
        measure(c, ("slot", "hertz_mindlin_verlet"), damper, 1.0);
        let damper = slot((HertzMindlin::new(acrylic), skin(), rk4()), STRICT, count);
        measure(c, ("slot", "hertz_mindlin_rk4"), damper, 1.0);
        let damper = slot((impulse(), skin(), verlet()), COARSE, count);
        measure(c, ("slot", "restitution_verlet"), damper, 1.0);
        let damper = slot((impulse(), skin(), rk4()), COARSE, count);
        measure(c, ("slot", "restitution_rk4"), damper, 1.0);
        let damper = slot((impulse(), CellGrid::paper(), verlet()), COARSE, count);
        measure(c, ("slot", "restitution_verlet_cells_32x20"), damper, 1.0);
    }
}

/// A box as high as wide, and `count` spheres that fill about 0.6 of its height. Rows are stacked so
/// that each sphere presses on two below, about as hard as the weight of four rows makes it.
fn stacked(planar: bool, count: usize) -> (DVec3, Vec<Particle>) {
    let sphere = Particle::new(3e-3, 0.2e-3).unwrap();
    let diameter = 2.0 * sphere.radius;
    let [pitch, between] = [1.001 * diameter, 0.9999 * diameter];
    let rise = (between.powi(2) - 0.25 * pitch.powi(2)).sqrt();
    let room = count as f64 / 0.7;
    let across = if planar { room.sqrt() } else { room.cbrt() }.ceil() as usize;
    let deep = if planar { 1 } else { across };
    let place = |number: usize| {
        let (column, layer) = (number % across, number / across % deep);
        let row = number / (across * deep);
        let [x, y, z] = [column, row, layer].map(|index| index as f64);
        let at = DVec3::new(x + 0.5 * (row % 2) as f64, y, z) * DVec3::new(pitch, rise, pitch);
        let corner = DVec3::new(pitch, between, pitch) * 0.5;
        sphere.at((at + corner).with_z(if planar { 0.0 } else { at.z + corner.z }))
    };
    let side = (across as f64 + 0.5) * pitch;
    (DVec3::splat(side), (0..count).map(place).collect())
}

/// Such a bed in a box that is shaken along y, by 5 mm at 6 Hz from the lowest point: too little to
/// throw the bed, so that it has its contacts however many steps are timed.
fn shaken<C: Cavity + Clone, L: ContactLaw>(
    c: &mut Criterion,
    id: (&str, &str),
    parts: (&C, L, &[Particle]),
    time_step: f64,
) {
    let (cavity, law, bed) = parts;
    let w = std::f64::consts::TAU * 6.0;
    let mount = Prescribed(move |time: f64| {
        Motion::at(
            DVec3::Y * 0.005 * (1.0 - (w * time).cos()),
            DVec3::Y * 0.005 * w * (w * time).sin(),
        )
    });
    let damper = Damper::builder(cavity.clone(), law)
        .mount(mount)
        .particles(bed.iter().copied())
        .time_step(time_step)
        .build()
        .unwrap();
    measure(c, id, damper, 100.0 * time_step);
}

/// Large beds, under every law.
fn every<C: Cavity + Clone>(c: &mut Criterion, group: &str, cavity: &C, bed: &[Particle]) {
    let acrylic = Material::acrylic();
    let (tsuji, mindlin) = (HertzTsuji::new(acrylic), HertzMindlin::new(acrylic));
    shaken(
        c,
        (group, "hertz_tsuji_verlet"),
        (cavity, tsuji, bed),
        STRICT,
    );
    shaken(
        c,
        (group, "hertz_mindlin_verlet"),
        (cavity, mindlin, bed),
        STRICT,
    );
    if bed.len() <= 100_000 {
        let impulse = RestitutionImpulse::new(acrylic);
        shaken(
            c,
            (group, "restitution_verlet"),
            (cavity, impulse, bed),
            COARSE,
        );
    }
}

fn large(c: &mut Criterion) {
    for count in [1_000, 10_000, 100_000] {
        let (size, bed) = stacked(true, count);
        every(c, "plane", &Slot::new(size.x, size.y).unwrap(), &bed);
    }
    for count in [1_000, 10_000, 100_000, 1_000_000] {
        let (size, bed) = stacked(false, count);
        every(c, "space", &Cuboid::new(size).unwrap(), &bed);
    }
}

criterion_group!(benches, paper, large);
criterion_main!(benches);
