//! Contacts and motions as a ledger keeps them over a step.

use glam::DVec3;

use crate::contact::Partner;
use crate::mount::Motion;
use crate::observer::{ContactEvent, StepReport};
use crate::particle::Particle;

/// A contact with its forces.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch {
    pub(super) particle: usize,
    pub(super) partner: Partner,
    pub(super) cavity: usize,
    pub(super) normal: DVec3,
    pub(super) force: f64,
    /// What the normal force has besides its elastic part, N.
    pub(super) damping: f64,
    pub(super) tangential: DVec3,
    pub(super) couple: DVec3,
    pub(super) working_velocity: DVec3,
    pub(super) working_spin: DVec3,
}

impl Touch {
    pub(super) fn new(event: &ContactEvent) -> Self {
        Self {
            particle: event.particle,
            partner: event.partner,
            cavity: event.cavity,
            normal: event.contact.normal,
            force: event.force.normal,
            damping: event.force.normal - event.stored.normal_force,
            tangential: event.force.tangential,
            couple: event.force.couple,
            working_velocity: event.working_velocity,
            working_spin: event.working_spin,
        }
    }

    /// Powers in W taken along the normal and across it at a relative velocity and spin.
    pub(super) fn powers(&self, velocity: DVec3, spin: DVec3) -> [f64; 2] {
        [
            -self.force * self.normal.dot(velocity),
            -self.tangential.dot(velocity) - self.couple.dot(spin),
        ]
    }
}

/// Place of a pair and of a contact with a wall among sums of the two.
pub(super) const fn class(partner: Partner) -> usize {
    match partner {
        Partner::Particle(_) => 0,
        Partner::Wall(_) => 1,
    }
}

/// How everything moves: at the end of a step, or on the mean over it.
#[derive(Debug, Clone, Default)]
pub(super) struct Pace {
    pub(super) particles: Vec<Particle>,
    pub(super) containers: Vec<Motion>,
}

impl Pace {
    pub(super) fn read(&mut self, report: &StepReport<'_>) {
        self.particles.clear();
        self.particles.extend(report.particles());
        self.containers.clear();
        let containers = (0..report.cavities()).map_while(|cavity| report.container(cavity));
        self.containers.extend(containers);
    }

    /// Becomes the mean of itself and `other`.
    pub(super) fn average(&mut self, other: &Self) {
        for (own, other) in self.particles.iter_mut().zip(&other.particles) {
            own.position = 0.5 * (own.position + other.position);
            own.velocity = 0.5 * (own.velocity + other.velocity);
            own.spin = 0.5 * (own.spin + other.spin);
        }
        for (own, other) in self.containers.iter_mut().zip(&other.containers) {
            own.position = 0.5 * (own.position + other.position);
            own.velocity = 0.5 * (own.velocity + other.velocity);
            own.angular_velocity = 0.5 * (own.angular_velocity + other.angular_velocity);
        }
    }

    /// Velocity of the first body's surface relative to the second's, and relative spin.
    pub(super) fn of(&self, touch: &Touch) -> [DVec3; 2] {
        let first = &self.particles[touch.particle];
        let turning = first.spin * first.radius;
        let (second, turning, spin) = match touch.partner {
            Partner::Particle(other) => {
                let other = &self.particles[other];
                let turning = turning + other.spin * other.radius;
                (other.velocity, turning, first.spin - other.spin)
            }
            Partner::Wall(_) => {
                let container = &self.containers[touch.cavity];
                let point = first.position - touch.normal * first.radius;
                let spin = first.spin - container.angular_velocity;
                (container.velocity_at(point), turning, spin)
            }
        };
        let surface = first.velocity - second - turning.cross(touch.normal);
        [surface, spin]
    }
}
