use super::{Bed, Detector, Pairs};

/// Tests every pair (the paper's Eq. 8, with the contact distance r1 + r2 that it means): exact,
/// without any memory, and of cost N^2.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct AllPairs;

impl Detector for AllPairs {
    fn detect(&mut self, bed: &Bed<'_>, pairs: &mut Pairs) {
        for a in 0..bed.len() {
            for b in a + 1..bed.len() {
                if bed.are_near(a, b) {
                    pairs.push(a, b);
                }
            }
        }
    }
}
