//! The same seen from elsewhere is the same.

use particle_damper::cavity::{Composite, Cylinder, Disc, Part, Sphere};
use particle_damper::glam::{DQuat, DVec3, dvec3};
use particle_damper::{
    AllPairs, CellGrid, Cuboid, Damper, Driven, Filling, LinkedCells, Motion, Particle, Skin, Slot,
};
use proptest::prelude::*;

use super::*;

/// A bed of unlike grains that moves about, in the cavity's frame.
fn lively(cavity: AnyCavity<'_>, count: usize) -> Vec<Particle> {
    let filling = Filling::new(3)
        .with(count, Particle::new(3e-3, 2e-4).unwrap())
        .with(count / 2, Particle::new(2e-3, 1e-4).unwrap());
    let mut bed = filling.fill(cavity).unwrap();
    for (n, particle) in (0..).zip(&mut bed) {
        let phase = f64::from(n);
        let way = dvec3((2.0 * phase).sin(), (3.0 * phase).cos(), phase.sin());
        let flat = if cavity.is_planar() { 0.0 } else { 1.0 };
        particle.velocity = dvec3(way.x, way.y, flat * way.z) * 0.3;
        particle.spin = dvec3(flat * way.y, flat * way.z, way.x) * 20.0;
    }
    bed
}

/// A tilted box under gravity is a box under tilted gravity.
fn tilts<L: ContactLaw + Clone>(
    cavity: AnyCavity<'_>,
    law: &L,
    time_step: f64,
    orientation: DQuat,
) {
    let gravity = dvec3(0.0, -9.81, 0.0);
    let place = dvec3(0.3, -0.2, if cavity.is_planar() { 0.0 } else { 0.1 });
    let bed = lively(cavity, 8);
    let mut straight = Damper::builder(cavity, law.clone())
        .particles(bed.clone())
        .gravity(orientation.inverse() * gravity)
        .time_step(time_step)
        .build()
        .unwrap();
    let stand = Motion::at(place, DVec3::ZERO).turned(orientation, DVec3::ZERO);
    let mut tilted = Damper::builder(cavity, law.clone())
        .mount(Driven::at(stand))
        .particles(turned(&bed, orientation))
        .gravity(gravity)
        .time_step(time_step)
        .build()
        .unwrap();
    for _ in 0..(0.02 / time_step) as usize {
        straight.step().unwrap();
        tilted.step().unwrap();
    }
    for (own, other) in straight.particles().zip(tilted.particles()) {
        let off = stand.to_local(other.position) - own.position;
        assert!(off.length() < 1e-9, "{} m off", off.length());
        let off = orientation.inverse() * other.spin - own.spin;
        assert!(off.length() < 1e-6, "{off} rad/s");
    }
    let [own, other] = [straight.reaction(0), tilted.reaction(0)].map(Option::unwrap);
    let size = own.force.length().max(1e-3);
    assert!((orientation.inverse() * other.force - own.force).length() < 1e-6 * size);
    let off = orientation.inverse() * other.torque - own.torque;
    assert!(off.length() < 1e-6 * size);
}

fn tilts_under_all_laws(cavity: AnyCavity<'_>, orientation: DQuat) {
    tilts(cavity, &tsuji(0.4), 2e-5, orientation);
    tilts(cavity, &mindlin(0.4), 2e-5, orientation);
    tilts(cavity, &impulses(0.4), 2e-4, orientation);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]
    #[test]
    fn a_tilted_box_is_a_box_under_tilted_gravity(vector in prop::array::uniform3(-2.5..2.5_f64)) {
        let orientation = rotation(vector);
        let flat = rotation([0.0, 0.0, vector[2]]);
        tilts_under_all_laws(&Slot::new(0.03, 0.05).unwrap(), flat);
        tilts_under_all_laws(&Disc::new(0.02).unwrap(), flat);
        tilts_under_all_laws(&Cuboid::new(dvec3(0.03, 0.02, 0.025)).unwrap(), orientation);
        tilts_under_all_laws(&Cylinder::new(0.015, 0.03).unwrap(), orientation);
        tilts_under_all_laws(&Sphere::new(0.015).unwrap(), orientation);
        // With a rod askew in it.
        let rod = Part::capsule(3e-3, 0.02).along(dvec3(1.0, 0.3, 0.2)).at(DVec3::NEG_Y * 0.008);
        let room = Composite::new([Part::cylinder(0.015).inside(), Part::plane().at(DVec3::NEG_Y * 0.015),
            Part::plane().along(DVec3::NEG_Y).at(DVec3::Y * 0.015), rod]).unwrap();
        tilts_under_all_laws(&room, orientation);
    }

    /// Forces do not feel that everything moves along as one rigid body.
    #[test]
    fn forces_are_those_of_the_relative_motion(
        vector in prop::array::uniform3(-2.0..2.0_f64),
        spin in prop::array::uniform3(-9.0..9.0_f64),
    ) {
        let cavity = Cuboid::new(dvec3(0.03, 0.02, 0.025)).unwrap();
        // Pressed into two walls and into each other.
        let grains = [dvec3(0.002_9, 0.002_8, 0.01), dvec3(0.008_8, 0.0029, 0.01)];
        let bed = grains.map(|place| {
            Particle::new(3e-3, 2e-4).unwrap()
                .at(place)
                .moving(dvec3(-0.2, -0.1, 0.15))
                .spinning(dvec3(30.0, -20.0, 10.0))
        });
        let frame = Motion::at(dvec3(1.0, 2.0, 3.0), dvec3(0.5, -0.3, 0.8))
            .turned(rotation(vector), DVec3::from(spin));
        let moved = bed.map(|mut particle| {
            let velocity = frame.velocity_at(frame.to_fixed(particle.position));
            particle.velocity = velocity + frame.orientation * particle.velocity;
            particle.spin = frame.angular_velocity + frame.orientation * particle.spin;
            particle
        });
        let forces = |law: &dyn Fn(Motion, [Particle; 2]) -> particle_damper::Reaction| {
            let own = law(Motion::default(), bed);
            let other = law(frame, moved);
            let off = frame.orientation.inverse() * other.force - own.force;
            assert!(off.length() < 1e-11 * own.force.length(), "{off} N");
            let off = frame.orientation.inverse() * other.torque - own.torque;
            assert!(off.length() < 1e-11 * own.torque.length(), "{off} N m");
            assert!(own.force.length() > 1e-3);
        };
        macro_rules! of {
            ($law:expr) => {
                &|motion, bed: [Particle; 2]| {
                    Damper::builder(&cavity as AnyCavity<'_>, $law)
                        .mount(Driven::at(motion))
                        .particles(bed)
                        .initial_overlap(0.1)
                        .gravity(DVec3::ZERO)
                        .time_step(1e-9)
                        .build()
                        .unwrap()
                        .reaction(0)
                        .unwrap()
                }
            };
        }
        forces(of!(tsuji(0.4)));
        forces(of!(mindlin(0.4)));
    }
}

/// A motion that does all that a container can do, and its derivative.
fn wild(t: f64) -> Motion {
    let (sine, cosine) = (30.0 * t).sin_cos();
    // Turning about a fixed axis at a rate that changes.
    let axis = dvec3(1.0, 2.0, -1.0).normalize();
    let orientation = DQuat::from_axis_angle(axis, 1.0 + 2.0 * sine);
    Motion::at(
        dvec3(0.0, 2e-3, 1e-3) * sine,
        dvec3(0.0, 2e-3, 1e-3) * 30.0 * cosine,
    )
    .turned(orientation, axis * 60.0 * cosine)
}

#[test]
fn detectors_agree_to_the_bit_in_a_container_that_turns() {
    fn run<L: ContactLaw + Clone>(law: &L, time_step: f64) {
        let cavity: AnyCavity<'_> = &Cuboid::new(dvec3(0.03, 0.03, 0.03)).unwrap();
        let bed = turned(&lively(cavity, 20), wild(0.0).orientation);
        macro_rules! with {
            ($detector:expr) => {{
                let mut damper = Damper::builder(cavity, law.clone())
                    .mount(moved(wild))
                    .detector($detector)
                    .particles(bed.clone())
                    .time_step(time_step)
                    .build()
                    .unwrap();
                for _ in 0..(0.03 / time_step) as usize {
                    damper.step().unwrap();
                }
                let places = damper.particles().map(|particle| particle.position);
                places.collect::<Vec<_>>()
            }};
        }
        let expected = with!(AllPairs);
        assert_eq!(with!(LinkedCells::default()), expected);
        assert_eq!(with!(CellGrid::in_space([4; 3]).unwrap()), expected);
        assert_eq!(
            with!(Skin::new(LinkedCells::default(), 0.3).unwrap()),
            expected
        );
    }
    run(&mindlin(0.4), 2e-5);
    run(&impulses(0.4), 1e-4);
}

/// A smooth round wall that turns about its axis does nothing.
#[test]
fn a_smooth_drum_that_turns_is_a_drum_at_rest() {
    fn run<L: ContactLaw + Clone>(law: &L, time_step: f64) {
        let cavity: AnyCavity<'_> = &Cylinder::new(0.015, 0.03).unwrap();
        let turn = |t: f64| {
            let (sine, cosine) = (40.0 * t).sin_cos();
            Motion::default().turned(rotation([0.0, 0.7 * sine, 0.0]), DVec3::Y * 28.0 * cosine)
        };
        let bed = lively(cavity, 10);
        let mut still = Damper::builder(cavity, law.clone())
            .particles(bed.clone())
            .time_step(time_step)
            .build()
            .unwrap();
        let mut turning = Damper::builder(cavity, law.clone())
            .mount(moved(turn))
            .particles(bed)
            .time_step(time_step)
            .build()
            .unwrap();
        for _ in 0..(0.02 / time_step) as usize {
            still.step().unwrap();
            turning.step().unwrap();
        }
        for (own, other) in still.particles().zip(turning.particles()) {
            // Onsets are corrected for the acceleration relative to the container, in which a round wall is
            // taken to be flat where it is touched: that is another error in another frame.
            assert!(
                (own.position - other.position).length() < 1e-7,
                "{own:?} {other:?}"
            );
        }
    }
    run(&tsuji(0.0), 2e-5);
    run(&mindlin(0.0), 2e-5);
}
