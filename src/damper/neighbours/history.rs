//! Contact history: what contacts remember while their candidates are listed anew.

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
