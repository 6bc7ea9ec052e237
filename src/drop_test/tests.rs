//! Balls whose restitution is known, with noise.

use super::*;
use crate::random::Random;

/// A normal random number of variance one.
fn normal(random: &mut Random) -> f64 {
    let radius = (-2.0 * random.unit().ln()).sqrt();
    radius * (std::f64::consts::TAU * random.unit()).cos()
}

/// Times of `count` impacts, from a drop of 0.05 m.
fn impacts(test: &DropTest, number: f64, count: usize) -> Vec<f64> {
    let drop = (2.0 * 9.81 * 0.05_f64).sqrt();
    let speed = drop * test.bounces.restitution(number, drop);
    test.impacts(0.3, speed, number).take(count).collect()
}

fn noisy(times: &[f64], sigma: f64, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    times
        .iter()
        .map(|time| time + sigma * normal(&mut random))
        .collect()
}

const FORMS: [Damping; 2] = [Damping::Tsuji, Damping::Viscoelastic];

#[test]
fn clean_times_give_restitution_back_to_rounding() {
    for damping in FORMS {
        for ending in [Ending::NeverPulling, Ending::PullingAllowed] {
            let test = DropTest::new().damping(damping).ending(ending);
            for e in [0.1, 0.3, 0.5, 0.75, 0.95, 0.99] {
                for count in [4, 6, 12] {
                    let number = damping.number(e, ending).unwrap();
                    let fit = test.times(&impacts(&test, number, count)).unwrap();
                    let off = fit.restitution.value - e;
                    assert!(off.abs() < 1e-6, "{damping:?} {e} {count}: {off}");
                    assert!(fit.rms_residual() < 1e-8);
                    assert_eq!(fit.impacts.len(), count);
                }
            }
        }
    }
}

#[test]
fn intervals_hold_the_true_value_as_often_as_they_say() {
    for (damping, e, count, sigma) in [
        (Damping::Tsuji, 0.3, 4, 1e-4),
        (Damping::Tsuji, 0.75, 6, 1e-4),
        (Damping::Tsuji, 0.75, 6, 1e-3),
        (Damping::Tsuji, 0.95, 20, 1e-3),
        (Damping::Viscoelastic, 0.75, 8, 2e-4),
    ] {
        let test = DropTest::new().damping(damping);
        let number = damping.number(e, Ending::NeverPulling).unwrap();
        let times = impacts(&test, number, count);
        let tests = 300;
        let (mut held, mut sum) = (0, 0.0);
        for seed in 0..tests {
            let fit = test.times(&noisy(&times, sigma, seed)).unwrap().restitution;
            held += u32::from(fit.low <= e && e <= fit.high);
            sum += fit.value - e;
        }
        let held = f64::from(held) / tests as f64;
        let bias = sum / tests as f64;
        assert!(
            (0.91..=0.985).contains(&held),
            "{damping:?} {e} {count}: {held}"
        );
        assert!(bias.abs() < 0.01, "{damping:?} {e} {count}: {bias}");
    }
}

#[test]
fn more_bounces_and_less_noise_make_intervals_narrow() {
    let test = DropTest::new();
    let number = Damping::Tsuji.number(0.75, Ending::NeverPulling).unwrap();
    let width = |count, sigma| {
        let times = impacts(&test, number, count);
        let widths = (0..40).map(|seed| {
            let fit = test.times(&noisy(&times, sigma, seed)).unwrap().restitution;
            fit.high - fit.low
        });
        widths.sum::<f64>() / 40.0
    };
    assert!(width(10, 1e-4) < 0.3 * width(5, 1e-4));
    assert!((width(8, 1e-3) / width(8, 1e-4) - 10.0).abs() < 0.5);
}

#[test]
fn gravity_does_not_matter_where_restitution_is_constant() {
    let number = Damping::Tsuji.number(0.6, Ending::NeverPulling).unwrap();
    let test = DropTest::new();
    let times = noisy(&impacts(&test, number, 6), 1e-4, 1);
    let elsewhere = test.gravity(1.62).unwrap().times(&times).unwrap();
    let here = test.times(&times).unwrap();
    assert!((here.restitution.value - elsewhere.restitution.value).abs() < 1e-7);
    // Under viscoelastic damping it sets the speeds.
    let test = test.damping(Damping::Viscoelastic);
    let [here, elsewhere] =
        [9.81, 1.1 * 9.81].map(|g| test.gravity(g).unwrap().times(&times).unwrap().number.value);
    assert!((here / elsewhere - 1.1_f64.powf(0.2)).abs() < 1e-5);
}

#[test]
fn drag_that_is_left_out_lowers_restitution_as_the_page_says() {
    let (e, terminal) = (0.75, 13.0);
    let number = Damping::Tsuji.number(e, Ending::NeverPulling).unwrap();
    let air = DropTest::new().terminal_speed(terminal).unwrap();
    // Two bounces in a row at 0.5 m/s: the ratio of their flights.
    let [first, second] = {
        let flights: Vec<f64> = air.bounces.speeds(number, 0.5).take(2).collect();
        [0, 1].map(|n| air.bounces.flight(flights[n]))
    };
    let lowered = 1.0 - second / first / e;
    let stated = 0.25 * (1.0 + e * e) * (0.5_f64 / terminal).powi(2);
    assert!((lowered / stated - 1.0).abs() < 0.01, "{lowered} {stated}");
    // And with drag it comes out right.
    let drag = DropTest::new().terminal_speed(4.0).unwrap();
    let times = impacts(&drag, number, 8);
    assert!((drag.times(&times).unwrap().restitution.value - e).abs() < 1e-6);
    assert!(DropTest::new().times(&times).unwrap().restitution.value < e - 3e-3);
}

#[test]
fn contacts_that_last_are_taken_off() {
    let number = Damping::Tsuji.number(0.75, Ending::NeverPulling).unwrap();
    let slow = DropTest::new().contact_duration(1e-3).unwrap();
    let times = impacts(&slow, number, 8);
    assert!((slow.times(&times).unwrap().restitution.value - 0.75).abs() < 1e-6);
    assert!(DropTest::new().times(&times).unwrap().restitution.value > 0.752);
}

/// Height (m) at `since` (s) of a flight that began at `speed` (m/s).
fn flight(bounces: &Bounces, speed: f64, since: f64) -> f64 {
    let (g, terminal) = (bounces.gravity, bounces.terminal);
    if terminal.is_infinite() {
        return since * (speed - 0.5 * g * since).max(0.0);
    }
    let after = since - bounces.ascent(speed);
    let from_top = if after < 0.0 {
        (g * after / terminal).cos().ln()
    } else {
        -(g * after / terminal).cosh().ln()
    };
    (bounces.height(speed) + terminal * terminal / g * from_top).max(0.0)
}

/// Heights of a bouncing ball at intervals of `step`, on a floor at 2 mm, `scale` times too large.
fn trace(test: &DropTest, number: f64, step: f64, scale: f64) -> (Vec<f64>, Vec<f64>) {
    let drop = (2.0 * 9.81 * 0.2_f64).sqrt();
    let speed = drop * test.bounces.restitution(number, drop);
    let start = drop / 9.81;
    let impacts: Vec<f64> = test.impacts(start, speed, number).take(40).collect();
    let speeds: Vec<f64> = test.bounces.speeds(number, speed).take(40).collect();
    let count = (1.6 / step) as usize;
    let times: Vec<f64> = (0..count).map(|n| n as f64 * step).collect();
    let height = |t: &f64| match impacts.iter().rposition(|impact| impact <= t) {
        None => 0.2 - 0.5 * 9.81 * t * t,
        Some(n) => flight(&test.bounces, speeds[n], t - impacts[n]),
    };
    let heights = times.iter().map(|t| scale * (height(t) + 2e-3));
    (times.clone(), heights.collect())
}

#[test]
fn height_traces_give_restitution_floor_and_scale_back() {
    for damping in FORMS {
        let test = DropTest::new().damping(damping);
        for (e, step) in [(0.4, 5e-4), (0.6, 1e-3), (0.75, 2e-3), (0.9, 4e-3)] {
            let number = damping.number(e, Ending::NeverPulling).unwrap();
            let (times, heights) = trace(&test, number, step, 1.3);
            let fit = test.heights(&times, &heights).unwrap();
            let off = fit.contact.restitution.value - e;
            assert!(
                off.abs() < 1e-5,
                "{damping:?} {e}: {off}, {} flights",
                fit.peaks.len()
            );
            assert!((fit.scale.value - 1.3).abs() < 1e-4, "{:?}", fit.scale);
            assert!((fit.floor.value - 2.6e-3).abs() < 1e-6, "{:?}", fit.floor);
        }
    }
}

#[test]
fn of_drag_a_small_part_is_left_in_height_traces() {
    for terminal in [4.0, 6.0, 13.0] {
        let drag = DropTest::new().terminal_speed(terminal).unwrap();
        for e in [0.6, 0.75, 0.9] {
            let number = Damping::Tsuji.number(e, Ending::NeverPulling).unwrap();
            let (times, heights) = trace(&drag, number, 1e-3, 1.0);
            let found = |test: DropTest| {
                let fit = test.heights(&times, &heights).unwrap();
                e - fit.contact.restitution.value
            };
            let [with, without] = [found(drag), found(DropTest::new())];
            assert!(without > 1e-3, "{terminal} {e}: {without}");
            assert!(
                with.abs() < 0.02 * without,
                "{terminal} {e}: {with} {without}"
            );
        }
    }
}

#[test]
fn intervals_of_height_traces_hold_the_true_value() {
    for (e, sigma) in [(0.5, 1e-4), (0.75, 5e-4), (0.9, 2e-3)] {
        let test = DropTest::new();
        let number = Damping::Tsuji.number(e, Ending::NeverPulling).unwrap();
        let (times, heights) = trace(&test, number, 1e-3, 1.0);
        let (tests, mut held) = (60, 0);
        for seed in 0..tests {
            let heights = noisy(&heights, sigma, seed);
            let fit = test.heights(&times, &heights).unwrap();
            let found = fit.contact.restitution;
            held += u32::from(found.low <= e && e <= found.high);
            assert!((found.value - e).abs() < 0.02, "{e}: {found:?}");
        }
        assert!(held >= 54, "{e}: {held} of {tests}");
    }
}

#[test]
fn what_cannot_be_fitted_is_refused() {
    let test = DropTest::new();
    assert!(matches!(
        test.times(&[0.0, 0.1, 0.2]),
        Err(DropTestError::TooFew {
            found: 3,
            least: 4,
            ..
        })
    ));
    assert!(matches!(
        test.times(&[0.0, 0.1, 0.1, 0.2]),
        Err(DropTestError::NotRising { index: 2, .. })
    ));
    assert!(matches!(
        test.times(&[0.0, f64::NAN, 0.1, 0.2]),
        Err(DropTestError::Value(_))
    ));
    assert!(matches!(
        test.heights(&[0.0, 1.0], &[0.0]),
        Err(DropTestError::Lengths {
            times: 2,
            heights: 1
        })
    ));
    for heights in [vec![], vec![1.0; 100], (0..100).map(f64::from).collect()] {
        let times: Vec<f64> = (0..heights.len()).map(|n| n as f64).collect();
        assert!(matches!(
            test.heights(&times, &heights),
            Err(DropTestError::TooFew { .. })
        ));
    }
    assert!(test.gravity(0.0).is_err() && test.confidence(1.0).is_err());
    assert!(test.terminal_speed(-1.0).is_err() && test.contact_duration(f64::NAN).is_err());
}

#[test]
fn the_coefficient_is_that_of_the_law_with_the_same_restitution() {
    use crate::{Bodies, Body, HertzMindlin, HertzTsuji, Interaction, Material, Materials};
    let ball = Body::sphere(3e-3, 2e-4, Materials::FIRST);
    let plate = Bodies::new(ball, Body::wall(Materials::FIRST));
    for damping in FORMS {
        let test = DropTest::new()
            .damping(damping)
            .reference_speed(0.7)
            .unwrap();
        let number = damping.number(0.65, Ending::NeverPulling).unwrap();
        let fit = test.times(&impacts(&test, number, 8)).unwrap();
        let mut material = Material::acrylic();
        material.interaction = Interaction::new(0.65, 0.2).unwrap();
        let law = HertzTsuji::new(material)
            .damping(damping)
            .reference_speed(0.7)
            .unwrap();
        let mindlin = HertzMindlin::new(material)
            .damping(damping)
            .reference_speed(0.7)
            .unwrap();
        for speed in [0.2, 1.0] {
            let impact = law.elastic_impact(&plate, speed).unwrap();
            let found = fit.damping_coefficient(&impact).value;
            for c in [
                law.damping_coefficient(&plate),
                mindlin.damping_coefficient(&plate),
            ] {
                assert!((found / c.unwrap() - 1.0).abs() < 1e-5);
            }
        }
    }
}
