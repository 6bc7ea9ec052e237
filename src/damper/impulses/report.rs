//! What observers are told of a step's impulses.

use glam::DVec3;

use super::{ImpulseSolver, SolverStep};
use crate::cavity::Cavity;
use crate::contact::{Contact, Partner, Stored};
use crate::damper::engine::Engine;
use crate::damper::state::{Space, surface_velocity};
use crate::detector::Detector;
use crate::law::ContactLaw;
use crate::mount::Mount;
use crate::observer::{ContactEvent, Observer};

/// How a body moves at the beginning and at the end of the step: velocity and spin.
type Motions = [(DVec3, DVec3); 2];

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Tells `observer` of every contact that was given an impulse.
    pub(super) fn report<S: Space, O: Observer>(
        &self,
        step: &SolverStep,
        solver: &ImpulseSolver<S>,
        observer: &mut O,
    ) {
        for number in 0..solver.constraints.len() {
            if solver.constraints[number].impulse > 0.0 {
                observer.contact(&self.event(step, solver, number));
            }
        }
    }

    fn event<S: Space>(
        &self,
        step: &SolverStep,
        solver: &ImpulseSolver<S>,
        number: usize,
    ) -> ContactEvent {
        let particles = &self.particles;
        let constraint = &solver.constraints[number];
        let [index, other] = constraint.bodies.map(|body| body as usize);
        let motions = |index: usize| -> Motions {
            let body = &solver.bodies[index];
            let spin = S::spin_in_space(body.spin) / particles.radius[index];
            let before = (particles.velocity.get(index), particles.spin.get(index));
            [before, (S::in_space(body.velocity), spin)]
        };
        let (cavity, partner, radii, others);
        if number < solver.pairs {
            cavity = self.model.cavity_of(index);
            partner = Partner::Particle(particles.id[other] as usize);
            radii = [particles.radius[index], particles.radius[other]];
            others = motions(other);
        } else {
            cavity = other;
            let compartment = &self.model.compartments[cavity];
            partner = Partner::Wall(solver.infos[number].wall - compartment.first_wall);
            radii = [particles.radius[index], 0.0];
            let after = S::in_space(solver.containers.each[cavity].velocity);
            others = [compartment.motion.velocity, after].map(|velocity| (velocity, DVec3::ZERO));
        }
        let normal = S::in_space(constraint.normal);
        let levers = radii.map(|radius| constraint.lever * radius);
        let own = motions(index);
        let [velocity, left] = [0, 1].map(|end| {
            let spins = [own[end].1, others[end].1];
            surface_velocity::<false>(normal, own[end].0 - others[end].0, spins, levers)
        });
        let [spin, spin_left] = [0, 1].map(|end| own[end].1 - others[end].1);
        let overlap = (1.0 - constraint.lever) * (radii[0] + radii[1]);
        let mut contact = Contact::new(normal, overlap, velocity);
        contact.spins = [own[0].1, others[0].1];
        contact.elapsed = step.time_step;
        ContactEvent {
            particle: particles.id[index] as usize,
            partner,
            cavity,
            contact,
            force: solver.force(number, step.time_step),
            stored: Stored::default(),
            working_velocity: 0.5 * (velocity + left),
            working_spin: 0.5 * (spin + spin_left),
        }
    }
}
