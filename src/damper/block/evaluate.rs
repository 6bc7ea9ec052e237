//! Evaluating the contacts of a block: forces and torques on its particles, loads on the walls.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::ops::Range;

use glam::DVec3;

use super::report::{report_pairs, report_walls};
use super::{Block, Parcel, Place};
use crate::cavity::Cavity;
use crate::damper::Partner;
use crate::damper::candidates::Candidates;
use crate::damper::chunk::{CHUNK, Chunk};
use crate::damper::scene::{Scene, WallLoad};
use crate::damper::vectors::scale;
use crate::law::{ContactLaw, ForceLaw};
use crate::observer::Observer;

impl<L: ForceLaw> Block<L> {
    /// Evaluates all contacts of the block, and turns forces and torques on its own slots, for which
    /// there is room in `sums`, into accelerations; parcels of other blocks are not among them. Returns
    /// whether all are finite. With `END`, contacts advance their memory to step `scene.stamp + 1`.
    pub(crate) fn evaluate<C: Cavity, O: Observer, const END: bool>(
        &mut self,
        scene: &Scene<'_, C, L>,
        gravity: DVec3,
        sums: (&mut [f64], &mut [f64]),
        observer: &mut O,
    ) -> bool {
        let (force, torque) = sums;
        force.fill(0.0);
        torque.fill(0.0);
        self.loads.fill(WallLoad::default());
        self.parcels.clear();
        self.forget();
        self.contacts = self.contacts_in_reach();
        if scene.planar {
            let sums = Sums::<true>::new(force, torque);
            self.evaluate_lists::<C, O, END, true>(scene, gravity, sums, observer)
        } else {
            let sums = Sums::<false>::new(force, torque);
            self.evaluate_lists::<C, O, END, false>(scene, gravity, sums, observer)
        }
    }

    fn evaluate_lists<C: Cavity, O: Observer, const END: bool, const PLANAR: bool>(
        &mut self,
        scene: &Scene<'_, C, L>,
        gravity: DVec3,
        mut sums: Sums<'_, PLANAR>,
        observer: &mut O,
    ) -> bool {
        let base = self.slots.start;
        let chunk = &mut *self.chunk;
        let mut deepest = 0.0_f64;
        chunk.begin_pairs(scene.coefficients.only_radius());
        let list = &mut self.pairs;
        for run in runs(list.contacts.len()) {
            answer_pairs::<C, L, END, PLANAR>(scene, list, chunk, run.clone());
            deepest = deepest.max(chunk.largest_overlap());
            let bodies = &list.contacts.bodies()[run.clone()];
            for (n, [i, j]) in bodies.iter().take(CHUNK).enumerate() {
                let (i, j) = (*i as usize - base, *j as usize - base);
                let (push, [first, second]) = (chunk.push(n), chunk.torques(n));
                sums.add(i, push, first);
                sums.add(j, -push, second);
            }
            if END && observer.wants_contacts() {
                report_pairs(scene, list, chunk, run, observer);
            }
        }
        let list = &mut self.border;
        for run in runs(list.contacts.len()) {
            answer_pairs::<C, L, END, PLANAR>(scene, list, chunk, run.clone());
            deepest = deepest.max(chunk.largest_overlap());
            for (n, [i, j]) in list.contacts.bodies()[run.clone()].iter().enumerate() {
                let (push, [first, second]) = (chunk.push(n), chunk.torques(n));
                let both = [(*i, push, first), (*j, -push, second)];
                for (slot, force, torque) in both {
                    if self.slots.contains(&(slot as usize)) {
                        sums.add(slot as usize - base, force, torque);
                    } else {
                        self.parcels.push(Parcel {
                            slot,
                            force,
                            torque,
                        });
                    }
                }
            }
            if END && observer.wants_contacts() {
                report_pairs(scene, list, chunk, run, observer);
            }
        }
        let list = &mut self.walls;
        for run in runs(list.contacts.len()) {
            answer_walls::<C, L, END, PLANAR>(scene, list, chunk, run.clone());
            deepest = deepest.max(chunk.largest_overlap());
            for (n, [slot, wall]) in list.contacts.bodies()[run.clone()].iter().enumerate() {
                let (push, [turn, _]) = (chunk.push(n), chunk.torques(n));
                let slot = *slot as usize;
                sums.add(slot - base, push, turn);
                let room = scene.room_of_wall(*wall);
                let place = scene.position.get(slot) - room.motion.position;
                self.loads[*wall as usize].react(push, turn, place);
                if chunk.overlap(n) > scene.radius[slot] {
                    let partner = Partner::Wall(wall - room.first_wall);
                    self.escaped = Some(Place { slot, partner });
                }
            }
            if END && observer.wants_contacts() {
                report_walls(scene, list, chunk, run, observer);
            }
        }
        self.largest_overlap = deepest;
        sums.accelerate(scene, self.slots.clone(), gravity)
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

    /// Turns the sums, which are those of `slots`, into accelerations. Returns whether all are finite.
    fn accelerate<C, L: ContactLaw>(
        &mut self,
        scene: &Scene<'_, C, L>,
        slots: Range<usize>,
        gravity: DVec3,
    ) -> bool {
        let inverse_mass = &scene.inverse_mass[slots.clone()];
        let inverse_inertia = &scene.inverse_inertia[slots];
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

/// Runs of at most [`CHUNK`] contacts, one after the other.
fn runs(contacts: usize) -> impl Iterator<Item = Range<usize>> {
    let starts = (0..contacts).step_by(CHUNK);
    starts.map(move |start| start..contacts.min(start + CHUNK))
}

/// Has the law answer a run of touching pairs.
#[inline(always)]
fn answer_pairs<C: Cavity, L: ForceLaw, const END: bool, const PLANAR: bool>(
    scene: &Scene<'_, C, L>,
    list: &mut Candidates<L>,
    chunk: &mut Chunk<L>,
    run: Range<usize>,
) {
    let bodies = &list.contacts.bodies()[run.clone()];
    let places = &list.contacts.places()[run.clone()];
    chunk.gather_pairs::<C, PLANAR>(scene, bodies);
    list.recall(run.clone(), scene.stamp, chunk.memory_mut());
    let kinds = bodies.iter().zip(places).map(|([i, j], place)| {
        let first = scene.species[*i as usize];
        let second = scene.species[*j as usize];
        let own = list.prepared(*place);
        scene.coefficients.pair(first, second, own)
    });
    let only = scene.coefficients.only_pair();
    chunk.answer::<true, END, PLANAR>(scene.law, only, kinds, scene.moment);
    if scene.law.corrects_onset() {
        let acceleration = |n: usize| acceleration_of_pair(scene, bodies[n]);
        chunk.correct_onsets::<true, END>(scene.law, only, scene.moment, acceleration);
    }
    if END {
        list.keep_run(run, scene.stamp.wrapping_add(1), chunk.advanced());
    }
}

/// Has the law answer a run of touching walls.
#[inline(always)]
fn answer_walls<C: Cavity, L: ForceLaw, const END: bool, const PLANAR: bool>(
    scene: &Scene<'_, C, L>,
    list: &mut Candidates<L>,
    chunk: &mut Chunk<L>,
    run: Range<usize>,
) {
    let bodies = &list.contacts.bodies()[run.clone()];
    chunk.gather_walls::<C>(scene, bodies);
    list.recall(run.clone(), scene.stamp, chunk.memory_mut());
    let kinds = bodies.iter().map(|[slot, _]| {
        let species = scene.species[*slot as usize];
        *scene.coefficients.wall(species)
    });
    let only = scene.coefficients.only_wall();
    chunk.answer::<false, END, PLANAR>(scene.law, only, kinds, scene.moment);
    if scene.law.corrects_onset() {
        let acceleration = |n: usize| scene.acceleration.get(bodies[n][0] as usize);
        chunk.correct_onsets::<false, END>(scene.law, only, scene.moment, acceleration);
    }
    if END {
        list.keep_run(run, scene.stamp.wrapping_add(1), chunk.advanced());
    }
}

/// How the centre of the first body was accelerated relative to that of the second when forces were
/// evaluated last, in m/s^2.
pub(super) fn acceleration_of_pair<C: Cavity, L: ContactLaw>(
    scene: &Scene<'_, C, L>,
    bodies: [u32; 2],
) -> DVec3 {
    let [first, second] = bodies.map(|slot| scene.acceleration.get(slot as usize));
    first - second
}
