use std::f64::consts::TAU;

use super::estimate::{Estimate, estimate};
use super::point::{Cycle, Measurement};
use super::regime::{BedState, Regime};
use crate::observer::ComplexPower;

/// What a damper is to its host at one amplitude and frequency: the mean over the periods and seeds.
///
/// Masses are those of the particles, without the container. Signs, and where the loss factor means nothing,
/// are said at [`ComplexPower`].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Cell {
    /// Amplitude A of the container's motion in m.
    pub amplitude: f64,
    /// Its frequency f in Hz.
    pub frequency: f64,
    /// Mass m of the bed in kg.
    pub bed_mass: f64,
    /// Energy that the particles take in a cycle, from the first harmonic of the force on them, J.
    pub energy_per_cycle: Estimate,
    /// What their contacts lost in a cycle, J: the same over a long time.
    pub contact_loss: Estimate,
    /// By how much the particles' energy grew in a cycle over the time watched, J: what the two above may
    /// differ by. The rest of the difference is the error of the time step.
    pub gain: f64,
    /// Complex power P = F V*/2 of the host on the particles.
    pub power: ComplexPower,
    /// Mass in kg that moves in phase with the container.
    pub apparent_mass: Estimate,
    /// Coefficient of a dashpot to a fixed floor that takes as much, N s/m.
    pub viscous_coefficient: Estimate,
    /// Impacts per cycle on each wall, by the cavity's numbers.
    pub impacts: Vec<f64>,
    /// What the bed did; all zero of a [known](Self::known) cell.
    pub state: BedState,
    /// The largest overlap of all runs in m, their starts included.
    pub max_overlap: f64,
    /// How many seeds there are.
    pub seeds: usize,
    /// Periods averaged, of all seeds together.
    pub periods: usize,
    /// Whether the start was over in all runs. If not, nothing says that intervals hold: run longer.
    pub settled: bool,
}

impl Cell {
    /// A cell of known apparent mass (kg) and viscous coefficient (N s/m), for a bed of `bed_mass` (kg) that
    /// is described by formulas or by measurements.
    #[must_use]
    pub fn known(
        amplitude: f64,
        frequency: f64,
        bed_mass: f64,
        apparent_mass: f64,
        viscous_coefficient: f64,
    ) -> Self {
        let w = TAU * frequency;
        let speed = w * amplitude;
        let power = ComplexPower {
            angular_frequency: w,
            speed,
            active: 0.5 * viscous_coefficient * speed * speed,
            reactive: 0.5 * w * apparent_mass * speed * speed,
        };
        let energy = Estimate::known(power.energy_per_cycle());
        Self {
            amplitude,
            frequency,
            bed_mass,
            energy_per_cycle: energy,
            contact_loss: energy,
            gain: 0.0,
            power,
            apparent_mass: Estimate::known(apparent_mass),
            viscous_coefficient: Estimate::known(viscous_coefficient),
            impacts: Vec::new(),
            state: BedState::default(),
            max_overlap: 0.0,
            seeds: 0,
            periods: 0,
            settled: true,
        }
    }

    /// The cell of all `measurements` of one amplitude and frequency, which differ by their seeds; none of no
    /// measurement, or of one without periods. Those of other amplitudes or frequencies than the first's are
    /// left out.
    #[must_use]
    pub fn pooled(measurements: &[Measurement]) -> Option<Self> {
        let first = measurements.first()?;
        let alike = |run: &&Measurement| {
            let [own, other] = [run, first].map(|run| run.point);
            own.amplitude.to_bits() == other.amplitude.to_bits()
                && own.frequency.to_bits() == other.frequency.to_bits()
        };
        let runs: Vec<&Measurement> = measurements.iter().filter(alike).collect();
        if runs.iter().any(|run| run.kept().is_empty()) {
            return None;
        }
        let of = |value: &dyn Fn(&Cycle) -> f64| estimate(&runs, value);
        let (active, reactive) = (of(&|c| c.power.active), of(&|c| c.power.reactive));
        let power = ComplexPower {
            angular_frequency: first.point.angular_frequency(),
            speed: of(&|c| c.power.speed).value,
            active: active.value,
            reactive: reactive.value,
        };
        let walls = first.kept()[0].impacts.len();
        let impacts = |wall: usize| of(&|c| c.impacts[wall] as f64).value;
        Some(Self {
            amplitude: first.point.amplitude,
            frequency: first.point.frequency,
            bed_mass: first.bed_mass,
            energy_per_cycle: of(&|c| c.power.energy_per_cycle()),
            contact_loss: of(&|c| c.contact_loss),
            gain: of(&|c| c.gain).value,
            power,
            apparent_mass: of(&|c| c.power.apparent_mass()),
            viscous_coefficient: of(&|c| c.power.viscous_coefficient()),
            impacts: (0..walls).map(impacts).collect(),
            state: mean_state(&runs),
            max_overlap: runs.iter().map(|run| run.max_overlap).fold(0.0, f64::max),
            seeds: runs.len(),
            periods: runs.iter().map(|run| run.kept().len()).sum(),
            settled: runs.iter().all(|run| run.settled),
        })
    }

    /// Angular frequency w in rad/s.
    #[must_use]
    pub const fn angular_frequency(&self) -> f64 {
        TAU * self.frequency
    }

    /// Loss factor eta = Re P/Im P; none where the apparent mass is zero or negative, see
    /// [`ComplexPower::loss_factor`].
    #[must_use]
    pub fn loss_factor(&self) -> Option<f64> {
        self.power.loss_factor()
    }

    /// Energy per cycle over the kinetic energy m A^2 w^2/2 of a bed that moves along; at most 8 without
    /// rebound.
    #[must_use]
    pub fn normalised_loss(&self) -> f64 {
        self.power.normalised_loss(self.bed_mass)
    }

    /// In which state the bed is, as [`BedState::regime`] tells; none of a cell that was not measured.
    #[must_use]
    pub fn regime(&self) -> Option<Regime> {
        (self.periods > 0).then(|| self.state.regime())
    }

    /// Energy per cycle by the wall force less that by the contacts, J. Over whole periods of a motion that
    /// repeats itself the two agree; else the bed's energy has grown by the [gain](Self::gain).
    #[must_use]
    pub const fn difference(&self) -> f64 {
        self.energy_per_cycle.value - self.contact_loss.value
    }
}

/// The mean over runs of their means over periods.
fn mean_state(runs: &[&Measurement]) -> BedState {
    let mut mean = BedState::default();
    for run in runs {
        let weight = 1.0 / (runs.len() * run.kept().len()) as f64;
        for cycle in run.kept() {
            mean.add(&cycle.state, weight);
        }
    }
    mean
}
