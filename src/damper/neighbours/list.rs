//! Contacts that might be, those of them that are, and what they remember.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use std::ops::Range;

use crate::damper::state::{Coefficients, StateView};
use crate::law::{ContactLaw, ContactMemory, LawError};

/// Two bodies that might touch.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    /// Slot of the first body.
    first: u32,
    /// Slot of the second body, or number of the wall.
    second: u32,
    /// Distance at which they touch, m: of two centres, or of a centre and a wall.
    touching: f64,
}

/// The memory of a contact, between two lists of candidates.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct ContactRecord<M> {
    pub(crate) first: u32,
    pub(crate) second: u32,
    pub(crate) memory: M,
}

impl<M> ContactRecord<M> {
    /// The two indices of a pair, the lower one first: histories of pairs are in ascending order of it.
    pub(crate) const fn pair(&self) -> (u32, u32) {
        pair(self.first, self.second)
    }

    /// The index and the wall: histories of contacts with walls are in ascending order of it.
    pub(crate) const fn wall(&self) -> (u32, u32) {
        (self.first, self.second)
    }
}

/// Two indices, the lower one first.
pub(crate) const fn pair(first: u32, second: u32) -> (u32, u32) {
    if first < second {
        (first, second)
    } else {
        (second, first)
    }
}

/// Candidates in ascending order of their two bodies. This is the order in which contacts are
/// evaluated, whoever proposed them.
#[derive(Clone)]
pub(crate) struct NeighbourList<L: ContactLaw> {
    list: Vec<Candidate>,
    /// Index of the entry of each, or [`NONE`]; empty if contacts remember nothing, and if each has the
    /// entry of its own index.
    entry: Vec<u32>,
    /// What those remember that have touched since they were listed, or had before.
    entries: Vec<Entry<ContactMemory<L>>>,
    /// One each, if the law has to be asked pair by pair; else empty.
    prepared: Vec<L::Coefficients>,
    pub(crate) contacts: Contacts,
}

/// No entry.
const NONE: u32 = u32::MAX;

/// What a candidate remembers.
#[derive(Debug, Clone, Copy)]
struct Entry<M> {
    /// The step at whose end it touched last.
    touched: u32,
    memory: M,
}

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
}

/// Sets the entry of a candidate, whose index among all `entries` is `own`.
#[inline(always)]
fn keep<M: Copy>(entries: &mut Vec<Entry<M>>, own: &mut u32, touched: u32, memory: &M) {
    // Each straight to its place: through a temporary it would be copied twice.
    if let Some(entry) = entries.get_mut(*own as usize) {
        entry.touched = touched;
        entry.memory = *memory;
    } else {
        let count = entries.len();
        *own = count as u32;
        make_room(entries, count + 1);
        entries.push(Entry {
            touched,
            memory: *memory,
        });
    }
}

/// Makes room for `count` entries. A column that has to grow gets an eighth more than that.
pub(crate) fn make_room<T>(column: &mut Vec<T>, count: usize) {
    if column.capacity() < count {
        column.reserve_exact(count + count / 8 - column.len());
    }
}

/// Gives a column `count` entries.
fn fit<T: Copy>(column: &mut Vec<T>, count: usize, value: T) {
    make_room(column, count);
    column.resize(count, value);
}

impl<L: ContactLaw> Default for NeighbourList<L> {
    fn default() -> Self {
        Self {
            list: Vec::new(),
            entry: Vec::new(),
            entries: Vec::new(),
            prepared: Vec::new(),
            contacts: Contacts::default(),
        }
    }
}

impl<L: ContactLaw> NeighbourList<L> {
    /// Whether the law's contacts remember anything; decided when the program is compiled.
    pub(crate) const REMEMBERS: bool = size_of::<ContactMemory<L>>() != 0;

    /// Whether each candidate has an entry of its own. The entries of a larger memory would not stay in
    /// the caches, and those of contacts alone are kept.
    const EACH: bool = Self::REMEMBERS && size_of::<Entry<ContactMemory<L>>>() <= 16;

    /// Empties the list.
    pub(crate) fn clear(&mut self) {
        self.list.clear();
        self.contacts.count = 0;
    }

    /// Adds to `history` what contacts remember that touched at the end of step `stamp`.
    pub(crate) fn save_history(
        &self,
        stamp: u32,
        history: &mut Vec<ContactRecord<ContactMemory<L>>>,
    ) {
        if !Self::REMEMBERS {
            return;
        }
        for (index, candidate) in (0..).zip(&self.list) {
            if let Some(memory) = self.memory_of(index, stamp) {
                history.push(ContactRecord {
                    first: candidate.first,
                    second: candidate.second,
                    memory: *memory,
                });
            }
        }
    }

    /// How many contacts may remember something.
    pub(crate) const fn entries(&self) -> usize {
        self.entries.len()
    }

    /// Makes room for candidates.
    pub(crate) fn reserve(&mut self, candidates: usize) {
        make_room(&mut self.list, candidates);
    }

    /// Makes room for whatever comes of `candidates`.
    pub(crate) fn reserve_all(&mut self, candidates: usize) {
        make_room(&mut self.list, candidates);
        make_room(&mut self.contacts.bodies, candidates + 1);
        make_room(&mut self.contacts.candidates, candidates + 1);
        if Self::REMEMBERS {
            make_room(&mut self.entry, if Self::EACH { 0 } else { candidates });
            make_room(&mut self.entries, candidates);
        }
    }

    /// Adds a candidate. Pairs come in ascending order of their indices, the lower one first; walls in
    /// ascending order of index and wall.
    pub(crate) fn push(&mut self, first: u32, second: u32, touching: f64) {
        self.list.push(Candidate {
            first,
            second,
            touching,
        });
    }

    /// Makes a finished list ready: gives its contacts their memory back, which `history` holds in
    /// ascending order of the `key` by which candidates are sorted.
    pub(crate) fn finish(
        &mut self,
        stamp: u32,
        history: &[ContactRecord<ContactMemory<L>>],
        key: impl Fn(u32, u32) -> (u32, u32),
    ) {
        let count = self.list.len();
        // One more, because entries are written before it is known whether they count.
        fit(&mut self.contacts.bodies, count + 1, [0; 2]);
        fit(&mut self.contacts.candidates, count + 1, 0);
        if !Self::REMEMBERS {
            return;
        }
        self.entry.clear();
        self.entries.clear();
        if Self::EACH {
            let forgotten = Entry {
                touched: stamp.wrapping_sub(1),
                memory: ContactMemory::<L>::default(),
            };
            fit(&mut self.entries, count, forgotten);
        } else {
            fit(&mut self.entry, count, NONE);
            make_room(&mut self.entries, history.len().min(count));
        }
        let mut history = history.iter().peekable();
        for (index, candidate) in self.list.iter().enumerate() {
            let own = key(candidate.first, candidate.second);
            let of = |contact: &ContactRecord<ContactMemory<L>>| key(contact.first, contact.second);
            while history.next_if(|contact| of(contact) < own).is_some() {}
            if let Some(contact) = history.next_if(|contact| of(contact) == own) {
                let (entry, entries) = (&mut self.entry, &mut self.entries);
                Self::store_at(entry, entries, index, stamp, &contact.memory);
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
            for candidate in &self.list {
                let first = species[candidate.first as usize];
                let second = species[candidate.second as usize];
                self.prepared
                    .push(coefficients.prepare(law, first, second)?);
            }
        }
        Ok(())
    }

    /// How many candidates there are.
    pub(crate) const fn len(&self) -> usize {
        self.list.len()
    }

    /// The places of all candidates, and their bodies.
    pub(crate) fn all(&self) -> impl Iterator<Item = (u32, [u32; 2])> {
        let bodies = self.list.iter().map(|own| [own.first, own.second]);
        (0..).zip(bodies)
    }

    /// Lists the candidates that are in contact, as `touches` tells of both and of the distance at which
    /// they touch (m).
    #[inline(always)]
    pub(crate) fn find(&mut self, touches: impl Fn(usize, u32, f64) -> bool) {
        let Contacts {
            bodies, candidates, ..
        } = &mut self.contacts;
        let candidates = &mut candidates[..bodies.len()];
        let mut count = 0;
        for (index, candidate) in (0..).zip(&self.list) {
            let Candidate {
                first,
                second,
                touching,
            } = *candidate;
            // Written before it is known whether it counts: no branch to mispredict.
            bodies[count] = [first, second];
            candidates[count] = index;
            count += usize::from(touches(first as usize, second, touching));
        }
        self.contacts.count = count;
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
        if !Self::REMEMBERS {
            return None;
        }
        let candidate = candidate as usize;
        let own = if Self::EACH {
            candidate
        } else {
            self.entry[candidate] as usize
        };
        let entry = self.entries.get(own);
        let touched = entry.filter(|entry| entry.touched == stamp);
        touched.map(|entry| &entry.memory)
    }

    /// Copies what the contacts of a run remember from the end of step `stamp`.
    #[inline(always)]
    pub(crate) fn load_memories(
        &self,
        run: Range<usize>,
        stamp: u32,
        memories: &mut [ContactMemory<L>],
    ) {
        if Self::REMEMBERS {
            for (candidate, memory) in self.contacts.candidates[run].iter().zip(memories) {
                // Each straight to its place: through a temporary it would be copied twice.
                match self.memory_of(*candidate, stamp) {
                    Some(history) => *memory = *history,
                    None => *memory = ContactMemory::<L>::default(),
                }
            }
        }
    }

    /// Keeps what a candidate remembers at the end of step `stamp`.
    #[inline(always)]
    fn store_at(
        entry: &mut [u32],
        entries: &mut Vec<Entry<ContactMemory<L>>>,
        candidate: usize,
        stamp: u32,
        memory: &ContactMemory<L>,
    ) {
        if Self::EACH {
            entries[candidate] = Entry {
                touched: stamp,
                memory: *memory,
            };
        } else {
            keep(entries, &mut entry[candidate], stamp, memory);
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
        if Self::REMEMBERS {
            for (candidate, memory) in self.contacts.candidates[run].iter().zip(memories) {
                let (entry, entries) = (&mut self.entry, &mut self.entries);
                Self::store_at(entry, entries, *candidate as usize, stamp, memory);
            }
        }
    }

    /// Keeps what a candidate remembers at the end of step `stamp`.
    #[inline(always)]
    pub(crate) fn keep(&mut self, candidate: u32, stamp: u32, memory: &ContactMemory<L>) {
        let (entry, entries) = (&mut self.entry, &mut self.entries);
        Self::store_at(entry, entries, candidate as usize, stamp, memory);
    }

    /// Memory in bytes that the list has reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        let contacts = &self.contacts;
        size_of::<Candidate>() * self.list.capacity()
            + size_of::<Entry<ContactMemory<L>>>() * self.entries.capacity()
            + size_of::<L::Coefficients>() * self.prepared.capacity()
            + size_of::<[u32; 2]>() * contacts.bodies.capacity()
            + size_of::<u32>() * (self.entry.capacity() + contacts.candidates.capacity())
    }
}
