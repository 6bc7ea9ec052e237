//! Structures and drives other than the paper's, against closed forms.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use particle_damper::excitation::{Harmonic, Signal};
use particle_damper::glam::DVec3;
use particle_damper::response::{Excited, OnBase, Over, Point, Response, ResponseError};
use particle_damper::{
    Detector, Integrator, Load, Material, Motion, Mount, ResponseCurve, RestitutionImpulse,
    RungeKutta4, SingleDof, Slot,
};

fn curve() -> ResponseCurve<RestitutionImpulse> {
    ResponseCurve::new(RestitutionImpulse::new(Material::acrylic()))
}

fn measure<D: Detector + Clone, I: Integrator + Clone, S: particle_damper::response::Structure>(
    curve: &ResponseCurve<RestitutionImpulse, Slot, D, I, S>,
    particles: usize,
    frequency: f64,
) -> Result<Response, ResponseError> {
    let point = Point {
        particles,
        seed: 1,
        amplitude: 1e-3,
        frequency,
    };
    curve.measure(point, |_| ControlFlow::Continue(()))
}

/// The paper's Fig. 2: an empty container, base of its oscillator shaken.
#[test]
fn transmissibility_is_the_textbooks() {
    let curve = curve()
        .structure(OnBase(SingleDof::paper()))
        .integrator(RungeKutta4::default())
        .time_step(5e-4);
    for frequency in [3.0, 5.5, 6.03, 7.0, 12.0] {
        let constants = (14.0 * 2.15 * frequency) as u32;
        let response = measure(&curve.clone().periods(constants, 20), 0, frequency).unwrap();
        let (k, c, m, w) = (123.4, 0.08, 0.086, TAU * frequency);
        let (above, below) = (f64::hypot(k, c * w), f64::hypot(k - m * w * w, c * w));
        let expected = above / below;
        let off = response.first_harmonic / expected - 1.0;
        assert!(off.abs() < 1e-4, "{frequency} Hz: {off}");
        assert!((response.rms_mean * 2.0_f64.sqrt() / expected - 1.0).abs() < 1e-4);
        let lag = (c * w).atan2(k - m * w * w) - (c * w / k).atan();
        assert!((response.phase_lag - lag).abs() < 1e-3, "{frequency} Hz");
    }
}

const STIFFNESS: f64 = 300.0;
const DAMPING: f64 = 0.4;
const MASS: f64 = 0.1;

/// Two masses on a line, sprung to ground and to each other, with a container on each.
struct Two(Harmonic);

impl Mount for Two {
    fn degrees(&self) -> usize {
        2
    }
    fn motion(&self, _time: f64, x: &[f64], v: &[f64], cavity: usize) -> Motion {
        Motion::at(DVec3::Y * x[cavity], DVec3::Y * v[cavity])
    }
    fn accelerate(&self, time: f64, x: &[f64], v: &[f64], loads: &[Load], a: &mut [f64]) {
        let ground = STIFFNESS * x[0] + DAMPING * v[0];
        let between = STIFFNESS * (x[1] - x[0]) + DAMPING * (v[1] - v[0]);
        a[0] = (self.0.value(time) + loads[0].force.y - ground + between) / MASS;
        a[1] = (loads[1].force.y - between) / MASS;
    }
    fn highest_frequency(&self) -> f64 {
        1.618_034 * (STIFFNESS / MASS).sqrt() / TAU
    }
}

/// Amplitudes of both under a unit force on the first, over F/K, each with `mass`.
fn closed_form(mass: f64, frequency: f64) -> [f64; 2] {
    let w = TAU * frequency;
    // (a + ib) x1 - (k + icw) x2 = 1, -(k + icw) x1 + (d + icw) x2 = 0.
    let multiply =
        |a: [f64; 2], b: [f64; 2]| [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
    let spring = [STIFFNESS, DAMPING * w];
    let second = [STIFFNESS - mass * w * w, DAMPING * w];
    let first = [2.0 * STIFFNESS - mass * w * w, 2.0 * DAMPING * w];
    let [both, square] = [multiply(first, second), multiply(spring, spring)];
    let determinant = f64::hypot(both[0] - square[0], both[1] - square[1]);
    [second, spring].map(|[re, im]| STIFFNESS * f64::hypot(re, im) / determinant)
}

#[test]
fn any_coordinate_of_a_structure_of_several_degrees_can_be_watched() {
    let two = Excited::by(|drive| Ok(Two(drive.harmonic()?))).over(Over::Deflection(STIFFNESS));
    for (number, frequency) in [(0, 5.0), (1, 5.0), (1, 7.0)] {
        let curve = curve()
            .structure(two.watching(number))
            .another_cavity(Slot::paper())
            .integrator(RungeKutta4::default())
            .time_step(2e-4)
            .periods(90, 10);
        let response = measure(&curve, 0, frequency).unwrap();
        let off = response.first_harmonic / closed_form(MASS, frequency)[number] - 1.0;
        assert!(
            off.abs() < 1e-3,
            "coordinate {number}, {frequency} Hz: {off}"
        );

        // At an amplitude that leaves the beds at rest they are mass, in both cavities.
        let response = measure(&curve, 12, frequency).unwrap();
        let loaded = closed_form(MASS + 12.0 * 0.2e-3, frequency)[number];
        let off = response.first_harmonic / loaded - 1.0;
        assert!(
            off.abs() < 2e-3,
            "coordinate {number}, {frequency} Hz: {off}"
        );
    }
    let beyond = curve()
        .structure(two.watching(2))
        .another_cavity(Slot::paper());
    assert!(matches!(
        measure(&beyond, 0, 5.0),
        Err(ResponseError::Unwatched { .. })
    ));
}
