//! Snapshots: the whole state of a damper, apart from how it is set up.

use std::fmt;

use glam::DVec3;

use super::Damper;
use super::engine::Engine;
use super::neighbours::ContactRecord;
use super::state::{Clock, MountCoordinates, Setup};
use crate::cavity::Cavity;
use crate::contact::WallLoad;
use crate::detector::Detector;
use crate::digest::Digest;
use crate::integrator::Integrator;
use crate::law::{ContactLaw, ContactMemory, LawKind};
use crate::mount::{Load, Motion, Mount};
use crate::step_error::StepError;

mod recording;

pub use recording::{Recorded, Recording, ReplayError};

/// Number of the layout of [`Snapshot`], which changes with it.
const VERSION: u32 = 2;

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
    version: u32,
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
    memory: [Vec<ContactRecord<Memory>>; 2],
}

impl<Memory> fmt::Debug for Snapshot<Memory> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Snapshot")
            .field("time", &self.time())
            .field("particles", &self.number.len())
            .field("contacts", &self.memory.each_ref().map(Vec::len))
            .field("digest", &self.digest)
            .finish_non_exhaustive()
    }
}

/// Why a snapshot cannot be restored into a damper.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RestoreError {
    /// The snapshot was written by a version of this library that lays it out otherwise.
    #[error("the snapshot has layout {found}, this version of the library reads {expected}")]
    Version {
        /// The layout that this version reads.
        expected: u32,
        /// The layout of the snapshot.
        found: u32,
    },
    /// The snapshot is of a damper with another number of something.
    #[error("the snapshot has {found} {quantity}, the damper {expected}")]
    Mismatch {
        /// What was counted.
        quantity: &'static str,
        /// How many the damper has.
        expected: usize,
        /// How many the snapshot has.
        found: usize,
    },
    /// The snapshot is of a damper that is set up otherwise.
    #[error("the snapshot is of a damper with another {quantity}")]
    OtherSetup {
        /// What differs.
        quantity: &'static str,
    },
    /// The snapshot was damaged: no damper has such a state.
    #[error("the snapshot is damaged: its {quantity} cannot be")]
    Damaged {
        /// What is wrong in it.
        quantity: &'static str,
    },
    /// The snapshot is not what was taken: it was changed on the way, by a format that does not keep every
    /// bit of a number, for instance.
    #[error(
        "the snapshot was changed on the way: its digest does not fit (a text format has to keep every bit of a number, serde_json with `float_roundtrip`)"
    )]
    Changed,
    /// The contacts cannot be taken up again. The damper has to be restored from another snapshot.
    #[error(transparent)]
    State(#[from] StepError),
}

impl RestoreError {
    /// `Ok` if the damper and the snapshot have as many of a `quantity`.
    const fn count(quantity: &'static str, expected: usize, found: usize) -> Result<(), Self> {
        if expected == found {
            return Ok(());
        }
        Err(Self::Mismatch {
            quantity,
            expected,
            found,
        })
    }

    /// `Ok` if a `quantity` of the snapshot is `sound`.
    const fn sound(quantity: &'static str, sound: bool) -> Result<(), Self> {
        if sound {
            return Ok(());
        }
        Err(Self::Damaged { quantity })
    }
}

impl<Memory> Snapshot<Memory> {
    /// Simulated time in s.
    #[must_use]
    pub const fn time(&self) -> f64 {
        self.clock.time()
    }

    /// The digest that it carries.
    pub(crate) const fn own_digest(&self) -> Digest {
        self.digest
    }

    /// The digest of everything, contacts as `law` tells what they remember.
    fn digest<L>(&self, law: &L) -> Digest
    where
        L: ContactLaw,
        L::Kind: LawKind<L, Memory = Memory>,
    {
        let mut digest = Digest::default();
        digest.words(&[self.version, self.since_sort]);
        self.setup.add_to(&mut digest);
        self.clock.add_to(&mut digest);
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
        for contact in self.memory.iter().flatten() {
            digest.words(&[contact.first, contact.second]);
            L::Kind::tell_memory(law, &contact.memory, &mut |number| digest.number(number));
        }
        digest
    }

    /// Refuses what does not fit into `engine`, and what cannot be.
    fn check<C, L, M, D>(
        &self,
        engine: &Engine<C, L, M, D>,
        setup: &Setup,
    ) -> Result<(), RestoreError>
    where
        C: Cavity,
        L: ContactLaw,
        L::Kind: LawKind<L, Memory = Memory>,
        M: Mount,
        D: Detector,
    {
        let count = engine.state.particles.len();
        let cavities = engine.state.model.compartments.len();
        let coordinates = engine.state.mount_coordinates.position.len();
        RestoreError::count("particles", count, self.number.len())?;
        RestoreError::count("cavities", cavities, self.containers.len())?;
        RestoreError::count(
            "walls",
            engine.state.wall_loads.len(),
            self.wall_loads.len(),
        )?;
        RestoreError::count("mount coordinates", coordinates, self.mount.position.len())?;
        if let Some(quantity) = setup.difference(&self.setup) {
            return Err(RestoreError::OtherSetup { quantity });
        }

        let columns = [
            ("positions", &self.position),
            ("velocities", &self.velocity),
            ("spins", &self.spin),
            ("accelerations", &self.acceleration),
            ("angular accelerations", &self.angular_acceleration),
        ];
        for (quantity, column) in columns {
            RestoreError::count(quantity, count, column.len())?;
            let finite = column.iter().all(|vector| vector.is_finite());
            RestoreError::sound(quantity, finite)?;
        }
        RestoreError::count("species", count, self.species.len())?;
        RestoreError::count("loads", cavities, self.loads.len())?;
        RestoreError::count("containers", cavities, self.mount.origins.len())?;
        let mut origins = self.mount.origins.iter();
        RestoreError::sound("containers", origins.all(|origin| origin.is_finite()))?;
        let mount = &self.mount;
        for column in [&mount.position, &mount.velocity, &mount.acceleration] {
            RestoreError::count("mount coordinates", coordinates, column.len())?;
            let finite = column.iter().all(|value| value.is_finite());
            RestoreError::sound("mount coordinates", finite)?;
        }
        RestoreError::sound("clock", self.clock.is_sound())?;
        let mut motions = self.containers.iter();
        let moving = |motion: &Motion| motion.is_finite() && motion.normalized().is_some();
        RestoreError::sound("containers", motions.all(moving))?;
        let loaded = |load: &WallLoad| load.force.is_finite() && load.torque.is_finite();
        RestoreError::sound("wall loads", self.wall_loads.iter().all(loaded))?;
        let loaded = |load: &Load| load.force.is_finite() && load.torque.is_finite();
        RestoreError::sound("loads", self.loads.iter().all(loaded))?;
        self.check_numbers(engine)?;
        self.check_memory(count, engine.state.wall_loads.len())?;
        if self.digest(&engine.state.model.law) != self.digest {
            return Err(RestoreError::Changed);
        }
        Ok(())
    }

    /// Refuses numbers that are not each particle's once, at an index of its own cavity.
    fn check_numbers<C, L, M, D>(&self, engine: &Engine<C, L, M, D>) -> Result<(), RestoreError>
    where
        L: ContactLaw,
    {
        let particles = &engine.state.particles;
        let mut seen = vec![false; particles.len()];
        for (index, (number, species)) in self.number.iter().zip(&self.species).enumerate() {
            let number = *number as usize;
            let own = seen
                .get_mut(number)
                .is_some_and(|seen| !std::mem::replace(seen, true));
            RestoreError::sound("particle numbers", own)?;
            let now = particles.index_of[number] as usize;
            let at_home = engine.state.model.cavity_of(index) == engine.state.model.cavity_of(now);
            RestoreError::sound("particle numbers", at_home)?;
            RestoreError::sound("species", particles.species[now] == *species)?;
        }
        Ok(())
    }

    /// Refuses what is remembered of contacts that do not exist, or that are out of order.
    fn check_memory(&self, particles: usize, walls: usize) -> Result<(), RestoreError> {
        let [pairs, others] = &self.memory;
        let paired = |contact: &ContactRecord<Memory>| {
            let number = |index: u32| self.number.get(index as usize);
            let (_, high) = contact.pair();
            (high as usize) < particles && number(contact.first) < number(contact.second)
        };
        let walled = |contact: &ContactRecord<Memory>| {
            (contact.first as usize) < particles && (contact.second as usize) < walls
        };
        let rising = pairs.is_sorted_by(|a, b| a.pair() < b.pair())
            && others.is_sorted_by(|a, b| a.wall() < b.wall());
        let sound = pairs.iter().all(paired) && others.iter().all(walled);
        RestoreError::sound("contacts", sound && rising)
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
        let engine = &self.engine;
        let particles = &engine.state.particles;
        let mut snapshot = Snapshot {
            version: VERSION,
            digest: Digest::default(),
            setup: self.setup,
            clock: self.clock,
            since_sort: engine.neighbours.since_sort,
            species: particles.species.clone(),
            number: particles.id.clone(),
            position: particles.position.iter().collect(),
            velocity: particles.velocity.iter().collect(),
            spin: particles.spin.iter().collect(),
            acceleration: particles.acceleration.iter().collect(),
            angular_acceleration: particles.angular_acceleration.iter().collect(),
            mount: engine.state.mount_coordinates.clone(),
            containers: engine
                .state
                .model
                .compartments
                .iter()
                .map(|compartment| compartment.motion)
                .collect(),
            wall_loads: engine.state.wall_loads.clone(),
            loads: engine.state.loads.clone(),
            memory: engine.neighbours.history(engine.state.stamp),
        };
        snapshot.digest = snapshot.digest(&engine.state.model.law);
        snapshot
    }

    /// Puts the damper into the state of `snapshot`, from which it goes on to the same bits.
    ///
    /// # Errors
    /// If the snapshot is of another version or setup, or is damaged; the damper is then as before.
    pub fn restore(&mut self, snapshot: &Snapshot<ContactMemory<L>>) -> Result<(), RestoreError> {
        if snapshot.version != VERSION {
            return Err(RestoreError::Version {
                expected: VERSION,
                found: snapshot.version,
            });
        }
        let engine = &mut self.engine;
        snapshot.check(engine, &self.setup)?;
        let particles = &mut engine.state.particles;
        particles.rearrange(&snapshot.number);
        particles.position.assign(snapshot.position.iter().copied());
        particles.velocity.assign(snapshot.velocity.iter().copied());
        particles.spin.assign(snapshot.spin.iter().copied());
        particles
            .acceleration
            .assign(snapshot.acceleration.iter().copied());
        let turning = snapshot.angular_acceleration.iter();
        particles.angular_acceleration.assign(turning.copied());
        engine.state.mount_coordinates.clone_from(&snapshot.mount);
        engine.state.wall_loads.clone_from(&snapshot.wall_loads);
        engine.state.loads.clone_from(&snapshot.loads);
        for (compartment, motion) in engine
            .state
            .model
            .compartments
            .iter_mut()
            .zip(&snapshot.containers)
        {
            compartment.place(*motion);
        }
        engine.state.mount.resume(&snapshot.containers);
        self.clock = snapshot.clock;
        engine.neighbours.since_sort = snapshot.since_sort;
        engine.state.time = self.clock.time();
        engine
            .neighbours
            .list(&engine.state, Some(&snapshot.memory))?;
        Ok(())
    }

    /// Puts the damper into the state of `other`, which differs in what drives it and in its time step. Its
    /// own time goes on.
    pub(crate) fn take_over(&mut self, other: &Self) -> Result<(), RestoreError> {
        let mut snapshot = other.snapshot();
        snapshot.clock = self.clock;
        snapshot.setup = snapshot.setup.under_steps_of(self.time_step);
        snapshot.digest = snapshot.digest(&self.engine.state.model.law);
        self.restore(&snapshot)
    }
}
