//! Snapshots: the whole state of a damper, apart from how it is set up.
//!
//! In: a damper between steps. Out: columns that can be kept and written; and the other way, a damper that goes on
//! from them, once they have been checked. Called by programs alone, and by what serves them: records of a host's
//! session, dampers of unlike make, curves that go on from one point to the next.

use std::fmt;

use glam::DVec3;

use super::Damper;
use super::engine::Engine;
use super::neighbours::{ContactRecord, Detectors};
use super::state::{Clock, MountCoordinates, Setup, State};
use crate::cavity::Cavity;
use crate::contact::WallLoad;
use crate::detector::Detector;
use crate::digest::Digest;
use crate::integrator::Integrator;
use crate::law::{ContactLaw, ContactMemory, LawKind};
use crate::mount::{Load, Motion, Mount};
use crate::step_error::StepError;

mod any;
mod check;
mod error;
mod recording;

pub use any::AnySnapshot;
pub use error::RestoreError;
pub use recording::{Recorded, Recording, ReplayError};

/// Number of the layout of [`Snapshot`], which changes with it.
const VERSION: u32 = 3;

/// The state of a damper whose contacts remember `Memory`: particles, contact memory, mount and time.
/// A damper that is restored from it goes on to the same bits.
///
/// With the feature `serde` it can be written and read, in any format that keeps every bit of an
/// `f64` (JSON does with `serde_json`'s `float_roundtrip`); it carries a digest of itself, and one that was
/// changed on the way is refused. It carries the number of its layout and a fingerprint of the setup, made
/// from how the parts behave: particles, cavities, law, time step, gravity, and how the mount yields.
/// What drives the mount, the integrator and the detector are free to differ, so that a settled bed
/// can be the start of many runs; to go on to the same bits, keep excitation and integrator.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// use particle_damper::{Damper, HertzTsuji, Material, Motion, Particle, Slot, glam::DVec3};
///
/// let mut damper = Damper::builder(Slot::paper(), HertzTsuji::new(Material::acrylic()))
///     .particles([Particle::new(3e-3, 2e-4)?.at(DVec3::new(0.05, 0.01, 0.0))])
///     .build()?;
/// let before = damper.snapshot();
/// let up = |height: f64| Motion::at(DVec3::Y * height, DVec3::Y);
/// let first = damper.drive(up(1e-3), 2e-3)?;
/// damper.restore(&before)?;
/// assert_eq!(damper.drive(up(1e-3), 2e-3)?, first);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Snapshot<Memory> {
    state: BareSnapshot,
    memory: [Vec<ContactRecord<Memory>>; 2],
}

/// A snapshot but for its contacts, which is the same whatever they remember.
#[derive(Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct BareSnapshot {
    version: u32,
    /// Of the whole snapshot.
    digest: Digest,
    setup: Setup,
    clock: Clock,
    since_sort: u32,
    species: Vec<u32>,
    number: Vec<u32>,
    position: Vec<DVec3>,
    velocity: Vec<DVec3>,
    spin: Vec<DVec3>,
    acceleration: Vec<DVec3>,
    angular_acceleration: Vec<DVec3>,
    mount: MountCoordinates,
    containers: Vec<Motion>,
    wall_loads: Vec<WallLoad>,
    loads: Vec<Load>,
}

impl<Memory> fmt::Debug for Snapshot<Memory> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Snapshot")
            .field("time", &self.time())
            .field("particles", &self.state.number.len())
            .field("contacts", &self.memory.each_ref().map(Vec::len))
            .field("digest", &self.state.digest)
            .finish_non_exhaustive()
    }
}

impl<Memory> Snapshot<Memory> {
    /// Simulated time in s.
    #[must_use]
    pub const fn time(&self) -> f64 {
        self.state.clock.time()
    }

    /// The digest that it carries.
    pub(crate) const fn own_digest(&self) -> Digest {
        self.state.digest
    }

    /// The digest of everything, contacts as `law` tells what they remember.
    fn digest<L>(&self, law: &L) -> Digest
    where
        L: ContactLaw,
        L::Kind: LawKind<L, Memory = Memory>,
    {
        let mut digest = Digest::default();
        self.state.add_to(&mut digest);
        for contact in self.memory.iter().flatten() {
            digest.words(&[contact.first, contact.second]);
            L::Kind::tell_memory(law, &contact.memory, &mut |number| digest.number(number));
        }
        digest
    }
}

impl BareSnapshot {
    /// Adds all of it but its own digest.
    fn add_to(&self, digest: &mut Digest) {
        digest.words(&[self.version, self.since_sort]);
        self.setup.add_to(digest);
        self.clock.add_to(digest);
        digest.words(&self.species);
        digest.words(&self.number);
        for column in [
            &self.position,
            &self.velocity,
            &self.spin,
            &self.acceleration,
            &self.angular_acceleration,
        ] {
            digest.vectors(column);
        }
        let mount = &self.mount;
        for column in [&mount.position, &mount.velocity, &mount.acceleration] {
            digest.numbers(column);
        }
        digest.vectors(&mount.origins);
        for container in &self.containers {
            digest.vectors(&[container.position, container.velocity]);
            digest.numbers(&container.orientation.to_array());
            digest.vector(container.angular_velocity);
        }
        for load in &self.wall_loads {
            digest.vectors(&[load.force, load.torque]);
        }
        for load in &self.loads {
            digest.vectors(&[load.force, load.torque]);
        }
    }
}

impl BareSnapshot {
    /// That of `state`.
    fn new(state: &State, setup: Setup, clock: Clock, since_sort: u32) -> Self {
        let particles = &state.particles;
        let compartments = state.compartments.iter();
        Self {
            version: VERSION,
            digest: Digest::default(),
            setup,
            clock,
            since_sort,
            species: particles.species.clone(),
            number: particles.id.clone(),
            position: particles.position.iter().collect(),
            velocity: particles.velocity.iter().collect(),
            spin: particles.spin.iter().collect(),
            acceleration: particles.acceleration.iter().collect(),
            angular_acceleration: particles.angular_acceleration.iter().collect(),
            mount: state.mount_coordinates.clone(),
            containers: compartments.map(|compartment| compartment.motion).collect(),
            wall_loads: state.wall_loads.clone(),
            loads: state.loads.clone(),
        }
    }

    /// Puts `state` into this one, which fits it.
    fn apply(&self, state: &mut State) {
        let particles = &mut state.particles;
        particles.rearrange(&self.number);
        for (column, saved) in [
            (&mut particles.position, &self.position),
            (&mut particles.velocity, &self.velocity),
            (&mut particles.spin, &self.spin),
            (&mut particles.acceleration, &self.acceleration),
            (
                &mut particles.angular_acceleration,
                &self.angular_acceleration,
            ),
        ] {
            column.assign(saved.iter().copied());
        }
        state.mount_coordinates.clone_from(&self.mount);
        state.wall_loads.clone_from(&self.wall_loads);
        state.loads.clone_from(&self.loads);
        let compartments = state.compartments.iter_mut();
        for (compartment, motion) in compartments.zip(&self.containers) {
            compartment.place(*motion);
        }
        state.time = self.clock.time();
    }
}

impl<C: Cavity, L: ContactLaw> Engine<C, L> {
    fn snapshot(&self, setup: Setup, clock: Clock) -> Snapshot<ContactMemory<L>> {
        let (state, neighbours) = (&self.state, &self.neighbours);
        let mut snapshot = Snapshot {
            state: BareSnapshot::new(state, setup, clock, neighbours.since_sort),
            memory: neighbours.history(),
        };
        snapshot.state.digest = snapshot.digest(&self.model.law);
        snapshot
    }

    /// Puts everything into the state of a `snapshot` that fits.
    fn restore(
        &mut self,
        snapshot: &Snapshot<ContactMemory<L>>,
        detectors: &mut dyn Detectors,
    ) -> Result<(), StepError> {
        snapshot.state.apply(&mut self.state);
        let neighbours = &mut self.neighbours;
        neighbours.since_sort = snapshot.state.since_sort;
        let memory = Some(&snapshot.memory);
        neighbours.list(&self.model, &self.state, detectors, memory)
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
    /// The state of the damper.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot<ContactMemory<L>> {
        self.engine.snapshot(self.setup, self.clock)
    }

    /// Puts the damper into the state of `snapshot`, from which it goes on to the same bits.
    ///
    /// # Errors
    /// If the snapshot is of another version or setup, or is damaged; the damper is then as before.
    pub fn restore(&mut self, snapshot: &Snapshot<ContactMemory<L>>) -> Result<(), RestoreError> {
        snapshot.check(&self.engine, &self.setup)?;
        self.mount.resume(&snapshot.state.containers);
        self.clock = snapshot.state.clock;
        Ok(self.engine.restore(snapshot, &mut self.detectors)?)
    }

    /// Puts the damper into the state of `other`, which differs in what drives it and in its time step. Its
    /// own time goes on.
    pub(crate) fn take_over(&mut self, other: &Self) -> Result<(), RestoreError> {
        let setup = other.setup.under_steps_of(self.time_step);
        let snapshot = other.engine.snapshot(setup, self.clock);
        self.restore(&snapshot)
    }
}
