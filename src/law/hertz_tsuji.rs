use super::friction::{Friction, Grip};
use super::normal::{NormalCoefficients, NormalForce, strict_law};
use super::{ContactLaw, LawError};
use crate::contact::{Bodies, Contact, ContactForce};
use crate::material::Materials;

/// The strict law of the paper: Hertz's spring with damping along the normal, sliding friction
/// across it, no memory.
///
/// f_n = k d^(3/2) + c d^(1/2) d' (Eq. 4), f_t = -mu f_n v_t/|v_t| (Eq. 5), with overlap d (m), its
/// rate d' (m/s, positive while approaching), slip v_t (m/s), k = 4/3 E* sqrt(r*) (Eqs 6, 7) and c
/// from the restitution coefficient of the materials at a reference speed. Positive f_n pushes the
/// bodies apart; f_t is the force on the first of them. Komatsuzaki & Iwata 2017,
/// doi 10.1007/s10999-016-9344-3; Tsuji et al. 1992, doi 10.1016/0032-5910(92)88030-L.
///
/// [`new`](Self::new) gives the paper's law: [viscoelastic](Damping::Viscoelastic) damping,
/// [never pulling](Ending::NeverPulling), restitution met at 1 m/s; its friction has the
/// [chatter taken out](Friction::stopping). Where the materials give one, a constant couple
/// mu_r r* f_n resists rolling. Valid for overlaps small against the radii and for impacts that
/// leave no dent.
///
/// A static friction force needs memory: see [`HertzMindlin`](crate::HertzMindlin).
///
/// # Time step
/// At most a quarter of the contact duration at the reference speed (the paper takes a sixth), and
/// at most the reciprocal of the greatest damping rate, c d^(1/2)/m*: beyond, an explicit integrator
/// amplifies what damping should take away. The second bound is the shorter one for restitutions
/// under about 0.3.
///
/// ```
/// use particle_damper::{Bodies, Body, HertzTsuji, Material, Materials};
///
/// # fn main() -> Result<(), particle_damper::LawError> {
/// let law = HertzTsuji::new(Material::acrylic());
/// let sphere = Body::sphere(3e-3, 0.2e-3, Materials::FIRST);
/// let wall = Bodies::new(sphere, Body::wall(Materials::FIRST));
/// assert!((law.normal_stiffness(&wall)? - 1.605048e7).abs() < 1e2);
/// assert!((law.damping_coefficient(&wall)? - 183.41).abs() < 0.01);
/// # Ok(())
/// # }
/// ```
///
/// [`Damping::Viscoelastic`]: crate::Damping::Viscoelastic
#[derive(Debug, Clone, PartialEq)]
pub struct HertzTsuji {
    normal: NormalForce,
    friction: Friction,
}

/// What [`HertzTsuji`] prepares for two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients {
    normal: NormalCoefficients,
    grip: Grip,
    longest: f64,
}

impl HertzTsuji {
    /// The paper's law for a table of materials, or for one material.
    #[must_use]
    pub fn new(materials: impl Into<Materials>) -> Self {
        Self {
            normal: NormalForce::new(materials.into()),
            friction: Friction::default(),
        }
    }

    /// The same law with another form of friction.
    #[must_use]
    pub const fn friction(mut self, friction: Friction) -> Self {
        self.friction = friction;
        self
    }
}

strict_law!(HertzTsuji);

impl ContactLaw for HertzTsuji {
    type Coefficients = Coefficients;
    type Memory = ();

    fn coefficients(&self, bodies: &Bodies) -> Result<Coefficients, LawError> {
        let (normal, longest) = self.normal.coefficients(bodies)?;
        let interaction = self.normal.interaction(bodies)?;
        Ok(Coefficients {
            normal,
            grip: self.friction.coefficients(bodies, &interaction),
            longest,
        })
    }

    #[inline]
    fn force(&self, coefficients: &Coefficients, contact: &Contact, (): &()) -> ContactForce {
        let normal = self.normal.at(&coefficients.normal, contact).force;
        let pressing = normal.max(0.0);
        ContactForce {
            normal,
            tangential: self.friction.force(&coefficients.grip, contact, pressing),
            couple: coefficients.grip.rolling.couple(contact, pressing),
        }
    }

    fn time_step_limit(&self, coefficients: &Coefficients) -> f64 {
        coefficients.longest
    }
}
