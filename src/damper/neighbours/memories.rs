//! What the candidates of a list remember, from the end of one step to the next.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use super::columns::{fit, make_room};

/// The memories of a list of candidates.
#[derive(Debug, Clone)]
pub(super) struct Memories<M> {
    /// Index of the entry of each candidate, or [`NONE`]; empty if contacts remember nothing, and if each has
    /// the entry of its own index.
    entry: Vec<u32>,
    /// What those remember that have touched since they were listed, or had before.
    entries: Vec<Entry<M>>,
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

impl<M> Default for Memories<M> {
    fn default() -> Self {
        Self {
            entry: Vec::new(),
            entries: Vec::new(),
        }
    }
}

impl<M: Copy + Default> Memories<M> {
    /// Whether contacts remember anything; decided when the program is compiled.
    pub(super) const ANY: bool = size_of::<M>() != 0;

    /// Whether each candidate has an entry of its own. The entries of a larger memory would not stay in
    /// the caches, and those of contacts alone are kept.
    const EACH: bool = Self::ANY && size_of::<Entry<M>>() <= 16;

    /// How many candidates may remember something.
    pub(super) const fn len(&self) -> usize {
        self.entries.len()
    }

    /// Makes room for whatever comes of `candidates`.
    pub(super) fn reserve(&mut self, candidates: usize) {
        if Self::ANY {
            make_room(&mut self.entry, if Self::EACH { 0 } else { candidates });
            make_room(&mut self.entries, candidates);
        }
    }

    /// Starts anew for `count` candidates, as many as `kept` of which will be given their memory back that
    /// touched at the end of step `stamp`.
    pub(super) fn forget(&mut self, count: usize, kept: usize, stamp: u32) {
        self.entry.clear();
        self.entries.clear();
        if Self::EACH {
            let forgotten = Entry {
                touched: stamp.wrapping_sub(1),
                memory: M::default(),
            };
            fit(&mut self.entries, count, forgotten);
        } else {
            fit(&mut self.entry, count, NONE);
            make_room(&mut self.entries, kept.min(count));
        }
    }

    /// What a candidate remembers that touched at the end of step `stamp`, if contacts remember anything.
    #[inline(always)]
    pub(super) fn of(&self, candidate: usize, stamp: u32) -> Option<&M> {
        if !Self::ANY {
            return None;
        }
        let own = if Self::EACH {
            candidate
        } else {
            self.entry[candidate] as usize
        };
        let entry = self.entries.get(own);
        let touched = entry.filter(|entry| entry.touched == stamp);
        touched.map(|entry| &entry.memory)
    }

    /// Keeps what a candidate remembers at the end of step `stamp`.
    #[inline(always)]
    pub(super) fn keep(&mut self, candidate: usize, stamp: u32, memory: &M) {
        let Self { entry, entries } = self;
        if Self::EACH {
            entries[candidate] = Entry {
                touched: stamp,
                memory: *memory,
            };
            return;
        }
        // Each straight to its place: through a temporary it would be copied twice.
        let own = &mut entry[candidate];
        if let Some(entry) = entries.get_mut(*own as usize) {
            entry.touched = stamp;
            entry.memory = *memory;
        } else {
            let count = entries.len();
            *own = count as u32;
            make_room(entries, count + 1);
            entries.push(Entry {
                touched: stamp,
                memory: *memory,
            });
        }
    }

    /// Memory in bytes that is reserved.
    pub(super) const fn reserved_bytes(&self) -> usize {
        size_of::<Entry<M>>() * self.entries.capacity() + size_of::<u32>() * self.entry.capacity()
    }
}
