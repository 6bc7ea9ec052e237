//! Where the energy goes.

use particle_damper::excitation::Harmonic;
use particle_damper::{
    ContactLaw, Damper, EnergyLedger, Filling, HertzMindlin, HertzTsuji, Integrator, Material,
    Particle, RestitutionImpulse, RungeKutta4, SingleDof, Slot, VelocityVerlet,
};

const FREQUENCY: f64 = 6.0;

/// Runs the paper's damper with `count` particles for some periods; the first one is not accounted.
fn run<L: ContactLaw, I: Integrator>(
    law: L,
    integrator: I,
    count: usize,
    time_step: f64,
    periods: f64,
) -> EnergyLedger {
    let cavity = Slot::paper();
    let bed = Filling::new(1).with(count, Particle::new(3e-3, 0.2e-3).unwrap());
    let force = Harmonic::new(0.25, FREQUENCY).unwrap();
    let mut damper = Damper::builder(cavity, law)
        .mount(SingleDof::paper().excited_by(force))
        .integrator(integrator)
        .particles(bed.fill(&cavity).unwrap())
        .time_step(time_step)
        .build()
        .unwrap();
    let until = |damper: f64, periods: f64| damper < periods / FREQUENCY - 0.5 * time_step;
    while until(damper.time(), 1.0) {
        damper.step().unwrap();
    }
    let mut ledger = EnergyLedger::new();
    while until(damper.time(), 1.0 + periods) {
        damper.step_watched(&mut ledger).unwrap();
    }
    ledger
}

#[test]
#[ignore = "explore"]
fn explore() {
    let acrylic = Material::acrylic;
    let periods: f64 = std::env::var("PERIODS").map_or(4.0, |p| p.parse().unwrap());
    let steps: usize = std::env::var("STEPS").map_or(4, |p| p.parse().unwrap());
    for dt in [2e-5, 1e-5, 5e-6, 2.5e-6].into_iter().take(steps) {
        let show = |name: &str, l: EnergyLedger| {
            println!(
                "{name} {dt:e}: input {:.5e} residual/input {:.3e} drift {:.3e} structure {:.4e} {:?}",
                l.input(),
                l.residual() / l.input(),
                l.integration_loss() / l.input(),
                l.structure_loss(),
                l.losses()
            );
        };
        show("tsuji verlet", run(HertzTsuji::new(acrylic()), VelocityVerlet::default(), 20, dt, periods));
        show("tsuji rk4", run(HertzTsuji::new(acrylic()), RungeKutta4::default(), 20, dt, periods));
        show("mindlin verlet", run(HertzMindlin::new(acrylic()), VelocityVerlet::default(), 20, dt, periods));
        let law = RestitutionImpulse::new(acrylic());
        show("impulse", run(law, VelocityVerlet::default(), 20, dt * 5.0, periods));
    }
}
