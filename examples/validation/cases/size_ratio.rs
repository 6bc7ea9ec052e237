//! Friction between bodies of very unlike size, at coarse steps against small ones.
//!
//! Where friction sees velocities of one time and positions of another, part of the approach is taken for
//! slip, and at size ratios above three particles end where they should not: Vyas et al. 2024,
//! arXiv 2410.14798. Here the ratio is ten.

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{ContactLaw, Cuboid, Damper, HertzMindlin, HertzTsuji, Particle};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::{acrylic, hertz_constant, hertz_duration, paper_particle};

const VYAS: &str = "the same with 400 steps to a contact; Vyas et al. 2024, arXiv 2410.14798";

const ROLLING: &str = "rolling without slip, v^2 = 10/7 g (R + r) (1 - cos)";

const GRAVITY: f64 = 9.81;

/// A sphere of a `part` of the radius and of the same material.
fn small(part: f64) -> Particle {
    let large = paper_particle();
    Particle::new(part * large.radius, part.powi(3) * large.mass).unwrap()
}

/// Velocity and surface speed of the spin (m/s) of a sphere of `part` of the radius after it has met the
/// large one at 1 m/s, `degrees` from the normal and with a surface speed `spin` (m/s).
fn oblique<L: ContactLaw + Clone>(
    law: &L,
    part: f64,
    steps: f64,
    [degrees, spin]: [f64; 2],
) -> [DVec3; 2] {
    let (large, small) = (paper_particle(), small(part));
    let k = hertz_constant((large.radius, 0.4e9, 0.3), (small.radius, 0.4e9, 0.3));
    let mass = 1.0 / (1.0 / large.mass + 1.0 / small.mass);
    let dt = hertz_duration(k, mass, 1.0) / steps;
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let centre = DVec3::splat(0.05);
    let reach = large.radius + small.radius;
    let thrown = small
        .at(centre + DVec3::Y * (reach + 0.4 * dt))
        .moving(dvec3(sine, -cosine, 0.0))
        .spinning(DVec3::Z * (spin / small.radius));
    let mut damper = Damper::builder(Cuboid::new(DVec3::splat(0.1)).unwrap(), law.clone())
        .gravity(DVec3::ZERO)
        .particles([thrown, large.at(centre)])
        .time_step(dt)
        .build()
        .unwrap();
    for _ in 0..(4.0 * steps) as u32 {
        damper.step().unwrap();
    }
    let after = damper.particle(0).unwrap();
    [after.velocity, after.spin * small.radius]
}

/// Speed over the theoretical one of a small sphere that has rolled from the top of a large heavy one, 5
/// degrees off, down to 25 degrees.
fn rolled<L: ContactLaw + Clone>(law: &L, steps: f64) -> f64 {
    let (large, small) = (paper_particle(), small(0.1));
    // A hundred thousand times as heavy as the small one: it does not yield.
    let large = Particle::new(large.radius, 100.0 * large.mass).unwrap();
    let reach = large.radius + small.radius;
    let k = hertz_constant((large.radius, 0.4e9, 0.3), (small.radius, 0.4e9, 0.3));
    let dt = hertz_duration(k, small.mass, 1.0) / steps;
    let (sine, cosine) = 5.0_f64.to_radians().sin_cos();
    let sunk = (small.mass * GRAVITY * cosine / k).powf(2.0 / 3.0);
    let floor = hertz_constant((large.radius, 0.4e9, 0.3), (f64::INFINITY, 0.4e9, 0.3));
    let rests = large.radius - (large.mass * GRAVITY / floor).powf(2.0 / 3.0);
    let centre = dvec3(0.05, rests, 0.05);
    let normal = dvec3(sine, cosine, 0.0);
    let mut damper = Damper::builder(Cuboid::new(DVec3::splat(0.1)).unwrap(), law.clone())
        .gravity(DVec3::NEG_Y * GRAVITY)
        .particles([small.at(centre + normal * (reach - sunk)), large.at(centre)])
        .time_step(dt)
        .build()
        .unwrap();
    loop {
        damper.step().unwrap();
        let sphere = damper.particle(0).unwrap();
        let apart = sphere.position - damper.particle(1).unwrap().position;
        let down = apart.y / apart.length();
        if down < 25.0_f64.to_radians().cos() {
            let theory = 10.0 / 7.0 * GRAVITY * reach * (cosine - down);
            return sphere.velocity.length() / theory.sqrt();
        }
    }
}

fn of_law<L: ContactLaw + Clone>(name: &str, law: &L) -> Vec<Case> {
    let mut cases = Vec::new();
    // Friction over few steps has an error of its own, which equal spheres show, each half of it: the
    // small one of two unlike ones has it all.
    let [equal, unlike] = [1.0, 0.1].map(|part| {
        let mut squares = 0.0;
        for degrees in [10.0, 25.0, 40.0, 55.0, 70.0, 85.0] {
            for spin in [-1.0, 0.0, 1.0] {
                let after = |steps| oblique(law, part, steps, [degrees, spin]);
                let (coarse, exact) = (after(8.0), after(400.0));
                let errors = coarse.iter().zip(&exact);
                squares += errors.map(|(a, b)| a.distance_squared(*b)).sum::<f64>();
            }
        }
        (squares / 36.0).sqrt()
    });
    cases.push(Case::bounded(
        format!(
            "{name}: RMS error of velocities after oblique impacts, over that of equal spheres"
        ),
        VYAS,
        2.0,
        unlike / equal,
    ));
    cases.push(Case::new(
        format!("{name}: speed after rolling down over the theoretical one"),
        ROLLING,
        1.0,
        rolled(law, 8.0),
        Tolerance::Relative(2e-3),
    ));
    cases
}

pub(crate) fn cases(_: Form) -> Vec<Case> {
    let material = acrylic(0.75, 0.3);
    let mut cases = of_law("HertzTsuji", &HertzTsuji::new(material));
    cases.extend(of_law("HertzMindlin", &HertzMindlin::new(material)));
    cases
}
