use std::fmt;

use crate::observer::BedRegime;

/// Part of m A^2 w^2/2 below which a bed's motion in its container is none.
const STILL: f64 = 0.01;

/// The state of a bed in its shaken container, in the words of the literature.
///
/// Three states are Salueña's, Pöschel's and Esipov's (1999, doi 10.1103/PhysRevE.59.4422) for shaken beds under
/// gravity, told apart by the energy lost; the fourth is what Bannerman et al. (2011,
/// doi 10.1103/PhysRevE.84.011301) and Sack et al. (2013, doi 10.1103/PhysRevLett.111.018001) found without it: a
/// bed of clear travel d collects at the walls where A > d/pi, and is a gas below. Under gravity such a bed is
/// called a bouncing bed as well. The sources tell states apart by eye and by d/(pi A); here it is done by what
/// the particles do, so that it holds for any room and axis: see [`BedState::regime`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Regime {
    /// The bed goes with the container: a mass, and next to no loss.
    Solid,
    /// The grains stay together, but flow among each other.
    Convective,
    /// The bed is thrown as one body and collects at the walls: the most loss. A single ball that does not go
    /// with the container does nothing else.
    CollectAndCollide,
    /// The grains fly apart, each by itself: the host feels little of them.
    GasLike,
}

impl fmt::Display for Regime {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Solid => "solid",
            Self::Convective => "convective",
            Self::CollectAndCollide => "collect and collide",
            Self::GasLike => "gas-like",
        })
    }
}

/// What a bed does in some time, as means that a [`BedRegime`](crate::BedRegime) finds, which says how to read
/// them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct BedState {
    /// Contacts of a particle.
    pub contacts: f64,
    /// Share of the particles that touch nothing, 0 to 1.
    pub flight: f64,
    /// Share of time in which no particle touches a wall, 0 to 1.
    pub off_walls: f64,
    /// Kinetic energy of a particle about the motion of the bed's centre of mass, J.
    pub temperature: f64,
    /// A particle's share of the kinetic energy of the bed's centre of mass, J.
    pub common_energy: f64,
    /// Kinetic energy of a particle that moves along with the container at its greatest speed, m A^2 w^2/2, J.
    pub carried_energy: f64,
    /// Kinetic energy of a particle by its motion in the container, J.
    pub relative_energy: f64,
}

impl BedState {
    /// What a bed did whose particles, at the container's greatest speed, have the energy `carried` (J) each.
    pub(super) fn new(bed: &BedRegime, carried: f64) -> Self {
        Self {
            contacts: bed.contacts(),
            flight: bed.flight(),
            off_walls: bed.off_walls(),
            temperature: bed.temperature(),
            common_energy: bed.common_energy(),
            carried_energy: carried,
            relative_energy: bed.relative_energy(),
        }
    }

    /// Part of the particles' kinetic energy that is that of their centre of mass, in the fixed frame: 1 of a
    /// bed that moves as one body, next to 0 of a gas.
    #[must_use]
    pub fn coherence(&self) -> f64 {
        let whole = self.common_energy + self.temperature;
        if whole > 0.0 {
            self.common_energy / whole
        } else {
            1.0
        }
    }

    /// The state that these numbers say, by three questions in this order:
    /// 1. Do the particles' velocities in the container hold less than a hundredth of m A^2 w^2/2? The bed is
    ///    solid.
    /// 2. Does a particle touch another or a wall for more than half of the time? The bed is convective.
    /// 3. Is half of the particles' kinetic energy, or more, that of their [common motion](Self::coherence)?
    ///    The bed collects and collides, else it is gas-like.
    ///
    /// States pass into each other gradually; near a border look at the numbers.
    #[must_use]
    pub fn regime(&self) -> Regime {
        if self.relative_energy < STILL * self.carried_energy {
            Regime::Solid
        } else if self.flight < 0.5 {
            Regime::Convective
        } else if self.coherence() >= 0.5 {
            Regime::CollectAndCollide
        } else {
            Regime::GasLike
        }
    }

    /// Adds another one by a weight.
    pub(super) fn add(&mut self, other: &Self, weight: f64) {
        self.contacts += weight * other.contacts;
        self.flight += weight * other.flight;
        self.off_walls += weight * other.off_walls;
        self.temperature += weight * other.temperature;
        self.common_energy += weight * other.common_energy;
        self.carried_energy += weight * other.carried_energy;
        self.relative_energy += weight * other.relative_energy;
    }
}
