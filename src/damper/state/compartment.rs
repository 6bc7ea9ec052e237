//! The compartments of the bed: a cavity each, with the particles in it and the container around it.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::ops::Range;

use glam::{DMat3, DVec3};

use super::Space;
use crate::cavity::{Cavity, WallPoint};
use crate::contact::WallLoad;
use crate::mount::{Load, Mobility, Motion};
use crate::rotation::exp;

/// The particles in a cavity, and the container around it.
#[derive(Debug, Clone)]
pub(crate) struct Compartment {
    /// Indices of its particles.
    pub(crate) indices: Range<usize>,
    /// Number of its first wall among the walls of all cavities.
    pub(crate) first_wall: u32,
    /// How many walls it has.
    pub(crate) walls: u32,
    /// The lower and the upper corner of its bounding box, container's frame, m.
    pub(crate) bounds: [DVec3; 2],
    /// Whether it is flat: everything stays in the plane z = 0.
    pub(crate) planar: bool,
    /// How thin its thinnest obstacle is, m.
    pub(crate) thickness: f64,
    /// Where its container is, and how it moves.
    pub(crate) motion: Motion,
    /// The container's orientation as a matrix.
    rotation: DMat3,
    /// Whether the container stands turned, turns, or is turned by what the particles do.
    pub(crate) turned: bool,
    /// What impulses on the container do to it.
    mobility: Mobility,
    /// Whether they turn it.
    yields_turning: bool,
    /// The point that the torques on the walls are about: where the container's origin was when they were
    /// worked out, m.
    pub(crate) torque_origin: DVec3,
    /// How much farther than the law's reach candidates are listed, m: they can be trusted while no
    /// particle has moved by half of it.
    pub(crate) margin: f64,
}

impl Compartment {
    /// The particles at `indices` in `cavity`, whose first wall is the one of that number. Its container
    /// is at the origin.
    pub(crate) fn new<C: Cavity>(
        cavity: &C,
        indices: Range<usize>,
        first_wall: u32,
        margin: f64,
    ) -> Self {
        Self {
            indices,
            first_wall,
            walls: cavity.walls(),
            bounds: cavity.bounds(),
            planar: cavity.is_planar(),
            thickness: cavity.thickness(),
            motion: Motion::default(),
            rotation: DMat3::IDENTITY,
            turned: false,
            mobility: Mobility::ZERO,
            yields_turning: false,
            torque_origin: DVec3::ZERO,
            margin,
        }
    }

    /// What the particles do to the container, from the loads on the walls of all cavities.
    pub(crate) fn load(&self, walls: &[WallLoad]) -> Load {
        let first = self.first_wall as usize;
        let own = &walls[first..first + self.walls as usize];
        let force: DVec3 = own.iter().map(|wall| wall.force).sum();
        let torque: DVec3 = own.iter().map(|wall| wall.torque).sum();
        let arm = self.torque_origin - self.motion.position;
        Load::new(force, torque + arm.cross(force))
    }

    /// How one of the walls of `cavity`, which is its own, stands to a point of the fixed frame.
    #[inline(always)]
    pub(crate) fn wall<C: Cavity>(&self, cavity: &C, wall: u32, position: DVec3) -> WallPoint {
        let number = wall - self.first_wall;
        if self.turned {
            let point = cavity.wall(number, self.to_local(position));
            WallPoint {
                normal: self.rotation * point.normal,
                distance: point.distance,
            }
        } else {
            cavity.wall(number, position - self.motion.position)
        }
    }

    /// The greatest velocity that the container gains anywhere per unit impulse, from above, 1/kg.
    pub(crate) fn greatest_inverse_mass(&self) -> f64 {
        self.mobility.greatest(self.reach())
    }

    /// The distance of the farthest point of the cavity from the container's origin, from above, m.
    pub(crate) fn reach(&self) -> f64 {
        let [low, high] = self.bounds;
        low.abs().max(high.abs()).length()
    }

    /// Takes what impulses on the container do to it.
    pub(crate) fn set_mobility(&mut self, mobility: &Mobility) {
        self.mobility = *mobility;
        self.yields_turning = mobility.turns();
    }

    /// Moves the container.
    pub(crate) fn place(&mut self, motion: Motion) {
        self.motion = motion;
        self.turned = !motion.is_translation() || self.yields_turning;
        if self.turned {
            self.rotation = DMat3::from_quat(motion.orientation);
        }
    }

    /// Moves the container to where it will be in `time` (s) if it goes on as it does.
    pub(crate) fn advance(&mut self, time: f64) {
        self.motion.position += self.motion.velocity * time;
        if self.turned {
            let turn = exp(self.motion.angular_velocity * time);
            self.motion.orientation = turn * self.motion.orientation;
            self.rotation = DMat3::from_quat(self.motion.orientation);
        }
    }

    /// Where a point of the fixed frame is in the container's.
    #[inline(always)]
    pub(crate) fn to_local(&self, position: DVec3) -> DVec3 {
        let arm = position - self.motion.position;
        if self.turned {
            let DMat3 {
                x_axis,
                y_axis,
                z_axis,
            } = self.rotation;
            DVec3::new(x_axis.dot(arm), y_axis.dot(arm), z_axis.dot(arm))
        } else {
            arm
        }
    }

    /// Where a point of the container is in the fixed frame.
    pub(crate) fn to_fixed(&self, point: DVec3) -> DVec3 {
        if self.turned {
            self.rotation * point + self.motion.position
        } else {
            point + self.motion.position
        }
    }

    /// How `velocity` is seen from the container at a point of the fixed frame, m/s.
    #[inline(always)]
    pub(crate) fn relative(&self, point: impl Fn() -> DVec3, velocity: DVec3) -> DVec3 {
        let relative = velocity - self.motion.velocity;
        if self.turned {
            let turning = self.motion.angular_velocity;
            relative - turning.cross(point() - self.motion.position)
        } else {
            relative
        }
    }

    /// How `acceleration` (m/s^2) of a body that moves with `velocity` at a point is seen from the container,
    /// as far as its rotation goes.
    #[inline(always)]
    pub(crate) fn relative_acceleration(
        &self,
        position: DVec3,
        velocity: DVec3,
        acceleration: DVec3,
    ) -> DVec3 {
        if self.turned {
            let turning = self.motion.angular_velocity;
            let inwards = turning.cross(turning.cross(position - self.motion.position));
            let relative = self.relative(|| position, velocity);
            acceleration - inwards - turning.cross(relative) * 2.0
        } else {
            acceleration
        }
    }

    /// Velocity along `normal` that the wall gains per unit impulse along it at a point, 1/kg.
    #[inline(always)]
    pub(crate) fn inverse_mass_along<S: Space>(
        &self,
        normal: DVec3,
        point: impl Fn() -> DVec3,
    ) -> f64 {
        if self.turned {
            self.mobility.along(normal, point() - self.motion.position)
        } else {
            let normal = S::vector(normal);
            S::dot(normal, S::transform(&self.mobility.linear, normal))
        }
    }

    /// The indices among `indices` whose particles are in this compartment.
    pub(crate) fn indices_in(&self, indices: &Range<usize>) -> Range<usize> {
        let start = self.indices.start.clamp(indices.start, indices.end);
        start..self.indices.end.clamp(start, indices.end)
    }
}
