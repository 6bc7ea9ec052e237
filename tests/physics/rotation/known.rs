//! Single spheres in containers that turn, whose motion is known.

use particle_damper::cavity::{Cylinder, Disc};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{Damper, Motion, Particle, Slot};

use super::*;

const RADIUS: f64 = 3e-3;
const MASS: f64 = 2e-4;

fn sphere() -> Particle {
    Particle::new(RADIUS, MASS).unwrap()
}

fn spinning(rate: f64) -> Moved {
    moved(move |t: f64| Motion::default().turned_in_plane(rate * t, rate))
}

/// Carried around by a drum, a sphere presses on it with m w^2 r.
#[test]
fn a_sphere_rides_on_the_wall_of_a_drum() {
    fn run<L: ContactLaw>(law: L, time_step: f64) {
        let (drum, rate) = (0.05, 20.0);
        let path = drum - RADIUS;
        let start = sphere()
            .at(DVec3::X * path)
            .moving(DVec3::Y * rate * path)
            .spinning(DVec3::Z * rate);
        let room = Disc::new(drum).unwrap();
        let mut damper = Damper::builder(&room as AnyCavity<'_>, law)
            .mount(spinning(rate))
            .particles([start])
            .gravity(DVec3::ZERO)
            .time_step(time_step)
            .build()
            .unwrap();
        let turn = std::f64::consts::TAU / rate;
        let steps = (turn / time_step) as usize;
        let (mut pressing, mut torque) = (0.0, 0.0);
        for step in 0..2 * steps {
            damper.step().unwrap();
            if step >= steps {
                let reaction = damper.reaction(0).unwrap();
                pressing += reaction
                    .impulse
                    .dot(damper.particle(0).unwrap().position.normalize());
                torque += reaction.angular_impulse.z;
            }
        }
        let elapsed = steps as f64 * time_step;
        // It may settle to a steady roll beside the one in which it is carried along.
        let speed = damper.particle(0).unwrap().velocity.length() / path; // rad/s
        let expected = MASS * speed * speed * path;
        assert!(
            (pressing / elapsed / expected - 1.0).abs() < 1e-3,
            "{} for {expected} N",
            pressing / elapsed
        );
        assert!(torque.abs() / elapsed < 1e-3 * expected * drum);
        let sphere = damper.particle(0).unwrap();
        assert!((speed / rate - 1.0).abs() < 2e-3, "{speed} rad/s");
        let surface = sphere.velocity.length() + sphere.spin.z * RADIUS;
        assert!(
            (surface / (rate * drum) - 1.0).abs() < 1e-3,
            "{surface} m/s"
        );
    }
    run(tsuji(0.3), 2e-5);
    run(mindlin(0.3), 2e-5);
    run(impulses(0.3), 1e-4);
}

/// A sphere slides on the wall of a drum of radius R that turns at w, while its centre goes around on a
/// circle of radius p = R - r at the speed v. The wall presses with N = m v^2/p and pulls with mu N, so
///
/// ```text
/// v' = mu v^2/p       and   r s' = 5/2 v'   for its spin s,
/// 1/v0 - 1/v = mu t/p.
/// ```
/// Its surface goes at v + r s = 7/2 v - 5/2 v0, and has the wall's speed w R at v1 = (w R + 5/2 v0) 2/7.
#[test]
fn a_drum_takes_a_sliding_sphere_along_in_the_time_of_theory() {
    fn run<L: ContactLaw>(law: L, time_step: f64, friction: f64) {
        let (drum, rate, slow) = (0.05, 20.0, 0.2);
        let path = drum - RADIUS;
        let start = sphere().at(DVec3::X * path).moving(DVec3::Y * slow);
        let room = Disc::new(drum).unwrap();
        let mut damper = Damper::builder(&room as AnyCavity<'_>, law)
            .mount(spinning(rate))
            .particles([start])
            .gravity(DVec3::ZERO)
            .time_step(time_step)
            .build()
            .unwrap();
        let rolling = (rate * drum + 2.5 * slow) / 3.5;
        let expected = path / friction * (1.0 / slow - 1.0 / rolling);
        let slip = |sphere: &Particle| {
            let along = DVec3::Z.cross(sphere.position.normalize());
            rate * drum - sphere.velocity.dot(along) - sphere.spin.z * sphere.radius
        };
        let half = 0.5 * expected;
        while damper.time() < half {
            damper.step().unwrap();
        }
        let on_the_way = 1.0 / (1.0 / slow - friction * half / path);
        let speed = damper.particle(0).unwrap().velocity.length();
        assert!(
            (speed / on_the_way - 1.0).abs() < 0.01,
            "{speed} for {on_the_way} m/s"
        );
        while slip(&damper.particle(0).unwrap()) > 2e-3 * rate * drum {
            damper.step().unwrap();
            assert!(damper.time() < 2.0 * expected);
        }
        let sphere = damper.particle(0).unwrap();
        let found = damper.time();
        assert!(
            (found / expected - 1.0).abs() < 0.02,
            "{found} for {expected} s"
        );
        let speed = sphere.velocity.length();
        assert!(
            (speed / rolling - 1.0).abs() < 0.01,
            "{speed} for {rolling} m/s"
        );
    }
    run(tsuji(0.3), 2e-5, 0.3);
    run(mindlin(0.2), 2e-5, 0.2);
    run(impulses(0.3), 2e-5, 0.3);
}

/// A ball that rolls on a turntable of angular velocity w goes around in a circle with 2/7 w, wherever and
/// however it starts: v' = 2/7 w x v.
#[test]
fn a_ball_on_a_turntable_circles_with_two_sevenths() {
    fn run<L: ContactLaw>(law: L, time_step: f64, tolerance: f64) {
        let rate = 10.0;
        let spin = DVec3::Y * rate;
        let table =
            moved(move |t: f64| Motion::default().turned(rotation([0.0, rate * t, 0.0]), spin));
        let (place, velocity) = (dvec3(0.02, RADIUS, 0.01), dvec3(0.02, 0.0, -0.06));
        // It rolls: v - s x r y is the speed of the table beneath it.
        let own = DVec3::Y.cross(velocity - spin.cross(place)) / RADIUS;
        let ball = sphere().at(place).moving(velocity).spinning(own);
        let room = Cylinder::new(0.2, 0.05).unwrap();
        let mut damper = Damper::builder(&room as AnyCavity<'_>, law)
            .mount(table)
            .particles([ball])
            .time_step(time_step)
            .build()
            .unwrap();
        let circling = 2.0 / 7.0 * rate;
        let centre = place + spin.normalize().cross(velocity) / circling;
        let around = place - centre;
        let radius = dvec3(around.x, 0.0, around.z).length();
        while damper.time() < std::f64::consts::TAU / circling {
            damper.step().unwrap();
            let ball = damper.particle(0).unwrap();
            let turned = rotation([0.0, circling * damper.time(), 0.0]);
            let expected = centre + turned * around;
            let off = ball.position - expected;
            assert!(
                dvec3(off.x, 0.0, off.z).length() < tolerance * radius,
                "{} of {radius} m off at {} s",
                off.length(),
                damper.time()
            );
        }
    }
    run(tsuji(0.5), 2e-5, 0.03);
    run(mindlin(0.5), 2e-5, 0.01);
    run(impulses(0.5), 1e-4, 0.01);
}

/// A sphere rolls down a plane that tips at the rate w about z, through the plane's origin. With its place
/// s along the plane, its centre has the velocity (s' - w r, w s) along and across it and the spin
/// w - s'/r; friction F = -2/5 m s'' turns it, and so
///
/// ```text
/// 7/5 s'' - w^2 s = -g sin wt,
/// s = A (sin wt - w/k sinh kt),   A = 5 g/(12 w^2),   k^2 = 5/7 w^2   from rest on the plane.
/// ```
#[test]
fn a_sphere_on_a_plane_that_tips_rolls_as_theory_has_it() {
    fn run<L: ContactLaw>(law: L, time_step: f64) {
        let rate = 0.8;
        let width = 4.0;
        // The plane is the floor of a slot, whose origin is its corner.
        let tipping = moved(move |t: f64| {
            let turned = Motion::default().turned_in_plane(rate * t, rate);
            let corner = turned.to_fixed(DVec3::NEG_X * 0.5 * width);
            Motion::at(corner, turned.velocity_at(corner)).turned_in_plane(rate * t, rate)
        });
        let start = sphere()
            .at(dvec3(0.5 * width, RADIUS, 0.0))
            .moving(DVec3::NEG_X * rate * RADIUS)
            .spinning(DVec3::Z * rate);
        let room = Slot::new(width, 0.5).unwrap();
        let mut damper = Damper::builder(&room as AnyCavity<'_>, law)
            .mount(tipping)
            .particles([start])
            .time_step(time_step)
            .build()
            .unwrap();
        while damper.time() < 0.8 {
            damper.step().unwrap();
        }
        let k = (5.0_f64 / 7.0).sqrt() * rate;
        let (t, size) = (damper.time(), 5.0 * 9.81 / (12.0 * rate * rate));
        let expected = size * ((rate * t).sin() - rate / k * (k * t).sinh());
        let motion = damper.container(0).unwrap();
        let found = motion.to_local(damper.particle(0).unwrap().position).x - 0.5 * width;
        assert!(expected < -0.2, "{expected}");
        assert!(
            (found / expected - 1.0).abs() < 5e-3,
            "{found} for {expected} m"
        );
    }
    run(tsuji(0.5), 2e-5);
    run(mindlin(0.5), 2e-5);
    run(impulses(0.5), 1e-4);
}
