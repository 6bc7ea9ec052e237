//! The paper's system: constants of its contacts, response of the empty container, and the bed as a
//! rigid added mass while it stays on the floor.

use std::f64::consts::TAU;

use particle_damper::excitation::Harmonic;
use particle_damper::glam::dvec3;
use particle_damper::mount::SingleDof;
use particle_damper::{
    AllPairs, Bodies, Body, CellGrid, ContactLaw, Damper, Detector, Filling, HertzMindlin,
    HertzTsuji, Integrator, LinkedCells, Material, Materials, RestitutionImpulse, RungeKutta4,
    Skin, Slot, VelocityVerlet,
};

use super::Form;
use super::case::{Case, Tolerance};
use super::contacts::restitution_at;
use super::setup::paper_particle;

const PAPER: &str = "Komatsuzaki & Iwata 2017, doi 10.1007/s10999-016-9344-3";
const TEXTBOOK: &str = "linear oscillator of M + N m";
/// M (kg), K (N/m), C (N s/m) and F (N) of Table 1.
const MASS: f64 = 0.086;
const K: f64 = 123.4;
const C: f64 = 0.08;
const F: f64 = 0.25;

pub(crate) fn cases(form: Form) -> Vec<Case> {
    let mut cases = constants();
    cases.extend(empty());
    cases.extend(added_mass(form));
    cases.push(settled());
    cases
}

/// RMS over F/K of the oscillator of `mass` at `f`.
pub(crate) fn linear(mass: f64, f: f64) -> f64 {
    let omega = TAU * f;
    K / ((K - mass * omega * omega).hypot(C * omega) * 2.0_f64.sqrt())
}

fn constants() -> Vec<Case> {
    let law = HertzTsuji::new(Material::acrylic());
    let sphere = Body::sphere(3e-3, 0.2e-3, Materials::FIRST);
    let wall = Bodies::new(sphere, Body::wall(Materials::FIRST));
    let pair = Bodies::new(sphere, sphere);
    let k = |bodies| law.normal_stiffness(&bodies).unwrap();
    let mut cases = Vec::new();
    let mut check = |name: &str, printed, got, digits| {
        cases.push(Case::new(
            name,
            PAPER,
            printed,
            got,
            Tolerance::Relative(digits),
        ));
    };
    check("k_wall (N m^-1.5)", 1.605_048e7, k(wall), 5e-7);
    check("k_pair (N m^-1.5)", 1.134_940e7, k(pair), 5e-7);
    check(
        "k_wall/k_pair, equal materials",
        2.0_f64.sqrt(),
        k(wall) / k(pair),
        1e-14,
    );
    check(
        "c_wall (N s m^-1.5)",
        183.41,
        law.damping_coefficient(&wall).unwrap(),
        3e-5,
    );
    for (bodies, name, duration, overlap, force) in [
        (pair, "pair", 121.8e-6, 41.38e-6, 3.021),
        (wall, "wall", 139.9e-6, 47.53e-6, 5.260),
    ] {
        let impact = law.elastic_impact(&bodies, 1.0).unwrap();
        check(
            &format!("{name} at 1 m/s: duration (s)"),
            duration,
            impact.duration(),
            5e-4,
        );
        check(
            &format!("{name} at 1 m/s: overlap (m)"),
            overlap,
            impact.overlap(),
            2e-4,
        );
        check(
            &format!("{name} at 1 m/s: force (N)"),
            force,
            impact.force(),
            2e-4,
        );
    }
    for (speed, e) in [(0.1, 0.83077), (1.0, 0.75), (3.0, 0.70242)] {
        let damping = particle_damper::Damping::Viscoelastic;
        let got = restitution_at(damping, particle_damper::Ending::NeverPulling, 0.75, speed);
        check(&format!("e for c_wall at {speed} m/s"), e, got, 1e-4);
    }
    let frequency = (K / MASS).sqrt() / TAU;
    check("natural frequency (Hz)", 6.028_767, frequency, 1e-7);
    check(
        "damping ratio",
        0.012_278_72,
        C / (2.0 * (K * MASS).sqrt()),
        5e-7,
    );
    check("static deflection (m)", 2.025_932e-3, F / K, 5e-7);
    for (f, printed) in [
        (6.027_858, 28.79616),
        (4.0, 1.262_637),
        (5.0, 2.260_350),
        (6.0, 26.95888),
        (7.0, 2.024_247),
        (8.0, 0.928_510),
    ] {
        check(
            &format!("formula, empty, {f} Hz: RMS/(F/K)"),
            printed,
            linear(MASS, f),
            5e-7,
        );
    }
    cases
}

/// RMS of x about zero, its standard deviation and its mean, over F/K, of `count` particles at `f`:
/// `pass` seconds pass, then 40 periods.
pub(crate) fn response<L: ContactLaw, D: Detector + Clone, I: Integrator>(
    law: L,
    detector: D,
    integrator: I,
    (count, f): (usize, f64),
    (dt, pass): (f64, f64),
) -> [f64; 3] {
    let bed = Filling::new(1)
        .with(count, paper_particle())
        .fill(&Slot::paper())
        .unwrap();
    let mut damper = Damper::builder(Slot::paper(), law)
        .mount(SingleDof::paper().excited_by(Harmonic::new(F, f).unwrap()))
        .detector(detector)
        .integrator(integrator)
        .particles(bed)
        .time_step(dt)
        .build()
        .unwrap();
    while damper.time() < pass {
        damper.step().unwrap();
    }
    let steps = (40.0 / (f * dt)).round();
    let (mut sum, mut squares) = (0.0, 0.0);
    for _ in 0..steps as u64 {
        damper.step().unwrap();
        let x = damper.coordinates()[0] * K / F;
        sum += x;
        squares += x * x;
    }
    let (mean, square) = (sum / steps, squares / steps);
    [square.sqrt(), (square - mean * mean).sqrt(), mean]
}

fn empty() -> Vec<Case> {
    let mut cases = Vec::new();
    for f in [4.0, 5.0, 5.6, 6.0, 6.027_858, 7.0, 8.0] {
        let law = || RestitutionImpulse::new(Material::acrylic());
        let (run, plan) = ((0, f), (1e-4, 30.0));
        let verlet = response(law(), AllPairs, VelocityVerlet, run, plan);
        let kutta = response(law(), AllPairs, RungeKutta4::default(), run, plan);
        for ([rms, ..], integrator) in [(verlet, "VelocityVerlet"), (kutta, "RungeKutta4")] {
            let name = format!("empty, {f} Hz, {integrator}: RMS/(F/K)");
            let close = Tolerance::Relative(1e-4);
            cases.push(Case::new(name, TEXTBOOK, linear(MASS, f), rms, close));
        }
    }
    cases
}

/// The bed stays on the floor while sqrt 2 RMS w^2 < g, and is then a part of the mass.
fn added_mass(form: Form) -> Vec<Case> {
    let mut cases = Vec::new();
    let rows: &[(usize, f64)] = match form {
        Form::Short => &[(20, 5.2)],
        Form::Long => &[(60, 5.0), (20, 5.2), (40, 5.0), (20, 4.5), (60, 4.0)],
    };
    for &(count, f) in rows {
        let mass = MASS + 0.2e-3 * count as f64;
        let expected = linear(mass, f);
        let shift = -(count as f64) * 0.2e-3 * 9.81 / F;
        let coarse = || RestitutionImpulse::new(Material::acrylic());
        let strict = || HertzTsuji::new(Material::acrylic());
        let (run, slow, fine) = ((count, f), (1e-4, 25.0), (2e-5, 25.0));
        let verlet = VelocityVerlet::default;
        let grid = CellGrid::new(64, 40).unwrap();
        let mut runs = vec![
            (
                "RestitutionImpulse, VelocityVerlet",
                response(
                    coarse(),
                    Skin::<LinkedCells>::default(),
                    verlet(),
                    run,
                    slow,
                ),
            ),
            (
                "RestitutionImpulse, RungeKutta4",
                response(coarse(), grid.clone(), RungeKutta4::default(), run, slow),
            ),
        ];
        if form == Form::Long {
            runs.push((
                "RestitutionImpulse, AllPairs",
                response(coarse(), AllPairs, verlet(), run, slow),
            ));
            runs.push((
                "HertzTsuji, VelocityVerlet",
                response(
                    strict(),
                    Skin::<LinkedCells>::default(),
                    verlet(),
                    run,
                    fine,
                ),
            ));
            runs.push((
                "HertzTsuji, RungeKutta4, grid",
                response(strict(), grid, RungeKutta4::default(), run, fine),
            ));
            let mindlin = HertzMindlin::new(Material::acrylic());
            runs.push((
                "HertzMindlin, VelocityVerlet",
                response(mindlin, Skin::<LinkedCells>::default(), verlet(), run, fine),
            ));
        }
        for (parts, [_, deviation, mean]) in runs {
            let name = |what| format!("N {count}, {f} Hz, {parts}: {what}");
            let close = Tolerance::Relative(3e-4);
            cases.push(Case::new(
                name("standard deviation/(F/K)"),
                TEXTBOOK,
                expected,
                deviation,
                close,
            ));
            let close = Tolerance::Absolute(1e-3);
            cases.push(Case::new(name("mean/(F/K)"), TEXTBOOK, shift, mean, close));
        }
    }
    for (count, f, printed) in [(60, 5.0, 3.2563), (20, 5.2, 3.1788)] {
        let got = linear(MASS + 0.2e-3 * f64::from(count), f);
        let name = format!("N {count}, {f} Hz, printed row: standard deviation/(F/K)");
        cases.push(Case::new(
            name,
            PAPER,
            printed,
            got,
            Tolerance::Absolute(5e-5),
        ));
    }
    cases
}

/// One particle at rest on the floor: (m g/`k_wall`)^(2/3).
fn settled() -> Case {
    let ball = paper_particle();
    let expected = (ball.mass * 9.81 / 1.605_048e7_f64).powf(2.0 / 3.0);
    let mut damper = Damper::builder(Slot::paper(), HertzTsuji::new(Material::acrylic()))
        .particles([ball.at(dvec3(0.03, ball.radius, 0.0))])
        .time_step(2e-5)
        .build()
        .unwrap();
    for _ in 0..50_000 {
        damper.step().unwrap();
    }
    let overlap = ball.radius - damper.particle(0).unwrap().position.y;
    let close = Tolerance::Relative(1e-4);
    Case::new(
        "overlap of a particle at rest (m)",
        PAPER,
        expected,
        overlap,
        close,
    )
}
