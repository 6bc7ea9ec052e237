//! Listing the candidates of a block anew.

use super::{Block, Listing, Memories};
use crate::cavity::Cavity;
use crate::damper::candidates::{Remembered, make_room, pair};
use crate::damper::scene::Scene;
use crate::law::{ContactLaw, ContactMemory, LawError};

impl<L: ContactLaw> Block<L> {
    /// Lists candidates anew, and hands over what contacts remember: what the block's own do, which goes
    /// by way of `buffer`, unless it is `saved`, in ascending order. `partners` are those in the rows of
    /// the block's slots.
    pub(crate) fn relist<C: Cavity>(
        &mut self,
        listing: &Listing<'_, C, L>,
        partners: &mut [u32],
        saved: Option<&Memories<L>>,
        buffer: &mut Memories<L>,
    ) {
        let memory = if let Some(all) = saved {
            self.own(all)
        } else {
            buffer.iter_mut().for_each(Vec::clear);
            make_room(&mut buffer[0], self.pairs.entries() + self.border.entries());
            make_room(&mut buffer[1], self.walls.entries());
            self.remember(listing.scene.stamp, buffer);
            buffer[0].sort_unstable_by_key(Remembered::pair);
            buffer.each_ref().map(Vec::as_slice)
        };
        self.pairs.clear();
        self.border.clear();
        self.walls.clear();
        self.list(listing, partners);
        self.finish(listing.scene.stamp, memory);
    }

    /// Adds what the contacts of step `stamp` remember to `memory`.
    pub(crate) fn remember(&self, stamp: u32, memory: &mut Memories<L>) {
        let [pairs, walls] = memory;
        self.pairs.remember(stamp, pairs);
        self.border.remember(stamp, pairs);
        self.walls.remember(stamp, walls);
    }

    /// What `memory`, in ascending order, holds of the block's contacts.
    fn own<'a>(&self, memory: &'a Memories<L>) -> [&'a [Remembered<ContactMemory<L>>]; 2] {
        let slots = [self.slots.start as u32, self.slots.end as u32];
        let own = |all: &'a [Remembered<ContactMemory<L>>],
                   slot: fn(&Remembered<ContactMemory<L>>) -> u32| {
            let [start, end] = slots.map(|end| all.partition_point(|own| slot(own) < end));
            &all[start..end]
        };
        [
            own(&memory[0], |contact| contact.pair().0),
            own(&memory[1], |contact| contact.wall().0),
        ]
    }

    /// Fills the empty lists.
    fn list<C: Cavity>(&mut self, listing: &Listing<'_, C, L>, partners: &mut [u32]) {
        let Listing { scene, rows, local } = *listing;
        let begin = rows[self.slots.start];
        let beyond = |partner: &&u32| **partner as usize >= self.slots.end;
        let border = partners.iter().filter(beyond).count();
        self.border.reserve(border);
        self.pairs.reserve(partners.len() - border);
        for slot in self.slots.clone() {
            let row = (rows[slot] - begin) as usize..(rows[slot + 1] - begin) as usize;
            let partners = &mut partners[row];
            partners.sort_unstable();
            let mut last = None;
            let each_once = |partner: &u32| last.replace(*partner) != Some(*partner);
            for partner in partners.iter().copied().filter(each_once) {
                let other = partner as usize;
                let touching = scene.radius[slot] + scene.radius[other];
                let list = if other < self.slots.end {
                    &mut self.pairs
                } else {
                    &mut self.border
                };
                // The one with the lower number comes first, wherever it stands.
                if scene.number[slot] < scene.number[other] {
                    list.push(slot as u32, partner, touching);
                } else {
                    list.push(partner, slot as u32, touching);
                }
            }
        }
        for room in scene.rooms {
            // A wall does not come to meet a particle.
            let margin = 0.5 * room.margin;
            for slot in room.slots_in(&self.slots) {
                let touching = scene.radius[slot];
                for wall in 0..room.cavity.walls() {
                    let point = room.cavity.wall(wall, local[slot]);
                    if point.distance < touching + scene.listed + margin {
                        self.walls
                            .push(slot as u32, room.first_wall + wall, touching);
                    }
                }
            }
        }
    }

    /// Makes filled lists ready for use, but for what the law has to [`prepare`](Self::prepare).
    fn finish(&mut self, stamp: u32, [pairs, walls]: [&[Remembered<ContactMemory<L>>]; 2]) {
        self.pairs.finish(stamp, pairs, pair);
        self.border.finish(stamp, pairs, pair);
        self.walls.finish(stamp, walls, |slot, wall| (slot, wall));
        make_room(&mut self.parcels, self.border.candidates());
    }

    /// Asks the law for the pairs of finished lists.
    pub(crate) fn prepare<C: Cavity>(&mut self, scene: &Scene<'_, C, L>) -> Result<(), LawError> {
        for list in [&mut self.pairs, &mut self.border] {
            list.prepare(scene.law, scene.coefficients, scene.species)?;
        }
        Ok(())
    }
}
