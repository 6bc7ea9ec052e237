//! Contact constraints of pairs, worked out side by side.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use super::constraint::TURNING;
use super::prepare::{ConstraintInfo, ContactKinematics};
use super::{ImpulseSolver, SolverBody, SolverStep};
use crate::cavity::Cavity;
use crate::damper::neighbours::NeighbourList;
use crate::damper::state::{Space, StateView};
use crate::law::ImpulseLaw;
use crate::numbers::{at_least, at_most};

/// How many pairs are side by side at the most.
const LANES: usize = 32;

type Column = [f64; LANES];

/// Pairs in reach, side by side: so that several roots and quotients are under way at a time.
#[derive(Debug, Clone)]
pub(super) struct Lanes<S: Space> {
    /// From the second centre to the first, m.
    towards: [S::Vector; LANES],
    /// Rate at which the centres approach at the start of the step, times their distance, m^2/s.
    closing: Column,
    /// Square of the distance, m^2, and then the distance, m.
    distance: Column,
    /// Reciprocal of the distance, 1/m.
    inverse: Column,
    /// Sum of the radii, m.
    touching: Column,
    /// Speed of approach along the normal at the start of the step, m/s, negative when they part.
    approach: Column,
    /// How much nearer they are than they have to be, m.
    within: Column,
}

impl<S: Space> Default for Lanes<S> {
    fn default() -> Self {
        Self {
            towards: [S::Vector::default(); LANES],
            closing: [0.0; LANES],
            distance: [0.0; LANES],
            inverse: [0.0; LANES],
            touching: [0.0; LANES],
            approach: [0.0; LANES],
            within: [0.0; LANES],
        }
    }
}

impl<S: Space> Lanes<S> {
    /// Takes pairs into the lanes.
    #[inline(always)]
    fn gather<C: Cavity, L: ImpulseLaw>(
        &mut self,
        view: &StateView<'_, C, L>,
        bodies: &[SolverBody<S>],
        pairs: &[[u32; 2]],
    ) {
        let radius = view.radius;
        let bodies = &bodies[..radius.len()];
        let position = &S::rows(view.position.flat())[..radius.len()];
        for (n, [i, j]) in pairs.iter().take(LANES).enumerate() {
            let (i, j) = (*i as usize, *j as usize);
            let towards = S::from_row(position[i]) - S::from_row(position[j]);
            self.towards[n] = towards;
            self.closing[n] = S::dot(bodies[j].velocity - bodies[i].velocity, towards);
            self.distance[n] = S::dot(towards, towards);
            self.touching[n] = radius[i] + radius[j];
        }
    }

    /// Works out which of the first `count` pairs are in contact, where `closes_under_load` tells of a lane, a gap
    /// (m) and a speed of approach (m/s) what the step does. Returns their lanes, and how many.
    #[inline(always)]
    fn find_active(
        &mut self,
        step: &SolverStep,
        count: usize,
        closes_under_load: impl Fn(usize, f64, f64) -> bool,
    ) -> ([u8; LANES], usize) {
        let count = count.min(LANES);
        for n in 0..count {
            let distance = self.distance[n].sqrt();
            let inverse = 1.0 / (distance + f64::MIN_POSITIVE);
            let approach = self.closing[n] * inverse;
            let gap = distance - self.touching[n];
            self.distance[n] = distance;
            self.inverse[n] = inverse;
            self.approach[n] = approach;
            self.within[n] = step.prediction_distance(at_least(approach, 0.0)) - gap;
        }
        let mut active = [0; LANES];
        let mut found = 0;
        for n in 0..count {
            // Written before it is known whether it counts: no branch to mispredict.
            active[found] = n as u8;
            let active = self.within[n] > 0.0 || {
                let gap = self.distance[n] - self.touching[n];
                closes_under_load(n, gap, self.approach[n])
            };
            found += usize::from(active);
        }
        (active, found)
    }
}

impl<S: Space> ImpulseSolver<S> {
    /// Adds the constraints of the pairs of a list. Returns their largest overlap at the start of the step, m.
    pub(super) fn add_pairs<C: Cavity, L: ImpulseLaw>(
        &mut self,
        step: &SolverStep,
        view: &StateView<'_, C, L>,
        list: &NeighbourList<L>,
    ) -> f64 {
        let start = self.constraints.len();
        let mut deepest = 0.0;
        let Self {
            bodies,
            containers,
            constraints,
            infos,
            contact_counts,
            lanes,
            ..
        } = self;
        // Columns of one length, so that one comparison stands for all their bounds.
        let bodies = &bodies[..view.radius.len()];
        let counts = &mut contact_counts[..view.radius.len()];
        let only = view.coefficients.only_pair();
        let common_gain = containers.common_speed_gain();
        let mut memories = list.memories();
        let runs = list.contacts.bodies().chunks(LANES);
        for (pairs, candidates) in runs.zip(list.contacts.candidates().chunks(LANES)) {
            lanes.gather(view, bodies, pairs);
            let mut held = [None; LANES];
            for (held, candidate) in held.iter_mut().zip(candidates) {
                *held = memories.of(*candidate);
            }
            let closes_under_load = |n: usize, gap: f64, approach: f64| {
                let [i, j] = pairs[n].map(|index| index as usize);
                let inverse_mass = bodies[i].inverse_mass + bodies[j].inverse_mass;
                step.closes_under_load(gap, approach, inverse_mass, held[n])
            };
            let (active, found) = lanes.find_active(step, pairs.len(), closes_under_load);
            for n in &active[..found.min(LANES)] {
                let n = *n as usize % LANES;
                let (pair, candidate) = (pairs[n], candidates[n]);
                let [i, j] = pair.map(|index| index as usize);
                let held = held[n];
                let lever = lanes.distance[n] / lanes.touching[n];
                let inverse_mass = bodies[i].inverse_mass + bodies[j].inverse_mass;
                let kinematics = ContactKinematics {
                    overlap: lanes.touching[n] - lanes.distance[n],
                    approach: at_least(lanes.approach[n], 0.0),
                    smaller_radius: at_most(view.radius[i], view.radius[j]),
                    inverse_masses: [inverse_mass, inverse_mass * (1.0 + TURNING * lever * lever)],
                    speed_gain: common_gain.unwrap_or_else(|| {
                        let cavity = view.compartment_of(pair[0]);
                        containers.speed_gain(cavity, view.position.get(i), step.time_step)
                    }),
                };
                let place = (pair, lanes.towards[n] * lanes.inverse[n], lever);
                let other;
                let own = if let Some(only) = only {
                    only
                } else {
                    other = list.pair_coefficients(view, pair, candidate);
                    &other
                };
                let (constraint, rests) = step.constrain(view.law, own, place, &kinematics, held);
                let overlap = step.at_start(kinematics.overlap, lanes.approach[n]);
                deepest = at_least(overlap, deepest);
                constraints.push(constraint);
                infos.push(ConstraintInfo {
                    candidate,
                    wall: 0,
                    rests,
                    before: held.map_or(0.0, |held| held.force.normal),
                    speed_gain: kinematics.speed_gain,
                });
                counts[i] += 1;
                counts[j] += 1;
            }
        }
        self.list_ends.push(self.constraints.len());
        if only.is_none_or(|own| view.law.rolling_arm(own) > 0.0) {
            self.resist_rolling(step, view, list, (start, false), |constraint, info| {
                list.pair_coefficients(view, constraint.bodies, info.candidate)
            });
        }
        deepest
    }
}
