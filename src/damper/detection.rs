//! Detection: candidates are proposed, sorted into the one order in which contacts are evaluated, and
//! narrowed down to those that touch.

use super::candidates::Remembered;
use super::engine::Engine;
use super::error::StepError;
use crate::cavity::Cavity;
use crate::detector::{Bed, Detector};
use crate::law::ContactLaw;
use crate::mount::Mount;

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
            self.detect()?;
            self.narrow();
        }
        Ok(())
    }

    /// Narrow phase. Returns whether the candidates could be trusted.
    fn narrow(&mut self) -> bool {
        let scene = self.world.scene(&self.particles, 0.0);
        let reference = self.scratch.reference.components();
        let mut trusted = true;
        for block in &mut self.blocks {
            trusted &= block.narrow(&scene, &reference);
        }
        trusted
    }

    /// Broad phase: lists candidates, and hands the memory of contacts over to the new list.
    fn detect(&mut self) -> Result<(), StepError> {
        self.scratch.memory.iter_mut().for_each(Vec::clear);
        for block in &mut self.blocks {
            block.clear(self.world.stamp, &mut self.scratch.memory);
        }
        self.scratch.memory[0].sort_unstable_by_key(Remembered::pair);
        self.list()
    }

    /// Gives contacts the memories that [`remembered`](Self::remembered) saved.
    pub(crate) fn recall(
        &mut self,
        memory: &[Vec<Remembered<L::Memory>>; 2],
    ) -> Result<(), StepError> {
        for block in &mut self.blocks {
            block.clear(self.world.stamp, &mut self.scratch.memory);
        }
        self.scratch.memory.clone_from(memory);
        self.list()
    }

    /// Lists candidates in blocks that are empty; those that remember have their memory in the
    /// scratch.
    fn list(&mut self) -> Result<(), StepError> {
        self.scratch.listed = false;
        self.detections += 1;
        self.check_finite()?;
        self.propose()?;
        self.list_candidates();
        let scene = self.world.scene(&self.particles, 0.0);
        for block in &mut self.blocks {
            block.finish(&scene, &self.scratch.memory);
        }
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
            let origin = room.motion.position;
            let positions = slots
                .clone()
                .map(|slot| self.particles.position.get(slot) - origin);
            scratch.local.extend(positions);
            let bed = Bed::new(
                &scratch.local[slots.clone()],
                &self.particles.radius[slots.clone()],
                room.cavity.bounds(),
            )
            .in_plane(room.cavity.is_planar())
            .with_margin(room.margin + self.world.reach);
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
            scratch.partners.resize(end as usize, 0);
            for &[first, second] in proposals.iter().rev() {
                let place = &mut rows[first as usize + 1];
                *place -= 1;
                scratch.partners[*place as usize] = slots.start as u32 + second;
            }
            rows.copy_within(1..=slots.len(), 0);
            rows[slots.len()] = end;
        }
        scratch.reference.clone_from(&self.particles.position);
        scratch.reference.assign(scratch.local.iter().copied());
        Ok(())
    }

    /// Fills the blocks' empty lists from the sorted proposals, and with the walls that are near.
    fn list_candidates(&mut self) {
        let (scratch, world) = (&mut self.scratch, &self.world);
        let (radius, number) = (&self.particles.radius, &self.particles.number);
        for block in &mut self.blocks {
            for slot in block.slots.clone() {
                let row = scratch.rows[slot] as usize..scratch.rows[slot + 1] as usize;
                let partners = &mut scratch.partners[row];
                partners.sort_unstable();
                let mut last = None;
                for partner in partners
                    .iter()
                    .copied()
                    .filter(|p| last.replace(*p) != Some(*p))
                {
                    let reach = radius[slot] + radius[partner as usize] + world.reach;
                    let list = if (partner as usize) < block.slots.end {
                        &mut block.pairs
                    } else {
                        &mut block.border
                    };
                    // The one with the lower number comes first, wherever it stands.
                    let (mut first, mut second) = (slot as u32, partner);
                    if number[slot] > number[partner as usize] {
                        std::mem::swap(&mut first, &mut second);
                    }
                    list.push(first, second, reach * reach);
                }
            }
            for room in &world.rooms {
                let own = room.slots_in(&block.slots);
                let grains = radius[own.clone()].iter().zip(&scratch.local[own.clone()]);
                for (slot, (radius, point)) in own.zip(grains) {
                    let reach = radius + world.reach;
                    for wall in 0..room.cavity.walls() {
                        if room.cavity.wall(wall, *point).distance < reach + room.margin {
                            block.walls.push(slot as u32, room.first_wall + wall, reach);
                        }
                    }
                }
            }
        }
    }

    /// Memories of all contacts, pairs and walls, by slot.
    pub(crate) fn remembered(&self) -> [Vec<Remembered<L::Memory>>; 2] {
        let mut memory = [Vec::new(), Vec::new()];
        for block in &self.blocks {
            block.remember(self.world.stamp, &mut memory);
        }
        memory[0].sort_unstable_by_key(Remembered::pair);
        memory
    }
}
