//! Steps that some part cannot bear: refused, and right where they are not.

use std::f64::consts::{PI, TAU};

use particle_damper::cavity::Slot;
use particle_damper::excitation::{
    Base, Beyond, Excitation, Featured, HalfSine, Harmonic, Sampled,
};
use particle_damper::glam::dvec3;
use particle_damper::integrator::{Integrator, RungeKutta4, VelocityVerlet};
use particle_damper::mount::SingleDof;
use particle_damper::{
    BuildError, Damper, HertzTsuji, Material, Particle, RestitutionImpulse, StepBound,
};

use super::table::{Table, law};

fn speck() -> Particle {
    let speck = Particle::new(3e-3, 1e-7).unwrap();
    speck.at(dvec3(0.03, 3e-3, 0.0))
}

fn coarse() -> RestitutionImpulse {
    RestitutionImpulse::new(Material::acrylic())
}

/// An undamped oscillator of 1 kg.
fn ringing(frequency: f64) -> SingleDof {
    SingleDof::new(1.0, 0.0, (TAU * frequency).powi(2))
        .unwrap()
        .released_from(1e-5, 0.0)
        .unwrap()
}

/// Steps of 0.3 ms rang 500 Hz 4 % too high, 1000 Hz 30 %, and let 1100 Hz run away.
#[test]
fn a_mount_that_rings_too_fast_for_the_step_is_named() {
    let mut table = Table::default();
    for frequency in [500.0, 1000.0, 1100.0] {
        let at = |mount| {
            let damper = Damper::builder(Slot::paper(), coarse()).mount(mount);
            damper.particles([speck()])
        };
        let is = |error: &BuildError| {
            matches!(
                error,
                BuildError::TimeStepTooLong { limit, bound: StepBound::NaturalFrequency { frequency: own }, .. }
                    if (limit * 20.0 * frequency - 1.0).abs() < 1e-12 && (own / frequency - 1.0).abs() < 1e-12
            )
        };
        table.row(
            at(ringing(frequency)).time_step(3e-4).build(),
            is,
            &["0.0003 s", "natural frequency", "Hz"],
        );
        let damper = at(ringing(frequency)).build().unwrap();
        assert!(damper.time_step() * frequency <= 0.05 * (1.0 + 1e-12));
        // A dashpot that is faster than the spring counts, too.
        let damped = SingleDof::new(1.0, TAU * frequency, 1.0).unwrap();
        table.row(at(damped).time_step(3e-4).build(), is, &["Hz"]);
    }
    table.end(6);
}

#[test]
fn what_the_limit_of_a_mount_buys_is_what_is_said() {
    fn swing<I: Integrator>(integrator: I) -> (f64, f64) {
        let mut damper = Damper::builder(Slot::paper(), law())
            .mount(ringing(500.0))
            .integrator(integrator)
            .time_step(1e-4)
            .build()
            .unwrap();
        // Upward zero crossings, and the largest displacement of the last period.
        let (mut crossings, mut last, mut largest) = (Vec::new(), 1.0, 0.0_f64);
        for step in 1..=4000 {
            damper.step().unwrap();
            let x = damper.coordinates()[0];
            if last < 0.0 && x >= 0.0 {
                crossings.push(damper.time() - 1e-4 * x / (x - last));
            }
            last = x;
            if step > 3950 {
                largest = largest.max(x.abs());
            }
        }
        let periods = (crossings.len() - 1) as f64;
        let span = crossings[crossings.len() - 1] - crossings[0];
        (periods / span / 500.0, largest / 1e-5)
    }
    let (frequency, amplitude) = swing(VelocityVerlet);
    assert!((frequency - 1.0).abs() < 5e-3, "{frequency}");
    assert!((amplitude - 1.0).abs() < 2e-2, "{amplitude}");
    let (frequency, amplitude) = swing(RungeKutta4::default());
    assert!((frequency - 1.0).abs() < 5e-3, "{frequency}");
    // 2e-4 a period, over 200 of them.
    assert!(amplitude > 0.96, "{amplitude}");
}

/// Velocity that a mass of 1 kg has got at the end, with steps of `time_step`, or why not.
fn pushed<E: Excitation + Clone>(force: E, time_step: f64) -> Result<[f64; 2], BuildError> {
    let free = || SingleDof::new(1.0, 0.0, 0.0).unwrap();
    let mut strict = Damper::builder(Slot::paper(), HertzTsuji::new(Material::acrylic()))
        .mount(free().excited_by(force.clone()))
        .time_step(time_step)
        .build()?;
    let mut coarse = Damper::builder(Slot::paper(), coarse())
        .mount(free().excited_by(force))
        .time_step(time_step)
        .build()?;
    while strict.time() < 2e-3 {
        strict.step().unwrap();
        coarse.step().unwrap();
    }
    Ok([strict.rates()[0], coarse.rates()[0]])
}

/// A pulse of 0.2 ms gave a fifth too much at steps of its length, and nothing at three times that.
#[test]
fn a_pulse_gives_its_impulse_or_is_refused() {
    let mut table = Table::default();
    let is = |error: &BuildError| {
        matches!(error, BuildError::TimeStepTooLong { bound: StepBound::Feature { duration }, .. }
            if (duration / 2e-4 - 1.0).abs() < 0.07)
    };
    let impulse = 2.0 * 1e3 * 2e-4 / PI;
    for phase in 0..10 {
        let start = 1e-4 + 2e-6 * f64::from(phase);
        let pulse = HalfSine::new(1e3, 2e-4)
            .unwrap()
            .starting_at(start)
            .unwrap();
        let by_hand = move |t: f64| {
            let inside = (start..start + 2e-4).contains(&t);
            if inside {
                1e3 * (PI * (t - start) / 2e-4).sin()
            } else {
                0.0
            }
        };
        let record: Vec<f64> = (0..200).map(|n| by_hand(1e-5 * f64::from(n))).collect();
        let recorded = Sampled::new(1e-5, record).unwrap();
        let featured = Featured::new(2e-4, by_hand).unwrap();
        for time_step in [6e-4, 2e-4, 1e-4, 2.2e-5] {
            let texts = ["excitation", "feature"];
            table.row(pushed(pulse, time_step), is, &texts);
            table.row(pushed(featured, time_step), is, &texts);
            table.row(pushed(recorded.clone(), time_step), is, &texts);
        }
        for got in [pushed(pulse, 2e-5), pushed(featured, 2e-5)] {
            for velocity in got.unwrap() {
                assert!(
                    (velocity / impulse - 1.0).abs() < 0.01,
                    "{velocity} of {impulse}"
                );
            }
        }
    }
    table.row(
        pushed(
            (
                HalfSine::new(1.0, 1.0).unwrap(),
                Harmonic::new(1.0, 2500.0).unwrap(),
            ),
            1e-4,
        ),
        is,
        &["feature of 0.0001"],
    );
    table.end(121);
}

#[test]
fn a_base_that_jumps_is_refused_unless_it_was_asked_for() {
    let mut table = Table::default();
    let ramp = Sampled::new(0.1, (0..11).map(|n| 0.1 * f64::from(n)).collect::<Vec<_>>()).unwrap();
    let on = |base: Sampled| {
        let mount = SingleDof::paper().excited_by(Base(base));
        Damper::builder(Slot::paper(), law())
            .mount(mount)
            .time_step(1e-4)
            .build()
    };
    let is = |error: &BuildError| matches!(error, BuildError::BaseJumps(_));
    table.row(
        on(ramp.clone()),
        is,
        &["0 m and 1", "m/s", "Sampled::beyond"],
    );
    table.row(
        on(ramp.clone().beyond(Beyond::Zero)),
        is,
        &["at 1 s", "1 m"],
    );
    assert!(on(ramp.clone().beyond(Beyond::Hold)).is_ok());
    assert!(on(ramp.clone().beyond(Beyond::Continue)).is_ok());
    assert!(on(ramp.integral()).is_ok());
    table.end(2);
}
