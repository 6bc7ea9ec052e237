//! Materials and what happens where two of them meet.

use crate::error::{Bound, ValueError};

/// The number of a material in a [`Materials`] table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MaterialId(pub u16);

/// How two surfaces meet: restitution and friction of a pair of materials.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Interaction {
    /// Restitution coefficient e, 0 to 1: normal speed after over normal speed before an impact.
    pub restitution: f64,
    /// Friction coefficient mu, not negative.
    pub friction: f64,
    /// Rolling friction coefficient, not negative: the rolling couple over (normal force times
    /// effective radius). Zero by default.
    pub rolling_friction: f64,
}

impl Interaction {
    /// Restitution and friction of a pair, without rolling friction.
    ///
    /// # Errors
    /// If `restitution` is not in 0 to 1 or `friction` is negative or not finite.
    pub fn new(restitution: f64, friction: f64) -> Result<Self, ValueError> {
        Ok(Self {
            restitution: Bound::Within(0.0, 1.0).check("restitution", restitution)?,
            friction: Bound::NonNegative.check("friction coefficient", friction)?,
            rolling_friction: 0.0,
        })
    }

    /// The same with a rolling friction coefficient.
    ///
    /// # Errors
    /// If `coefficient` is negative or not finite.
    pub fn with_rolling_friction(mut self, coefficient: f64) -> Result<Self, ValueError> {
        self.rolling_friction =
            Bound::NonNegative.check("rolling friction coefficient", coefficient)?;
        Ok(self)
    }

    /// The same, if all numbers are in range: the fields can be set without asking.
    pub(crate) fn checked(self) -> Result<Self, ValueError> {
        Self::new(self.restitution, self.friction)?.with_rolling_friction(self.rolling_friction)
    }

    /// The mixing rule for two materials whose pair was not given: the geometric mean of each
    /// coefficient.
    fn mixed(a: &Self, b: &Self) -> Self {
        Self {
            restitution: (a.restitution * b.restitution).sqrt(),
            friction: (a.friction * b.friction).sqrt(),
            rolling_friction: (a.rolling_friction * b.rolling_friction).sqrt(),
        }
    }
}

/// An isotropic elastic material and how it meets itself.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Material {
    /// Young's modulus E in Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio, above -1 and at most 0.5.
    pub poissons_ratio: f64,
    /// Restitution and friction of the material against itself.
    pub interaction: Interaction,
}

impl Material {
    /// A material of Young's modulus `youngs_modulus` (Pa) and Poisson's ratio `poissons_ratio`
    /// that meets itself with `interaction`.
    ///
    /// # Errors
    /// If the modulus is not positive, or the ratio is not in -1 (excluded) to 0.5.
    pub fn new(
        youngs_modulus: f64,
        poissons_ratio: f64,
        interaction: Interaction,
    ) -> Result<Self, ValueError> {
        Bound::Above(-1.0).check("Poisson's ratio", poissons_ratio)?;
        Ok(Self {
            youngs_modulus: Bound::Positive.check("Young's modulus (Pa)", youngs_modulus)?,
            poissons_ratio: Bound::AtMost(0.5).check("Poisson's ratio", poissons_ratio)?,
            interaction,
        })
    }

    /// The same, if its numbers are in range: the fields can be set without asking.
    pub(crate) fn checked(&self) -> Result<&Self, ValueError> {
        Self::new(self.youngs_modulus, self.poissons_ratio, self.interaction)?;
        Ok(self)
    }

    /// The acrylic of the paper's Table 1: E 0.4 GPa, Poisson's ratio 0.3, friction 0.2, and the
    /// measured restitution 0.75.
    #[must_use]
    pub const fn acrylic() -> Self {
        Self {
            youngs_modulus: 0.4e9,
            poissons_ratio: 0.3,
            interaction: Interaction {
                restitution: 0.75,
                friction: 0.2,
                rolling_friction: 0.0,
            },
        }
    }

    /// The same material with the Young's modulus with which two bodies of it, of effective radius r* (m),
    /// have the force constant k = `stiffness` (N/m^(3/2)): E = 3 k (1 - nu^2)/(2 sqrt r*), from k =
    /// 4/3 E* sqrt r* with E* = E/(2 (1 - nu^2)). [`ElasticImpact::lasting`](crate::ElasticImpact::lasting)
    /// gives the stiffness for a wanted duration of contact.
    ///
    /// # Errors
    /// If a number is not positive and finite.
    pub fn with_contact_stiffness(
        self,
        stiffness: f64,
        effective_radius: f64,
    ) -> Result<Self, ValueError> {
        Bound::Positive.check("contact stiffness (N/m^1.5)", stiffness)?;
        Bound::Positive.check("effective radius (m)", effective_radius)?;
        let ratio = self.poissons_ratio;
        let modulus = 1.5 * stiffness * (1.0 - ratio * ratio) / effective_radius.sqrt();
        Self::new(modulus, ratio, self.interaction)
    }

    /// Effective modulus E* of a contact of two materials, in Pa:
    /// 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 (Hertz; the paper's Eqs (6) and (7)).
    #[must_use]
    pub fn effective_modulus(&self, other: &Self) -> f64 {
        let compliance = |m: &Self| (1.0 - m.poissons_ratio * m.poissons_ratio) / m.youngs_modulus;
        1.0 / (compliance(self) + compliance(other))
    }

    /// Effective shear modulus G* of a contact of two materials, in Pa:
    /// 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2 with G = E/(2 (1 + nu)) (Mindlin).
    #[must_use]
    pub fn effective_shear_modulus(&self, other: &Self) -> f64 {
        let compliance =
            |m: &Self| 2.0 * (1.0 + m.poissons_ratio) * (2.0 - m.poissons_ratio) / m.youngs_modulus;
        1.0 / (compliance(self) + compliance(other))
    }
}

/// A numbered table of materials, and of the pairs whose meeting was measured.
///
/// A pair that was not given mixes: its coefficients are the geometric means of those of the two
/// materials against themselves. Elastic constants never need a rule; Hertz' theory combines them
/// ([`Material::effective_modulus`]).
///
/// ```
/// use particle_damper::{Interaction, Material, Materials};
///
/// # fn main() -> Result<(), particle_damper::ValueError> {
/// let mut materials = Materials::from(Material::acrylic());
/// let steel = materials.add(Material::new(210e9, 0.3, Interaction::new(0.9, 0.1)?)?);
/// materials.set_interaction(Materials::FIRST, steel, Interaction::new(0.85, 0.15)?);
/// assert_eq!(materials.interaction(steel, Materials::FIRST), Some(Interaction::new(0.85, 0.15)?));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Materials {
    materials: Vec<Material>,
    given: Vec<((MaterialId, MaterialId), Interaction)>,
}

impl From<Material> for Materials {
    fn from(material: Material) -> Self {
        Self {
            materials: vec![material],
            given: Vec::new(),
        }
    }
}

impl Materials {
    /// The number of the material that the table was made from.
    pub const FIRST: MaterialId = MaterialId(0);

    /// Adds a material and returns its number.
    pub fn add(&mut self, material: Material) -> MaterialId {
        self.materials.push(material);
        MaterialId((self.materials.len() - 1) as u16)
    }

    /// Says how `a` and `b` meet, in either order.
    pub fn set_interaction(&mut self, a: MaterialId, b: MaterialId, interaction: Interaction) {
        let key = (a.min(b), a.max(b));
        self.given.retain(|(pair, _)| *pair != key);
        self.given.push((key, interaction));
    }

    /// The material of a number, if there is one.
    #[must_use]
    pub fn get(&self, id: MaterialId) -> Option<&Material> {
        self.materials.get(usize::from(id.0))
    }

    /// How `a` and `b` meet: as given, else mixed. `None` if either number is unknown.
    #[must_use]
    pub fn interaction(&self, a: MaterialId, b: MaterialId) -> Option<Interaction> {
        let (first, second) = (self.get(a)?, self.get(b)?);
        let key = (a.min(b), a.max(b));
        let given = self.given.iter().find(|(pair, _)| *pair == key);
        Some(match given {
            Some((_, interaction)) => *interaction,
            None if a == b => first.interaction,
            None => Interaction::mixed(&first.interaction, &second.interaction),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unnamed_pair_mixes_geometrically_and_a_named_one_does_not() {
        let mut table = Materials::from(Material::acrylic());
        let soft = Material {
            interaction: Interaction::new(0.12, 0.8).unwrap(),
            ..Material::acrylic()
        };
        let soft = table.add(soft);
        let mixed = table.interaction(soft, Materials::FIRST).unwrap();
        assert!((mixed.restitution - 0.3).abs() < 1e-15 && (mixed.friction - 0.4).abs() < 1e-15);
        let named = Interaction::new(0.5, 0.6).unwrap();
        table.set_interaction(soft, Materials::FIRST, named);
        assert_eq!(table.interaction(Materials::FIRST, soft), Some(named));
    }

    #[test]
    fn effective_moduli_of_equal_materials() {
        let m = Material::acrylic();
        assert!((m.effective_modulus(&m) - 0.4e9 / (2.0 * 0.91)).abs() < 1e-3);
        assert!((m.effective_shear_modulus(&m) - 0.4e9 / (4.0 * 1.3 * 1.7)).abs() < 1e-3);
    }
}
