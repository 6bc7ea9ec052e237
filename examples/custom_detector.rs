//! A contact detector of one's own, beside those of the crate: the same trajectory to the bit, and how
//! many pairs each proposes for it.
//!
//! `cargo run --release --example custom_detector` leaves `target/custom_detector/proposals.csv`.

#![allow(clippy::print_stdout)]

#[path = "support/output.rs"]
mod output;

use std::error::Error;

use particle_damper::excitation::Harmonic;
use particle_damper::{
    AllPairs, Bed, CellGrid, Counted, Damper, Detector, Filling, LinkedCells, Material, Pairs,
    Particle, RestitutionImpulse, SingleDof, Skin, Slot,
};

type Failure = Box<dyn Error + Send + Sync>;

/// Sorts the particles along x, and proposes those whose extents along x meet.
#[derive(Debug, Clone, Default)]
struct Sweep {
    order: Vec<u32>,
}

impl Detector for Sweep {
    fn detect(&mut self, bed: &Bed<'_>, pairs: &mut Pairs) {
        let x = |n: u32| bed.position(n as usize).x;
        let reach = 2.0 * bed.largest_radius() + bed.margin();
        // Cleared and filled anew, so that nothing is allocated once warm.
        self.order.clear();
        self.order.extend(0..bed.len() as u32);
        self.order.sort_unstable_by(|a, b| x(*a).total_cmp(&x(*b)));
        for (place, a) in self.order.iter().enumerate() {
            for b in &self.order[place + 1..] {
                if x(*b) - x(*a) >= reach {
                    break;
                }
                pairs.push(*a as usize, *b as usize);
            }
        }
    }
}

/// The particles after `steps` under `detector`, with how often it was asked and what it proposed.
fn run<D>(detector: D, steps: u32) -> Result<(Vec<Particle>, u64, u64), Failure>
where
    D: Detector + Clone,
{
    let filling = Filling::new(7).with(60, Particle::new(3e-3, 0.2e-3)?);
    let mount = SingleDof::paper().excited_by(Harmonic::new(0.25, 6.0)?);
    let mut damper = Damper::builder(Slot::paper(), RestitutionImpulse::new(Material::acrylic()))
        .mount(mount)
        .particles(filling.fill(&Slot::paper())?)
        .time_step(1e-4)
        .detector(Counted::new(detector))
        .build()?;
    for _ in 0..steps {
        damper.step()?;
    }
    let counted = damper.detector(0).ok_or("the cavity has a detector")?;
    let counts = (counted.detections(), counted.proposals());
    Ok((damper.particles().collect(), counts.0, counts.1))
}

fn main() -> Result<(), Failure> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let steps = if quick { 1000 } else { 20_000 };
    let (reference, ..) = run(AllPairs, steps)?;
    let runs = [
        ("all pairs", run(AllPairs, steps)?),
        ("sweep", run(Sweep::default(), steps)?),
        ("cell grid", run(CellGrid::paper(), steps)?),
        ("linked cells", run(LinkedCells::new(), steps)?),
        (
            "sweep in a skin",
            run(Skin::new(Sweep::default(), 0.5)?, steps)?,
        ),
        (
            "cells in a skin",
            run(Skin::new(LinkedCells::new(), 0.5)?, steps)?,
        ),
    ];
    println!(
        "60 particles, {steps} steps\n{:16} {:>8} {:>14}",
        "", "asked", "pairs per step"
    );
    let mut rows = Vec::new();
    for (name, (particles, asked, proposed)) in runs {
        if particles != reference {
            return Err(format!("{name} gives another trajectory").into());
        }
        let per_step = proposed as f64 / f64::from(steps);
        println!("{name:16} {asked:8} {per_step:14.2}");
        rows.push(format!("{name},{asked},{per_step:.4}"));
    }
    println!("all end with the same bits");
    let path = output::directory("custom_detector")?.join("proposals.csv");
    output::write_table(&path, "detector,asked,pairs_per_step", rows)?;
    Ok(())
}
