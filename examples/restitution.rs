//! How far the restitution of the strict laws comes out from the one asked for, by steps to a contact:
//! the table of the page `guide::trust`, as Markdown.
//!
//! `cargo run --release --example restitution` prints the largest mean over the phase of first touch and
//! the farthest of all phases, less what was asked, over restitutions from 0.3 to 0.95 and both forms of damping, of a wall, an
//! equal and an unlike pair. `-- --each` prints every form and restitution by itself.
//!
//! `-- --as-good-as 0.006` prints instead, for pairs of equal particles, the fewest steps to a contact with
//! that RMS error over the phase. (LAMMPS, `pair granular hertz/material` with `damping tsuji`, has 0.006
//! at the paper's step, six to a contact, about the restitution that it converges to.) The example `bed`
//! takes such a step, and says what a simulated second costs.

#[allow(dead_code)] // Shared with the validation, of which this uses a part.
#[path = "validation/cases/mod.rs"]
mod cases;

use cases::restitution::{ASKED, Bodies, Deviation, FORMS, of_both_laws};
use clap::Parser;
use particle_damper::{Damping, Ending, Integrator, RungeKutta4, VelocityVerlet};

/// Prints how far restitution is off.
#[derive(Debug, Parser)]
struct Options {
    /// Every form of damping and every restitution by itself.
    #[arg(long)]
    each: bool,
    /// At most six steps to a contact.
    #[arg(long)]
    quick: bool,
    /// RMS error of the restitution over the phase of first touch.
    #[arg(long)]
    as_good_as: Option<f64>,
}

/// Steps to a contact.
const STEPS: [f64; 8] = [4.01, 4.5, 6.0, 8.0, 12.0, 20.0, 50.0, 100.0];

/// The largest of all bodies.
fn of_all_bodies<I: Integrator>(
    integrator: impl Fn() -> I + Copy,
    form: (Damping, Ending),
    asked: f64,
    steps: f64,
) -> Option<Deviation> {
    [Bodies::Wall, Bodies::Equal, Bodies::Unequal]
        .into_iter()
        .filter_map(|bodies| of_both_laws(integrator, form, bodies, asked, steps))
        .reduce(Deviation::or_larger)
}

fn show(found: Option<Deviation>) -> String {
    found.map_or("- | -".into(), |found| {
        format!("{:+.4} | {:.4}", found.mean, found.farthest)
    })
}

/// Prints the fewest steps to a contact whose RMS error is at most `error`, from the fewest that the law
/// bears on.
fn fewest_steps(error: f64) {
    println!("| e | damping | ending | fewest steps | RMS |");
    println!("|---|---|---|---|---|");
    for form in FORMS {
        for asked in ASKED {
            let found = (80..1000).map(|n| f64::from(n) / 20.0).find_map(|steps| {
                let integrator = VelocityVerlet::default;
                let found = of_both_laws(integrator, form, Bodies::Equal, asked, steps)?;
                (found.rms <= error).then_some((steps, found.rms))
            });
            if let Some((steps, rms)) = found {
                println!(
                    "| {asked} | {:?} | {:?} | {steps} | {rms:.4} |",
                    form.0, form.1
                );
            }
        }
    }
}

fn main() {
    let options = Options::parse();
    if let Some(error) = options.as_good_as {
        return fewest_steps(error);
    }
    let steps = STEPS
        .into_iter()
        .take(if options.quick { 3 } else { STEPS.len() });
    for ending in [Ending::NeverPulling, Ending::PullingAllowed] {
        println!("\n{ending:?}: mean over phases, farthest; less what was asked\n");
        println!("| steps | e | damping | mean | farthest | RungeKutta4: mean | farthest |");
        println!("|---|---|---|---|---|---|---|");
        for steps in steps.clone() {
            let mut all: [Option<Deviation>; 2] = [None; 2];
            for form in FORMS.into_iter().filter(|form| form.1 == ending) {
                for asked in ASKED {
                    let found = [
                        of_all_bodies(VelocityVerlet::default, form, asked, steps),
                        of_all_bodies(RungeKutta4::default, form, asked, steps),
                    ];
                    if options.each {
                        let [verlet, kutta] = found.map(show);
                        println!("| {steps} | {asked} | {:?} | {verlet} | {kutta} |", form.0);
                    }
                    for (all, found) in all.iter_mut().zip(found) {
                        *all = [*all, found]
                            .into_iter()
                            .flatten()
                            .reduce(Deviation::or_larger);
                    }
                }
            }
            let [verlet, kutta] = all.map(show);
            println!("| {steps} | all | both | {verlet} | {kutta} |");
        }
    }
}
