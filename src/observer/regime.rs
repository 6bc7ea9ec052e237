use glam::DVec3;

use super::{ContactEvent, Observer, StepReport};
use crate::contact::Partner;

/// The state that a bed is in, as means over the time watched.
///
/// A bed at rest has no flight and next to no temperature; a bed thrown as a whole flies with many
/// contacts; in a gas flight is near one and contacts are near zero.
#[derive(Debug, Clone, Default)]
pub struct BedRegime {
    time: f64,
    contacts: f64,
    in_flight: f64,
    off_walls: f64,
    centroid: DVec3,
    temperature: f64,
    common: f64,
    relative: f64,
    /// Contacts of each particle in this step, and how many of all are with a wall.
    touches: Vec<u32>,
    at_walls: u32,
}

impl BedRegime {
    /// Nothing watched yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    fn mean(&self, sum: f64) -> f64 {
        if self.time > 0.0 {
            sum / self.time
        } else {
            0.0
        }
    }

    /// Mean number of contacts of a particle, walls included.
    #[must_use]
    pub fn contacts(&self) -> f64 {
        self.mean(self.contacts)
    }

    /// Share of the particles that touch nothing, 0 to 1.
    #[must_use]
    pub fn flight(&self) -> f64 {
        self.mean(self.in_flight)
    }

    /// Share of time in which no particle touches a wall, 0 to 1.
    #[must_use]
    pub fn off_walls(&self) -> f64 {
        self.mean(self.off_walls)
    }

    /// Mean centre of mass in m, in the container's frame.
    #[must_use]
    pub fn centroid(&self) -> DVec3 {
        if self.time > 0.0 {
            self.centroid / self.time
        } else {
            DVec3::ZERO
        }
    }

    /// Mean kinetic energy of a particle about the motion of the bed's centre of mass, translation
    /// alone, in J.
    #[must_use]
    pub fn temperature(&self) -> f64 {
        self.mean(self.temperature)
    }

    /// Mean kinetic energy of the bed's centre of mass, a particle's share of it in J: what the particles have
    /// in common, in the fixed frame. With the [temperature](Self::temperature) it is all their energy of
    /// translation.
    #[must_use]
    pub fn common_energy(&self) -> f64 {
        self.mean(self.common)
    }

    /// Mean kinetic energy of a particle by its velocity relative to its container's origin, in J.
    #[must_use]
    pub fn relative_energy(&self) -> f64 {
        self.mean(self.relative)
    }

    fn touch(&mut self, particle: usize) {
        if particle >= self.touches.len() {
            self.touches.resize(particle + 1, 0);
        }
        self.touches[particle] += 1;
    }
}

impl Observer for BedRegime {
    fn wants_contacts(&self) -> bool {
        true
    }

    fn contact(&mut self, event: &ContactEvent) {
        self.touch(event.particle);
        match event.partner {
            Partner::Particle(other) => self.touch(other),
            Partner::Wall(_) => self.at_walls += 1,
        }
    }

    fn step(&mut self, report: &StepReport<'_>) {
        if report.is_empty() {
            return;
        }
        let (dt, count) = (report.time_step(), report.len() as f64);
        let touching = self.touches.iter().filter(|touches| **touches > 0).count() as f64;
        let contacts: u32 = self.touches.iter().sum();
        self.time += dt;
        self.contacts += dt * f64::from(contacts) / count;
        self.in_flight += dt * (1.0 - touching / count);
        self.off_walls += dt * f64::from(self.at_walls == 0);
        let (mut mass, mut place, mut momentum, mut energy) = (0.0, DVec3::ZERO, DVec3::ZERO, 0.0);
        let mut relative = 0.0;
        for particle in report.particles() {
            let origin = report
                .container(particle.cavity as usize)
                .unwrap_or_default();
            mass += particle.mass;
            place += particle.mass * origin.to_local(particle.position);
            momentum += particle.mass * particle.velocity;
            energy += 0.5 * particle.mass * particle.velocity.length_squared();
            let velocity = particle.velocity - origin.velocity;
            relative += 0.5 * particle.mass * velocity.length_squared();
        }
        self.centroid += dt * place / mass;
        let common = 0.5 * momentum.length_squared() / mass;
        self.temperature += dt * (energy - common) / count;
        self.common += dt * common / count;
        self.relative += dt * relative / count;
        self.touches.fill(0);
        self.at_walls = 0;
    }
}
