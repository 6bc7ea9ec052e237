//! Bad days: what hosts and laws hand in by mistake is a typed error that says what and where, and the
//! damper goes on once it is restored.

use std::sync::{Arc, Mutex};

use glam::{DVec3, dvec3};
use particle_damper::{
    Bodies, Bound, Cause, Contact, ContactForce, ContactLaw, Cuboid, Damper, Driven, Filling,
    ForceLaw, Forces, HertzMindlin, HertzTsuji, ImpulseLaw, Impulses, LawError, LinkedCells, Load,
    Material, Motion, Mount, Observer, Particle, Partner, RestitutionImpulse, SingleDof, Skin,
    Slot, StepError, StepReport,
};

type Hosted<L> = Damper<Cuboid, L, Driven, Skin<LinkedCells>>;

fn hosted<L: ContactLaw>(law: L) -> Hosted<L> {
    let cavity = Cuboid::new(dvec3(0.03, 0.03, 0.03)).unwrap();
    let filling = Filling::new(2).with(20, Particle::new(3e-3, 0.2e-3).unwrap());
    Damper::builder(cavity, law)
        .particles(filling.fill(&cavity).unwrap())
        .time_step(1e-5)
        .build()
        .unwrap()
}

fn shaken(time: f64) -> Motion {
    let (sine, cosine) = (40.0 * time).sin_cos();
    Motion::at(
        dvec3(1.0, 2.0, 1.0) * (1e-3 * sine),
        dvec3(1.0, 2.0, 1.0) * (0.04 * cosine),
    )
}

fn still_at(position: DVec3) -> Motion {
    Motion::at(position, DVec3::ZERO)
}

/// Drives over `steps` intervals of a millisecond; returns the bits of the forces.
fn go_on<L: ContactLaw>(damper: &mut Hosted<L>, steps: u32) -> Vec<[u64; 3]> {
    let mut forces = Vec::new();
    for _ in 0..steps {
        let end = shaken(damper.time() + 1e-3);
        let reaction = damper.drive(end, 1e-3).unwrap();
        forces.push(reaction.impulse.to_array().map(f64::to_bits));
    }
    forces
}

/// That `mistake` is an error, after which the damper goes on from its snapshot as if nothing had
/// happened.
fn survives<L: ContactLaw>(
    law: L,
    mistake: impl Fn(&mut Hosted<L>) -> Result<(), StepError>,
) -> StepError {
    let mut damper = hosted(law);
    go_on(&mut damper, 30);
    let before = damper.snapshot();
    let expected = go_on(&mut damper, 20);
    damper.restore(&before).unwrap();
    let error = mistake(&mut damper).unwrap_err();
    damper.restore(&before).unwrap();
    assert_eq!(go_on(&mut damper, 20), expected, "after {error}");
    error
}

/// The mistake under a law that remembers, one that does not, and one of impulses.
fn survives_under_every_law(
    mistake: fn(Motion) -> (Motion, f64),
    is_right: impl Fn(&StepError) -> bool,
) {
    let material = Material::acrylic;
    let errors = [
        survives(HertzMindlin::new(material()), |damper| {
            let (end, interval) = mistake(damper.container(0).unwrap());
            damper.drive(end, interval).map(|_| ())
        }),
        survives(HertzTsuji::new(material()), |damper| {
            let (end, interval) = mistake(damper.container(0).unwrap());
            damper.drive(end, interval).map(|_| ())
        }),
        survives(RestitutionImpulse::new(material()), |damper| {
            let (end, interval) = mistake(damper.container(0).unwrap());
            damper.drive(end, interval).map(|_| ())
        }),
    ];
    for error in errors {
        assert!(is_right(&error), "{error:?}");
    }
}

#[test]
fn a_host_that_hands_in_nan_is_told_so() {
    survives_under_every_law(
        |now| {
            let mut end = now;
            end.position.x = f64::NAN;
            (end, 1e-3)
        },
        |error| matches!(error, StepError::Container { cavity: 0, position, .. } if position.x.is_nan()),
    );
    survives_under_every_law(
        |now| {
            let mut end = now;
            end.velocity.z = f64::NEG_INFINITY;
            (end, 1e-3)
        },
        |error| matches!(error, StepError::Container { velocity, .. } if velocity.z < 0.0),
    );
}

#[test]
fn time_that_runs_backwards_or_stands_still_is_refused() {
    for (interval, mistake) in [
        (-1e-3, (|now| (now, -1e-3)) as fn(Motion) -> (Motion, f64)),
        (0.0, |now| (now, 0.0)),
        (f64::NAN, |now| (now, f64::NAN)),
        (f64::INFINITY, |now| (now, f64::INFINITY)),
    ] {
        survives_under_every_law(mistake, |error| match error {
            StepError::Value(value) => {
                value.quantity == "interval (s)"
                    && value.value.to_bits() == interval.to_bits()
                    && value.bound == Bound::Positive
            }
            _ => false,
        });
    }
}

/// A metre away within one step.
fn leap<L: ContactLaw>(damper: &mut Hosted<L>, way: DVec3) -> Result<(), StepError> {
    let end = still_at(damper.container(0).unwrap_or_default().position + way);
    damper.drive(end, 1e-5).map(|_| ())
}

#[test]
fn a_container_moved_by_a_metre_in_one_step_leaves_its_particles_behind() {
    for way in [DVec3::X, DVec3::NEG_Y, DVec3::Z, DVec3::ONE] {
        let material = Material::acrylic;
        for error in [
            survives(HertzMindlin::new(material()), |damper| leap(damper, way)),
            survives(HertzTsuji::new(material()), |damper| leap(damper, way)),
            survives(RestitutionImpulse::new(material()), |damper| {
                leap(damper, way)
            }),
        ] {
            match error {
                StepError::Escaped {
                    particle, position, ..
                } => assert!(particle < 20 && position.length() > 0.9, "{error}"),
                StepError::Jump { off, .. } => assert!(off > 0.9, "{error}"),
                _ => panic!("{error:?}"),
            }
        }
    }
}

/// A linear spring that answers with NaN between two particles, or at a wall, when told to.
#[derive(Debug, Clone)]
struct Spring {
    fails_at: Arc<Mutex<Option<bool>>>,
}

/// An impulse law whose friction is none of a number, likewise.
#[derive(Debug, Clone)]
struct Rub(Spring);

impl ContactLaw for Rub {
    type Kind = Impulses;
    type Coefficients = bool;

    fn coefficients(&self, bodies: &Bodies) -> Result<bool, LawError> {
        self.0.coefficients(bodies)
    }
}

impl ImpulseLaw for Rub {
    fn restitution(&self, _: &bool, _approach_speed: f64) -> f64 {
        0.5
    }

    fn friction(&self, at_wall: &bool) -> f64 {
        if *self.0.fails_at.lock().unwrap() == Some(*at_wall) {
            f64::NAN
        } else {
            0.2
        }
    }
}

impl ContactLaw for Spring {
    type Kind = Forces;
    type Coefficients = bool;

    fn coefficients(&self, bodies: &Bodies) -> Result<bool, LawError> {
        Ok(bodies.at_wall())
    }
}

impl ForceLaw for Spring {
    type Memory = ();

    fn force(&self, at_wall: &bool, contact: &Contact, (): &()) -> ContactForce {
        if *self.fails_at.lock().unwrap() == Some(*at_wall) {
            return ContactForce::new(f64::NAN, DVec3::ZERO);
        }
        ContactForce::new(300.0 * contact.overlap.max(0.0), DVec3::ZERO)
    }
}

/// Steps on until the law fails at two particles, or at a wall.
fn fails<L: ContactLaw>(law: L, fails_at: &Arc<Mutex<Option<bool>>>, at_wall: bool) -> StepError {
    survives(law, |damper| {
        *fails_at.lock().unwrap() = Some(at_wall);
        // Sooner or later something touches.
        let outcome = (0..5000).try_for_each(|_| damper.step());
        *fails_at.lock().unwrap() = None;
        outcome
    })
}

#[test]
fn a_law_that_returns_nan_is_named_by_the_particle_it_was_asked_for() {
    for at_wall in [false, true] {
        let fails_at = Arc::default();
        let law = Spring { fails_at };
        let switch = law.fails_at.clone();
        for error in [
            fails(law.clone(), &switch, at_wall),
            fails(Rub(law), &switch, at_wall),
        ] {
            let StepError::NotFinite {
                particle,
                acceleration,
                ..
            } = error
            else {
                panic!("{error:?}")
            };
            assert!(particle < 20 && acceleration.is_nan(), "{error}");
        }
    }
}

/// A mount whose solver breaks down.
struct Broken;

impl Mount for Broken {
    fn degrees(&self) -> usize {
        1
    }

    fn motion(&self, _time: f64, x: &[f64], v: &[f64], _cavity: usize) -> Motion {
        Motion::at(DVec3::Y * x[0], DVec3::Y * v[0])
    }

    fn accelerate(&self, time: f64, _: &[f64], _: &[f64], loads: &[Load], a: &mut [f64]) {
        a[0] = if time > 1e-3 {
            f64::NAN
        } else {
            loads[0].force.y
        };
    }
}

#[test]
fn a_mount_that_returns_nan_is_told_so_within_two_steps() {
    let cavity = Cuboid::new(DVec3::splat(0.03)).unwrap();
    let particle = Particle::new(3e-3, 0.2e-3).unwrap().at(DVec3::splat(0.015));
    let mut damper = Damper::builder(cavity, HertzTsuji::new(Material::acrylic()))
        .mount(Broken)
        .particles([particle])
        .time_step(1e-5)
        .build()
        .unwrap();
    let error = loop {
        if let Err(error) = damper.step() {
            break error;
        }
    };
    assert!(matches!(error, StepError::Mount { coordinate: 0, .. }));
    assert!(damper.time() < 1.03e-3);
}

#[test]
fn two_bodies_pressed_into_each_other_are_named() {
    let cavity = Cuboid::new(DVec3::splat(0.03)).unwrap();
    let particle = |x: f64, speed: f64| {
        let particle = Particle::new(3e-3, 0.2e-3).unwrap();
        particle.at(dvec3(x, 0.015, 0.015)).moving(DVec3::X * speed)
    };
    let soft = Spring {
        fails_at: Arc::default(),
    };
    let mut damper = Damper::builder(cavity, soft)
        .particles([particle(0.01, 3.0), particle(0.02, -3.0)])
        .time_step(1e-5)
        .build()
        .unwrap();
    let error = loop {
        if let Err(error) = damper.step() {
            break error;
        }
    };
    let StepError::Overlap {
        particle,
        other,
        overlap,
        limit,
        cause: Cause::Unknown { .. },
    } = error
    else {
        panic!("{error:?}")
    };
    assert_eq!((particle, other), (0, Partner::Particle(1)));
    assert!(overlap > limit && (limit - 0.7 * 3e-3).abs() < 1e-15);
}

/// A host that iterates finds the same end of a step however often it went back.
#[test]
fn a_step_taken_back_leaves_no_trace() {
    let mut damper = hosted(HertzMindlin::new(Material::acrylic()));
    let mut straight = hosted(HertzMindlin::new(Material::acrylic()));
    for _ in 0..40 {
        let end = shaken(damper.time() + 1e-3);
        let before = damper.snapshot();
        for guess in [0.5, 0.9, 1.3] {
            damper.drive(still_at(end.position * guess), 1e-3).unwrap();
            damper.restore(&before).unwrap();
        }
        let reaction = damper.drive(end, 1e-3).unwrap();
        assert_eq!(reaction, straight.drive(end, 1e-3).unwrap());
    }
    assert_eq!(damper.snapshot(), straight.snapshot());
}

/// Counts steps.
#[derive(Default)]
struct Steps(u64);

impl Observer for Steps {
    fn step(&mut self, _report: &StepReport<'_>) {
        self.0 += 1;
    }
}

/// A host that hands in differences of its times got a step more in a third of its calls at 10 s, and
/// other bits at every time of day.
#[test]
fn the_steps_of_an_interval_do_not_depend_on_when_it_begins() {
    fn run<L: ContactLaw + Clone>(law: &L, begin: f64, to: bool) -> Vec<[u64; 3]> {
        let filling = Filling::new(2).with(20, Particle::new(3e-3, 0.2e-3).unwrap());
        let cavity = Cuboid::new(DVec3::splat(0.03)).unwrap();
        let mut damper = Damper::builder(cavity, law.clone())
            .particles(filling.fill(&cavity).unwrap())
            .time_step(1e-5)
            .start_time(begin)
            .build()
            .unwrap();
        let mut bits = Vec::new();
        let mut last = begin;
        for call in 1..=200 {
            let time = begin + f64::from(call) * 1e-4;
            let (end, mut steps) = (shaken(f64::from(call) * 1e-4), Steps::default());
            let reaction = if to {
                damper.drive_to_watched(end, time, &mut steps)
            } else {
                damper.drive_watched(end, time - last, &mut steps)
            };
            assert_eq!(steps.0, 10, "from {last} to {time}");
            assert!((damper.time() - time).abs() <= 4e-9);
            bits.push(reaction.unwrap().impulse.to_array().map(f64::to_bits));
            last = time;
        }
        bits
    }
    fn at_any_time<L: ContactLaw + Clone>(law: &L) {
        let expected = run(law, 0.0, false);
        for begin in [0.0, 10.0, 86_400.0, 1e7 - 1.0] {
            assert_eq!(run(law, begin, false), expected, "from {begin}");
            assert_eq!(run(law, begin, true), expected, "to a time from {begin}");
        }
    }
    at_any_time(&HertzTsuji::new(Material::acrylic()));
    at_any_time(&RestitutionImpulse::new(Material::acrylic()));
}

#[test]
fn a_time_that_has_passed_is_refused() {
    let mut damper = hosted(HertzTsuji::new(Material::acrylic()));
    damper.drive_to(shaken(1e-4), 1e-4).unwrap();
    for time in [1e-4, 0.0, f64::NAN] {
        let error = damper.drive_to(shaken(1e-4), time).unwrap_err();
        assert!(
            error
                .to_string()
                .starts_with("time (s) must be finite and above 0.0001")
        );
    }
}

/// Largest displacement of a mass on a spring within a second, bed of `grains` solved together with it.
fn swing_together(mass: f64, stiffness: f64, grains: &[Particle]) -> f64 {
    let mount = SingleDof::new(mass, 0.0, stiffness).unwrap();
    let mut damper = Damper::builder(Slot::paper(), RestitutionImpulse::new(Material::acrylic()))
        .mount(mount.released_from(0.0, 0.4).unwrap())
        .particles(grains.iter().copied())
        .time_step(1e-4)
        .build()
        .unwrap();
    let mut top = 0.0_f64;
    while damper.time() < 1.0 {
        damper.step().unwrap();
        top = top.max(damper.coordinates()[0].abs());
    }
    top
}

/// A host of a twentieth of its bed's mass finds the impulse by relaxation (the guide's iteration), and
/// swings as the same structure does when it is solved together with the bed.
#[test]
fn a_host_far_lighter_than_its_bed_converges_by_relaxation() {
    let filling = Filling::new(1).with(30, Particle::new(3e-3, 0.2e-3).unwrap());
    let grains = filling.fill(&Slot::paper()).unwrap();
    let bed = 30.0 * 0.2e-3;
    for ratio in [0.1, 1.0, 5.0, 20.0] {
        let mass = bed / ratio;
        let stiffness = 1400.0 * (mass + bed);
        let law = RestitutionImpulse::new(Material::acrylic());
        let mut damper = Damper::builder(Slot::paper(), law)
            .particles(grains.iter().copied())
            .time_step(1e-4)
            .build()
            .unwrap();
        let (mut x, mut v, mut impulse, mut top) = (0.0, 0.4, 0.0, 0.0_f64);
        let mut interval = 1e-3_f64;
        while damper.time() < 1.0 {
            let before = damper.snapshot();
            let (mut relaxation, mut last) = (1.0 / (1.0 + ratio), None);
            let converged = (0..20).any(|_| {
                let q = 0.25 * stiffness * interval * interval / mass;
                let gain = (impulse - stiffness * x * interval) / mass;
                let end_v = (v * (1.0 - q) + gain) / (1.0 + q);
                let end_x = x + 0.5 * interval * (v + end_v);
                let end = Motion::at(DVec3::Y * end_x, DVec3::Y * end_v);
                let error = damper.drive(end, interval).unwrap().impulse.y - impulse;
                if error.abs() < 1e-6 * (mass + bed) {
                    (x, v) = (end_x, end_v);
                    return true;
                }
                damper.restore(&before).unwrap();
                if let Some(last) = last {
                    let aitken: f64 = relaxation * last / (last - error);
                    relaxation = aitken.clamp(0.5 / (1.0 + ratio), 1.0);
                }
                last = Some(error);
                impulse += relaxation * error;
                false
            });
            if converged {
                top = top.max(x.abs());
                interval = (2.0 * interval).min(1e-3);
            } else {
                interval *= 0.5;
                assert!(interval > 1e-5, "m/M = {ratio} at {} s", damper.time());
            }
        }
        let together = swing_together(mass, stiffness, &grains);
        assert!(
            (top / together - 1.0).abs() < 0.03,
            "m/M = {ratio}: {top} m, {together} m together"
        );
    }
}
