//! The eight benchmark impacts of Chung & Ooi (2011). Cases 1 to 3 against Hertz and the restitution
//! asked for, 4 to 8 against the theory of rigid bodies with Coulomb friction.

use particle_damper::glam::DVec3;
use particle_damper::{
    ContactLaw, HertzMindlin, HertzTsuji, MaterialId, Particle, RestitutionImpulse, VelocityVerlet,
};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::{
    Collision, collide, elastic_impact, hertz_constant, hertz_duration, material, on_rigid,
};

const SOURCE: &str = "Chung & Ooi 2011, doi 10.1007/s10035-011-0277-0";
const RIGID: &str =
    "Chung & Ooi 2011, doi 10.1007/s10035-011-0277-0; rigid bodies, Coulomb friction";

pub(crate) fn cases(form: Form) -> Vec<Case> {
    let mut cases = elastic();
    cases.extend(restitution());
    cases.extend(oblique(form));
    cases.extend(spinning());
    cases
}

/// Cases 1 and 2: elastic impacts of two spheres, and of a sphere on a rigid plane.
fn elastic() -> Vec<Case> {
    let mut cases = Vec::new();
    for (number, name, radius, modulus, ratio, density, speed, pair) in [
        (1, "glass", 0.01, 48e9, 0.20, 2800.0, 10.0, true),
        (1, "magnesium alloy", 0.01, 40e9, 0.35, 1800.0, 10.0, true),
        (2, "aluminium alloy", 0.1, 70e9, 0.30, 2699.0, 0.2, false),
        (2, "magnesium alloy", 0.1, 40e9, 0.35, 1800.0, 0.2, false),
    ] {
        let (materials, rigid) = on_rigid(material(modulus, ratio, 1.0, 0.0));
        let sphere = Particle::with_density(radius, density).unwrap();
        let one = sphere.moving(DVec3::NEG_Y * speed);
        let this = (radius, modulus, ratio);
        let (bodies, other, m, v) = if pair {
            let two = sphere.moving(DVec3::Y * speed);
            (vec![one, two], this, 0.5 * sphere.mass, 2.0 * speed)
        } else {
            (vec![one], (f64::INFINITY, 1e30, 0.0), sphere.mass, speed)
        };
        let k = hertz_constant(this, other);
        let name = format!("case {number}, {name}");
        cases.extend(elastic_impact(
            &name,
            SOURCE,
            (materials, rigid),
            &bodies,
            (k, m, v),
        ));
    }
    for (what, printed, expected) in [
        (
            "case 1, glass: overlap (m)",
            274.113e-6,
            (48e9, 0.2, 2800.0, 0.005, 0.5, 20.0),
        ),
        (
            "case 2, aluminium: overlap (m)",
            49.717e-6,
            (140e9, 0.3, 2699.0, 0.1, 1.0, 0.2),
        ),
    ]
    .map(
        |(what, printed, (modulus, ratio, density, radius, part, v))| {
            let k: f64 = 4.0 / 3.0 * modulus / (2.0 * (1.0 - ratio * ratio)) * f64::sqrt(radius);
            let sphere: f64 = if part < 1.0 { 0.01 } else { 0.1 };
            let m = part * density * 4.0 / 3.0 * std::f64::consts::PI * sphere.powi(3);
            (what, printed, (1.25 * m * v * v / k).powf(0.4))
        },
    ) {
        let name = format!("{what}, printed row");
        cases.push(Case::new(
            name,
            SOURCE,
            printed,
            expected,
            Tolerance::Relative(2e-5),
        ));
    }
    cases
}

/// Case 3: the restitution asked for comes out, 0.2 to 1.
fn restitution() -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, modulus, ratio, density) in [
        ("aluminium oxide", 380e9, 0.23, 4000.0),
        ("cast iron", 100e9, 0.25, 7000.0),
    ] {
        let sphere = Particle::with_density(2.5e-3, density).unwrap();
        let one = sphere.moving(DVec3::NEG_Y * 3.9);
        let k = hertz_constant((2.5e-3, modulus, ratio), (f64::INFINITY, 1e30, 0.0));
        let dt = hertz_duration(k, sphere.mass, 3.9) / 200.0;
        for e in [0.2, 0.4, 0.6, 0.8, 1.0] {
            let (materials, rigid) = on_rigid(material(modulus, ratio, e, 0.0));
            let strict = HertzTsuji::new(materials.clone())
                .reference_speed(3.9)
                .unwrap();
            let coarse = RestitutionImpulse::new(materials);
            let gap = 0.3 * 3.9 * dt;
            let verlet = VelocityVerlet::default;
            for (impact, law) in [
                (
                    collide(strict, rigid, verlet(), dt, gap, &[one]),
                    "HertzTsuji",
                ),
                (
                    collide(coarse, rigid, verlet(), 1e-5, gap, &[one]),
                    "RestitutionImpulse",
                ),
            ] {
                let got = impact.bodies[0].velocity.y / 3.9;
                let name = format!("case 3, {name}, {law}: restitution");
                cases.push(Case::new(name, SOURCE, e, got, Tolerance::Absolute(1e-3)));
            }
        }
    }
    cases
}

/// An impact of rigid spheres: what the tangential impulse makes of the motion. `slip` is the
/// surface velocity of the first relative to the second along x, `v` the normal approach.
/// Returns (change of v1x, of w1z, of v2x, of w2z).
pub(crate) fn rigid_impact(
    first: &Particle,
    second: Option<&Particle>,
    v: f64,
    slip: f64,
    mu: f64,
    e: f64,
) -> [f64; 4] {
    let inverse = second.map_or(0.0, |body| 1.0 / body.mass);
    let m = 1.0 / (1.0 / first.mass + inverse);
    let sticking = 2.0 / 7.0 * m * slip.abs();
    let sliding = mu * m * (1.0 + e) * v;
    let j = sticking.min(sliding) * slip.signum();
    // The impulse on the first is -j x at -r1 y from its centre, on the second j x at +r2 y.
    let turn = |body: &Particle| -2.5 * j / (body.mass * body.radius);
    [
        -j / first.mass,
        turn(first),
        j * inverse,
        second.map_or(0.0, turn),
    ]
}

/// Slip along x of two bodies that touch along y, the first above.
pub(crate) fn slip(first: &Particle, second: Option<&Particle>) -> f64 {
    let below = second.map_or(0.0, |body| body.velocity.x - body.spin.z * body.radius);
    first.velocity.x + first.spin.z * first.radius - below
}

/// The cases of an impact under one law, named `name`.
fn compare(name: &str, bodies: &[Particle], e: f64, mu: f64, after: &Collision) -> Vec<Case> {
    let (first, second) = (&bodies[0], bodies.get(1));
    let v = second.map_or(0.0, |body| body.velocity.y) - first.velocity.y;
    let change = rigid_impact(first, second, v, slip(first, second), mu, e);
    let mut cases = Vec::new();
    // Normal impulse over mass, the scale of every tangential change.
    let scale = |body: &Particle| {
        let inverse = second.map_or(0.0, |body| 1.0 / body.mass);
        (1.0 + e) * v / (1.0 / first.mass + inverse) / body.mass
    };
    for (n, body) in bodies.iter().enumerate() {
        let now = &after.bodies[n];
        let close = Tolerance::Absolute(3e-3);
        let unit = scale(body);
        let (expected, got) = (body.velocity.x + change[2 * n], now.velocity.x);
        let what = format!("{name}: v_t of body {} / ((1+e) v_n m*/m)", n + 1);
        cases.push(Case::new(what, RIGID, expected / unit, got / unit, close));
        let (expected, got) = (body.spin.z + change[2 * n + 1], now.spin.z);
        let unit = unit / body.radius;
        let what = format!("{name}: w r of body {} / ((1+e) v_n m*/m)", n + 1);
        cases.push(Case::new(what, RIGID, expected / unit, got / unit, close));
    }
    cases
}

/// Runs an impact under the laws that rigid-body theory holds for: both without a tangential spring,
/// and the one with a spring where the bodies slide throughout.
fn impact(
    name: &str,
    elastic: (f64, f64),
    coefficients: (f64, f64),
    bodies: &[Particle],
) -> Vec<Case> {
    let (e, mu) = coefficients;
    let (materials, rigid) = on_rigid(material(elastic.0, elastic.1, e, mu));
    let (first, second) = (&bodies[0], bodies.get(1));
    let v = second.map_or(0.0, |body| body.velocity.y) - first.velocity.y;
    let this = (first.radius, elastic.0, elastic.1);
    let other = second.map_or((f64::INFINITY, 1e30, 0.0), |body| {
        (body.radius, elastic.0, elastic.1)
    });
    let inverse = second.map_or(0.0, |body| 1.0 / body.mass);
    let m = 1.0 / (1.0 / first.mass + inverse);
    let dt = hertz_duration(hertz_constant(this, other), m, v) / 400.0;
    let gap = 0.3 * v * dt;

    let run =
        |law: &str, after: Collision| compare(&format!("{name}, {law}"), bodies, e, mu, &after);
    let strict = HertzTsuji::new(materials.clone())
        .reference_speed(v)
        .unwrap();
    let mut cases = run("HertzTsuji", verlet(strict, rigid, dt, gap, bodies));
    let coarse = RestitutionImpulse::new(materials.clone());
    let coarse = coarse.reference_speed(10.0).unwrap();
    cases.extend(run(
        "RestitutionImpulse",
        verlet(coarse, rigid, dt, gap, bodies),
    ));
    if slip(first, second).abs() > 1.3 * 3.5 * mu * (1.0 + e) * v {
        let spring = HertzMindlin::new(materials).reference_speed(v).unwrap();
        cases.extend(run("HertzMindlin", verlet(spring, rigid, dt, gap, bodies)));
    }
    cases
}

fn verlet<L: ContactLaw>(
    law: L,
    walls: MaterialId,
    dt: f64,
    gap: f64,
    bodies: &[Particle],
) -> Collision {
    collide(law, walls, VelocityVerlet, dt, gap, bodies)
}

/// Cases 4 (constant speed, various angles) and 5 (constant normal speed, various tangential ones).
fn oblique(form: Form) -> Vec<Case> {
    let mut cases = Vec::new();
    let angles: &[f64] = match form {
        Form::Short => &[5.0, 30.0, 40.0, 70.0],
        Form::Long => &[
            1.0, 5.0, 10.0, 20.0, 30.0, 32.0, 34.0, 40.0, 50.0, 60.0, 70.0, 80.0, 89.0,
        ],
    };
    let oxide = Particle::with_density(2.5e-3, 4000.0).unwrap();
    for &angle in angles {
        let (sine, cosine) = angle.to_radians().sin_cos();
        let body = oxide.moving(3.9 * DVec3::new(sine, -cosine, 0.0));
        let name = format!("case 4, aluminium oxide, {angle} deg");
        cases.extend(impact(&name, (380e9, 0.23), (0.98, 0.092), &[body]));
        let name = format!("case 4, the same elastic, {angle} deg");
        cases.extend(impact(&name, (380e9, 0.23), (1.0, 0.092), &[body]));
    }
    for (name, modulus, ratio, density) in [
        ("steel", 208e9, 0.3, 7850.0),
        ("polyethylene", 1e9, 0.4, 1400.0),
    ] {
        let sphere = Particle::with_density(0.1, density).unwrap();
        for tangential in [0.5, 3.0, 10.0, 15.0, 40.0] {
            let body = sphere.moving(DVec3::new(tangential, -5.0, 0.0));
            let name = format!("case 5, {name}, v_t {tangential} m/s");
            cases.extend(impact(&name, (modulus, ratio), (1.0, 0.3), &[body]));
        }
    }
    cases
}

/// Cases 6 (spinning sphere on a plane), 7 (equal spheres) and 8 (unequal spheres).
fn spinning() -> Vec<Case> {
    let mut cases = Vec::new();
    let (fall, pair) = (DVec3::NEG_Y * 0.2, (0.5, 0.4));
    for (name, modulus, ratio, density) in [
        ("aluminium alloy", 70e9, 0.33, 2700.0),
        ("copper", 120e9, 0.35, 8900.0),
    ] {
        let sphere = Particle::with_density(0.1, density).unwrap();
        let small = Particle::with_density(0.02, density).unwrap();
        let elastic = (modulus, ratio);
        for spin in [-20.0, -2.0, 1.0, 4.0, 4.4, 8.0, 24.0] {
            let turning = DVec3::Z * spin;
            let upper = sphere.moving(fall).spinning(turning);
            let label = format!("{name}, {spin} rad/s");
            cases.extend(impact(&format!("case 6, {label}"), elastic, pair, &[upper]));
            let lower = sphere.moving(-fall);
            let opposite = lower.spinning(-turning);
            let what = format!("case 7, {label}, opposite");
            cases.extend(impact(&what, elastic, pair, &[upper, opposite]));
            let what = format!("case 7, {label}, alike");
            cases.extend(impact(
                &what,
                elastic,
                pair,
                &[upper, lower.spinning(turning)],
            ));
            let what = format!("case 8, {label}");
            let upper = small.moving(fall).spinning(turning);
            cases.extend(impact(&what, elastic, pair, &[upper, lower]));
        }
    }
    cases
}
