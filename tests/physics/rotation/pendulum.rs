//! A pendulum whose bob is a box of grains.

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    Damper, EnergyLedger, Filling, Load, Motion, Mount, MountEnergy, Particle, Slot,
};

use super::*;

const LENGTH: f64 = 0.25; // m, from the pivot to the middle of the box
const GRAVITY: f64 = 9.81;
const GRAINS: usize = 12;
const GRAIN: f64 = 2e-4; // kg

/// A box on a rod, in the plane. Its coordinate is the angle from hanging down. Where all mass is in the box,
/// grains feel no pull sideways, as little as water does that is swung in a bucket: so a counterweight above
/// the pivot slows the pendulum down.
struct Pendulum {
    size: DVec3,
    /// First moment of mass below the pivot, kg m.
    moment: f64,
    /// About the pivot, kg m^2.
    inertia: f64,
    damping: f64,
    start: f64,
}

impl Pendulum {
    /// From the pivot to the box's corner, which is the container's origin, in the container's frame.
    fn corner(&self) -> DVec3 {
        dvec3(-0.5 * self.size.x, -LENGTH - 0.5 * self.size.y, 0.0)
    }
}

impl Mount for Pendulum {
    fn degrees(&self) -> usize {
        1
    }

    fn start(&self, x: &mut [f64], _v: &mut [f64]) {
        x[0] = self.start;
    }

    fn motion(&self, _time: f64, x: &[f64], v: &[f64], _cavity: usize) -> Motion {
        let pivot = Motion::default().turned_in_plane(x[0], v[0]);
        let corner = pivot.to_fixed(self.corner());
        Motion::at(corner, pivot.velocity_at(corner))
            .turned(pivot.orientation, pivot.angular_velocity)
    }

    fn accelerate(&self, _time: f64, x: &[f64], v: &[f64], loads: &[Load], a: &mut [f64]) {
        let corner = self.motion(0.0, x, v, 0).position;
        let weight = self.moment * GRAVITY * x[0].sin();
        let torque = loads[0].torque_about(-corner).z - weight - self.damping * v[0];
        a[0] = torque / self.inertia;
    }

    fn energy(&self, _time: f64, x: &[f64], v: &[f64]) -> MountEnergy {
        let potential = self.moment * GRAVITY * (1.0 - x[0].cos());
        MountEnergy::new(0.5 * self.inertia * v[0] * v[0], potential)
            .with_powers(0.0, self.damping * v[0] * v[0])
    }

    fn highest_frequency(&self) -> f64 {
        (GRAVITY * self.moment / self.inertia).sqrt() / std::f64::consts::TAU
    }
}

/// Swings for `duration` (s); the largest angle over the last swing, and the ledger.
fn swing<L: ContactLaw>(law: L, time_step: f64, loose: bool) -> (f64, EnergyLedger) {
    let size = dvec3(0.05, 0.03, 0.0);
    let cavity = Slot::new(size.x, size.y).unwrap();
    let bed = Filling::new(4)
        .with(GRAINS, Particle::new(3e-3, GRAIN).unwrap())
        .fill(&cavity)
        .unwrap();
    let start = 0.9;
    let mut pendulum = Pendulum {
        size,
        moment: 0.01 * LENGTH - 0.02 * 0.1,
        inertia: 0.01 * (LENGTH * LENGTH + size.length_squared() / 12.0) + 0.02 * 0.01,
        damping: 2e-5,
        start,
    };
    if !loose {
        // Fixed where they lie at first.
        for grain in &bed {
            let arm = pendulum.corner() + grain.position;
            pendulum.moment -= grain.mass * arm.y;
            pendulum.inertia += grain.mass * arm.length_squared() + grain.inertia();
        }
    }
    let mut damper = Damper::builder(cavity, law)
        .mount(pendulum)
        .particles(if loose { bed } else { Vec::new() })
        .time_step(time_step)
        .build()
        .unwrap();
    let mut ledger = EnergyLedger::new();
    let mut largest = 0.0_f64;
    while damper.time() < 5.0 {
        damper.step_watched(&mut ledger).unwrap();
        if damper.time() > 3.9 {
            largest = largest.max(damper.coordinates()[0].abs());
        }
    }
    (largest, ledger)
}

#[test]
fn a_pendulum_decays_faster_with_loose_grains() {
    fn run<L: ContactLaw + Clone>(law: &L, time_step: f64, residual: f64) {
        let (fixed, _) = swing(law.clone(), time_step, false);
        let (loose, ledger) = swing(law.clone(), time_step, true);
        println!("{loose} rad with loose grains, {fixed} rad with fixed ones");
        assert!(fixed > 0.6 && fixed < 0.9, "{fixed}");
        assert!(0.9 - loose > 1.5 * (0.9 - fixed), "{loose} {fixed}");
        let lost = ledger.losses().total();
        println!("lost {lost}, residual {}", ledger.residual());
        assert!(lost > 0.2 * ledger.opening().total().abs());
        assert!(
            ledger.residual().abs() < residual * lost,
            "{} {lost}",
            ledger.residual()
        );
    }
    run(&tsuji(0.3), 4e-5, 1e-3);
    run(&impulses(0.3), 2e-4, 1e-3);
}
