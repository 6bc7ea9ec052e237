use glam::DVec3;

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
    pub(crate) fn add(&mut self, other: &Self) {
        self.force += other.force;
        self.torque += other.torque;
    }
}
