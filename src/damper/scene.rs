//! What contacts are computed from, and how two bodies become a [`Contact`].

use std::ops::Range;

use glam::{DMat3, DVec3};

use super::coefficients::Coefficients;
use super::particles::Particles;
use crate::cavity::Cavity;
use crate::contact::{Contact, ContactForce};
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
    /// Gap in m up to which contacts are evaluated.
    pub(crate) reach: f64,
    /// Number of the last accepted step; it wraps.
    pub(crate) stamp: u32,
}

impl<C, L: ContactLaw> World<C, L> {
    /// The scene of `particles`, `elapsed` seconds after memories were advanced.
    pub(crate) fn scene<'a>(&'a self, particles: &'a Particles, elapsed: f64) -> Scene<'a, C, L> {
        Scene {
            law: &self.law,
            coefficients: &self.coefficients,
            rooms: &self.rooms,
            position: &particles.position,
            velocity: &particles.velocity,
            spin: &particles.spin,
            radius: &particles.radius,
            species: &particles.species,
            number: &particles.number,
            reach: self.reach,
            elapsed,
            stamp: self.stamp,
        }
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
    pub(crate) position: &'a [DVec3],
    pub(crate) velocity: &'a [DVec3],
    pub(crate) spin: &'a [DVec3],
    pub(crate) radius: &'a [f64],
    pub(crate) species: &'a [u32],
    pub(crate) number: &'a [u32],
    /// Gap up to which contacts are evaluated, m.
    pub(crate) reach: f64,
    /// Time since memories were advanced, s.
    pub(crate) elapsed: f64,
    /// Number of the last accepted step.
    pub(crate) stamp: u32,
}

/// Two particles that touch.
pub(crate) struct PairContact {
    pub(crate) contact: Contact,
    pub(crate) radii: [f64; 2],
}

impl PairContact {
    /// Force on the first body, and torques on the first and on the second.
    #[inline]
    pub(crate) fn resolve(&self, answer: &ContactForce) -> (DVec3, DVec3, DVec3) {
        let normal = self.contact.normal;
        let force = normal * answer.normal + answer.tangential;
        let turn = answer.tangential.cross(normal);
        let first = turn * self.radii[0] + answer.couple;
        let second = turn * self.radii[1] - answer.couple;
        (force, first, second)
    }
}

impl<C: Cavity, L: ContactLaw> Scene<'_, C, L> {
    /// Whether two particles are within the law's reach.
    #[inline]
    pub(crate) fn is_reached(&self, first: usize, second: usize) -> bool {
        let reach = self.radius[first] + self.radius[second] + self.reach;
        self.position[first].distance_squared(self.position[second]) < reach * reach
    }

    /// The contact of two particles, with `velocity` and `spin` in place of the scene's own.
    /// Coincident centres have no normal and feel no force.
    #[inline]
    pub(crate) fn pair_with(
        &self,
        first: usize,
        second: usize,
        velocity: &[DVec3],
        spin: &[DVec3],
    ) -> PairContact {
        let apart = self.position[first] - self.position[second];
        let distance = apart.length();
        let normal = apart * if distance > 0.0 { 1.0 / distance } else { 0.0 };
        let radii = [self.radius[first], self.radius[second]];
        let turning = spin[first] * radii[0] + spin[second] * radii[1];
        let velocity = velocity[first] - velocity[second] - turning.cross(normal);
        PairContact {
            contact: Contact {
                normal,
                overlap: radii[0] + radii[1] - distance,
                velocity,
                velocity_ahead: velocity,
                spins: [spin[first], spin[second]],
                elapsed: self.elapsed,
                mobility: DMat3::ZERO,
            },
            radii,
        }
    }

    /// The contact of two particles.
    #[inline]
    pub(crate) fn pair(&self, first: usize, second: usize) -> PairContact {
        self.pair_with(first, second, self.velocity, self.spin)
    }

    /// The contact of the particle in `slot` with a wall, if they touch, with `velocity`, `spin` and
    /// the container's velocity in place of the scene's own; and the distance of the two.
    #[inline]
    pub(crate) fn wall_with(
        &self,
        slot: usize,
        wall: u32,
        velocity: DVec3,
        spin: DVec3,
        container: DVec3,
    ) -> (f64, Contact) {
        let room = self.room_of_wall(wall);
        let point = self.position[slot] - room.motion.position;
        let point = room.cavity.wall(wall - room.first_wall, point);
        let radius = self.radius[slot];
        let surface = velocity - container - (spin * radius).cross(point.normal);
        let contact = Contact {
            normal: point.normal,
            overlap: radius - point.distance,
            velocity: surface,
            velocity_ahead: surface,
            spins: [spin, DVec3::ZERO],
            elapsed: self.elapsed,
            mobility: DMat3::ZERO,
        };
        (point.distance, contact)
    }

    /// The contact of the particle in `slot` with a wall, and the distance of the two.
    #[inline]
    pub(crate) fn wall(&self, slot: usize, wall: u32) -> (f64, Contact) {
        let container = self.room_of_wall(wall).motion.velocity;
        self.wall_with(slot, wall, self.velocity[slot], self.spin[slot], container)
    }

    /// Number of the cavity that has a wall.
    #[inline]
    pub(crate) fn cavity_of_wall(&self, wall: u32) -> usize {
        self.rooms.partition_point(|room| room.first_wall <= wall) - 1
    }

    #[inline]
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
