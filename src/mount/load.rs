use glam::DVec3;

/// What the particles of a cavity do to its container: force and torque, fixed frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Load {
    /// Force in N.
    pub force: DVec3,
    /// Torque about the container's origin in N m.
    pub torque: DVec3,
}

impl Load {
    /// A force (N), and a torque about the container's origin (N m).
    #[must_use]
    pub const fn new(force: DVec3, torque: DVec3) -> Self {
        Self { force, torque }
    }

    /// The torque (N m) about a point that lies at `offset` (m) from the container's origin.
    #[must_use]
    pub fn torque_about(&self, offset: DVec3) -> DVec3 {
        self.torque - offset.cross(self.force)
    }

    /// Number `axis` of the six unit loads: forces along the axes, then torques about them.
    pub(crate) fn unit(axis: usize) -> Self {
        if axis < 3 {
            Self::new(DVec3::AXES[axis], DVec3::ZERO)
        } else {
            Self::new(DVec3::ZERO, DVec3::AXES[axis - 3])
        }
    }
}
