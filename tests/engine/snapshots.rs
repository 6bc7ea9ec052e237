//! Snapshots: written, read in another process, damaged, and put into the wrong damper.
#![cfg(feature = "serde")]
#![allow(clippy::unwrap_used)]

use std::process::Command;

use glam::DVec3;
use particle_damper::excitation::Harmonic;
use particle_damper::{
    AnySnapshot, Bodies, Builder, CellGrid, Contact, ContactForce, ContactLaw, ContactMemory,
    Damper, Detector, DrivenDamper, EitherLaw, Filling, ForceLaw, Forces, HertzMindlin, HertzTsuji,
    Integrator, Interaction, LawError, Material, Motion, Particle, Recorded, Recording,
    ReplayError, RestitutionImpulse, RestoreError, RungeKutta4, SingleDof, Slot, Snapshot,
    TangentialSpring,
};
use serde_json::{Value, json};

type Mount = SingleDof<Harmonic>;

fn bed() -> Vec<Particle> {
    let particle = Particle::new(3e-3, 0.2e-3).unwrap();
    let small = Particle::new(2e-3, 0.06e-3).unwrap();
    let filling = Filling::new(5).with(8, particle).with(6, small);
    filling.fill(&Slot::paper()).unwrap()
}

fn builder<L: ContactLaw>(law: L) -> Builder<Slot, L, Mount> {
    let excitation = Harmonic::new(0.25, 6.0).unwrap();
    Damper::builder(Slot::paper(), law)
        .mount(SingleDof::paper().excited_by(excitation))
        .particles(bed())
        .time_step(1e-5)
}

fn damper() -> Damper<Slot, HertzMindlin, Mount, CellGrid, RungeKutta4> {
    let grid = CellGrid::paper();
    let builder = builder(HertzMindlin::new(Material::acrylic()));
    let builder = builder.detector(grid).integrator(RungeKutta4::default());
    builder.build().unwrap()
}

/// Everything that a run has to reproduce, bit by bit.
fn bits<L, D, I>(damper: &Damper<Slot, L, Mount, D, I>) -> Vec<u64>
where
    L: ContactLaw,
    D: Detector,
    I: Integrator,
{
    let state = damper
        .particles()
        .flat_map(|p| [p.position, p.velocity, p.spin]);
    let numbers = state.flat_map(|vector| vector.to_array());
    let mount = [damper.time(), damper.coordinates()[0], damper.rates()[0]];
    numbers.chain(mount).map(f64::to_bits).collect()
}

/// A bed at rest on its floor, with springs stretched in its contacts.
fn settled() -> Snapshot<TangentialSpring> {
    let mut damper = damper();
    for _ in 0..16000 {
        damper.step().unwrap();
    }
    assert!(damper.contacts() > 5, "contacts are part of the state");
    damper.snapshot()
}

fn on_from(snapshot: &Snapshot<TangentialSpring>) -> Vec<u64> {
    let mut damper = damper();
    damper.restore(snapshot).unwrap();
    for _ in 0..6000 {
        damper.step().unwrap();
    }
    bits(&damper)
}

const HANDED_OVER: &str = "PARTICLE_DAMPER_SNAPSHOT";

/// The other process of the test below; by itself it does nothing.
#[test]
fn child_process() {
    if let Ok(path) = std::env::var(HANDED_OVER) {
        let written = std::fs::read(format!("{path}.postcard")).unwrap();
        let snapshot = postcard::from_bytes(&written).unwrap();
        let end = serde_json::to_vec(&on_from(&snapshot)).unwrap();
        std::fs::write(format!("{path}.end"), end).unwrap();
    }
}

#[test]
fn a_new_process_goes_on_to_the_same_bits() {
    let snapshot = settled();
    let mut straight = damper();
    straight.restore(&snapshot).unwrap();
    for _ in 0..6000 {
        straight.step().unwrap();
    }
    let path = std::env::temp_dir().join(format!("particle-damper-{}", std::process::id()));
    let path = path.to_str().unwrap();
    let written = postcard::to_stdvec(&snapshot).unwrap();
    std::fs::write(format!("{path}.postcard"), written).unwrap();
    let status = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "snapshots::child_process"])
        .env(HANDED_OVER, path)
        .status()
        .unwrap();
    assert!(status.success());
    let end: Vec<u64> =
        serde_json::from_slice(&std::fs::read(format!("{path}.end")).unwrap()).unwrap();
    for ending in ["postcard", "end"] {
        std::fs::remove_file(format!("{path}.{ending}")).unwrap();
    }
    assert_eq!(end, bits(&straight));
}

/// Dampers of unlike make, whose contacts remember different things: springs, the better part of an impulse,
/// what the chosen one of two laws does, and what a law of another crate does.
fn fleet() -> Vec<Box<dyn DrivenDamper>> {
    fn driven<L: ContactLaw>(law: L) -> Damper<Slot, L> {
        let builder = Damper::builder(Slot::paper(), law).particles(bed());
        builder.time_step(1e-5).build().unwrap()
    }
    let acrylic = Material::acrylic();
    let chosen: EitherLaw<HertzMindlin, HertzTsuji> = EitherLaw::Second(HertzTsuji::new(acrylic));
    vec![
        Box::new(driven(HertzMindlin::new(acrylic))),
        Box::new(driven(RestitutionImpulse::new(acrylic))),
        Box::new(driven(chosen)),
        Box::new(Recorded::new(driven(Ageing { recalls: true }), 10)),
    ]
}

/// A spring that stiffens with the steps of a contact, which it counts.
struct Ageing {
    /// Whether a memory can be had back from its numbers.
    recalls: bool,
}

#[derive(Clone, Copy, Default, PartialEq)]
struct Age(u32);

impl ContactLaw for Ageing {
    type Kind = Forces;
    type Coefficients = ();

    fn coefficients(&self, _: &Bodies) -> Result<(), LawError> {
        Ok(())
    }
}

impl ForceLaw for Ageing {
    type Memory = Age;

    fn force(&self, (): &(), contact: &Contact, age: &Age) -> ContactForce {
        let stiffness = 2000.0 + f64::from(age.0.min(500));
        let damping = 0.1 * contact.approach_speed();
        ContactForce::new(
            (stiffness * contact.overlap + damping).max(0.0),
            DVec3::ZERO,
        )
    }

    fn advance(&self, (): &(), _: &Contact, age: &Age) -> Age {
        Age(age.0.saturating_add(1))
    }

    fn tell_memory(&self, age: &Age, tell: &mut dyn FnMut(f64)) {
        tell(f64::from(age.0));
    }

    fn recall_memory(&self, told: &mut dyn Iterator<Item = f64>) -> Option<Age> {
        let age = told.next()?;
        self.recalls.then_some(Age(age as u32))
    }
}

/// Drives each damper on by `drives` milliseconds; the bits of what it does to its container.
fn drive_all(fleet: &mut [Box<dyn DrivenDamper>], drives: u32) -> Vec<u64> {
    let mut bits = Vec::new();
    for damper in fleet {
        for _ in 0..drives {
            let next = damper.time() + 1e-3;
            let (sine, cosine) = (40.0 * next).sin_cos();
            let end = Motion::at(DVec3::Y * (5e-3 * sine), DVec3::Y * (0.2 * cosine));
            let reaction = damper.drive_to(end, next).unwrap();
            let numbers = [reaction.force, reaction.impulse].map(|vector| vector.to_array());
            bits.extend(numbers.as_flattened().iter().map(|number| number.to_bits()));
        }
    }
    bits
}

const FLEET_HANDED_OVER: &str = "PARTICLE_DAMPER_FLEET";

/// The other process of the test below; by itself it does nothing.
#[test]
fn child_process_with_a_fleet() {
    if let Ok(path) = std::env::var(FLEET_HANDED_OVER) {
        let written = std::fs::read(format!("{path}.fleet")).unwrap();
        let snapshots: Vec<AnySnapshot> = postcard::from_bytes(&written).unwrap();
        let mut fleet = fleet();
        for (damper, snapshot) in fleet.iter_mut().zip(&snapshots) {
            damper.restore(snapshot).unwrap();
        }
        let end = serde_json::to_vec(&drive_all(&mut fleet, 60)).unwrap();
        std::fs::write(format!("{path}.fleet-end"), end).unwrap();
    }
}

#[test]
fn a_new_process_goes_on_with_dampers_of_unlike_make_to_the_same_bits() {
    let mut fleet = fleet();
    drive_all(&mut fleet, 200);
    let snapshots: Vec<AnySnapshot> = fleet.iter_mut().map(|own| own.snapshot()).collect();
    let path = std::env::temp_dir().join(format!("particle-damper-{}", std::process::id()));
    let path = path.to_str().unwrap();
    let written = postcard::to_stdvec(&snapshots).unwrap();
    std::fs::write(format!("{path}.fleet"), &written).unwrap();
    let status = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "snapshots::child_process_with_a_fleet"])
        .env(FLEET_HANDED_OVER, path)
        .status()
        .unwrap();
    assert!(status.success());
    let end = std::fs::read(format!("{path}.fleet-end")).unwrap();
    let end: Vec<u64> = serde_json::from_slice(&end).unwrap();
    for ending in ["fleet", "fleet-end"] {
        std::fs::remove_file(format!("{path}.{ending}")).unwrap();
    }
    assert_eq!(end, drive_all(&mut fleet, 60));

    // What was read is written as what was taken, and fits no damper of another law.
    let read: Vec<AnySnapshot> = postcard::from_bytes(&written).unwrap();
    assert_eq!(postcard::to_stdvec(&read).unwrap(), written);
    for (read, taken) in read.iter().zip(&snapshots) {
        assert_eq!(read.time().to_bits(), taken.time().to_bits());
    }
    let law = RestoreError::OtherSetup {
        quantity: "contact law",
    };
    assert_eq!(fleet[0].restore(&read[1]).unwrap_err(), law);
}

#[test]
fn a_snapshot_of_any_law_that_was_changed_on_the_way_is_refused() {
    let mut fleet = fleet();
    drive_all(&mut fleet, 200);
    for damper in &mut fleet {
        let value = serde_json::to_value(damper.snapshot()).unwrap();
        let refused = |damage: fn(&mut Vec<Value>), damper: &mut dyn DrivenDamper| {
            let mut value = value.clone();
            damage(value["told"].as_array_mut().unwrap());
            let snapshot: AnySnapshot = serde_json::from_value(value).unwrap();
            damper.restore(&snapshot).unwrap_err()
        };
        assert!(!value["told"].as_array().unwrap().is_empty());
        let damaged = RestoreError::Damaged {
            quantity: "contacts",
        };
        let change = |told: &mut Vec<Value>| told[0] = json!(told[0].as_f64().unwrap() + 1.0);
        assert_eq!(refused(change, damper.as_mut()), RestoreError::Changed);
        let lose = |told: &mut Vec<Value>| drop(told.pop());
        assert_eq!(refused(lose, damper.as_mut()), damaged);
        let add = |told: &mut Vec<Value>| told.push(json!(0.0));
        assert_eq!(refused(add, damper.as_mut()), damaged);
    }
}

#[test]
fn a_snapshot_whose_memories_cannot_be_had_back_is_not_written() {
    let law = Ageing { recalls: false };
    let builder = Damper::builder(Slot::paper(), law).particles(bed());
    let damper: Box<dyn DrivenDamper> = Box::new(builder.time_step(1e-5).build().unwrap());
    let mut fleet = [damper];
    drive_all(&mut fleet, 200);
    let snapshot = fleet[0].snapshot();
    let error = serde_json::to_value(&snapshot).unwrap_err().to_string();
    assert!(error.contains("ForceLaw::recall_memory"), "{error}");
    let first = drive_all(&mut fleet, 20);
    fleet[0].restore(&snapshot).unwrap();
    assert_eq!(drive_all(&mut fleet, 20), first, "it can be gone back to");
}

#[test]
fn restoring_is_the_same_as_never_having_stopped() {
    let mut through = damper();
    for _ in 0..16000 {
        through.step().unwrap();
    }
    let snapshot = through.snapshot();
    for _ in 0..6000 {
        through.step().unwrap();
    }
    let text = serde_json::to_string(&snapshot).unwrap();
    let read: Snapshot<TangentialSpring> = serde_json::from_str(&text).unwrap();
    assert_eq!(read, snapshot);
    assert_eq!(on_from(&read), bits(&through));
}

#[test]
fn contact_memory_is_part_of_the_state() {
    let mut forgetful = serde_json::to_value(settled()).unwrap();
    forgetful["memory"] = json!([[], []]);
    let forgetful: Snapshot<TangentialSpring> = serde_json::from_value(forgetful).unwrap();
    let error = damper().restore(&forgetful).unwrap_err();
    assert_eq!(error, RestoreError::Changed);
}

/// Rounds every number as a format does that keeps sixteen digits of them.
fn rounded(value: &mut Value) {
    match value {
        Value::Number(number) if number.is_f64() => {
            let short = format!("{:.15e}", number.as_f64().unwrap());
            *value = json!(short.parse::<f64>().unwrap());
        }
        Value::Array(values) => values.iter_mut().for_each(rounded),
        Value::Object(entries) => entries.values_mut().for_each(rounded),
        _ => {}
    }
}

/// A format without exact numbers was restored to other bits without complaint.
#[test]
fn a_snapshot_changed_on_the_way_is_refused() {
    let snapshot = settled();
    let mut value = serde_json::to_value(&snapshot).unwrap();
    let exact: Snapshot<TangentialSpring> = serde_json::from_value(value.clone()).unwrap();
    let mut damper = damper();
    damper.restore(&exact).unwrap();
    let before = bits(&damper);
    rounded(&mut value);
    let snapshot: Snapshot<TangentialSpring> = serde_json::from_value(value).unwrap();
    let error = damper.restore(&snapshot).unwrap_err();
    assert_eq!(error, RestoreError::Changed);
    assert!(error.to_string().contains("float_roundtrip"));
    assert_eq!(bits(&damper), before, "a refused snapshot changes nothing");
}

/// The error on restoring a settled snapshot after `damage` was done to it.
fn refused(damage: impl FnOnce(&mut Value)) -> RestoreError {
    let mut damper = damper();
    let before = bits(&damper);
    let mut value = serde_json::to_value(damper.snapshot()).unwrap();
    damage(&mut value);
    let snapshot: Snapshot<TangentialSpring> = serde_json::from_value(value).unwrap();
    let error = damper.restore(&snapshot).unwrap_err();
    assert_eq!(bits(&damper), before, "a refused snapshot changes nothing");
    damper.step().unwrap();
    error
}

#[test]
fn another_version_is_refused() {
    let error = refused(|value| value["state"]["version"] = json!(7));
    assert_eq!(
        error.to_string(),
        "the snapshot has layout 7, this version of the library reads 3"
    );
}

#[test]
fn damage_is_refused_and_named() {
    let damaged = |quantity| RestoreError::Damaged { quantity };
    let error = refused(|value| value["state"]["number"][3] = json!(4_000_000_000_u32));
    assert_eq!(error, damaged("particle numbers"));
    let error = refused(|value| value["state"]["number"][3] = value["state"]["number"][4].clone());
    assert_eq!(error, damaged("particle numbers"));
    let error = refused(|value| value["state"]["species"][0] = json!(9));
    assert_eq!(error, damaged("species"));
    let error = refused(|value| value["state"]["clock"]["steps"] = json!(u64::MAX));
    assert_eq!(error, damaged("clock"));
    let spring = serde_json::to_value(TangentialSpring::default()).unwrap();
    for (first, second) in [(3, 3), (0, 14), (5, 2)] {
        let contact = json!({"first": first, "second": second, "memory": spring});
        let error = refused(|value| value["memory"] = json!([[contact], []]));
        assert_eq!(error, damaged("contacts"), "{first} {second}");
    }
    for column in ["position", "spin", "angular_acceleration", "species"] {
        let error = refused(|value| {
            value["state"][column].as_array_mut().unwrap().pop();
        });
        assert!(
            matches!(
                error,
                RestoreError::Mismatch {
                    expected: 14,
                    found: 13,
                    ..
                }
            ),
            "{column}: {error}"
        );
    }
    let error = refused(|value| value["state"]["mount"]["velocity"] = json!([]));
    assert!(matches!(error, RestoreError::Mismatch { found: 0, .. }));
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let mut damper = damper();
    let written = postcard::to_stdvec(&damper.snapshot()).unwrap();
    let particle = damper.particle(0).unwrap();
    let from = particle.position.x.to_le_bytes();
    let place = written.windows(8).position(|part| part == from).unwrap();
    let mut bad = written.clone();
    bad[place..place + 8].copy_from_slice(&f64::NAN.to_le_bytes());
    let snapshot = postcard::from_bytes(&bad).unwrap();
    let error = damper.restore(&snapshot).unwrap_err();
    assert_eq!(
        error,
        RestoreError::Damaged {
            quantity: "positions"
        }
    );
}

#[test]
fn no_broken_byte_goes_unnoticed() {
    let mut damper = damper();
    for _ in 0..2000 {
        damper.step().unwrap();
    }
    let written = postcard::to_stdvec(&damper.snapshot()).unwrap();
    for place in 0..written.len() {
        for flip in [0x01, 0x80, 0xFF] {
            let mut bad = written.clone();
            bad[place] ^= flip;
            if let Ok(snapshot) = postcard::from_bytes::<Snapshot<TangentialSpring>>(&bad)
                && damper.restore(&snapshot).is_ok()
            {
                panic!("byte {place} changed by {flip:#x} is not noticed");
            }
        }
    }
    for length in 0..written.len() {
        let cut = postcard::from_bytes::<Snapshot<TangentialSpring>>(&written[..length]);
        assert!(cut.is_err(), "{length} bytes are too few");
    }
}

#[test]
fn another_setup_is_refused_and_named() {
    let law = || RestitutionImpulse::new(Material::acrylic());
    let snapshot = builder(law()).build().unwrap().snapshot();
    let refused = |builder: Builder<Slot, RestitutionImpulse, Mount>| {
        let mut damper = builder.build().unwrap();
        damper.restore(&snapshot).unwrap_err().to_string()
    };
    let other = "the snapshot is of a damper with another ";
    assert_eq!(
        refused(builder(law()).time_step(5e-6)),
        format!("{other}time step")
    );
    assert_eq!(
        refused(builder(law()).gravity(DVec3::ZERO)),
        format!("{other}gravity")
    );
    let mut soft = Material::acrylic();
    soft.interaction = Interaction::new(0.6, 0.2).unwrap();
    let soft = RestitutionImpulse::new(soft);
    assert_eq!(refused(builder(soft)), format!("{other}contact law"));
    let lighter = SingleDof::new(0.08, 0.08, 123.4).unwrap();
    let lighter = lighter.excited_by(Harmonic::new(0.25, 6.0).unwrap());
    assert_eq!(
        refused(builder(law()).mount(lighter)),
        format!("{other}mount")
    );
    let wider = Slot::new(0.097, 0.06).unwrap();
    let wider = Damper::builder(wider, law())
        .mount(SingleDof::paper())
        .particles(bed())
        .time_step(2e-5);
    let error = wider.build().unwrap().restore(&snapshot).unwrap_err();
    assert_eq!(
        error,
        RestoreError::OtherSetup {
            quantity: "set of cavities"
        }
    );
}

#[test]
fn a_settled_bed_starts_a_run_at_another_frequency() {
    let law = RestitutionImpulse::new(Material::acrylic());
    let snapshot = builder(law.clone()).build().unwrap().snapshot();
    let faster = SingleDof::paper().excited_by(Harmonic::new(0.25, 7.0).unwrap());
    let mut damper = builder(law).mount(faster).build().unwrap();
    damper.restore(&snapshot).unwrap();
    damper.step().unwrap();
}

/// A session with a step taken back, a mistake and a way out of it, written and read as one file.
#[test]
fn a_session_of_a_host_is_replayed_from_one_file() {
    fn session<L: ContactLaw + Clone>(law: &L)
    where
        ContactMemory<L>: serde::Serialize + serde::de::DeserializeOwned,
    {
        let build = || {
            Damper::builder(Slot::paper(), law.clone())
                .particles(bed())
                .time_step(1e-5)
                .build()
                .unwrap()
        };
        let at = |time: f64| {
            let (sine, cosine) = (40.0 * time).sin_cos();
            Motion::at(DVec3::Y * (5e-3 * sine), DVec3::Y * (0.2 * cosine))
        };
        let mut host = Recorded::new(build(), 7);
        let mut time = 0.0;
        for step in 0..180 {
            let before = host.snapshot();
            // A guess that is taken back, every third time.
            if step % 3 == 0 {
                host.drive(at(time + 2e-3), 1e-3).unwrap();
                host.restore(&before).unwrap();
            }
            time += 1e-3;
            host.drive_to(at(time), time).unwrap();
            if step == 40 {
                let good = host.snapshot();
                let far = Motion::at(DVec3::Y, DVec3::ZERO);
                assert!((0..2).any(|_| host.drive(far, 1e-5).is_err()));
                host.restore(&good).unwrap();
            }
        }
        assert!(host.recording().drives() >= 241);
        let file = postcard::to_stdvec(host.recording()).unwrap();
        let recording: Recording<ContactMemory<L>> = postcard::from_bytes(&file).unwrap();
        let mut again = build();
        assert_eq!(recording.replay(&mut again), Ok(None));
        assert_eq!(again.snapshot(), host.damper().snapshot());

        // Another input in the midst of it parts the bits there.
        let mut value = serde_json::to_value(&recording).unwrap();
        let events = value["events"].as_array_mut().unwrap();
        let mut drives = events
            .iter_mut()
            .filter(|event| event.get("Drive").is_some());
        let end = &mut drives.nth(199).unwrap()["Drive"]["end"]["velocity"][1];
        *end = json!(end.as_f64().unwrap() + 1e-6);
        let other: Recording<ContactMemory<L>> = serde_json::from_value(value).unwrap();
        let error = other.replay(&mut build()).unwrap_err();
        assert!(
            matches!(
                error,
                ReplayError::Parted {
                    drive: 200..=203,
                    ..
                }
            ),
            "{error}"
        );

        // So does another law, which the snapshot does not fit.
        let slower = Damper::builder(Slot::paper(), law.clone())
            .particles(bed())
            .time_step(9e-6)
            .build();
        let error = recording.replay(&mut slower.unwrap()).unwrap_err();
        assert!(matches!(error, ReplayError::Restore { drives: 0, .. }));
    }
    session(&HertzMindlin::new(Material::acrylic()));
    session(&RestitutionImpulse::new(Material::acrylic()));
}

/// Laws that print alike were taken for the same.
#[test]
fn laws_are_told_apart_by_what_they_do() {
    struct Spring {
        stiffness: f64,
    }
    impl ContactLaw for Spring {
        type Kind = Forces;
        type Coefficients = ();

        fn coefficients(&self, _: &Bodies) -> Result<(), LawError> {
            Ok(())
        }
    }
    impl ForceLaw for Spring {
        type Memory = ();

        fn force(&self, (): &(), contact: &Contact, (): &()) -> ContactForce {
            ContactForce::new(self.stiffness * contact.overlap, DVec3::ZERO)
        }
    }
    let damper = |stiffness| builder(Spring { stiffness }).build().unwrap();
    let snapshot = damper(1000.0).snapshot();
    assert_eq!(damper(1000.0).restore(&snapshot), Ok(()));
    let error = damper(1000.0_f64.next_up()).restore(&snapshot).unwrap_err();
    assert_eq!(
        error,
        RestoreError::OtherSetup {
            quantity: "contact law"
        }
    );
}
