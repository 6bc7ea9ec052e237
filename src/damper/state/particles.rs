//! Columns of particle data.
//!
//! A particle keeps the number it was given; where it stands in the columns is its *index*, which a
//! spatial sort may change.

use super::vectors::{Axes, Vectors};
use crate::contact::Body;
use crate::particle::Particle;

/// The bed: one entry per particle in each column.
#[derive(Debug, Clone, Default)]
pub(crate) struct Particles {
    /// Centres in the fixed frame, m.
    pub(crate) position: Vectors,
    /// m/s.
    pub(crate) velocity: Vectors,
    /// rad/s.
    pub(crate) spin: Vectors,
    /// m/s^2.
    pub(crate) acceleration: Vectors,
    /// rad/s^2.
    pub(crate) angular_acceleration: Vectors,
    /// m.
    pub(crate) radius: Vec<f64>,
    /// 1/kg.
    pub(crate) inverse_mass: Vec<f64>,
    /// 1/(kg m^2).
    pub(crate) inverse_inertia: Vec<f64>,
    /// Number of the combination of radius, mass and material.
    pub(crate) species: Vec<u32>,
    /// Number of the particle at each index.
    pub(crate) id: Vec<u32>,
    /// Index of the particle of each number.
    pub(crate) index_of: Vec<u32>,
    /// The combinations that occur.
    pub(crate) kinds: Vec<Body>,
    /// m; infinite without particles.
    pub(crate) smallest_radius: f64,
}

impl Particles {
    /// Columns of `particles`, which the caller has ordered by cavity; `id` are their numbers.
    /// With `planar` all of them stay in the plane z = 0.
    pub(crate) fn new(particles: &[Particle], id: Vec<u32>, planar: bool) -> Self {
        let count = particles.len();
        let (moving, turning) = if planar {
            (Axes::Plane, Axes::Normal)
        } else {
            (Axes::Space, Axes::Space)
        };
        let mut columns = Self {
            position: Vectors::zeros(moving, count),
            velocity: Vectors::zeros(moving, count),
            spin: Vectors::zeros(turning, count),
            acceleration: Vectors::zeros(moving, count),
            angular_acceleration: Vectors::zeros(turning, count),
            id,
            index_of: vec![0; particles.len()],
            smallest_radius: particles
                .iter()
                .map(|own| own.radius)
                .fold(f64::INFINITY, f64::min),
            ..Self::default()
        };
        for (index, number) in columns.id.iter().enumerate() {
            columns.index_of[*number as usize] = index as u32;
        }
        let mut known: std::collections::HashMap<[u64; 3], u32> = std::collections::HashMap::new();
        for particle in particles {
            let body = Body::sphere(particle.radius, particle.mass, particle.material);
            let key = [
                body.radius.to_bits(),
                body.mass.to_bits(),
                u64::from(body.material.0),
            ];
            let species = *known.entry(key).or_insert_with(|| {
                columns.kinds.push(body);
                columns.kinds.len() as u32 - 1
            });
            columns.radius.push(particle.radius);
            columns.inverse_mass.push(1.0 / particle.mass);
            columns.inverse_inertia.push(1.0 / particle.inertia());
            columns.species.push(species);
        }
        columns
            .position
            .assign(particles.iter().map(|own| own.position));
        columns
            .velocity
            .assign(particles.iter().map(|own| own.velocity));
        columns.spin.assign(particles.iter().map(|own| own.spin));
        columns
    }

    /// Moves each particle to the index that `number` gives it.
    pub(crate) fn rearrange(&mut self, number: &[u32]) {
        let from: Vec<usize> = number
            .iter()
            .map(|number| self.index_of[*number as usize] as usize)
            .collect();
        for column in [
            &mut self.position,
            &mut self.velocity,
            &mut self.spin,
            &mut self.acceleration,
            &mut self.angular_acceleration,
        ] {
            column.permute(&from);
        }
        permute(&mut self.radius, &from);
        permute(&mut self.inverse_mass, &from);
        permute(&mut self.inverse_inertia, &from);
        permute(&mut self.species, &from);
        self.id.copy_from_slice(number);
        for (index, number) in number.iter().enumerate() {
            self.index_of[*number as usize] = index as u32;
        }
    }

    pub(crate) const fn len(&self) -> usize {
        self.position.len()
    }

    /// Memory in bytes that the columns have reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        let vectors = [
            &self.position,
            &self.velocity,
            &self.spin,
            &self.acceleration,
            &self.angular_acceleration,
        ];
        let scalars = [&self.radius, &self.inverse_mass, &self.inverse_inertia];
        let numbers = [&self.species, &self.id, &self.index_of];
        vectors.map(Vectors::reserved_bytes).iter().sum::<usize>()
            + size_of::<f64>() * scalars.map(Vec::capacity).iter().sum::<usize>()
            + size_of::<u32>() * numbers.map(Vec::capacity).iter().sum::<usize>()
    }

    /// The particle at an index, in cavity `cavity`.
    pub(crate) fn particle(&self, index: usize, cavity: u32) -> Particle {
        let body = self.kinds[self.species[index] as usize];
        Particle {
            radius: body.radius,
            mass: body.mass,
            material: body.material,
            cavity,
            position: self.position.get(index),
            velocity: self.velocity.get(index),
            spin: self.spin.get(index),
        }
    }
}

/// Fills a column with its values at the places `from`.
fn permute<T: Copy>(column: &mut [T], from: &[usize]) {
    let moved: Vec<T> = from.iter().map(|place| column[*place]).collect();
    column.copy_from_slice(&moved);
}
