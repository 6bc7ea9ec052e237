//! A bed spread through the whole room.

use glam::DVec3;

use super::filler::Filler;
use super::occupied::Occupied;
use super::plan::Size;
use crate::cavity::Cavity;
use crate::particle::Particle;

/// How often a particle is thrown into the room before the bed counts as too dense for chance.
const TRIES: usize = 400;

impl<C: Cavity + ?Sized> Filler<'_, C> {
    /// Throws all particles into the room at random, the largest first, each where it overlaps nothing. How
    /// many got a place.
    pub(super) fn scatter(&mut self, sizes: &[Size], bed: &mut [Particle]) -> usize {
        let mut total = 0;
        for size in sizes {
            self.occupied
                .push(Occupied::new(size.radius, self.frame.planar));
            for &number in &size.members {
                let particle = &mut bed[number as usize];
                let Some(place) = self.place_anywhere(particle.radius) else {
                    return total;
                };
                particle.position = place;
                total += 1;
            }
        }
        total
    }

    fn place_anywhere(&mut self, radius: f64) -> Option<DVec3> {
        (0..TRIES).find_map(|_| {
            let point = self.frame.point(|| self.random.unit());
            self.place_at(point, radius)
        })
    }
}
