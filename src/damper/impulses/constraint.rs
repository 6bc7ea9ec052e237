//! Contact constraints: what two bodies in contact may not do.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use super::SolverBody;
use crate::contact::ContactForce;
use crate::damper::state::Space;
use crate::numbers::at_least;

/// m r^2/I of a solid sphere, whose moment of inertia is I = 2/5 m r^2.
pub(super) const TURNING: f64 = 2.5;

/// Two bodies in contact: they have to part with a target speed at the least, and friction resists slip.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ContactConstraint<S: Space> {
    /// Indices of both; at a wall, index and number of the cavity.
    pub(super) bodies: [u32; 2],
    /// From the second body to the first.
    pub(super) normal: S::Vector,
    /// Distances from the centres to the point of contact over the radii. They add up to the distance of
    /// the centres, so that friction keeps angular momentum whatever the overlap.
    pub(super) lever: f64,
    /// Speed of separation that the contact has to leave at the least, m/s.
    pub(super) target: f64,
    /// Along the normal, kg.
    pub(super) effective_mass: f64,
    /// Across it, where spin counts too, kg.
    pub(super) tangential_mass: f64,
    /// Coefficient of friction.
    pub(super) friction: f64,
    /// Impulse so far along the normal, N s, not negative.
    pub(super) impulse: f64,
    /// Across it, on the first body.
    pub(super) tangential: S::Tangent,
}

/// What resists rolling in a contact.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RollingConstraint<S: Space> {
    /// Couple per normal force at the most, m.
    pub(super) arm: f64,
    /// Reciprocals of the radii, 1/m; zero for a wall.
    pub(super) curvatures: [f64; 2],
    /// Effective moment of inertia, kg m^2.
    pub(super) effective_inertia: f64,
    /// Angular impulse so far on the first body, N m s.
    pub(super) impulse: S::Spin,
}

/// What a solve adds to the impulses of a contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Change<S: Space> {
    /// On the first body.
    pub(super) impulse: S::Vector,
    /// What the tangential part gives to the spin times radius of either body, times its mass.
    turn: S::Spin,
}

impl<S: Space> ContactConstraint<S> {
    /// The impulses so far.
    #[inline(always)]
    pub(super) fn so_far(&self) -> Change<S> {
        self.change(self.impulse, self.tangential)
    }

    #[inline(always)]
    fn change(&self, normal: f64, tangential: S::Tangent) -> Change<S> {
        Change {
            impulse: self.normal * normal + S::across(self.normal, tangential),
            turn: S::turn(self.normal, tangential) * (TURNING * self.lever),
        }
    }

    /// Solves the contact by itself, for bodies whose centres move with the relative velocity `velocity`
    /// and whose spins times radii add up to `spin`: adds to the impulses what leaves the target and ends
    /// the slip, as far as the sum pushes and friction reaches.
    #[inline(always)]
    pub(super) fn solve(&mut self, velocity: S::Vector, spin: S::Spin) -> Change<S> {
        let separation = S::dot(velocity, self.normal);
        let asked = self.impulse + (self.target - separation) * self.effective_mass;
        let normal = at_least(asked, 0.0);
        let slip = S::slip(self.normal, velocity, separation, spin * self.lever);
        let sticking = self.tangential - slip * self.tangential_mass;
        let tangential = S::shorten(sticking, self.friction * normal);
        let change = self.change(normal - self.impulse, tangential - self.tangential);
        self.impulse = normal;
        self.tangential = tangential;
        change
    }

    /// Starts from the `force` of the step before over `time` (s).
    pub(super) fn start_from(&mut self, force: &ContactForce, time: f64) {
        self.impulse = force.normal * time;
        self.tangential = S::tangent(self.normal, S::vector(force.tangential * time));
    }

    /// The impulses as forces over `time_step` (s).
    pub(super) fn force(&self, time_step: f64) -> ContactForce {
        let rate = 1.0 / time_step;
        let tangential = S::in_space(S::across(self.normal, self.tangential));
        ContactForce::new(self.impulse * rate, tangential * rate)
    }
}

impl<S: Space> RollingConstraint<S> {
    /// Adds to the angular impulse what ends the rolling of two bodies with these spins times radii, as far
    /// as resistance reaches under a normal impulse (N s). Returns what it adds.
    pub(super) fn solve(&mut self, spins: [S::Spin; 2], normal: f64) -> S::Spin {
        let relative = spins[0] * self.curvatures[0] - spins[1] * self.curvatures[1];
        let stopping = self.impulse - relative * self.effective_inertia;
        let impulse = S::shorten_spin(stopping, self.arm * normal);
        let change = impulse - self.impulse;
        self.impulse = impulse;
        change
    }

    /// What the angular impulse `change` on a body adds to its spin times radius, times its mass.
    pub(super) fn turn(&self, body: usize, change: S::Spin) -> S::Spin {
        change * (TURNING * self.curvatures[body])
    }
}

impl<S: Space> SolverBody<S> {
    /// Takes an impulse.
    #[inline(always)]
    pub(super) fn add(&mut self, change: &Change<S>) {
        self.velocity += change.impulse * self.inverse_mass;
        self.spin += change.turn * self.inverse_mass;
    }

    /// Takes its reaction.
    #[inline(always)]
    pub(super) fn subtract(&mut self, change: &Change<S>) {
        self.velocity -= change.impulse * self.inverse_mass;
        self.spin += change.turn * self.inverse_mass;
    }
}
