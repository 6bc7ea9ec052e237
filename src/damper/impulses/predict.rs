//! Where contacts are looked for, and the velocities that the step leaves without them.

use super::{ImpulseSolver, SolverBody, SolverStep};
use crate::cavity::Cavity;
use crate::damper::engine::Engine;
use crate::damper::state::Space;
use crate::detector::Detector;
use crate::law::{ContactLaw, at_least};
use crate::mount::Mount;
use crate::step_error::StepError;

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Works out where the particles will be at the prediction, moves the containers there, and gives
    /// everything its free velocity: what it has at the end of the step without contacts.
    ///
    /// Refuses particles that could pass others, or a wall, unseen: two bodies that come closer by less than
    /// the sum of their radii in a step do not miss each other, whatever their restitution.
    pub(super) fn predict<S: Space>(
        &mut self,
        step: &SolverStep,
        solver: &mut ImpulseSolver<S>,
    ) -> Result<(), StepError> {
        self.free_containers(step.time_step, &mut solver.containers);
        let mut fastest = 0.0;
        solver.bodies.clear();
        for cavity in 0..self.model.compartments.len() {
            let (relative, too_fast) = self.predict_cavity(step, solver, cavity);
            if let (true, Some(index)) = (self.contained, too_fast) {
                return Err(self.too_fast(index, step.time_step));
            }
            fastest = at_least(relative, fastest);
        }
        let ahead = step.parameters.prediction * step.time_step;
        for (compartment, container) in self
            .model
            .compartments
            .iter_mut()
            .zip(&mut solver.containers.each)
        {
            compartment.motion.position += compartment.motion.velocity * ahead;
            container.origin = compartment.motion.position;
        }
        // Two bodies approach at twice the speed of the faster one at the most, and a wall at what its
        // container gains besides.
        let speed_gains = solver
            .containers
            .each
            .iter()
            .map(|container| container.speed_gain);
        solver.prediction_distance = ahead * (2.0 * fastest + speed_gains.fold(0.0, f64::max));
        Ok(())
    }

    /// The same for the particles of a cavity. Returns the greatest speed (m/s) relative to the container,
    /// and a particle that moves by more than its radius in the step.
    fn predict_cavity<S: Space>(
        &self,
        step: &SolverStep,
        solver: &mut ImpulseSolver<S>,
        cavity: usize,
    ) -> (f64, Option<usize>) {
        let compartment = &self.model.compartments[cavity];
        let indices = compartment.indices.clone();
        let particles = &self.particles;
        let position = &S::rows(particles.position.flat())[indices.clone()];
        let velocity = &S::rows(particles.velocity.flat())[indices.clone()];
        let spin = &S::spin_rows(particles.spin.flat())[indices.clone()];
        let radius = &particles.radius[indices.clone()];
        let inverse_mass = &particles.inverse_mass[indices.clone()];
        let predicted = &mut S::rows_mut(solver.predicted.flat_mut())[indices.clone()];
        let container = S::vector(compartment.motion.velocity);
        let gain = S::vector(self.gravity * step.time_step);
        let ahead = step.parameters.prediction * step.time_step;
        let rate = 1.0 / (step.time_step * step.time_step);
        let (mut fastest, mut too_fast) = (0.0, None);
        let all = position
            .iter()
            .zip(velocity)
            .zip(spin)
            .zip(radius)
            .zip(inverse_mass);
        let all = all.zip(predicted).enumerate();
        solver.bodies.extend(all.map(
            |(n, (((((position, velocity), spin), &radius), &inverse_mass), predicted))| {
                let velocity = S::from_row(*velocity);
                *predicted = S::row(S::from_row(*position) + velocity * ahead);
                let relative = velocity - container;
                let square = S::dot(relative, relative);
                fastest = at_least(square, fastest);
                if square > radius * radius * rate {
                    too_fast = Some(indices.start + n);
                }
                SolverBody {
                    velocity: velocity + gain,
                    spin: S::from_spin_row(*spin) * radius,
                    inverse_mass,
                }
            },
        ));
        (fastest.sqrt(), too_fast)
    }

    fn too_fast(&self, index: usize, time_step: f64) -> StepError {
        let container = self.model.compartments[self.model.cavity_of(index)].motion;
        let relative = self.particles.velocity.get(index) - container.velocity;
        StepError::TooFast {
            particle: self.particles.id[index] as usize,
            speed: relative.length(),
            time_step,
            limit: self.particles.radius[index] / time_step,
            cause: self.cause(),
        }
    }
}
