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
    now: Vec<M>,
    /// What contacts will remember at the end of the step.
    next: Vec<M>,
    /// What a run of contacts remembers of which some are new, or follow on others that ended.
    gathered: Vec<M>,
    /// How many of the candidates belong to the runs so far.
    place: usize,
}

impl<M> Default for Memories<M> {
    fn default() -> Self {
        Self {
            candidates: Vec::new(),
            now: Vec::new(),
            next: Vec::new(),
            gathered: Vec::new(),
            place: 0,
        }
    }
}

/// How many contacts make a run at the most.
pub(crate) const LONGEST_RUN: usize = 32;

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
            make_room(&mut self.now, candidates);
            make_room(&mut self.next, candidates);
            make_room(&mut self.gathered, candidates.min(LONGEST_RUN));
        }
    }

    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        self.candidates.clear();
        self.now.clear();
    }

    /// Adds what a candidate remembers that comes later in the list than all before.
    #[inline(always)]
    pub(super) fn push(&mut self, candidate: u32, memory: M) {
        let count = self.candidates.len() + 1;
        make_room(&mut self.candidates, count);
        make_room(&mut self.now, count);
        self.candidates.push(candidate);
        self.now.push(memory);
    }

    /// What candidates remember.
    #[inline(always)]
    pub(super) fn reader(&self) -> Reader<'_, M> {
        Reader {
            candidates: &self.candidates,
            memories: &self.now,
        }
    }

    /// Gets ready for a step at whose end `count` contacts will remember something.
    #[inline(always)]
    pub(super) fn begin(&mut self, count: usize) {
        fit(&mut self.next, count, M::default());
        self.place = 0;
    }

    /// What the contacts of the next run remember, whose `candidates` are from `start` on among those of all contacts;
    /// and where it is put what they will remember.
    #[inline(always)]
    pub(super) fn run(&mut self, candidates: &[u32], start: usize) -> (&[M], &mut [M]) {
        let count = candidates.len();
        let next = &mut self.next[start..start + count];
        if !Self::ANY {
            fit(&mut self.gathered, count, M::default());
            return (&self.gathered[..count], next);
        }
        let first = candidates.first().copied().unwrap_or(0);
        self.place += skip(&self.candidates[self.place..], first);
        let kept = self.place..self.place + count;
        if self.candidates.get(kept.clone()) == Some(candidates) {
            self.place = kept.end;
            return (&self.now[kept], next);
        }
        fit(&mut self.gathered, count, M::default());
        let memories = &self.now[..self.candidates.len()];
        for (memory, candidate) in self.gathered.iter_mut().zip(candidates) {
            self.place += skip(&self.candidates[self.place..], *candidate);
            *memory = match self.candidates.get(self.place) {
                Some(own) if own == candidate => memories[self.place],
                _ => M::default(),
            };
        }
        (&self.gathered, next)
    }

    /// Ends the step: `candidates` remember what was put where [`run`](Self::run) told.
    pub(super) fn end(&mut self, candidates: &[u32]) {
        if Self::ANY {
            make_room(&mut self.candidates, candidates.len());
            self.candidates.clear();
            self.candidates.extend_from_slice(candidates);
            std::mem::swap(&mut self.now, &mut self.next);
        }
    }

    /// Memory in bytes that is reserved.
    pub(super) const fn reserved_bytes(&self) -> usize {
        size_of::<M>() * (self.now.capacity() + self.next.capacity() + self.gathered.capacity())
            + size_of::<u32>() * self.candidates.capacity()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A step in runs of `size` contacts, in which each advances its memory by one.
    fn step(memories: &mut Memories<u64>, touching: &[u32], size: usize) -> Vec<u64> {
        memories.begin(touching.len());
        let mut seen = Vec::new();
        for (n, candidates) in touching.chunks(size).enumerate() {
            let (now, next) = memories.run(candidates, n * size);
            seen.extend_from_slice(now);
            for (next, now) in next[..now.len()].iter_mut().zip(now) {
                *next = now + 1;
            }
        }
        memories.end(touching);
        seen
    }

    #[test]
    fn contacts_that_persist_remember_whatever_begins_and_ends_beside_them() {
        for size in [1, 2, 3, 100] {
            let mut memories = Memories::default();
            let mut since = [None; 40];
            for round in 0..60_u32 {
                let is_touching = |n: &u32| !(n * n + 7 * (round / (1 + n % 5))).is_multiple_of(3);
                let touching: Vec<u32> = (0..40).filter(is_touching).collect();
                let expected: Vec<u64> = touching
                    .iter()
                    .map(|n| since[*n as usize].unwrap_or(0))
                    .collect();
                assert_eq!(step(&mut memories, &touching, size), expected);
                let mut reader = memories.reader();
                for n in 0..40 {
                    let own = &mut since[n as usize];
                    *own = is_touching(&n).then(|| own.unwrap_or(0) + 1);
                    assert_eq!(reader.of(n).copied(), *own);
                }
            }
        }
    }

    #[test]
    fn what_has_not_ended_a_step_is_not_remembered() {
        let mut memories = Memories::default();
        step(&mut memories, &[1, 4], 8);
        memories.begin(2);
        let (now, next) = memories.run(&[1, 5], 0);
        assert_eq!(now, [1, 0]);
        next.fill(9);
        assert_eq!(step(&mut memories, &[1, 4, 5], 8), [1, 1, 0]);
    }
}
