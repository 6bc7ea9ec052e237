//! Order of the integrators: on smooth motion the one they are known by, on Hertz contacts less.
//!
//! A contact sets in between two steps, where the force is not smooth: k d^(3/2) has an infinite
//! second derivative, c d^(1/2) d' an infinite first one. Left to itself a step across that point errs
//! as its length to the power 5/2 and 3/2 (5/4 with d^(1/4)), once per contact, whatever the order of
//! the method. The strict laws make up for it at first touch, which leaves the second order of all
//! else, under [`RungeKutta4`] with a tenth of the error; where a pull ends a contact it is not made up
//! for. Errors are taken over all phases of first touch.

use std::f64::consts::TAU;

use particle_damper::excitation::Harmonic;
use particle_damper::glam::DVec3;
use particle_damper::mount::SingleDof;
use particle_damper::{
    Damper, Damping, Ending, HertzTsuji, Integrator, Material, Materials, RestitutionImpulse,
    RungeKutta4, Slot, VelocityVerlet,
};

use super::Form;
use super::case::{Case, Tolerance};
use super::mfix::{stack_at, stack_by_crate};
use super::setup::{acrylic, collide, hertz_constant, hertz_duration, paper_particle};

const ORDER: &str =
    "order of the method; Hairer, Norsett & Wanner 1993, doi 10.1007/978-3-540-78862-1";
const KINK: &str = "second order but for the end of a pull, t^(p+1) of a force t^p; Navot 1961, doi 10.1002/sapm1961401271";

pub(crate) fn cases(_: Form) -> Vec<Case> {
    let mut cases = smooth();
    cases.extend(contacts());
    cases
}

fn order(coarse: f64, fine: f64, ratio: f64) -> f64 {
    (coarse / fine).ln() / ratio.ln()
}

/// Error of the driven oscillator after two seconds, in m: started on its steady state.
fn oscillator<I: Integrator>(integrator: I, dt: f64) -> f64 {
    let (mass, k, c, force, f) = (0.086, 123.4, 0.08, 0.25, 5.0);
    let omega = TAU * f;
    let (real, imaginary) = (k - mass * omega * omega, c * omega);
    let square = real * real + imaginary * imaginary;
    let (sine, cosine) = (force * real / square, -force * imaginary / square);
    let mount = SingleDof::new(mass, c, k).unwrap();
    let mut damper = Damper::builder(Slot::paper(), RestitutionImpulse::new(Material::acrylic()))
        .integrator(integrator)
        .mount(
            mount
                .released_from(cosine, sine * omega)
                .unwrap()
                .excited_by(Harmonic::new(force, f).unwrap()),
        )
        .time_step(dt)
        .build()
        .unwrap();
    let steps = (2.0 / dt).round() as u32;
    for _ in 0..steps {
        damper.step().unwrap();
    }
    let phase = omega * dt * f64::from(steps);
    let exact = sine * phase.sin() + cosine * phase.cos();
    let rate = sine * phase.cos() - cosine * phase.sin();
    (damper.coordinates()[0] - exact).hypot(damper.rates()[0] / omega - rate)
}

/// Oscillator, and two balls that never part from each other and the walls.
fn smooth() -> Vec<Case> {
    let mut cases = Vec::new();
    let mut check = |name: &str, expected, got| {
        cases.push(Case::new(
            name,
            ORDER,
            expected,
            got,
            Tolerance::Absolute(0.15),
        ));
    };
    let verlet = |dt| oscillator(VelocityVerlet::default(), dt);
    let kutta = |dt| oscillator(RungeKutta4::default(), dt);
    check(
        "VelocityVerlet, oscillator: order",
        2.0,
        order(verlet(1e-3), verlet(2.5e-4), 4.0),
    );
    check(
        "RungeKutta4, oscillator: order",
        4.0,
        order(kutta(8e-3), kutta(2e-3), 4.0),
    );

    let (radius, densities, k, e) = (5e-4, [2e4, 1e4], 1e3, 0.9);
    let volume = 4.0 / 3.0 * std::f64::consts::PI * f64::powi(radius, 3);
    let time = 2e-4;
    let exact = stack_at(
        densities.map(|density| density * volume),
        k,
        e,
        radius,
        time,
    );
    let error = |state: [f64; 4]| (state[0] - exact[0]).hypot(state[1] - exact[1]);
    let verlet = |steps| {
        error(stack_by_crate(
            VelocityVerlet::default(),
            densities,
            k,
            e,
            (radius, time, steps),
        ))
    };
    let kutta = |steps| {
        error(stack_by_crate(
            RungeKutta4::default(),
            densities,
            k,
            e,
            (radius, time, steps),
        ))
    };
    check(
        "VelocityVerlet, damped balls in touch: order",
        2.0,
        order(verlet(100), verlet(400), 4.0),
    );
    check(
        "RungeKutta4, damped balls in touch: order",
        4.0,
        order(kutta(20), kutta(80), 4.0),
    );
    cases
}

/// RMS error of the restitution of an impact at 1 m/s over sixteen phases of first touch.
pub(crate) fn impact_error<I: Integrator>(
    integrator: impl Fn() -> I,
    (damping, ending): (Damping, Ending),
    e: f64,
    steps: f64,
) -> f64 {
    let law = HertzTsuji::new(acrylic(e, 0.0));
    let law = law.damping(damping).ending(ending);
    let body = paper_particle().moving(DVec3::NEG_Y);
    let k = hertz_constant((3e-3, 0.4e9, 0.3), (f64::INFINITY, 0.4e9, 0.3));
    let dt = hertz_duration(k, body.mass, 1.0) / steps;
    let squares = (0..16).map(|n| {
        let gap = dt * (f64::from(n) + 0.37) / 16.0;
        let impact = collide(&law, Materials::FIRST, integrator(), dt, gap, &[body]);
        (impact.bodies[0].velocity.y - e).powi(2)
    });
    (squares.sum::<f64>() / 16.0).sqrt()
}

/// Orders from 64 to 1024 steps to a contact, and what 100 steps are good for.
fn contacts() -> Vec<Case> {
    let (pushing, pulling) = (Ending::NeverPulling, Ending::PullingAllowed);
    let mut cases = Vec::new();
    for (name, law, e, expected) in [
        ("elastic", (Damping::Viscoelastic, pushing), 1.0, 2.5),
        (
            "d^(1/2) damping",
            (Damping::Viscoelastic, pushing),
            0.75,
            2.0,
        ),
        (
            "d^(1/2) damping",
            (Damping::Viscoelastic, pushing),
            0.3,
            2.0,
        ),
        ("d^(1/4) damping", (Damping::Tsuji, pushing), 0.75, 2.0),
        ("d^(1/4) damping", (Damping::Tsuji, pushing), 0.3, 2.0),
        (
            "d^(1/2) damping with a pull",
            (Damping::Viscoelastic, pulling),
            0.5,
            1.5,
        ),
        (
            "d^(1/4) damping with a pull",
            (Damping::Tsuji, pulling),
            0.5,
            1.25,
        ),
    ] {
        let verlet = |steps| impact_error(VelocityVerlet::default, law, e, steps);
        let kutta = |steps| impact_error(RungeKutta4::default, law, e, steps);
        for (integrator, [coarse, fine, hundred]) in [
            ("VelocityVerlet", [64.0, 1024.0, 100.0].map(verlet)),
            ("RungeKutta4", [64.0, 1024.0, 100.0].map(kutta)),
        ] {
            let name = |what| format!("{integrator}, Hertz impact, {name}, e {e}: {what}");
            // Never worse, by more than chance among sixteen phases.
            let least = -order(coarse, fine, 16.0);
            cases.push(Case::bounded(
                name("minus the order of the restitution"),
                KINK,
                0.2 - expected,
                least,
            ));
            cases.push(Case::bounded(
                name("RMS error of e at 100 steps to a contact"),
                KINK,
                if law.1 == pulling { 5e-4 } else { 2.5e-4 },
                hundred,
            ));
        }
    }
    cases
}
