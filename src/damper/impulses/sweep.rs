//! Sweeps through the contact constraints.
//!
//! The impulses of all contacts solve a complementarity problem: each leaves its target speed of separation or
//! is zero. A sweep solves one contact after the other by itself, with the velocities that those before it
//! left, and cuts its sum of impulses at zero and at the cone of friction (projected Gauss-Seidel; M. Jean,
//! Comput. Methods Appl. Mech. Eng. 177 (1999) 235, doi 10.1016/S0045-7825(98)00383-1). Impulses go down a
//! chain of contacts in one sweep if it runs along the chain and by one contact a sweep if it runs against it:
//! so sweeps go to and fro. What one solve settles (a contact whose bodies have no other) is left out after the
//! first. And sweeps do not start from nothing but from what contacts gave in the step before (warm start; E.
//! Catto, Iterative dynamics with temporal coherence, Game Developers Conference 2005): a bed at rest is then
//! solved before the first sweep, and two are as accurate as four.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use super::constraint::{Change, ContactConstraint};
use super::container::Containers;
use super::{BeforeSweep, ImpulseSolver, SolverBody};
use crate::damper::state::Space;

/// Solves the contact of two particles.
#[inline(always)]
fn solve_pair<S: Space>(constraint: &mut ContactConstraint<S>, bodies: &mut [SolverBody<S>]) {
    let [i, j] = constraint.bodies.map(|index| index as usize);
    let (first, second) = (&bodies[i], &bodies[j]);
    let velocity = first.velocity - second.velocity;
    let change = constraint.solve(velocity, first.spin + second.spin);
    bodies[i].add(&change);
    bodies[j].subtract(&change);
}

/// Solves the contact of a particle with a wall.
#[inline(always)]
fn solve_wall<S: Space>(
    constraint: &mut ContactConstraint<S>,
    bodies: &mut [SolverBody<S>],
    containers: &mut Containers<S>,
) {
    let [index, cavity] = constraint.bodies.map(|body| body as usize);
    let body = &mut bodies[index];
    let velocity = body.velocity - containers.each[cavity].velocity;
    let change = constraint.solve(velocity, body.spin);
    body.add(&change);
    containers.add(cavity, change.impulse * -1.0);
}

impl<S: Space> ImpulseSolver<S> {
    /// Lists the constraints that one solve does not settle: those of which a body has more than one, and
    /// all where rolling is resisted.
    pub(super) fn list_coupled(&mut self) {
        let all = !self.rolling.is_empty();
        let yields = all || self.containers.yield_at_all();
        let contacts = |body: u32| self.contact_counts[body as usize];
        self.coupled.resize(self.constraints.len(), 0);
        let (pairs, walls) = self.constraints.split_at(self.pairs);
        let mut found = 0;
        for (number, pair) in (0..).zip(pairs) {
            // Written before it is known whether it counts: no branch to mispredict.
            self.coupled[found] = number;
            let [first, second] = pair.bodies;
            found += usize::from(all || contacts(first) + contacts(second) != 2);
        }
        for (number, wall) in (self.pairs as u32..).zip(walls) {
            self.coupled[found] = number;
            found += usize::from(yields || contacts(wall.bodies[0]) != 1);
        }
        self.coupled.truncate(found);
    }

    /// Gives what contacts start from.
    pub(super) fn warm_start(&mut self) {
        for pair in &self.constraints[..self.pairs] {
            if pair.impulse > 0.0 {
                let change = pair.so_far();
                let [first, second] = pair.bodies.map(|body| body as usize);
                self.bodies[first].add(&change);
                self.bodies[second].subtract(&change);
            }
        }
        for number in self.pairs..self.constraints.len() {
            if self.constraints[number].impulse > 0.0 {
                let change = self.constraints[number].so_far();
                self.give(number, &change);
            }
        }
        for number in 0..self.rolling.len() {
            self.roll(number, self.rolling[number].impulse);
        }
    }

    /// Solves each constraint in turn, with the velocities that those before it left: to and fro, and from
    /// the second sweep on only those that one solve does not settle.
    pub(super) fn sweep(&mut self, number: u32) {
        if !self.rolling.is_empty() {
            self.sweep_rolling(number.is_multiple_of(2));
        } else if number == 0 {
            let (pairs, walls) = self.constraints.split_at_mut(self.pairs);
            for pair in pairs {
                solve_pair(pair, &mut self.bodies);
            }
            if self.containers.turning.is_empty() {
                for wall in walls {
                    solve_wall(wall, &mut self.bodies, &mut self.containers);
                }
            } else {
                for number in self.pairs..self.constraints.len() {
                    self.solve_turning_wall(number);
                }
            }
        } else {
            self.sweep_coupled(number.is_multiple_of(2));
        }
    }

    /// The same through the coupled contacts alone.
    fn sweep_coupled(&mut self, to: bool) {
        let pair = |number: &u32| (*number as usize) < self.pairs;
        let pairs = self.coupled.partition_point(pair);
        if to {
            for number in &self.coupled[..pairs] {
                let constraint = &mut self.constraints[*number as usize];
                solve_pair(constraint, &mut self.bodies);
            }
            for n in pairs..self.coupled.len() {
                self.solve_wall(self.coupled[n] as usize);
            }
        } else {
            for n in (pairs..self.coupled.len()).rev() {
                self.solve_wall(self.coupled[n] as usize);
            }
            for number in self.coupled[..pairs].iter().rev() {
                let constraint = &mut self.constraints[*number as usize];
                solve_pair(constraint, &mut self.bodies);
            }
        }
    }

    #[inline(always)]
    fn solve_wall(&mut self, number: usize) {
        if self.turns() {
            self.solve_turning_wall(number);
        } else {
            let constraint = &mut self.constraints[number];
            solve_wall(constraint, &mut self.bodies, &mut self.containers);
        }
    }

    /// The same where something resists rolling.
    fn sweep_rolling(&mut self, to: bool) {
        let count = self.constraints.len();
        for turn in 0..count {
            let number = if to { turn } else { count - 1 - turn };
            let [first, second] = self.constraints[number].bodies.map(|body| body as usize);
            let mut spins = [S::Spin::default(); 2];
            if number < self.pairs {
                solve_pair(&mut self.constraints[number], &mut self.bodies);
                spins[1] = self.bodies[second].spin;
            } else {
                self.solve_wall(number);
                if let Some(container) = self.containers.turning.get(second) {
                    spins[1] = container.spin;
                }
            }
            spins[0] = self.bodies[first].spin;
            let impulse = self.constraints[number].impulse;
            let change = self.rolling[number].solve(spins, impulse);
            self.roll(number, change);
        }
    }

    /// Solves all constraints from the same velocities.
    pub(super) fn sweep_at_once(&mut self) {
        self.before_sweep.bodies.clone_from(&self.bodies);
        self.before_sweep
            .containers
            .clone_from(&self.containers.each);
        self.before_sweep
            .turning
            .clone_from(&self.containers.turning);
        for number in 0..self.constraints.len() {
            let BeforeSweep {
                bodies,
                containers,
                turning,
            } = &self.before_sweep;
            let constraint = &mut self.constraints[number];
            let [first, second] = constraint.bodies.map(|body| body as usize);
            let first = bodies[first];
            let second = if number < self.pairs {
                bodies[second]
            } else {
                SolverBody {
                    velocity: containers[second].velocity,
                    ..SolverBody::default()
                }
            };
            let mut velocity = first.velocity - second.velocity;
            let mut other = second.spin;
            if let Some(arm) = number
                .checked_sub(self.pairs)
                .and_then(|n| self.arms.get(n))
            {
                other = turning[constraint.bodies[1] as usize].spin;
                velocity -= S::swing(other, *arm);
            }
            let change = constraint.solve(velocity, first.spin + second.spin);
            let impulse = constraint.impulse;
            self.give(number, &change);
            if let Some(rolling) = self.rolling.get_mut(number) {
                let change = rolling.solve([first.spin, other], impulse);
                self.roll(number, change);
            }
        }
    }

    /// Gives the bodies of a constraint a change of its impulses.
    #[inline(always)]
    fn give(&mut self, number: usize, change: &Change<S>) {
        let [first, second] = self.constraints[number].bodies.map(|body| body as usize);
        self.bodies[first].add(change);
        if number < self.pairs {
            self.bodies[second].subtract(change);
        } else if self.turns() {
            let arm = self.arms[number - self.pairs];
            let none = S::Spin::default();
            let containers = &mut self.containers;
            containers.add_at(second, change.impulse * -1.0, arm, none);
        } else {
            self.containers.add(second, change.impulse * -1.0);
        }
    }

    /// Gives the bodies of a constraint a change of its angular impulse.
    fn roll(&mut self, number: usize, change: S::Spin) {
        let [first, second] = self.constraints[number].bodies.map(|body| body as usize);
        let rolling = &self.rolling[number];
        let body = &mut self.bodies[first];
        body.spin += rolling.turn(0, change) * body.inverse_mass;
        if number < self.pairs {
            let body = &mut self.bodies[second];
            body.spin -= rolling.turn(1, change) * body.inverse_mass;
        } else if self.turns() {
            let none = S::Vector::default();
            self.containers.add_at(second, none, none, change * -1.0);
        }
    }
}
