//! Builders.

use particle_damper::cavity::{Cavity, Slot, WallPoint};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::mount::{Motion, Prescribed, SingleDof};
use particle_damper::{
    AllPairs, Bodies, BuildError, Contact, ContactForce, ContactLaw, Damper, Detector, ForceLaw,
    Forces, LawError, Material, MaterialId, Particle, RestitutionImpulse, StepError,
};

use super::table::{INF, NAN, Table, law, particle};

/// A law without a limit.
#[derive(Debug, Clone, Copy)]
struct Soft;

impl ContactLaw for Soft {
    type Kind = Forces;
    type Coefficients = ();

    fn coefficients(&self, _: &Bodies) -> Result<(), LawError> {
        Ok(())
    }
}

impl ForceLaw for Soft {
    type Memory = ();

    fn force(&self, (): &(), _: &Contact, (): &()) -> ContactForce {
        ContactForce::default()
    }
}

/// More walls than anyone can count.
#[derive(Debug, Clone, Copy)]
struct Polyhedron;

impl Cavity for Polyhedron {
    fn walls(&self) -> u32 {
        u32::MAX
    }

    fn wall(&self, _number: u32, _point: DVec3) -> WallPoint {
        WallPoint {
            normal: DVec3::Y,
            distance: 1.0,
        }
    }

    fn bounds(&self) -> [DVec3; 2] {
        [DVec3::ZERO, DVec3::ONE]
    }
}

#[test]
fn builders_refuse_what_cannot_be() {
    let mut table = Table::default();
    let start = || Damper::builder(Slot::paper(), law());
    let value = |error: &BuildError| matches!(error, BuildError::Value(_));
    for (number, text) in [(0.0, "0"), (-1e-5, "-0.00001"), (NAN, "NaN"), (INF, "inf")] {
        table.row(
            start().time_step(number).build(),
            value,
            &["time step (s)", text],
        );
    }
    for (number, text) in [(-0.1, "-0.1"), (NAN, "NaN"), (INF, "inf")] {
        table.row(
            start().initial_overlap(number).build(),
            value,
            &["initial overlap", text],
        );
    }
    for (number, text) in [(0.0, "0"), (-0.1, "-0.1"), (NAN, "NaN")] {
        table.row(
            start().overlap_limit(number).build(),
            value,
            &["overlap limit", text],
        );
    }
    table.row(
        start().gravity(DVec3::NAN).build(),
        value,
        &["gravity (m/s^2)", "NaN"],
    );
    table.row(
        start().gravity(DVec3::X * INF).build(),
        value,
        &["gravity (m/s^2)", "inf"],
    );

    type Spoil = fn(&mut Particle);
    let spoilt: [(Spoil, &[&str]); 11] = [
        (|p| p.radius = 0.0, &["radius (m)", "0"]),
        (|p| p.radius = NAN, &["radius (m)", "NaN"]),
        (|p| p.mass = -1.0, &["mass (kg)", "-1"]),
        (|p| p.mass = 1e-310, &["mass (kg)", "at least"]),
        (
            |p| p.radius = 1e-170,
            &["moment of inertia (kg m^2)", "at least"],
        ),
        (|p| p.position.x = NAN, &["position (m)", "NaN"]),
        (|p| p.position.y = INF, &["position (m)", "inf"]),
        (|p| p.velocity.x = NAN, &["velocity (m/s)", "NaN"]),
        (|p| p.velocity.y = -INF, &["velocity (m/s)", "-inf"]),
        (|p| p.spin.z = NAN, &["spin (rad/s)", "NaN"]),
        (|p| p.spin.z = INF, &["spin (rad/s)", "inf"]),
    ];
    for (spoil, texts) in spoilt {
        let mut bad = particle();
        spoil(&mut bad);
        let built = start()
            .particles([particle().at(dvec3(0.01, 0.01, 0.0)), bad])
            .build();
        let is = |error: &BuildError| matches!(error, BuildError::Particle { particle: 1, .. });
        table.row(built, is, &[texts, &["particle 1"]].concat());
    }

    let plane = |error: &BuildError| matches!(error, BuildError::OutOfPlane { .. });
    table.row(
        start().gravity(DVec3::Z).build(),
        plane,
        &["gravity", "z = 0"],
    );
    for (moved, quantity) in [
        (particle().at(dvec3(0.03, 0.01, 1e-9)), "particle position"),
        (particle().moving(DVec3::Z), "particle velocity"),
        (particle().spinning(DVec3::X), "particle spin"),
        (particle().spinning(DVec3::Y), "particle spin"),
    ] {
        table.row(
            start().particles([moved]).build(),
            plane,
            &[quantity, "leaves the plane"],
        );
    }
    let across = SingleDof::paper().along(DVec3::Z).unwrap();
    table.row(
        start().time_step(1e-5).mount(across).build(),
        plane,
        &["axis of the mount"],
    );
    let away = Prescribed(|_: f64| Motion::at(DVec3::Z, DVec3::ZERO));
    let step =
        |error: &BuildError| matches!(error, BuildError::Start(StepError::OutOfPlane { .. }));
    table.row(
        start().time_step(1e-5).mount(away).build(),
        step,
        &["container of cavity 0", "z = 0"],
    );
    let lost = Prescribed(|_: f64| Motion::at(DVec3::NAN, DVec3::ZERO));
    let step = |error: &BuildError| matches!(error, BuildError::Start(StepError::Container { .. }));
    table.row(
        start().time_step(1e-5).mount(lost).build(),
        step,
        &["container of cavity 0", "NaN"],
    );

    let large = Particle::new(0.034, 0.1)
        .unwrap()
        .at(dvec3(0.03, 0.04, 0.0));
    let is = |error: &BuildError| matches!(error, BuildError::TooLarge { particle: 0, .. });
    table.row(
        start().particles([large]).build(),
        is,
        &["0.068", "0.06 m across"],
    );
    let is = |e: &BuildError| {
        matches!(
            e,
            BuildError::InitialOverlap {
                first: 0,
                second: 1,
                ..
            }
        )
    };
    let close = [particle(), particle().at(dvec3(0.035, 0.01, 0.0))];
    table.row(
        start().particles(close).build(),
        is,
        &["particles 0 and 1", "at most 0.00015"],
    );
    let is = |e: &BuildError| {
        matches!(
            e,
            BuildError::OutsideCavity {
                particle: 0,
                wall: 2,
                ..
            }
        )
    };
    let low = particle().at(dvec3(0.03, 0.002, 0.0));
    table.row(
        start().particles([low]).build(),
        is,
        &["particle 0", "wall 2", "at most 0.00015"],
    );
    let outside = particle().at(dvec3(0.03, -5.0, 0.0));
    table.row(
        start().particles([outside]).build(),
        is,
        &["particle 0", "wall 2", "5.003"],
    );
    let is = |e: &BuildError| {
        matches!(
            e,
            BuildError::UnknownCavity {
                particle: 0,
                cavity: 3,
                ..
            }
        )
    };
    table.row(
        start().particles([particle().in_cavity(3)]).build(),
        is,
        &["cavity 3", "there are 1"],
    );
    let is =
        |e: &BuildError| matches!(e, BuildError::Law(LawError::UnknownMaterial(MaterialId(9))));
    table.row(
        start().particles([particle().of(MaterialId(9))]).build(),
        is,
        &["material number 9"],
    );
    let walls = start()
        .particles([particle()])
        .walls_of(MaterialId(9))
        .build();
    table.row(walls, is, &["material number 9"]);
    table.end(35);
}

#[test]
fn builders_refuse_steps_counts_and_parts_that_do_not_go_together() {
    let mut table = Table::default();
    let start = || Damper::builder(Slot::paper(), law()).particles([particle()]);
    let limit = 2.0 * start().build().unwrap().time_step();
    let is =
        |e: &BuildError| matches!(e, BuildError::TimeStepTooLong { limit: at, .. } if *at == limit);
    table.row(
        start().time_step(1e-3).build(),
        is,
        &["0.001 s", &limit.to_string()],
    );
    let just = limit * (1.0 + 1e-15);
    table.row(
        start().time_step(just).build(),
        is,
        &[&just.to_string(), &limit.to_string()],
    );
    assert!(start().time_step(limit).build().is_ok());

    let impulse = RestitutionImpulse::new(Material::acrylic());
    let coarse = Damper::builder(Slot::paper(), impulse)
        .particles([particle()])
        .time_step(1.0);
    let is = |e: &BuildError| matches!(e, BuildError::TimeStepTooLong { .. });
    table.row(coarse.build(), is, &["time step 1 s", "at most"]);
    let is = |error: &BuildError| *error == BuildError::NoTimeStep;
    table.row(
        Damper::builder(Slot::paper(), Soft).build(),
        is,
        &["no time step"],
    );
    table.row(
        Damper::builder(Slot::paper(), law()).build(),
        is,
        &["no time step"],
    );

    let is = |error: &BuildError| matches!(error, BuildError::TooManyWalls { .. });
    let polyhedron = Damper::builder(Polyhedron, Soft).time_step(1e-3);
    table.row(
        polyhedron.clone().build(),
        is,
        &["4294967295 walls", "1048576"],
    );
    let two = polyhedron.another_cavity(Polyhedron);
    table.row(two.build(), is, &["8589934590 walls", "1048576"]);

    let is = |e: &BuildError| {
        matches!(
            e,
            BuildError::DetectorCount {
                detectors: 1,
                cavities: 2
            }
        )
    };
    let boxed = start()
        .another_cavity(Slot::paper())
        .detectors([Box::new(AllPairs) as Box<dyn Detector>]);
    table.row(boxed.build(), is, &["2 cavities", "1 detectors"]);
    let none = start().detectors(Vec::<AllPairs>::new());
    let is = |e: &BuildError| {
        matches!(
            e,
            BuildError::DetectorCount {
                detectors: 0,
                cavities: 1
            }
        )
    };
    table.row(none.build(), is, &["1 cavities", "0 detectors"]);
    table.end(9);
}
