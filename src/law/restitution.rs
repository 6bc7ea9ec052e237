use super::damping::{Damping, Ending};
use super::{ContactLaw, ImpulseLaw, Impulses, LawError, SolverParameters};
use crate::contact::Bodies;
use crate::error::{Bound, ValueError};
use crate::material::{Interaction, Materials};

mod fading;

use fading::Fading;

/// A step moves a particle at the reference speed by at most this fraction of the smaller radius. In the
/// paper's damper steps of a thirtieth, a fifteenth and two fifteenths lead to overlaps of 0.08, 0.17 and 0.33
/// radii (below), in proportion: a fifth leads to some 0.5, not far from where overlaps are an error.
const TRAVEL: f64 = 0.2;

/// The restitution coefficient turned into a force over one step (the paper's Sec. 4.3), for any
/// masses: the coarse law.
///
/// Two bodies that touch and approach at speed v are given the impulse J = m* (1 + e) v along the
/// normal (Eqs 10 and 11, where the wall yields as its mount does), as the force J/dt held over the
/// step (Eq. 12). Across it, the impulse ends the slip if it can, and is mu J otherwise; it turns the
/// bodies. Where the materials resist rolling, a couple of at most `mu_r r* J` does so.
///
/// As it stands in the paper the law lets resting particles sink, by g dt/(1 + e) in velocity and layer,
/// until they leave through the floor. Here the contacts of a step are solved together, by nonsmooth
/// contact dynamics: see [`SolverParameters`]. [`literal`](Self::literal) is the paper's form.
///
/// # Accuracy and limits
/// - One impact of two bodies has the restitution asked for, at every speed above the
///   [threshold](SolverParameters::restitution_threshold): 4 mm/s under gravity at steps of 0.1 ms, no more
///   than 0 without. It is taken where the bodies are at the middle of the step, which is off by up to half
///   of their way in it: the law is of first order in the step where impacts count, and of second in what
///   rests.
/// - The paper's damper at its resonances (20, 40, 60 particles, 5.5 to 6.75 Hz) responds as under the
///   strict law of the same restitution ([`Damping::Tsuji`], steps of 10 us): at worst 1.4 % off and 0.3 % on
///   the mean at steps of 0.1 ms, 1.9 % and 0.4 % at 0.2 ms, with overlaps of up to 0.08 and 0.17 radii
///   (`tests/physics/coarse_law.rs`, long form).
/// - Beds that are shaken at 1.1 to 3 g keep overlaps below 0.05 radii from 20 Hz on, and below 0.1 at
///   10 Hz, also where one half is up to 16 times as heavy as the other.
/// - Heavy on light wants more [sweeps](SolverParameters::sweeps): 16 at a mass ratio of 100, 64 at 1000.
///   Blows on such beds can press them to 0.5 radii for some steps.
/// - Blows that reach a body in one step count as simultaneous, and then what comes out depends on the order
///   in which contacts are solved, that of the particles' numbers: a column of five beads that *touch*, of
///   restitution 0.6, leaves a wall with 0.04 to 0.12 of its speed by numbering. Beads apart from each other
///   leave as theory has it, whatever their numbers.
/// - A body that moves by more than its radius in a step is [refused](crate::StepError::TooFast), so that
///   nothing is passed unseen.
#[derive(Debug, Clone, PartialEq)]
pub struct RestitutionImpulse {
    materials: Materials,
    reference_speed: f64,
    restitution: Restitution,
    friction: bool,
    solver: SolverParameters,
}

/// How restitution depends on the speed of approach.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Restitution {
    Constant,
    /// As under viscoelastic damping.
    Viscoelastic,
}

/// What [`RestitutionImpulse`] prepares for two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestitutionCoefficients {
    restitution: f64,
    /// How restitution fades with the speed, if it does.
    fading: Option<Fading>,
    friction: f64,
    /// Rolling friction coefficient times the effective radius, m.
    rolling_arm: f64,
    longest: f64,
}

impl RestitutionImpulse {
    /// The law for bodies of `materials`.
    #[must_use]
    pub fn new(materials: impl Into<Materials>) -> Self {
        Self {
            materials: materials.into(),
            reference_speed: 1.0,
            restitution: Restitution::Constant,
            friction: true,
            solver: SolverParameters::default(),
        }
    }

    /// The law with the restitution that [`HertzTsuji`](crate::HertzTsuji) has at every speed under its
    /// [viscoelastic](Damping::Viscoelastic) damping, [never pulling](Ending::NeverPulling): that of the
    /// materials at the [reference speed](Self::reference_speed), more below it and less above. Good to 1e-4
    /// from a thousandth to a hundred times that speed.
    #[must_use]
    pub fn viscoelastic(materials: impl Into<Materials>) -> Self {
        Self {
            restitution: Restitution::Viscoelastic,
            ..Self::new(materials)
        }
    }

    /// Eqs (10) to (12) as they are printed: all contacts from the same velocities, no friction, no
    /// spin, and nothing to keep resting particles from sinking ([`SolverParameters::literal`]). It loses
    /// particles: build the damper with [`contained(false)`](crate::Builder::contained) and an infinite
    /// [`overlap_limit`](crate::Builder::overlap_limit).
    #[must_use]
    pub fn literal(materials: impl Into<Materials>) -> Self {
        Self::new(materials)
            .friction(false)
            .solved_with(SolverParameters::literal())
    }

    /// The same law with or without friction, rolling resistance and the spin that comes of them.
    #[must_use]
    pub const fn friction(mut self, friction: bool) -> Self {
        self.friction = friction;
        self
    }

    /// The same law with other parameters of the contact dynamics solver.
    #[must_use]
    pub const fn solved_with(mut self, parameters: SolverParameters) -> Self {
        self.solver = parameters;
        self
    }

    /// The same law for relative speeds about `speed` (m/s; 1 unless set), which bounds the time step: a
    /// body moves by at most a fifth of the smaller radius in a step. Restitution that depends on the speed
    /// is that of the materials at this one.
    ///
    /// # Errors
    /// If the speed is not positive and finite.
    pub fn reference_speed(mut self, speed: f64) -> Result<Self, ValueError> {
        self.reference_speed = Bound::Positive.check("reference speed (m/s)", speed)?;
        Ok(self)
    }

    fn interaction(&self, bodies: &Bodies) -> Result<Interaction, LawError> {
        let [first, second] = [bodies.first.material, bodies.second.material];
        for material in [first, second] {
            self.materials
                .get(material)
                .ok_or(LawError::UnknownMaterial(material))?;
        }
        let interaction = self
            .materials
            .interaction(first, second)
            .ok_or(LawError::UnknownMaterial(second))?;
        Ok(interaction.checked()?)
    }
}

impl ContactLaw for RestitutionImpulse {
    type Kind = Impulses;
    type Coefficients = RestitutionCoefficients;

    fn coefficients(&self, bodies: &Bodies) -> Result<Self::Coefficients, LawError> {
        let interaction = self.interaction(bodies)?;
        let rubs = f64::from(self.friction);
        let fading = match self.restitution {
            Restitution::Constant => None,
            Restitution::Viscoelastic => {
                let number =
                    Damping::Viscoelastic.number(interaction.restitution, Ending::NeverPulling)?;
                Some(Fading::new(number, self.reference_speed)?)
            }
        };
        Ok(RestitutionCoefficients {
            restitution: interaction.restitution,
            fading,
            friction: rubs * interaction.friction,
            rolling_arm: rubs * interaction.rolling_friction * bodies.effective_radius(),
            longest: TRAVEL * bodies.first.radius.min(bodies.second.radius) / self.reference_speed,
        })
    }

    fn design_speed(&self) -> f64 {
        self.reference_speed
    }

    fn time_step_limit(&self, own: &Self::Coefficients) -> f64 {
        own.longest
    }
}

impl ImpulseLaw for RestitutionImpulse {
    #[inline(always)]
    fn restitution(&self, own: &Self::Coefficients, approach_speed: f64) -> f64 {
        match &own.fading {
            None => own.restitution,
            Some(fading) => fading.at(approach_speed),
        }
    }

    #[inline(always)]
    fn friction(&self, own: &Self::Coefficients) -> f64 {
        own.friction
    }

    #[inline(always)]
    fn rolling_arm(&self, own: &Self::Coefficients) -> f64 {
        own.rolling_arm
    }

    fn solver(&self) -> SolverParameters {
        self.solver
    }
}
