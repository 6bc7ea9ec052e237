//! Columns of particle data.
//!
//! A particle keeps the number it was given; where it stands in the columns is its *slot*, which a
//! spatial sort may change.

use glam::DVec3;

use crate::contact::Body;
use crate::particle::Particle;

/// The bed: one entry per particle in each column.
#[derive(Debug, Clone, Default)]
pub(crate) struct Particles {
    /// Centres in the fixed frame, m.
    pub(crate) position: Vec<DVec3>,
    /// m/s.
    pub(crate) velocity: Vec<DVec3>,
    /// rad/s.
    pub(crate) spin: Vec<DVec3>,
    /// m/s^2.
    pub(crate) acceleration: Vec<DVec3>,
    /// rad/s^2.
    pub(crate) angular_acceleration: Vec<DVec3>,
    /// m.
    pub(crate) radius: Vec<f64>,
    /// 1/kg.
    pub(crate) inverse_mass: Vec<f64>,
    /// 1/(kg m^2).
    pub(crate) inverse_inertia: Vec<f64>,
    /// Number of the combination of radius, mass and material.
    pub(crate) species: Vec<u32>,
    /// Particle number of each slot.
    pub(crate) number: Vec<u32>,
    /// Slot of each particle number.
    pub(crate) slot: Vec<u32>,
    /// The combinations that occur.
    pub(crate) kinds: Vec<Body>,
}

impl Particles {
    /// Columns of `particles`, which the caller has ordered by cavity; `number` are their numbers.
    pub(crate) fn new(particles: &[Particle], number: Vec<u32>) -> Self {
        let mut columns = Self {
            number,
            slot: vec![0; particles.len()],
            ..Self::default()
        };
        for (slot, number) in columns.number.iter().enumerate() {
            columns.slot[*number as usize] = slot as u32;
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
            columns.position.push(particle.position);
            columns.velocity.push(particle.velocity);
            columns.spin.push(particle.spin);
            columns.radius.push(particle.radius);
            columns.inverse_mass.push(1.0 / particle.mass);
            columns.inverse_inertia.push(1.0 / particle.inertia());
            columns.species.push(species);
        }
        columns.acceleration = vec![DVec3::ZERO; particles.len()];
        columns.angular_acceleration = vec![DVec3::ZERO; particles.len()];
        columns
    }

    /// Moves what never changes of each particle to the slots that `number` gives it. The columns of
    /// motion are the caller's to move.
    pub(crate) fn rearrange(&mut self, number: &[u32]) {
        let from: Vec<usize> = number
            .iter()
            .map(|number| self.slot[*number as usize] as usize)
            .collect();
        self.radius = from.iter().map(|slot| self.radius[*slot]).collect();
        self.inverse_mass = from.iter().map(|slot| self.inverse_mass[*slot]).collect();
        self.inverse_inertia = from
            .iter()
            .map(|slot| self.inverse_inertia[*slot])
            .collect();
        self.species = from.iter().map(|slot| self.species[*slot]).collect();
        self.number.copy_from_slice(number);
        for (slot, number) in number.iter().enumerate() {
            self.slot[*number as usize] = slot as u32;
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
        let numbers = [&self.species, &self.number, &self.slot];
        size_of::<DVec3>() * vectors.map(Vec::capacity).iter().sum::<usize>()
            + size_of::<f64>() * scalars.map(Vec::capacity).iter().sum::<usize>()
            + size_of::<u32>() * numbers.map(Vec::capacity).iter().sum::<usize>()
    }

    /// The particle in a slot, in cavity `cavity`.
    pub(crate) fn particle(&self, slot: usize, cavity: u32) -> Particle {
        let body = self.kinds[self.species[slot] as usize];
        Particle {
            radius: body.radius,
            mass: body.mass,
            material: body.material,
            cavity,
            position: self.position[slot],
            velocity: self.velocity[slot],
            spin: self.spin[slot],
        }
    }
}
