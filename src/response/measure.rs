use std::f64::consts::TAU;
use std::ops::ControlFlow;

use super::average::History;
use super::period::{Period, Sums};
use super::{Point, Response, ResponseCurve, ResponseError, Structure};
use crate::cavity::Cavity;
use crate::damper::Damper;
use crate::detector::Detector;
use crate::error::{Bound, ValueError};
use crate::filling::Filling;
use crate::integrator::Integrator;
use crate::law::ContactLaw;
use crate::observer::{Observer, StepReport};
use crate::particle::Particle;
use crate::periods::steps_per_period;

/// Steps to a period at the least: ten to each half of the wave, and one for their rounding.
const LEAST_STEPS: f64 = 21.0;

/// Keeps what a structure watches.
struct Watch<'a, S> {
    structure: &'a S,
    value: Option<f64>,
}

impl<S: Structure> Observer for Watch<'_, S> {
    fn step(&mut self, report: &StepReport<'_>) {
        self.value = self.structure.watched(report);
    }
}

impl<L, C, D, I, S> ResponseCurve<L, C, D, I, S> {
    pub(super) fn check(&self) -> Result<(), ValueError> {
        for &amplitude in &self.amplitudes {
            Bound::Positive.check("amplitude of the force or motion (N or m)", amplitude)?;
        }
        Bound::Positive.check("time step (s)", self.time_step)?;
        self.periods.check()?;
        for &frequency in &self.frequencies {
            Bound::Positive.check("frequency (Hz)", frequency)?;
        }
        Ok(())
    }
}

impl<L, C, D, I, S> ResponseCurve<L, C, D, I, S>
where
    L: ContactLaw + Clone,
    C: Cavity + Clone,
    D: Detector + Clone,
    I: Integrator + Clone,
    S: Structure,
{
    /// Measures one point, of the curve or any other: what [`run`](Self::run) gives for it, to the bit.
    /// `each_period` is called at the end of every period with what it was, and may cancel.
    ///
    /// # Errors
    /// If a number is outside its range, the container cannot be filled, the damper cannot be built or
    /// a step cannot be taken, the structure has not what it watches, or when `each_period` breaks.
    pub fn measure(
        &self,
        point: Point,
        each_period: impl FnMut(Period) -> ControlFlow<()>,
    ) -> Result<Response, ResponseError> {
        self.check()?;
        let mut damper = self.damper(point)?;
        self.observe(point, &mut damper, each_period)
    }

    /// Measures a point with a damper of its own.
    pub(super) fn observe(
        &self,
        point: Point,
        damper: &mut Damper<C, L, S::Mount, D, I>,
        mut each_period: impl FnMut(Period) -> ControlFlow<()>,
    ) -> Result<Response, ResponseError> {
        let steps = steps_per_period(point.frequency, self.time_step, LEAST_STEPS)?;
        let unit = "unit of what is watched";
        let unit = Bound::Positive.check(unit, self.structure.unit(point.drive()))?;
        let mut history = History::new(self.periods, unit);
        let mut watch = Watch {
            structure: &self.structure,
            value: None,
        };
        let (mut max_overlap, mut outside) = (0.0_f64, 0);
        loop {
            let mut sums = Sums::default();
            for step in 1..=steps {
                let done = damper.step_watched(&mut watch);
                done.map_err(|error| ResponseError::Step {
                    point,
                    time: damper.time(),
                    error: Box::new(error),
                })?;
                max_overlap = max_overlap.max(damper.largest_overlap());
                let value = watch.value.ok_or(ResponseError::Unwatched { point })?;
                let angle = libm::sincos(TAU * (step as f64 / steps as f64)).into();
                sums.add(value, angle);
                if let Some(total) = history.total() {
                    total.add(value, angle);
                }
            }
            outside = outside.max(damper.outside());
            if each_period(history.push(sums)).is_break() {
                return Err(ResponseError::Cancelled);
            }
            if let Some(averages) = history.averages() {
                return Ok(Response {
                    point,
                    time_step: damper.time_step(),
                    rms_zero: averages.rms_zero,
                    rms_mean: averages.rms_mean,
                    mean: averages.mean,
                    first_harmonic: averages.first_harmonic,
                    phase_lag: averages.phase_lag,
                    half_widths: averages.half_widths,
                    settled: averages.settled,
                    discarded: averages.discarded,
                    averaged: averages.averaged,
                    max_overlap,
                    outside,
                });
            }
        }
    }

    /// The damper of a point, filled and at rest.
    pub(super) fn damper(
        &self,
        point: Point,
    ) -> Result<Damper<C, L, S::Mount, D, I>, ResponseError> {
        let frequency = Bound::Positive.check("frequency (Hz)", point.frequency)?;
        Bound::Positive.check("amplitude of the force or motion (N or m)", point.amplitude)?;
        let steps = steps_per_period(frequency, self.time_step, LEAST_STEPS)?;
        let mount = self.structure.mount(point.drive())?;
        let bed = self.fill(point)?;
        let mut damper = Damper::builder(self.cavity.clone(), self.law.clone())
            .mount(mount)
            .detector(self.detector.clone())
            .integrator(self.integrator.clone())
            .gravity(self.gravity)
            .particles(bed)
            .time_step(1.0 / (frequency * steps as f64));
        for cavity in &self.others {
            damper = damper.another_cavity(cavity.clone());
        }
        if !self.contained {
            damper = damper.contained(false).overlap_limit(f64::INFINITY);
        }
        damper
            .build()
            .map_err(Box::new)
            .map_err(|error| ResponseError::Build { point, error })
    }

    fn fill(&self, point: Point) -> Result<Vec<Particle>, ResponseError> {
        let mut bed = Vec::new();
        let cavities = std::iter::once(&self.cavity).chain(&self.others);
        for (number, cavity) in (0_u32..).zip(cavities) {
            let seed = point.seed.wrapping_add(u64::from(number));
            let particle = self.particle.in_cavity(number);
            let mut filling = Filling::new(seed).with(point.particles, particle);
            if self.gravity.length_squared() > 0.0 {
                filling = filling.down(self.gravity);
            }
            let filled = filling.fill(cavity);
            bed.extend(filled.map_err(|error| ResponseError::Filling { point, error })?);
        }
        Ok(bed)
    }
}
