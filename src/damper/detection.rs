//! Detection: candidates are proposed, sorted into the one order in which contacts are evaluated, and
//! narrowed down to those that touch.

use glam::DVec3;

use super::block::{Block, Listing, Memories};
use super::candidates::{Remembered, make_room};
use super::engine::Engine;
use super::error::StepError;
use super::particles::Particles;
use super::scene::Room;
use crate::cavity::Cavity;
use crate::detector::{Bed, Detector, DetectorError};
use crate::law::ContactLaw;
use crate::mount::Mount;
use crate::parallel::for_each;

/// The bed of a room as its detector sees it, for bodies with a gap of up to `reach` (m). Its places, seen
/// from the container, go to the end of `local`, which holds those of the rooms before.
fn bed<'a, C: Cavity>(
    room: &Room<C>,
    particles: &'a Particles,
    reach: f64,
    local: &'a mut Vec<DVec3>,
) -> Bed<'a> {
    let slots = room.slots.clone();
    let origin = room.motion.position;
    let positions = slots.clone();
    local.extend(positions.map(|slot| particles.position.get(slot) - origin));
    Bed::new(
        &local[slots.clone()],
        &particles.radius[slots],
        room.cavity.bounds(),
    )
    .in_plane(room.cavity.is_planar())
    .with_margin(room.margin + reach)
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

    /// Has bodies with a gap below `reach` (m) count as in contact. Candidates are listed up to more, so
    /// that they need not be listed anew for every new speed of the bed.
    pub(crate) fn reach_out(&mut self, reach: f64) -> Result<(), StepError> {
        self.world.reach = reach;
        if reach <= self.world.listed {
            return Ok(());
        }
        self.world.listed = 2.0 * reach;
        self.scratch.listed = false;
        Ok(self.prepare_detectors()?)
    }

    /// Makes the detectors ready for the bed as it stands.
    pub(crate) fn prepare_detectors(&mut self) -> Result<(), DetectorError> {
        let local = &mut self.scratch.local;
        local.clear();
        for (room, detector) in self.world.rooms.iter().zip(&mut self.detectors) {
            detector.prepare(&bed(room, &self.particles, self.world.listed, local))?;
        }
        Ok(())
    }

    /// Narrow phase. Returns whether the candidates could be trusted.
    fn narrow(&mut self) -> bool {
        let scene = self.world.scene(&self.particles, 0.0);
        let reference = self.scratch.reference.rows();
        all_blocks(&mut self.blocks, &|block| block.narrow(&scene, reference))
    }

    /// Broad phase: lists candidates anew. Contacts remember what they did, or what is `saved` by
    /// [`remembered`](Self::remembered).
    pub(crate) fn list(&mut self, saved: Option<&Memories<L>>) -> Result<(), StepError> {
        self.scratch.listed = false;
        self.detections += 1;
        self.check_finite()?;
        self.propose()?;
        self.list_candidates(saved);
        let scene = self.world.scene(&self.particles, 0.0);
        for block in &mut self.blocks {
            block.prepare(&scene)?;
        }
        self.scratch.listed = true;
        Ok(())
    }

    /// Asks the detectors, and sorts their proposals into rows by the lower slot.
    fn propose(&mut self) -> Result<(), StepError> {
        let count = self.particles.len();
        let scratch = &mut self.scratch;
        scratch.rows.clear();
        scratch.rows.resize(count + 1, 0);
        scratch.partners.clear();
        scratch.local.clear();
        for (room, detector) in self.world.rooms.iter().zip(&mut self.detectors) {
            let slots = room.slots.clone();
            let local = &mut scratch.local;
            let bed = bed(room, &self.particles, self.world.listed, local);
            scratch.proposals.clear();
            detector.detect(&bed, &mut scratch.proposals);
            let proposals = scratch.proposals.as_slice();
            let rows = &mut scratch.rows[slots.start..];
            for &[first, second] in proposals {
                if first == second || second as usize >= slots.len() {
                    return Err(StepError::InvalidPair {
                        first,
                        second,
                        particles: slots.len(),
                    });
                }
                rows[first as usize + 1] += 1;
            }
            let mut end = scratch.partners.len() as u32;
            rows[0] = end;
            for row in &mut rows[1..=slots.len()] {
                end += *row;
                *row = end;
            }
            // Filling a row from its end moves the end to the start.
            make_room(&mut scratch.partners, end as usize);
            scratch.partners.resize(end as usize, 0);
            for &[first, second] in proposals.iter().rev() {
                let place = &mut rows[first as usize + 1];
                *place -= 1;
                scratch.partners[*place as usize] = slots.start as u32 + second;
            }
            rows.copy_within(1..=slots.len(), 0);
            rows[slots.len()] = end;
        }
        scratch.reference.assign(scratch.local.iter().copied());
        Ok(())
    }

    /// Fills the blocks' lists from the sorted proposals, and with the walls that are near.
    fn list_candidates(&mut self, saved: Option<&Memories<L>>) {
        let listing = Listing {
            scene: &self.world.scene(&self.particles, 0.0),
            rows: &self.scratch.rows,
            local: &self.scratch.local,
        };
        let split = |partners, blocks: &[Block<L>]| {
            let slots = blocks.first().zip(blocks.last());
            let slots = slots.map_or(0..0, |(first, last)| first.slots.start..last.slots.end);
            let count = listing.rows[slots.end] - listing.rows[slots.start];
            <[u32]>::split_at_mut(partners, count as usize)
        };
        let partners = self.scratch.partners.as_mut_slice();
        for_each(&mut self.blocks, partners, &split, &|block, partners| {
            self.memories
                .with(|buffer| block.relist(&listing, partners, saved, buffer));
            true
        });
    }

    /// Memories of all contacts, pairs and walls, by slot.
    pub(crate) fn remembered(&self) -> Memories<L> {
        let mut memory = [Vec::new(), Vec::new()];
        for block in &self.blocks {
            block.remember(self.world.stamp, &mut memory);
        }
        memory[0].sort_unstable_by_key(Remembered::pair);
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
