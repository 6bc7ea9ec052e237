use std::f64::consts::{SQRT_2, TAU};

use super::*;
use crate::equivalent::Mode;
use crate::impact_damper::OneBall;
use crate::mount::SingleDof;

/// A mass that falls with the square of the amplitude, which makes a hardening spring of the structure, and a
/// dashpot.
struct Hardening {
    mass: f64,
    fall: f64,
    dashpot: f64,
}

impl Field for Hardening {
    fn amplitudes(&self, _angular_frequency: f64) -> [f64; 2] {
        [0.0, 1e3]
    }

    fn bed_mass(&self) -> f64 {
        self.mass
    }

    fn at(&self, amplitude: f64, _angular_frequency: f64) -> Result<Effect, ValueError> {
        let mass = self.mass - self.fall * amplitude * amplitude;
        Ok(Effect::new(mass, self.dashpot))
    }
}

fn oscillator(m: f64, c: f64, k: f64) -> ModalStructure {
    ModalStructure::oscillator(&SingleDof::new(m, c, k).unwrap()).unwrap()
}

#[test]
fn a_rigid_mass_and_a_dashpot_give_the_textbook_amplitude() {
    let field = Hardening {
        mass: 0.5,
        fall: 0.0,
        dashpot: 0.2,
    };
    let damper = EquivalentDamper::new(oscillator(2.0, 0.1, 50.0), field);
    for w in [1.0_f64, 4.0, 4.5, 9.0] {
        let found = damper.solutions(3.0, w).unwrap();
        let expected = 3.0 / (50.0 - 2.5 * w * w).hypot(0.3 * w);
        assert_eq!(found.len(), 1);
        assert!((found[0].amplitude / expected - 1.0).abs() < 1e-12);
        assert!((found[0].watched / expected - 1.0).abs() < 1e-12);
        assert!(found[0].stable && found[0].doubtful());
    }
    let backbone = damper.backbone(&[0.1, 1.0]).unwrap();
    for point in backbone {
        assert!((point.angular_frequency - 20.0_f64.sqrt()).abs() < 1e-9);
        let force = point.amplitude * 0.3 * point.angular_frequency;
        assert!((point.force / force - 1.0).abs() < 1e-9);
    }
}

#[test]
fn all_solutions_of_a_hardening_structure_are_found() {
    let (m, c, k, fall, w) = (1.0, 0.02, 1.0, 0.3, 1.2_f64);
    let field = Hardening {
        mass: 0.0,
        fall,
        dashpot: 0.0,
    };
    let damper = EquivalentDamper::new(oscillator(m, c, k), field);
    let force = |a: f64| a * (k - m * w * w + fall * w * w * a * a).hypot(c * w);
    let mut counts = [0; 4];
    for n in 1..400 {
        let f = 5e-4 * f64::from(n);
        let found = damper.solutions(f, w).unwrap();
        // The amplitudes at which the force passes f, counted finely.
        let crossings = (0..200_000).filter(|n| {
            let [from, to] = [0, 1].map(|more| 1e-5 * f64::from(n + more));
            (force(from) < f) != (force(to) < f)
        });
        assert_eq!(found.len(), crossings.count(), "{f}");
        for solution in &found {
            assert!((force(solution.amplitude) / f - 1.0).abs() < 1e-9);
        }
        if found.len() == 3 {
            assert!(found[0].stable && !found[1].stable && found[2].stable);
        }
        counts[found.len()] += 1;
    }
    assert!(counts[1] > 10 && counts[3] > 10, "{counts:?}");
    let point = damper.backbone(&[0.8]).unwrap()[0];
    assert!((point.angular_frequency - (1.0 / (1.0 - fall * 0.64_f64)).sqrt()).abs() < 1e-9);
}

/// Where two solutions are as near as a thousandth, between two amplitudes of the scan.
#[test]
fn solutions_that_have_just_begun_are_not_missed() {
    let (fall, w) = (0.3, 1.2_f64);
    let field = Hardening {
        mass: 0.0,
        fall,
        dashpot: 0.0,
    };
    let damper = EquivalentDamper::new(oscillator(1.0, 0.02, 1.0), field);
    let force = |a: f64| a * (1.0 - w * w + fall * w * w * a * a).hypot(0.02 * w);
    // The largest force on the lower branch.
    let fold = (1..10_000).map(|n| force(5e-5 * f64::from(n) + 0.3));
    let fold = fold.fold((0.0, false), |(most, over), f| {
        if over || f < most {
            (most, true)
        } else {
            (f, false)
        }
    });
    let found = damper.solutions(fold.0 * (1.0 - 1e-6), w).unwrap();
    assert_eq!(found.len(), 3, "{found:?}");
    assert!(found[1].amplitude / found[0].amplitude < 1.003);
    assert_eq!(damper.solutions(fold.0 * (1.0 + 1e-6), w).unwrap().len(), 1);
}

/// A chain of two masses, solved by hand and by its modes.
#[test]
fn a_set_of_modes_is_the_chain_that_it_is_of() {
    // Equal masses m, to the ground and to each other by springs k: modes (1, 1) and (1, -1).
    let (m, k, z, f, w) = (0.4, 90.0, 0.01, 2.0, 13.0);
    let mode = |squares: f64, at_damper: f64| Mode {
        mass: 2.0 * m,
        frequency: (squares * k / m).sqrt() / TAU,
        damping_ratio: z,
        at_damper,
        at_force: 1.0,
        at_watch: 1.0,
    };
    let structure = ModalStructure::modes([mode(1.0, 1.0), mode(3.0, -1.0)]).unwrap();
    let field = Hardening {
        mass: 0.03,
        fall: 0.0,
        dashpot: 0.5,
    };
    let found = EquivalentDamper::new(structure, field)
        .solutions(f, w)
        .unwrap();
    // By the equations of motion: the force on the first mass, the damper on the second.
    let (d1, d3) = (
        2.0 * z * (k / m).sqrt() * m,
        2.0 * z * (3.0 * k / m).sqrt() * m,
    );
    let complex = Complex::new;
    let own = complex(2.0 * k - m * w * w, w * 0.5 * (d1 + d3));
    let with = own + complex(-0.03 * w * w, 0.5 * w);
    let coupling = complex(-k, w * 0.5 * (d1 - d3));
    let negative = |z: Complex| complex(-z.re, -z.im);
    let determinant = own * with + negative(coupling * coupling);
    let [first, second] = [with, coupling].map(|z| f * (z / determinant).abs());
    assert!((found[0].watched / first - 1.0).abs() < 1e-9);
    assert!((found[0].amplitude / second - 1.0).abs() < 1e-9);
}

/// The paper's oscillator with one ball, at its natural frequency: figures of the shortcut, not of the truth.
#[test]
fn one_ball_on_the_paper_s_oscillator_comes_out_as_is_known() {
    let rms = |m, e, d| {
        let structure = ModalStructure::oscillator(&SingleDof::paper()).unwrap();
        let damper = EquivalentDamper::new(structure, OneBall::new(m, e, d).unwrap());
        let found = damper.solutions(0.25, TAU * 6.0288).unwrap();
        found
            .iter()
            .map(|found| 1e3 * found.amplitude / SQRT_2)
            .collect::<Vec<f64>>()
    };
    let light = rms(4e-3, 0.75, 0.07);
    assert!(
        light.len() == 1 && (light[0] - 11.010).abs() < 1e-3,
        "{light:?}"
    );
    let heavy = rms(8.6e-3, 0.6, 0.04);
    assert!(
        heavy.iter().any(|rms| (rms - 3.80436).abs() < 1e-5),
        "{heavy:?}"
    );
    assert!(rms(8.6e-3, 0.6, 0.05).is_empty());
}

#[test]
fn what_is_outside_a_field_is_an_error() {
    use crate::equivalent::FieldTable;
    let effects = [Effect::new(0.01, 0.1); 4];
    let table = FieldTable::new(0.01, &[1e-3, 1e-2], &[30.0, 40.0], &effects).unwrap();
    let damper = EquivalentDamper::new(oscillator(1.0, 0.1, 1200.0), table);
    assert!(damper.solutions(0.5, 35.0).is_ok());
    let refused = damper.solutions(0.5, 50.0).unwrap_err();
    assert_eq!(refused.quantity, "angular frequency (rad/s)");
    assert!(damper.solutions(-1.0, 35.0).is_err() && damper.solutions(1.0, 0.0).is_err());
    // A force whose amplitude the table does not hold.
    assert!(damper.solutions(1e3, 35.0).unwrap().is_empty());
    assert!(damper.backbone(&[5e-3, 1.0]).unwrap().len() == 1);
}
