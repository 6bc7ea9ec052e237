//! Frequency response of an oscillator that carries a particle damper (the paper's Figs 4 and 9 to
//! 11).
//!
//! A [`ResponseCurve`] says what is measured; each of its [`Point`]s is a run of its own: a container
//! filled at random from a seed, a harmonic force F sin 2 pi f t on an oscillator at rest, some
//! periods discarded and some averaged. What comes of it is a [`Response`].
//!
//! A period is cut into as many equal steps as keep them within the asked time step, so that averages
//! are over whole periods exactly. The start fades as exp(-C t / 2 M), M with the particles' mass as
//! long as they rest: to be rid of it, discard more than 9 time constants (20 s with the paper's
//! oscillator). The paper averages over 40 periods and says nothing of the start; 20 are discarded
//! here unless set.

mod error;
mod measure;
mod point;
mod sweep;

pub use error::ResponseError;
pub use point::{Point, Response};
pub use sweep::Progress;

use glam::DVec3;

use crate::cavity::Slot;
use crate::detector::{LinkedCells, Skin};
use crate::integrator::VelocityVerlet;
use crate::material::Materials;
use crate::mount::SingleDof;
use crate::particle::Particle;

/// What a response curve is measured with, and where.
///
/// `L` is the contact law, `C` the cavity, `D` the detector, `I` the integrator. Unless set otherwise
/// it is the paper's system: [`Slot::paper`] on [`SingleDof::paper`] driven by 0.25 N along its axis,
/// spheres of 3 mm and 0.2 g, gravity 9.81 m/s^2 against y, steps of at most 0.1 ms, 20 periods
/// discarded and 40 averaged, seed 1, no particles and no frequencies yet.
///
/// ```
/// use std::ops::ControlFlow;
/// use particle_damper::{Material, ResponseCurve, RestitutionImpulse};
///
/// let curve = ResponseCurve::new(RestitutionImpulse::new(Material::acrylic()))
///     .particles([0, 20])
///     .frequencies([5.0, 5.5])
///     .periods(2, 4);
/// let responses = curve.run(|progress| {
///     assert!(progress.fraction <= 1.0);
///     ControlFlow::Continue(()) // Break(()) gives up
/// })?;
/// assert_eq!(responses.len(), 4);
/// assert_eq!(responses[3].point.particles, 20);
/// assert!(responses.iter().all(|response| response.outside == 0));
/// # Ok::<(), particle_damper::response::ResponseError>(())
/// ```
#[derive(Debug, Clone)]
#[must_use]
pub struct ResponseCurve<L, C = Slot, D = Skin<LinkedCells>, I = VelocityVerlet> {
    law: L,
    cavity: C,
    detector: D,
    integrator: I,
    oscillator: SingleDof,
    force: f64,
    particle: Particle,
    gravity: DVec3,
    time_step: f64,
    discarded: u32,
    averaged: u32,
    contained: bool,
    particles: Vec<usize>,
    seeds: Vec<u64>,
    frequencies: Vec<f64>,
}

impl<L> ResponseCurve<L> {
    /// The paper's system under a contact law.
    pub fn new(law: L) -> Self {
        Self {
            law,
            cavity: Slot::paper(),
            detector: Skin::default(),
            integrator: VelocityVerlet,
            oscillator: SingleDof::paper(),
            force: 0.25,
            particle: Particle {
                radius: 3e-3,
                mass: 0.2e-3,
                material: Materials::FIRST,
                cavity: 0,
                position: DVec3::ZERO,
                velocity: DVec3::ZERO,
                spin: DVec3::ZERO,
            },
            gravity: DVec3::NEG_Y * 9.81,
            time_step: 1e-4,
            discarded: 20,
            averaged: 40,
            contained: true,
            particles: vec![0],
            seeds: vec![1],
            frequencies: Vec::new(),
        }
    }
}

impl<L, C, D, I> ResponseCurve<L, C, D, I> {
    /// The cavity.
    pub fn cavity<B>(self, cavity: B) -> ResponseCurve<L, B, D, I> {
        self.with(|parts| (cavity, parts.1, parts.2))
    }

    /// How contacts are found. Every detector gives the same bits.
    pub fn detector<E>(self, detector: E) -> ResponseCurve<L, C, E, I> {
        self.with(|parts| (parts.0, detector, parts.2))
    }

    /// How time is integrated.
    pub fn integrator<J>(self, integrator: J) -> ResponseCurve<L, C, D, J> {
        self.with(|parts| (parts.0, parts.1, integrator))
    }

    /// The same curve with other parts.
    fn with<B, E, J>(
        self,
        change: impl FnOnce((C, D, I)) -> (B, E, J),
    ) -> ResponseCurve<L, B, E, J> {
        let (cavity, detector, integrator) = change((self.cavity, self.detector, self.integrator));
        ResponseCurve {
            law: self.law,
            cavity,
            detector,
            integrator,
            oscillator: self.oscillator,
            force: self.force,
            particle: self.particle,
            gravity: self.gravity,
            time_step: self.time_step,
            discarded: self.discarded,
            averaged: self.averaged,
            contained: self.contained,
            particles: self.particles,
            seeds: self.seeds,
            frequencies: self.frequencies,
        }
    }

    /// The oscillator that carries the container.
    pub const fn oscillator(mut self, oscillator: SingleDof) -> Self {
        self.oscillator = oscillator;
        self
    }

    /// Amplitude F of the force in N.
    pub const fn force(mut self, amplitude: f64) -> Self {
        self.force = amplitude;
        self
    }

    /// What each particle is like; its position is of no account.
    pub const fn particle(mut self, prototype: Particle) -> Self {
        self.particle = prototype;
        self
    }

    /// Acceleration of gravity in m/s^2. The container is filled from where it points to, or from the
    /// low end of y without gravity.
    pub const fn gravity(mut self, gravity: DVec3) -> Self {
        self.gravity = gravity;
        self
    }

    /// The longest time step in s. The one that is taken divides the period.
    pub const fn time_step(mut self, longest: f64) -> Self {
        self.time_step = longest;
        self
    }

    /// How many periods of the force are discarded, and how many averaged after them.
    pub const fn periods(mut self, discarded: u32, averaged: u32) -> Self {
        self.discarded = discarded;
        self.averaged = averaged;
        self
    }

    /// Whether a particle that leaves, or is pressed into another up to its centre, is an error (the
    /// default) or only counted. Needed for
    /// [`RestitutionImpulse::literal`](crate::RestitutionImpulse::literal), which loses particles.
    pub const fn contained(mut self, contained: bool) -> Self {
        self.contained = contained;
        self
    }

    /// The numbers of particles.
    pub fn particles(mut self, counts: impl IntoIterator<Item = usize>) -> Self {
        self.particles = counts.into_iter().collect();
        self
    }

    /// The seeds of the initial fillings.
    pub fn seeds(mut self, seeds: impl IntoIterator<Item = u64>) -> Self {
        self.seeds = seeds.into_iter().collect();
        self
    }

    /// The frequencies of the force in Hz.
    pub fn frequencies(mut self, frequencies: impl IntoIterator<Item = f64>) -> Self {
        self.frequencies = frequencies.into_iter().collect();
        self
    }

    /// Every combination of number of particles, seed and frequency; frequencies follow each other
    /// first, seeds then.
    #[must_use]
    pub fn points(&self) -> Vec<Point> {
        let mut points = Vec::new();
        for &particles in &self.particles {
            for &seed in &self.seeds {
                points.extend(self.frequencies.iter().map(|&frequency| Point {
                    particles,
                    seed,
                    frequency,
                }));
            }
        }
        points
    }
}
