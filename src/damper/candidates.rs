//! Contacts that might be: rows of candidates, and what those that touch remember.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use super::coefficients::Coefficients;
use crate::law::{ContactLaw, LawError};

/// A candidate that touches, by row and place.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Touch {
    /// Slot of the first body.
    pub(crate) first: u32,
    /// Slot of the second body, or number of the wall.
    pub(crate) second: u32,
    /// Place among the candidates.
    pub(crate) place: u32,
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

/// For each slot of a range, in ascending order, the partners that it might touch, in ascending
/// order. This is the order in which contacts are evaluated, whoever proposed them.
#[derive(Debug, Clone)]
pub(crate) struct Candidates<L: ContactLaw> {
    first_slot: u32,
    rows: Vec<u32>,
    partners: Vec<u32>,
    memory: Vec<L::Memory>,
    /// The step at whose end each candidate touched last.
    touched: Vec<u32>,
    /// One each, if the law has to be asked pair by pair; else empty.
    prepared: Vec<L::Coefficients>,
}

impl<L: ContactLaw> Candidates<L> {
    /// Whether the law's contacts remember anything; decided when the program is compiled.
    const REMEMBERS: bool = size_of::<L::Memory>() != 0;

    pub(crate) const fn new(first_slot: u32) -> Self {
        Self {
            first_slot,
            rows: Vec::new(),
            partners: Vec::new(),
            memory: Vec::new(),
            touched: Vec::new(),
            prepared: Vec::new(),
        }
    }

    /// Empties the list. The memories of contacts that touched at the end of step `stamp` are added
    /// to `remembered`.
    pub(crate) fn clear(&mut self, stamp: u32, remembered: &mut Vec<Remembered<L::Memory>>) {
        self.remember(stamp, remembered);
        self.rows.clear();
        self.rows.push(0);
        self.partners.clear();
    }

    /// Adds to `remembered` the memories of contacts that touched at the end of step `stamp`.
    pub(crate) fn remember(&self, stamp: u32, remembered: &mut Vec<Remembered<L::Memory>>) {
        if !Self::REMEMBERS {
            return;
        }
        for (row, ends) in self.rows.windows(2).enumerate() {
            for place in ends[0] as usize..ends[1] as usize {
                if self.touched[place] == stamp {
                    remembered.push(Remembered {
                        first: self.first_slot + row as u32,
                        second: self.partners[place],
                        memory: self.memory[place],
                    });
                }
            }
        }
    }

    /// Adds a partner to the row in hand. Partners come in ascending order.
    pub(crate) fn push(&mut self, partner: u32) {
        self.partners.push(partner);
    }

    /// Closes the row in hand.
    pub(crate) fn end_row(&mut self) {
        self.rows.push(self.partners.len() as u32);
    }

    /// Gives the contacts of a finished list their memory back. `remembered` is in ascending order.
    pub(crate) fn recall(&mut self, stamp: u32, remembered: &[Remembered<L::Memory>]) {
        if !Self::REMEMBERS {
            return;
        }
        self.memory.clear();
        self.memory
            .resize(self.partners.len(), L::Memory::default());
        self.touched.clear();
        self.touched
            .resize(self.partners.len(), stamp.wrapping_sub(1));
        let mut remembered = remembered.iter().peekable();
        for (row, ends) in self.rows.windows(2).enumerate() {
            let first = self.first_slot + row as u32;
            for place in ends[0] as usize..ends[1] as usize {
                let key = (first, self.partners[place]);
                while remembered.next_if(|contact| contact.key() < key).is_some() {}
                if let Some(contact) = remembered.next_if(|contact| contact.key() == key) {
                    self.memory[place] = contact.memory;
                    self.touched[place] = stamp;
                }
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
        if !coefficients.is_by_pair() {
            return Ok(());
        }
        for (row, ends) in self.rows.windows(2).enumerate() {
            let first = species[self.first_slot as usize + row];
            for partner in &self.partners[ends[0] as usize..ends[1] as usize] {
                let second = species[*partner as usize];
                self.prepared
                    .push(coefficients.prepare(law, first, second)?);
            }
        }
        Ok(())
    }

    /// How many candidates there are.
    pub(crate) const fn len(&self) -> usize {
        self.partners.len()
    }

    /// The rows: slot, place of the first candidate, and the partners.
    #[inline(always)]
    pub(crate) fn rows(&self) -> impl Iterator<Item = (u32, u32, &[u32])> {
        self.rows.windows(2).enumerate().map(|(row, ends)| {
            let partners = &self.partners[ends[0] as usize..ends[1] as usize];
            (self.first_slot + row as u32, ends[0], partners)
        })
    }

    /// The law's own coefficients of a candidate, if it was asked pair by pair.
    #[inline(always)]
    pub(crate) fn prepared(&self, place: u32) -> Option<&L::Coefficients> {
        self.prepared.get(place as usize)
    }

    /// What a touching candidate remembers from the end of step `stamp`: the default if it did not
    /// touch then.
    #[inline(always)]
    pub(crate) fn memory(&self, place: u32, stamp: u32) -> L::Memory {
        if Self::REMEMBERS && self.touched[place as usize] == stamp {
            self.memory[place as usize]
        } else {
            L::Memory::default()
        }
    }

    /// Keeps what a candidate remembers at the end of step `stamp`.
    #[inline(always)]
    pub(crate) fn keep(&mut self, place: u32, stamp: u32, memory: L::Memory) {
        if Self::REMEMBERS {
            self.memory[place as usize] = memory;
            self.touched[place as usize] = stamp;
        }
    }

    /// Memory in bytes that the list has reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        size_of::<u32>()
            * (self.rows.capacity() + self.partners.capacity() + self.touched.capacity())
            + size_of::<L::Memory>() * self.memory.capacity()
            + size_of::<L::Coefficients>() * self.prepared.capacity()
    }
}
