//! What a damper is set up of, told apart by fingerprints.

use std::fmt::{self, Write};

use glam::DVec3;

use super::coefficients::Coefficients;
use super::engine::Engine;
use crate::cavity::Cavity;
use crate::contact::Body;
use crate::detector::Detector;
use crate::law::ContactLaw;
use crate::mount::Mount;

/// The setup of a damper, as far as its state means nothing without it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Setup {
    time_step: f64,
    gravity: DVec3,
    kinds: Fingerprint,
    cavities: Fingerprint,
    law: Fingerprint,
    mount: Fingerprint,
}

impl Setup {
    /// The setup of `engine` under steps of `time_step` (s).
    pub(crate) fn new<C, L, M, D>(engine: &Engine<C, L, M, D>, time_step: f64) -> Self
    where
        C: Cavity,
        L: ContactLaw,
        M: Mount,
        D: Detector,
    {
        let world = &engine.world;
        let mut cavities = Fingerprint::default();
        let mut mount = Fingerprint::default();
        cavities.add(&world.rooms.len());
        mount.add(&engine.mount.degrees());
        mount.add(&engine.container_responses());
        for room in &world.rooms {
            cavities.add_cavity(&room.cavity);
        }
        if world.rooms.len() > 1 {
            cavities.add(&engine.particles.number);
        }
        Self {
            time_step,
            gravity: engine.gravity,
            kinds: Fingerprint::of(&engine.particles.kinds),
            cavities,
            law: Fingerprint::of_law(&world.coefficients, &engine.particles.kinds),
            mount,
        }
    }

    /// What differs first in `other`.
    pub(crate) fn difference(&self, other: &Self) -> Option<&'static str> {
        [
            ("bed: radii, masses or materials", self.kinds == other.kinds),
            ("set of cavities", self.cavities == other.cavities),
            (
                "time step",
                self.time_step.to_bits() == other.time_step.to_bits(),
            ),
            ("gravity", self.gravity == other.gravity),
            ("contact law", self.law == other.law),
            ("mount", self.mount == other.mount),
        ]
        .into_iter()
        .find_map(|(quantity, same)| (!same).then_some(quantity))
    }
}

/// The FNV-1a hash of what values show of themselves for debugging, which of a number is every bit.
/// (Fowler, Noll & Vo; the same on every platform.)
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Fingerprint(u64);

impl Default for Fingerprint {
    fn default() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }
}

impl Write for Fingerprint {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3);
        }
        Ok(())
    }
}

impl Fingerprint {
    fn of(value: &impl fmt::Debug) -> Self {
        let mut own = Self::default();
        own.add(value);
        own
    }

    fn add(&mut self, value: &impl fmt::Debug) {
        // Hashing fails only if the value's own formatting does; what came before then has to do.
        let _ = write!(self, "{value:?};");
    }

    /// A law by what it prepares for each kind at a wall and against itself and its neighbour.
    fn of_law<K: Copy + fmt::Debug>(table: &Coefficients<K>, kinds: &[Body]) -> Self {
        let mut own = Self::default();
        let count = kinds.len() as u32;
        for kind in 0..count {
            own.add(table.wall(kind));
            if !table.is_by_pair() {
                own.add(&table.pair(kind, kind, None));
                own.add(&table.pair(kind, (kind + 1) % count, None));
            }
        }
        own
    }

    /// A cavity by its walls as they stand to the corners of its bounds.
    fn add_cavity<C: Cavity>(&mut self, cavity: &C) {
        let [low, high] = cavity.bounds();
        self.add(&(low, high, cavity.walls(), cavity.is_planar()));
        for corner in 0..8_u32 {
            let pick = DVec3::from_array([0, 1, 2].map(|axis| f64::from(corner >> axis & 1)));
            for number in 0..cavity.walls() {
                let wall = cavity.wall(number, low + (high - low) * pick);
                self.add(&(wall.normal, wall.distance));
            }
        }
    }
}
