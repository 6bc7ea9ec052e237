//! Contact constraints of pairs, worked out side by side.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use super::constraint::TURNING;
use super::prepare::{Mark, Meeting};
use super::{Stages, Step};
use crate::cavity::Cavity;
use crate::damper::candidates::Candidates;
use crate::damper::scene::Scene;
use crate::damper::space::Space;
use crate::law::{ImpulseLaw, at_least, at_most};

/// How many pairs are side by side at the most.
const LANES: usize = 32;

type Column = [f64; LANES];

/// Pairs in reach, side by side: so that several roots and quotients are under way at a time.
#[derive(Debug, Clone)]
pub(super) struct Lanes<S: Space> {
    /// From the second centre to the first, m.
    towards: [S::Vector; LANES],
    /// Rate at which the distance of the centres falls, times that distance, m^2/s.
    closing: Column,
    /// Square of the distance, m^2, and then the distance, m.
    distance: Column,
    /// Reciprocal of the distance, 1/m.
    inverse: Column,
    /// Sum of the radii, m.
    touching: Column,
    /// Speed along the normal, m/s, not negative.
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
    /// Works out which of the first `count` pairs are in contact. Returns their lanes, and how many.
    #[inline(always)]
    fn judge(&mut self, step: &Step, count: usize) -> ([u8; LANES], usize) {
        let count = count.min(LANES);
        for n in 0..count {
            let distance = self.distance[n].sqrt();
            let inverse = 1.0 / (distance + f64::MIN_POSITIVE);
            let approach = at_least(self.closing[n] * inverse, 0.0);
            let gap = distance - self.touching[n];
            self.distance[n] = distance;
            self.inverse[n] = inverse;
            self.approach[n] = approach;
            self.within[n] = step.reach(approach) - gap;
        }
        let mut active = [0; LANES];
        let mut found = 0;
        for n in 0..count {
            // Written before it is known whether it counts: no branch to mispredict.
            active[found] = n as u8;
            found += usize::from(self.within[n] > 0.0);
        }
        (active, found)
    }
}

impl<S: Space> Stages<S> {
    /// Adds the constraints of the pairs of a list. Returns their largest overlap in m.
    pub(super) fn add_pairs<C: Cavity, L: ImpulseLaw>(
        &mut self,
        step: &Step,
        scene: &Scene<'_, C, L>,
        list: &Candidates<L>,
    ) -> f64 {
        let start = self.constraints.len();
        let mut deepest = 0.0;
        let runs = list.contacts.bodies().chunks(LANES);
        for (bodies, places) in runs.zip(list.contacts.places().chunks(LANES)) {
            self.gather(scene, bodies);
            let (active, found) = self.lanes.judge(step, bodies.len());
            for n in &active[..found.min(LANES)] {
                let n = *n as usize % LANES;
                let held = list.touched(places[n], scene.stamp);
                let [i, j] = bodies[n].map(|slot| slot as usize);
                let lanes = &self.lanes;
                let lever = lanes.distance[n] / lanes.touching[n];
                let inverse_mass = self.bodies[i].inverse_mass + self.bodies[j].inverse_mass;
                let meeting = Meeting {
                    overlap: lanes.touching[n] - lanes.distance[n],
                    approach: lanes.approach[n],
                    smaller_radius: at_most(scene.radius[i], scene.radius[j]),
                    inverse_masses: [inverse_mass, inverse_mass * (1.0 + TURNING * lever * lever)],
                    fall: self.containers.each[scene.room_of(bodies[n][0])].fall,
                };
                let place = (bodies[n], lanes.towards[n] * lanes.inverse[n], lever);
                let other;
                let own = if let Some(only) = scene.coefficients.only_pair() {
                    only
                } else {
                    other = scene.pair(list, bodies[n], places[n]);
                    &other
                };
                let (constraint, rests) = step.constrain(scene.law, own, place, &meeting, held);
                deepest = at_least(meeting.overlap, deepest);
                self.constraints.push(constraint);
                self.marks.push(Mark {
                    place: places[n],
                    wall: 0,
                    rests,
                    before: held.map_or(0.0, |held| held.force.normal),
                    fall: meeting.fall,
                });
                self.touches[i] += 1;
                self.touches[j] += 1;
            }
        }
        self.ends.push(self.constraints.len());
        let only = scene.coefficients.only_pair();
        if only.is_none_or(|own| scene.law.rolling_arm(own) > 0.0) {
            self.resist_rolling(step, scene, list, start, |constraint, mark| {
                scene.pair(list, constraint.bodies, mark.place)
            });
        }
        deepest
    }

    /// Takes pairs into the lanes.
    #[inline(always)]
    fn gather<C: Cavity, L: ImpulseLaw>(&mut self, scene: &Scene<'_, C, L>, bodies: &[[u32; 2]]) {
        let radius = scene.radius;
        // Columns of one length, so that one comparison stands for all their bounds.
        let position = &S::rows(scene.position.flat())[..radius.len()];
        let bodies_now = &self.bodies[..radius.len()];
        let lanes = &mut self.lanes;
        for (n, [i, j]) in bodies.iter().take(LANES).enumerate() {
            let (i, j) = (*i as usize, *j as usize);
            let towards = S::from_row(position[i]) - S::from_row(position[j]);
            lanes.towards[n] = towards;
            lanes.closing[n] = S::dot(bodies_now[j].velocity - bodies_now[i].velocity, towards);
            lanes.distance[n] = S::dot(towards, towards);
            lanes.touching[n] = radius[i] + radius[j];
        }
    }
}
