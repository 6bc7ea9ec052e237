use glam::DVec3;

use super::lattice::{Frame, Lattice, Pattern};
use super::occupied::Occupied;
use super::plan::{GAP, Plan, Size};
use crate::cavity::{Cavity, clearance};
use crate::particle::Particle;
use crate::random::Random;

/// How far a site may stand too near to a wall and still be used, shifted off it, over the diameter.
const SHIFT: f64 = 0.5;

/// One try to place the bed.
#[derive(Debug)]
pub(super) struct Filler<'a, C: ?Sized> {
    pub(super) cavity: &'a C,
    pub(super) frame: Frame,
    pub(super) plan: Plan,
    /// Whether particles of a size differ.
    pub(super) varied: bool,
    /// Whether the whole room is filled, instead of layers from the floor up.
    pub(super) throughout: bool,
    pub(super) random: &'a mut Random,
    /// What stands already, by size.
    pub(super) occupied: Vec<Occupied>,
}

impl<C: Cavity + ?Sized> Filler<'_, C> {
    /// How many particles got a place.
    pub(super) fn place_all(&mut self, sizes: &mut [Size], bed: &mut [Particle]) -> usize {
        let mut total = 0;
        for size in sizes {
            if self.varied {
                self.random.shuffle(&mut size.members);
            }
            let placed = self.place(size, bed);
            total += placed;
            if placed < size.members.len() {
                break;
            }
        }
        total
    }

    fn place(&mut self, size: &Size, bed: &mut [Particle]) -> usize {
        self.occupied
            .push(Occupied::new(size.radius, self.frame.planar));
        let Plan {
            pattern, looseness, ..
        } = self.plan;
        let wanted = size.members.len();
        let lattice = Lattice::new(self.frame, pattern, size.radius, looseness, wanted);
        let lattice = if self.plan.centred {
            lattice.centred()
        } else {
            lattice.moved([self.random.unit(), self.random.unit()])
        };
        let mut placed = 0;
        let mut sites = Vec::new();
        for layer in lattice.layers() {
            let missing = wanted - placed;
            for row in lattice.rows(layer) {
                self.collect(size, &lattice, lattice.row(layer, row), &mut sites);
                // Enough to choose from, however wide the cavity.
                if sites.len() > 4 * missing + 1000 && !self.throughout {
                    break;
                }
            }
            if !self.throughout {
                placed += self.fill_sites(&mut sites, &size.members[placed..], lattice.slack, bed);
            }
            if placed == wanted {
                return placed;
            }
        }
        placed + self.fill_sites(&mut sites, &size.members[placed..], lattice.slack, bed)
    }

    /// Stands `members` near the sites, and returns how many got a place. All sites are used up.
    fn fill_sites(
        &mut self,
        sites: &mut Vec<DVec3>,
        members: &[u32],
        slack: [f64; 3],
        bed: &mut [Particle],
    ) -> usize {
        if sites.len() > members.len() {
            self.random.shuffle(sites);
        }
        let mut placed = 0;
        for site in sites.drain(..) {
            let Some(&member) = members.get(placed) else {
                break;
            };
            let particle = &mut bed[member as usize];
            if let Some(place) = self.place_near(site, particle.radius, slack) {
                particle.position = place;
                placed += 1;
            }
        }
        placed
    }

    /// Adds the sites of a row that stand inside the cavity, or nearly.
    fn collect(
        &mut self,
        size: &Size,
        lattice: &Lattice,
        (start, count): (DVec3, i64),
        sites: &mut Vec<DVec3>,
    ) {
        let stride = lattice.stride();
        let pitch = stride.length();
        let strewn = self.plan.pattern == Pattern::Spread;
        let share = if self.plan.mixed && !strewn {
            size.share
        } else {
            1.0
        };
        let mut number = 0;
        while number < count {
            let site = start + stride * number as f64;
            let behind = size.radius - clearance(self.cavity, site) - SHIFT * 2.0 * size.radius;
            if behind > 0.0 {
                // Distances change no more than the site moves, so none is missed.
                number = number.saturating_add(((behind / pitch) as i64).max(1));
                continue;
            }
            if share >= 1.0 || self.random.unit() < share {
                sites.push(site);
            }
            number += 1;
        }
    }

    /// Stands a particle at a random place near `site`, or else as near as can be.
    fn place_near(&mut self, site: DVec3, radius: f64, slack: [f64; 3]) -> Option<DVec3> {
        let mut shifted = site;
        for (axis, slack) in self.frame.axes.into_iter().zip(slack) {
            shifted += axis * (slack * self.random.symmetric());
        }
        if self.frame.planar {
            shifted.z = 0.0;
        }
        self.place_at(shifted, radius)
            .or_else(|| self.place_at(site, radius))
    }

    /// Stands a particle at `point`, off the walls, if there is room.
    pub(super) fn place_at(&mut self, point: DVec3, radius: f64) -> Option<DVec3> {
        let radius = radius * (1.0 + GAP);
        let place = self.free_place(point, radius)?;
        if let Some(occupied) = self.occupied.last_mut() {
            occupied.add(place, radius);
        }
        Some(place)
    }

    /// `place`, off the walls, if no other particle stands there.
    fn free_place(&self, place: DVec3, radius: f64) -> Option<DVec3> {
        let place = self.off_walls(place, radius)?;
        self.occupied
            .iter()
            .all(|occupied| occupied.has_room(place, radius))
            .then_some(place)
    }

    /// `place` with a gap to all walls, or else, where a particle fits exactly, pressed into them by no more
    /// than the gap would be.
    fn off_walls(&self, place: DVec3, radius: f64) -> Option<DVec3> {
        self.clear_of_walls(place, radius)
            .or_else(|| self.clear_of_walls(place, radius * (1.0 - 2.0 * GAP)))
    }

    fn clear_of_walls(&self, mut place: DVec3, radius: f64) -> Option<DVec3> {
        const TRIES: usize = 8;
        for _ in 0..TRIES {
            let nearest = (0..self.cavity.walls())
                .map(|number| self.cavity.wall(number, place))
                .min_by(|a, b| a.distance.total_cmp(&b.distance));
            let Some(wall) = nearest.filter(|wall| wall.distance < radius) else {
                return Some(place);
            };
            place += wall.normal * (radius - wall.distance + 0.1 * GAP * radius);
        }
        None
    }
}
