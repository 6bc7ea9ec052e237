//! Contacts that might be, those of them that are, and what they remember.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use super::coefficients::Coefficients;
use crate::law::{ContactLaw, LawError};

/// Two bodies that might touch.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    /// Slot of the first body.
    first: u32,
    /// Slot of the second body, or number of the wall.
    second: u32,
    /// They are in contact while their measure is below this: of two particles the squared distance
    /// of the centres, of a particle and a wall the distance.
    limit: f64,
}

/// Two bodies in contact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Touch {
    /// Slot of the first body.
    pub(crate) first: u32,
    /// Slot of the second body, or number of the wall.
    pub(crate) second: u32,
    /// Place among the candidates.
    pub(crate) place: u32,
    /// Distance of two centres in m, or of a centre from the wall.
    pub(crate) distance: f64,
    /// One over the distance of two centres, finite.
    pub(crate) inverse: f64,
}

/// The memory of a contact, between two lists of candidates.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Remembered<M> {
    pub(crate) first: u32,
    pub(crate) second: u32,
    pub(crate) memory: M,
}

impl<M> Remembered<M> {
    pub(crate) const fn key(&self) -> (u32, u32) {
        (self.first, self.second)
    }
}

/// Candidates in ascending order of their two bodies. This is the order in which contacts are
/// evaluated, whoever proposed them.
#[derive(Debug, Clone)]
pub(crate) struct Candidates<L: ContactLaw> {
    list: Vec<Candidate>,
    memory: Vec<L::Memory>,
    /// The step at whose end each candidate touched last.
    touched: Vec<u32>,
    /// One each, if the law has to be asked pair by pair; else empty.
    prepared: Vec<L::Coefficients>,
    pub(crate) contacts: Contacts,
}

/// Which candidates are in contact: columns of which the first `count` entries are in use.
#[derive(Debug, Clone, Default)]
pub(crate) struct Contacts {
    places: Vec<u32>,
    distance: Vec<f64>,
    inverse: Vec<f64>,
    count: usize,
}

impl Contacts {
    /// How many there are.
    #[inline(always)]
    pub(crate) const fn len(&self) -> usize {
        self.count
    }
}

/// Gives `column` a length, and room for more, so that columns that belong together grow together.
fn fit<T: Copy>(column: &mut Vec<T>, length: usize, room: usize, value: T) {
    column.resize(length, value);
    column.reserve(room - length);
}

impl<L: ContactLaw> Default for Candidates<L> {
    fn default() -> Self {
        Self {
            list: Vec::new(),
            memory: Vec::new(),
            touched: Vec::new(),
            prepared: Vec::new(),
            contacts: Contacts::default(),
        }
    }
}

impl<L: ContactLaw> Candidates<L> {
    /// Whether the law's contacts remember anything; decided when the program is compiled.
    pub(crate) const REMEMBERS: bool = size_of::<L::Memory>() != 0;

    /// Empties the list. The memories of contacts that touched at the end of step `stamp` are added
    /// to `remembered`.
    pub(crate) fn clear(&mut self, stamp: u32, remembered: &mut Vec<Remembered<L::Memory>>) {
        self.remember(stamp, remembered);
        self.list.clear();
        self.contacts.count = 0;
    }

    /// Adds to `remembered` the memories of contacts that touched at the end of step `stamp`.
    pub(crate) fn remember(&self, stamp: u32, remembered: &mut Vec<Remembered<L::Memory>>) {
        if !Self::REMEMBERS {
            return;
        }
        let touched = self.list.iter().zip(&self.touched).zip(&self.memory);
        let touched = touched.filter(|((_, touched), _)| **touched == stamp);
        remembered.extend(touched.map(|((candidate, _), memory)| Remembered {
            first: candidate.first,
            second: candidate.second,
            memory: *memory,
        }));
    }

    /// Makes room for candidates.
    pub(crate) fn reserve(&mut self, candidates: usize) {
        self.list.reserve(candidates);
    }

    /// Adds a candidate. They come in ascending order of `first` and `second`.
    pub(crate) fn push(&mut self, first: u32, second: u32, limit: f64) {
        self.list.push(Candidate {
            first,
            second,
            limit,
        });
    }

    /// Makes a finished list ready: gives its contacts their memory back, which `remembered` holds in
    /// ascending order.
    pub(crate) fn finish(&mut self, stamp: u32, remembered: &[Remembered<L::Memory>]) {
        let count = self.list.len();
        // One place more, because entries are written before it is known whether they count.
        let room = self.list.capacity() + 1;
        let contacts = &mut self.contacts;
        fit(&mut contacts.places, count + 1, room, 0);
        fit(&mut contacts.distance, count + 1, room, 0.0);
        fit(&mut contacts.inverse, count + 1, room, 0.0);
        if !Self::REMEMBERS {
            return;
        }
        self.memory.clear();
        self.memory.reserve(room);
        self.touched.clear();
        self.touched.reserve(room);
        self.memory.resize(count, L::Memory::default());
        self.touched.resize(count, stamp.wrapping_sub(1));
        let mut remembered = remembered.iter().peekable();
        for (place, candidate) in self.list.iter().enumerate() {
            let key = (candidate.first, candidate.second);
            while remembered.next_if(|contact| contact.key() < key).is_some() {}
            if let Some(contact) = remembered.next_if(|contact| contact.key() == key) {
                self.memory[place] = contact.memory;
                self.touched[place] = stamp;
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
    pub(crate) const fn candidates(&self) -> usize {
        self.list.len()
    }

    /// Lists the candidates in contact, by their `measure`.
    #[inline(always)]
    pub(crate) fn find(&mut self, measure: impl Fn(usize, u32) -> f64) {
        let Contacts {
            places, distance, ..
        } = &mut self.contacts;
        let distance = &mut distance[..places.len()];
        let mut count = 0;
        for (place, candidate) in (0..).zip(&self.list) {
            let measured = measure(candidate.first as usize, candidate.second);
            // Written before it is known whether it counts: no branch to mispredict.
            places[count] = place;
            distance[count] = measured;
            count += usize::from(measured < candidate.limit);
        }
        self.contacts.count = count;
    }

    /// Turns squared distances into distances and their inverses. Of its own, so that the compiler
    /// takes several roots at a time.
    pub(crate) fn take_roots(&mut self) {
        let Contacts {
            distance,
            inverse,
            count,
            ..
        } = &mut self.contacts;
        for (distance, inverse) in distance[..*count].iter_mut().zip(&mut inverse[..*count]) {
            let root = distance.sqrt();
            *distance = root;
            *inverse = 1.0 / (root + f64::MIN_POSITIVE);
        }
    }

    /// The contact of a number.
    #[inline(always)]
    pub(crate) fn touch(&self, number: usize) -> Touch {
        let place = self.contacts.places[number];
        let candidate = self.list[place as usize];
        Touch {
            first: candidate.first,
            second: candidate.second,
            place,
            distance: self.contacts.distance[number],
            inverse: self.contacts.inverse[number],
        }
    }

    /// The contacts.
    pub(crate) fn touching(&self) -> impl Iterator<Item = Touch> {
        (0..self.contacts.len()).map(|number| self.touch(number))
    }

    /// The law's own coefficients of a candidate, if it was asked pair by pair.
    #[inline(always)]
    pub(crate) fn prepared(&self, place: u32) -> Option<&L::Coefficients> {
        self.prepared.get(place as usize)
    }

    /// Whether a contact touched at the end of step `stamp`, and may remember something.
    #[inline(always)]
    pub(crate) fn remembers(&self, place: u32, stamp: u32) -> bool {
        Self::REMEMBERS && self.touched[place as usize] == stamp
    }

    /// What a contact remembers from the end of step `stamp`: the default if it did not touch then.
    #[inline(always)]
    pub(crate) fn memory(&self, place: u32, stamp: u32) -> L::Memory {
        if Self::REMEMBERS && self.touched[place as usize] == stamp {
            self.memory[place as usize]
        } else {
            L::Memory::default()
        }
    }

    /// Keeps what a contact remembers at the end of step `stamp`.
    #[inline(always)]
    pub(crate) fn keep(&mut self, place: u32, stamp: u32, memory: L::Memory) {
        if Self::REMEMBERS {
            self.memory[place as usize] = memory;
            self.touched[place as usize] = stamp;
        }
    }

    /// Memory in bytes that the list has reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        let contacts = &self.contacts;
        size_of::<Candidate>() * self.list.capacity()
            + size_of::<L::Memory>() * self.memory.capacity()
            + size_of::<L::Coefficients>() * self.prepared.capacity()
            + size_of::<u32>() * (self.touched.capacity() + contacts.places.capacity())
            + size_of::<f64>() * (contacts.distance.capacity() + contacts.inverse.capacity())
    }
}
