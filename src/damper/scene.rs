//! What contacts are computed from, and how two bodies become a [`Contact`].

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::ops::Range;

use glam::{DMat3, DVec3};

use super::candidates::Touch;
use super::coefficients::Coefficients;
use super::particles::Particles;
use crate::cavity::{Cavity, WallPoint};
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
    /// Its velocity at the start of the step.
    pub(crate) start_velocity: DVec3,
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
            room_of_wall: &self.room_of_wall,
            position: &particles.position,
            velocity: &particles.velocity,
            spin: &particles.spin,
            acceleration: &particles.acceleration,
            angular_acceleration: &particles.angular_acceleration,
            radius: &particles.radius,
            species: &particles.species,
            number: &particles.number,
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
    pub(crate) room_of_wall: &'a [u32],
    pub(crate) position: &'a [DVec3],
    pub(crate) velocity: &'a [DVec3],
    pub(crate) spin: &'a [DVec3],
    /// As they were evaluated last.
    pub(crate) acceleration: &'a [DVec3],
    pub(crate) angular_acceleration: &'a [DVec3],
    pub(crate) radius: &'a [f64],
    pub(crate) species: &'a [u32],
    pub(crate) number: &'a [u32],
    /// Time since memories were advanced, s.
    pub(crate) elapsed: f64,
    /// Number of the last accepted step.
    pub(crate) stamp: u32,
}

/// What a contact needs to know of a particle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Grain {
    pub(crate) position: DVec3,
    pub(crate) velocity: DVec3,
    pub(crate) spin: DVec3,
    pub(crate) acceleration: DVec3,
    pub(crate) angular_acceleration: DVec3,
    pub(crate) radius: f64,
}

/// Two particles that touch.
pub(crate) struct PairContact {
    pub(crate) contact: Contact,
    radii: [f64; 2],
}

impl PairContact {
    /// The contact of two particles that `touch`, `elapsed` seconds after its memory was advanced.
    /// Coincident centres have no normal and feel no force.
    #[inline(always)]
    pub(crate) fn new(first: &Grain, second: &Grain, touch: &Touch, elapsed: f64) -> Self {
        let normal = (first.position - second.position) * touch.inverse;
        let turning = first.spin * first.radius + second.spin * second.radius;
        let velocity = first.velocity - second.velocity - turning.cross(normal);
        let turning =
            first.angular_acceleration * first.radius + second.angular_acceleration * second.radius;
        let acceleration = first.acceleration - second.acceleration - turning.cross(normal);
        Self {
            contact: Contact {
                normal,
                overlap: first.radius + second.radius - touch.distance,
                velocity,
                velocity_ahead: velocity,
                fall: 0.0,
                acceleration,
                spins: [first.spin, second.spin],
                elapsed,
                mobility: DMat3::ZERO,
            },
            radii: [first.radius, second.radius],
        }
    }

    /// Force on the first body, and torques on the first and on the second.
    #[inline(always)]
    pub(crate) fn resolve(&self, answer: &ContactForce) -> (DVec3, DVec3, DVec3) {
        let normal = self.contact.normal;
        let force = normal * answer.normal + answer.tangential;
        let turn = answer.tangential.cross(normal);
        let first = turn * self.radii[0] + answer.couple;
        let second = turn * self.radii[1] - answer.couple;
        (force, first, second)
    }
}

/// The contact of a particle with a wall that stands to it as `wall`, in a container of a velocity
/// and an acceleration.
#[inline(always)]
pub(crate) fn wall_contact(
    grain: &Grain,
    wall: &WallPoint,
    container: [DVec3; 2],
    elapsed: f64,
) -> Contact {
    let turning = grain.spin * grain.radius;
    let velocity = grain.velocity - container[0] - turning.cross(wall.normal);
    let turning = grain.angular_acceleration * grain.radius;
    let acceleration = grain.acceleration - container[1] - turning.cross(wall.normal);
    Contact {
        normal: wall.normal,
        overlap: grain.radius - wall.distance,
        velocity,
        velocity_ahead: velocity,
        fall: 0.0,
        acceleration,
        spins: [grain.spin, DVec3::ZERO],
        elapsed,
        mobility: DMat3::ZERO,
    }
}

impl<C> Room<C> {
    /// The slots among `slots` whose particles are in this room.
    pub(crate) fn slots_in(&self, slots: &Range<usize>) -> Range<usize> {
        let start = self.slots.start.clamp(slots.start, slots.end);
        start..self.slots.end.clamp(start, slots.end)
    }

    /// Velocity of the container, and its mean acceleration since the start of the step.
    #[inline(always)]
    pub(crate) fn moving(&self, elapsed: f64) -> [DVec3; 2] {
        let velocity = self.motion.velocity;
        let gain = velocity - self.start_velocity;
        let rate = if elapsed > 0.0 { 1.0 / elapsed } else { 0.0 };
        [velocity, gain * rate]
    }
}

impl<C: Cavity, L: ContactLaw> Scene<'_, C, L> {
    /// The particle in a slot.
    #[inline(always)]
    pub(crate) fn grain(&self, slot: usize) -> Grain {
        Grain {
            position: self.position[slot],
            velocity: self.velocity[slot],
            spin: self.spin[slot],
            acceleration: self.acceleration[slot],
            angular_acceleration: self.angular_acceleration[slot],
            radius: self.radius[slot],
        }
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
