//! A host that turns the container.

use particle_damper::glam::{DQuat, DVec3, dvec3};
use particle_damper::{
    Cuboid, Damper, Driven, Filling, LinkedCells, Motion, Particle, Recorded, Skin, Slot, StepError,
};

use super::*;

type Hosted<L> = Damper<Cuboid, L, Driven, Skin<LinkedCells>>;

fn swung(t: f64) -> Motion {
    let axis = dvec3(1.0, 0.5, 2.0).normalize();
    let (sine, cosine) = (40.0 * t).sin_cos();
    Motion::at(
        dvec3(3e-3, 1e-3, 0.0) * sine,
        dvec3(0.12, 0.04, 0.0) * cosine,
    )
    .turned(
        DQuat::from_axis_angle(axis, 0.5 * sine),
        axis * 20.0 * cosine,
    )
}

fn hosted<L: ContactLaw>(law: L, time_step: f64) -> Hosted<L> {
    let cavity = Cuboid::new(dvec3(0.03, 0.02, 0.03)).unwrap();
    let grains = Filling::new(2).with(15, Particle::new(3e-3, 0.2e-3).unwrap());
    let bed = grains.fill(&cavity).unwrap();
    Damper::builder(cavity, law)
        .mount(Driven::at(swung(0.0)))
        .particles(bed)
        .gravity(DVec3::ZERO)
        .time_step(time_step)
        .build()
        .unwrap()
}

/// What the container gets is what particles lose, momentum and angular momentum.
#[test]
fn reactions_are_what_particles_lost() {
    fn run<L: ContactLaw>(law: L, time_step: f64) {
        let mut damper = hosted(law, time_step);
        let mut largest = 0.0_f64;
        for _ in 0..100 {
            let end = swung(damper.time() + 1e-3);
            let before = [damper.momentum(), damper.angular_momentum(end.position)];
            let reaction = damper.drive(end, 1e-3).unwrap();
            let after = [damper.momentum(), damper.angular_momentum(end.position)];
            let off = after[0] - before[0] + reaction.impulse;
            assert!(off.length() < 1e-15, "{off} N s");
            let off = after[1] - before[1] + reaction.angular_impulse;
            assert!(off.length() < 1e-17, "{off} N m s");
            largest = largest.max(reaction.angular_impulse.length());
        }
        assert!(largest > 1e-7, "{largest} N m s");
    }
    run(tsuji(0.3), 2e-5);
    run(mindlin(0.3), 2e-5);
    run(impulses(0.3), 1e-4);
}

#[test]
fn a_turning_damper_is_restored_and_replayed_to_the_bit() {
    fn run<L: ContactLaw + Clone>(law: &L, time_step: f64) {
        let cavity: AnyCavity<'_> = &Slot::new(0.04, 0.03).unwrap();
        let grains = Filling::new(2).with(12, Particle::new(3e-3, 0.2e-3).unwrap());
        let path = |t: f64| {
            let (sine, cosine) = (50.0 * t).sin_cos();
            Motion::at(DVec3::X * 2e-3 * sine, DVec3::X * 0.1 * cosine)
                .turned_in_plane(0.4 * sine, 20.0 * cosine)
        };
        let build = || {
            Damper::builder(cavity, law.clone())
                .mount(Driven::at(path(0.0)))
                .particles(grains.fill(cavity).unwrap())
                .time_step(time_step)
                .build()
                .unwrap()
        };
        let mut host = Recorded::new(build(), 5);
        let go_on = |host: &mut Recorded<_, _, _, _>, count: usize| {
            let mut answers = Vec::new();
            for _ in 0..count {
                let time = host.damper().time() + 1e-3;
                answers.push(host.drive_to(path(time), time).unwrap());
            }
            answers
        };
        go_on(&mut host, 20);
        let before = host.snapshot();
        let expected = go_on(&mut host, 20);
        host.restore(&before).unwrap();
        assert_eq!(go_on(&mut host, 20), expected);
        assert_eq!(host.recording().replay(&mut build()).unwrap(), None);
    }
    run(&mindlin(0.4), 2e-5);
    run(&impulses(0.4), 1e-4);
}

#[test]
fn orientations_that_cannot_be_are_refused() {
    let mut damper = hosted(tsuji(0.3), 2e-5);
    let bent = Motion {
        orientation: DQuat::from_xyzw(0.0, 0.0, 0.1, 1.0),
        ..swung(1e-4)
    };
    let error = damper.drive(bent, 1e-4).unwrap_err();
    assert!(matches!(error, StepError::Orientation { .. }), "{error}");
    let lost = swung(1e-4).turned(DQuat::IDENTITY, DVec3::NAN);
    let error = damper.drive(lost, 1e-4).unwrap_err();
    assert!(error.to_string().contains("NaN"), "{error}");
    // A leap by half a revolution in one step.
    let leap = swung(1e-4).turned(DQuat::from_rotation_y(3.0), DVec3::ZERO);
    let error = damper.drive(leap, 2e-5).unwrap_err();
    assert!(
        matches!(error, StepError::Jump { .. } | StepError::Escaped { .. }),
        "{error}"
    );
    assert!(error.to_string().contains("turns at"), "{error}");

    let slot = Slot::paper();
    let mut flat = Damper::builder(&slot as AnyCavity<'_>, tsuji(0.3))
        .time_step(1e-4)
        .build()
        .unwrap();
    let error = flat.drive(swung(1e-4), 1e-4).unwrap_err();
    assert!(matches!(
        error,
        StepError::OutOfPlane { .. } | StepError::TurnsOutOfPlane { .. }
    ));
}

#[test]
fn an_angular_velocity_that_is_not_the_rate_of_the_orientation_is_refused() {
    let law = impulses(0.3);
    let slow = |t: f64| Motion::default().turned_in_plane(10.0 * t, 1.0);
    let grain = Particle::new(3e-3, 2e-4)
        .unwrap()
        .at(dvec3(0.05, 0.05, 0.0));
    let slot = Slot::paper();
    let mut damper = Damper::builder(&slot as AnyCavity<'_>, law)
        .mount(moved(slow))
        .particles([grain])
        .time_step(1e-4)
        .build()
        .unwrap();
    let error = damper.step().unwrap_err();
    assert!(matches!(error, StepError::TurnsOtherwise { .. }), "{error}");
}
