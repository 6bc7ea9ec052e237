//! A neighbour list: contacts that might be, those of them that are, and what they remember.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::ops::Range;

use super::columns::make_room;
use super::contacts::Contacts;
use super::history::ContactRecord;
use super::memories::Memories;
use crate::damper::state::{Coefficients, StateView};
use crate::law::{ContactLaw, ContactMemory, LawError};

/// Candidates in ascending order of their two bodies. This is the order in which contacts are
/// evaluated, whoever proposed them.
#[derive(Clone)]
pub(crate) struct NeighbourList<L: ContactLaw> {
    /// Index of the first body of each; index of the second, or number of the wall.
    bodies: Vec<[u32; 2]>,
    /// Distance at which they touch, m: of two centres, or of a centre and a wall.
    touching: Vec<f64>,
    memories: Memories<ContactMemory<L>>,
    /// One each, if the law has to be asked pair by pair; else empty.
    prepared: Vec<L::Coefficients>,
    pub(crate) contacts: Contacts,
}

impl<L: ContactLaw> Default for NeighbourList<L> {
    fn default() -> Self {
        Self {
            bodies: Vec::new(),
            touching: Vec::new(),
            memories: Memories::default(),
            prepared: Vec::new(),
            contacts: Contacts::default(),
        }
    }
}

impl<L: ContactLaw> NeighbourList<L> {
    /// Empties the list.
    pub(crate) fn clear(&mut self) {
        self.bodies.clear();
        self.touching.clear();
        self.contacts.clear();
    }

    /// Adds to `history` what contacts remember that touched at the end of step `stamp`.
    pub(crate) fn save_history(
        &self,
        stamp: u32,
        history: &mut Vec<ContactRecord<ContactMemory<L>>>,
    ) {
        if !Memories::<ContactMemory<L>>::ANY {
            return;
        }
        for (index, [first, second]) in self.all() {
            if let Some(memory) = self.memory_of(index, stamp) {
                history.push(ContactRecord {
                    first,
                    second,
                    memory: *memory,
                });
            }
        }
    }

    /// How many contacts may remember something.
    pub(crate) const fn entries(&self) -> usize {
        self.memories.len()
    }

    /// Makes room for candidates.
    pub(crate) fn reserve(&mut self, candidates: usize) {
        make_room(&mut self.bodies, candidates);
        make_room(&mut self.touching, candidates);
    }

    /// Makes room for whatever comes of `candidates`.
    pub(crate) fn reserve_all(&mut self, candidates: usize) {
        make_room(&mut self.bodies, candidates);
        make_room(&mut self.touching, candidates);
        self.contacts.reserve(candidates);
        self.memories.reserve(candidates);
    }

    /// Adds a candidate. Pairs come in ascending order of their indices, the lower one first; walls in
    /// ascending order of index and wall.
    pub(crate) fn push(&mut self, first: u32, second: u32, touching: f64) {
        self.bodies.push([first, second]);
        self.touching.push(touching);
    }

    /// Makes a finished list ready: gives its contacts their memory back, which `history` holds in
    /// ascending order of the `key` by which candidates are sorted.
    pub(crate) fn finish(
        &mut self,
        stamp: u32,
        history: &[ContactRecord<ContactMemory<L>>],
        key: impl Fn(u32, u32) -> (u32, u32),
    ) {
        let count = self.bodies.len();
        self.contacts.fit(count);
        if !Memories::<ContactMemory<L>>::ANY {
            return;
        }
        self.memories.forget(count, history.len(), stamp);
        let mut history = history.iter().peekable();
        for (index, [first, second]) in self.bodies.iter().enumerate() {
            let own = key(*first, *second);
            let of = |contact: &ContactRecord<ContactMemory<L>>| key(contact.first, contact.second);
            while history.next_if(|contact| of(contact) < own).is_some() {}
            if let Some(contact) = history.next_if(|contact| of(contact) == own) {
                self.memories.keep(index, stamp, &contact.memory);
            }
        }
    }

    /// Asks the law for the pairs of a finished list, if it has to be asked pair by pair.
    pub(crate) fn prepare(
        &mut self,
        law: &L,
        coefficients: &Coefficients<L::Coefficients>,
        species: &[u32],
    ) -> Result<(), LawError> {
        self.prepared.clear();
        if coefficients.is_by_pair() {
            for bodies in &self.bodies {
                let [first, second] = bodies.map(|index| species[index as usize]);
                self.prepared
                    .push(coefficients.prepare(law, first, second)?);
            }
        }
        Ok(())
    }

    /// How many candidates there are.
    pub(crate) const fn len(&self) -> usize {
        self.bodies.len()
    }

    /// The places of all candidates, and their bodies.
    pub(crate) fn all(&self) -> impl Iterator<Item = (u32, [u32; 2])> {
        (0..).zip(self.bodies.iter().copied())
    }

    /// Lists the candidates that are in contact, as `touches` tells of both bodies and of the distance at
    /// which they touch (m).
    #[inline(always)]
    pub(crate) fn find(&mut self, touches: impl Fn([u32; 2], f64) -> bool) {
        let all = self.bodies.iter().zip(&self.touching);
        self.contacts
            .find(all.map(|(bodies, touching)| (*bodies, touches(*bodies, *touching))));
    }

    /// The same where the distance is one for all.
    #[inline(always)]
    pub(crate) fn find_alike(&mut self, touches: impl Fn([u32; 2]) -> bool) {
        let all = self.bodies.iter();
        self.contacts
            .find(all.map(|bodies| (*bodies, touches(*bodies))));
    }

    /// The law's own coefficients of a candidate, if it was asked pair by pair.
    #[inline(always)]
    pub(crate) fn prepared(&self, candidate: u32) -> Option<&L::Coefficients> {
        self.prepared.get(candidate as usize)
    }

    /// The coefficients of two particles that are a candidate.
    #[inline(always)]
    pub(crate) fn pair_coefficients<C>(
        &self,
        view: &StateView<'_, C, L>,
        bodies: [u32; 2],
        candidate: u32,
    ) -> L::Coefficients {
        let [first, second] = bodies.map(|index| view.species[index as usize]);
        view.coefficients
            .pair(first, second, self.prepared(candidate))
    }

    /// What a candidate remembers that touched at the end of step `stamp`, if contacts remember anything.
    #[inline(always)]
    pub(crate) fn memory_of(&self, candidate: u32, stamp: u32) -> Option<&ContactMemory<L>> {
        self.memories.of(candidate as usize, stamp)
    }

    /// Copies what the contacts of a run remember from the end of step `stamp`.
    #[inline(always)]
    pub(crate) fn load_memories(
        &self,
        run: Range<usize>,
        stamp: u32,
        memories: &mut [ContactMemory<L>],
    ) {
        if Memories::<ContactMemory<L>>::ANY {
            for (candidate, memory) in self.contacts.candidates()[run].iter().zip(memories) {
                // Each straight to its place: through a temporary it would be copied twice.
                match self.memory_of(*candidate, stamp) {
                    Some(history) => *memory = *history,
                    None => *memory = ContactMemory::<L>::default(),
                }
            }
        }
    }

    /// Keeps what the contacts of a run remember at the end of step `stamp`.
    #[inline(always)]
    pub(crate) fn store_memories(
        &mut self,
        run: Range<usize>,
        stamp: u32,
        memories: &[ContactMemory<L>],
    ) {
        if Memories::<ContactMemory<L>>::ANY {
            for (candidate, memory) in self.contacts.candidates()[run].iter().zip(memories) {
                self.memories.keep(*candidate as usize, stamp, memory);
            }
        }
    }

    /// Keeps what a candidate remembers at the end of step `stamp`.
    #[inline(always)]
    pub(crate) fn keep(&mut self, candidate: u32, stamp: u32, memory: &ContactMemory<L>) {
        self.memories.keep(candidate as usize, stamp, memory);
    }

    /// Memory in bytes that the list has reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        size_of::<[u32; 2]>() * self.bodies.capacity()
            + size_of::<f64>() * self.touching.capacity()
            + size_of::<L::Coefficients>() * self.prepared.capacity()
            + self.memories.reserved_bytes()
            + self.contacts.reserved_bytes()
    }
}
