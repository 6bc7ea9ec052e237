//! Order of the integrators: on smooth motion the one they are known by, on Hertz contacts less.
//!
//! A contact sets in between two steps, where the force is not smooth: k d^(3/2) has an infinite
//! second derivative, c d^(1/2) d' an infinite first one. Left to itself a step across that point errs
//! as its length to the power 5/2 and 3/2 (5/4 with d^(1/4)), once per contact, whatever the order of
//! the method. The strict laws make up for it at first touch, which leaves the second order of all
//! else; where a pull ends a contact they do so under [`VelocityVerlet`] alone. Errors are taken over all
//! phases of first touch.

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
const KINK: &str = "second order but for the end of a pull under Runge-Kutta, t^(p+1) of a force t^p; Navot 1961, doi 10.1002/sapm1961401271";

const MANUAL: &str = "what the page guide::trust says of steps to a contact";

pub(crate) fn cases(_: Form) -> Vec<Case> {
    let mut cases = smooth();
    cases.extend(contacts());
    cases.extend(steps_to_a_contact());
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
    let verlet = |dt| oscillator(VelocityVerlet, dt);
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
            VelocityVerlet,
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

/// RMS and largest error of the restitution of an impact at 1 m/s over sixteen phases of first touch.
fn restitution_errors<I: Integrator>(
    integrator: impl Fn() -> I,
    (damping, ending): (Damping, Ending),
    e: f64,
    steps: f64,
) -> (f64, f64) {
    let law = HertzTsuji::new(acrylic(e, 0.0));
    let law = law.damping(damping).ending(ending);
    let body = paper_particle().moving(DVec3::NEG_Y);
    let k = hertz_constant((3e-3, 0.4e9, 0.3), (f64::INFINITY, 0.4e9, 0.3));
    let dt = hertz_duration(k, body.mass, 1.0) / steps;
    let errors = (0..16).map(|n| {
        let gap = dt * (f64::from(n) + 0.37) / 16.0;
        let impact = collide(
            law.clone(),
            Materials::FIRST,
            integrator(),
            dt,
            gap,
            &[body],
        );
        (impact.bodies[0].velocity.y - e).abs()
    });
    let sums = |(squares, most): (f64, f64), error: f64| (squares + error * error, error.max(most));
    let (squares, most) = errors.fold((0.0, 0.0), sums);
    ((squares / 16.0).sqrt(), most)
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
        let verlet = |steps| restitution_errors(VelocityVerlet::default, law, e, steps).0;
        let kutta = |steps| restitution_errors(RungeKutta4::default, law, e, steps).0;
        for (integrator, [coarse, fine, hundred]) in [
            ("VelocityVerlet", [64.0, 1024.0, 100.0].map(verlet)),
            ("RungeKutta4", [64.0, 1024.0, 100.0].map(kutta)),
        ] {
            let name = |what| format!("{integrator}, Hertz impact, {name}, e {e}: {what}");
            let expected = match integrator {
                "VelocityVerlet" => f64::max(expected, 2.0),
                _ => expected,
            };
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
                if law.1 == pulling {
                    5e-4
                } else if e < 1.0 {
                    2e-4
                } else {
                    1e-8
                },
                hundred,
            ));
        }
    }
    cases
}

/// What a number of steps to a contact is worth, as the manual has it.
fn steps_to_a_contact() -> Vec<Case> {
    let mut cases = Vec::new();
    for (steps, bounds) in [
        (6.0, [0.014, 0.03]),
        (8.0, [0.006, 0.019]),
        (12.0, [2.6e-3, 0.0094]),
        (20.0, [9e-4, 1.4e-3]),
        (50.0, [1.4e-4, 1.4e-4]),
    ] {
        let worst = |errors: &dyn Fn(Damping, f64) -> f64| {
            let both = [Damping::Viscoelastic, Damping::Tsuji].into_iter();
            let all = both.flat_map(|damping| {
                [0.3, 0.5, 0.75, 0.95]
                    .map(|e| errors(damping, e))
                    .into_iter()
            });
            all.fold(0.0, f64::max)
        };
        let pushing = Ending::NeverPulling;
        let found = [
            worst(&|damping, e| {
                restitution_errors(VelocityVerlet::default, (damping, pushing), e, steps).1
            }),
            worst(&|damping, e| {
                restitution_errors(RungeKutta4::default, (damping, pushing), e, steps).1
            }),
        ];
        for ((integrator, bound), found) in ["VelocityVerlet", "RungeKutta4"]
            .iter()
            .zip(bounds)
            .zip(found)
        {
            cases.push(Case::bounded(
                format!("{integrator}, {steps} steps to a contact: farthest restitution"),
                MANUAL,
                bound,
                found,
            ));
        }
    }
    cases
}
