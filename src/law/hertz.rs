use crate::error::{Bound, ValueError};

/// Duration of an elastic Hertz impact over its greatest overlap by its speed:
/// 2 sqrt(pi) Gamma(7/5)/Gamma(9/10), twice the integral of 1/sqrt(1 - x^(5/2)) from 0 to 1.
const DURATION: f64 = 2.943_275_184_324_706;

/// A head-on elastic impact of two spheres, or of a sphere and a wall, after Hertz: the force is
/// F = k d^(3/2) for an overlap d. Damping is left out.
///
/// Gravity and other contacts are neglected, and the bodies' own vibration: the impact speed must
/// be well below the speed of sound in them. Johnson, Contact Mechanics (1985), Sec. 11.4,
/// doi 10.1017/CBO9781139171731.
///
/// ```
/// use particle_damper::ElasticImpact;
///
/// # fn main() -> Result<(), particle_damper::ValueError> {
/// let pair = ElasticImpact::new(1.134940e7, 1e-4, 1.0)?;
/// assert!((pair.duration() - 121.8e-6).abs() < 0.1e-6);
/// assert!((pair.overlap() - 41.38e-6).abs() < 0.01e-6);
/// assert!((pair.force() - 3.021).abs() < 0.001);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticImpact {
    stiffness: f64,
    effective_mass: f64,
    speed: f64,
}

impl ElasticImpact {
    /// An impact with force constant k = `stiffness` (N/m^(3/2)), effective mass m* (kg) and normal
    /// relative speed v (m/s).
    ///
    /// # Errors
    /// If one of the three is not positive and finite.
    pub fn new(stiffness: f64, effective_mass: f64, speed: f64) -> Result<Self, ValueError> {
        Ok(Self {
            stiffness: Bound::Positive.check("contact stiffness (N/m^1.5)", stiffness)?,
            effective_mass: Bound::Positive.check("effective mass (kg)", effective_mass)?,
            speed: Bound::Positive.check("impact speed (m/s)", speed)?,
        })
    }

    /// The impact of bodies of effective mass m* (kg) and normal relative speed v (m/s) that lasts for
    /// `duration` T (s): k = m* sqrt((3.2180655/T)^5/v).
    ///
    /// So a stiffness is chosen by the time step that it is to bear: of the bodies'
    /// [material](crate::Material::with_contact_stiffness), softened. The overlap grows in proportion,
    /// d = T v/2.9432752: a bed behaves like hard spheres while that is a few hundredths of a radius.
    ///
    /// # Errors
    /// If a number is not positive and finite.
    ///
    /// ```
    /// use particle_damper::{Bodies, Body, ElasticImpact, HertzTsuji, Material, Materials};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// // Spheres of 3 mm and 0.2 g, softened so that an impact at 1 m/s takes 0.5 ms.
    /// let impact = ElasticImpact::lasting(0.5e-3, 1e-4, 1.0)?;
    /// let soft = Material::acrylic().with_contact_stiffness(impact.stiffness(), 1.5e-3)?;
    /// let sphere = Body::sphere(3e-3, 0.2e-3, Materials::FIRST);
    /// let pair = HertzTsuji::new(soft).elastic_impact(&Bodies::new(sphere, sphere), 1.0)?;
    /// assert!((pair.duration() - 0.5e-3).abs() < 1e-9);
    /// assert!((pair.overlap() - impact.overlap()).abs() < 1e-9); // 0.17 mm
    /// # Ok(())
    /// # }
    /// ```
    pub fn lasting(duration: f64, effective_mass: f64, speed: f64) -> Result<Self, ValueError> {
        Bound::Positive.check("contact duration (s)", duration)?;
        Bound::Positive.check("impact speed (m/s)", speed)?;
        // T = DURATION d/v, and the overlap gives the stiffness.
        Self::overlapping(duration * speed / DURATION, effective_mass, speed)
    }

    /// The impact of bodies of effective mass m* (kg) and normal relative speed v (m/s) whose greatest
    /// overlap is d = `overlap` (m): k = 5 m* v^2/(4 d^(5/2)).
    ///
    /// # Errors
    /// If a number is not positive and finite.
    pub fn overlapping(overlap: f64, effective_mass: f64, speed: f64) -> Result<Self, ValueError> {
        Bound::Positive.check("overlap (m)", overlap)?;
        let work = 1.25 * effective_mass * speed * speed;
        Self::new(
            work / (overlap * overlap * overlap.sqrt()),
            effective_mass,
            speed,
        )
    }

    /// Force constant k in N/m^(3/2).
    #[must_use]
    pub const fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Effective mass m* in kg.
    #[must_use]
    pub const fn effective_mass(&self) -> f64 {
        self.effective_mass
    }

    /// Normal relative speed v at first touch, in m/s.
    #[must_use]
    pub const fn speed(&self) -> f64 {
        self.speed
    }

    /// Length scale (m* v^2/k)^(2/5) of the impact, in m.
    pub(super) fn length(&self) -> f64 {
        libm::pow(
            self.effective_mass * self.speed * self.speed / self.stiffness,
            0.4,
        )
    }

    /// Greatest overlap (5 m* v^2/(4 k))^(2/5) in m.
    #[must_use]
    pub fn overlap(&self) -> f64 {
        libm::pow(1.25, 0.4) * self.length()
    }

    /// Greatest force k d^(3/2) in N.
    #[must_use]
    pub fn force(&self) -> f64 {
        self.stiffness * self.overlap() * self.overlap().sqrt()
    }

    /// Contact duration T = 2.9432752 d/v = 3.2180655 (m*^2/(k^2 v))^(1/5) in s. It falls slowly
    /// with speed. Twenty steps to a contact follow it well; [`guide::trust`](crate::guide::trust) says
    /// what other numbers are worth, the law's limit is the fewest.
    #[must_use]
    pub fn duration(&self) -> f64 {
        DURATION * self.overlap() / self.speed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    /// Chung & Ooi, Granul. Matter 13 (2011) 643, doi 10.1007/s10035-011-0277-0, test 1.
    #[test]
    fn glass_spheres_meet_as_chung_and_ooi_have_it() {
        let (radius, density) = (0.01, 2800.0);
        let mass = density * 4.0 / 3.0 * PI * 0.01_f64.powi(3);
        let modulus = 48e9 / (2.0 * (1.0 - 0.2 * 0.2));
        let stiffness = 4.0 / 3.0 * modulus * (radius / 2.0_f64).sqrt();
        let impact = ElasticImpact::new(stiffness, mass / 2.0, 20.0).unwrap();
        assert_relative_eq!(impact.overlap(), 274.113e-6, max_relative = 2e-6);
        assert_relative_eq!(impact.force(), 10.69689e3, max_relative = 5e-7);
        assert_relative_eq!(impact.duration(), 40.340e-6, max_relative = 2e-5);
    }

    /// The same, test 2: an aluminium sphere on a rigid plane.
    #[test]
    fn a_sphere_meets_a_plane_as_chung_and_ooi_have_it() {
        let mass = 2699.0 * 4.0 / 3.0 * PI * 0.1_f64.powi(3);
        let stiffness = 4.0 / 3.0 * 70e9 / (1.0 - 0.3 * 0.3) * 0.1_f64.sqrt();
        let impact = ElasticImpact::new(stiffness, mass, 0.2).unwrap();
        assert_relative_eq!(impact.overlap(), 49.717e-6, max_relative = 1e-5);
        assert_relative_eq!(impact.force(), 11.36986e3, max_relative = 5e-7);
        assert_relative_eq!(impact.duration(), 731.66e-6, max_relative = 1e-5);
    }

    #[test]
    fn both_forms_of_the_duration_agree() {
        let impact = ElasticImpact::new(1.6e7, 2e-4, 0.3).unwrap();
        let other = 3.218_065_5 * (2e-4_f64.powi(2) / (1.6e7_f64.powi(2) * 0.3)).powf(0.2);
        assert_relative_eq!(impact.duration(), other, max_relative = 2e-8);
    }

    #[test]
    fn a_stiffness_chosen_by_duration_or_overlap_gives_just_that() {
        for (mass, speed) in [(1e-4, 0.01), (2e-4, 1.0), (3.0, 12.0)] {
            for wanted in [1e-6, 3e-4, 0.02] {
                let impact = ElasticImpact::lasting(wanted, mass, speed).unwrap();
                assert_relative_eq!(impact.duration(), wanted, max_relative = 1e-14);
                let printed = mass * ((3.218_065_5 / wanted).powi(5) / speed).sqrt();
                assert_relative_eq!(impact.stiffness(), printed, max_relative = 1e-7);
                let impact = ElasticImpact::overlapping(wanted, mass, speed).unwrap();
                assert_relative_eq!(impact.overlap(), wanted, max_relative = 1e-14);
            }
        }
        assert!(ElasticImpact::lasting(0.0, 1.0, 1.0).is_err());
        assert!(ElasticImpact::lasting(1e-4, 1.0, f64::NAN).is_err());
        assert!(ElasticImpact::overlapping(-1e-4, 1.0, 1.0).is_err());
        assert!(ElasticImpact::overlapping(1e-90, 1.0, 1e90).is_err());
    }

    #[test]
    fn what_cannot_be_an_impact_is_refused() {
        assert!(ElasticImpact::new(1e7, 1e-4, 0.0).is_err());
        assert!(ElasticImpact::new(f64::NAN, 1e-4, 1.0).is_err());
        assert!(ElasticImpact::new(1e7, -1e-4, 1.0).is_err());
    }
}
