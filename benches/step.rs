//! Steps of a damper: time per step against the number of particles, under every law and integrator.
//!
//! Groups: the paper's slot at 6 Hz, with the detector that is the default, and with the paper's; and
//! large boxes, filled to a third and shaken up and down.

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
    while damper.time() < before {
        damper.step().unwrap();
    }
    let mut group = c.benchmark_group(format!("step/{group}"));
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500))
        .throughput(Throughput::Elements(damper.len() as u64))
        .bench_function(BenchmarkId::new(name, damper.len()), |bencher| {
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

/// `count` spheres in a cube that is shaken by 10 mm at 6 Hz.
fn cube<L: ContactLaw>(c: &mut Criterion, name: &str, law: L, time_step: f64, count: usize) {
    let side = 3e-3 * (4.0 * std::f64::consts::PI * count as f64).cbrt();
    let cavity = Cuboid::new(DVec3::splat(side)).unwrap();
    let sphere = Particle::new(3e-3, 0.2e-3).unwrap();
    let w = std::f64::consts::TAU * 6.0;
    let shaken = Prescribed(move |time: f64| Motion {
        position: DVec3::Y * 0.01 * (w * time).sin(),
        velocity: DVec3::Y * 0.01 * w * (w * time).cos(),
    });
    let damper = Damper::builder(cavity, law)
        .mount(shaken)
        .particles(Filling::new(1).with(count, sphere).fill(&cavity).unwrap())
        .time_step(time_step)
        .build()
        .unwrap();
    measure(c, ("cube", name), damper, 100.0 * time_step);
}

fn large(c: &mut Criterion) {
    let acrylic = Material::acrylic();
    for count in [1_000, 10_000, 100_000] {
        cube(
            c,
            "hertz_tsuji_verlet",
            HertzTsuji::new(acrylic),
            STRICT,
            count,
        );
        cube(
            c,
            "restitution_verlet",
            RestitutionImpulse::new(acrylic),
            COARSE,
            count,
        );
    }
}

criterion_group!(benches, paper, large);
criterion_main!(benches);
