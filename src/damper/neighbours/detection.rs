//! Detection: candidates are proposed, sorted into the one order in which contacts are evaluated, and
//! narrowed down to those that touch.

use glam::DVec3;

use super::Neighbours;
use super::block::{Block, ContactHistory, Listing};
use super::columns::make_room;
use super::history::ContactRecord;
use crate::cavity::Cavity;
use crate::damper::state::{Compartment, Model, Particles, State, StateView};
use crate::detector::{Bed, Detector, DetectorError};
use crate::law::ContactLaw;
use crate::parallel::for_each;
use crate::step_error::StepError;

/// The detectors of a damper, one for each cavity, whatever their type.
pub(crate) trait Detectors {
    /// That of a cavity.
    fn of(&mut self, cavity: usize) -> &mut dyn Detector;
}

impl<D: Detector> Detectors for Vec<D> {
    fn of(&mut self, cavity: usize) -> &mut dyn Detector {
        &mut self[cavity]
    }
}

/// The bed of a compartment as its detector sees it, for bodies with a gap of up to `prediction_distance`
/// (m). Its positions, seen from the container, go to the end of `local`, which holds those of the
/// compartments before.
fn bed<'a>(
    compartment: &Compartment,
    particles: &'a Particles,
    prediction_distance: f64,
    local: &'a mut Vec<DVec3>,
) -> Bed<'a> {
    let indices = compartment.indices.clone();
    let positions = indices.clone();
    local.extend(positions.map(|index| compartment.to_local(particles.position.get(index))));
    Bed::new(
        &local[indices.clone()],
        &particles.radius[indices],
        compartment.bounds,
    )
    .in_plane(compartment.planar)
    .with_margin(compartment.margin + prediction_distance)
}

impl<L: ContactLaw> Neighbours<L> {
    /// Lists the pairs and walls that touch now. With `afresh`, candidates without a skin are listed
    /// anew first; candidates that can no longer be trusted always are.
    pub(crate) fn find_contacts<C: Cavity>(
        &mut self,
        model: &Model<C, L>,
        state: &State,
        detectors: &mut dyn Detectors,
        afresh: bool,
    ) -> Result<(), StepError> {
        let mut cavities = 0..state.compartments.len();
        let skinless = afresh && cavities.any(|cavity| detectors.of(cavity).skin(1.0) == 0.0);
        if skinless || !self.listed || !self.narrow(model, state) {
            self.list(model, state, detectors, None)?;
            self.narrow(model, state);
        }
        Ok(())
    }

    /// Has bodies with a gap below `prediction_distance` (m) count as in contact. Candidates are listed up
    /// to more, so that they need not be listed anew for every new speed of the bed.
    pub(crate) fn set_prediction_distance(
        &mut self,
        state: &State,
        detectors: &mut dyn Detectors,
        prediction_distance: f64,
    ) -> Result<(), StepError> {
        self.prediction_distance = prediction_distance;
        if prediction_distance <= self.listed_distance {
            return Ok(());
        }
        self.listed_distance = 2.0 * prediction_distance;
        self.listed = false;
        Ok(self.prepare_detectors(state, detectors)?)
    }

    /// Makes the detectors ready for the bed as it stands.
    pub(crate) fn prepare_detectors(
        &mut self,
        state: &State,
        detectors: &mut dyn Detectors,
    ) -> Result<(), DetectorError> {
        let local = &mut self.local;
        local.clear();
        for (cavity, compartment) in state.compartments.iter().enumerate() {
            let bed = bed(compartment, &state.particles, self.listed_distance, local);
            detectors.of(cavity).prepare(&bed)?;
        }
        Ok(())
    }

    /// Narrow phase. Returns whether the candidates could be trusted.
    fn narrow<C: Cavity>(&mut self, model: &Model<C, L>, state: &State) -> bool {
        let view = state.view(model, 0.0);
        let reference = self.reference.rows();
        let distance = self.prediction_distance;
        all_blocks(&mut self.blocks, &|block| {
            block.narrow(&view, reference, distance)
        })
    }

    /// Broad phase: lists candidates anew. Contacts remember what they did, or what is `saved` by
    /// [`history`](Self::history).
    pub(crate) fn list<C: Cavity>(
        &mut self,
        model: &Model<C, L>,
        state: &State,
        detectors: &mut dyn Detectors,
        saved: Option<&ContactHistory<L>>,
    ) -> Result<(), StepError> {
        self.listed = false;
        self.detections += 1;
        state.check_finite()?;
        self.detect(state, detectors)?;
        let view = state.view(model, 0.0);
        self.list_candidates(&view, saved);
        for block in &mut self.blocks {
            block.prepare(&view)?;
        }
        self.listed = true;
        Ok(())
    }

    /// Asks the detectors, and sorts their proposals into rows by the lower index.
    fn detect(&mut self, state: &State, detectors: &mut dyn Detectors) -> Result<(), StepError> {
        let count = state.particles.len();
        self.rows.clear();
        self.rows.resize(count + 1, 0);
        self.partners.clear();
        self.local.clear();
        for (cavity, compartment) in state.compartments.iter().enumerate() {
            let indices = compartment.indices.clone();
            let local = &mut self.local;
            let bed = bed(compartment, &state.particles, self.listed_distance, local);
            self.proposals.clear();
            detectors.of(cavity).detect(&bed, &mut self.proposals);
            let proposals = self.proposals.as_slice();
            let rows = &mut self.rows[indices.start..];
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
            let mut end = self.partners.len() as u32;
            rows[0] = end;
            for row in &mut rows[1..=indices.len()] {
                end += *row;
                *row = end;
            }
            // Filling a row from its end moves the end to the start.
            make_room(&mut self.partners, end as usize);
            self.partners.resize(end as usize, 0);
            for &[first, second] in proposals.iter().rev() {
                let place = &mut rows[first as usize + 1];
                *place -= 1;
                self.partners[*place as usize] = indices.start as u32 + second;
            }
            rows.copy_within(1..=indices.len(), 0);
            rows[indices.len()] = end;
        }
        self.reference.assign(self.local.iter().copied());
        Ok(())
    }

    /// Fills the blocks' lists from the sorted proposals, and with the walls that are near.
    fn list_candidates<C: Cavity>(
        &mut self,
        view: &StateView<'_, C, L>,
        saved: Option<&ContactHistory<L>>,
    ) {
        let listing = Listing {
            view,
            rows: &self.rows,
            local: &self.local,
            listed_distance: self.listed_distance,
        };
        let split = |partners, blocks: &[Block<L>]| {
            let indices = blocks.first().zip(blocks.last());
            let indices =
                indices.map_or(0..0, |(first, last)| first.indices.start..last.indices.end);
            let count = listing.rows[indices.end] - listing.rows[indices.start];
            <[u32]>::split_at_mut(partners, count as usize)
        };
        let partners = self.partners.as_mut_slice();
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
            block.save_history(&mut memory);
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
