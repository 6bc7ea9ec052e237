//! Parts: materials, particles, cavities, mounts, detectors, fillings.

use particle_damper::cavity::{Cuboid, Cylinder, Disc, Slot, Sphere};
use particle_damper::excitation::{BandLimitedNoise, Chirp, Harmonic, Sampled, SampledError};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::mount::SingleDof;
use particle_damper::{
    AllPairs, Bound, CellGrid, Damping, DetectorError, ElasticImpact, Ending, Filling,
    FillingError, Friction, HertzMindlin, Interaction, Material, Particle, RestitutionImpulse,
    Skin,
};

use super::table::{INF, NAN, Table, law, particle};

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
