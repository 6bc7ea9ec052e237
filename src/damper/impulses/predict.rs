//! Where contacts are looked for, and the velocities that the step leaves without them.

use super::{ImpulseSolver, SolverBody, SolverStep};
use crate::damper::state::{Space, State};
use crate::mount::Mount;
use crate::numbers::at_least;
use crate::step_error::StepError;

impl<S: Space> ImpulseSolver<S> {
    /// Works out where the particles will be at the prediction, moves the containers there, and gives
    /// everything its free velocity: what it has at the end of the step without contacts.
    ///
    /// Refuses particles that could pass others, or a wall, unseen: two bodies that come closer by less than
    /// the sum of their radii in a step do not miss each other, whatever their restitution.
    pub(super) fn predict(
        &mut self,
        step: &SolverStep,
        state: &mut State,
        mount: &dyn Mount,
    ) -> Result<(), StepError> {
        self.containers.set_free(state, mount, step.time_step);
        let mut fastest = 0.0;
        self.bodies.clear();
        for cavity in 0..state.compartments.len() {
            let (relative, fast) = self.predict_cavity(step, state, cavity);
            if let (true, Some(index)) = (state.contained, fast) {
                return Err(too_fast(state, index, step.time_step));
            }
            fastest = at_least(relative, fastest);
        }
        let ahead = step.parameters.prediction * step.time_step;
        for (compartment, container) in state.compartments.iter_mut().zip(&mut self.containers.each)
        {
            compartment.advance(ahead);
            compartment.torque_origin = compartment.motion.position;
            container.origin = compartment.motion.position;
        }
        // Two bodies approach at twice the speed of the faster one at the most, and a wall at what its
        // container gains besides.
        let speed_gains = self
            .containers
            .each
            .iter()
            .map(|container| container.speed_gain);
        let speed_gain = speed_gains.fold(0.0, f64::max) + self.swept_gain(step, state, fastest);
        self.prediction_distance = ahead * (2.0 * fastest + speed_gain);
        Ok(())
    }

    /// The speed (m/s) that a free particle of up to `fastest` (m/s) gains on any wall over the step because
    /// containers turn, from above.
    fn swept_gain(&self, step: &SolverStep, state: &State, fastest: f64) -> f64 {
        let compartments = state.compartments.iter();
        let gains = compartments.zip(&self.containers.turning);
        gains.fold(0.0, |most, (compartment, turning)| {
            let free = S::spin_in_space(turning.free);
            let (spin, reach) = (free.length(), compartment.reach());
            let turned = spin * (spin * reach + 2.0 * fastest) * step.time_step;
            at_least((free - turning.start).length() * reach + turned, most)
        })
    }

    /// The same for the particles of a cavity. Returns the greatest speed (m/s) relative to the container,
    /// and a particle that moves by more than its radius in the step.
    fn predict_cavity(
        &mut self,
        step: &SolverStep,
        state: &State,
        cavity: usize,
    ) -> (f64, Option<usize>) {
        let compartment = &state.compartments[cavity];
        let indices = compartment.indices.clone();
        let particles = &state.particles;
        let position = &S::rows(particles.position.flat())[indices.clone()];
        let velocity = &S::rows(particles.velocity.flat())[indices.clone()];
        let spin = &S::spin_rows(particles.spin.flat())[indices.clone()];
        let radius = &particles.radius[indices.clone()];
        let inverse_mass = &particles.inverse_mass[indices.clone()];
        let predicted = &mut S::rows_mut(self.predicted.flat_mut())[indices.clone()];
        let container = S::vector(compartment.motion.velocity);
        let gain = S::vector(state.gravity * step.time_step);
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
        self.bodies.extend(all.map(
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
        if compartment.turned {
            return fastest_on_turning(state, cavity, step.time_step);
        }
        (fastest.sqrt(), too_fast)
    }
}

/// The greatest speed (m/s) relative to a container that is turned, and a particle that moves by more than its
/// radius in the step.
fn fastest_on_turning(state: &State, cavity: usize, time_step: f64) -> (f64, Option<usize>) {
    let compartment = &state.compartments[cavity];
    let particles = &state.particles;
    let (mut fastest, mut too_fast) = (0.0, None);
    for index in compartment.indices.clone() {
        let position = || particles.position.get(index);
        let relative = compartment.relative(position, particles.velocity.get(index));
        let speed = relative.length();
        fastest = at_least(speed, fastest);
        if speed * time_step > particles.radius[index] {
            too_fast = Some(index);
        }
    }
    (fastest, too_fast)
}

fn too_fast(state: &State, index: usize, time_step: f64) -> StepError {
    let compartment = &state.compartments[state.cavity_of(index)];
    let position = || state.particles.position.get(index);
    let relative = compartment.relative(position, state.particles.velocity.get(index));
    StepError::TooFast {
        particle: state.particles.id[index] as usize,
        speed: relative.length(),
        time_step,
        limit: state.particles.radius[index] / time_step,
        cause: state.cause(),
    }
}
