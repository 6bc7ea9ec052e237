//! Building: what a damper is made of, and from there to its first accelerations.
//!
//! In: cavities, law, mount, detectors, integrator and particles, as a program names them. Out: a
//! [`Damper`] whose every part has been checked, with the particles in their places. Called by
//! [`Damper::builder`], and by curves and fields for each of their points.

use glam::DVec3;

use super::Damper;
use crate::cavity::Cavity;
use crate::detector::{Detector, LinkedCells, Skin};
use crate::integrator::{Integrator, VelocityVerlet};
use crate::law::ContactLaw;
use crate::material::{MaterialId, Materials};
use crate::mount::{Driven, Mount};
use crate::particle::Particle;

mod build;
mod check;
mod error;
mod start;
mod time_step;

pub use error::{BuildError, StepBound};

/// Overlaps up to this fraction of the smallest radius are taken for contacts of a settled bed. Beds that have
/// settled under the coarse law keep its [slop](crate::SolverParameters::slop) of 0.01, and tall ones that are
/// hit hard stay within 0.05.
const INITIAL_OVERLAP: f64 = 0.05;

/// Overlaps up to this fraction of the smallest radius pass while blows are hard. Beds of very unlike masses
/// come back from 0.5 ([`RestitutionImpulse`](crate::RestitutionImpulse)); from 1 on, a grain's centre is
/// beyond the wall, which would push it out.
const OVERLAP_LIMIT: f64 = 0.7;

/// Puts a [`Damper`] together.
#[derive(Debug, Clone)]
#[must_use]
pub struct Builder<C, L, M = Driven, D = Skin<LinkedCells>, I = VelocityVerlet> {
    cavities: Vec<C>,
    law: L,
    mount: M,
    detectors: Vec<D>,
    copy: Option<fn(&D) -> D>,
    integrator: I,
    settings: Settings,
}

/// What a builder is told besides the parts.
#[derive(Debug, Clone)]
struct Settings {
    gravity: DVec3,
    time_step: Option<f64>,
    start_time: f64,
    wall_material: MaterialId,
    particles: Vec<Particle>,
    initial_overlap: f64,
    overlap_limit: f64,
    contained: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            gravity: DVec3::NEG_Y * 9.81,
            time_step: None,
            start_time: 0.0,
            wall_material: Materials::FIRST,
            particles: Vec::new(),
            initial_overlap: INITIAL_OVERLAP,
            overlap_limit: OVERLAP_LIMIT,
            contained: true,
        }
    }
}

impl<C, L> Builder<C, L> {
    pub(crate) fn new(cavity: C, law: L) -> Self {
        Self {
            cavities: vec![cavity],
            law,
            mount: Driven::default(),
            detectors: vec![Skin::default()],
            copy: Some(Clone::clone),
            integrator: VelocityVerlet,
            settings: Settings::default(),
        }
    }
}

impl<C, L, M, D, I> Builder<C, L, M, D, I> {
    /// What the container is mounted on.
    pub fn mount<N: Mount>(self, mount: N) -> Builder<C, L, N, D, I> {
        Builder {
            cavities: self.cavities,
            law: self.law,
            mount,
            detectors: self.detectors,
            copy: self.copy,
            integrator: self.integrator,
            settings: self.settings,
        }
    }

    /// How contacts are found, in every cavity. All detectors give the same trajectory to the bit.
    pub fn detector<E: Detector + Clone>(self, detector: E) -> Builder<C, L, M, E, I> {
        self.detected_by(vec![detector], Some(E::clone))
    }

    /// A detector for each cavity in turn: one that is chosen at run time (`Box<dyn Detector>`) or
    /// borrowed cannot be copied.
    pub fn detectors<E: Detector>(
        self,
        detectors: impl IntoIterator<Item = E>,
    ) -> Builder<C, L, M, E, I> {
        self.detected_by(detectors.into_iter().collect(), None)
    }

    /// How time is integrated.
    pub fn integrator<J: Integrator>(self, integrator: J) -> Builder<C, L, M, D, J> {
        Builder {
            cavities: self.cavities,
            law: self.law,
            mount: self.mount,
            detectors: self.detectors,
            copy: self.copy,
            integrator,
            settings: self.settings,
        }
    }

    fn detected_by<E>(
        self,
        detectors: Vec<E>,
        copy: Option<fn(&E) -> E>,
    ) -> Builder<C, L, M, E, I> {
        Builder {
            cavities: self.cavities,
            law: self.law,
            mount: self.mount,
            detectors,
            copy,
            integrator: self.integrator,
            settings: self.settings,
        }
    }

    /// One more cavity on the mount; particles name theirs ([`Particle::in_cavity`]).
    pub fn another_cavity(mut self, cavity: C) -> Self {
        self.cavities.push(cavity);
        self
    }

    /// Acceleration of gravity in m/s^2; 9.81 against y unless set.
    pub const fn gravity(mut self, gravity: DVec3) -> Self {
        self.settings.gravity = gravity;
        self
    }

    /// Length of a step in s. Unless set, half of what the law allows, and no more than the mount's
    /// [natural frequency](Mount::highest_frequency) and the [excitation](Mount::shortest_feature) do.
    /// Under a strict law that is eight steps to a contact or more, which give the restitution asked for to
    /// within 1 % ([`guide::trust`](crate::guide::trust#steps-to-a-contact)); of contacts that may pull, on
    /// the mean.
    pub const fn time_step(mut self, time_step: f64) -> Self {
        self.settings.time_step = Some(time_step);
        self
    }

    /// Simulated time at the start in s; zero unless set.
    pub const fn start_time(mut self, time: f64) -> Self {
        self.settings.start_time = time;
        self
    }

    /// Material of the walls; the first of the law's table unless set.
    pub const fn walls_of(mut self, material: MaterialId) -> Self {
        self.settings.wall_material = material;
        self
    }

    /// Adds particles, with positions in their container's frame.
    pub fn particles(mut self, particles: impl IntoIterator<Item = Particle>) -> Self {
        self.settings.particles.extend(particles);
        self
    }

    /// Largest overlap at the start, as a fraction of the smallest radius; 0.05 unless set.
    ///
    /// This is the one rule for what may be squeezed: every contact at the start, of two particles or of a
    /// particle and a wall, by so much and no more. A particle may thus be larger than its cavity is wide by
    /// twice that. (A [`Filling`](crate::Filling) squeezes by a millionth of a radius at most, to let an exact
    /// fit stand.)
    pub const fn initial_overlap(mut self, fraction: f64) -> Self {
        self.settings.initial_overlap = fraction;
        self
    }

    /// Overlap at which a step reports an error, as a fraction of the smallest radius; 0.7 unless set.
    /// Results are worth little well before: see [`guide::trust`](crate::guide::trust).
    pub const fn overlap_limit(mut self, fraction: f64) -> Self {
        self.settings.overlap_limit = fraction;
        self
    }

    /// Whether a particle whose centre passes a wall is an error (the default), or merely
    /// [counted](crate::Damper::outside).
    pub const fn contained(mut self, contained: bool) -> Self {
        self.settings.contained = contained;
        self
    }
}

impl<C: Cavity, L: ContactLaw> Damper<C, L, Driven, Skin<LinkedCells>> {
    /// A builder for particles in `cavity` that meet by `law`.
    ///
    /// Unless told otherwise, the container is [`Driven`] and at rest, contacts are found by
    /// [`LinkedCells`] with a [`Skin`] (the fastest for every bed measured in `benches/step.rs`), and
    /// the integrator is [`VelocityVerlet`].
    pub fn builder(cavity: C, law: L) -> Builder<C, L> {
        Builder::new(cavity, law)
    }
}
