//! Evaluating the contacts of a block: forces and torques on its particles, loads on the walls.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::ops::Range;

use glam::DVec3;

use super::batch::{BATCH_SIZE, Batch};
use super::report::{report_pairs, report_walls};
use crate::cavity::Cavity;
use crate::contact::{Partner, WallLoad};
use crate::damper::neighbours::{Block, ContactId, NeighbourList, make_room};
use crate::damper::state::{StateView, scale};
use crate::law::{ContactLaw, ForceLaw};
use crate::observer::Observer;

/// What a block sends to a particle of a later one.
#[derive(Debug, Clone, Copy)]
pub(super) struct HaloForce {
    pub(super) index: u32,
    pub(super) force: DVec3,
    pub(super) torque: DVec3,
}

/// What the forces of a block are evaluated with.
#[derive(Debug, Clone)]
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
    /// whether all are finite. With `END`, contacts advance their memory to step `view.stamp + 1`.
    pub(super) fn evaluate<C: Cavity, O: Observer, const END: bool>(
        &mut self,
        block: &mut Block<L>,
        view: &StateView<'_, C, L>,
        gravity: DVec3,
        sums: (&mut [f64], &mut [f64]),
        observer: &mut O,
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
            let sums = Sums::<true>::new(force, torque);
            self.evaluate_lists::<C, O, END, true>(block, view, gravity, sums, observer)
        } else {
            let sums = Sums::<false>::new(force, torque);
            self.evaluate_lists::<C, O, END, false>(block, view, gravity, sums, observer)
        }
    }

    fn evaluate_lists<C: Cavity, O: Observer, const END: bool, const PLANAR: bool>(
        &mut self,
        block: &mut Block<L>,
        view: &StateView<'_, C, L>,
        gravity: DVec3,
        mut sums: Sums<'_, PLANAR>,
        observer: &mut O,
    ) -> bool {
        let base = block.indices.start;
        let batch = &mut *self.batch;
        let mut deepest = 0.0_f64;
        batch.begin_pairs(view.coefficients.only_radius());
        let list = &mut block.pairs;
        for run in runs(list.contacts.len()) {
            evaluate_pairs::<C, L, END, PLANAR>(view, list, batch, run.clone());
            deepest = deepest.max(batch.largest_overlap());
            let bodies = &list.contacts.bodies()[run.clone()];
            for (n, [i, j]) in bodies.iter().take(BATCH_SIZE).enumerate() {
                let (i, j) = (*i as usize - base, *j as usize - base);
                let (push, [first, second]) = (batch.push(n), batch.torques(n));
                sums.add(i, push, first);
                sums.add(j, -push, second);
            }
            if END && observer.wants_contacts() {
                report_pairs(view, list, batch, run, observer);
            }
        }
        let list = &mut block.halo;
        for run in runs(list.contacts.len()) {
            evaluate_pairs::<C, L, END, PLANAR>(view, list, batch, run.clone());
            deepest = deepest.max(batch.largest_overlap());
            for (n, [i, j]) in list.contacts.bodies()[run.clone()].iter().enumerate() {
                let (push, [first, second]) = (batch.push(n), batch.torques(n));
                let both = [(*i, push, first), (*j, -push, second)];
                for (index, force, torque) in both {
                    if block.indices.contains(&(index as usize)) {
                        sums.add(index as usize - base, force, torque);
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
                report_pairs(view, list, batch, run, observer);
            }
        }
        let list = &mut block.walls;
        for run in runs(list.contacts.len()) {
            evaluate_walls::<C, L, END, PLANAR>(view, list, batch, run.clone());
            deepest = deepest.max(batch.largest_overlap());
            for (n, [index, wall]) in list.contacts.bodies()[run.clone()].iter().enumerate() {
                let (push, [turn, _]) = (batch.push(n), batch.torques(n));
                let index = *index as usize;
                sums.add(index - base, push, turn);
                let compartment = view.compartment_of_wall(*wall);
                let place = view.position.get(index) - compartment.motion.position;
                self.loads[*wall as usize].react(push, turn, place);
                if batch.overlap(n) > view.radius[index] {
                    let partner = Partner::Wall(wall - compartment.first_wall);
                    block.escaped = Some(ContactId { index, partner });
                }
            }
            if END && observer.wants_contacts() {
                report_walls(view, list, batch, run, observer);
            }
        }
        block.largest_overlap = deepest;
        sums.accelerate(view, block.indices.clone(), gravity)
    }
}

/// Where the forces and torques on the particles of a block are summed up. With `PLANAR` forces have
/// no z, and torques nothing else.
struct Sums<'a, const PLANAR: bool> {
    plane: (&'a mut [[f64; 2]], &'a mut [f64]),
    space: (&'a mut [[f64; 3]], &'a mut [[f64; 3]]),
}

impl<'a, const PLANAR: bool> Sums<'a, PLANAR> {
    fn new(force: &'a mut [f64], torque: &'a mut [f64]) -> Self {
        // Columns of one length, so that one comparison stands for both bounds.
        if PLANAR {
            let (force, _) = force.as_chunks_mut();
            let torque = &mut torque[..force.len()];
            Self {
                plane: (force, torque),
                space: (&mut [], &mut []),
            }
        } else {
            let (force, _) = force.as_chunks_mut();
            let (torque, _) = torque.as_chunks_mut();
            let torque = &mut torque[..force.len()];
            Self {
                plane: (&mut [], &mut []),
                space: (force, torque),
            }
        }
    }

    #[inline(always)]
    fn add(&mut self, n: usize, force: DVec3, torque: DVec3) {
        if PLANAR {
            let (forces, torques) = &mut self.plane;
            forces[n][0] += force.x;
            forces[n][1] += force.y;
            torques[n] += torque.z;
        } else {
            let (forces, torques) = &mut self.space;
            let add = |sum: &mut [f64; 3], vector: DVec3| {
                *sum = (DVec3::from_array(*sum) + vector).to_array();
            };
            add(&mut forces[n], force);
            add(&mut torques[n], torque);
        }
    }

    /// Turns the sums, which are those of the particles at `indices`, into accelerations. Returns whether all are finite.
    fn accelerate<C, L: ContactLaw>(
        &mut self,
        view: &StateView<'_, C, L>,
        indices: Range<usize>,
        gravity: DVec3,
    ) -> bool {
        let inverse_mass = &view.inverse_mass[indices.clone()];
        let inverse_inertia = &view.inverse_inertia[indices];
        let DVec3 { x, y, z } = gravity;
        if PLANAR {
            let (forces, torques) = &mut self.plane;
            let (torques, _) = torques.as_chunks_mut();
            scale(forces, inverse_mass, [x, y]) & scale(torques, inverse_inertia, [0.0])
        } else {
            let (forces, torques) = &mut self.space;
            scale(forces, inverse_mass, [x, y, z]) & scale(torques, inverse_inertia, [0.0; 3])
        }
    }
}

/// Runs of at most [`BATCH_SIZE`] contacts, one after the other.
fn runs(contacts: usize) -> impl Iterator<Item = Range<usize>> {
    let starts = (0..contacts).step_by(BATCH_SIZE);
    starts.map(move |start| start..contacts.min(start + BATCH_SIZE))
}

/// Has the law answer a run of touching pairs.
#[inline(always)]
fn evaluate_pairs<C: Cavity, L: ForceLaw, const END: bool, const PLANAR: bool>(
    view: &StateView<'_, C, L>,
    list: &mut NeighbourList<L>,
    batch: &mut Batch<L>,
    run: Range<usize>,
) {
    let bodies = &list.contacts.bodies()[run.clone()];
    let candidates = &list.contacts.candidates()[run.clone()];
    batch.gather_pairs::<C, PLANAR>(view, bodies);
    list.load_memories(run.clone(), view.stamp, batch.memory_mut());
    let kinds = bodies.iter().zip(candidates).map(|([i, j], candidate)| {
        let first = view.species[*i as usize];
        let second = view.species[*j as usize];
        let own = list.prepared(*candidate);
        view.coefficients.pair(first, second, own)
    });
    let only = view.coefficients.only_pair();
    batch.evaluate::<true, END, PLANAR>(view.law, only, kinds, view.step_time);
    if view.law.corrects_onset() {
        let acceleration = |n: usize| acceleration_of_pair(view, bodies[n]);
        batch.correct_onsets::<true, END>(view.law, only, view.step_time, acceleration);
    }
    if END {
        list.store_memories(run, view.stamp.wrapping_add(1), batch.advanced());
    }
}

/// Has the law answer a run of touching walls.
#[inline(always)]
fn evaluate_walls<C: Cavity, L: ForceLaw, const END: bool, const PLANAR: bool>(
    view: &StateView<'_, C, L>,
    list: &mut NeighbourList<L>,
    batch: &mut Batch<L>,
    run: Range<usize>,
) {
    let bodies = &list.contacts.bodies()[run.clone()];
    batch.gather_walls::<C>(view, bodies);
    list.load_memories(run.clone(), view.stamp, batch.memory_mut());
    let kinds = bodies.iter().map(|[index, _]| {
        let species = view.species[*index as usize];
        *view.coefficients.wall(species)
    });
    let only = view.coefficients.only_wall();
    batch.evaluate::<false, END, PLANAR>(view.law, only, kinds, view.step_time);
    if view.law.corrects_onset() {
        let acceleration = |n: usize| view.acceleration.get(bodies[n][0] as usize);
        batch.correct_onsets::<false, END>(view.law, only, view.step_time, acceleration);
    }
    if END {
        list.store_memories(run, view.stamp.wrapping_add(1), batch.advanced());
    }
}

/// How the centre of the first body was accelerated relative to that of the second when forces were
/// evaluated last, in m/s^2.
pub(super) fn acceleration_of_pair<C: Cavity, L: ContactLaw>(
    view: &StateView<'_, C, L>,
    bodies: [u32; 2],
) -> DVec3 {
    let [first, second] = bodies.map(|index| view.acceleration.get(index as usize));
    first - second
}
