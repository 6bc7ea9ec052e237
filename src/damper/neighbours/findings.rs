//! What contacts were found, and what a step refuses of them.

use super::{Block, ContactId, Neighbours};
use crate::cavity::Cavity;
use crate::contact::Partner;
use crate::damper::state::{Model, State};
use crate::law::ContactLaw;
use crate::step_error::StepError;

impl<L: ContactLaw> Neighbours<L> {
    /// How many contacts there were when they were evaluated last.
    pub(crate) fn contacts(&self) -> usize {
        self.blocks.iter().map(|block| block.contacts).sum()
    }

    /// The largest overlap then, m.
    pub(crate) fn largest_overlap(&self) -> f64 {
        let overlaps = self.blocks.iter().map(|block| block.largest_overlap);
        overlaps.fold(0.0, f64::max)
    }

    /// Refuses overlaps past the bound, and particles behind a wall if they are to be contained.
    pub(crate) fn check_overlaps<C: Cavity>(
        &self,
        model: &Model<C, L>,
        state: &State,
    ) -> Result<(), StepError> {
        for block in &self.blocks {
            if let (true, Some(ContactId { index, partner })) = (state.contained, block.escaped) {
                return Err(escaped(state, index, partner));
            }
            if block.largest_overlap.is_nan() || block.largest_overlap > state.overlap_limit {
                return Err(overlaps(model, state, block));
            }
        }
        Ok(())
    }
}

fn escaped(state: &State, index: usize, partner: Partner) -> StepError {
    let compartment = &state.compartments[state.cavity_of(index)];
    StepError::Escaped {
        particle: state.particles.id[index] as usize,
        wall: match partner {
            Partner::Wall(wall) => wall,
            Partner::Particle(_) => 0,
        },
        position: compartment.to_local(state.particles.position.get(index)),
        cause: state.cause(),
    }
}

fn overlaps<C: Cavity, L: ContactLaw>(
    model: &Model<C, L>,
    state: &State,
    block: &Block<L>,
) -> StepError {
    let view = state.view(model, 0.0);
    let place = block.deepest(&view);
    let (index, other) = place.map_or((block.indices.start, Partner::Wall(0)), |place| {
        (place.index, place.partner)
    });
    StepError::Overlap {
        particle: state.particles.id[index] as usize,
        other,
        overlap: block.largest_overlap,
        limit: state.overlap_limit,
        cause: state.cause(),
    }
}
