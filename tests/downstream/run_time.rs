//! Parts and dampers that are chosen at run time, boxed, without a wrapper.

use particle_damper::cavity::{Cavity, Cuboid, Slot};
use particle_damper::excitation::{Excitation, Harmonic};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::integrator::{Integrator, RungeKutta4, VelocityVerlet};
use particle_damper::mount::{Motion, Mount, SingleDof};
use particle_damper::{
    AllPairs, Bodies, Contact, ContactForce, ContactLaw, Damper, Detector, DrivenDamper, EitherLaw,
    ForceLaw, Forces, HertzMindlin, HertzTsuji, LawError, Material, Particle, Recorded,
    RestitutionImpulse, RestoreError,
};

fn grains() -> [Particle; 2] {
    let grain = Particle::new(3e-3, 2e-4).unwrap();
    [0.01, 0.0165].map(|x| grain.at(dvec3(x, 0.01, 0.0)).moving(dvec3(0.1, 0.0, 0.0)))
}

/// What a program writes down.
struct MySimulation {
    damper: Damper<Cuboid, RestitutionImpulse>,
    record: Recorded<Slot, HertzTsuji>,
}

#[test]
fn a_program_names_its_dampers_by_cavity_and_law() {
    let law = RestitutionImpulse::new(Material::acrylic());
    let cavity = Cuboid::new(DVec3::splat(0.04)).unwrap();
    let slot = Damper::builder(Slot::paper(), HertzTsuji::new(Material::acrylic()));
    let mut simulation = MySimulation {
        damper: Damper::builder(cavity, law)
            .time_step(1e-4)
            .build()
            .unwrap(),
        record: Recorded::new(slot.time_step(1e-5).build().unwrap(), 1),
    };
    simulation.damper.step().unwrap();
    simulation.record.drive(Motion::default(), 1e-5).unwrap();
    assert!(simulation.damper.time() > simulation.record.damper().time());
}

#[test]
fn every_part_is_chosen_at_run_time_to_the_same_bits() {
    let law = HertzTsuji::new(Material::acrylic());
    let oscillator = || SingleDof::new(0.3, 0.5, 400.0).unwrap();
    let force = Harmonic::new(0.4, 6.0).unwrap();
    let mut plain = Damper::builder(Slot::paper(), law.clone())
        .mount(oscillator().excited_by(force))
        .detector(AllPairs)
        .integrator(RungeKutta4::default())
        .particles(grains())
        .time_step(1e-5)
        .build()
        .unwrap();
    let cavity: Box<dyn Cavity> = Box::new(Slot::paper());
    let force: Box<dyn Excitation> = Box::new(force);
    let detector: Box<dyn Detector> = Box::new(AllPairs);
    let integrators: [Box<dyn Integrator>; 2] =
        [Box::new(VelocityVerlet), Box::new(RungeKutta4::default())];
    let [_, integrator] = integrators;
    let either: EitherLaw<HertzMindlin, HertzTsuji> = EitherLaw::Second(law);
    let mut chosen = Damper::builder(cavity, either)
        .mount(Box::new(oscillator().excited_by(force)) as Box<dyn Mount>)
        .detectors([detector])
        .integrator(integrator)
        .particles(grains())
        .time_step(1e-5)
        .build()
        .unwrap();
    for _ in 0..5000 {
        plain.step().unwrap();
        chosen.step().unwrap();
    }
    assert!(plain.particles().eq(chosen.particles()));
    assert_eq!(plain.coordinates(), chosen.coordinates());
}

type AnyForceLaw = EitherLaw<HertzTsuji, EitherLaw<HertzMindlin, Silent>>;

/// A law by the name that a file gives it.
fn named(law: &str) -> Option<AnyForceLaw> {
    let acrylic = Material::acrylic();
    Some(match law {
        "tsuji" => EitherLaw::First(HertzTsuji::new(acrylic)),
        "mindlin" => EitherLaw::Second(EitherLaw::First(HertzMindlin::new(acrylic))),
        "silent" => EitherLaw::Second(EitherLaw::Second(Silent)),
        _ => return None,
    })
}

#[test]
fn one_of_three_laws_is_chosen_by_name_to_the_bits_of_that_law() {
    fn end<L: ContactLaw>(law: L) -> Vec<Particle> {
        let builder = Damper::builder(Slot::paper(), law).particles(grains());
        let mut damper = builder.time_step(1e-5).build().unwrap();
        for _ in 0..5000 {
            damper.step().unwrap();
        }
        damper.particles().collect()
    }
    let chosen = ["tsuji", "mindlin", "silent"].map(|law| end(named(law).unwrap()));
    let acrylic = Material::acrylic();
    let own = [
        end(HertzTsuji::new(acrylic)),
        end(HertzMindlin::new(acrylic)),
        end(Silent),
    ];
    assert_eq!(chosen, own);
    assert!(named("hooke").is_none());
    assert!(own[0] != own[1] && own[1] != own[2]);
}

#[test]
fn dampers_of_unlike_make_are_driven_and_restored_in_one_list() {
    let strict = HertzTsuji::new(Material::acrylic());
    let impulses = RestitutionImpulse::new(Material::acrylic());
    let coarse = Damper::builder(Slot::paper(), impulses).time_step(1e-4);
    let fine = Damper::builder(Slot::paper(), strict).time_step(1e-5);
    let recorded = Recorded::new(fine.clone().particles(grains()).build().unwrap(), 5);
    let mut list: Vec<Box<dyn DrivenDamper>> = vec![
        Box::new(coarse.particles(grains()).build().unwrap()),
        Box::new(fine.particles(grains()).build().unwrap()),
        Box::new(recorded),
    ];
    let end = |n: u32| Motion::at(DVec3::X * 1e-4 * f64::from(n), DVec3::X * 0.1);
    let snapshots: Vec<_> = list.iter_mut().map(|damper| damper.snapshot()).collect();
    for (damper, start) in list.iter_mut().zip(&snapshots) {
        let drive = |damper: &mut dyn DrivenDamper| -> Vec<_> {
            let reactions = (1..=40).map(|n| damper.drive(end(n), 1e-3).unwrap());
            reactions.collect()
        };
        let first = drive(damper.as_mut());
        assert!(first.iter().any(|reaction| reaction.impulse != DVec3::ZERO));
        assert_eq!(damper.reaction(), first[39]);
        assert_eq!(damper.container(), end(40));
        assert!((damper.time() - 0.04).abs() < 1e-9);
        damper.restore(start).unwrap();
        assert_eq!(damper.time().to_bits(), start.time().to_bits());
        assert_eq!(drive(damper.as_mut()), first);
    }
    // What contacts remember under one law is nothing that another could go on with.
    let refused = list[0].restore(&snapshots[1]).unwrap_err();
    let law = RestoreError::OtherSetup {
        quantity: "contact law",
    };
    assert_eq!(refused, law);
}

/// Coefficients and memory that cannot be printed.
#[derive(Clone, Copy)]
struct Secret(f64);

#[derive(Clone, Copy, Default, PartialEq)]
struct Touched(bool);

struct Silent;

impl ContactLaw for Silent {
    type Kind = Forces;
    type Coefficients = Secret;

    fn coefficients(&self, _: &Bodies) -> Result<Secret, LawError> {
        Ok(Secret(1e4))
    }
}

impl ForceLaw for Silent {
    type Memory = Touched;

    fn force(&self, stiffness: &Secret, contact: &Contact, _: &Touched) -> ContactForce {
        ContactForce::new(stiffness.0 * contact.overlap, DVec3::ZERO)
    }

    fn advance(&self, _: &Secret, _: &Contact, _: &Touched) -> Touched {
        Touched(true)
    }
}

#[test]
fn laws_need_not_print_what_they_keep_and_dampers_print_all_the_same() {
    let build = || {
        let builder = Damper::builder(Slot::paper(), Silent).particles(grains());
        builder.time_step(1e-5).build().unwrap()
    };
    let text = format!("{:?} {:?}", build(), Recorded::new(build(), 0));
    assert!(text.starts_with("Damper { time: 0.0"), "{text}");
    assert!(
        text.contains("particles: 2") && text.contains("drives: 0"),
        "{text}"
    );
}
