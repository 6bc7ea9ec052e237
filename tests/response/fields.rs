//! Effective fields: points by themselves, errors, cancelling, and how sure they are.

use std::ops::ControlFlow;
use std::sync::Mutex;

use particle_damper::fields::{Cell, FieldError, Measurement, Point, Progress};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::impact_damper::collecting_amplitude;
use particle_damper::{
    Cuboid, EffectiveFields, HertzTsuji, Material, Particle, RestitutionImpulse, StepError,
};

fn grains() -> EffectiveFields<RestitutionImpulse, Cuboid> {
    let cavity = Cuboid::new(DVec3::splat(0.02)).unwrap();
    EffectiveFields::new(RestitutionImpulse::new(Material::acrylic()), cavity)
        .with(12, Particle::new(2e-3, 0.04e-3).unwrap())
        .amplitudes([0.2e-3, 1e-3])
        .frequencies([30.0, 40.0])
        .seeds([1, 2, 3])
        .periods(4, 12)
}

fn go_on(_: &Progress<'_>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn next(_: u64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

#[test]
fn points_are_independent_and_cells_are_made_of_them() {
    let fields = grains();
    let points = fields.points();
    assert_eq!(points.len(), 12);
    let told = Mutex::new((0.0, 0));
    let all = fields
        .measure_all(|progress| {
            let mut told = told.lock().unwrap();
            assert!(progress.fraction >= told.0 && progress.fraction <= 1.0);
            *told = (
                progress.fraction,
                told.1 + usize::from(progress.latest.is_some()),
            );
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(*told.lock().unwrap(), (1.0, 12));
    for (number, (point, measured)) in points.iter().zip(&all).enumerate() {
        assert_eq!(*point, measured.point);
        if number % 5 == 0 {
            assert_eq!(fields.measure(*point, next).unwrap(), *measured, "{point}");
        }
    }
    let cells = fields.run(go_on).unwrap();
    assert_eq!(cells.len(), 4);
    let second = [cells[1].amplitude, cells[1].frequency].map(f64::to_bits);
    assert_eq!(second, [1e-3, 30.0].map(f64::to_bits));
    for (cell, runs) in cells.iter().zip(all.chunks(3)) {
        assert_eq!(Cell::pooled(runs).as_ref(), Some(cell));
        assert_eq!((cell.seeds, cell.periods), (3, 36));
        let mean = runs.iter().flat_map(Measurement::kept);
        let mean = mean.map(|cycle| cycle.contact_loss).sum::<f64>() / 36.0;
        assert!((cell.contact_loss.value - mean).abs() < 1e-12 * mean);
        let (energy, carried) = (cell.energy_per_cycle, cell.normalised_loss());
        if carried > 1e-6 {
            assert!(energy.half_width.unwrap() > 0.0);
            let unexplained = cell.difference() - cell.gain;
            assert!(unexplained.abs() < 5e-3 * energy.value, "{cell:?}");
        } else {
            assert!(cell.settled && (cell.apparent_mass.value / cell.bed_mass - 1.0).abs() < 1e-3);
        }
    }
}

/// Any axis, any gravity: a box on its side, shaken along gravity, is the same damper.
#[test]
fn a_turned_damper_has_the_same_fields() {
    let [along, lying] = [DVec3::Y, dvec3(0.0, 0.0, -1.0)].map(|up| {
        let cavity = Cuboid::new(if up == DVec3::Y {
            dvec3(0.02, 0.03, 0.02)
        } else {
            dvec3(0.02, 0.02, 0.03)
        });
        let law = HertzTsuji::new(Material::acrylic());
        EffectiveFields::new(law, cavity.unwrap())
            .with(1, Particle::new(2e-3, 0.04e-3).unwrap())
            .along(up * 2.0)
            .gravity(up * -9.81)
            .time_step(1e-5)
            .amplitudes([0.5e-3])
            .frequencies([40.0])
            .periods(1, 4)
            .run(go_on)
            .unwrap()
    });
    let [along, lying] = [&along[0], &lying[0]];
    let energies = [along, lying].map(|cell| cell.energy_per_cycle.value);
    assert!(energies[0] > 0.0);
    assert!(
        (energies[0] - energies[1]).abs() < 1e-6 * energies[0],
        "{energies:?}"
    );
    assert!(lying.impacts.iter().sum::<f64>() > 0.0);
}

/// A bed at rest is known at once, one that is thrown about goes on, and the intervals hold the long mean.
#[test]
fn a_point_goes_on_until_it_is_sure() {
    let fields = grains()
        .seeds([1])
        .amplitudes([0.1e-3, 1e-3])
        .frequencies([40.0]);
    let until = fields
        .clone()
        .periods_until(0.1, 400)
        .measure_all(go_on)
        .unwrap();
    let [rest, thrown] = [&until[0], &until[1]];
    assert!(rest.settled && thrown.settled);
    assert!(rest.cycles.len() <= 50, "{}", rest.cycles.len());
    assert!(thrown.cycles.len() > rest.cycles.len());
    let cell = Cell::pooled(std::slice::from_ref(thrown)).unwrap();
    let energy = cell.energy_per_cycle;
    assert!(
        energy.half_width.unwrap() <= 0.1 * energy.value,
        "{energy:?}"
    );
    let point = Point {
        seed: 77,
        ..thrown.point
    };
    let long = fields
        .clone()
        .periods(100, 900)
        .measure(point, next)
        .unwrap();
    let long = Cell::pooled(&[long]).unwrap().energy_per_cycle;
    let width = energy.half_width.unwrap() + long.half_width.unwrap();
    assert!(
        (energy.value - long.value).abs() < 1.5 * width,
        "{energy:?} {long:?}"
    );
    // Cut short, it says so.
    let short = fields
        .periods_until(1e-3, 20)
        .measure(thrown.point, next)
        .unwrap();
    let energy = Cell::pooled(&[short]).unwrap().energy_per_cycle;
    assert!(
        energy
            .half_width
            .is_none_or(|width| width > 1e-3 * energy.value)
    );
}

/// Too few periods to know whether the start is over, or how sure the mean is.
#[test]
fn a_cell_that_has_not_settled_says_so() {
    let cells = grains().periods(4, 3).run(go_on).unwrap();
    let thrown = cells.iter().filter(|cell| cell.amplitude > 0.5e-3);
    for cell in thrown {
        assert!(!cell.settled && cell.energy_per_cycle.half_width.is_none());
    }
}

#[test]
fn fields_can_be_cancelled_and_what_cannot_be_is_told_apart() {
    let mut left = 5;
    let cancelled = grains().run(|_| {
        left -= 1;
        if left == 0 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    assert_eq!(cancelled, Err(FieldError::Cancelled));
    for refused in [
        grains().amplitudes([-1.0]),
        grains().frequencies([f64::NAN]),
        grains().time_step(0.0),
        grains().periods(3, 0),
        grains().periods_until(0.0, 100),
        grains().periods_until(0.01, 3),
        grains().along(DVec3::ZERO),
        grains().placed([]),
    ] {
        assert!(matches!(refused.run(go_on), Err(FieldError::Value(_))));
    }
    let full = grains().with(5000, Particle::new(2e-3, 1e-4).unwrap());
    assert!(matches!(full.run(go_on), Err(FieldError::Filling { .. })));
    let coarse = grains().time_step(5e-3);
    assert!(matches!(coarse.run(go_on), Err(FieldError::Build { .. })));
    let Err(FieldError::Step { point, time, error }) = grains().amplitudes([1e-3, 1.0]).run(go_on)
    else {
        panic!("a box that outruns its particles");
    };
    assert!((point.amplitude - 1.0).abs() < 1e-15 && time < 0.1);
    assert!(matches!(*error, StepError::TooFast { .. }), "{error}");
    assert!(error.to_string().len() < format!("{point}: {error}").len());
}

#[cfg(feature = "serde")]
#[test]
fn units_of_work_can_be_written_and_read() {
    let fields = grains().seeds([1]).periods(2, 6);
    let points: Vec<Point> =
        serde_json::from_str(&serde_json::to_string(&fields.points()).unwrap()).unwrap();
    assert_eq!(points, fields.points());
    let measured = fields.measure(points[1], next).unwrap();
    let text = serde_json::to_string(&measured).unwrap();
    let read: Measurement = serde_json::from_str(&text).unwrap();
    assert_eq!(read, measured);
    let cell = Cell::pooled(&[read]).unwrap();
    let read: Cell = serde_json::from_str(&serde_json::to_string(&cell).unwrap()).unwrap();
    assert_eq!(read, cell);
}

/// 50 grains of 4 mm. Weightless ones, loosely piled, leave 23 mm of their box clear: they collect where A > d/pi,
/// and are a gas far below. Under gravity a bed rests in its box up to 1 g; on its side, shaken as hard, it flows.
#[test]
fn states_of_a_bed_have_the_words_of_the_literature() {
    let collecting = collecting_amplitude(0.023).unwrap();
    for (height, gravity, axis, amplitude, regime) in [
        (0.03, 0.0, DVec3::Y, 1.3 * collecting, "collect and collide"),
        (0.03, 0.0, DVec3::Y, 0.4 * collecting, "gas-like"),
        (0.03, 9.81, DVec3::Y, 0.5e-3, "solid"),
        (0.08, 9.81, DVec3::X, 0.62e-3, "convective"),
    ] {
        let cavity = Cuboid::new(dvec3(0.02, height, 0.02)).unwrap();
        let law = RestitutionImpulse::new(Material::acrylic());
        let fields = EffectiveFields::new(law, cavity)
            .along(axis)
            .gravity(DVec3::NEG_Y * gravity)
            .with(50, Particle::with_density(2e-3, 1190.0).unwrap())
            .amplitudes([amplitude])
            .frequencies([20.0])
            .periods(8, 8);
        let cell = &fields.run(go_on).unwrap()[0];
        assert_eq!(cell.regime().unwrap().to_string(), regime, "{cell:?}");
        let coherence = cell.state.coherence();
        assert!((coherence > 0.5) != (regime == "gas-like"), "{coherence}");
    }
    assert_eq!(Cell::known(1e-3, 20.0, 1e-2, 0.0, 0.0).regime(), None);
}
