//! How sure a response is, and points that go on until it is sure enough.

use std::ops::ControlFlow;

use particle_damper::response::{Point, Response, ResponseError};
use particle_damper::{Material, ResponseCurve, RestitutionImpulse};

fn curve() -> ResponseCurve<RestitutionImpulse> {
    ResponseCurve::new(RestitutionImpulse::new(Material::acrylic()))
}

fn measure(
    curve: &ResponseCurve<RestitutionImpulse>,
    particles: usize,
    frequency: f64,
) -> Response {
    let point = Point {
        particles,
        seed: 1,
        amplitude: 0.25,
        frequency,
    };
    curve.measure(point, |_| ControlFlow::Continue(())).unwrap()
}

fn relative(response: &Response) -> f64 {
    response
        .half_widths
        .map_or(f64::INFINITY, |widths| widths.rms_mean)
        / response.rms_mean
}

#[test]
fn a_point_goes_on_until_it_is_sure_and_is_right_then() {
    for (particles, frequency, sure) in [(20, 6.0, 0.02), (60, 5.6, 0.01)] {
        let long = measure(&curve().periods(60, 240), particles, frequency);
        let until = measure(&curve().periods_until(sure, 2000), particles, frequency);
        assert!(until.settled && long.settled);
        assert!(relative(&until) <= sure && relative(&long) <= sure);
        assert!(until.discarded + until.averaged < 2000);
        let off = (until.rms_mean / long.rms_mean - 1.0).abs();
        assert!(off < 1.5 * sure, "{}: off by {off}", until.point);
    }
}

/// The time constant of the empty oscillator is 13 periods at its resonance, 26 with a bed of its mass.
#[test]
fn a_start_that_fades_without_noise_is_waited_for() {
    let peak = measure(&curve().periods_until(0.01, 2000), 0, 6.027_858);
    assert!(peak.settled && (peak.rms_mean / 28.796_16 - 1.0).abs() < 0.01);
    let rest = measure(&curve().periods_until(0.01, 2000), 60, 5.0);
    assert!(rest.settled && (rest.rms_mean / 3.2563 - 1.0).abs() < 0.01);
    assert!(rest.discarded + rest.averaged < 1000, "{rest:?}");
}

#[test]
fn a_point_that_has_not_settled_says_so() {
    // On its way: after 20 periods a fifth of the start is left.
    let fixed = measure(&curve(), 0, 6.027_858);
    assert!(!fixed.settled);
    assert_eq!((fixed.discarded, fixed.averaged), (20, 40));
    let short = measure(&curve().periods_until(0.01, 30), 0, 6.027_858);
    assert!(!short.settled || relative(&short) > 0.01);
    assert_eq!(short.discarded + short.averaged, 30);
    let settled = measure(&curve().periods(60, 60), 20, 6.0);
    assert!(settled.settled && relative(&settled) < 0.1);
    // Three periods say nothing of it.
    let three = measure(&curve().periods(2, 3), 20, 6.0);
    assert!(!three.settled && three.half_widths.is_none());
}

#[test]
fn periods_are_handed_out_as_they_come() {
    let point = Point {
        particles: 20,
        seed: 1,
        amplitude: 0.25,
        frequency: 6.0,
    };
    let mut squares = Vec::new();
    let response = curve().periods(4, 6).measure(point, |period| {
        assert_eq!(period.number, squares.len() as u64 + 1);
        assert!(period.in_phase.hypot(period.quadrature) > 0.0);
        squares.push(period.mean_square);
        ControlFlow::Continue(())
    });
    let mean = squares[4..].iter().sum::<f64>() / 6.0;
    assert!((response.unwrap().rms_zero - mean.sqrt()).abs() < 1e-12);
    for (bad, what) in [
        (curve().periods_until(0.0, 100), "half-width"),
        (curve().periods_until(0.1, 10), "periods at most"),
    ] {
        let error = bad.measure(point, |_| ControlFlow::Continue(()));
        assert!(
            matches!(&error, Err(ResponseError::Value(value)) if value.quantity.contains(what))
        );
    }
}
