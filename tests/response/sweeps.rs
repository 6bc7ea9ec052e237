//! Sweeps that keep the state from point to point.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::response::{Drive, Excited, Response, ResponseError, Swept};
use particle_damper::{
    Cuboid, Interaction, Material, Motion, Mount, Particle, ResponseCurve, RestitutionImpulse, Slot,
};

/// A box in harmonic motion along y.
struct Shaken(Drive);

impl Mount for Shaken {
    fn motion(&self, time: f64, _x: &[f64], _v: &[f64], _cavity: usize) -> Motion {
        let w = TAU * self.0.frequency;
        let (sine, cosine) = (w * time).sin_cos();
        let velocity = DVec3::Y * (self.0.amplitude * w * cosine);
        Motion::at(DVec3::Y * (self.0.amplitude * sine), velocity)
    }
}

#[test]
fn one_ball_falls_off_its_branch_where_theory_says() {
    let (travel, radius, e) = (0.04, 2e-3, 0.5);
    let material = Material::new(1e9, 0.3, Interaction::new(e, 0.0).unwrap()).unwrap();
    let cavity = Cuboid::new(dvec3(0.01, travel + 2.0 * radius, 0.01)).unwrap();
    let amplitudes: Vec<f64> = (0..30).map(|n| travel / 10.5 * 1.02_f64.powi(n)).collect();
    let curve = ResponseCurve::new(RestitutionImpulse::new(material))
        .cavity(cavity)
        .structure(
            Excited::by(|drive| Ok(Shaken(drive)))
                .watching_by(|report| report.particle(0).map_or(0.0, |ball| ball.velocity.y)),
        )
        .particle(Particle::new(radius, 1e-3).unwrap())
        .gravity(DVec3::ZERO)
        .particles([1])
        .amplitudes(amplitudes)
        .frequencies([10.0])
        .time_step(0.1 / 2000.0)
        .periods(10, 40);
    let branches = curve
        .sweep(Swept::Amplitude, |_| ControlFlow::Continue(()))
        .unwrap();
    let c = (1.0 - e) / (1.0 + e);
    let fall = travel / ((PI / c).powi(2) + 4.0).sqrt();
    let [parting] = branches[0].parted(0.05)[..] else {
        panic!("{:?}", branches[0].parted(0.05));
    };
    let above = parting.from / fall;
    assert!((1.0..1.02).contains(&above), "off at {above} of {fall}");
    assert!(parting.to > 1.05 * fall && parting.difference > 0.5);
    // Between impacts the ball keeps its speed.
    for response in &branches[0].down {
        let amplitude = response.point.amplitude;
        if amplitude > fall {
            let length = travel / amplitude;
            let r = (1.0 + (2.0 * c / PI).powi(2)).sqrt();
            let phase = (2.0 * c / PI).atan() + (-c * length / (PI * r)).acos();
            let speed = (length + 2.0 * phase.sin()) / PI * amplitude * TAU * 10.0;
            let off = response.rms_mean / speed - 1.0;
            assert!(off.abs() < 0.01, "{}: {off}", response.point);
        }
    }
}

#[test]
fn what_remembers_nothing_does_not_part_and_lines_are_followed_by_themselves() {
    let curve = ResponseCurve::new(RestitutionImpulse::new(Material::acrylic()))
        .particles([0, 8])
        .amplitudes([0.25, 0.1])
        .frequencies([6.5, 4.5, 5.0])
        .periods(30, 20)
        .time_step(4e-4);
    let mut last = 0.0;
    let mut finished = 0;
    let branches = curve
        .sweep(Swept::Frequency, |progress| {
            assert!(progress.fraction >= last);
            last = progress.fraction;
            finished = progress.finished;
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!((branches.len(), finished), (4, 4 * 6));
    assert!((last - 1.0).abs() < f64::EPSILON);
    for (line, branches) in curve.lines(Swept::Frequency).into_iter().zip(&branches) {
        assert_eq!(branches.parted(0.1), [], "{line}");
        let alone = curve.follow(line, |_, _| ControlFlow::Continue(()));
        assert_eq!(alone.as_ref(), Ok(branches));
        let frequencies = |points: &[Response]| -> Vec<f64> {
            let of = points.iter().map(|response| response.point.frequency);
            of.collect()
        };
        assert_eq!(frequencies(&branches.up), [4.5, 5.0, 6.5]);
        assert_eq!(frequencies(&branches.down), [6.5, 5.0, 4.5]);
    }
    let cancelled = curve.sweep(Swept::Amplitude, |progress| {
        if progress.finished > 0 {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    });
    assert_eq!(cancelled, Err(ResponseError::Cancelled));
}

/// The case of Masri & Caughey (1966): on the way up the ball keeps to two impacts a period, on the way down
/// it finds them late.
#[test]
fn an_impact_damper_on_an_oscillator_remembers_where_it_comes_from() {
    let ball = Material::new(1e9, 0.3, Interaction::new(0.6, 0.0).unwrap()).unwrap();
    let curve = ResponseCurve::new(RestitutionImpulse::new(ball))
        .cavity(Slot::new(0.02, 0.046).unwrap())
        .particle(Particle::new(3e-3, 8.6e-3).unwrap())
        .gravity(DVec3::ZERO)
        .particles([1])
        .frequencies((0..9).map(|n| 6.0288 + 0.1 * f64::from(n)))
        .periods(80, 40);
    let branches = curve
        .sweep(Swept::Frequency, |_| ControlFlow::Continue(()))
        .unwrap();
    // The closed form's RMS at the first point is 4.175117 mm.
    for response in [&branches[0].up[0], &branches[0].down[8]] {
        let off = response.rms_mean * 0.25 / 123.4 / 4.175_117e-3 - 1.0;
        assert!(off.abs() < 0.01, "{off}");
    }
    let parted = branches[0].parted(0.1);
    let widest = parted.iter().find(|parting| parting.difference > 0.5);
    let Some(parting) = widest else {
        panic!("{parted:?}");
    };
    assert!(parting.from > 6.2 && parting.to < 6.8, "{parted:?}");
}
