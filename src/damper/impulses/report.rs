//! What observers are told of a step's impulses.

use glam::DVec3;

use super::{ImpulseSolver, SolverStep};
use crate::contact::{Contact, Partner, Stored};
use crate::damper::state::{Space, State, Volume, surface_velocity};
use crate::observer::{ContactEvent, Observer};

/// How a body moves at the beginning and at the end of the step: velocity and spin.
type Motions = [(DVec3, DVec3); 2];

impl<S: Space> ImpulseSolver<S> {
    /// Tells `observer` of every contact that was given an impulse.
    pub(super) fn report(&self, step: &SolverStep, state: &State, observer: &mut dyn Observer) {
        for number in 0..self.constraints.len() {
            if self.constraints[number].impulse > 0.0 {
                observer.contact(&self.event(step, state, number));
            }
        }
    }

    fn event(&self, step: &SolverStep, state: &State, number: usize) -> ContactEvent {
        let particles = &state.particles;
        let constraint = &self.constraints[number];
        let [index, other] = constraint.bodies.map(|body| body as usize);
        let motions = |index: usize| -> Motions {
            let body = &self.bodies[index];
            let spin = S::spin_in_space(body.spin) / particles.radius[index];
            let before = (particles.velocity.get(index), particles.spin.get(index));
            [before, (S::in_space(body.velocity), spin)]
        };
        let (cavity, partner, radii, others);
        if number < self.pairs {
            cavity = state.cavity_of(index);
            partner = Partner::Particle(particles.id[other] as usize);
            radii = [particles.radius[index], particles.radius[other]];
            others = motions(other);
        } else {
            cavity = other;
            let compartment = &state.compartments[cavity];
            partner = Partner::Wall(self.infos[number].wall - compartment.first_wall);
            radii = [particles.radius[index], 0.0];
            let after = S::in_space(self.containers.each[cavity].velocity);
            let mut spins = [DVec3::ZERO; 2];
            let mut arm = DVec3::ZERO;
            if let Some(turning) = self.containers.turning.get(cavity) {
                spins = [turning.start, S::spin_in_space(turning.spin)];
                arm = S::in_space(self.arms[number - self.pairs]);
            }
            let velocities = [compartment.motion.velocity, after];
            others = [0, 1].map(|end| (velocities[end] + spins[end].cross(arm), spins[end]));
        }
        let normal = S::in_space(constraint.normal);
        let levers = radii.map(|radius| constraint.lever * radius);
        let own = motions(index);
        let [velocity, left] = [0, 1].map(|end| {
            let spins = [own[end].1, others[end].1];
            surface_velocity::<Volume>(normal, own[end].0 - others[end].0, spins, levers)
        });
        let [spin, spin_left] = [0, 1].map(|end| own[end].1 - others[end].1);
        let overlap = (1.0 - constraint.lever) * (radii[0] + radii[1]);
        let overlap = step.at_start(overlap, -velocity.dot(normal));
        let mut contact = Contact::new(normal, overlap, velocity);
        contact.spins = [own[0].1, others[0].1];
        contact.elapsed = step.time_step;
        ContactEvent {
            particle: particles.id[index] as usize,
            partner,
            cavity,
            contact,
            force: self.force(number, step.time_step),
            stored: Stored::default(),
            working_velocity: 0.5 * (velocity + left),
            working_spin: 0.5 * (spin + spin_left),
        }
    }
}
