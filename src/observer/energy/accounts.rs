//! What an account of energy is made of.

use glam::DVec3;

use crate::particle::Particle;

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
    /// Adds those of a particle under gravity (m/s^2).
    pub(crate) fn add_particle(&mut self, particle: &Particle, gravity: DVec3) {
        self.translation += 0.5 * particle.mass * particle.velocity.length_squared();
        self.spin += 0.5 * particle.inertia() * particle.spin.length_squared();
        self.gravity -= particle.mass * gravity.dot(particle.position);
    }

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

    pub(super) const NONE: Self = Self {
        pair_normal: 0.0,
        pair_friction: 0.0,
        wall_normal: 0.0,
        wall_friction: 0.0,
    };

    /// Adds energies by class, each along the normal and across it.
    pub(super) fn add(&mut self, energies: &[[f64; 2]; 2]) {
        let [[pair_normal, pair_friction], [wall_normal, wall_friction]] = energies;
        self.pair_normal += pair_normal;
        self.pair_friction += pair_friction;
        self.wall_normal += wall_normal;
        self.wall_friction += wall_friction;
    }
}

/// An account of energy over some time: input = change of energies + structure loss + contact losses +
/// residual.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Account {
    /// Energies at its beginning.
    pub opening: Energies,
    /// Energies at its end.
    pub closing: Energies,
    /// Work of the excitation in J; where a mount has no coordinates, of moving its containers.
    pub input: f64,
    /// Energy lost in the damping of the mount, in J.
    pub structure_loss: f64,
    /// Energies lost in contacts.
    pub losses: Losses,
    /// Part of the losses along the normal that the law's damping does not explain, in J.
    pub integration_loss: f64,
}

impl Account {
    /// By how much the energies have grown, in J.
    #[must_use]
    pub fn change(&self) -> f64 {
        self.closing.total() - self.opening.total()
    }

    /// Energy in J that is not accounted for: positive when more was put in than can be found.
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.input - self.change() - self.structure_loss - self.losses.total()
    }
}
