//! A damper under an ODE solver that chooses its own steps (Dormand-Prince 5(4)).
//!
//! The solver takes a step under the force that the grains are thought to exert. The damper follows,
//! and answers with the force it exerts. Until the two agree the damper goes back to the start of the
//! step and the step is taken again, with the force moved towards the answer (by relaxation, so that the
//! grains may be heavier than the structure), and if that does not help, with half the length. The
//! program fails if that does not help either, or if the swing does not decay faster than with the
//! grains' weight fixed.
//!
//! A structure of a twentieth of the grains' mass is met under a force law: its answer follows the motion
//! without jumps, so that there is one that fits. An impulse law decides once a step which contacts
//! rebound; where the grains outweigh the structure there may be none.
//!
//! Run: `cargo run --manifest-path examples/ode-host/Cargo.toml`

use std::error::Error;
use std::process::ExitCode;

use differential_equations::methods::ExplicitRungeKutta;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use differential_equations::status::Status;
use particle_damper::glam::DVec3;
use particle_damper::{
    ContactLaw, Damper, Driven, Filling, HertzTsuji, Material, Motion, Particle,
    RestitutionImpulse, Slot,
};

const STIFFNESS: f64 = 123.4; // N/m
const DAMPING: f64 = 0.08; // N s/m
const RELEASE: f64 = 0.02; // m
const DURATION: f64 = 2.0; // s
const LONGEST: f64 = 2e-3; // s between two meetings of host and damper
const SHORTEST: f64 = 1e-5; // s
const TRIES: u32 = 20; // of a step, before it is halved
const TOLERANCE: f64 = 1e-5; // m/s that the wrong force may give structure and grains in a step

/// M x" + C x' + K x = force, counted from where spring and weight balance.
struct Oscillator {
    mass: f64,
    force: f64,
}

impl ODE<f64, [f64; 2]> for Oscillator {
    fn diff(&self, _time: f64, y: &[f64; 2], rate: &mut [f64; 2]) {
        *rate = [
            y[1],
            (self.force - STIFFNESS * y[0] - DAMPING * y[1]) / self.mass,
        ];
    }
}

/// One accepted step of the solver, `h` long at the most: its length, the state at its end, and how
/// many tries the solver itself rejected.
fn step(system: &Oscillator, y: [f64; 2], h: f64) -> Result<(f64, [f64; 2], u32), Box<dyn Error>> {
    let mut solver = ExplicitRungeKutta::dopri5().rtol(1e-8).atol(1e-10).h0(h);
    let failed = |error| format!("{error:?}");
    solver.init(system, 0.0, h, &y).map_err(failed)?;
    let mut rejected = 0;
    loop {
        solver.step(system).map_err(failed)?;
        match solver.status() {
            Status::RejectedStep => rejected += 1,
            _ => return Ok((solver.t(), *solver.y(), rejected)),
        }
    }
}

fn motion(y: [f64; 2]) -> Motion {
    Motion::at(DVec3::Y * y[0], DVec3::Y * y[1])
}

/// The largest displacement over the last fifth of a swing with `grains` loose in a container that meet
/// by `law` at steps of `time_step`, and how many steps were taken and taken back.
fn swing<L: ContactLaw>(
    law: L,
    time_step: f64,
    mass: f64,
    grains: usize,
) -> Result<(f64, u32, u32), Box<dyn Error>> {
    let filling = Filling::new(1).with(grains, Particle::new(3e-3, 0.2e-3)?);
    let bed = 0.2e-3 * grains as f64;
    let weight = 9.81 * bed;
    let (mut time, mut y) = (0.0, [RELEASE, 0.0]);
    let mut damper = Damper::builder(Slot::paper(), law)
        .mount(Driven::at(motion(y)))
        .particles(filling.fill(&Slot::paper())?)
        .time_step(time_step)
        .build()?;
    let mut oscillator = Oscillator { mass, force: 0.0 };
    let (mut h, mut impulse, mut taken, mut back) = (LONGEST, 0.0, 0, 0);
    let mut largest = 0.0_f64;
    while time < DURATION {
        let before = damper.snapshot();
        let mut tries = 0;
        // Grains that ride along answer with -m / M of what they are moved with.
        let least = 0.5 * mass / (mass + bed);
        let (mut relaxation, mut last) = (2.0 * least, None);
        loop {
            oscillator.force = impulse / h + weight;
            let (length, end, rejected) = step(&oscillator, y, h)?;
            // The tries that follow are of the same length, so that they can be told from one another.
            h = length;
            let supposed = (oscillator.force - weight) * length;
            let error = damper.drive(motion(end), length)?.impulse.y - supposed;
            back += rejected;
            tries += 1;
            if error.abs() / (mass + bed) <= TOLERANCE {
                (time, y, taken) = (time + length, end, taken + 1);
                break;
            }
            damper.restore(&before)?;
            back += 1;
            // Aitken's: what the last two tries suggest.
            if let Some(last) = last {
                let suggested: f64 = relaxation * last / (last - error);
                relaxation = suggested.clamp(least, 1.0);
            }
            last = Some(error);
            impulse = supposed + relaxation * error;
            if tries % TRIES == 0 {
                h = 0.5 * length;
                (relaxation, last) = (2.0 * least, None);
                if h < SHORTEST {
                    return Err(format!("host and grains do not agree at {time} s").into());
                }
            }
        }
        h = if tries < TRIES {
            (1.5 * h).min(LONGEST)
        } else {
            h
        };
        if time > 0.8 * DURATION {
            largest = largest.max(y[0].abs());
        }
    }
    Ok((largest, taken, back))
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let coarse = || RestitutionImpulse::new(Material::acrylic());
    let (loose, taken, back) = swing(coarse(), 1e-4, 0.086, 60)?;
    let (fixed, ..) = swing(coarse(), 1e-4, 0.086 + 60.0 * 0.2e-3, 0)?;
    // A structure of a twentieth of the grains' mass, which would diverge without relaxation.
    let strict = HertzTsuji::new(Material::acrylic());
    let (light, steps, taken_back) = swing(strict, 2e-5, 0.6e-3, 60)?;
    println!(
        "let go {:.1} mm from rest; {DURATION} s later",
        RELEASE * 1e3
    );
    println!(
        "  grains loose: {:.3} mm ({taken} steps, {back} taken back)",
        loose * 1e3
    );
    println!(
        "  of a light structure: {:.3} mm ({steps} steps, {taken_back} taken back)",
        light * 1e3
    );
    println!("  grains fixed: {:.3} mm", fixed * 1e3);
    if loose < 0.8 * fixed && back > 0 {
        return Ok(ExitCode::SUCCESS);
    }
    eprintln!("the swing should decay faster with grains than with their weight");
    Ok(ExitCode::FAILURE)
}
