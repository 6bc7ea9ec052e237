use std::f64::consts::TAU;
use std::ops::ControlFlow;

use super::{Point, Response, ResponseCurve, ResponseError};
use crate::cavity::Cavity;
use crate::damper::Damper;
use crate::detector::Detector;
use crate::error::{Bound, ValueError};
use crate::excitation::Harmonic;
use crate::filling::Filling;
use crate::integrator::Integrator;
use crate::law::ContactLaw;
use crate::mount::SingleDof;
use crate::particle::Particle;

/// Running sums of a displacement sampled evenly over whole periods.
#[derive(Debug, Default)]
struct Sums {
    samples: u64,
    sum: f64,
    squares: f64,
    in_phase: f64,
    quadrature: f64,
}

impl Sums {
    /// Takes up the displacement at the angle (rad) of the force.
    fn add(&mut self, displacement: f64, angle: f64) {
        let (sine, cosine) = libm::sincos(angle);
        self.samples += 1;
        self.sum += displacement;
        self.squares += displacement * displacement;
        self.in_phase += displacement * sine;
        self.quadrature += displacement * cosine;
    }
}

/// Steps to a period at the least: ten to each half of the wave, and one for their rounding.
const LEAST_STEPS: f64 = 21.0;

/// How many steps of at most `longest` make up a period.
fn steps_per_period(frequency: f64, longest: f64) -> Result<u64, ValueError> {
    // A hair of tolerance, so that a step that divides the period is taken as it is.
    let steps = (1.0 / (frequency * longest) * (1.0 - 1e-9))
        .ceil()
        .max(LEAST_STEPS);
    // Beyond, steps could no longer be counted exactly.
    Bound::AtMost(1e12).check("steps per period", steps)?;
    Ok(steps as u64)
}

impl<L, C, D, I> ResponseCurve<L, C, D, I> {
    pub(super) fn check(&self) -> Result<(), ValueError> {
        Bound::Positive.check("amplitude of the force (N)", self.force)?;
        Bound::Positive.check("time step (s)", self.time_step)?;
        Bound::AtLeast(1.0).check("periods averaged", f64::from(self.averaged))?;
        Bound::Positive.check(
            "stiffness of the primary system (N/m)",
            self.oscillator.stiffness(),
        )?;
        for &frequency in &self.frequencies {
            Bound::Positive.check("frequency (Hz)", frequency)?;
        }
        Ok(())
    }

    /// Periods of a point, discarded and averaged.
    pub(super) const fn periods_per_point(&self) -> u64 {
        self.discarded as u64 + self.averaged as u64
    }
}

impl<L, C, D, I> ResponseCurve<L, C, D, I>
where
    L: ContactLaw + Clone,
    C: Cavity + Clone,
    D: Detector + Clone,
    I: Integrator + Clone,
{
    /// Measures one point, of the curve or any other. `each_period` is called at the end of every
    /// period with the number of those done, and may cancel.
    ///
    /// # Errors
    /// If a number is outside its range, the container cannot be filled, the damper cannot be built or
    /// a step cannot be taken, or when `each_period` breaks.
    pub fn measure(
        &self,
        point: Point,
        mut each_period: impl FnMut(u64) -> ControlFlow<()>,
    ) -> Result<Response, ResponseError> {
        self.check()?;
        let frequency = Bound::Positive.check("frequency (Hz)", point.frequency)?;
        let steps = steps_per_period(frequency, self.time_step)?;
        let mut damper = self.damper(point, 1.0 / (frequency * steps as f64))?;
        let mut sums = Sums::default();
        let (mut max_overlap, mut outside) = (0.0_f64, 0);
        for period in 0..self.periods_per_point() {
            let averaged = period >= u64::from(self.discarded);
            for step in 1..=steps {
                damper.step().map_err(|error| ResponseError::Step {
                    point,
                    time: damper.time(),
                    error,
                })?;
                max_overlap = max_overlap.max(damper.largest_overlap());
                if averaged {
                    let angle = TAU * (step as f64 / steps as f64);
                    sums.add(damper.coordinates()[0], angle);
                }
            }
            outside = outside.max(damper.outside());
            if each_period(period + 1).is_break() {
                return Err(ResponseError::Cancelled);
            }
        }
        let deflection = self.force / self.oscillator.stiffness();
        let samples = sums.samples as f64;
        let mean = sums.sum / samples;
        let square = sums.squares / samples;
        let [sine, cosine] = [sums.in_phase, sums.quadrature].map(|sum| 2.0 * sum / samples);
        Ok(Response {
            point,
            time_step: damper.time_step(),
            rms_zero: square.sqrt() / deflection,
            rms_mean: (square - mean * mean).max(0.0).sqrt() / deflection,
            mean: mean / deflection,
            first_harmonic: libm::hypot(sine, cosine) / deflection,
            phase_lag: libm::atan2(-cosine, sine),
            max_overlap,
            outside,
        })
    }

    /// The damper of a point, filled and at rest.
    fn damper(
        &self,
        point: Point,
        time_step: f64,
    ) -> Result<Damper<C, L, SingleDof<Harmonic>, D, I>, ResponseError> {
        let force = Harmonic::new(self.force, point.frequency)?;
        let damper = Damper::builder(self.cavity.clone(), self.law.clone())
            .mount(self.oscillator.excited_by(force))
            .detector(self.detector.clone())
            .integrator(self.integrator.clone())
            .gravity(self.gravity)
            .particles(self.fill(point)?)
            .time_step(time_step);
        let damper = if self.contained {
            damper
        } else {
            damper.contained(false).overlap_limit(f64::INFINITY)
        };
        damper
            .build()
            .map_err(|error| ResponseError::Build { point, error })
    }

    fn fill(&self, point: Point) -> Result<Vec<Particle>, ResponseError> {
        let mut filling = Filling::new(point.seed).with(point.particles, self.particle);
        if self.gravity.length_squared() > 0.0 {
            filling = filling.down(self.gravity);
        }
        filling
            .fill(&self.cavity)
            .map_err(|error| ResponseError::Filling { point, error })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_divide_the_period_and_are_no_longer_than_asked() {
        assert_eq!(steps_per_period(5.0, 1e-4).unwrap(), 2000);
        assert_eq!(steps_per_period(6.0, 1e-4).unwrap(), 1667);
        assert_eq!(steps_per_period(8.0, 2e-5).unwrap(), 6250);
        assert_eq!(steps_per_period(1.0, 10.0).unwrap(), 21);
        assert!(steps_per_period(1.0, 1e-15).is_err());
    }
}
