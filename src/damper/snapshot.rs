//! Snapshots: the whole state of a damper, apart from how it is set up.

use glam::DVec3;

use super::Damper;
use super::candidates::Remembered;
use super::clock::Clock;
use super::engine::MountState;
use super::error::StepError;
use super::scene::WallLoad;
use crate::cavity::Cavity;
use crate::contact::Body;
use crate::detector::Detector;
use crate::integrator::Integrator;
use crate::law::ContactLaw;
use crate::mount::{Motion, Mount};

/// The state of a damper whose contacts remember `Memory`: particles, contact memory, mount and time.
/// A damper that is restored from it goes on to the same bits.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot<Memory> {
    clock: Clock,
    kinds: Vec<Body>,
    species: Vec<u32>,
    number: Vec<u32>,
    position: Vec<DVec3>,
    velocity: Vec<DVec3>,
    spin: Vec<DVec3>,
    acceleration: Vec<DVec3>,
    angular_acceleration: Vec<DVec3>,
    mount: MountState,
    containers: Vec<Motion>,
    wall_loads: Vec<WallLoad>,
    loads: Vec<DVec3>,
    memory: [Vec<Remembered<Memory>>; 2],
}

/// Why a snapshot cannot be restored into a damper.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RestoreError {
    /// The snapshot is of a damper that is set up otherwise.
    #[error("the snapshot has {found} {quantity}, the damper {expected}")]
    Mismatch {
        /// What was counted.
        quantity: &'static str,
        /// How many the damper has.
        expected: usize,
        /// How many the snapshot has.
        found: usize,
    },
    /// The snapshot's particles are not those of the damper.
    #[error("the snapshot's particles have other radii, masses, materials or cavities")]
    OtherParticles,
    /// The snapshot's state cannot be used.
    #[error(transparent)]
    State(#[from] StepError),
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
    pub fn snapshot(&self) -> Snapshot<L::Memory> {
        let engine = &self.engine;
        let particles = &engine.particles;
        Snapshot {
            clock: self.clock,
            kinds: particles.kinds.clone(),
            species: particles.species.clone(),
            number: particles.number.clone(),
            position: particles.position.clone(),
            velocity: particles.velocity.clone(),
            spin: particles.spin.clone(),
            acceleration: particles.acceleration.clone(),
            angular_acceleration: particles.angular_acceleration.clone(),
            mount: engine.mount_state.clone(),
            containers: engine.world.rooms.iter().map(|room| room.motion).collect(),
            wall_loads: engine.wall_loads.clone(),
            loads: engine.loads.clone(),
            memory: engine.remembered(),
        }
    }

    /// Puts the damper into the state of `snapshot`, from which it goes on to the same bits.
    ///
    /// # Errors
    /// If the snapshot is of a damper that is set up otherwise; the damper is then as before.
    pub fn restore(&mut self, snapshot: &Snapshot<L::Memory>) -> Result<(), RestoreError> {
        let engine = &mut self.engine;
        let (count, cavities) = (engine.particles.len(), engine.world.rooms.len());
        let coordinates = engine.mount_state.position.len();
        for (quantity, expected, found) in [
            ("particles", count, snapshot.number.len()),
            ("kinds of particles", count, snapshot.species.len()),
            ("positions", count, snapshot.position.len()),
            ("velocities", count, snapshot.velocity.len()),
            ("spins", count, snapshot.spin.len()),
            ("accelerations", count, snapshot.acceleration.len()),
            (
                "angular accelerations",
                count,
                snapshot.angular_acceleration.len(),
            ),
            (
                "mount coordinates",
                coordinates,
                snapshot.mount.position.len(),
            ),
            ("mount rates", coordinates, snapshot.mount.velocity.len()),
            (
                "mount accelerations",
                coordinates,
                snapshot.mount.acceleration.len(),
            ),
            ("cavities", cavities, snapshot.containers.len()),
            ("loads", cavities, snapshot.loads.len()),
            ("walls", engine.wall_loads.len(), snapshot.wall_loads.len()),
        ] {
            if expected != found {
                return Err(RestoreError::Mismatch {
                    quantity,
                    expected,
                    found,
                });
            }
        }
        let (particles, world) = (&mut engine.particles, &engine.world);
        let mut places = snapshot.number.iter().zip(&snapshot.species).enumerate();
        let same = places.all(|(place, (number, species))| {
            let slot = particles
                .slot
                .get(*number as usize)
                .map(|slot| *slot as usize);
            slot.is_some_and(|slot| {
                particles.species[slot] == *species
                    && world.cavity_of(slot) == world.cavity_of(place)
            })
        });
        if particles.kinds != snapshot.kinds || !same {
            return Err(RestoreError::OtherParticles);
        }
        particles.rearrange(&snapshot.number);
        particles.position.clone_from(&snapshot.position);
        particles.velocity.clone_from(&snapshot.velocity);
        particles.spin.clone_from(&snapshot.spin);
        particles.acceleration.clone_from(&snapshot.acceleration);
        particles
            .angular_acceleration
            .clone_from(&snapshot.angular_acceleration);
        engine.mount_state.clone_from(&snapshot.mount);
        engine.wall_loads.clone_from(&snapshot.wall_loads);
        engine.loads.clone_from(&snapshot.loads);
        for (room, motion) in engine.world.rooms.iter_mut().zip(&snapshot.containers) {
            room.motion = *motion;
        }
        engine.mount.resume(&snapshot.containers);
        self.clock = snapshot.clock;
        engine.time = self.clock.time();
        engine.recall(&snapshot.memory)?;
        Ok(())
    }
}
