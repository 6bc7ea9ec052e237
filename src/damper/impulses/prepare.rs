//! Contact constraints of a step, from the contacts in reach.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use super::constraint::{ContactConstraint, RollingConstraint, TURNING};
use super::turning::carried;
use super::{ImpulseSolver, SolverStep};
use crate::cavity::Cavity;
use crate::contact::{HeldForce, Partner};
use crate::damper::neighbours::{Block, ContactId, NeighbourList};
use crate::damper::state::{Space, StateView};
use crate::law::ImpulseLaw;
use crate::numbers::{at_least, at_most};

/// What is to be known of a constraint besides what sweeps need.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ConstraintInfo {
    /// Index among the candidates of its list.
    pub(super) candidate: u32,
    /// Number of the wall among those of all cavities; of no account for a pair.
    pub(super) wall: u32,
    /// Whether its bodies rest on each other or come to rest: then the target is position correction.
    pub(super) rests: bool,
    /// Normal force in the step before, N.
    pub(super) before: f64,
    /// Speed that a free body gains on the container over the step, m/s.
    pub(super) speed_gain: f64,
}

/// How two bodies meet that are in contact.
pub(super) struct ContactKinematics {
    pub(super) overlap: f64,
    /// Speed along the normal at the start of the step, m/s, positive when approaching.
    pub(super) approach: f64,
    pub(super) smaller_radius: f64,
    /// Reciprocals of the effective masses along the normal and across it, 1/kg.
    pub(super) inverse_masses: [f64; 2],
    /// Speed that a free body gains on the container over the step, m/s.
    pub(super) speed_gain: f64,
}

impl SolverStep {
    /// What bodies come nearer from the start of the step to where contacts are looked for, m, that approach at a
    /// speed (m/s) at its start: those with a smaller gap there touch within the step.
    #[inline(always)]
    pub(super) fn prediction_distance(&self, speed: f64) -> f64 {
        self.parameters.prediction * self.time_step * speed
    }

    /// The overlap (m) at the start of the step of bodies that overlap by `overlap` (m) where contacts are looked
    /// for, and approach at a speed (m/s, negative when they part) at the start.
    #[inline(always)]
    pub(super) fn at_start(&self, overlap: f64, approach: f64) -> f64 {
        overlap - self.prediction_distance(approach)
    }

    /// From where contacts are looked for to the end of the step, s.
    #[inline(always)]
    fn rest(&self) -> f64 {
        (1.0 - self.parameters.prediction) * self.time_step
    }

    /// The speed (m/s) of approach that a contact's load would give two bodies over the step if they were not
    /// in contact; `inverse_mass` is that of both along the normal, 1/kg.
    #[inline(always)]
    fn load_speed(&self, held: &HeldForce, inverse_mass: f64) -> f64 {
        self.parameters.warm_start * held.load * self.time_step * inverse_mass
    }

    /// Whether bodies that approach at a speed (m/s, negative when they part) are pressed together again by the
    /// end of the step.
    ///
    /// What presses two bodies on each other does not end because a gap has opened between them: left to itself, a
    /// contact that has come off by a hair would be missed for a step, in which the load of its neighbours drives its
    /// bodies into each other. So it stays a constraint (a speculative contact, as game engines have them) that lets
    /// the bodies come as near as touching and no nearer.
    #[inline(always)]
    pub(super) fn closes_under_load(
        &self,
        gap: f64,
        approach: f64,
        inverse_mass: f64,
        held: Option<&HeldForce>,
    ) -> bool {
        held.is_some_and(|held| {
            let speed = self.load_speed(held, inverse_mass);
            speed > 0.0 && gap < self.rest() * (speed + approach)
        })
    }

    /// How long a force of the step before acts in a warm start, s, where a free body gains `speed_gain` (m/s) over
    /// the step. Loads at rest grow with the container's acceleration: so they follow it without delay.
    #[inline(always)]
    fn warm_start_time(&self, held: &HeldForce, speed_gain: f64) -> f64 {
        let time = self.parameters.warm_start * self.time_step;
        let before = held.gravity * self.time_step;
        if before > 0.0 {
            time * at_most(speed_gain / before, 2.0)
        } else {
            time
        }
    }

    /// The constraint of two bodies that will touch within the step, and whether they rest on each other or
    /// come to rest.
    #[inline(always)]
    pub(super) fn constrain<L: ImpulseLaw, S: Space>(
        &self,
        law: &L,
        own: &L::Coefficients,
        (bodies, normal, lever): ([u32; 2], S::Vector, f64),
        kinematics: &ContactKinematics,
        held: Option<&HeldForce>,
    ) -> (ContactConstraint<S>, bool) {
        let parameters = &self.parameters;
        let rests = kinematics.approach <= parameters.restitution_threshold * kinematics.speed_gain;
        let restitution = if rests {
            0.0
        } else {
            at_most(
                at_least(law.restitution(own, kinematics.approach), 0.0),
                1.0,
            )
        };
        let [effective_mass, tangential_mass] = kinematics.inverse_masses.map(|own| 1.0 / own);
        let rebound = if restitution > 0.0 {
            restitution * kinematics.approach
        } else {
            // What does not rebound comes as near as touching by the end of the step.
            at_most(kinematics.overlap, 0.0) / self.rest()
        };
        let deep = kinematics.overlap - parameters.slop * kinematics.smaller_radius;
        let target = if deep > 0.0 {
            let correction = deep * (parameters.position_correction / self.time_step);
            // No faster than bodies fall, and their load would press them together.
            let inverse_mass = kinematics.inverse_masses[0];
            let load = held.map_or(0.0, |held| self.load_speed(held, inverse_mass));
            let most = kinematics.speed_gain + load;
            at_least(at_most(correction, most), rebound)
        } else {
            rebound
        };
        let mut constraint = ContactConstraint {
            bodies,
            normal,
            lever,
            target,
            effective_mass,
            tangential_mass,
            friction: law.friction(own),
            impulse: 0.0,
            tangential: S::Tangent::default(),
        };
        if let Some(held) = held {
            constraint.start_from(
                &held.force,
                self.warm_start_time(held, kinematics.speed_gain),
            );
        }
        (constraint, rests)
    }
}

impl<S: Space> ImpulseSolver<S> {
    /// Prepares a constraint for each active contact, in the order of pairs and then of walls.
    pub(super) fn prepare<C: Cavity, L: ImpulseLaw>(
        &mut self,
        step: &SolverStep,
        view: &StateView<'_, C, L>,
        blocks: &mut [Block<L>],
    ) {
        self.clear();
        for block in &mut *blocks {
            block.clear_results();
            let before = self.constraints.len();
            for list in [&block.pairs, &block.halo] {
                let deepest = self.add_pairs(step, view, list);
                block.largest_overlap = at_least(deepest, block.largest_overlap);
            }
            block.contacts += self.constraints.len() - before;
        }
        self.pairs = self.constraints.len();
        for block in &mut *blocks {
            let before = self.constraints.len();
            self.add_walls(step, view, block);
            block.contacts += self.constraints.len() - before;
        }
        if !self.rolling.is_empty() {
            self.rolling
                .resize(self.constraints.len(), RollingConstraint::default());
        }
    }
}

impl<S: Space> ImpulseSolver<S> {
    /// Forgets the constraints of the step before.
    fn clear(&mut self) {
        self.constraints.clear();
        self.infos.clear();
        self.pairs = 0;
        self.list_ends.clear();
        self.contact_counts.clear();
        self.contact_counts.resize(self.bodies.len(), 0);
        self.rolling.clear();
        self.arms.clear();
    }

    /// Adds the constraints of the contacts of a block with walls.
    fn add_walls<C: Cavity, L: ImpulseLaw>(
        &mut self,
        step: &SolverStep,
        view: &StateView<'_, C, L>,
        block: &mut Block<L>,
    ) {
        let start = self.constraints.len();
        let list = &block.walls;
        let mut memories = list.memories();
        let contacts = list
            .contacts
            .bodies()
            .iter()
            .zip(list.contacts.candidates());
        for (&[index, wall], &candidate) in contacts {
            let n = index as usize;
            let body = &self.bodies[n];
            let cavity = view.cavity_of_wall(wall);
            let point = view.wall_point(wall, view.position.get(n));
            let normal = S::vector(point.normal);
            let radius = view.radius[n];
            let touch = view.position.get(n) - point.normal * point.distance;
            let motion = self.containers.wall_at(cavity, touch, step.time_step);
            let velocity = body.velocity - motion.free;
            let ahead = -S::dot(velocity, normal);
            let at_start = ahead + motion.velocity_gain.dot(point.normal);
            let approach = at_least(at_start, 0.0);
            let overlap = radius - point.distance;
            let held = memories.of(candidate);
            if -overlap >= step.prediction_distance(at_least(ahead, approach))
                && !step.closes_under_load(-overlap, at_start, body.inverse_mass, held)
            {
                continue;
            }
            let lever = point.distance / radius;
            let mut inverse_masses = [1.0, 1.0 + TURNING * lever * lever];
            inverse_masses = inverse_masses.map(|own| own * body.inverse_mass);
            if let Some(response) = self.containers.inverse_mass(cavity) {
                let slip = S::slip(normal, velocity, -ahead, body.spin * lever);
                let slip = S::across(normal, slip);
                let square = S::dot(slip, slip) + f64::MIN_POSITIVE;
                let [along, across] = match self.containers.mobility(cavity) {
                    None => [normal, slip].map(|way| S::dot(way, S::transform(response, way))),
                    Some(mobility) => {
                        let arm = S::in_space(motion.arm);
                        [normal, slip].map(|way| mobility.along(S::in_space(way), arm))
                    }
                };
                inverse_masses[0] += along;
                inverse_masses[1] += across / square;
            }
            let kinematics = ContactKinematics {
                overlap,
                approach,
                smaller_radius: radius,
                inverse_masses,
                speed_gain: motion.speed_gain,
            };
            let own = view.coefficients.wall(view.species[n]);
            let turned;
            let held = match held {
                Some(held) if self.turns() => {
                    turned = carried(held, &view.compartments[cavity], step.time_step);
                    Some(&turned)
                }
                held => held,
            };
            let bodies = [index, cavity as u32];
            let place = (bodies, normal, lever);
            let (constraint, rests) = step.constrain(view.law, own, place, &kinematics, held);
            let deepest = step.at_start(overlap, at_start);
            block.largest_overlap = at_least(deepest, block.largest_overlap);
            if overlap > radius {
                let partner = Partner::Wall(wall - view.compartments[cavity].first_wall);
                block.escaped = Some(ContactId { index: n, partner });
            }
            self.constraints.push(constraint);
            self.infos.push(ConstraintInfo {
                candidate,
                wall,
                rests,
                before: held.map_or(0.0, |held| held.force.normal),
                speed_gain: kinematics.speed_gain,
            });
            self.contact_counts[n] += 1;
            if self.turns() {
                self.arms.push(motion.arm);
            }
        }
        self.list_ends.push(self.constraints.len());
        let only = view.coefficients.only_wall();
        if only.is_none_or(|own| view.law.rolling_arm(own) > 0.0) {
            self.resist_rolling(step, view, list, (start, true), |constraint, _| {
                *view
                    .coefficients
                    .wall(view.species[constraint.bodies[0] as usize])
            });
        }
    }

    /// Prepares what resists rolling in the constraints from `start` on, whose coefficients `own` tells.
    pub(super) fn resist_rolling<C: Cavity, L: ImpulseLaw>(
        &mut self,
        step: &SolverStep,
        view: &StateView<'_, C, L>,
        list: &NeighbourList<L>,
        (start, walls): (usize, bool),
        own: impl Fn(&ContactConstraint<S>, &ConstraintInfo) -> L::Coefficients,
    ) {
        let mut memories = list.memories();
        for n in start..self.constraints.len() {
            let (constraint, info) = (&self.constraints[n], &self.infos[n]);
            let arm = view.law.rolling_arm(&own(constraint, info));
            if arm <= 0.0 {
                continue;
            }
            let [first, second] = constraint.bodies.map(|body| body as usize);
            let curvature = |index: usize| 1.0 / view.radius[index];
            let inverse_inertia = |index: usize| view.inverse_inertia[index];
            let held = memories.of(info.candidate);
            let speed_gain = info.speed_gain;
            let couple = held.map_or_else(S::Spin::default, |held| {
                let mut couple = held.force.couple;
                if walls && self.turns() {
                    let compartment = &view.compartments[second];
                    couple = carried(held, compartment, step.time_step).force.couple;
                }
                S::spin(couple) * step.warm_start_time(held, speed_gain)
            });
            let mut rolling = RollingConstraint {
                arm,
                curvatures: [curvature(first), 0.0],
                effective_inertia: 1.0 / inverse_inertia(first),
                impulse: couple,
            };
            if !walls {
                rolling.curvatures[1] = curvature(second);
                rolling.effective_inertia =
                    1.0 / (inverse_inertia(first) + inverse_inertia(second));
            } else if self.turns() {
                // The spin of a container is no multiple of a radius.
                rolling.curvatures[1] = 1.0;
                let container = self.containers.greatest_inverse_inertia(second);
                rolling.effective_inertia = 1.0 / (inverse_inertia(first) + container);
            }
            self.rolling.resize(n, RollingConstraint::default());
            self.rolling.push(rolling);
        }
    }
}
