//! Oblique impacts: the tangential restitution `e_t` = `v_t'`/`v_t` against the angle from the normal.

use particle_damper::glam::DVec3;
use particle_damper::{
    HertzMindlin, HertzTsuji, Materials, Particle, RestitutionImpulse, VelocityVerlet,
};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::{collide, hertz_constant, hertz_duration, material};

const RIGID: &str =
    "rigid sphere, Coulomb friction; Chung & Ooi 2011, doi 10.1007/s10035-011-0277-0";
const KHARAZ: &str = "Kharaz, Gorham & Salman 2001, doi 10.1016/S0032-5910(01)00283-2, measured";

/// Measured `e_t` of aluminium oxide spheres of 5 mm on glass at 3.9 m/s, by angle in degrees.
pub(crate) const MEASURED: [(f64, f64); 4] = [
    (9.63, 0.673),
    (20.08, 0.596),
    (30.22, 0.688),
    (49.55, 0.847),
];

/// The contact laws that are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Law {
    HertzTsuji,
    HertzMindlin,
    RestitutionImpulse,
}

/// `e_t` of rigid bodies: sliding, or rolling when the contact ends.
pub(crate) fn rigid_e_t(degrees: f64, mu: f64, e: f64) -> f64 {
    let tangent = degrees.to_radians().tan();
    if tangent >= 3.5 * mu * (1.0 + e) {
        1.0 - mu * (1.0 + e) / tangent
    } else {
        5.0 / 7.0
    }
}

/// Velocity (along the wall, away from it) and r w after an impact at 3.9 m/s, `degrees` from the
/// normal: an aluminium oxide sphere of 5 mm on glass.
pub(crate) fn rebound(law: Law, degrees: f64, mu: f64, e: f64) -> [f64; 3] {
    let mut materials = Materials::from(material(380e9, 0.23, e, mu));
    let glass = materials.add(material(70e9, 0.25, e, mu));
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let body = Particle::with_density(2.5e-3, 4000.0).unwrap();
    let normal = 3.9 * cosine;
    let k = hertz_constant((2.5e-3, 380e9, 0.23), (f64::INFINITY, 70e9, 0.25));
    let dt = hertz_duration(k, body.mass, normal) / 400.0;
    let bodies = [body.moving(3.9 * DVec3::new(sine, -cosine, 0.0))];
    let gap = 0.3 * normal * dt;
    let verlet = VelocityVerlet;
    let after = match law {
        Law::HertzTsuji => {
            let law = HertzTsuji::new(materials).reference_speed(normal).unwrap();
            collide(law, glass, verlet, dt, gap, &bodies)
        }
        Law::HertzMindlin => {
            let law = HertzMindlin::new(materials)
                .reference_speed(normal)
                .unwrap();
            collide(law, glass, verlet, dt, gap, &bodies)
        }
        Law::RestitutionImpulse => {
            let law = RestitutionImpulse::new(materials)
                .reference_speed(normal)
                .unwrap();
            collide(law, glass, verlet, dt, gap, &bodies)
        }
    };
    let body = after.bodies[0];
    [body.velocity.x, body.velocity.y, -body.spin.z * body.radius]
}

pub(crate) fn cases(form: Form) -> Vec<Case> {
    let mut cases = Vec::new();
    let angles: Vec<f64> = match form {
        Form::Short => vec![2.0, 20.0, 40.0, 60.0, 85.0],
        Form::Long => (1..=44)
            .map(|n| 2.0 * f64::from(n))
            .chain([32.0, 33.5, 89.0])
            .collect(),
    };
    for (mu, e) in [(0.092, 1.0), (0.092, 0.98), (0.3, 0.6), (0.0, 0.8)] {
        for &angle in &angles {
            for law in [Law::HertzTsuji, Law::RestitutionImpulse, Law::HertzMindlin] {
                let tangent = angle.to_radians().tan();
                let slides = tangent > 1.3 * 3.5 * mu * (1.0 + e);
                if law == Law::HertzMindlin && !slides {
                    continue;
                }
                let incoming = 3.9 * angle.to_radians().sin();
                let [along, _, surface] = rebound(law, angle, mu, e);
                let expected = rigid_e_t(angle, mu, e);
                let spin = 2.5 * (1.0 - expected);
                let name = |what| format!("mu {mu}, e {e}, {angle} deg, {law:?}: {what}");
                let close = Tolerance::Absolute(2e-3);
                cases.push(Case::new(
                    name("e_t"),
                    RIGID,
                    expected,
                    along / incoming,
                    close,
                ));
                cases.push(Case::new(
                    name("w r / v_t"),
                    RIGID,
                    spin,
                    surface / incoming,
                    close,
                ));
            }
        }
    }
    let printed = Tolerance::Absolute(5e-7);
    cases.push(Case::new(
        "mu 0.092, e 1, 40 deg, printed row",
        RIGID,
        0.780_717,
        rigid_e_t(40.0, 0.092, 1.0),
        printed,
    ));
    for (angle, measured) in MEASURED {
        let [along, ..] = rebound(Law::HertzMindlin, angle, 0.092, 0.98);
        let got = along / (3.9 * angle.to_radians().sin());
        let name = format!("oxide on glass, {angle} deg, HertzMindlin: e_t");
        cases.push(Case::new(
            name,
            KHARAZ,
            measured,
            got,
            Tolerance::Absolute(0.05),
        ));
    }
    let [along, ..] = rebound(Law::HertzMindlin, 20.08, 0.092, 0.98);
    let got = along / (3.9 * 20.08_f64.to_radians().sin());
    cases.push(Case::bounded(
        "the tangential spring rebounds below rolling: e_t at 20.08 deg",
        KHARAZ,
        5.0 / 7.0 - 0.05,
        got,
    ));
    cases
}
