//! The normal force that the strict laws share.

use std::f64::consts::PI;

use super::LawError;
use super::damping::{Damping, Ending};
use super::hertz::ElasticImpact;
use crate::contact::{Bodies, Contact, Stored};
use crate::error::{Bound, ValueError};
use crate::material::{Interaction, Material, MaterialId, Materials};
use crate::numbers::at_least;

/// The fewest steps to a contact. In a hexagonal packing as compressed as an impact at the reference
/// speed, the fastest oscillation has sqrt 3 times the frequency of one contact; with four, frequency
/// times step is 1.75, under the 2 that Verlet's method bears.
const FEWEST_STEPS: f64 = 4.0;

/// What integration can add to the energy of an undamped impact in n steps, times n^3, from above: of
/// bodies that meet one, two or three others, in any phase of the step, under both integrators.
const GAIN: f64 = 4.0;

/// Enough steps to a contact for any restitution: what an impact without damping can gain is below
/// 4/50^3, and a thousand bounces of one ball change its energy by less than 1e-4.
const ELASTIC_STEPS: f64 = 50.0;

/// The fewest steps to half an oscillation in which damping takes more energy than integration can add.
pub(super) fn damped_steps(restitution: f64) -> f64 {
    libm::cbrt(GAIN / (1.0 - restitution * restitution))
}

/// The same to a contact with an oscillation `quickness` times as fast as its own.
fn fewest_steps(restitution: f64, quickness: f64) -> f64 {
    (quickness * damped_steps(restitution)).clamp(FEWEST_STEPS, ELASTIC_STEPS)
}

/// Hertz's spring with damping, for a table of materials.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NormalForce {
    materials: Materials,
    pub(super) damping: Damping,
    pub(super) ending: Ending,
    reference_speed: f64,
    /// The damping number of each ordered pair of materials, row by row.
    numbers: Vec<Result<f64, ValueError>>,
    count: usize,
}

/// Constants of the normal force of two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct NormalCoefficients {
    /// k in N/m^(3/2).
    pub(super) stiffness: f64,
    /// c in N s/m^(3/2) or N s/m^(5/4).
    pub(super) damping: f64,
    /// 1/m* in 1/kg.
    pub(super) inverse_mass: f64,
}

/// What a contact under [`HertzTsuji`](crate::HertzTsuji) remembers: the normal force at the end of the
/// step before. Velocities are predicted with it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NormalHistory {
    /// The force in N.
    pub(super) force: f64,
}

impl NormalCoefficients {
    /// With the effective mass that the bodies have where the wall yields: a damping number then means
    /// another damping coefficient ([`Damping::coefficient`]).
    #[inline(always)]
    pub(super) fn yielding(mut self, damping: Damping, contact: &Contact) -> Self {
        if contact.wall_inverse_mass > 0.0 {
            let at_rest = self.inverse_mass;
            self.inverse_mass += contact.wall_inverse_mass;
            self.damping *= damping.of_mass(at_rest / self.inverse_mass);
        }
        self
    }
}

/// The normal force at one instant, in parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Normal {
    /// sqrt d in m^(1/2).
    pub(super) root: f64,
    /// Damping force per rate of overlap, in N s/m.
    pub(super) resistance: f64,
    /// The force in N, positive when pushing.
    pub(super) force: f64,
}

impl NormalForce {
    pub(super) fn new(materials: Materials) -> Self {
        let known = |id: &u16| materials.get(MaterialId(*id)).is_some();
        let count = (0..=u16::MAX).take_while(known).count();
        Self {
            materials,
            damping: Damping::default(),
            ending: Ending::default(),
            reference_speed: 1.0,
            numbers: Vec::new(),
            count,
        }
        .numbered()
    }

    pub(super) fn with_damping(mut self, damping: Damping) -> Self {
        self.damping = damping;
        self.numbered()
    }

    pub(super) fn with_ending(mut self, ending: Ending) -> Self {
        self.ending = ending;
        self.numbered()
    }

    pub(super) fn with_reference_speed(mut self, speed: f64) -> Result<Self, ValueError> {
        self.reference_speed = Bound::Positive.check("reference impact speed (m/s)", speed)?;
        Ok(self)
    }

    /// Solves for the damping numbers here, once: there may be far more combinations of radius and
    /// mass than of material.
    fn numbered(mut self) -> Self {
        self.numbers.clear();
        let ids = || (0..self.count).map(|id| MaterialId(id as u16));
        for (a, b) in ids().flat_map(|a| ids().map(move |b| (a, b))) {
            let known = self
                .numbers
                .get(usize::from(b.0) * self.count + usize::from(a.0));
            let number = known.copied().unwrap_or_else(|| {
                let interaction = self.materials.interaction(a, b);
                let restitution = interaction.map_or(f64::NAN, |given| given.restitution);
                self.damping.number(restitution, self.ending)
            });
            self.numbers.push(number);
        }
        self
    }

    fn material(&self, id: MaterialId) -> Result<&Material, LawError> {
        let material = self.materials.get(id);
        Ok(material.ok_or(LawError::UnknownMaterial(id))?.checked()?)
    }

    pub(super) fn materials(&self, bodies: &Bodies) -> Result<[&Material; 2], LawError> {
        Ok([
            self.material(bodies.first.material)?,
            self.material(bodies.second.material)?,
        ])
    }

    pub(super) fn interaction(&self, bodies: &Bodies) -> Result<Interaction, LawError> {
        self.materials(bodies)?;
        let (a, b) = (bodies.first.material, bodies.second.material);
        let interaction = self.materials.interaction(a, b);
        Ok(interaction.ok_or(LawError::UnknownMaterial(b))?.checked()?)
    }

    /// The elastic impact of two bodies at `speed` (m/s).
    pub(super) fn impact(&self, bodies: &Bodies, speed: f64) -> Result<ElasticImpact, LawError> {
        let [first, second] = self.materials(bodies)?;
        let modulus = first.effective_modulus(second);
        let stiffness = 4.0 / 3.0 * modulus * bodies.effective_radius().sqrt();
        Ok(ElasticImpact::new(
            stiffness,
            bodies.effective_mass(),
            speed,
        )?)
    }

    /// Impact speed (m/s) at which restitution is met.
    pub(super) const fn reference_speed(&self) -> f64 {
        self.reference_speed
    }

    /// The elastic impact of two bodies at the reference speed.
    pub(super) fn reference(&self, bodies: &Bodies) -> Result<ElasticImpact, LawError> {
        self.impact(bodies, self.reference_speed)
    }

    pub(super) fn damping_coefficient(&self, bodies: &Bodies) -> Result<f64, LawError> {
        let impact = self.reference(bodies)?;
        let [row, column] = [bodies.first, bodies.second].map(|body| body.material.0);
        let place = usize::from(row) * self.count + usize::from(column);
        let unknown = LawError::UnknownMaterial(bodies.second.material);
        let number = (*self.numbers.get(place).ok_or(unknown)?)?;
        Ok(self.damping.coefficient(number, &impact))
    }

    /// Constants of the force, and the longest step in s that it bears with other forces of the contact
    /// that oscillate at up to `frequency` (rad/s).
    pub(super) fn coefficients(
        &self,
        bodies: &Bodies,
        frequency: f64,
    ) -> Result<(NormalCoefficients, f64), LawError> {
        let impact = self.reference(bodies)?;
        let damping = self.damping_coefficient(bodies)?;
        let coefficients = NormalCoefficients {
            stiffness: impact.stiffness(),
            damping,
            inverse_mass: 1.0 / impact.effective_mass(),
        };
        let rate = self.damping.greatest_rate(damping, &impact);
        let quickness = (frequency * impact.duration() / PI).max(1.0);
        let steps = fewest_steps(self.interaction(bodies)?.restitution, quickness);
        let longest = (impact.duration() / steps).min(1.0 / rate);
        Ok((coefficients, longest))
    }

    /// The normal force, after one of `before` (N) at the end of the step before.
    #[inline(always)]
    pub(super) fn at(
        &self,
        coefficients: &NormalCoefficients,
        contact: &Contact,
        before: f64,
    ) -> Normal {
        let coefficients = coefficients.yielding(self.damping, contact);
        // Rounding can leave touching bodies with an overlap of zero, or a hair less.
        let overlap = at_least(contact.overlap, f64::MIN_POSITIVE);
        let root = overlap.sqrt();
        let shape = match self.damping {
            Damping::Viscoelastic => root,
            Damping::Tsuji => root.sqrt(),
        };
        let resistance = coefficients.damping * shape;
        let spring = coefficients.stiffness * overlap * root;
        let gain = coefficients.inverse_mass * contact.correction;
        let speed = contact.approach_speed() + before * gain;
        let force = (spring + resistance * speed) / (1.0 + resistance * gain);
        Normal {
            root,
            resistance,
            force: self.ended(force),
        }
    }

    #[inline(always)]
    pub(super) fn ended(&self, force: f64) -> f64 {
        match self.ending {
            Ending::NeverPulling => at_least(force, 0.0),
            Ending::PullingAllowed => force,
        }
    }

    /// Hertz's force and energy, 2/5 k d^(5/2); `tangential` is the energy (J) of the stretch.
    pub(super) fn stored(
        coefficients: &NormalCoefficients,
        contact: &Contact,
        tangential: f64,
    ) -> Stored {
        let force = coefficients.stiffness * contact.overlap * contact.overlap.sqrt();
        Stored::new(force, 0.4 * force * contact.overlap, tangential)
    }
}

/// The options and questions that the strict laws have in common. The law has the fields `normal`
/// (a [`NormalForce`]) and `friction`.
macro_rules! strict_law {
    ($law:ty) => {
        impl $law {
            /// The same law with another damping force.
            #[must_use]
            pub fn damping(mut self, damping: $crate::law::Damping) -> Self {
                self.normal = self.normal.with_damping(damping);
                self
            }

            /// The same law with another end of contact.
            #[must_use]
            pub fn ending(mut self, ending: $crate::law::Ending) -> Self {
                self.normal = self.normal.with_ending(ending);
                self
            }

            /// The same law with the impact speed (m/s) at which the materials' restitution is met,
            /// and which the time step is judged by.
            ///
            /// # Errors
            /// If `speed` is not positive.
            pub fn reference_speed(mut self, speed: f64) -> Result<Self, $crate::ValueError> {
                self.normal = self.normal.with_reference_speed(speed)?;
                Ok(self)
            }

            /// The force constant k = 4/3 E* sqrt(r*) of two bodies in N/m^(3/2): the paper's Eqs
            /// (6) and (7) for any two radii and materials.
            ///
            /// # Errors
            /// If a material is unknown or a number out of range.
            pub fn normal_stiffness(&self, bodies: &$crate::Bodies) -> Result<f64, LawError> {
                Ok(self.normal.reference(bodies)?.stiffness())
            }

            /// The damping coefficient c of two bodies, found from the restitution of their
            /// materials at the reference speed, in N s/m^(3/2) (viscoelastic) or N s/m^(5/4)
            /// (Tsuji).
            ///
            /// # Errors
            /// If a material is unknown or a number out of range: restitution below
            /// [`Damping::LEAST_RESTITUTION`](crate::Damping::LEAST_RESTITUTION), for instance.
            pub fn damping_coefficient(&self, bodies: &$crate::Bodies) -> Result<f64, LawError> {
                self.normal.damping_coefficient(bodies)
            }

            /// Duration, overlap and force of the head-on impact of two bodies at `speed` (m/s), as
            /// far as elasticity goes.
            ///
            /// # Errors
            /// If a material is unknown or a number out of range.
            pub fn elastic_impact(
                &self,
                bodies: &$crate::Bodies,
                speed: f64,
            ) -> Result<$crate::law::ElasticImpact, LawError> {
                self.normal.impact(bodies, speed)
            }
        }
    };
}

pub(super) use strict_law;
