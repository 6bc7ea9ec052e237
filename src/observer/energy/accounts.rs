//! What an account of energy is made of.

/// Energies at an instant, in J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Energies {
    /// Kinetic energy of the mount.
    pub mount: f64,
    /// Potential energy of the mount's springs.
    pub spring: f64,
    /// Kinetic energy of the particles' centres.
    pub translation: f64,
    /// Kinetic energy of the particles' spin.
    pub spin: f64,
    /// Potential energy of the particles in gravity, zero at the origin of the fixed frame.
    pub gravity: f64,
    /// Elastic energy in contacts.
    pub contacts: f64,
}

impl Energies {
    /// Their sum in J.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.mount + self.spring + self.translation + self.spin + self.gravity + self.contacts
    }
}

/// Energies lost in contacts, in J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Losses {
    /// Normal damping between particles.
    pub pair_normal: f64,
    /// Friction between particles, rolling resistance and tangential damping included.
    pub pair_friction: f64,
    /// Normal damping at walls.
    pub wall_normal: f64,
    /// Friction at walls, rolling resistance and tangential damping included.
    pub wall_friction: f64,
}

impl Losses {
    /// Their sum in J.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.pair_normal + self.pair_friction + self.wall_normal + self.wall_friction
    }

    /// Adds energies by class, each along the normal and across it.
    pub(super) fn add(&mut self, energies: &[[f64; 2]; 2]) {
        let [[pair_normal, pair_friction], [wall_normal, wall_friction]] = energies;
        self.pair_normal += pair_normal;
        self.pair_friction += pair_friction;
        self.wall_normal += wall_normal;
        self.wall_friction += wall_friction;
    }
}
