use glam::{DQuat, DVec3};

use crate::rotation::exp;

/// How far the length of an orientation may be off one: single precision leaves 1e-7, and a host that adds up
/// rates without setting the length right leaves an eighth of the square of the angle of a step, 1e-3 at 0.09.
const UNIT: f64 = 1e-3;

/// How a container moves, as a rigid body: where its origin is and how it stands, velocity and angular
/// velocity, all in the fixed frame.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use particle_damper::Motion;
///
/// let lifted = Motion::at(DVec3::Y * 0.1, DVec3::Y * 0.5);
/// let tilted = Motion::at(DVec3::ZERO, DVec3::ZERO).turned(DQuat::from_rotation_x(0.3), DVec3::ZERO);
/// // In the plane: by 0.3 rad about z, at 2 rad/s.
/// let swinging = Motion::at(DVec3::ZERO, DVec3::ZERO).turned_in_plane(0.3, 2.0);
/// assert_eq!(swinging.velocity_at(DVec3::X), DVec3::Y * 2.0);
/// # let _ = (lifted, tilted);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Motion {
    /// Position of the container's origin in m.
    pub position: DVec3,
    /// Velocity of the container's origin in m/s.
    pub velocity: DVec3,
    /// Unit quaternion that takes directions of the container's frame to the fixed frame. It is normalised
    /// where it is used; one whose length is off by more than a thousandth is refused.
    pub orientation: DQuat,
    /// Angular velocity of the container in rad/s, fixed frame.
    pub angular_velocity: DVec3,
}

impl Motion {
    /// A container at `position` (m) that moves with `velocity` (m/s) and does not turn.
    #[must_use]
    pub const fn at(position: DVec3, velocity: DVec3) -> Self {
        Self {
            position,
            velocity,
            orientation: DQuat::IDENTITY,
            angular_velocity: DVec3::ZERO,
        }
    }

    /// The same, standing at `orientation` and turning with `angular_velocity` (rad/s).
    #[must_use]
    pub const fn turned(self, orientation: DQuat, angular_velocity: DVec3) -> Self {
        Self {
            orientation,
            angular_velocity,
            ..self
        }
    }

    /// The same, turned about z by `angle` (rad) and turning at `rate` (rad/s).
    #[must_use]
    pub fn turned_in_plane(self, angle: f64, rate: f64) -> Self {
        self.turned(exp(DVec3::Z * angle), DVec3::Z * rate)
    }

    /// Where a point of the container (m, container's frame) is in the fixed frame.
    #[must_use]
    pub fn to_fixed(&self, point: DVec3) -> DVec3 {
        self.position + self.orientation * point
    }

    /// Where a point of the fixed frame (m) is in the container's.
    #[must_use]
    pub fn to_local(&self, point: DVec3) -> DVec3 {
        self.orientation.conjugate() * (point - self.position)
    }

    /// Velocity (m/s) of the container at a point of the fixed frame (m).
    #[must_use]
    pub fn velocity_at(&self, point: DVec3) -> DVec3 {
        self.velocity + self.angular_velocity.cross(point - self.position)
    }

    /// Whether all numbers are finite.
    pub(crate) fn is_finite(&self) -> bool {
        self.position.is_finite()
            && self.velocity.is_finite()
            && self.orientation.is_finite()
            && self.angular_velocity.is_finite()
    }

    /// Whether the container neither stands turned nor turns.
    pub(crate) fn is_translation(&self) -> bool {
        self.orientation == DQuat::IDENTITY && self.angular_velocity == DVec3::ZERO
    }

    /// Whether it stays in the plane z = 0.
    pub(crate) fn is_in_plane(&self) -> bool {
        let turning = self.angular_velocity;
        [
            self.position.z,
            self.velocity.z,
            self.orientation.x,
            self.orientation.y,
            turning.x,
            turning.y,
        ]
        .iter()
        .all(|component| *component == 0.0)
    }

    /// The same with its orientation normalised, unless that is none.
    pub(crate) fn normalized(self) -> Option<Self> {
        let length = self.orientation.length();
        ((length - 1.0).abs() <= UNIT).then(|| Self {
            orientation: self.orientation * (1.0 / length),
            ..self
        })
    }
}
