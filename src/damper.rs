//! The damper: a bed of particles in a container on a mount, stepped in time.

use crate::contact::WallLoad;
use std::fmt;

use glam::DVec3;

use crate::cavity::{Cavity, clearance};
use crate::detector::{Detector, LinkedCells, Skin};
use crate::integrator::{Integrator, VelocityVerlet};
use crate::law::ContactLaw;
use crate::mount::{Driven, Load, Motion, Mount};
use crate::observer::{Observable, Observer};
use crate::particle::Particle;
use crate::step_error::StepError;
use engine::Engine;
use observable::Observed;
use parts::Parts;
use state::{Clock, Compartment, Setup};

mod builder;
mod drive;
mod driven_damper;
mod energies;
mod engine;
mod forces;
mod impulses;
mod neighbours;
mod observable;
mod parts;
mod snapshot;
pub(crate) mod state;
mod step;

pub use builder::{BuildError, Builder, StepBound};
pub use driven_damper::DrivenDamper;
pub use snapshot::{AnySnapshot, Recorded, Recording, ReplayError, RestoreError, Snapshot};

/// What the particles do to a container.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Reaction {
    /// Force on the container at the end of the step, in N; of an impulse law, the force that was
    /// held over the step.
    pub force: DVec3,
    /// Impulse on the container over the step, in N s: exactly the momentum that the particles lost,
    /// but for gravity.
    pub impulse: DVec3,
    /// Torque on the container about its origin at the end of the step, in N m; of an impulse law, that of
    /// the forces that were held, where they act in the midst of the step.
    pub torque: DVec3,
    /// Angular impulse on the container about where its origin is at the end of the step, in N m s: exactly
    /// the angular momentum about that point that the particles lost, but for gravity
    /// (to the order of the integrator, if it is not [`VelocityVerlet`]).
    pub angular_impulse: DVec3,
}

/// A particle damper: particles in the cavity of a container that moves with its mount.
///
/// `C` is the cavity, `L` the contact law, `M` the mount, `D` the detector, `I` the integrator. Those that are
/// not named are the ones that [`Damper::builder`] starts with, so that a program can write down the type of
/// what it holds:
/// ```
/// use particle_damper::{Cuboid, Damper, RestitutionImpulse};
///
/// struct MySimulation {
///     damper: Damper<Cuboid, RestitutionImpulse>,
/// }
/// ```
/// The crate page shows the loop.
#[derive(Clone)]
pub struct Damper<C, L: ContactLaw, M = Driven, D = Skin<LinkedCells>, I = VelocityVerlet> {
    engine: Engine<C, L>,
    mount: M,
    /// One for each cavity.
    detectors: Vec<D>,
    integrator: I,
    clock: Clock,
    time_step: f64,
    setup: Setup,
}

impl<C, L: ContactLaw, M, D, I> fmt::Debug for Damper<C, L, M, D, I> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Damper")
            .field("time", &self.clock.time())
            .field("time_step", &self.time_step)
            .field("particles", &self.engine.state.particles.len())
            .field("cavities", &self.engine.state.compartments.len())
            .finish_non_exhaustive()
    }
}

impl<C, L, M, D, I> Damper<C, L, M, D, I>
where
    C: Cavity,
    L: ContactLaw,
    M: Mount,
    D: Detector,
    I: Integrator,
{
    /// Moves everything on by one time step.
    ///
    /// # Errors
    /// If a particle or the container is no longer finite, a particle has left the cavity, or an
    /// overlap is past its bound. The damper can then be [restored](Self::restore).
    pub fn step(&mut self) -> Result<(), StepError> {
        self.step_watched(&mut ())
    }

    /// Moves everything on by one time step under the eyes of `observer`.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn step_watched(&mut self, observer: &mut dyn Observer) -> Result<(), StepError> {
        self.reset_impulses();
        let done = self.advance(self.time_step, observer);
        // Particles that are found out of place may be so because walls are not where they say.
        if matches!(
            done,
            Ok(())
                | Err(StepError::Escaped { .. }
                    | StepError::Overlap { .. }
                    | StepError::Jump { .. })
        ) {
            self.engine.state.check_rates()?;
        }
        done
    }

    /// Starts the sums of impulses on the containers afresh.
    fn reset_impulses(&mut self) {
        let state = &mut self.engine.state;
        let compartments = state.compartments.iter();
        let origins = compartments.map(|compartment| compartment.motion.position);
        state
            .mount_coordinates
            .reset_impulses(state.degrees, origins);
    }

    fn advance(&mut self, dt: f64, observer: &mut dyn Observer) -> Result<(), StepError> {
        let mut parts = Parts {
            mount: &self.mount,
            detectors: &mut self.detectors,
            observer,
        };
        let (clock, integrator) = (&mut self.clock, &mut self.integrator);
        self.engine.step(dt, clock, integrator, &mut parts)
    }

    /// What there is to be seen.
    fn observed(&self) -> Observed<'_, C, L> {
        Observed::new(&self.engine, &self.mount)
    }

    /// Simulated time in s.
    #[must_use]
    pub const fn time(&self) -> f64 {
        self.clock.time()
    }

    /// Length of a step in s.
    #[must_use]
    pub const fn time_step(&self) -> f64 {
        self.time_step
    }

    /// How many particles there are.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.engine.state.particles.len()
    }

    /// Whether the container is empty.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The particle of a number, in the order in which they were given; positions are in the fixed
    /// frame.
    #[must_use]
    pub fn particle(&self, number: usize) -> Option<Particle> {
        self.observed().particle(number)
    }

    /// The particles in the order of their numbers.
    pub fn particles(&self) -> impl ExactSizeIterator<Item = Particle> {
        self.engine.state.particles.index_of.iter().map(|index| {
            let index = *index as usize;
            let cavity = self.engine.state.cavity_of(index) as u32;
            self.engine.state.particles.particle(index, cavity)
        })
    }

    /// The mount.
    #[must_use]
    pub const fn mount(&self) -> &M {
        &self.mount
    }

    /// The contact law.
    #[must_use]
    pub const fn law(&self) -> &L {
        &self.engine.model.law
    }

    /// The detector of a cavity.
    #[must_use]
    pub fn detector(&self, cavity: usize) -> Option<&D> {
        self.detectors.get(cavity)
    }

    /// The mount's generalised coordinates.
    #[must_use]
    pub fn coordinates(&self) -> &[f64] {
        self.engine.state.mount_state()[0]
    }

    /// The rates of the mount's generalised coordinates.
    #[must_use]
    pub fn rates(&self) -> &[f64] {
        self.engine.state.mount_state()[1]
    }

    /// How the container of a cavity moves.
    #[must_use]
    pub fn container(&self, cavity: usize) -> Option<Motion> {
        self.observed().container(cavity)
    }

    /// What the particles of a cavity did to its container over the last step.
    #[must_use]
    pub fn reaction(&self, cavity: usize) -> Option<Reaction> {
        let state = &self.engine.state;
        let Load { force, torque } = *state.loads.get(cavity)?;
        let origin = state.compartments[cavity].motion.position;
        let sums = state
            .mount_coordinates
            .impulses(state.degrees, cavity, origin);
        let [impulse, angular_impulse] = sums?;
        Some(Reaction {
            force,
            impulse,
            torque,
            angular_impulse,
        })
    }

    /// Load of the particles on a wall of a cavity at the end of the last step; of an impulse law,
    /// over the step.
    #[must_use]
    pub fn wall_load(&self, cavity: usize, wall: u32) -> Option<WallLoad> {
        self.observed().wall_load(cavity, wall)
    }

    /// How many contacts there were when they were evaluated last, walls included.
    #[must_use]
    pub fn contacts(&self) -> usize {
        self.engine.neighbours.contacts()
    }

    /// The largest overlap in m: under a force law when contacts were evaluated last, under an impulse law at
    /// the start of the last step.
    #[must_use]
    pub fn largest_overlap(&self) -> f64 {
        self.engine.neighbours.largest_overlap()
    }

    /// How many particles have their centre outside their cavity.
    #[must_use]
    pub fn outside(&self) -> usize {
        let state = &self.engine.state;
        let cavities = state.compartments.iter().zip(&self.engine.model.cavities);
        let outside = |(number, (compartment, cavity)): (usize, (&Compartment, &C))| {
            let container = self.container(number).unwrap_or_default();
            let local = |index| container.to_local(state.particles.position.get(index));
            let indices = compartment.indices.clone();
            indices
                .filter(|index| clearance(cavity, local(*index)) < 0.0)
                .count()
        };
        cavities.enumerate().map(outside).sum()
    }

    /// How often candidates have been listed anew.
    #[must_use]
    pub const fn detections(&self) -> u64 {
        self.engine.neighbours.detections
    }

    /// Memory in bytes that particles, candidates and contacts have reserved.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.engine.reserved_bytes()
    }

    /// Kinetic energy of the particles in J, translation and spin.
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        self.particles()
            .map(|particle| particle.kinetic_energy())
            .sum()
    }

    /// Momentum of the particles in kg m/s.
    #[must_use]
    pub fn momentum(&self) -> DVec3 {
        self.particles()
            .map(|particle| particle.velocity * particle.mass)
            .sum()
    }

    /// Angular momentum of the particles about a `point` of the fixed frame (m), in kg m^2/s, spin included.
    #[must_use]
    pub fn angular_momentum(&self, point: DVec3) -> DVec3 {
        self.particles()
            .map(|particle| {
                let momentum = particle.velocity * particle.mass;
                (particle.position - point).cross(momentum) + particle.spin * particle.inertia()
            })
            .sum()
    }
}
