//! No heap allocation per step once warm: for every law, integrator and detector, lists that are
//! rebuilt included.

#![allow(unsafe_code, clippy::unwrap_used)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicU64, Ordering};

use particle_damper::cavity::Slot;
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::integrator::{Integrator, RungeKutta4, VelocityVerlet};
use particle_damper::{
    AllPairs, CellGrid, ContactLaw, Cuboid, Damper, Detector, Filling, HertzMindlin, HertzTsuji,
    LinkedCells, Material, Motion, Particle, RestitutionImpulse, SingleDof, Skin,
};

/// The system's allocator, counting.
struct Counting;

static ALLOCATIONS: AtomicU64 = AtomicU64::new(0);

// SAFETY: hands every call on to the system's allocator, unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// How many allocations `work` makes.
fn allocations(work: impl FnOnce()) -> u64 {
    let before = ALLOCATIONS.load(Ordering::Relaxed);
    work();
    ALLOCATIONS.load(Ordering::Relaxed) - before
}

/// Long enough for the lists to have been as long as they get.
const WARM: usize = 30_000;
const COUNTED: usize = 5_000;

/// A shaken bed in a slot: sloshes, so that lists are rebuilt, and comes back on itself.
fn shaken<L: ContactLaw, I: Integrator>(
    name: &str,
    law: L,
    time_step: f64,
    integrator: I,
    detector: Box<dyn Detector>,
) {
    let bed = Filling::new(3)
        .with(30, Particle::new(3e-3, 0.2e-3).unwrap())
        .fill(&Slot::paper())
        .unwrap();
    let mount =
        SingleDof::paper().excited_by(|t: f64| if (t * 12.0) % 2.0 < 1.0 { 2.0 } else { -2.0 });
    let mut damper = Damper::builder(Slot::paper(), law)
        .mount(mount)
        .integrator(integrator)
        .detectors([detector])
        .particles(bed)
        .time_step(time_step)
        .build()
        .unwrap();
    for _ in 0..WARM {
        damper.step().unwrap();
    }
    let before = damper.detections();
    let made = allocations(|| {
        for _ in 0..COUNTED {
            damper.step().unwrap();
        }
    });
    assert!(damper.detections() > before, "{name}: no list was rebuilt");
    assert_eq!(made, 0, "{name}");
}

fn detectors() -> Vec<(&'static str, Box<dyn Detector>)> {
    vec![
        ("all pairs", Box::new(AllPairs)),
        ("cell grid", Box::new(CellGrid::paper())),
        ("linked cells", Box::new(LinkedCells::new())),
        (
            "skin of all pairs",
            Box::new(Skin::new(AllPairs, 0.3).unwrap()),
        ),
        (
            "skin of a grid",
            Box::new(Skin::new(CellGrid::paper(), 0.3).unwrap()),
        ),
        (
            "skin of linked cells",
            Box::new(Skin::<LinkedCells>::default()),
        ),
    ]
}

/// A host drives a box in space to and fro.
fn driven<L: ContactLaw>(name: &str, law: L, time_step: f64) {
    let room = Cuboid::new(dvec3(0.02, 0.03, 0.02)).unwrap();
    let bed = Filling::new(5)
        .with(20, Particle::new(2e-3, 0.1e-3).unwrap())
        .with(5, Particle::new(1e-3, 0.02e-3).unwrap())
        .fill(&room)
        .unwrap();
    let mut damper = Damper::builder(room, law)
        .particles(bed)
        .time_step(time_step)
        .build()
        .unwrap();
    let mut speed = 0.3;
    let mut place = 0.0;
    let mut drive = |steps: usize| {
        for step in 0..steps {
            if step % 50 == 0 {
                speed = -speed;
            }
            place += speed * 2.0 * time_step;
            let end = Motion::at(DVec3::Y * place, DVec3::Y * speed);
            damper.drive(end, 2.0 * time_step).unwrap();
        }
    };
    drive(WARM / 2);
    assert_eq!(allocations(|| drive(COUNTED / 2)), 0, "{name}");
}

// One test: a second one at the same time would be counted along.
#[test]
fn no_step_allocates_once_warm() {
    let acrylic = Material::acrylic;
    for (name, detector) in detectors() {
        let law = HertzTsuji::new(acrylic());
        shaken(name, law, 2e-5, VelocityVerlet, detector);
    }
    let linked = || -> Box<dyn Detector> { Box::new(Skin::<LinkedCells>::default()) };
    let law = HertzTsuji::new(acrylic());
    shaken("Runge-Kutta", law, 2e-5, RungeKutta4::default(), linked());
    for (name, detector) in detectors() {
        let law = HertzMindlin::new(acrylic());
        shaken(name, law, 1.5e-5, VelocityVerlet, detector);
    }
    let law = HertzMindlin::new(acrylic());
    shaken(
        "memory, Runge-Kutta",
        law,
        1.5e-5,
        RungeKutta4::default(),
        linked(),
    );
    for (name, detector) in detectors() {
        let law = RestitutionImpulse::new(acrylic());
        shaken(name, law, 1e-4, VelocityVerlet, detector);
    }
    let law = RestitutionImpulse::new(acrylic());
    shaken(
        "impulses, Runge-Kutta",
        law,
        1e-4,
        RungeKutta4::default(),
        linked(),
    );
    let law = RestitutionImpulse::literal(acrylic());
    shaken("simultaneous impulses", law, 2e-5, VelocityVerlet, linked());
    driven("driven, strict", HertzTsuji::new(acrylic()), 4e-6);
    driven("driven, memory", HertzMindlin::new(acrylic()), 4e-6);
    driven("driven, impulses", RestitutionImpulse::new(acrylic()), 1e-4);
}
