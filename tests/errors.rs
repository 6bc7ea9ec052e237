//! Whatever cannot be right is refused where it is handed in, by an error that names the quantity, the
//! value and the bound.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    clippy::items_after_statements,
    clippy::too_many_lines
)]

use std::error::Error;

use particle_damper::cavity::{Cavity, Cuboid, Cylinder, Disc, Slot, Sphere, WallPoint};
use particle_damper::excitation::{BandLimitedNoise, Chirp, Harmonic, Sampled, SampledError};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::mount::{Motion, Mount, Prescribed, SingleDof};
use particle_damper::{
    AllPairs, Bodies, Body, Bound, BuildError, CellGrid, Contact, ContactForce, ContactLaw, Damper,
    Damping, Detector, DetectorError, ElasticImpact, Ending, Filling, FillingError, Friction,
    HertzMindlin, HertzTsuji, Interaction, LawError, Material, MaterialId, Materials, Particle,
    RestitutionImpulse, RestoreError, Skin, StepError, ValueError,
};

/// What was refused so far, or was not.
#[derive(Default)]
struct Table {
    rows: usize,
    wrong: Vec<String>,
}

impl Table {
    /// A row: `result` has to be an error of which `is` is true and whose text holds all of `texts`.
    fn row<T, E: Error>(&mut self, result: Result<T, E>, is: impl Fn(&E) -> bool, texts: &[&str]) {
        self.rows += 1;
        let row = self.rows;
        let Err(error) = result else {
            self.wrong
                .push(format!("row {row} ({texts:?}) is accepted"));
            return;
        };
        let text = error.to_string();
        if !is(&error) {
            self.wrong
                .push(format!("row {row} is of another type: {error:?}"));
        }
        for part in texts.iter().filter(|part| !text.contains(**part)) {
            self.wrong
                .push(format!("row {row} does not say {part:?}: {text}"));
        }
    }

    /// A row whose error is a number outside `bound`.
    fn value<T>(
        &mut self,
        result: Result<T, ValueError>,
        quantity: &str,
        bound: Bound,
        value: &str,
    ) {
        let is = |error: &ValueError| error.bound == bound && !bound.admits(error.value);
        self.row(result, is, &[quantity, &bound.to_string(), value]);
    }

    fn end(self, at_least: usize) {
        assert!(self.wrong.is_empty(), "{:#?}", self.wrong);
        assert!(self.rows >= at_least, "{} rows", self.rows);
    }
}

const NAN: f64 = f64::NAN;
const INF: f64 = f64::INFINITY;

fn particle() -> Particle {
    Particle::new(3e-3, 0.2e-3)
        .unwrap()
        .at(dvec3(0.03, 0.01, 0.0))
}

fn law() -> HertzTsuji {
    HertzTsuji::new(Material::acrylic())
}

#[test]
fn parts_refuse_numbers_that_cannot_be_right() {
    let mut table = Table::default();
    let acrylic = Material::acrylic;
    let fine = Interaction::new(0.5, 0.3).unwrap();
    let unit = Bound::Within(0.0, 1.0);
    for (value, text) in [(1.2, "1.2"), (-0.1, "-0.1"), (NAN, "NaN"), (INF, "inf")] {
        table.value(Interaction::new(value, 0.2), "restitution", unit, text);
    }
    for (value, text) in [(-0.1, "-0.1"), (NAN, "NaN"), (INF, "inf")] {
        let not_negative = Bound::NonNegative;
        table.value(
            Interaction::new(0.5, value),
            "friction coefficient",
            not_negative,
            text,
        );
        table.value(
            fine.with_rolling_friction(value),
            "rolling friction",
            not_negative,
            text,
        );
        let mindlin = HertzMindlin::new(acrylic());
        table.value(
            mindlin.tangential_damping(value),
            "tangential damping",
            not_negative,
            text,
        );
        table.value(
            SingleDof::new(1.0, value, 1.0),
            "damping of the primary",
            not_negative,
            text,
        );
        table.value(
            SingleDof::new(1.0, 1.0, value),
            "stiffness of the primary",
            not_negative,
            text,
        );
        table.value(
            Harmonic::new(1.0, value),
            "frequency (Hz)",
            not_negative,
            text,
        );
        table.value(
            Chirp::linear(1.0, [value, 2.0], 1.0),
            "frequency (Hz)",
            not_negative,
            text,
        );
        table.value(
            BandLimitedNoise::new(value, [1.0, 2.0], 5, 0),
            "RMS",
            not_negative,
            text,
        );
    }
    for (value, text) in [(0.0, "0"), (-2.0, "-2"), (NAN, "NaN"), (INF, "inf")] {
        let p = Bound::Positive;
        table.value(
            Material::new(value, 0.3, fine),
            "Young's modulus (Pa)",
            p,
            text,
        );
        table.value(Particle::new(value, 1.0), "radius (m)", p, text);
        table.value(Particle::new(1.0, value), "mass (kg)", p, text);
        table.value(
            Particle::with_density(1.0, value),
            "density (kg/m^3)",
            p,
            text,
        );
        table.value(Slot::new(value, 1.0), "slot width (m)", p, text);
        table.value(Slot::new(1.0, value), "slot height (m)", p, text);
        table.value(Cuboid::new(dvec3(1.0, value, 1.0)), "box edge (m)", p, text);
        table.value(Cylinder::new(value, 1.0), "cylinder radius (m)", p, text);
        table.value(Cylinder::new(1.0, value), "cylinder height (m)", p, text);
        table.value(Disc::new(value), "disc radius (m)", p, text);
        table.value(
            Sphere::new(value),
            "radius of the hollow sphere (m)",
            p,
            text,
        );
        table.value(
            SingleDof::new(value, 1.0, 1.0),
            "mass of the primary system (kg)",
            p,
            text,
        );
        table.value(Skin::new(AllPairs, value), "skin", p, text);
        table.value(law().reference_speed(value), "speed (m/s)", p, text);
        let mindlin = HertzMindlin::new(acrylic());
        table.value(mindlin.reference_speed(value), "speed (m/s)", p, text);
        let impulse = RestitutionImpulse::new(acrylic());
        table.value(impulse.reference_speed(value), "speed (m/s)", p, text);
        table.value(Friction::regularised(value), "slip speed (m/s)", p, text);
        table.value(ElasticImpact::new(value, 1.0, 1.0), "stiffness", p, text);
        table.value(ElasticImpact::new(1.0, value, 1.0), "mass (kg)", p, text);
        table.value(ElasticImpact::new(1.0, 1.0, value), "speed (m/s)", p, text);
        table.value(
            Chirp::linear(1.0, [1.0, 2.0], value),
            "duration of the sweep (s)",
            p,
            text,
        );
        table.value(
            Chirp::logarithmic(1.0, [value, 2.0], 1.0),
            "frequency (Hz)",
            p,
            text,
        );
        let is = |error: &SampledError| matches!(error, SampledError::Value(_));
        table.row(
            Sampled::new(value, vec![1.0]),
            is,
            &["sampling interval (s)", text],
        );
    }
    for (value, text) in [(NAN, "NaN"), (INF, "inf"), (-INF, "-inf")] {
        let finite = Bound::Finite;
        let mount = SingleDof::paper();
        table.value(
            mount.released_from(value, 0.0),
            "displacement (m)",
            finite,
            text,
        );
        table.value(
            mount.released_from(0.0, value),
            "velocity (m/s)",
            finite,
            text,
        );
        table.value(Harmonic::new(value, 1.0), "amplitude", finite, text);
        let harmonic = Harmonic::new(1.0, 1.0).unwrap();
        table.value(harmonic.with_phase(value), "phase (rad)", finite, text);
        table.value(
            Chirp::linear(value, [1.0, 2.0], 1.0),
            "amplitude",
            finite,
            text,
        );
        let is = |error: &SampledError| matches!(error, SampledError::NotFinite { number: 1, .. });
        table.row(Sampled::new(1.0, vec![0.0, value]), is, &["sample 1", text]);
    }
    let ratio = "Poisson's ratio";
    table.value(
        Material::new(1e9, -1.0, fine),
        ratio,
        Bound::Above(-1.0),
        "-1",
    );
    table.value(
        Material::new(1e9, NAN, fine),
        ratio,
        Bound::Above(-1.0),
        "NaN",
    );
    table.value(
        Material::new(1e9, 0.6, fine),
        ratio,
        Bound::AtMost(0.5),
        "0.6",
    );
    for axis in [DVec3::ZERO, DVec3::NAN, DVec3::X * INF] {
        let bound = Bound::Positive;
        table.value(
            SingleDof::paper().along(axis),
            "length of the axis",
            bound,
            "not ",
        );
    }
    let noise = |band, count| BandLimitedNoise::new(1.0, band, count, 0);
    table.value(
        noise([2.0, 2.0], 5),
        "upper frequency (Hz)",
        Bound::Above(2.0),
        "2",
    );
    table.value(noise([1.0, 2.0], 0), "components", Bound::AtLeast(1.0), "0");
    let is = |error: &SampledError| *error == SampledError::Empty;
    table.row(Sampled::new(1.0, vec![]), is, &["one sample"]);
    let least = Bound::Within(Damping::LEAST_RESTITUTION, 1.0);
    for damping in [Damping::Viscoelastic, Damping::Tsuji] {
        for (value, text) in [(0.0, "0"), (1.1, "1.1"), (NAN, "NaN")] {
            let number = damping.number(value, Ending::NeverPulling);
            table.value(number, "restitution", least, text);
            let restitution = damping.restitution(value - 1.0, Ending::NeverPulling);
            if !(0.0..=100.0).contains(&(value - 1.0)) {
                table.value(
                    restitution,
                    "damping number",
                    Bound::Within(0.0, 100.0),
                    "not ",
                );
            }
        }
    }
    table.end(150);
}

#[test]
fn detectors_refuse_grids_that_cannot_be_held() {
    let mut table = Table::default();
    let value = |error: &DetectorError| matches!(error, DetectorError::Value(_));
    let many = |error: &DetectorError| {
        matches!(
            error,
            DetectorError::TooManyCells {
                limit: CellGrid::MAX_CELLS,
                ..
            }
        )
    };
    table.row(
        CellGrid::new(0, 5),
        value,
        &["cells along x", "at least 1", "0"],
    );
    table.row(
        CellGrid::new(5, 0),
        value,
        &["cells along y", "at least 1", "0"],
    );
    table.row(
        CellGrid::in_space([0, 1, 1]),
        value,
        &["cells along x", "0"],
    );
    table.row(
        CellGrid::in_space([1, 0, 1]),
        value,
        &["cells along y", "0"],
    );
    table.row(
        CellGrid::in_space([1, 1, 0]),
        value,
        &["cells along z", "0"],
    );
    table.row(
        CellGrid::new(100_000, 100_000),
        many,
        &["10000200001 cells", "16777216"],
    );
    table.row(
        CellGrid::new(usize::MAX, usize::MAX),
        many,
        &["too large to hold", "16777216"],
    );
    table.row(
        CellGrid::in_space([usize::MAX; 3]),
        many,
        &["too large to hold"],
    );
    table.end(8);
}

#[test]
fn fillings_say_what_does_not_fit() {
    let mut table = Table::default();
    let slot = Slot::paper();
    let room = |error: &FillingError| {
        matches!(
            error,
            FillingError::NoRoom { .. } | FillingError::TooMuch { .. }
        )
    };
    let fill = |count, prototype| Filling::new(1).with(count, prototype).fill(&slot);
    table.row(fill(10_000, particle()), room, &["10000 particles"]);
    table.row(fill(200, particle()), room, &["200 particles"]);
    table.row(fill(1, Particle::new(0.04, 1.0).unwrap()), room, &["0.04"]);
    table.row(
        fill(usize::MAX, particle()),
        |_| true,
        &["18446744073709551615"],
    );
    let value = |error: &FillingError| matches!(error, FillingError::Value(_));
    let mut bad = particle();
    bad.radius = NAN;
    table.row(fill(1, bad), value, &["particle radius (m)", "NaN"]);
    bad.radius = 1e-15;
    table.row(
        fill(1, bad),
        value,
        &["particle radius (m)", "0.000000000000001"],
    );
    let down = Filling::new(1)
        .with(1, particle())
        .down(DVec3::ZERO)
        .fill(&slot);
    table.row(down, value, &["direction down", "0"]);
    let down = Filling::new(1)
        .with(1, particle())
        .down(DVec3::Z)
        .fill(&slot);
    table.row(down, value, &["direction down", "0"]);
    table.end(8);
}

/// Bodies that a law cannot serve.
fn law_rows<L: ContactLaw>(table: &mut Table, law: impl Fn(Materials) -> L)
where
    L::Coefficients: std::fmt::Debug,
{
    let sphere = |radius, mass, id| Body::sphere(radius, mass, MaterialId(id));
    let ask = |law: L, first, second| law.coefficients(&Bodies::new(first, second));
    let value = |error: &LawError| matches!(error, LawError::Value(_));
    let good = sphere(1e-3, 1e-5, 0);
    let unknown = |number| move |e: &LawError| *e == LawError::UnknownMaterial(MaterialId(number));
    let acrylic = || Materials::from(Material::acrylic());
    table.row(
        ask(law(acrylic()), sphere(1e-3, 1e-5, 7), good),
        unknown(7),
        &["7"],
    );
    table.row(
        ask(law(acrylic()), good, Body::wall(MaterialId(3))),
        unknown(3),
        &["3"],
    );

    type Spoil = fn(&mut Material);
    let spoilt: [(Spoil, &str); 4] = [
        (|m| m.interaction.restitution = 1.5, "restitution"),
        (|m| m.interaction.friction = -1.0, "friction coefficient"),
        (|m| m.interaction.friction = NAN, "friction coefficient"),
        (
            |m| m.interaction.rolling_friction = -1.0,
            "rolling friction",
        ),
    ];
    for (spoil, quantity) in spoilt {
        let mut material = Material::acrylic();
        spoil(&mut material);
        table.row(ask(law(material.into()), good, good), value, &[quantity]);
    }
}

/// Constants that the strict laws alone work with.
fn strict_rows<L: ContactLaw>(table: &mut Table, law: impl Fn(Materials) -> L) {
    let good = Body::sphere(1e-3, 1e-5, Materials::FIRST);
    let value = |error: &LawError| matches!(error, LawError::Value(_));
    type Spoil = fn(&mut Material);
    let spoilt: [(Spoil, &str); 4] = [
        (|m| m.youngs_modulus = 0.0, "Young's modulus"),
        (|m| m.poissons_ratio = 0.7, "Poisson's ratio"),
        (|m| m.poissons_ratio = NAN, "Poisson's ratio"),
        (|m| m.interaction.restitution = 0.0, "restitution"),
    ];
    for (spoil, quantity) in spoilt {
        let mut material = Material::acrylic();
        spoil(&mut material);
        let answer = law(material.into()).coefficients(&Bodies::new(good, good));
        table.row(answer, value, &[quantity]);
    }
}

#[test]
fn laws_refuse_bodies_that_they_cannot_serve() {
    let mut table = Table::default();
    law_rows(&mut table, HertzTsuji::new);
    law_rows(&mut table, HertzMindlin::new);
    law_rows(&mut table, RestitutionImpulse::new);
    strict_rows(&mut table, HertzTsuji::new);
    strict_rows(&mut table, HertzMindlin::new);
    table.end(26);
}

/// A law without a limit.
#[derive(Debug, Clone, Copy)]
struct Soft;

impl ContactLaw for Soft {
    type Coefficients = ();
    type Memory = ();

    fn coefficients(&self, _: &Bodies) -> Result<(), LawError> {
        Ok(())
    }

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
    let away = Prescribed(|_: f64| Motion {
        position: DVec3::Z,
        velocity: DVec3::ZERO,
    });
    let step =
        |error: &BuildError| matches!(error, BuildError::Start(StepError::OutOfPlane { .. }));
    table.row(
        start().time_step(1e-5).mount(away).build(),
        step,
        &["container of cavity 0", "z = 0"],
    );
    let lost = Prescribed(|_: f64| Motion {
        position: DVec3::NAN,
        velocity: DVec3::ZERO,
    });
    let step = |error: &BuildError| matches!(error, BuildError::Start(StepError::Container { .. }));
    table.row(
        start().time_step(1e-5).mount(lost).build(),
        step,
        &["container of cavity 0", "NaN"],
    );

    let large = Particle::new(0.031, 0.1)
        .unwrap()
        .at(dvec3(0.03, 0.04, 0.0));
    let is = |error: &BuildError| matches!(error, BuildError::TooLarge { particle: 0, .. });
    table.row(
        start().particles([large]).build(),
        is,
        &["0.062", "0.06 m across"],
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
            Motion {
                position: DVec3::Z * cavity as f64,
                velocity: DVec3::ZERO,
            }
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
