//! What goes wrong is an error that says so, and a damper goes on from the last good state.

use super::mechanics::{bed, paper_particle, steps};
use particle_damper::cavity::{Cuboid, Slot};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::mount::Motion;
use particle_damper::{
    Bodies, Contact, ContactForce, ContactLaw, Damper, ForceLaw, Forces, HertzMindlin, HertzTsuji,
    LawError, Material, RestitutionImpulse, StepError,
};

/// NaN (seen elsewhere): two centres at one point have no normal.
#[test]
fn coincident_centres_are_refused_or_stay_finite() {
    let twins = [paper_particle().at(dvec3(0.03, 0.01, 0.0)); 2];
    let law = || HertzTsuji::new(Material::acrylic());
    let refused = Damper::builder(Slot::paper(), law())
        .particles(twins)
        .build();
    assert!(
        refused
            .unwrap_err()
            .to_string()
            .contains("particles 0 and 1 overlap by 0.006")
    );
    let mut damper = Damper::builder(Slot::paper(), law())
        .particles(twins)
        .initial_overlap(3.0)
        .overlap_limit(f64::INFINITY)
        .build()
        .unwrap();
    steps(&mut damper, 10_000);
    assert!(
        damper
            .particles()
            .all(|p| p.position.is_finite() && p.velocity.is_finite())
    );
    let mut damper = Damper::builder(Slot::paper(), RestitutionImpulse::new(Material::acrylic()))
        .particles(twins)
        .initial_overlap(3.0)
        .overlap_limit(f64::INFINITY)
        .time_step(1e-4)
        .build()
        .unwrap();
    steps(&mut damper, 10_000);
    assert!(
        damper
            .particles()
            .all(|p| p.position.is_finite() && p.velocity.is_finite())
    );
}

/// A host that goes wrong gets an error, and can go on from the last good state.
fn survives_its_host<L: ContactLaw + Clone>(law: &L, time_step: f64) {
    let build = || {
        Damper::builder(Slot::paper(), law.clone())
            .particles(bed(30))
            .time_step(time_step)
            .build()
            .unwrap()
    };
    let mut damper = build();
    steps(&mut damper, 2000);
    let good = damper.snapshot();
    let at = |position| Motion::at(position, DVec3::ZERO);

    // An impulse law looks at the contacts at the start of a step, so it may tell one later.
    let metre = (0..2).find_map(|_| damper.drive(at(DVec3::Y), time_step).err());
    assert!(
        matches!(
            metre,
            Some(StepError::Escaped { .. } | StepError::Overlap { .. } | StepError::Jump { .. })
        ),
        "{metre:?}"
    );
    damper.restore(&good).unwrap();
    for bad in [DVec3::NAN, DVec3::X * f64::INFINITY] {
        let told = damper.drive(at(bad), time_step);
        assert!(matches!(told, Err(StepError::Container { .. })), "{told:?}");
    }
    for interval in [0.0, -time_step, f64::NAN, f64::INFINITY, 1e300] {
        let told = damper.drive(at(DVec3::ZERO), interval);
        assert!(matches!(told, Err(StepError::Value(_))), "{told:?}");
    }
    let told = damper.drive(at(DVec3::Z), time_step);
    assert!(
        matches!(told, Err(StepError::OutOfPlane { .. })),
        "{told:?}"
    );

    // As if nothing had happened.
    damper.restore(&good).unwrap();
    let mut other = build();
    steps(&mut other, 2000);
    for _ in 0..200 {
        let end = at(damper.container(0).unwrap().position + DVec3::Y * 1e-6);
        let (a, b) = (
            damper.drive(end, time_step).unwrap(),
            other.drive(end, time_step).unwrap(),
        );
        assert_eq!(a, b);
    }
    assert!(damper.particles().eq(other.particles()));
}

#[test]
fn a_damper_survives_its_host() {
    survives_its_host(&HertzTsuji::new(Material::acrylic()), 2e-5);
    survives_its_host(&HertzMindlin::new(Material::acrylic()), 1.5e-5);
    survives_its_host(&RestitutionImpulse::new(Material::acrylic()), 1e-4);
}

/// A law that fails past an overlap, in one of three ways.
#[derive(Debug, Clone, Copy)]
struct Failing {
    way: usize,
    overlap: f64,
}

impl ContactLaw for Failing {
    type Kind = Forces;
    type Coefficients = ();

    fn coefficients(&self, _bodies: &Bodies) -> Result<(), LawError> {
        Ok(())
    }
}

impl ForceLaw for Failing {
    type Memory = ();

    fn force(&self, (): &(), contact: &Contact, (): &()) -> ContactForce {
        let mut force = ContactForce::new(1e3 * contact.overlap, DVec3::ZERO);
        if contact.overlap > self.overlap {
            match self.way {
                0 => force.normal = f64::NAN,
                1 => force.tangential = DVec3::X * f64::INFINITY,
                _ => force.couple = DVec3::Z * f64::NAN,
            }
        }
        force
    }
}

#[test]
fn a_law_that_answers_nan_is_an_error_and_the_damper_goes_on_from_a_snapshot() {
    for way in 0..3 {
        let ball = paper_particle()
            .at(dvec3(0.03, 0.004, 0.0))
            .moving(DVec3::NEG_Y * 0.2);
        let mut damper = Damper::builder(Slot::paper(), Failing { way, overlap: 4e-5 })
            .particles([ball])
            .time_step(1e-5)
            .build()
            .unwrap();
        let good = damper.snapshot();
        let error = (0..10_000).find_map(|_| damper.step().err());
        let Some(StepError::NotFinite { particle: 0, .. }) = error else {
            panic!("way {way}: {error:?}");
        };
        damper.restore(&good).unwrap();
        steps(&mut damper, 100);
        assert!(damper.particle(0).unwrap().velocity.y < -0.2);
    }
}

/// An error names the wall that was crossed.
#[test]
fn an_escape_names_the_particle_and_the_wall() {
    let room = Cuboid::new(DVec3::splat(0.02)).unwrap();
    let fast = paper_particle()
        .at(DVec3::splat(0.01))
        .moving(DVec3::X * 500.0);
    let mut damper = Damper::builder(room, HertzTsuji::new(Material::acrylic()))
        .overlap_limit(f64::INFINITY)
        .particles([paper_particle().at(dvec3(0.01, 0.0035, 0.0035)), fast])
        .build()
        .unwrap();
    let error = (0..10_000).find_map(|_| damper.step().err()).unwrap();
    let StepError::Escaped {
        particle: 1, wall, ..
    } = error
    else {
        panic!("{error}");
    };
    assert_eq!(wall, 1, "x high");
}
