//! Listing the candidates of a block anew.

use super::block::{Block, ContactHistory, Listing};
use super::columns::make_room;
use super::history::{ContactRecord, pair};
use crate::cavity::Cavity;
use crate::damper::state::StateView;
use crate::law::{ContactLaw, ContactMemory, LawError};

impl<L: ContactLaw> Block<L> {
    /// Lists candidates anew, and hands over what contacts remember: what the block's own do, which goes
    /// by way of `buffer`, unless it is `saved`, in ascending order. `partners` are those in the rows of
    /// the block's indices.
    pub(crate) fn relist<C: Cavity>(
        &mut self,
        listing: &Listing<'_, C, L>,
        partners: &mut [u32],
        saved: Option<&ContactHistory<L>>,
        buffer: &mut ContactHistory<L>,
    ) {
        let memory = if let Some(all) = saved {
            self.own(all)
        } else {
            buffer.iter_mut().for_each(Vec::clear);
            make_room(&mut buffer[0], self.pairs.entries() + self.halo.entries());
            make_room(&mut buffer[1], self.walls.entries());
            self.save_history(buffer);
            buffer[0].sort_unstable_by_key(ContactRecord::pair);
            buffer.each_ref().map(Vec::as_slice)
        };
        self.pairs.clear();
        self.halo.clear();
        self.walls.clear();
        self.list(listing, partners);
        self.finish(memory);
    }

    /// Adds what the contacts remember to `memory`.
    pub(crate) fn save_history(&self, memory: &mut ContactHistory<L>) {
        let [pairs, walls] = memory;
        self.pairs.save_history(pairs);
        self.halo.save_history(pairs);
        self.walls.save_history(walls);
    }

    /// What `memory`, in ascending order, holds of the block's contacts.
    fn own<'a>(&self, memory: &'a ContactHistory<L>) -> [&'a [ContactRecord<ContactMemory<L>>]; 2] {
        let indices = [self.indices.start as u32, self.indices.end as u32];
        let own = |all: &'a [ContactRecord<ContactMemory<L>>],
                   index: fn(&ContactRecord<ContactMemory<L>>) -> u32| {
            let [start, end] = indices.map(|end| all.partition_point(|own| index(own) < end));
            &all[start..end]
        };
        [
            own(&memory[0], |contact| contact.pair().0),
            own(&memory[1], |contact| contact.wall().0),
        ]
    }

    /// Fills the empty lists.
    fn list<C: Cavity>(&mut self, listing: &Listing<'_, C, L>, partners: &mut [u32]) {
        let Listing {
            view,
            rows,
            local,
            listed_distance,
        } = *listing;
        let begin = rows[self.indices.start];
        let beyond = |partner: &&u32| **partner as usize >= self.indices.end;
        let halo = partners.iter().filter(beyond).count();
        self.halo.reserve(halo);
        self.pairs.reserve(partners.len() - halo);
        for index in self.indices.clone() {
            let row = (rows[index] - begin) as usize..(rows[index + 1] - begin) as usize;
            let partners = &mut partners[row];
            partners.sort_unstable();
            let mut last = None;
            let each_once = |partner: &u32| last.replace(*partner) != Some(*partner);
            for partner in partners.iter().copied().filter(each_once) {
                let other = partner as usize;
                let touching = view.radius[index] + view.radius[other];
                let list = if other < self.indices.end {
                    &mut self.pairs
                } else {
                    &mut self.halo
                };
                // The one with the lower number comes first, wherever it stands.
                if view.id[index] < view.id[other] {
                    list.push(index as u32, partner, touching);
                } else {
                    list.push(partner, index as u32, touching);
                }
            }
        }
        for (compartment, cavity) in view.compartments.iter().zip(view.cavities) {
            // A wall does not come to meet a particle.
            let margin = 0.5 * compartment.margin;
            for index in compartment.indices_in(&self.indices) {
                let touching = view.radius[index];
                let near = touching + listed_distance + margin;
                for wall in 0..compartment.walls {
                    if cavity.reaches(wall, local[index], near) {
                        self.walls
                            .push(index as u32, compartment.first_wall + wall, touching);
                    }
                }
            }
        }
    }

    /// Makes filled lists ready for use, but for what the law has to [`prepare`](Self::prepare).
    fn finish(&mut self, [pairs, walls]: [&[ContactRecord<ContactMemory<L>>]; 2]) {
        self.pairs.finish(pairs, pair);
        self.halo.finish(pairs, pair);
        self.walls.finish(walls, |index, wall| (index, wall));
    }

    /// Asks the law for the pairs of finished lists.
    pub(crate) fn prepare<C: Cavity>(
        &mut self,
        view: &StateView<'_, C, L>,
    ) -> Result<(), LawError> {
        for list in [&mut self.pairs, &mut self.halo] {
            list.prepare(view.law, view.coefficients, view.species)?;
        }
        Ok(())
    }
}
