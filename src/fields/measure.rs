use std::ops::ControlFlow;

use super::point::Cycle;
use super::regime::BedState;
use super::settings::Bed;
use super::{EffectiveFields, FieldError, Measurement, Point};
use crate::cavity::Cavity;
use crate::damper::Damper;
use crate::detector::Detector;
use crate::error::{Bound, ValueError};
use crate::excitation::Harmonic;
use crate::filling::Filling;
use crate::integrator::Integrator;
use crate::law::ContactLaw;
use crate::mount::Shaker;
use crate::observer::{BedRegime, EnergyLedger, Harmonics};
use crate::particle::Particle;
use crate::periods::{CONFIDENCE, Looks, Periods, steps_per_period};
use crate::statistics::{half_width, steady_state};

/// Steps to a period at the least.
const LEAST_STEPS: f64 = 40.0;
/// Part of the bed's kinetic energy below which a loss need not be known any better.
const SMALL_LOSS: f64 = 0.1;
/// Changes that mean nothing, as parts of the bed's kinetic energy and mass.
const ROUNDING: f64 = 1e-9;

impl<L, C, D, I> EffectiveFields<L, C, D, I>
where
    L: ContactLaw + Clone,
    C: Cavity + Clone,
    D: Detector + Clone,
    I: Integrator + Clone,
{
    /// Measures one point, of the fields or any other: what [`run`](Self::run) makes its cell of, to the bit.
    /// `each_period` is called at the end of every period with the number of those done, and may cancel.
    ///
    /// # Errors
    /// If a number is outside its range, the cavity cannot be filled, the damper cannot be built or a step
    /// cannot be taken, or when `each_period` breaks.
    pub fn measure(
        &self,
        point: Point,
        mut each_period: impl FnMut(u64) -> ControlFlow<()>,
    ) -> Result<Measurement, FieldError> {
        self.check()?;
        let frequency = Bound::Positive.check("frequency (Hz)", point.frequency)?;
        let amplitude = Bound::Positive.check("amplitude (m)", point.amplitude)?;
        let steps = steps_per_period(frequency, self.time_step, LEAST_STEPS)?;
        let shaker = Shaker::new(self.axis, Harmonic::new(amplitude, frequency)?)?;
        let mut damper = Damper::builder(self.cavity.clone(), self.law.clone())
            .particles(self.particles(point, shaker.axis())?)
            .mount(shaker)
            .detector(self.detector.clone())
            .integrator(self.integrator.clone())
            .gravity(self.gravity)
            .time_step(1.0 / (frequency * steps as f64))
            .build()
            .map_err(Box::new)
            .map_err(|error| FieldError::Build { point, error })?;
        let mut measurement = Measurement {
            point,
            bed_mass: self.bed_size().1,
            time_step: damper.time_step(),
            cycles: Vec::new(),
            discarded: 0,
            settled: false,
            max_overlap: 0.0,
        };
        let mut watch = Watch::new(frequency, self.cavity.walls())?;
        let mut looks = Looks::default();
        // The first period opens the accounts.
        for period in 0..=self.periods.most() {
            for _ in 0..steps {
                let done = damper.step_watched(&mut watch.observers);
                done.map_err(|error| FieldError::Step {
                    point,
                    time: damper.time(),
                    error: Box::new(error),
                })?;
                let overlap = damper.largest_overlap();
                measurement.max_overlap = measurement.max_overlap.max(overlap);
            }
            let cycle = watch.close(measurement.carried() / self.bed_size().0 as f64);
            if period > 0 {
                measurement.cycles.push(cycle);
            }
            if each_period(period + 1).is_break() {
                return Err(FieldError::Cancelled);
            }
            if let Periods::Until { half_width, .. } = self.periods
                && looks.are_due(period)
                && measurement.settle()
                && measurement.is_within(half_width)
            {
                return Ok(measurement);
            }
        }
        match self.periods {
            Periods::Fixed { discarded, .. } => measurement.settle_after(discarded as usize),
            Periods::Until { .. } => measurement.settle(),
        };
        Ok(measurement)
    }

    /// The particles at the start.
    fn particles(&self, point: Point, axis: glam::DVec3) -> Result<Vec<Particle>, FieldError> {
        let kinds = match &self.bed {
            Bed::Placed(particles) => return Ok(particles.clone()),
            Bed::Filled(kinds) => kinds,
        };
        let mut filling = Filling::new(point.seed);
        filling = if self.gravity.length_squared() > 0.0 {
            filling.down(self.gravity)
        } else {
            filling.throughout()
        };
        for &(count, prototype) in kinds {
            filling = filling.with(count, prototype);
        }
        let filled = filling.fill(&self.cavity);
        let mut bed = filled.map_err(|error| FieldError::Filling { point, error })?;
        for particle in &mut bed {
            particle.velocity += axis * (point.angular_frequency() * point.amplitude);
        }
        Ok(bed)
    }
}

/// What watches a point.
struct Watch {
    observers: (Harmonics, (EnergyLedger, BedRegime)),
    walls: u32,
}

impl Watch {
    fn new(frequency: f64, walls: u32) -> Result<Self, ValueError> {
        let others = (EnergyLedger::new(), BedRegime::new());
        Ok(Self {
            observers: (Harmonics::new(frequency)?, others),
            walls,
        })
    }

    /// What the period was that ends here, of particles that have the energy `carried` (J) each when they move
    /// along. The next one begins.
    fn close(&mut self, carried: f64) -> Cycle {
        let (harmonics, (ledger, bed)) = &mut self.observers;
        let account = ledger.close();
        let impacts = |wall| harmonics.walls().wall(0, wall).map_or(0, |own| own.impacts);
        let cycle = Cycle {
            power: harmonics.power(0).unwrap_or_default(),
            contact_loss: account.losses.total(),
            gain: account.change(),
            impacts: (0..self.walls).map(impacts).collect(),
            state: BedState::new(bed, carried),
        };
        harmonics.reset();
        *bed = BedRegime::new();
        cycle
    }
}

impl Measurement {
    /// A number of each kept cycle.
    fn series(&self, value: impl Fn(&Cycle) -> f64) -> Vec<f64> {
        self.kept().iter().map(value).collect()
    }

    /// Both of what a host feels: energies per cycle and apparent masses.
    fn both(&self) -> [Vec<f64>; 2] {
        [
            self.series(|cycle| cycle.power.energy_per_cycle()),
            self.series(|cycle| cycle.power.apparent_mass()),
        ]
    }

    /// Kinetic energy of the bed when it moves along, J.
    fn carried(&self) -> f64 {
        let speed = self.point.angular_frequency() * self.point.amplitude;
        0.5 * self.bed_mass * speed * speed
    }

    /// How many cycles are the start of both, and whether it is over.
    fn start(&self) -> (usize, bool) {
        let scales = [self.carried(), self.bed_mass];
        let states = self.both().into_iter().zip(scales).map(|(series, scale)| {
            let low = series.iter().copied().fold(f64::INFINITY, f64::min);
            let high = series.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            if high - low <= ROUNDING * scale {
                return (0, true);
            }
            steady_state(&series, CONFIDENCE)
                .map_or((0, false), |state| (state.discarded, state.settled))
        });
        states.fold((0, true), |all, own| (all.0.max(own.0), all.1 && own.1))
    }

    /// Finds the end of the start, and returns whether there is one.
    fn settle(&mut self) -> bool {
        self.discarded = 0;
        (self.discarded, self.settled) = self.start();
        self.settled
    }

    /// Takes the first `discarded` cycles for the start, and returns whether it is over after them.
    fn settle_after(&mut self, discarded: usize) -> bool {
        self.discarded = discarded;
        (_, self.settled) = self.start();
        self.settled
    }

    /// Whether the intervals are narrow enough.
    fn is_within(&self, part: f64) -> bool {
        let [energies, masses] = self.both();
        let mean = energies.iter().sum::<f64>() / energies.len() as f64;
        let small = SMALL_LOSS * self.carried();
        let narrow = |series: &[f64], scale: f64| {
            half_width(series, CONFIDENCE).is_ok_and(|width| width <= part * scale)
        };
        narrow(&energies, mean.abs().max(small)) && narrow(&masses, self.bed_mass)
    }
}
