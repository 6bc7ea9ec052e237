//! Digests of bits.

use glam::DVec3;

/// A hash of words in their order, after FNV-1a (Fowler, Noll & Vo) with the upper half folded down
/// after each; the same on every platform.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Digest(u64);

impl Default for Digest {
    fn default() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }
}

impl Digest {
    pub(crate) const fn word(&mut self, word: u64) {
        let product = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01B3);
        self.0 = product ^ (product >> 32);
    }

    /// All that another has taken up.
    pub(crate) const fn add(&mut self, other: Self) {
        self.word(other.0);
    }

    pub(crate) fn words(&mut self, words: &[u32]) {
        self.word(words.len() as u64);
        for word in words {
            self.word(u64::from(*word));
        }
    }

    /// Every bit of a number.
    pub(crate) const fn number(&mut self, number: f64) {
        self.word(number.to_bits());
    }

    pub(crate) fn numbers(&mut self, numbers: &[f64]) {
        self.word(numbers.len() as u64);
        for number in numbers {
            self.number(*number);
        }
    }

    pub(crate) fn vector(&mut self, vector: DVec3) {
        for number in vector.to_array() {
            self.number(number);
        }
    }

    pub(crate) fn vectors(&mut self, vectors: &[DVec3]) {
        self.word(vectors.len() as u64);
        for vector in vectors {
            self.vector(*vector);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_digest_depends_on_every_bit_and_on_the_order() {
        let of = |words: [u64; 3]| {
            let mut digest = Digest::default();
            for word in words {
                digest.word(word);
            }
            digest
        };
        let words = [1.5_f64.to_bits(), 0, 7];
        for place in 0..3 {
            for bit in 0..64 {
                let mut other = words;
                other[place] ^= 1 << bit;
                assert_ne!(of(other), of(words), "bit {bit} of word {place}");
            }
        }
        assert_ne!(of([words[1], words[0], words[2]]), of(words));
    }
}
