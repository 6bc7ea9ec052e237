//! Spatial sorting: particles that are near one another get near indices, so that a large bed uses the
//! caches. Nobody outside notices: particles keep their numbers.
//!
//! When a bed is sorted depends on its size and on the count of steps alone, and the order on where
//! the particles are: so results are the same bits with every detector, and after a restart.

use glam::DVec3;

use super::Neighbours;
use super::block::BLOCK;
use super::detection::Detectors;
use super::history::ContactRecord;
use crate::cavity::Cavity;
use crate::damper::state::{Model, Particles, State};
use crate::law::ContactLaw;
use crate::step_error::StepError;

/// Steps between two sorts: a particle that moves by a tenth of its radius per step crosses the bed's
/// neighbourhoods in some hundred steps, and a sort costs as much as a few steps.
const INTERVAL: u32 = 1000;

impl<L: ContactLaw> Neighbours<L> {
    /// Sorts a large bed if it is time to.
    pub(crate) fn sort_in_time<C: Cavity>(
        &mut self,
        model: &Model<C, L>,
        state: &mut State,
        detectors: &mut dyn Detectors,
    ) -> Result<(), StepError> {
        if state.particles.len() <= BLOCK {
            return Ok(());
        }
        if self.since_sort < INTERVAL {
            self.since_sort += 1;
            return Ok(());
        }
        let mut memory = self.history();
        let number = state.particles.id.clone();
        self.sort(state);
        for contact in memory.iter_mut().flatten() {
            contact.first = moved(&state.particles, &number, contact.first);
        }
        for contact in &mut memory[0] {
            contact.second = moved(&state.particles, &number, contact.second);
        }
        let [pairs, walls] = &mut memory;
        pairs.sort_unstable_by_key(ContactRecord::pair);
        walls.sort_unstable_by_key(ContactRecord::wall);
        self.list(model, state, detectors, Some(&memory))
    }

    /// Sorts a large bed. Candidates have to be listed anew.
    pub(crate) fn sort(&mut self, state: &mut State) {
        self.since_sort = 0;
        let particles = &state.particles;
        if particles.len() <= BLOCK {
            return;
        }
        let largest = particles.radius.iter().copied().fold(0.0, f64::max);
        let density = 0.5 / largest;
        let mut order: Vec<(u64, u32)> = Vec::with_capacity(particles.len());
        for compartment in &state.compartments {
            let [lower, _] = compartment.bounds;
            let shifted = lower + compartment.motion.position;
            let start = order.len();
            order.extend(compartment.indices.clone().map(|index| {
                let position = particles.position.get(index);
                let place = if compartment.turned {
                    compartment.to_local(position) - lower
                } else {
                    position - shifted
                };
                let cell = place * density;
                (morton(cell), particles.id[index])
            }));
            order[start..].sort_unstable();
        }
        let number: Vec<u32> = order.iter().map(|(_, number)| *number).collect();
        state.particles.rearrange(&number);
    }
}

/// The index of the particle that was at `index` when the columns held the particles of `number`.
fn moved(particles: &Particles, number: &[u32], index: u32) -> u32 {
    particles.index_of[number[index as usize] as usize]
}

/// Number of a cell along Morton's curve, 21 bits to each of the three coordinates. Negative
/// coordinates count as zero.
fn morton(cell: DVec3) -> u64 {
    let [x, y, z] = cell.to_array().map(|coordinate| spread(coordinate as u64));
    x | y << 1 | z << 2
}

/// Puts two zeros between each two of the lower 21 bits.
const fn spread(bits: u64) -> u64 {
    let bits = bits & 0x1F_FFFF;
    let bits = (bits | bits << 32) & 0x001F_0000_0000_FFFF;
    let bits = (bits | bits << 16) & 0x001F_0000_FF00_00FF;
    let bits = (bits | bits << 8) & 0x100F_00F0_0F00_F00F;
    let bits = (bits | bits << 4) & 0x10C3_0C30_C30C_30C3;
    (bits | bits << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    #[test]
    fn near_cells_have_near_numbers() {
        assert_eq!(morton(dvec3(1.5, 0.0, 0.9)), 1);
        assert_eq!(morton(dvec3(0.0, 1.0, 0.0)), 2);
        assert_eq!(morton(dvec3(0.0, 0.0, 1.0)), 4);
        assert_eq!(morton(dvec3(3.0, 3.0, 3.0)), 63);
        assert_eq!(morton(dvec3(-2.0, 2.0, 0.0)), 16);
        assert_eq!(spread(0x1F_FFFF), 0x1249_2492_4924_9249);
    }
}
