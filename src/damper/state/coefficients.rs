//! What the law prepared for every two bodies that can meet.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use crate::contact::{Bodies, Body};
use crate::law::{ContactLaw, LawError};
use crate::material::MaterialId;

/// Beds of more kinds of particles than this prepare pair by pair as particles come near, because a
/// table of all pairs of kinds would no longer stay in the caches.
const TABLE_LIMIT: usize = 64;

/// A kind with another, or with a wall if there is none.
pub(crate) type Meeting = (u32, Option<u32>);

/// Coefficients by pair of kinds, and by kind at a wall.
#[derive(Debug, Clone)]
pub(crate) struct Coefficients<K> {
    kinds: Vec<Body>,
    pairs: Option<Vec<K>>,
    walls: Vec<K>,
}

impl<K: Copy> Coefficients<K> {
    /// Asks `law` for all of `kinds`, with walls of `wall_material`.
    pub(crate) fn new<L: ContactLaw<Coefficients = K>>(
        law: &L,
        kinds: &[Body],
        wall_material: MaterialId,
    ) -> Result<Self, LawError> {
        let wall = Body::wall(wall_material);
        let walls = kinds
            .iter()
            .map(|kind| law.coefficients(&Bodies::new(*kind, wall)));
        let pairs = (kinds.len() <= TABLE_LIMIT).then(|| {
            kinds
                .iter()
                .flat_map(|first| kinds.iter().map(move |second| Bodies::new(*first, *second)))
                .map(|bodies| law.coefficients(&bodies))
                .collect::<Result<Vec<_>, _>>()
        });
        Ok(Self {
            kinds: kinds.to_vec(),
            walls: walls.collect::<Result<_, _>>()?,
            pairs: pairs.transpose()?,
        })
    }

    /// The longest time step that `law` allows for every contact with `wall` and every pair of kinds; of a
    /// long list of kinds, for every kind against itself and against the lightest. Beside it the kind
    /// that sets it, with the other if it is a pair.
    pub(crate) fn time_step_limit<L>(
        &self,
        law: &L,
        wall: Body,
    ) -> Result<(f64, Option<Meeting>), LawError>
    where
        L: ContactLaw<Coefficients = K>,
    {
        let mut shortest = (f64::INFINITY, None);
        let mut heed = |coefficients: &K, kind: usize, other: Option<usize>| {
            let limit = law.time_step_limit(coefficients);
            if limit < shortest.0 || limit.is_nan() {
                shortest = (limit, Some((kind as u32, other.map(|kind| kind as u32))));
            }
        };
        for (number, kind) in self.kinds.iter().enumerate() {
            heed(&law.coefficients(&Bodies::new(*kind, wall))?, number, None);
        }
        let count = self.kinds.len();
        if let Some(pairs) = &self.pairs {
            for (number, pair) in pairs.iter().enumerate() {
                heed(pair, number / count, Some(number % count));
            }
            return Ok(shortest);
        }
        let masses = self.kinds.iter().enumerate();
        let lightest = masses.min_by(|a, b| a.1.mass.total_cmp(&b.1.mass));
        for own in self.kinds.iter().enumerate() {
            for other in [own].into_iter().chain(lightest) {
                let pair = law.coefficients(&Bodies::new(*own.1, *other.1))?;
                heed(&pair, own.0, Some(other.0));
            }
        }
        Ok(shortest)
    }

    /// Whether pairs have to be prepared one by one ([`prepare`](Self::prepare)).
    pub(crate) const fn is_by_pair(&self) -> bool {
        self.pairs.is_none()
    }

    /// Asks `law` for one pair of kinds.
    pub(crate) fn prepare<L>(&self, law: &L, first: u32, second: u32) -> Result<K, LawError>
    where
        L: ContactLaw<Coefficients = K>,
    {
        let kind = |number: u32| self.kinds[number as usize];
        law.coefficients(&Bodies::new(kind(first), kind(second)))
    }

    /// The coefficients of two kinds; `prepared` are those of the pair, if it has its own.
    #[inline(always)]
    pub(crate) fn pair(&self, first: u32, second: u32, prepared: Option<&K>) -> K {
        match (&self.pairs, prepared) {
            (_, Some(own)) => *own,
            (Some(table), None) => table[first as usize * self.kinds.len() + second as usize],
            // A pair is prepared whenever there is no table.
            (None, None) => self.walls[first as usize],
        }
    }

    /// The radius of every particle in m, if there is one kind alone.
    pub(crate) fn only_radius(&self) -> Option<f64> {
        match self.kinds.as_slice() {
            [only] => Some(only.radius),
            _ => None,
        }
    }

    /// The coefficients of every pair, if there is one kind alone.
    pub(crate) fn only_pair(&self) -> Option<&K> {
        match self.pairs.as_deref() {
            Some([only]) => Some(only),
            _ => None,
        }
    }

    /// The coefficients of every contact with a wall, if there is one kind alone.
    pub(crate) fn only_wall(&self) -> Option<&K> {
        match self.walls.as_slice() {
            [only] => Some(only),
            _ => None,
        }
    }

    /// The coefficients of a kind at a wall.
    #[inline(always)]
    pub(crate) fn wall(&self, kind: u32) -> &K {
        &self.walls[kind as usize]
    }
}
