//! What nobody outside touches keeps momentum and angular momentum.

use particle_damper::glam::{DMat3, DVec3, dvec3};
use particle_damper::mount::RigidBody;
use particle_damper::{Cuboid, Damper, Filling, Motion, Particle, Slot};

use super::*;

/// Momentum, and angular momentum about the origin of the fixed frame, of a box and its grains, and their
/// kinetic energy. The box has `mass` and `inertia` about the point `centre` of it.
fn totals(
    damper_of: (DVec3, DVec3, f64),
    motion: Motion,
    (mass, inertia, centre): (f64, DMat3, DVec3),
) -> ([DVec3; 2], f64) {
    let (momentum, angular, kinetic) = damper_of;
    let place = motion.to_fixed(centre);
    let velocity = motion.velocity_at(place);
    let local = motion.orientation.inverse() * motion.angular_velocity;
    let own = motion.orientation * (inertia * local);
    let energy = 0.5 * (mass * velocity.length_squared() + own.dot(motion.angular_velocity));
    let whole = momentum + velocity * mass;
    let turning = angular + place.cross(velocity * mass) + own;
    ([whole, turning], kinetic + energy)
}

/// A spinning box in space, with the container's origin at a corner.
fn flies<L: ContactLaw>(law: L, time_step: f64, steps: usize) {
    let size = dvec3(0.03, 0.02, 0.025);
    let cavity: AnyCavity<'_> = &Cuboid::new(size).unwrap();
    let body = (
        2e-3,
        DMat3::from_cols(
            dvec3(4e-7, 1e-8, 0.0),
            dvec3(1e-8, 6e-7, 2e-8),
            dvec3(0.0, 2e-8, 3e-7),
        ),
        size * 0.5,
    );
    let mount = RigidBody::new(body.0, body.1)
        .unwrap()
        .centre_of_mass(body.2)
        .released(
            Motion::at(dvec3(0.2, 0.1, -0.1), dvec3(0.1, 0.3, -0.2))
                .turned(rotation([0.4, -1.0, 0.6]), dvec3(5.0, 12.0, -7.0)),
        );
    let grains = Filling::new(5).with(6, Particle::new(3e-3, 2e-4).unwrap());
    let mut damper = Damper::builder(cavity, law)
        .mount(mount)
        .particles(grains.fill(cavity).unwrap())
        .gravity(DVec3::ZERO)
        .time_step(time_step)
        .build()
        .unwrap();
    let now = |damper: &Damper<_, L, RigidBody, _>| {
        let of_bed = (
            damper.momentum(),
            damper.angular_momentum(DVec3::ZERO),
            damper.kinetic_energy(),
        );
        totals(of_bed, damper.container(0).unwrap(), body)
    };
    let ([momentum, angular], energy) = now(&damper);
    for _ in 0..steps {
        damper.step().unwrap();
    }
    let ([other, turned], left) = now(&damper);
    let off = (other - momentum).length() / momentum.length();
    let spun = (turned - angular).length() / angular.length();
    println!(
        "momentum {off:e}, angular momentum {spun:e}, energy left {}",
        left / energy
    );
    assert!(off < 1e-10, "momentum: {off}");
    assert!(spun < 1e-10, "angular momentum: {spun}");
    assert!(left < energy && left > 0.2 * energy, "{left} of {energy} J");
}

#[test]
fn a_box_with_grains_in_space_keeps_momentum_under_the_strict_law() {
    flies(tsuji(0.3), 2e-5, 100_000);
}

#[test]
fn a_box_with_grains_in_space_keeps_momentum_under_the_law_with_memory() {
    flies(mindlin(0.3), 2e-5, 10_000);
}

#[test]
fn a_box_with_grains_in_space_keeps_momentum_under_impulses() {
    flies(impulses(0.3), 1e-4, 100_000);
}

/// In the plane, where a light box turns as grains hit it off its centre.
#[test]
fn a_box_with_grains_in_the_plane_keeps_momentum() {
    fn run<L: ContactLaw>(law: L, time_step: f64) {
        let cavity: AnyCavity<'_> = &Slot::new(0.03, 0.03).unwrap();
        let body = (
            1e-3,
            DMat3::from_diagonal(DVec3::splat(2e-7)),
            dvec3(0.01, 0.02, 0.0),
        );
        let start = Motion::at(DVec3::X, dvec3(0.1, 0.2, 0.0)).turned_in_plane(0.5, 8.0);
        let mount = RigidBody::in_plane(body.0, 2e-7)
            .unwrap()
            .centre_of_mass(body.2)
            .released(start);
        let grains = Filling::new(5).with(6, Particle::new(3e-3, 2e-4).unwrap());
        let mut damper = Damper::builder(cavity, law)
            .mount(mount)
            .particles(grains.fill(cavity).unwrap())
            .gravity(DVec3::ZERO)
            .time_step(time_step)
            .build()
            .unwrap();
        let first = damper.container(0).unwrap();
        assert!((first.position - start.position).length() < 1e-15);
        assert!((first.velocity - start.velocity).length() < 1e-15);
        let now = |damper: &Damper<_, L, RigidBody, _>| {
            let of_bed = (damper.momentum(), damper.angular_momentum(DVec3::ZERO), 0.0);
            totals(of_bed, damper.container(0).unwrap(), body).0
        };
        let [momentum, angular] = now(&damper);
        for _ in 0..10_000 {
            damper.step().unwrap();
        }
        let [other, turned] = now(&damper);
        assert!((other - momentum).length() < 1e-12 * momentum.length());
        assert!((turned - angular).length() < 1e-12 * angular.length());
        let spin = damper.container(0).unwrap().angular_velocity;
        assert!((spin.z - 8.0).abs() > 0.1, "{spin}");
    }
    run(tsuji(0.3), 2e-5);
    run(impulses(0.3), 1e-4);
}

/// Without grains a body turns as Euler's equations have it: reversible, no drift of energy.
#[test]
fn a_tumbling_body_keeps_its_energy() {
    let inertia = dvec3(1e-6, 2e-6, 3e-6);
    let spin = dvec3(0.1, 20.0, 0.1);
    let run = |time_step: f64| {
        let mount = RigidBody::new(0.01, DMat3::from_diagonal(inertia))
            .unwrap()
            .released(Motion::default().turned(rotation([0.0; 3]), spin));
        let cavity: AnyCavity<'_> = &Cuboid::new(DVec3::ONE).unwrap();
        let mut damper = Damper::builder(cavity, tsuji(0.3))
            .mount(mount)
            .time_step(time_step)
            .build()
            .unwrap();
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        for _ in 0..(10.0 / time_step) as usize {
            damper.step().unwrap();
            let turning = damper.container(0).unwrap();
            let local = turning.orientation.inverse() * turning.angular_velocity;
            let energy = 0.5 * (inertia * local).dot(local);
            (least, most) = (least.min(energy), most.max(energy));
        }
        let local = damper.container(0).unwrap();
        (
            (most - least) / most,
            local.orientation.inverse() * local.angular_velocity,
        )
    };
    // It flips over again and again (Dzhanibekov), as the middle axis does.
    let ((coarse, _), (fine, _)) = (run(1e-3), run(5e-4));
    assert!(fine < 1e-4, "{fine}");
    assert!(fine < 0.3 * coarse, "{fine} {coarse}");
}
