//! Detection: candidates are proposed, sorted into the one order in which contacts are evaluated, and
//! narrowed down to those that touch.

use super::block::room_for;
use crate::damper::state::Vectors;
use crate::detector::Pairs;
use glam::DVec3;

use super::block::{Block, ContactHistory, Listing};
use super::list::{ContactRecord, make_room};
use crate::cavity::Cavity;
use crate::damper::engine::Engine;
use crate::damper::state::{Compartment, Particles};
use crate::detector::{Bed, Detector, DetectorError};
use crate::law::ContactLaw;
use crate::mount::Mount;
use crate::parallel::for_each;
use crate::step_error::StepError;

/// What stays between steps only to save work.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scratch {
    pub(crate) proposals: Pairs,
    /// Proposals by their lower index: ends of the rows, and the higher indices.
    pub(crate) rows: Vec<u32>,
    pub(crate) partners: Vec<u32>,
    /// Where each particle was in its container's frame when the candidates were listed.
    pub(crate) reference: Vectors,
    /// The same while candidates are listed, for detectors.
    pub(crate) local: Vec<DVec3>,
    /// Whether the candidates may still be used.
    pub(crate) listed: bool,
    /// Accelerations and angular accelerations as the evaluation before the last left them. The next
    /// one sums up forces there, and they change places.
    pub(crate) previous: [Vectors; 2],
    /// The same of the mount's coordinates.
    pub(crate) previous_of_mount: Vec<f64>,
}

impl Scratch {
    /// Scratch for a bed of `particles` and for `coordinates` of the mount.
    pub(crate) fn new(particles: &Particles, coordinates: usize) -> Self {
        let candidates = room_for(particles.len());
        let mut scratch = Self {
            reference: particles.position.clone(),
            previous: [
                particles.acceleration.clone(),
                particles.angular_acceleration.clone(),
            ],
            previous_of_mount: vec![0.0; coordinates],
            ..Self::default()
        };
        scratch.proposals.reserve(candidates);
        scratch.partners.reserve(candidates);
        scratch
    }

    /// Memory in bytes that it has reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        size_of::<DVec3>() * self.local.capacity()
            + size_of::<u32>() * (self.rows.capacity() + self.partners.capacity())
            + self.reference.reserved_bytes()
            + self
                .previous
                .each_ref()
                .map(Vectors::reserved_bytes)
                .iter()
                .sum::<usize>()
            + self.proposals.reserved_bytes()
    }
}

/// The bed of a compartment as its detector sees it, for bodies with a gap of up to `prediction_distance`
/// (m). Its positions, seen from the container, go to the end of `local`, which holds those of the
/// compartments before.
fn bed<'a, C: Cavity>(
    compartment: &Compartment<C>,
    particles: &'a Particles,
    prediction_distance: f64,
    local: &'a mut Vec<DVec3>,
) -> Bed<'a> {
    let indices = compartment.indices.clone();
    let origin = compartment.motion.position;
    let positions = indices.clone();
    local.extend(positions.map(|index| particles.position.get(index) - origin));
    Bed::new(
        &local[indices.clone()],
        &particles.radius[indices],
        compartment.cavity.bounds(),
    )
    .in_plane(compartment.cavity.is_planar())
    .with_margin(compartment.margin + prediction_distance)
}

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Lists the pairs and walls that touch now. With `afresh`, candidates without a skin are listed
    /// anew first; candidates that can no longer be trusted always are.
    pub(crate) fn find_contacts(&mut self, afresh: bool) -> Result<(), StepError> {
        let skinless = afresh
            && self
                .detectors
                .iter()
                .any(|detector| detector.skin(1.0) == 0.0);
        if skinless || !self.scratch.listed || !self.narrow() {
            self.list(None)?;
            self.narrow();
        }
        Ok(())
    }

    /// Has bodies with a gap below `prediction_distance` (m) count as in contact. Candidates are listed up
    /// to more, so that they need not be listed anew for every new speed of the bed.
    pub(crate) fn set_prediction_distance(
        &mut self,
        prediction_distance: f64,
    ) -> Result<(), StepError> {
        self.model.prediction_distance = prediction_distance;
        if prediction_distance <= self.model.listed_distance {
            return Ok(());
        }
        self.model.listed_distance = 2.0 * prediction_distance;
        self.scratch.listed = false;
        Ok(self.prepare_detectors()?)
    }

    /// Makes the detectors ready for the bed as it stands.
    pub(crate) fn prepare_detectors(&mut self) -> Result<(), DetectorError> {
        let local = &mut self.scratch.local;
        local.clear();
        for (compartment, detector) in self.model.compartments.iter().zip(&mut self.detectors) {
            detector.prepare(&bed(
                compartment,
                &self.particles,
                self.model.listed_distance,
                local,
            ))?;
        }
        Ok(())
    }

    /// Narrow phase. Returns whether the candidates could be trusted.
    fn narrow(&mut self) -> bool {
        let view = self.model.view(&self.particles, 0.0);
        let reference = self.scratch.reference.rows();
        all_blocks(&mut self.blocks, &|block| block.narrow(&view, reference))
    }

    /// Broad phase: lists candidates anew. Contacts remember what they did, or what is `saved` by
    /// [`history`](Self::history).
    pub(crate) fn list(&mut self, saved: Option<&ContactHistory<L>>) -> Result<(), StepError> {
        self.scratch.listed = false;
        self.detections += 1;
        self.check_finite()?;
        self.detect()?;
        self.list_candidates(saved);
        let view = self.model.view(&self.particles, 0.0);
        for block in &mut self.blocks {
            block.prepare(&view)?;
        }
        self.scratch.listed = true;
        Ok(())
    }

    /// Asks the detectors, and sorts their proposals into rows by the lower index.
    fn detect(&mut self) -> Result<(), StepError> {
        let count = self.particles.len();
        let scratch = &mut self.scratch;
        scratch.rows.clear();
        scratch.rows.resize(count + 1, 0);
        scratch.partners.clear();
        scratch.local.clear();
        for (compartment, detector) in self.model.compartments.iter().zip(&mut self.detectors) {
            let indices = compartment.indices.clone();
            let local = &mut scratch.local;
            let bed = bed(
                compartment,
                &self.particles,
                self.model.listed_distance,
                local,
            );
            scratch.proposals.clear();
            detector.detect(&bed, &mut scratch.proposals);
            let proposals = scratch.proposals.as_slice();
            let rows = &mut scratch.rows[indices.start..];
            for &[first, second] in proposals {
                if first == second || second as usize >= indices.len() {
                    return Err(StepError::InvalidPair {
                        first,
                        second,
                        particles: indices.len(),
                    });
                }
                rows[first as usize + 1] += 1;
            }
            let mut end = scratch.partners.len() as u32;
            rows[0] = end;
            for row in &mut rows[1..=indices.len()] {
                end += *row;
                *row = end;
            }
            // Filling a row from its end moves the end to the start.
            make_room(&mut scratch.partners, end as usize);
            scratch.partners.resize(end as usize, 0);
            for &[first, second] in proposals.iter().rev() {
                let place = &mut rows[first as usize + 1];
                *place -= 1;
                scratch.partners[*place as usize] = indices.start as u32 + second;
            }
            rows.copy_within(1..=indices.len(), 0);
            rows[indices.len()] = end;
        }
        scratch.reference.assign(scratch.local.iter().copied());
        Ok(())
    }

    /// Fills the blocks' lists from the sorted proposals, and with the walls that are near.
    fn list_candidates(&mut self, saved: Option<&ContactHistory<L>>) {
        let listing = Listing {
            view: &self.model.view(&self.particles, 0.0),
            rows: &self.scratch.rows,
            local: &self.scratch.local,
        };
        let split = |partners, blocks: &[Block<L>]| {
            let indices = blocks.first().zip(blocks.last());
            let indices =
                indices.map_or(0..0, |(first, last)| first.indices.start..last.indices.end);
            let count = listing.rows[indices.end] - listing.rows[indices.start];
            <[u32]>::split_at_mut(partners, count as usize)
        };
        let partners = self.scratch.partners.as_mut_slice();
        for_each(&mut self.blocks, partners, &split, &|block, partners| {
            self.history_pool
                .with(|buffer| block.relist(&listing, partners, saved, buffer));
            true
        });
    }

    /// Memories of all contacts, pairs and walls, by index.
    pub(crate) fn history(&self) -> ContactHistory<L> {
        let mut memory = [Vec::new(), Vec::new()];
        for block in &self.blocks {
            block.save_history(self.model.stamp, &mut memory);
        }
        memory[0].sort_unstable_by_key(ContactRecord::pair);
        memory
    }
}

/// Does `work` for all blocks, and tells whether it was good for each.
fn all_blocks<L: ContactLaw>(
    blocks: &mut [Block<L>],
    work: &(impl Fn(&mut Block<L>) -> bool + Sync),
) -> bool {
    for_each(blocks, (), &|(), _| ((), ()), &|block, ()| work(block))
}
