//! What contacts are computed from, and how two bodies meet and part.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::ops::Range;

use glam::{DMat3, DVec3};

use super::candidates::Candidates;
use super::chunk::Moment;
use super::coefficients::Coefficients;
use super::particles::Particles;
use super::vectors::{Rows, polar};
use crate::cavity::{Cavity, WallPoint};
use crate::contact::ContactForce;
use crate::law::ContactLaw;
use crate::mount::Motion;

/// A cavity with the particles in it.
#[derive(Debug, Clone)]
pub(crate) struct Room<C> {
    pub(crate) cavity: C,
    /// Slots of its particles.
    pub(crate) slots: Range<usize>,
    /// Number of its first wall among the walls of all cavities.
    pub(crate) first_wall: u32,
    /// Where its container is, and how it moves.
    pub(crate) motion: Motion,
    /// Inverse effective mass of the container: velocity that it gains per unit impulse, 1/kg.
    pub(crate) inverse_mass: DMat3,
    /// How much farther than the law's reach candidates are listed, m: they can be trusted while no
    /// particle has moved by half of it.
    pub(crate) margin: f64,
}

/// The rules that contacts follow, and the rooms that they happen in.
#[derive(Debug, Clone)]
pub(crate) struct World<C, L: ContactLaw> {
    pub(crate) law: L,
    pub(crate) coefficients: Coefficients<L::Coefficients>,
    pub(crate) rooms: Vec<Room<C>>,
    /// Number of the room of each wall.
    pub(crate) room_of_wall: Vec<u32>,
    /// Gap in m up to which bodies count as in contact: zero under a force law.
    pub(crate) reach: f64,
    /// Gap in m up to which candidates are listed, besides the margin.
    pub(crate) listed: f64,
    /// Number of the last accepted step; it wraps.
    pub(crate) stamp: u32,
    /// Length of the step, s.
    pub(crate) time_step: f64,
}

impl<C: Cavity, L: ContactLaw> World<C, L> {
    /// The scene of `particles`, `elapsed` seconds after memories were advanced.
    pub(crate) fn scene<'a>(&'a self, particles: &'a Particles, elapsed: f64) -> Scene<'a, C, L> {
        Scene {
            law: &self.law,
            coefficients: &self.coefficients,
            rooms: &self.rooms,
            room_of_wall: &self.room_of_wall,
            position: particles.position.rows(),
            velocity: particles.velocity.rows(),
            spin: particles.spin.rows(),
            acceleration: particles.acceleration.rows(),
            radius: &particles.radius,
            inverse_mass: &particles.inverse_mass,
            inverse_inertia: &particles.inverse_inertia,
            species: &particles.species,
            number: &particles.number,
            moment: Moment {
                elapsed,
                correction: 0.0,
                time_step: self.time_step,
            },
            stamp: self.stamp,
            planar: self.planar(),
            reach: self.reach,
            listed: self.listed,
        }
    }
}

impl<C, L: ContactLaw> World<C, L> {
    /// Whether everything moves in the plane z = 0.
    pub(crate) fn planar(&self) -> bool
    where
        C: Cavity,
    {
        self.rooms.iter().all(|room| room.cavity.is_planar())
    }

    /// Number of the cavity whose particle is in `slot`.
    pub(crate) fn cavity_of(&self, slot: usize) -> usize {
        self.rooms.partition_point(|room| room.slots.end <= slot)
    }
}

/// The state that contacts are computed from, for reading alone.
pub(crate) struct Scene<'a, C, L: ContactLaw> {
    pub(crate) law: &'a L,
    pub(crate) coefficients: &'a Coefficients<L::Coefficients>,
    pub(crate) rooms: &'a [Room<C>],
    pub(crate) room_of_wall: &'a [u32],
    pub(crate) position: Rows<'a>,
    pub(crate) velocity: Rows<'a>,
    pub(crate) spin: Rows<'a>,
    /// As they were evaluated last.
    pub(crate) acceleration: Rows<'a>,
    pub(crate) radius: &'a [f64],
    pub(crate) inverse_mass: &'a [f64],
    pub(crate) inverse_inertia: &'a [f64],
    pub(crate) species: &'a [u32],
    pub(crate) number: &'a [u32],
    /// When in the step this is.
    pub(crate) moment: Moment,
    /// Number of the last accepted step.
    pub(crate) stamp: u32,
    /// Whether everything moves in the plane z = 0.
    pub(crate) planar: bool,
    /// As in [`World`].
    pub(crate) reach: f64,
    pub(crate) listed: f64,
}

/// What a contact needs to know of a particle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Grain {
    pub(crate) position: DVec3,
    pub(crate) velocity: DVec3,
    pub(crate) spin: DVec3,
    pub(crate) radius: f64,
}

/// Normal, and overlap in m, of two spheres whose centres are `towards` apart, from the second to the
/// first. Coincident centres have no normal and feel no force.
#[inline(always)]
pub(crate) fn meeting<const PLANAR: bool>(towards: DVec3, radii: [f64; 2]) -> (DVec3, f64) {
    let distance = towards.length();
    let inverse = 1.0 / (distance + f64::MIN_POSITIVE);
    let normal = polar::<PLANAR>(towards * inverse);
    (normal, radii[0] + radii[1] - distance)
}

/// Distances of two centres from the point at which the bodies touch, m: in the middle of the overlap,
/// where bodies of one stiffness meet (Hertz). They sum to the distance of the centres, whatever the
/// overlap, so that friction keeps angular momentum.
#[inline(always)]
pub(crate) fn levers(radii: [f64; 2], overlap: f64) -> [f64; 2] {
    radii.map(|radius| radius - 0.5 * overlap)
}

/// Velocity of one surface relative to the other in m/s. `velocity` is that of the first centre
/// relative to the second body; a wall has no lever.
#[inline(always)]
pub(crate) fn at_surface<const PLANAR: bool>(
    normal: DVec3,
    velocity: DVec3,
    spins: [DVec3; 2],
    levers: [f64; 2],
) -> DVec3 {
    let turning = spins[0] * levers[0] + spins[1] * levers[1];
    polar::<PLANAR>(velocity - turning.cross(normal))
}

/// Force on the first of two bodies, and torques on both. Without `COUPLE` the answer has none.
#[inline(always)]
pub(crate) fn resolve<const PLANAR: bool, const COUPLE: bool>(
    normal: DVec3,
    levers: [f64; 2],
    answer: &ContactForce,
) -> (DVec3, [DVec3; 2]) {
    let tangential = polar::<PLANAR>(answer.tangential);
    let turn = tangential.cross(normal);
    let [mut first, mut second] = levers.map(|lever| turn * lever);
    if COUPLE {
        first += answer.couple;
        second -= answer.couple;
    }
    (normal * answer.normal + tangential, [first, second])
}

impl<C: Cavity> Room<C> {
    /// Force of the particles on the container in N, from the loads on the walls of all cavities.
    pub(crate) fn load(&self, walls: &[WallLoad]) -> DVec3 {
        let first = self.first_wall as usize;
        let own = &walls[first..first + self.cavity.walls() as usize];
        own.iter().map(|wall| wall.force).sum()
    }
}

impl<C> Room<C> {
    /// Velocity along `normal` that the container gains per unit impulse along it, 1/kg.
    #[inline(always)]
    pub(crate) fn inverse_mass_along(&self, normal: DVec3) -> f64 {
        normal.dot(self.inverse_mass * normal)
    }

    /// The greatest velocity that the container gains per unit impulse in any direction, from above
    /// (Gershgorin), 1/kg.
    pub(crate) fn greatest_inverse_mass(&self) -> f64 {
        let rows = [0, 1, 2].map(|row| self.inverse_mass.row(row).abs().element_sum());
        rows.into_iter().fold(0.0, f64::max)
    }

    /// The slots among `slots` whose particles are in this room.
    pub(crate) fn slots_in(&self, slots: &Range<usize>) -> Range<usize> {
        let start = self.slots.start.clamp(slots.start, slots.end);
        start..self.slots.end.clamp(start, slots.end)
    }
}

impl<C: Cavity, L: ContactLaw> Scene<'_, C, L> {
    /// The particle in a slot.
    #[inline(always)]
    pub(crate) fn grain(&self, slot: usize) -> Grain {
        Grain {
            position: self.position.get(slot),
            velocity: self.velocity.get(slot),
            spin: self.spin.get(slot),
            radius: self.radius[slot],
        }
    }

    /// The coefficients of two particles that stand at a place of a list.
    #[inline(always)]
    pub(crate) fn pair(
        &self,
        list: &Candidates<L>,
        bodies: [u32; 2],
        place: u32,
    ) -> L::Coefficients {
        let [first, second] = bodies.map(|slot| self.species[slot as usize]);
        self.coefficients.pair(first, second, list.prepared(place))
    }

    /// Number of the room that a particle is in.
    #[inline(always)]
    pub(crate) fn room_of(&self, slot: u32) -> usize {
        self.rooms
            .partition_point(|room| room.slots.end <= slot as usize)
    }

    /// How a wall stands to a point of the fixed frame.
    #[inline(always)]
    pub(crate) fn wall_point(&self, wall: u32, position: DVec3) -> WallPoint {
        let room = self.room_of_wall(wall);
        room.cavity
            .wall(wall - room.first_wall, position - room.motion.position)
    }

    /// Number of the cavity that has a wall.
    #[inline(always)]
    pub(crate) fn cavity_of_wall(&self, wall: u32) -> usize {
        self.room_of_wall[wall as usize] as usize
    }

    #[inline(always)]
    pub(crate) fn room_of_wall(&self, wall: u32) -> &Room<C> {
        &self.rooms[self.cavity_of_wall(wall)]
    }
}

/// Force and torque of the particles on one wall.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WallLoad {
    /// Force on the wall in N, fixed frame.
    pub force: DVec3,
    /// Torque on the wall about the container's origin, in N m.
    pub torque: DVec3,
}

impl WallLoad {
    /// Adds the reaction to `force` on a particle, with the couple `couple` besides, at `arm` from
    /// the container's origin.
    #[inline]
    pub(crate) fn react(&mut self, force: DVec3, couple: DVec3, arm: DVec3) {
        self.force -= force;
        self.torque -= arm.cross(force) + couple;
    }

    pub(crate) fn add(&mut self, other: &Self) {
        self.force += other.force;
        self.torque += other.torque;
    }
}
