use glam::DVec3;

use super::Point;
use crate::cavity::Slot;
use crate::detector::{LinkedCells, Skin};
use crate::integrator::VelocityVerlet;
use crate::material::Materials;
use crate::mount::SingleDof;
use crate::particle::Particle;
use crate::periods::Periods;

/// The parts that have types of their own.
type Parts<C, D, I, S> = ((C, Vec<C>), D, I, S);

/// What a response curve is measured with, and where.
///
/// `L` is the contact law, `C` the cavity, `D` the detector, `I` the integrator, `S` the structure. Unless
/// set otherwise it is the paper's system: [`Slot::paper`] on [`SingleDof::paper`] driven by 0.25 N along
/// its axis, spheres of 3 mm and 0.2 g, gravity 9.81 m/s^2 against y, steps of at most 0.1 ms, 20 periods
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
pub struct ResponseCurve<L, C = Slot, D = Skin<LinkedCells>, I = VelocityVerlet, S = SingleDof> {
    pub(super) law: L,
    pub(super) cavity: C,
    pub(super) others: Vec<C>,
    pub(super) detector: D,
    pub(super) integrator: I,
    pub(super) structure: S,
    pub(super) particle: Particle,
    pub(super) gravity: DVec3,
    pub(super) time_step: f64,
    pub(super) periods: Periods,
    pub(super) contained: bool,
    pub(super) particles: Vec<usize>,
    pub(super) seeds: Vec<u64>,
    pub(super) amplitudes: Vec<f64>,
    pub(super) frequencies: Vec<f64>,
}

impl<L> ResponseCurve<L> {
    /// The paper's system under a contact law.
    pub fn new(law: L) -> Self {
        Self {
            law,
            cavity: Slot::paper(),
            others: Vec::new(),
            detector: Skin::default(),
            integrator: VelocityVerlet,
            structure: SingleDof::paper(),
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
            periods: Periods::default(),
            contained: true,
            particles: vec![0],
            seeds: vec![1],
            amplitudes: vec![0.25],
            frequencies: Vec::new(),
        }
    }
}

impl<L, C, D, I> ResponseCurve<L, C, D, I> {
    /// The oscillator that carries the container.
    pub fn oscillator(mut self, oscillator: SingleDof) -> Self {
        self.structure = oscillator;
        self
    }

    /// Amplitude F of the force in N.
    pub fn force(self, amplitude: f64) -> Self {
        self.amplitudes([amplitude])
    }
}

impl<L, C, D, I, S> ResponseCurve<L, C, D, I, S> {
    /// The cavity.
    pub fn cavity<B>(self, cavity: B) -> ResponseCurve<L, B, D, I, S> {
        self.with(|parts| ((cavity, Vec::new()), parts.1, parts.2, parts.3))
    }

    /// One more cavity of the structure. Each is filled with as many particles as a point says, from the
    /// point's seed and those that follow it.
    pub fn another_cavity(mut self, cavity: C) -> Self {
        self.others.push(cavity);
        self
    }

    /// How contacts are found. Every detector gives the same bits.
    pub fn detector<E>(self, detector: E) -> ResponseCurve<L, C, E, I, S> {
        self.with(|parts| (parts.0, detector, parts.2, parts.3))
    }

    /// How time is integrated.
    pub fn integrator<J>(self, integrator: J) -> ResponseCurve<L, C, D, J, S> {
        self.with(|parts| (parts.0, parts.1, integrator, parts.3))
    }

    /// What carries the containers, what drives it and what is watched of it. The amplitude of the drive
    /// is then 1 until it [is set](Self::amplitudes).
    ///
    /// Transmissibility, the base of the paper's oscillator moved by 1 mm:
    /// ```
    /// use std::ops::ControlFlow;
    /// use particle_damper::response::OnBase;
    /// use particle_damper::{Material, ResponseCurve, RestitutionImpulse, SingleDof};
    ///
    /// let curve = ResponseCurve::new(RestitutionImpulse::new(Material::acrylic()))
    ///     .structure(OnBase(SingleDof::paper()))
    ///     .amplitudes([1e-3])
    ///     .frequencies([12.0])
    ///     .periods(250, 10);
    /// let response = &curve.run(|_| ControlFlow::Continue(()))?[0];
    /// // Twice the natural frequency: 1 / (4 - 1), and a little for the damping.
    /// assert!((response.first_harmonic - 0.338).abs() < 1e-3);
    /// # Ok::<(), particle_damper::response::ResponseError>(())
    /// ```
    pub fn structure<T>(self, structure: T) -> ResponseCurve<L, C, D, I, T> {
        self.with(|parts| (parts.0, parts.1, parts.2, structure))
            .amplitudes([1.0])
    }

    /// The same curve with other parts.
    fn with<B, E, J, T>(
        self,
        change: impl FnOnce(Parts<C, D, I, S>) -> Parts<B, E, J, T>,
    ) -> ResponseCurve<L, B, E, J, T> {
        let parts = (
            (self.cavity, self.others),
            self.detector,
            self.integrator,
            self.structure,
        );
        let ((cavity, others), detector, integrator, structure) = change(parts);
        ResponseCurve {
            law: self.law,
            cavity,
            others,
            detector,
            integrator,
            structure,
            particle: self.particle,
            gravity: self.gravity,
            time_step: self.time_step,
            periods: self.periods,
            contained: self.contained,
            particles: self.particles,
            seeds: self.seeds,
            amplitudes: self.amplitudes,
            frequencies: self.frequencies,
        }
    }

    /// What each particle is like; its position and cavity are of no account.
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

    /// How many periods of the drive are discarded, and how many averaged after them.
    pub const fn periods(mut self, discarded: u32, averaged: u32) -> Self {
        self.periods = Periods::Fixed {
            discarded,
            averaged,
        };
        self
    }

    /// Goes on until the start is over and the RMS about the mean is known to `half_width` (a part of it:
    /// 0.02 is 2 %) with a confidence of 95 %, or for `most` periods, 20 at the least. How many of them are
    /// the start is found out by [`steady_state`](crate::statistics::steady_state) of the periods' own RMS
    /// values. A point that gives up says so: it is not [settled](super::Response::settled), or its
    /// [half-width](super::HalfWidths::rms_mean) is still larger.
    pub const fn periods_until(mut self, half_width: f64, most: u32) -> Self {
        self.periods = Periods::Until { half_width, most };
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

    /// The amplitudes of the drive: of a force in N, of a motion in m.
    pub fn amplitudes(mut self, amplitudes: impl IntoIterator<Item = f64>) -> Self {
        self.amplitudes = amplitudes.into_iter().collect();
        self
    }

    /// The frequencies of the drive in Hz.
    pub fn frequencies(mut self, frequencies: impl IntoIterator<Item = f64>) -> Self {
        self.frequencies = frequencies.into_iter().collect();
        self
    }

    /// Every combination of number of particles, seed, amplitude and frequency; frequencies follow each
    /// other first, amplitudes and seeds then.
    #[must_use]
    pub fn points(&self) -> Vec<Point> {
        let mut points = Vec::new();
        for &particles in &self.particles {
            for &seed in &self.seeds {
                for &amplitude in &self.amplitudes {
                    points.extend(self.frequencies.iter().map(|&frequency| Point {
                        particles,
                        seed,
                        amplitude,
                        frequency,
                    }));
                }
            }
        }
        points
    }
}
