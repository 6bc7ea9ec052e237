//! What observers are told of a step's impulses.

use glam::DVec3;

use super::{Stages, Step};
use crate::cavity::Cavity;
use crate::contact::{Contact, Stored};
use crate::damper::Partner;
use crate::damper::engine::Engine;
use crate::damper::scene::at_surface;
use crate::damper::space::Space;
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
        step: &Step,
        stages: &Stages<S>,
        observer: &mut O,
    ) {
        for number in 0..stages.constraints.len() {
            if stages.constraints[number].impulse > 0.0 {
                observer.contact(&self.event(step, stages, number));
            }
        }
    }

    fn event<S: Space>(&self, step: &Step, stages: &Stages<S>, number: usize) -> ContactEvent {
        let particles = &self.particles;
        let constraint = &stages.constraints[number];
        let [slot, other] = constraint.bodies.map(|body| body as usize);
        let motions = |slot: usize| -> Motions {
            let body = &stages.bodies[slot];
            let spin = S::spin_in_space(body.spin) / particles.radius[slot];
            let before = (particles.velocity.get(slot), particles.spin.get(slot));
            [before, (S::in_space(body.velocity), spin)]
        };
        let (cavity, partner, radii, others);
        if number < stages.pairs {
            cavity = self.world.cavity_of(slot);
            partner = Partner::Particle(particles.number[other] as usize);
            radii = [particles.radius[slot], particles.radius[other]];
            others = motions(other);
        } else {
            cavity = other;
            let room = &self.world.rooms[cavity];
            partner = Partner::Wall(stages.marks[number].wall - room.first_wall);
            radii = [particles.radius[slot], 0.0];
            let after = S::in_space(stages.containers.each[cavity].velocity);
            others = [room.motion.velocity, after].map(|velocity| (velocity, DVec3::ZERO));
        }
        let normal = S::in_space(constraint.normal);
        let levers = radii.map(|radius| constraint.lever * radius);
        let own = motions(slot);
        let [velocity, left] = [0, 1].map(|end| {
            let spins = [own[end].1, others[end].1];
            at_surface::<false>(normal, own[end].0 - others[end].0, spins, levers)
        });
        let [spin, spin_left] = [0, 1].map(|end| own[end].1 - others[end].1);
        let overlap = (1.0 - constraint.lever) * (radii[0] + radii[1]);
        let mut contact = Contact::new(normal, overlap, velocity);
        contact.spins = [own[0].1, others[0].1];
        contact.elapsed = step.time_step;
        ContactEvent {
            particle: particles.number[slot] as usize,
            partner,
            cavity,
            contact,
            force: stages.force(number, step.time_step),
            stored: Stored::default(),
            working_velocity: 0.5 * (velocity + left),
            working_spin: 0.5 * (spin + spin_left),
        }
    }
}
