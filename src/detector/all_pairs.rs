use super::{Bed, Detector, Pairs};

/// Tests every pair (the paper's Eq. 8, with the contact distance r1 + r2 that it means): exact,
/// without any memory, and of cost N^2.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct AllPairs;

/// Partners tested at a time.
const BATCH: usize = 4;

impl Detector for AllPairs {
    fn detect(&mut self, bed: &Bed<'_>, pairs: &mut Pairs) {
        for (a, (&centre, &radius)) in bed.positions.iter().zip(bed.radii).enumerate() {
            let (partners, _) = bed.positions[a + 1..].as_chunks::<BATCH>();
            let (radii, rest) = bed.radii[a + 1..].as_chunks::<BATCH>();
            let mut first = a + 1;
            for (partners, radii) in partners.iter().zip(radii) {
                let near: [bool; BATCH] = std::array::from_fn(|which| {
                    let reach = radius + radii[which] + bed.margin;
                    centre.distance_squared(partners[which]) < reach * reach
                });
                // Rarely taken, and no other branch: most pairs are far apart.
                if near.iter().fold(false, |any, &near| any | near) {
                    for (which, &near) in near.iter().enumerate() {
                        if near {
                            pairs.push(a, first + which);
                        }
                    }
                }
                first += BATCH;
            }
            for b in first..first + rest.len() {
                if bed.are_near(a, b) {
                    pairs.push(a, b);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn touching_neighbours_in_a_row_are_found_in_order() {
        for count in 0..12_u32 {
            let positions: Vec<_> = (0..count).map(|x| DVec3::X * f64::from(x)).collect();
            let radii = vec![0.51; positions.len()];
            let bed = Bed::new(&positions, &radii, [DVec3::ZERO, DVec3::ONE]);
            let mut pairs = Pairs::default();
            AllPairs.detect(&bed, &mut pairs);
            let row: Vec<_> = (1..count).map(|x| [x - 1, x]).collect();
            assert_eq!(pairs.as_slice(), row);
        }
    }
}
