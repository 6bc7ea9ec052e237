//! What the contacts of a list remember, from the end of one step to the next.
//!
//! Memories lie in the order of the contacts, and a step writes those of its end beside those of its start. So
//! a run of contacts that all persist finds its memories one after the other, and no contact is looked up.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use super::columns::{fit, make_room};

/// The memories of a list of candidates.
#[derive(Debug, Clone)]
pub(super) struct Memories<M> {
    /// The candidates that remember something, ascending.
    candidates: Vec<u32>,
    /// What each remembers.
    memories: Vec<M>,
    /// What contacts will remember at the end of the step.
    next: Vec<M>,
    /// What a run of contacts remembers of which some are new, or follow on others that ended.
    gathered: Vec<M>,
}

impl<M> Default for Memories<M> {
    fn default() -> Self {
        Self {
            candidates: Vec::new(),
            memories: Vec::new(),
            next: Vec::new(),
            gathered: Vec::new(),
        }
    }
}

/// Reads what candidates remember, in ascending order.
#[derive(Debug)]
pub(crate) struct Reader<'a, M> {
    candidates: &'a [u32],
    memories: &'a [M],
}

impl<'a, M> Reader<'a, M> {
    /// What a candidate remembers, if anything: one that comes no earlier in the list than the last.
    #[inline(always)]
    pub(crate) fn of(&mut self, candidate: u32) -> Option<&'a M> {
        let own = skip(self.candidates, candidate);
        self.candidates = &self.candidates[own..];
        self.memories = &self.memories[own..];
        let found = self.candidates.first() == Some(&candidate);
        self.memories.first().filter(|_| found)
    }
}

/// How many of `candidates`, ascending, come before one.
#[inline(always)]
fn skip(candidates: &[u32], candidate: u32) -> usize {
    let mut own = 0;
    while candidates.get(own).is_some_and(|other| *other < candidate) {
        own += 1;
    }
    own
}

impl<M: Copy + Default> Memories<M> {
    /// Whether contacts remember anything; decided when the program is compiled.
    pub(super) const ANY: bool = size_of::<M>() != 0;

    /// How many candidates remember something.
    pub(super) const fn len(&self) -> usize {
        self.candidates.len()
    }

    /// Makes room for whatever comes of `candidates`.
    pub(super) fn reserve(&mut self, candidates: usize) {
        if Self::ANY {
            make_room(&mut self.candidates, candidates);
            make_room(&mut self.memories, candidates);
            make_room(&mut self.next, candidates);
            make_room(&mut self.gathered, candidates);
        }
    }

    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        self.candidates.clear();
        self.memories.clear();
    }

    /// Adds what a candidate remembers that comes later in the list than all before.
    #[inline(always)]
    pub(super) fn push(&mut self, candidate: u32, memory: M) {
        let count = self.candidates.len() + 1;
        make_room(&mut self.candidates, count);
        make_room(&mut self.memories, count);
        self.candidates.push(candidate);
        self.memories.push(memory);
    }

    /// What candidates remember.
    #[inline(always)]
    pub(super) fn reader(&self) -> Reader<'_, M> {
        Reader {
            candidates: &self.candidates,
            memories: &self.memories,
        }
    }

    /// Gets ready for a step at whose end `count` contacts will remember something.
    #[inline(always)]
    pub(super) fn begin(&mut self, count: usize) {
        fit(&mut self.next, count, M::default());
    }

    /// What contacts that follow on one another remember, whose `candidates` are from `start` on among those of all
    /// contacts; and where it is put what they will remember. `place` is how many memories belong to contacts
    /// before.
    #[inline(always)]
    pub(super) fn run(
        &mut self,
        candidates: &[u32],
        start: usize,
        place: &mut usize,
    ) -> (&[M], &mut [M]) {
        let count = candidates.len();
        let next = &mut self.next[start..start + count];
        if !Self::ANY {
            fit(&mut self.gathered, count, M::default());
            return (&self.gathered[..count], next);
        }
        let first = candidates.first().copied().unwrap_or(0);
        *place += skip(&self.candidates[*place..], first);
        let kept = *place..*place + count;
        if self.candidates.get(kept.clone()) == Some(candidates) {
            *place = kept.end;
            return (&self.memories[kept], next);
        }
        let mut reader = Reader {
            candidates: &self.candidates[*place..],
            memories: &self.memories[*place..],
        };
        self.gathered.clear();
        self.gathered.extend(
            candidates
                .iter()
                .map(|candidate| reader.of(*candidate).copied().unwrap_or_default()),
        );
        *place = self.candidates.len() - reader.candidates.len();
        (&self.gathered, next)
    }

    /// Ends the step: `candidates` remember what was put where [`run`](Self::run) told.
    pub(super) fn end(&mut self, candidates: &[u32]) {
        if Self::ANY {
            make_room(&mut self.candidates, candidates.len());
            self.candidates.clear();
            self.candidates.extend_from_slice(candidates);
            std::mem::swap(&mut self.memories, &mut self.next);
        }
    }

    /// Memory in bytes that is reserved.
    pub(super) const fn reserved_bytes(&self) -> usize {
        size_of::<M>() * (self.memories.capacity() + self.next.capacity())
            + size_of::<u32>() * self.candidates.capacity()
    }
}
