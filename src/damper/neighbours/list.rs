//! A neighbour list: contacts that might be, those of them that are, and what they remember.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::ops::Range;

use super::columns::make_room;
use super::contacts::Contacts;
use super::history::ContactRecord;
use super::memories::{Memories, Reader};
use crate::cavity::Cavity;
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

/// Contacts that follow on one another in a list.
pub(crate) struct Run<'a, L: ContactLaw> {
    pub(crate) bodies: &'a [[u32; 2]],
    candidates: &'a [u32],
    /// What each remembers.
    pub(crate) memory: &'a [ContactMemory<L>],
    prepared: &'a [L::Coefficients],
}

impl<L: ContactLaw> Run<'_, L> {
    /// The coefficients of a pair.
    #[inline(always)]
    pub(crate) fn pair_coefficients<C: Cavity>(
        &self,
        view: &StateView<'_, C, L>,
        n: usize,
    ) -> L::Coefficients {
        let own = self.prepared.get(self.candidates[n] as usize);
        view.pair_coefficients(self.bodies[n], own)
    }
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

    /// Adds to `history` what contacts remember.
    pub(crate) fn save_history(&self, history: &mut Vec<ContactRecord<ContactMemory<L>>>) {
        if !Memories::<ContactMemory<L>>::ANY {
            return;
        }
        let mut memories = self.memories();
        for (index, [first, second]) in self.all() {
            if let Some(memory) = memories.of(index) {
                history.push(ContactRecord {
                    first,
                    second,
                    memory: *memory,
                });
            }
        }
    }

    /// How many contacts remember something.
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
        history: &[ContactRecord<ContactMemory<L>>],
        key: impl Fn(u32, u32) -> (u32, u32),
    ) {
        let count = self.bodies.len();
        self.contacts.fit(count);
        if !Memories::<ContactMemory<L>>::ANY {
            return;
        }
        self.memories.clear();
        let mut history = history.iter().peekable();
        for (index, [first, second]) in (0..).zip(&self.bodies) {
            let own = key(*first, *second);
            let of = |contact: &ContactRecord<ContactMemory<L>>| key(contact.first, contact.second);
            while history.next_if(|contact| of(contact) < own).is_some() {}
            if let Some(contact) = history.next_if(|contact| of(contact) == own) {
                self.memories.push(index, contact.memory);
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
    pub(crate) fn pair_coefficients<C: Cavity>(
        &self,
        view: &StateView<'_, C, L>,
        bodies: [u32; 2],
        candidate: u32,
    ) -> L::Coefficients {
        view.pair_coefficients(bodies, self.prepared(candidate))
    }

    /// What candidates remember, to be read in their order.
    #[inline(always)]
    pub(crate) fn memories(&self) -> Reader<'_, ContactMemory<L>> {
        self.memories.reader()
    }

    /// Forgets what contacts remember.
    pub(crate) fn forget(&mut self) {
        self.memories.clear();
    }

    /// Adds what a candidate remembers that comes later in the list than all before.
    #[inline(always)]
    pub(crate) fn remember(&mut self, candidate: u32, memory: &ContactMemory<L>) {
        self.memories.push(candidate, *memory);
    }

    /// Gets ready for [`run`](Self::run).
    #[inline(always)]
    pub(crate) fn begin_runs(&mut self) {
        self.memories.begin(self.contacts.len());
    }

    /// The next of the runs that the contacts are evaluated in, and where it is put what each will remember at the
    /// end of the step.
    #[inline(always)]
    pub(crate) fn run(&mut self, run: Range<usize>) -> (Run<'_, L>, &mut [ContactMemory<L>]) {
        let candidates = &self.contacts.candidates()[run.clone()];
        let (memory, advanced) = self.memories.run(candidates, run.start);
        let run = Run {
            bodies: &self.contacts.bodies()[run],
            candidates,
            memory,
            prepared: &self.prepared,
        };
        (run, advanced)
    }

    /// Ends a step: contacts remember from now on what they were advanced to.
    pub(crate) fn advance_memories(&mut self) {
        self.memories.end(self.contacts.candidates());
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
