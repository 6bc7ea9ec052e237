//! What a damper refuses once it runs: snapshots and drives.

use particle_damper::cavity::{Disc, Slot};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::mount::{Motion, Mount, SingleDof};
use particle_damper::{BuildError, Damper, Particle, RestoreError, StepError};

use super::table::{INF, NAN, Table, law, particle};

fn mismatch(quantity: &'static str) -> impl Fn(&RestoreError) -> bool {
    move |error| matches!(error, RestoreError::Mismatch { quantity: found, .. } if *found == quantity)
}

#[test]
fn restoring_another_set_up_is_refused_and_changes_nothing() {
    let mut table = Table::default();
    let at = |x| particle().at(dvec3(x, 0.01, 0.0));
    let two = || Damper::builder(Slot::paper(), law()).particles([at(0.01), at(0.03)]);
    let mut damper = two().build().unwrap();
    let before = damper.snapshot();
    let more = two().particles([at(0.05)]).build().unwrap().snapshot();
    table.row(
        damper.restore(&more),
        mismatch("particles"),
        &["3 particles", "the damper 2"],
    );
    let mounted = two().mount(SingleDof::paper()).build().unwrap().snapshot();
    table.row(
        damper.restore(&mounted),
        mismatch("mount coordinates"),
        &["mount coordinates"],
    );
    let both = two()
        .another_cavity(Slot::paper())
        .build()
        .unwrap()
        .snapshot();
    table.row(damper.restore(&both), |_| true, &["the damper"]);
    let other = |change: fn(Particle) -> Particle| {
        let bed = [at(0.01), change(at(0.03))];
        let built = Damper::builder(Slot::paper(), law()).particles(bed).build();
        built.unwrap().snapshot()
    };
    let is = |error: &RestoreError| matches!(error, RestoreError::OtherSetup { .. });
    for change in [
        |p: Particle| Particle::new(2e-3, p.mass).unwrap().at(p.position),
        |p: Particle| Particle::new(p.radius, 1e-3).unwrap().at(p.position),
    ] {
        table.row(damper.restore(&other(change)), is, &["another bed"]);
    }
    let round = Damper::builder(Disc::new(0.05).unwrap(), law())
        .particles([at(0.01), at(0.03)])
        .build()
        .unwrap();
    table.row(
        damper.restore(&round.snapshot()),
        mismatch("walls"),
        &["1 walls", "the damper 4"],
    );
    assert_eq!(damper.snapshot(), before);

    // The same particles, but one of them in the other cavity.
    let build = |cavities: [u32; 2]| {
        let bed = [
            at(0.01).in_cavity(cavities[0]),
            at(0.03).in_cavity(cavities[1]),
        ];
        let two = Damper::builder(Slot::paper(), law()).another_cavity(Slot::paper());
        two.particles(bed).build().unwrap()
    };
    let mut damper = build([0, 1]);
    table.row(damper.restore(&build([1, 0]).snapshot()), is, &["cavities"]);
    table.end(7);
}

#[test]
fn drives_that_cannot_be_are_refused() {
    let mut table = Table::default();
    let build = || {
        Damper::builder(Slot::paper(), law())
            .particles([particle()])
            .build()
            .unwrap()
    };
    let mut damper = build();
    let still = Motion::default();
    let value = |error: &StepError| matches!(error, StepError::Value(_));
    for (interval, text) in [
        (0.0, "0"),
        (-1.0, "-1"),
        (NAN, "NaN"),
        (INF, "inf"),
        (1e300, "at most"),
    ] {
        table.row(
            damper.drive(still, interval),
            value,
            &["interval (s)", text],
        );
    }
    let is = |error: &StepError| matches!(error, StepError::Container { cavity: 0, .. });
    let place = |position| Motion { position, ..still };
    table.row(
        damper.drive(place(DVec3::NAN), 1e-5),
        is,
        &["cavity 0", "NaN"],
    );
    let speed = |velocity| Motion { velocity, ..still };
    table.row(
        damper.drive(speed(DVec3::INFINITY), 1e-5),
        is,
        &["cavity 0", "inf"],
    );
    assert_eq!(
        damper.snapshot(),
        build().snapshot(),
        "a refused drive changes nothing"
    );
    let is = |error: &StepError| matches!(error, StepError::OutOfPlane { cavity: 0, .. });
    table.row(
        build().drive(place(DVec3::Z), 1e-5),
        is,
        &["cavity 0", "z = 0"],
    );
    table.row(
        build().drive(speed(DVec3::Z), 1e-5),
        is,
        &["cavity 0", "z = 0"],
    );
    table.end(9);
}

/// A mount whose second container alone leaves the plane.
#[test]
fn every_container_of_a_planar_cavity_is_held_to_the_plane() {
    struct Askew;
    impl Mount for Askew {
        fn motion(&self, _: f64, _: &[f64], _: &[f64], cavity: usize) -> Motion {
            Motion::at(DVec3::Z * cavity as f64, DVec3::ZERO)
        }
    }
    let built = Damper::builder(Slot::paper(), law())
        .another_cavity(Slot::paper())
        .mount(Askew)
        .time_step(1e-5)
        .build();
    let error = built.err().unwrap();
    assert!(
        matches!(
            error,
            BuildError::Start(StepError::OutOfPlane { cavity: 1, .. })
        ),
        "{error}"
    );
}
