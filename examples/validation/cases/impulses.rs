//! Impacts under the restitution impulse: any masses, with a wall that yields as its mount does.

use particle_damper::glam::DVec3;
use particle_damper::mount::SingleDof;
use particle_damper::{
    AllPairs, Damper, Materials, Particle, RestitutionImpulse, RungeKutta4, Slot, VelocityVerlet,
};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::{acrylic, collide, paper_particle};

const NEWTON: &str = "Newton's law of impact and conservation of momentum";
const PAPER: &str = "Komatsuzaki & Iwata 2017 Eq. (11), doi 10.1007/s10999-016-9344-3";

pub(crate) fn cases(_: Form) -> Vec<Case> {
    let mut cases = pairs();
    cases.extend(walls());
    cases
}

/// Velocities after, and the energy lost, of two spheres of masses `m1` and `m2`.
fn pairs() -> Vec<Case> {
    let mut cases = Vec::new();
    for (m1, m2, v1, v2) in [
        (2e-4, 2e-4, -1.0, 0.0),
        (2e-4, 2e-1, -0.7, 0.1),
        (2e-1, 2e-4, -0.3, 0.5),
        (1e-3, 3e-3, 0.2, 1.1),
    ] {
        for e in [0.0, 0.005, 0.3, 0.75, 1.0] {
            for phase in [0.02, 0.4, 0.7, 0.98] {
                for literal in [false, true] {
                    let law = if literal {
                        RestitutionImpulse::literal(acrylic(e, 0.2))
                    } else {
                        RestitutionImpulse::new(acrylic(e, 0.2))
                    };
                    let body = |mass: f64, velocity: f64| {
                        let radius = 3e-3 * (mass / 2e-4_f64).cbrt();
                        Particle::new(radius, mass)
                            .unwrap()
                            .moving(DVec3::Y * velocity)
                    };
                    let bodies = [body(m1, v1), body(m2, v2)];
                    let dt = 1e-4;
                    let gap = (v2 - v1) * dt * phase;
                    let walls = Materials::FIRST;
                    let impact = collide(law, walls, VelocityVerlet, dt, gap, &bodies);
                    let after = [0, 1].map(|n| impact.bodies[n].velocity.y);
                    let share = |other: f64| (1.0 + e) * other / (m1 + m2) * (v1 - v2);
                    let name = |what: &str| {
                        let form = if literal { "as printed" } else { "default" };
                        format!("masses {m1} {m2} kg, e {e}, {form}, phase {phase}: {what}")
                    };
                    let close = Tolerance::Absolute(1e-3);
                    let exact = Tolerance::Absolute(1e-12);
                    let (first, second) = (v1 - share(m2), v2 + share(m1));
                    cases.push(Case::new(name("v1'"), NEWTON, first, after[0], close));
                    cases.push(Case::new(name("v2'"), NEWTON, second, after[1], close));
                    let momentum = |v: [f64; 2]| m1 * v[0] + m2 * v[1];
                    let drift = (momentum(after) - momentum([v1, v2])) / (m1 + m2);
                    cases.push(Case::new(name("momentum"), NEWTON, 0.0, drift, exact));
                    let energy = |v: [f64; 2]| 0.5 * (m1 * v[0] * v[0] + m2 * v[1] * v[1]);
                    let m = m1 * m2 / (m1 + m2);
                    let scale = 0.5 * m * (v1 - v2).powi(2);
                    let lost = (energy([v1, v2]) - energy(after)) / scale;
                    let due = 1.0 - e * e;
                    cases.push(Case::new(
                        name("energy lost / (m* v^2/2)"),
                        NEWTON,
                        due,
                        lost,
                        close,
                    ));
                }
            }
        }
    }
    cases
}

/// Eq. (11): a particle meets the floor of a container that yields.
fn walls() -> Vec<Case> {
    let mut cases = Vec::new();
    for (mass, m, v, wall, e) in [
        (0.086, 2e-4, -1.0, 0.0, 0.75),
        (0.086, 8.6e-3, -0.5, 0.3, 0.4),
        (0.01, 0.1, -0.2, 0.4, 0.9),
        (1.0, 1e-3, 0.1, 0.6, 0.0),
    ] {
        let particle = Particle::new(3e-3, m).unwrap();
        let dt = 1e-4;
        let start = DVec3::new(0.03, 3e-3 + 0.7 * dt * (wall - v), 0.0);
        let mount = SingleDof::new(mass, 0.0, 0.0).unwrap();
        let builder = || {
            Damper::builder(Slot::paper(), RestitutionImpulse::new(acrylic(e, 0.2)))
                .mount(mount.released_from(0.0, wall).unwrap())
                .gravity(DVec3::ZERO)
                .particles([particle.at(start).moving(DVec3::Y * v)])
                .time_step(dt)
        };
        let mut verlet = builder().build().unwrap();
        let mut kutta = builder()
            .detector(AllPairs)
            .integrator(RungeKutta4::default())
            .build()
            .unwrap();
        let mut after = Vec::new();
        for _ in 0..5 {
            verlet.step().unwrap();
            kutta.step().unwrap();
        }
        after.push((verlet.particle(0).unwrap().velocity.y, verlet.rates()[0]));
        after.push((kutta.particle(0).unwrap().velocity.y, kutta.rates()[0]));
        let share = (1.0 + e) * (v - wall) / (mass + m);
        for (got, integrator) in after.into_iter().zip(["VelocityVerlet", "RungeKutta4"]) {
            let name =
                |what: &str| format!("container {mass} kg, m {m} kg, e {e}, {integrator}: {what}");
            let close = Tolerance::Absolute(if e < 0.02 { 1e-3 } else { 1e-12 });
            cases.push(Case::new(name("v'"), PAPER, v - share * mass, got.0, close));
            cases.push(Case::new(
                name("v_w'"),
                PAPER,
                wall + share * m,
                got.1,
                close,
            ));
        }
    }
    let free = paper_particle();
    let expected = -1.0 + 1.75 * 0.086 / (0.086 + free.mass);
    let printed = Tolerance::Absolute(5e-8);
    cases.push(Case::new(
        "Eq. (11), the printed row: v'",
        PAPER,
        0.745_939_7,
        expected,
        printed,
    ));
    cases
}
