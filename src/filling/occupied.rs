use glam::DVec3;

/// Spheres placed so far, hashed by cell: quick to ask, and as large as what it holds.
#[derive(Debug)]
pub(super) struct Occupied {
    cell: f64,
    planar: bool,
    heads: Vec<u32>,
    spheres: Vec<Sphere>,
}

#[derive(Debug)]
struct Sphere {
    centre: DVec3,
    radius: f64,
    next: u32,
}

const NONE: u32 = u32::MAX;

impl Occupied {
    /// Room for spheres of `radius` at the most.
    pub(super) fn new(radius: f64, planar: bool) -> Self {
        Self {
            cell: 2.0 * radius,
            planar,
            heads: vec![NONE; 64],
            spheres: Vec::new(),
        }
    }

    pub(super) fn add(&mut self, centre: DVec3, radius: f64) {
        if self.spheres.len() >= self.heads.len() {
            self.grow();
        }
        let bucket = self.bucket(self.cell_of(centre));
        let number = self.spheres.len() as u32;
        let next = std::mem::replace(&mut self.heads[bucket], number);
        self.spheres.push(Sphere {
            centre,
            radius,
            next,
        });
    }

    /// Whether a sphere of `radius`, no larger than any here may be, overlaps none.
    pub(super) fn has_room(&self, centre: DVec3, radius: f64) -> bool {
        let [i, j, k] = self.cell_of(centre);
        let depth = if self.planar { 0..=0 } else { -1..=1 };
        for dk in depth {
            for dj in -1..=1 {
                for di in -1..=1 {
                    let bucket = self.bucket([i + di, j + dj, k + dk]);
                    let mut number = self.heads[bucket];
                    while number != NONE {
                        let other = &self.spheres[number as usize];
                        let reach = radius + other.radius;
                        if centre.distance_squared(other.centre) < reach * reach {
                            return false;
                        }
                        number = other.next;
                    }
                }
            }
        }
        true
    }

    fn cell_of(&self, point: DVec3) -> [i64; 3] {
        (point / self.cell)
            .floor()
            .to_array()
            .map(|place| place as i64)
    }

    /// Cells that follow each other along x are neighbours in memory too.
    fn bucket(&self, [i, j, k]: [i64; 3]) -> usize {
        let hash = i
            .wrapping_add(j.wrapping_mul(73_856_093))
            .wrapping_add(k.wrapping_mul(19_349_663));
        hash as usize & (self.heads.len() - 1)
    }

    fn grow(&mut self) {
        self.heads = vec![NONE; 4 * self.heads.len()];
        for number in 0..self.spheres.len() {
            let bucket = self.bucket(self.cell_of(self.spheres[number].centre));
            self.spheres[number].next = std::mem::replace(&mut self.heads[bucket], number as u32);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn room_is_what_a_check_of_all_spheres_finds() {
        let mut random = Random::new(5);
        let mut point = || DVec3::from_array([0; 3].map(|_| random.symmetric()));
        let mut occupied = Occupied::new(0.06, false);
        let mut spheres: Vec<(DVec3, f64)> = Vec::new();
        for number in 0..3000_u32 {
            let (centre, radius) = (point(), 0.02 + 0.04 * f64::from(number % 3) / 2.0);
            let free = spheres
                .iter()
                .all(|(other, r)| centre.distance(*other) >= radius + r);
            assert_eq!(occupied.has_room(centre, radius), free);
            if free {
                occupied.add(centre, radius);
                spheres.push((centre, radius));
            }
        }
        assert!(spheres.len() > 500, "{}", spheres.len());
    }
}
