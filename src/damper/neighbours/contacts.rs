//! The narrow phase of a list: which of its candidates touch.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use super::columns::{fit, make_room};

/// Which candidates are in contact: columns of which the first `count` entries are in use.
#[derive(Debug, Clone, Default)]
pub(crate) struct Contacts {
    bodies: Vec<[u32; 2]>,
    candidates: Vec<u32>,
    count: usize,
}

impl Contacts {
    /// How many there are.
    #[inline(always)]
    pub(crate) const fn len(&self) -> usize {
        self.count
    }

    /// The bodies of all contacts.
    #[inline(always)]
    pub(crate) fn bodies(&self) -> &[[u32; 2]] {
        &self.bodies[..self.count]
    }

    /// Their indices among the candidates.
    #[inline(always)]
    pub(crate) fn candidates(&self) -> &[u32] {
        &self.candidates[..self.count]
    }

    /// Empties them.
    pub(super) const fn clear(&mut self) {
        self.count = 0;
    }

    /// Makes room for the contacts of as many candidates.
    pub(super) fn reserve(&mut self, candidates: usize) {
        // One more, because entries are written before it is known whether they count.
        make_room(&mut self.bodies, candidates + 1);
        make_room(&mut self.candidates, candidates + 1);
    }

    /// Gets ready for the contacts of as many candidates.
    pub(super) fn fit(&mut self, candidates: usize) {
        fit(&mut self.bodies, candidates + 1, [0; 2]);
        fit(&mut self.candidates, candidates + 1, 0);
    }

    /// Lists those of all candidates that touch: of each there are its bodies, and whether they do.
    #[inline(always)]
    pub(super) fn find(&mut self, all: impl Iterator<Item = ([u32; 2], bool)>) {
        let Self {
            bodies, candidates, ..
        } = self;
        let candidates = &mut candidates[..bodies.len()];
        let mut count = 0;
        for (index, (own, touches)) in (0..).zip(all) {
            // Written before it is known whether it counts: no branch to mispredict.
            bodies[count] = own;
            candidates[count] = index;
            count += usize::from(touches);
        }
        self.count = count;
    }

    /// Memory in bytes that is reserved.
    pub(super) const fn reserved_bytes(&self) -> usize {
        size_of::<[u32; 2]>() * self.bodies.capacity()
            + size_of::<u32>() * self.candidates.capacity()
    }
}
