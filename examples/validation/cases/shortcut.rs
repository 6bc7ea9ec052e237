//! How far off the equivalent damper is: the exact motion of one ball in the paper's oscillator beside what
//! the field of the same ball in a box that nothing stops gives.

use std::f64::consts::{SQRT_2, TAU};

use particle_damper::SingleDof;
use particle_damper::equivalent::{EquivalentDamper, ModalStructure, Solution};
use particle_damper::impact_damper::OneBall;

use super::Form;
use super::case::{Case, Tolerance};
use super::impact_damper::two_impacts;

const BALANCE: &str = "harmonic balance with the closed form of one ball";
const EXACT: &str = "Masri & Caughey 1966, doi 10.1115/1.3625084";

/// Under the paper's force at 6.0288 Hz.
fn solutions(m: f64, e: f64, d: f64) -> Vec<Solution> {
    let structure = ModalStructure::oscillator(&SingleDof::paper()).unwrap();
    let damper = EquivalentDamper::new(structure, OneBall::new(m, e, d).unwrap());
    damper.solutions(0.25, TAU * 6.0288).unwrap()
}

pub(crate) fn cases(_form: Form) -> Vec<Case> {
    let mut cases = Vec::new();
    for (m, e, d, shortcut, exact, doubtful) in [
        (4e-3, 0.75, 0.07, Some(11.010), 11.255, false),
        (8.6e-3, 0.6, 0.04, Some(3.8046), 4.1751, true),
        (8.6e-3, 0.6, 0.05, None, 3.0045, true),
    ] {
        let name = |what: &str| format!("m {m} kg, e {e}, d {d} m: {what}");
        let found = solutions(m, e, d);
        let rms = |solution: &Solution| 1e3 * solution.amplitude / SQRT_2;
        if let Some(expected) = shortcut {
            // Figures of four digits and a half.
            let close = Tolerance::Relative(1e-4);
            let got = found.last().map_or(f64::NAN, rms);
            cases.push(Case::new(name("RMS (mm)"), BALANCE, expected, got, close));
            let said = f64::from(found.iter().any(Solution::doubtful));
            let expected = f64::from(doubtful);
            let exactly = Tolerance::Absolute(0.0);
            cases.push(Case::new(
                name("doubtful"),
                BALANCE,
                expected,
                said,
                exactly,
            ));
        }
        let count = f64::from(shortcut.is_some());
        let exactly = Tolerance::Absolute(0.0);
        let number = found.len() as f64;
        cases.push(Case::new(
            name("solutions"),
            BALANCE,
            count,
            number,
            exactly,
        ));
        let truth = two_impacts(m, e, d, 6.0288).map_or(f64::NAN, |exact| 1e3 * exact.rms);
        let close = Tolerance::Relative(2e-5);
        cases.push(Case::new(
            name("exact RMS (mm)"),
            EXACT,
            exact,
            truth,
            close,
        ));
    }
    cases
}
