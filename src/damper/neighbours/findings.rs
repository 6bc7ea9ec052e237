//! What a step refuses of the contacts that were found.

use super::{Block, ContactId, Neighbours};
use crate::cavity::Cavity;
use crate::contact::Partner;
use crate::damper::state::State;
use crate::law::ContactLaw;
use crate::mount::Mount;
use crate::step_error::StepError;

impl<L: ContactLaw, D> Neighbours<L, D> {
    /// Refuses overlaps past the bound, and particles behind a wall if they are to be contained.
    pub(crate) fn check_overlaps<C: Cavity, M: Mount + ?Sized>(
        &self,
        state: &State<C, L, M>,
    ) -> Result<(), StepError> {
        for block in &self.blocks {
            if let (true, Some(ContactId { index, partner })) = (state.contained, block.escaped) {
                return Err(escaped(state, index, partner));
            }
            if block.largest_overlap.is_nan() || block.largest_overlap > state.overlap_limit {
                return Err(overlaps(state, block));
            }
        }
        Ok(())
    }
}

fn escaped<C: Cavity, L: ContactLaw, M: Mount + ?Sized>(
    state: &State<C, L, M>,
    index: usize,
    partner: Partner,
) -> StepError {
    let compartment = &state.model.compartments[state.model.cavity_of(index)];
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

fn overlaps<C: Cavity, L: ContactLaw, M: Mount + ?Sized>(
    state: &State<C, L, M>,
    block: &Block<L>,
) -> StepError {
    let view = state.view(0.0);
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
