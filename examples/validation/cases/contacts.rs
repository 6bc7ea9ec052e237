//! One contact under the strict laws: Hertz's impact, and the restitution that damping gives.

use particle_damper::glam::DVec3;
use particle_damper::{
    Damping, Ending, HertzMindlin, HertzTsuji, Materials, Particle, RungeKutta4, VelocityVerlet,
};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::{
    acrylic, collide, elastic_impact, hertz_constant, hertz_duration, material, on_rigid,
};

const HERTZ: &str = "Johnson, Contact Mechanics (1985) Sec. 11.4, doi 10.1017/CBO9781139171731";
const KUWABARA: &str = "Kuwabara & Kono 1987, doi 10.1143/JJAP.26.1230; equation integrated here";
const PADE: &str = "Mueller & Poeschel 2011, doi 10.1103/PhysRevE.84.021302";
const ANTYPOV: &str = "Antypov & Elliott 2011, doi 10.1209/0295-5075/94/50004";
const SCHWAGER: &str = "closed form of the d^(1/4) oscillator; Schwager & Poeschel 2007, doi 10.1007/s10035-007-0065-z";
const ASKED: &str = "Interaction::restitution as asked";

pub(crate) fn cases(form: Form) -> Vec<Case> {
    let mut cases = elastic();
    cases.extend(numbers());
    cases.extend(speeds());
    cases.extend(asked(form));
    cases
}

/// Overlap, force and duration of elastic impacts.
fn elastic() -> Vec<Case> {
    let mut cases = Vec::new();
    // Radius (m), density (kg/m^3), E (Pa), nu of both; the second radius zero for a rigid plane.
    for (name, first, second, v) in [
        (
            "acrylic pair",
            (3e-3, 1768.0, 0.4e9, 0.3),
            (3e-3, 1768.0, 0.4e9, 0.3),
            1.0,
        ),
        (
            "steel on brass",
            (2e-3, 7850.0, 210e9, 0.3),
            (5e-3, 8500.0, 100e9, 0.35),
            0.3,
        ),
        (
            "rubber on plane",
            (10e-3, 1100.0, 5e6, 0.49),
            (0.0, 0.0, 0.0, 0.0),
            0.5,
        ),
        (
            "glass on plane",
            (1e-3, 2500.0, 70e9, 0.2),
            (0.0, 0.0, 0.0, 0.0),
            3.0,
        ),
    ] {
        let sphere = |(radius, density, ..): (f64, f64, f64, f64)| {
            Particle::with_density(radius, density).unwrap()
        };
        let elastic =
            |(.., modulus, ratio): (f64, f64, f64, f64)| material(modulus, ratio, 1.0, 0.0);
        let one = sphere(first).moving(DVec3::NEG_Y * v);
        let (mut materials, rigid) = on_rigid(elastic(first));
        let (bodies, k, m) = if second.0 > 0.0 {
            let other = sphere(second).of(materials.add(elastic(second)));
            let k = hertz_constant((first.0, first.2, first.3), (second.0, second.2, second.3));
            let m = 1.0 / (1.0 / one.mass + 1.0 / other.mass);
            (vec![one, other], k, m)
        } else {
            let k = hertz_constant((first.0, first.2, first.3), (f64::INFINITY, 1e30, 0.0));
            (vec![one], k, one.mass)
        };
        let name = format!("elastic, {name}, {v} m/s");
        cases.extend(elastic_impact(
            &name,
            HERTZ,
            (materials, rigid),
            &bodies,
            (k, m, v),
        ));
    }
    cases
}

/// Restitution of u" + u^(3/2) + beta u^(1/2) u' = 0 from u = 0, u' = 1, by small Runge-Kutta steps.
fn restitution_by_integration(beta: f64, ending: Ending) -> f64 {
    let rate = |u: f64, v: f64| -(u.max(0.0).powf(1.5) + beta * u.max(0.0).sqrt() * v);
    let (mut u, mut v, h) = (0.0_f64, 1.0_f64, 5e-5);
    loop {
        let (v1, a1) = (v, rate(u, v));
        let (v2, a2) = (v + 0.5 * h * a1, rate(u + 0.5 * h * v1, v + 0.5 * h * a1));
        let (v3, a3) = (v + 0.5 * h * a2, rate(u + 0.5 * h * v2, v + 0.5 * h * a2));
        let (v4, a4) = (v + h * a3, rate(u + h * v3, v + h * a3));
        u += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
        v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        if u <= 0.0 || (ending == Ending::NeverPulling && u + beta * v <= 0.0) {
            return -v;
        }
    }
}

/// ln e of d^(1/4) damping with the damping ratio zeta = alpha/sqrt 5, never pulling.
fn log_never_pulling(zeta: f64) -> f64 {
    let s = (1.0 - zeta * zeta).sqrt();
    -2.0 * zeta / s * s.atan2(zeta)
}

/// Damping numbers against restitution, as the crate turns one into the other.
fn numbers() -> Vec<Case> {
    let mut cases = Vec::new();
    let name = |what: &str, number: f64, ending: Ending| format!("{what} {number}, {ending:?}: e");
    for ending in [Ending::NeverPulling, Ending::PullingAllowed] {
        for beta in [0.02, 0.1, 0.3, 1.0, 2.0] {
            let got = Damping::Viscoelastic.restitution(beta, ending).unwrap();
            let expected = restitution_by_integration(beta, ending);
            let close = Tolerance::Absolute(1e-6);
            cases.push(Case::new(
                name("beta", beta, ending),
                KUWABARA,
                expected,
                got,
                close,
            ));
        }
        for e in [0.2_f64, 0.5, 0.75, 0.95] {
            let alpha = Damping::Tsuji.number(e, ending).unwrap();
            let zeta = alpha / 5.0_f64.sqrt();
            let (expected, source) = match ending {
                Ending::PullingAllowed => {
                    let log = zeta * std::f64::consts::PI / (1.0 - zeta * zeta).sqrt();
                    ((-log).exp(), ANTYPOV)
                }
                Ending::NeverPulling => (log_never_pulling(zeta).exp(), SCHWAGER),
            };
            let close = Tolerance::Absolute(1e-9);
            cases.push(Case::new(
                name("alpha", alpha, ending),
                source,
                expected,
                e,
                close,
            ));
        }
    }
    for beta in [0.001_f64, 0.05, 0.2] {
        let s = beta.sqrt();
        let top = 1.0 + 0.501_086 * s;
        let pade = top / (top + 1.15345 * beta + 0.577_977 * s.powi(3) + 0.532_178 * s.powi(4));
        let ending = Ending::NeverPulling;
        let got = Damping::Viscoelastic.restitution(beta, ending).unwrap();
        let close = Tolerance::Absolute(3e-4);
        cases.push(Case::new(
            name("Pade form, beta", beta, ending),
            PADE,
            pade,
            got,
            close,
        ));
    }
    cases
}

/// Impact of the paper's particle on a wall at `speed`, its damping set for `e` at 1 m/s.
pub(crate) fn restitution_at(damping: Damping, ending: Ending, e: f64, speed: f64) -> f64 {
    let law = HertzTsuji::new(acrylic(e, 0.0))
        .damping(damping)
        .ending(ending);
    let body = super::setup::paper_particle().moving(DVec3::NEG_Y * speed);
    let k = hertz_constant((3e-3, 0.4e9, 0.3), (f64::INFINITY, 0.4e9, 0.3));
    let dt = hertz_duration(k, body.mass, speed.max(1.0)) / 1000.0;
    let walls = Materials::FIRST;
    let impact = collide(
        law,
        walls,
        RungeKutta4::default(),
        dt,
        0.3 * speed * dt,
        &[body],
    );
    impact.bodies[0].velocity.y / speed
}

/// Restitution at speeds other than the one it was asked for.
fn speeds() -> Vec<Case> {
    let mut cases = Vec::new();
    for ending in [Ending::NeverPulling, Ending::PullingAllowed] {
        for (e, speed) in [(0.75, 0.1), (0.75, 3.0), (0.5, 0.02), (0.9, 10.0)] {
            let beta = Damping::Viscoelastic.number(e, ending).unwrap();
            let expected = restitution_by_integration(beta * f64::powf(speed, 0.2), ending);
            let got = restitution_at(Damping::Viscoelastic, ending, e, speed);
            let name = format!("e {e} at 1 m/s, viscoelastic, {ending:?}: e at {speed} m/s");
            cases.push(Case::new(
                name,
                KUWABARA,
                expected,
                got,
                Tolerance::Absolute(1e-4),
            ));
            let got = restitution_at(Damping::Tsuji, ending, e, speed);
            let name = format!("e {e} at 1 m/s, Tsuji, {ending:?}: e at {speed} m/s");
            cases.push(Case::new(name, ANTYPOV, e, got, Tolerance::Absolute(1e-4)));
        }
    }
    cases
}

/// The restitution that was asked for, at 100 steps to a contact, wherever in a step the bodies first
/// touch: any masses, pair and wall, with either law, damping, ending and integrator.
fn asked(form: Form) -> Vec<Case> {
    let mut cases = Vec::new();
    let values: &[f64] = match form {
        Form::Short => &[1.0, 0.75, 0.3],
        Form::Long => &[1.0, 0.95, 0.9, 0.75, 0.5, 0.3, 0.2, 0.1, 0.05],
    };
    for damping in [Damping::Viscoelastic, Damping::Tsuji] {
        for ending in [Ending::NeverPulling, Ending::PullingAllowed] {
            for &e in values {
                for ratio in [0.0, 1.0, 1e-3, 1e3] {
                    let worst = worst_restitution(damping, ending, e, ratio, form);
                    let at = if ratio > 0.0 {
                        format!("masses 1:{ratio}")
                    } else {
                        "wall".into()
                    };
                    let name =
                        format!("e {e}, {damping:?}, {ending:?}, {at}: 100 steps to a contact");
                    cases.push(Case::new(name, ASKED, e, worst, Tolerance::Absolute(1e-3)));
                }
            }
        }
    }
    cases
}

/// The restitution farthest from `e` over phases of first touch, both integrators and both laws.
fn worst_restitution(damping: Damping, ending: Ending, e: f64, ratio: f64, form: Form) -> f64 {
    let one = super::setup::paper_particle().moving(DVec3::NEG_Y);
    let (bodies, k, m) = if ratio > 0.0 {
        let radius = one.radius * ratio.cbrt();
        let other = Particle::new(radius, one.mass * ratio).unwrap();
        let k = hertz_constant((one.radius, 0.4e9, 0.3), (radius, 0.4e9, 0.3));
        (vec![one, other], k, one.mass * ratio / (1.0 + ratio))
    } else {
        let k = hertz_constant((one.radius, 0.4e9, 0.3), (f64::INFINITY, 0.4e9, 0.3));
        (vec![one], k, one.mass)
    };
    let dt = hertz_duration(k, m, 1.0) / 100.0;
    let walls = Materials::FIRST;
    let mut worst = e;
    let phases = if form == Form::Long { 50 } else { 5 };
    for phase in 0..phases {
        let gap = dt * f64::from(phase) / f64::from(phases);
        let strict = HertzTsuji::new(acrylic(e, 0.2))
            .damping(damping)
            .ending(ending);
        let sticky = HertzMindlin::new(acrylic(e, 0.2))
            .damping(damping)
            .ending(ending);
        for impact in [
            collide(strict.clone(), walls, VelocityVerlet, dt, gap, &bodies),
            collide(
                strict.clone(),
                walls,
                RungeKutta4::default(),
                dt,
                gap,
                &bodies,
            ),
            collide(sticky.clone(), walls, VelocityVerlet, dt, gap, &bodies),
            collide(
                sticky.clone(),
                walls,
                RungeKutta4::default(),
                dt,
                gap,
                &bodies,
            ),
        ] {
            let velocity = |n: usize| impact.bodies.get(n).map_or(0.0, |body| body.velocity.y);
            let realised = velocity(0) - velocity(1);
            if (realised - e).abs() > (worst - e).abs() {
                worst = realised;
            }
        }
    }
    worst
}
