//! Containers that turn while impulses are worked out.

use glam::DVec3;

use super::constraint::ContactConstraint;
use super::container::Containers;
use super::{ImpulseSolver, SolverBody};
use crate::contact::HeldForce;
use crate::damper::state::{Compartment, Space};
use crate::rotation::exp;

/// A wall where a particle touches it.
#[derive(Debug, Clone, Copy)]
pub(super) struct WallMotion<S: Space> {
    /// From the container's origin to the point, m.
    pub(super) arm: S::Vector,
    /// Velocity that the step leaves it without impulses, m/s.
    pub(super) free: S::Vector,
    /// Velocity that a free particle gains on it over the step, m/s.
    pub(super) velocity_gain: DVec3,
    /// The same as a speed, for a particle that is carried along.
    pub(super) speed_gain: f64,
}

impl<S: Space> Containers<S> {
    /// How the wall of a cavity moves at a point of the fixed frame over a step of `time_step` (s).
    pub(super) fn wall_at(&self, cavity: usize, point: DVec3, time_step: f64) -> WallMotion<S> {
        let container = &self.each[cavity];
        let space = point - container.origin;
        let arm = S::vector(space);
        let Some(turning) = self.turning.get(cavity) else {
            return WallMotion {
                arm,
                free: container.free,
                velocity_gain: container.velocity_gain,
                speed_gain: container.speed_gain,
            };
        };
        let spin = S::spin_in_space(turning.free);
        let velocity_gain = container.velocity_gain - (spin - turning.start).cross(space);
        let inwards = spin.cross(spin.cross(space)) * time_step;
        WallMotion {
            arm,
            free: container.free + S::swing(turning.free, arm),
            velocity_gain,
            speed_gain: (velocity_gain - inwards).length(),
        }
    }

    /// Speed (m/s) that a free particle gains on the container over the step, wherever it is: known if there is
    /// one container that does not turn.
    pub(super) fn common_speed_gain(&self) -> Option<f64> {
        match (&*self.each, &*self.turning) {
            ([container], []) => Some(container.speed_gain),
            _ => None,
        }
    }

    /// The same for a free particle at a point of the fixed frame over a step of `time_step` (s), if it is
    /// carried along.
    pub(super) fn speed_gain(&self, cavity: usize, point: DVec3, time_step: f64) -> f64 {
        if self.turning.is_empty() {
            self.each[cavity].speed_gain
        } else {
            self.wall_at(cavity, point, time_step).speed_gain
        }
    }

    /// Velocity of the container of a cavity after the impulses so far, at `arm` from its origin, m/s.
    #[inline]
    pub(super) fn velocity_at(&self, cavity: usize, arm: S::Vector) -> S::Vector {
        self.each[cavity].velocity + S::swing(self.turning[cavity].spin, arm)
    }

    /// Takes an impulse (N s) at `arm` from the origin of the container of a cavity, and an angular impulse
    /// (N m s) besides.
    pub(super) fn add_at(
        &mut self,
        cavity: usize,
        impulse: S::Vector,
        arm: S::Vector,
        angular: S::Spin,
    ) {
        let cavities = self.each.len();
        let Some(row) = self.mobilities.get(cavity * cavities..) else {
            return;
        };
        let impulse = S::in_space(impulse);
        let moment = S::in_space(arm).cross(impulse) + S::spin_in_space(angular);
        for ((container, turning), mobility) in self.each.iter_mut().zip(&mut self.turning).zip(row)
        {
            let [velocity, spin] = mobility.motion(impulse, moment);
            container.velocity += S::vector(velocity);
            turning.spin += S::spin(spin);
        }
    }

    /// The inverse moment of inertia (1/(kg m^2)) that a container has at the most about any axis.
    pub(super) fn greatest_inverse_inertia(&self, cavity: usize) -> f64 {
        let own = self.mobilities.get(cavity * (self.each.len() + 1));
        own.map_or(0.0, |own| {
            let rows = [0, 1, 2].map(|row| own.angular.row(row).abs().element_sum());
            rows.into_iter().fold(0.0, f64::max)
        })
    }
}

impl<S: Space> ImpulseSolver<S> {
    /// Whether any container turns.
    pub(super) fn turns(&self) -> bool {
        !self.containers.turning.is_empty()
    }

    /// Solves the contact of a particle with the wall of a container that turns.
    pub(super) fn solve_turning_wall(&mut self, number: usize) {
        let constraint: &mut ContactConstraint<S> = &mut self.constraints[number];
        let [index, cavity] = constraint.bodies.map(|body| body as usize);
        let arm = self.arms[number - self.pairs];
        let body: &mut SolverBody<S> = &mut self.bodies[index];
        let velocity = body.velocity - self.containers.velocity_at(cavity, arm);
        let change = constraint.solve(velocity, body.spin);
        body.add(&change);
        let none = S::Spin::default();
        self.containers
            .add_at(cavity, change.impulse * -1.0, arm, none);
    }

    /// What impulses at walls do as containers turn: how the work (J) of the walls' rotation grows with a part
    /// of the impulses, in proportion and with the square.
    pub(super) fn work_of_rotation(&self) -> [f64; 2] {
        let (mut proportional, mut square) = (0.0, 0.0);
        for (number, arm) in (self.pairs..).zip(&self.arms) {
            let constraint = &self.constraints[number];
            let turning = &self.containers.turning[constraint.bodies[1] as usize];
            let impulse = constraint.so_far().impulse;
            let gained = turning.spin + turning.free * -1.0;
            proportional += S::dot(impulse, S::swing(turning.free, *arm));
            square += S::dot(impulse, S::swing(gained, *arm));
            if let Some(rolling) = self.rolling.get(number) {
                proportional += S::spin_dot(rolling.impulse, turning.free);
                square += S::spin_dot(rolling.impulse, gained);
            }
        }
        [proportional, square]
    }
}

/// What a contact at a wall bore, turned with the container by as much as it turns in `time` (s).
pub(super) fn carried(held: &HeldForce, compartment: &Compartment, time: f64) -> HeldForce {
    let turn = exp(compartment.motion.angular_velocity * time);
    let mut held = *held;
    held.force.tangential = turn * held.force.tangential;
    held.force.couple = turn * held.force.couple;
    held
}
