//! Evaluating the contacts of a block: forces and torques on its particles, loads on the walls.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::ops::Range;

use glam::DVec3;

use super::batch::{BATCH_SIZE, Batch, SpherePair, SphereWall, side_by_side};
use super::report::{report_pairs, report_walls};
use super::sums::Sums;
use crate::cavity::Cavity;
use crate::contact::{Partner, WallLoad};
use crate::damper::neighbours::{Block, ContactId, Run, make_room};
use crate::damper::state::{Plane, Space, StateView, Volume, react};
use crate::law::{ContactLaw, ContactMemory, ForceLaw};
use crate::observer::Observer;

/// What a block sends to a particle of a later one.
#[derive(Debug, Clone, Copy)]
pub(super) struct HaloForce {
    pub(super) index: u32,
    pub(super) force: DVec3,
    pub(super) torque: DVec3,
}

/// What the forces of a block are evaluated with.
#[derive(Clone)]
pub(super) struct BlockForces<L: ContactLaw> {
    pub(super) halo_forces: Vec<HaloForce>,
    /// On each wall, all cavities in turn.
    pub(super) loads: Vec<WallLoad>,
    batch: Box<Batch<L>>,
}

impl<L: ContactLaw> BlockForces<L> {
    pub(super) fn new(walls: usize) -> Self {
        Self {
            halo_forces: Vec::new(),
            loads: vec![WallLoad::default(); walls],
            batch: Box::default(),
        }
    }

    /// Memory in bytes that is reserved.
    pub(super) fn reserved_bytes(&self) -> usize {
        size_of::<HaloForce>() * self.halo_forces.capacity()
    }
}

impl<L: ForceLaw> BlockForces<L> {
    /// Evaluates all contacts of a block, and turns forces and torques on its own particles, for which
    /// there is room in `sums`, into accelerations; halo forces of other blocks are not among them. Returns
    /// whether all are finite. With `END`, contacts advance their memory.
    pub(super) fn evaluate<C: Cavity, const END: bool>(
        &mut self,
        block: &mut Block<L>,
        view: &StateView<'_, C, L>,
        gravity: DVec3,
        sums: (&mut [f64], &mut [f64]),
        observer: &mut dyn Observer,
    ) -> bool {
        let (force, torque) = sums;
        force.fill(0.0);
        torque.fill(0.0);
        self.loads.fill(WallLoad::default());
        self.halo_forces.clear();
        make_room(&mut self.halo_forces, block.halo.len());
        block.clear_results();
        block.contacts = block.contact_count();
        if view.planar {
            let sums = Sums::<Plane>::new(force, torque, block.indices.start);
            self.evaluate_lists::<C, Plane, END>(block, view, gravity, sums, observer)
        } else {
            let sums = Sums::<Volume>::new(force, torque, block.indices.start);
            self.evaluate_lists::<C, Volume, END>(block, view, gravity, sums, observer)
        }
    }

    fn evaluate_lists<C: Cavity, S: Space, const END: bool>(
        &mut self,
        block: &mut Block<L>,
        view: &StateView<'_, C, L>,
        gravity: DVec3,
        mut sums: Sums<'_, S>,
        observer: &mut dyn Observer,
    ) -> bool {
        self.batch.begin_pairs(view.coefficients.only_radius());
        for list in [&mut block.pairs, &mut block.halo, &mut block.walls] {
            list.begin_runs();
        }
        let deepest = [
            self.add_pairs::<C, S, END>(block, view, &mut sums, observer),
            self.add_halo::<C, S, END>(block, view, &mut sums, observer),
            self.add_walls::<C, S, END>(block, view, &mut sums, observer),
        ];
        if END {
            for list in [&mut block.pairs, &mut block.halo, &mut block.walls] {
                list.advance_memories();
            }
        }
        block.largest_overlap = deepest.into_iter().fold(0.0, f64::max);
        sums.accelerate(view, block.indices.clone(), gravity)
    }

    /// Adds the forces of the pairs within the block. Returns the largest overlap in m.
    #[allow(clippy::needless_range_loop)] // See `side_by_side`.
    fn add_pairs<C: Cavity, S: Space, const END: bool>(
        &mut self,
        block: &mut Block<L>,
        view: &StateView<'_, C, L>,
        sums: &mut Sums<'_, S>,
        observer: &mut dyn Observer,
    ) -> f64 {
        let (list, batch) = (&mut block.pairs, &mut *self.batch);
        let mut deepest = 0.0_f64;
        for run in runs(list.contacts.len()) {
            let (run, advanced) = list.run(run);
            evaluate_pairs::<C, L, S, END>(view, &run, advanced, batch);
            deepest = deepest.max(batch.largest_overlap());
            let bodies = side_by_side(run.bodies);
            for n in 0..bodies.len() {
                let [i, j] = &bodies[n];
                let (push, [first, second]) = (batch.push(n), batch.torques(n));
                sums.add(*i as usize, push, first);
                sums.add(*j as usize, -push, second);
            }
            if END && observer.wants_contacts() {
                report_pairs::<C, L, S>(view, &run, batch, observer);
            }
        }
        deepest
    }

    /// Adds the forces of pairs with particles of later blocks, as far as they act on this one, and keeps
    /// the rest as halo forces. Returns the largest overlap in m.
    fn add_halo<C: Cavity, S: Space, const END: bool>(
        &mut self,
        block: &mut Block<L>,
        view: &StateView<'_, C, L>,
        sums: &mut Sums<'_, S>,
        observer: &mut dyn Observer,
    ) -> f64 {
        let (list, batch) = (&mut block.halo, &mut *self.batch);
        let mut deepest = 0.0_f64;
        for run in runs(list.contacts.len()) {
            let (run, advanced) = list.run(run);
            evaluate_pairs::<C, L, S, END>(view, &run, advanced, batch);
            deepest = deepest.max(batch.largest_overlap());
            for (n, [i, j]) in run.bodies.iter().enumerate() {
                let (push, [first, second]) = (batch.push(n), batch.torques(n));
                let both = [(*i, push, first), (*j, -push, second)];
                for (index, force, torque) in both {
                    if block.indices.contains(&(index as usize)) {
                        sums.add(index as usize, force, torque);
                    } else {
                        self.halo_forces.push(HaloForce {
                            index,
                            force,
                            torque,
                        });
                    }
                }
            }
            if END && observer.wants_contacts() {
                report_pairs::<C, L, S>(view, &run, batch, observer);
            }
        }
        deepest
    }

    /// Adds the forces of the walls, and the loads on them. Returns the largest overlap in m.
    #[allow(clippy::needless_range_loop)] // See `side_by_side`.
    fn add_walls<C: Cavity, S: Space, const END: bool>(
        &mut self,
        block: &mut Block<L>,
        view: &StateView<'_, C, L>,
        sums: &mut Sums<'_, S>,
        observer: &mut dyn Observer,
    ) -> f64 {
        let (list, batch) = (&mut block.walls, &mut *self.batch);
        let position = S::rows(view.position.flat());
        let mut deepest = 0.0_f64;
        for run in runs(list.contacts.len()) {
            let (run, advanced) = list.run(run);
            evaluate_walls::<C, L, S, END>(view, &run, advanced, batch);
            deepest = deepest.max(batch.largest_overlap());
            let bodies = side_by_side(run.bodies);
            for n in 0..bodies.len() {
                let [index, wall] = &bodies[n];
                let (push, [turn, _]) = (batch.push(n), batch.torques(n));
                let index = *index as usize;
                sums.add(index, push, turn);
                let compartment = view.compartment_of_wall(*wall);
                let arm = S::from_row(position[index]) - S::vector(compartment.motion.position);
                react::<S>(&mut self.loads[*wall as usize], push, turn, arm);
                if batch.overlap(n) > view.radius[index] {
                    let partner = Partner::Wall(wall - compartment.first_wall);
                    block.escaped = Some(ContactId { index, partner });
                }
            }
            if END && observer.wants_contacts() {
                report_walls::<C, L, S>(view, &run, batch, observer);
            }
        }
        deepest
    }
}

/// Runs of at most [`BATCH_SIZE`] contacts, one after the other.
fn runs(contacts: usize) -> impl Iterator<Item = Range<usize>> {
    let starts = (0..contacts).step_by(BATCH_SIZE);
    starts.map(move |start| start..contacts.min(start + BATCH_SIZE))
}

/// Has the law answer a run of touching pairs.
#[inline(always)]
fn evaluate_pairs<C: Cavity, L: ForceLaw, S: Space, const END: bool>(
    view: &StateView<'_, C, L>,
    run: &Run<'_, L>,
    advanced: &mut [ContactMemory<L>],
    batch: &mut Batch<L>,
) {
    batch.gather_pairs::<C, S>(view, run.bodies);
    batch.evaluate::<SpherePair, S, END>(
        view.law,
        view.coefficients.only_pair(),
        (0..run.bodies.len()).map(|n| run.pair_coefficients(view, n)),
        view.step_time,
        (run.memory, advanced),
        |n| view.acceleration_of_pair(run.bodies[n]),
    );
}

/// Has the law answer a run of touching walls.
#[inline(always)]
fn evaluate_walls<C: Cavity, L: ForceLaw, S: Space, const END: bool>(
    view: &StateView<'_, C, L>,
    run: &Run<'_, L>,
    advanced: &mut [ContactMemory<L>],
    batch: &mut Batch<L>,
) {
    batch.gather_walls::<C, S>(view, run.bodies);
    let indices = run.bodies.iter().map(|[index, _]| *index as usize);
    batch.evaluate::<SphereWall, S, END>(
        view.law,
        view.coefficients.only_wall(),
        indices.map(|index| *view.coefficients.wall(view.species[index])),
        view.step_time,
        (run.memory, advanced),
        |n| view.acceleration_at_wall(run.bodies[n][0] as usize, run.bodies[n][1]),
    );
}
