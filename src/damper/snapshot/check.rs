//! What a snapshot has to be, to be restored.

use super::{BareSnapshot, RestoreError, Snapshot, VERSION};
use crate::contact::WallLoad;
use crate::damper::engine::Engine;
use crate::damper::neighbours::ContactRecord;
use crate::damper::state::{Setup, State};
use crate::law::{ContactLaw, LawKind};
use crate::mount::{Load, Motion};

impl<Memory> Snapshot<Memory> {
    /// Refuses another layout, what does not fit into `engine`, and what cannot be.
    pub(super) fn check<C, L>(
        &self,
        engine: &Engine<C, L>,
        setup: &Setup,
    ) -> Result<(), RestoreError>
    where
        L: ContactLaw,
        L::Kind: LawKind<L, Memory = Memory>,
    {
        let own = &self.state;
        own.check_fit(&engine.state, setup)?;
        own.check_columns(engine.state.particles.len())?;
        own.check_containers(&engine.state)?;
        own.check_numbers(&engine.state)?;
        self.check_memory(engine.state.wall_loads.len())?;
        if self.digest(&engine.model.law) != own.digest {
            return Err(RestoreError::Changed);
        }
        Ok(())
    }

    /// Refuses what is remembered of contacts that do not exist, or that are out of order.
    fn check_memory(&self, walls: usize) -> Result<(), RestoreError> {
        let [pairs, others] = &self.memory;
        let numbers = &self.state.number;
        let paired = |contact: &ContactRecord<Memory>| {
            let number = |index: u32| numbers.get(index as usize);
            let (_, high) = contact.pair();
            (high as usize) < numbers.len() && number(contact.first) < number(contact.second)
        };
        let walled = |contact: &ContactRecord<Memory>| {
            (contact.first as usize) < numbers.len() && (contact.second as usize) < walls
        };
        let rising = pairs.is_sorted_by(|a, b| a.pair() < b.pair())
            && others.is_sorted_by(|a, b| a.wall() < b.wall());
        let sound = pairs.iter().all(paired) && others.iter().all(walled);
        RestoreError::sound("contacts", sound && rising)
    }
}

impl BareSnapshot {
    /// Refuses another layout, and a damper of another setup.
    pub(super) fn check_fit(&self, state: &State, setup: &Setup) -> Result<(), RestoreError> {
        if self.version != VERSION {
            return Err(RestoreError::Version {
                expected: VERSION,
                found: self.version,
            });
        }
        let cavities = state.compartments.len();
        let coordinates = state.mount_coordinates.position.len();
        RestoreError::count("particles", state.particles.len(), self.number.len())?;
        RestoreError::count("cavities", cavities, self.containers.len())?;
        RestoreError::count("walls", state.wall_loads.len(), self.wall_loads.len())?;
        RestoreError::count("mount coordinates", coordinates, self.mount.position.len())?;
        match setup.difference(&self.setup) {
            Some(quantity) => Err(RestoreError::OtherSetup { quantity }),
            None => Ok(()),
        }
    }

    /// Refuses columns that are not of `count` particles, or not finite.
    fn check_columns(&self, count: usize) -> Result<(), RestoreError> {
        for (quantity, column) in [
            ("positions", &self.position),
            ("velocities", &self.velocity),
            ("spins", &self.spin),
            ("accelerations", &self.acceleration),
            ("angular accelerations", &self.angular_acceleration),
        ] {
            RestoreError::count(quantity, count, column.len())?;
            let finite = column.iter().all(|vector| vector.is_finite());
            RestoreError::sound(quantity, finite)?;
        }
        RestoreError::count("species", count, self.species.len())
    }

    /// Refuses containers, coordinates of the mount, loads and times that cannot be.
    fn check_containers(&self, state: &State) -> Result<(), RestoreError> {
        let cavities = state.compartments.len();
        let coordinates = state.mount_coordinates.position.len();
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
        RestoreError::sound("loads", self.loads.iter().all(loaded))
    }

    /// Refuses numbers that are not each particle's once, at an index of its own cavity.
    fn check_numbers(&self, state: &State) -> Result<(), RestoreError> {
        let particles = &state.particles;
        let mut seen = vec![false; particles.len()];
        for (index, (number, species)) in self.number.iter().zip(&self.species).enumerate() {
            let number = *number as usize;
            let own = seen
                .get_mut(number)
                .is_some_and(|seen| !std::mem::replace(seen, true));
            RestoreError::sound("particle numbers", own)?;
            let now = particles.index_of[number] as usize;
            let at_home = state.cavity_of(index) == state.cavity_of(now);
            RestoreError::sound("particle numbers", at_home)?;
            RestoreError::sound("species", particles.species[now] == *species)?;
        }
        Ok(())
    }
}
