//! What can be ordered of grains in a slot, and what room there is for it.

use std::error::Error;

use particle_damper::{Particle, Slot};

type Failure = Box<dyn Error + Send + Sync>;

/// The room: width and largest height in m; the mass allowed in kg; the grains' density in kg/m^3.
pub(crate) const WIDTH: f64 = 0.1;
const ROOM: f64 = 0.2;
const ALLOWED: f64 = 0.025;
const DENSITY: f64 = 1190.0;
/// Radii in m and fills that are considered.
pub(crate) const RADII: [f64; 2] = [3e-3, 9e-3];
pub(crate) const FILLS: [f64; 2] = [0.3, 0.9];

/// What can be ordered.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Design {
    pub(crate) radius: f64,
    /// Height of the bed at rest over that of the slot.
    pub(crate) fill: f64,
    pub(crate) grains: usize,
}

impl Design {
    /// From a radius, a fill and a part of the mass allowed, each brought into its range.
    pub(crate) fn new(radius: f64, fill: f64, part: f64) -> Result<Self, Failure> {
        let radius = radius.clamp(RADII[0], RADII[1]);
        let one = Particle::with_density(radius, DENSITY)?.mass;
        let grains = (part.clamp(0.1, 1.0) * ALLOWED / one).floor().max(1.0);
        let fill = fill.clamp(FILLS[0], FILLS[1]);
        let bed = Self {
            radius,
            fill,
            grains: grains as usize,
        };
        // What the room does not hold is filled more.
        let most = (bed.bed_height() / ROOM).max(fill);
        Ok(Self { fill: most, ..bed })
    }

    /// Height of the grains at rest, in rows that lie in each other's gaps.
    pub(crate) fn bed_height(&self) -> f64 {
        let room = WIDTH / (2.0 * self.radius) + 1e-9;
        let (across, shifted) = (room.floor(), (room - 0.5).floor());
        let (mut left, mut rows) = (self.grains as f64, 0);
        while left > 0.0 {
            left -= if rows % 2 == 0 { across } else { shifted };
            rows += 1;
        }
        self.radius * (2.0 + 3_f64.sqrt() * f64::from(rows - 1))
    }

    pub(crate) fn height(&self) -> f64 {
        self.bed_height() / self.fill
    }

    pub(crate) fn clearance(&self) -> f64 {
        self.height() - self.bed_height()
    }

    pub(crate) fn grain(&self) -> Result<Particle, Failure> {
        Ok(Particle::with_density(self.radius, DENSITY)?)
    }

    pub(crate) fn bed_mass(&self) -> Result<f64, Failure> {
        Ok(self.grains as f64 * self.grain()?.mass)
    }

    pub(crate) fn slot(&self) -> Result<Slot, Failure> {
        Ok(Slot::new(WIDTH, self.height())?)
    }

    /// Which of the limits it is at: a better design may lie beyond.
    pub(crate) fn limits(&self) -> Vec<&'static str> {
        let near = |value: f64, limit: f64| (value - limit).abs() < 1e-6;
        let limits = [
            (near(self.radius, RADII[0]), "smallest grain considered"),
            (near(self.radius, RADII[1]), "largest grain considered"),
            (near(self.fill, FILLS[0]), "least fill considered"),
            (near(self.fill, FILLS[1]), "largest fill considered"),
            (near(self.height(), ROOM), "height of the room"),
        ];
        let reached = limits.into_iter().filter(|limit| limit.0);
        reached.map(|limit| limit.1).collect()
    }
}
