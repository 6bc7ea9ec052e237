use glam::DVec3;

use super::Point;
use crate::detector::{LinkedCells, Skin};
use crate::error::{Bound, ValueError};
use crate::integrator::VelocityVerlet;
use crate::particle::Particle;
use crate::periods::Periods;

/// What is in the cavity.
#[derive(Debug, Clone)]
pub(super) enum Bed {
    /// Numbers of particles alike.
    Filled(Vec<(usize, Particle)>),
    /// Particles where they are at the start.
    Placed(Vec<Particle>),
}

/// What effective fields are measured with, and where.
///
/// `L` is the contact law, `C` the cavity, `D` the detector, `I` the integrator. Unless set otherwise the
/// container moves along y, gravity is 9.81 m/s^2 against y, steps are at most 0.1 ms, 20 periods are discarded
/// and 40 averaged, the seed is 1; there are no particles, amplitudes and frequencies yet.
///
/// ```
/// use std::ops::ControlFlow;
/// use particle_damper::glam::DVec3;
/// use particle_damper::{Cuboid, EffectiveFields, Material, Particle, RestitutionImpulse};
///
/// let cavity = Cuboid::new(DVec3::splat(0.02))?;
/// let fields = EffectiveFields::new(RestitutionImpulse::new(Material::acrylic()), cavity)
///     .with(12, Particle::new(2e-3, 0.04e-3)?)
///     .amplitudes([0.1e-3, 1e-3]) // 0.6 g and 6.4 g
///     .frequencies([40.0])
///     .periods(5, 10);
/// let cells = fields.run(|progress| {
///     assert!(progress.fraction <= 1.0);
///     ControlFlow::Continue(()) // Break(()) gives up
/// })?;
/// // The smaller motion carries the bed along, the larger throws it up.
/// assert!((cells[0].apparent_mass.value / cells[0].bed_mass - 1.0).abs() < 1e-3);
/// assert!(cells[0].normalised_loss() < 1e-3 && cells[1].normalised_loss() > 0.5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
#[must_use]
pub struct EffectiveFields<L, C, D = Skin<LinkedCells>, I = VelocityVerlet> {
    pub(super) law: L,
    pub(super) cavity: C,
    pub(super) detector: D,
    pub(super) integrator: I,
    pub(super) axis: DVec3,
    pub(super) gravity: DVec3,
    pub(super) bed: Bed,
    pub(super) time_step: f64,
    pub(super) periods: Periods,
    amplitudes: Vec<f64>,
    frequencies: Vec<f64>,
    seeds: Vec<u64>,
}

impl<L, C> EffectiveFields<L, C> {
    /// Particles in `cavity` that meet by `law`.
    pub fn new(law: L, cavity: C) -> Self {
        Self {
            law,
            cavity,
            detector: Skin::default(),
            integrator: VelocityVerlet,
            axis: DVec3::Y,
            gravity: DVec3::NEG_Y * 9.81,
            bed: Bed::Filled(Vec::new()),
            time_step: 1e-4,
            periods: Periods::default(),
            amplitudes: Vec::new(),
            frequencies: Vec::new(),
            seeds: vec![1],
        }
    }
}

impl<L, C, D, I> EffectiveFields<L, C, D, I> {
    /// How contacts are found. Every detector gives the same bits.
    pub fn detector<E>(self, detector: E) -> EffectiveFields<L, C, E, I> {
        self.having(|_, integrator| (detector, integrator))
    }

    /// How time is integrated.
    pub fn integrator<J>(self, integrator: J) -> EffectiveFields<L, C, D, J> {
        self.having(|detector, _| (detector, integrator))
    }

    /// The same fields with other parts.
    fn having<E, J>(self, change: impl FnOnce(D, I) -> (E, J)) -> EffectiveFields<L, C, E, J> {
        let (detector, integrator) = change(self.detector, self.integrator);
        EffectiveFields {
            law: self.law,
            cavity: self.cavity,
            detector,
            integrator,
            axis: self.axis,
            gravity: self.gravity,
            bed: self.bed,
            time_step: self.time_step,
            periods: self.periods,
            amplitudes: self.amplitudes,
            frequencies: self.frequencies,
            seeds: self.seeds,
        }
    }

    /// Axis of the motion, of any length.
    pub const fn along(mut self, axis: DVec3) -> Self {
        self.axis = axis;
        self
    }

    /// Acceleration of gravity in m/s^2. The cavity is filled from where it points to, or throughout without
    /// gravity.
    pub const fn gravity(mut self, gravity: DVec3) -> Self {
        self.gravity = gravity;
        self
    }

    /// Adds `count` particles like `prototype`, which are filled in from the seed; its position is of no
    /// account. They start at rest in the moving container.
    pub fn with(mut self, count: usize, prototype: Particle) -> Self {
        match &mut self.bed {
            Bed::Filled(kinds) => kinds.push((count, prototype)),
            bed @ Bed::Placed(_) => *bed = Bed::Filled(vec![(count, prototype)]),
        }
        self
    }

    /// Particles that start where they are told (container's frame), with the velocities that they have
    /// (fixed frame), instead of a filling: several motions can exist side by side, and this picks one. At the
    /// start the container passes its middle, with the speed A w along the axis.
    pub fn placed(mut self, particles: impl IntoIterator<Item = Particle>) -> Self {
        self.bed = Bed::Placed(particles.into_iter().collect());
        self
    }

    /// The longest time step in s. The one that is taken divides the period.
    pub const fn time_step(mut self, longest: f64) -> Self {
        self.time_step = longest;
        self
    }

    /// How many periods are discarded, after the first one, and how many averaged after them.
    pub const fn periods(mut self, discarded: u32, averaged: u32) -> Self {
        self.periods = Periods::Fixed {
            discarded,
            averaged,
        };
        self
    }

    /// Goes on until the start is over and `half_width` is reached with a confidence of 95 %, or for `most`
    /// periods, 20 at the least. It is a part of the energy per cycle, or of a tenth of m A^2 w^2/2 if that is more; and
    /// for the apparent mass, of the bed's mass. How many periods are the start is found out by MSER-5
    /// ([`steady_state`](crate::statistics::steady_state)). A point that gives up is not
    /// [settled](super::Measurement::settled), or its intervals are still wider.
    pub const fn periods_until(mut self, half_width: f64, most: u32) -> Self {
        self.periods = Periods::Until { half_width, most };
        self
    }

    /// The amplitudes A in m.
    pub fn amplitudes(mut self, amplitudes: impl IntoIterator<Item = f64>) -> Self {
        self.amplitudes = amplitudes.into_iter().collect();
        self
    }

    /// The frequencies in Hz.
    pub fn frequencies(mut self, frequencies: impl IntoIterator<Item = f64>) -> Self {
        self.frequencies = frequencies.into_iter().collect();
        self
    }

    /// The seeds of the fillings.
    pub fn seeds(mut self, seeds: impl IntoIterator<Item = u64>) -> Self {
        self.seeds = seeds.into_iter().collect();
        self
    }

    /// Every combination of frequency, amplitude and seed; seeds follow each other first, amplitudes then.
    #[must_use]
    pub fn points(&self) -> Vec<Point> {
        let mut points = Vec::new();
        for &frequency in &self.frequencies {
            for &amplitude in &self.amplitudes {
                points.extend(self.seeds.iter().map(|&seed| Point {
                    amplitude,
                    frequency,
                    seed,
                }));
            }
        }
        points
    }

    /// How many points make up a cell.
    pub(super) const fn seeds_per_cell(&self) -> usize {
        self.seeds.len()
    }

    /// Particles, and their mass in kg.
    pub(super) fn bed_size(&self) -> (usize, f64) {
        match &self.bed {
            Bed::Filled(kinds) => kinds
                .iter()
                .fold((0, 0.0), |(number, mass), (count, kind)| {
                    (number + count, mass + *count as f64 * kind.mass)
                }),
            Bed::Placed(bed) => (bed.len(), bed.iter().map(|particle| particle.mass).sum()),
        }
    }

    pub(super) fn check(&self) -> Result<(), ValueError> {
        Bound::Positive.check("time step (s)", self.time_step)?;
        Bound::Positive.check("mass of the bed (kg)", self.bed_size().1)?;
        self.periods.check()?;
        for &amplitude in &self.amplitudes {
            Bound::Positive.check("amplitude (m)", amplitude)?;
        }
        for &frequency in &self.frequencies {
            Bound::Positive.check("frequency (Hz)", frequency)?;
        }
        Ok(())
    }
}
