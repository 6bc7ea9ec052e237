use glam::DVec3;

use super::friction::{Rolling, SLIP_MOBILITY, cut};
use super::normal::{Normal, NormalCoefficients, NormalForce, strict_law};
use super::{ContactLaw, LawError};
use crate::contact::{Bodies, Contact, ContactForce};
use crate::error::{Bound, ValueError};
use crate::material::Materials;

/// The most that one step may turn the tangential oscillation of a contact at its greatest overlap,
/// in rad. A lone contact bears 2, several on one particle sqrt 2.
const GREATEST_TURN: f64 = 1.25;

/// Hertz's spring with damping along the normal as in [`HertzTsuji`](crate::HertzTsuji), and across
/// it a spring that remembers: bodies can stick, and rebound sideways.
///
/// f_t = -k_t xi - c_t v_t, cut to mu f_n, with k_t = 8 G* sqrt(r* d) (N/m), the tangential stretch
/// xi (m) of the contact, its slip v_t (m/s), overlap d (m) and normal force f_n (N, positive when
/// pushing). xi follows the slip, turns with the contact and is shortened to mu f_n/k_t where the
/// contact slides. While d grows, k_t xi is kept (the new part of the contact area is unstressed);
/// while d falls, xi is. Either way the spring's energy k_t xi^2/2 falls, so the law never gives
/// back more than it took. Mindlin & Deresiewicz 1953, doi 10.1115/1.4010702, without their slip
/// annulus; Thornton et al. 2013, doi 10.1016/j.powtec.2012.08.012. (Stretching xi alone, as the
/// simplest codes do, gains energy on loading: Elata & Berryman 1996,
/// doi 10.1016/S0167-6636(96)00034-8.)
///
/// c_t is the normal damping c d^(1/2) or c d^(1/4) times a ratio, one by default (Tsuji et al. 1992,
/// doi 10.1016/0032-5910(92)88030-L).
///
/// # Time step
/// As for [`HertzTsuji`](crate::HertzTsuji), for the tangential motion too, which is quicker by
/// about sqrt 3: k_t and c_t act on a tangential mass of 2/7 m*.
#[derive(Debug, Clone, PartialEq)]
pub struct HertzMindlin {
    normal: NormalForce,
    damping_ratio: f64,
}

/// What [`HertzMindlin`] prepares for two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients {
    normal: NormalCoefficients,
    /// 8 G* sqrt(r*) in N/m^(3/2).
    shear: f64,
    friction: f64,
    /// Slip velocity per unit impulse in 1/kg.
    mobility: f64,
    rolling: Rolling,
    longest: f64,
}

/// What a contact under [`HertzMindlin`] remembers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TangentialSpring {
    /// Tangential displacement of the first body against the second, as far as it is not slipped
    /// off, in m.
    stretch: DVec3,
    /// Tangential force on the first body in N.
    force: DVec3,
    /// Square root of the overlap in m^(1/2).
    root: f64,
}

/// The tangential force at one instant, in parts.
#[derive(Debug, Clone, Copy)]
struct Tangential {
    stretch: DVec3,
    force: DVec3,
}

impl HertzMindlin {
    /// The law for a table of materials, or for one material.
    #[must_use]
    pub fn new(materials: impl Into<Materials>) -> Self {
        Self {
            normal: NormalForce::new(materials.into()),
            damping_ratio: 1.0,
        }
    }

    /// The same law with a tangential damping of `ratio` times the normal one.
    ///
    /// # Errors
    /// If `ratio` is negative or not finite.
    pub fn tangential_damping(mut self, ratio: f64) -> Result<Self, ValueError> {
        self.damping_ratio = Bound::NonNegative.check("tangential damping ratio", ratio)?;
        Ok(self)
    }

    #[inline]
    fn tangential(
        &self,
        coefficients: &Coefficients,
        contact: &Contact,
        normal: &Normal,
        memory: &TangentialSpring,
    ) -> Tangential {
        let slip = contact.slip();
        let dt = contact.elapsed;
        // The slip over the step, v dt - a dt^2/2 with the velocity v at its end and the
        // acceleration a that the contact's own force had at its start: of second order, and exactly
        // what Verlet's method does with a position.
        let recoil = -0.5 * coefficients.mobility * dt * dt;
        let kept = memory.root.min(normal.root) / normal.root;
        let before = memory.stretch * kept + memory.force * recoil;
        let stretch = turned(before, contact.normal) + slip * dt;

        let stiffness = coefficients.shear * normal.root;
        let limit = coefficients.friction * normal.force.max(0.0);
        let spring = cut(stretch * stiffness, limit);
        let damping = slip * (self.damping_ratio * normal.resistance);
        Tangential {
            stretch: spring / stiffness,
            force: -cut(spring + damping, limit),
        }
    }
}

/// `vector` turned into the plane across `normal`, with its length kept.
#[inline]
fn turned(vector: DVec3, normal: DVec3) -> DVec3 {
    let flat = vector - vector.dot(normal) * normal;
    let shrunk = flat.length_squared().max(f64::MIN_POSITIVE);
    flat * (vector.length_squared() / shrunk).sqrt()
}

strict_law!(HertzMindlin);

impl ContactLaw for HertzMindlin {
    type Coefficients = Coefficients;
    type Memory = TangentialSpring;

    fn coefficients(&self, bodies: &Bodies) -> Result<Coefficients, LawError> {
        let (normal, longest) = self.normal.coefficients(bodies)?;
        let [first, second] = self.normal.materials(bodies)?;
        let interaction = self.normal.interaction(bodies)?;
        let shear = 8.0 * first.effective_shear_modulus(second) * bodies.effective_radius().sqrt();
        let mobility = SLIP_MOBILITY / bodies.effective_mass();

        let deepest = self.normal.reference(bodies)?.overlap();
        let frequency = (shear * deepest.sqrt() * mobility).sqrt();
        let rate = SLIP_MOBILITY * self.damping_ratio * self.normal.damping_rate(bodies)?;
        Ok(Coefficients {
            normal,
            shear,
            friction: interaction.friction,
            mobility,
            rolling: Rolling::new(bodies, &interaction),
            longest: longest.min(GREATEST_TURN / frequency).min(1.0 / rate),
        })
    }

    #[inline]
    fn force(
        &self,
        coefficients: &Coefficients,
        contact: &Contact,
        memory: &TangentialSpring,
    ) -> ContactForce {
        let normal = self.normal.at(&coefficients.normal, contact);
        ContactForce {
            normal: normal.force,
            tangential: self
                .tangential(coefficients, contact, &normal, memory)
                .force,
            couple: coefficients.rolling.couple(contact, normal.force.max(0.0)),
        }
    }

    #[inline]
    fn advance(
        &self,
        coefficients: &Coefficients,
        contact: &Contact,
        memory: &TangentialSpring,
    ) -> TangentialSpring {
        let normal = self.normal.at(&coefficients.normal, contact);
        let Tangential { stretch, force } = self.tangential(coefficients, contact, &normal, memory);
        TangentialSpring {
            stretch,
            force,
            root: normal.root,
        }
    }

    fn time_step_limit(&self, coefficients: &Coefficients) -> f64 {
        coefficients.longest
    }
}
