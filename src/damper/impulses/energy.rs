//! The accelerations that hold over the step, and the bound on energy: the impulses of a step never leave
//! more than the free velocities had.

use super::constraint::{ContactConstraint, TURNING};
use super::prepare::ConstraintInfo;
use super::{ImpulseSolver, SolverStep};
use crate::damper::state::{Space, State};
use crate::numbers::{at_least, at_most};

impl<S: Space> ImpulseSolver<S> {
    /// Sets the accelerations that lead to the velocities after the impulses. Returns how the kinetic energy
    /// (J) that impulses add, relative to the containers as they move freely, grows with a part of them: in
    /// proportion, and with the square.
    pub(super) fn accelerate(&self, step: &SolverStep, state: &mut State) -> [f64; 2] {
        let rate = 1.0 / step.time_step;
        let gravity = S::vector(state.gravity);
        let free_gain = S::vector(state.gravity * step.time_step);
        let (mut slope, mut curvature) = (0.0, 0.0);
        let particles = &mut state.particles;
        for (compartment, container) in state.compartments.iter().zip(&self.containers.each) {
            let indices = compartment.indices.clone();
            let velocity = &S::rows(particles.velocity.flat())[indices.clone()];
            let spin = &S::spin_rows(particles.spin.flat())[indices.clone()];
            let radius = &particles.radius[indices.clone()];
            let acceleration = &mut S::rows_mut(particles.acceleration.flat_mut())[indices.clone()];
            let turning =
                &mut S::spin_rows_mut(particles.angular_acceleration.flat_mut())[indices.clone()];
            let before = velocity.iter().zip(spin).zip(radius);
            let after = acceleration.iter_mut().zip(turning);
            let bodies = self.bodies[indices].iter();
            for ((body, ((velocity, spin), &radius)), (acceleration, turning)) in
                bodies.zip(before).zip(after)
            {
                let free = S::from_row(*velocity) + free_gain;
                let spin = S::from_spin_row(*spin) * radius;
                let (gain, turn) = (body.velocity - free, body.spin - spin);
                *acceleration = S::row(gravity + gain * rate);
                *turning = S::spin_row(turn * (rate / radius));
                let mass = 1.0 / body.inverse_mass;
                let [linear, turned] =
                    [S::dot(gain, free - container.free), S::spin_dot(turn, spin)];
                slope += mass * (linear + turned * (1.0 / TURNING));
                let [linear, turned] = [S::dot(gain, gain), S::spin_dot(turn, turn)];
                curvature += mass * (linear + turned * (1.0 / TURNING));
            }
        }
        for constraint in &self.constraints[self.pairs..] {
            let container = &self.containers.each[constraint.bodies[1] as usize];
            let impulse = constraint.so_far().impulse;
            curvature -= S::dot(impulse, container.velocity - container.free);
        }
        if self.turns() {
            let [proportional, square] = self.work_of_rotation();
            slope -= proportional;
            curvature -= square;
        }
        [slope, 0.5 * curvature]
    }

    /// Makes all impulses of the step smaller by one factor, so that they add no more kinetic energy than
    /// position correction needs; `growth` is as [`accelerate`](Self::accelerate) returned it.
    #[cold]
    pub(super) fn bound_energy(&mut self, step: &SolverStep, state: &mut State, growth: [f64; 2]) {
        let [slope, curvature] = growth;
        let all = self.constraints.iter().zip(&self.infos);
        let allowed: f64 = all.map(|(own, info)| correction_work(own, info)).sum();
        if slope + curvature <= allowed {
            return;
        }
        // Where slope x + curvature x^2 is what is allowed.
        let half = -0.5 * slope / curvature;
        let factor = half + (half * half + allowed / curvature).sqrt();
        let factor = factor.clamp(0.0, 1.0);

        let gravity = state.gravity;
        let particles = &mut state.particles;
        for index in 0..particles.len() {
            let gain = particles.acceleration.get(index) - gravity;
            particles.acceleration.set(index, gravity + gain * factor);
            let turning = particles.angular_acceleration.get(index);
            particles.angular_acceleration.set(index, turning * factor);
        }
        let (velocity, spin) = (particles.velocity.rows(), particles.spin.rows());
        for (index, body) in self.bodies.iter_mut().enumerate() {
            let free = S::vector(velocity.get(index) + gravity * step.time_step);
            let turning = S::spin(spin.get(index)) * particles.radius[index];
            body.velocity = free + (body.velocity - free) * factor;
            body.spin = turning + (body.spin - turning) * factor;
        }
        for container in &mut self.containers.each {
            let free = container.free;
            container.velocity = free + (container.velocity - free) * factor;
        }
        for turning in &mut self.containers.turning {
            let free = turning.free;
            turning.spin = free + (turning.spin - free) * factor;
        }
        for constraint in &mut self.constraints {
            constraint.impulse *= factor;
            constraint.tangential = constraint.tangential * factor;
        }
        for rolling in &mut self.rolling {
            rolling.impulse = rolling.impulse * factor;
        }
    }
}

/// The most energy (J) that position correction may add through a contact: the work of its impulse while
/// the bodies go from rest to a speed no greater than they would fall with.
fn correction_work<S: Space>(constraint: &ContactConstraint<S>, info: &ConstraintInfo) -> f64 {
    if info.rests {
        0.5 * constraint.impulse * at_most(at_least(constraint.target, 0.0), info.speed_gain)
    } else {
        0.0
    }
}
