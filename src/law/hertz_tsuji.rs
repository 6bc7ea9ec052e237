use super::friction::{Friction, Grip};
use super::normal::{Normal, NormalCoefficients, NormalForce, NormalHistory, strict_law};
use super::{ContactLaw, ForceLaw, Forces, LawError};
use crate::contact::{Bodies, Contact, ContactForce, Onset, Stored};
use crate::material::Materials;
use crate::numbers::at_least;

/// The strict law of the paper: Hertz's spring with damping along the normal, sliding friction
/// across it, no memory.
///
/// ```text
/// f_n = k d^(3/2) + c d^(1/2) d'      (Eq. 4)
/// f_t = -mu f_n v_t / |v_t|           (Eq. 5)
/// k   = 4/3 E* sqrt(r*)               (Eqs 6, 7)
/// ```
/// Overlap `d` (m), its rate `d'` (m/s, positive while approaching), slip `v_t` (m/s), effective
/// modulus `E*` (Pa) and radius `r*` (m); `c` follows from the restitution coefficient of the
/// materials at a reference speed. Positive `f_n` (N) pushes the bodies apart; `f_t` (N) is the
/// force on the first of them. Komatsuzaki & Iwata 2017,
/// doi 10.1007/s10999-016-9344-3; Tsuji et al. 1992, doi 10.1016/0032-5910(92)88030-L.
///
/// [`new`](Self::new) gives the paper's law: [viscoelastic](crate::Damping::Viscoelastic) damping,
/// [never pulling](crate::Ending::NeverPulling), restitution met at 1 m/s; its friction has the
/// [chatter taken out](Friction::stopping). Where the materials give one, a constant couple
/// `mu_r r* f_n` resists rolling. Valid for overlaps small against the radii and for impacts that
/// leave no dent.
///
/// A static friction force needs memory: see [`HertzMindlin`](crate::HertzMindlin).
///
/// # Time step
/// At most a quarter of the contact duration at the reference speed (the paper takes a sixth), and
/// at most the reciprocal of the greatest damping rate, `c d^(1/2) / m*`: beyond, an explicit
/// integrator amplifies what damping should take away. The second bound is the shorter one for
/// restitutions under about a third.
///
/// Where damping is weak a contact takes `n = (4 / (1 - e^2))^(1/3)` steps at least, up to 50 for an
/// elastic one: a step can add `4 / n^3` of its energy to an impact at the very most, which damping
/// then takes away again. An elastic ball keeps its energy to 1e-4 over a thousand bounces.
///
/// # Impacts in few steps
/// Under [`VelocityVerlet`](crate::VelocityVerlet) the damping force goes with the velocity at the end of
/// the step, as far as it depends on the contact's own force: with a velocity `v` predicted from the
/// forces of the step before, of which the contact's own was `f_0`,
/// ```text
/// f_n = (k d^(3/2) + r (v + f_0 t/m*)) / (1 + r t/m*),   t = dt/2
/// ```
/// where `r` is the damping force per speed, `c d^(1/2)` or `c d^(1/4)`, and `m*` the effective mass.
/// This is the trapezoidal rule for the contact by itself and a prediction of second order for what
/// others do to the two bodies; at rest it is Hertz's force. (With the velocity as predicted, a step as
/// coarse as the paper's realises 0.72 where 0.75 was asked for.)
///
/// Bodies meet and part in the midst of a step. What evaluations a step apart miss of the force there
/// is made up for by the first of them, and by the last before the force ends, be it cut off or a pull. So
/// impacts are of second order in the step whatever its phase, and a step as coarse as above leaves the
/// energy right. What steps are worth is said in [`guide::trust`](crate::guide::trust#steps-to-a-contact).
///
/// # Walls
/// At a wall `m*` is the effective mass of the particle and the container, as far as the mount lets it
/// yield along the normal: `1/m* = 1/m + 1/M` at the floor of a box of mass `M` that is free to move up
/// and down. `c` follows from `m*` ([`Damping::coefficient`](crate::Damping::coefficient)), so a light
/// box, too, rebounds from a particle with the restitution asked for. A container whose motion is
/// prescribed, or handed in by a host program, does not yield.
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

    /// The force whose normal part is `normal` (N).
    #[inline(always)]
    fn sliding(&self, coefficients: &Coefficients, contact: &Contact, normal: f64) -> ContactForce {
        let pressing = at_least(normal, 0.0);
        ContactForce {
            normal,
            tangential: self.friction.force(&coefficients.grip, contact, pressing),
            couple: coefficients.grip.rolling.couple(contact, pressing),
        }
    }
}

strict_law!(HertzTsuji);

impl ContactLaw for HertzTsuji {
    type Kind = Forces;
    type Coefficients = Coefficients;

    fn coefficients(&self, bodies: &Bodies) -> Result<Coefficients, LawError> {
        let (normal, longest) = self.normal.coefficients(bodies, 0.0)?;
        let interaction = self.normal.interaction(bodies)?;
        Ok(Coefficients {
            normal,
            grip: self.friction.coefficients(bodies, &interaction),
            longest,
        })
    }

    fn design_speed(&self) -> f64 {
        self.normal.reference_speed()
    }

    fn time_step_limit(&self, coefficients: &Coefficients) -> f64 {
        coefficients.longest
    }
}

impl ForceLaw for HertzTsuji {
    type Memory = NormalHistory;

    #[inline(always)]
    fn force(
        &self,
        coefficients: &Coefficients,
        contact: &Contact,
        before: &NormalHistory,
    ) -> ContactForce {
        let normal = self.normal.at(&coefficients.normal, contact, before.force);
        self.sliding(coefficients, contact, normal.force)
    }

    #[inline(always)]
    fn advance(
        &self,
        coefficients: &Coefficients,
        contact: &Contact,
        before: &NormalHistory,
    ) -> NormalHistory {
        let normal = self.normal.at(&coefficients.normal, contact, before.force);
        NormalHistory {
            force: normal.force,
        }
    }

    #[inline]
    fn corrects_onset(&self) -> bool {
        true
    }

    fn at_onset(
        &self,
        coefficients: &Coefficients,
        contact: &Contact,
        before: &NormalHistory,
        onset: &Onset,
    ) -> (ContactForce, NormalHistory) {
        let own = &coefficients.normal;
        let Normal { force, .. } = self.normal.at_onset(own, contact, before.force, onset);
        let answer = self.sliding(coefficients, contact, force);
        (answer, NormalHistory { force })
    }

    #[inline]
    fn has_couple(&self, coefficients: &Coefficients) -> bool {
        coefficients.grip.rolling.resists()
    }

    fn tell_memory(&self, memory: &NormalHistory, tell: &mut dyn FnMut(f64)) {
        tell(memory.force);
    }

    fn recall_memory(&self, told: &mut dyn Iterator<Item = f64>) -> Option<NormalHistory> {
        let force = told.next()?;
        Some(NormalHistory { force })
    }

    fn stored(&self, coefficients: &Coefficients, contact: &Contact, _: &NormalHistory) -> Stored {
        NormalForce::stored(&coefficients.normal, contact, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrator::{RungeKutta4, VelocityVerlet};
    use crate::law::collision::{Collision, acrylic, oblique, paper_bodies};
    use crate::{Body, Damping, Ending, Interaction, Material, MaterialId};
    use approx::{assert_abs_diff_eq, assert_relative_eq};
    use glam::{DVec3, dvec3};

    #[test]
    fn table_1() {
        let law = HertzTsuji::new(Material::acrylic());
        let [wall, pair] = paper_bodies();
        assert_relative_eq!(
            law.normal_stiffness(&wall).unwrap(),
            1.605_048e7,
            max_relative = 3e-7
        );
        assert_relative_eq!(
            law.normal_stiffness(&pair).unwrap(),
            1.134_940e7,
            max_relative = 3e-7
        );
        assert_relative_eq!(
            law.damping_coefficient(&wall).unwrap(),
            183.41,
            max_relative = 3e-5
        );
        assert_relative_eq!(
            law.damping_coefficient(&pair).unwrap(),
            112.9,
            max_relative = 5e-4
        );
    }

    #[test]
    fn a_resting_overlap_carries_the_weight() {
        let law = HertzTsuji::new(Material::acrylic());
        let wall = law.coefficients(&paper_bodies()[0]).unwrap();
        let contact = Contact::new(DVec3::Y, 2.4631e-7, DVec3::ZERO);
        assert_relative_eq!(
            law.force(&wall, &contact, &NormalHistory::default()).normal,
            0.2e-3 * 9.81,
            max_relative = 1e-4
        );
    }

    #[test]
    fn restitution_is_what_was_asked() {
        let sphere = |radius, mass| Body::sphere(radius, mass, Materials::FIRST);
        let [wall, equal] = paper_bodies();
        let unequal = Bodies::new(sphere(3e-3, 2e-4), sphere(1e-3, 3e-6));
        for (damping, ending, e) in [
            (Damping::Viscoelastic, Ending::NeverPulling, 0.75),
            (Damping::Viscoelastic, Ending::PullingAllowed, 0.3),
            (Damping::Tsuji, Ending::NeverPulling, 0.2),
            (Damping::Tsuji, Ending::PullingAllowed, 0.9),
            (Damping::Viscoelastic, Ending::NeverPulling, 1.0),
        ] {
            let law = HertzTsuji::new(acrylic(e, 0.2))
                .damping(damping)
                .ending(ending);
            let law = law.reference_speed(0.7).unwrap();
            for bodies in [wall, equal, unequal] {
                let approach = dvec3(0.0, -0.7, 0.0);
                let mut impact = Collision::new(&law, bodies, approach, DVec3::ZERO);
                impact.run_in(&mut RungeKutta4::default(), 100.0);
                assert_abs_diff_eq!(impact.separation_speed() / 0.7, e, epsilon = 1e-3);
            }
        }
    }

    #[test]
    fn restitution_of_the_papers_law_is_what_was_asked_under_verlet_too() {
        for e in [0.2, 0.5, 0.75, 0.9, 1.0] {
            let law = HertzTsuji::new(acrylic(e, 0.2));
            for bodies in paper_bodies() {
                let mut impact = Collision::new(&law, bodies, -DVec3::Y, DVec3::ZERO);
                impact.run_in(&mut VelocityVerlet, 100.0);
                assert_abs_diff_eq!(impact.separation_speed(), e, epsilon = 1e-3);
            }
        }
    }

    /// Chung & Ooi 2011, doi 10.1007/s10035-011-0277-0, test 2, by integration.
    #[test]
    fn an_elastic_impact_takes_the_time_and_depth_of_theory() {
        let rigid = Material::new(1e30, 0.3, Interaction::new(1.0, 0.0).unwrap()).unwrap();
        let alloy = Material::new(70e9, 0.3, Interaction::new(1.0, 0.0).unwrap()).unwrap();
        let mut materials = Materials::from(alloy);
        let plane = materials.add(rigid);
        let mass = 2699.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.1_f64.powi(3);
        let sphere = Body::sphere(0.1, mass, Materials::FIRST);
        let law = HertzTsuji::new(materials);
        let mut impact = Collision::new(
            &law,
            Bodies::new(sphere, Body::wall(plane)),
            dvec3(0.0, -0.2, 0.0),
            DVec3::ZERO,
        );
        let duration = impact.run(&mut RungeKutta4::default(), 0.5e-6);
        assert_abs_diff_eq!(duration, 731.66e-6, epsilon = 1e-6);
        assert_relative_eq!(impact.peak.0, 49.717e-6, max_relative = 1e-4);
        assert_relative_eq!(impact.peak.1, 11.36986e3, max_relative = 1e-4);
    }

    /// Friction at grazing impact must not create energy, at coarse steps either.
    #[test]
    fn an_oblique_impact_never_gains_energy() {
        let forms = [
            Friction::stopping(),
            Friction::regularised(1e-3).unwrap(),
            Friction::as_printed(),
        ];
        for (e, mu) in [(0.75, 0.2), (0.98, 0.0), (0.98, 0.3), (0.98, 1.0)] {
            for friction in forms {
                let law = HertzTsuji::new(acrylic(e, mu)).friction(friction);
                for steps in [20.0, 100.0] {
                    for mut impact in oblique(&law) {
                        let before = impact.kinetic_energy();
                        impact.run_in(&mut VelocityVerlet, steps);
                        assert!(
                            impact.kinetic_energy() < before,
                            "{friction:?} {e} {mu} {steps}"
                        );
                    }
                }
            }
        }
    }

    /// Chung & Ooi 2011, test 6: a spinning sphere comes down on a plane.
    #[test]
    fn a_spinning_sphere_slides_or_rolls_away() {
        let (mu, e, fall, radius) = (0.4, 0.5, 0.2, 0.1);
        let alloy = Material::new(70e9, 0.3, Interaction::new(e, mu).unwrap()).unwrap();
        let law = HertzTsuji::new(alloy).reference_speed(fall).unwrap();
        let bodies = Bodies::new(
            Body::sphere(radius, 11.3, Materials::FIRST),
            Body::wall(Materials::FIRST),
        );
        let step = law.elastic_impact(&bodies, fall).unwrap().duration() / 200.0;
        for spin in [1.0_f64, 3.0, 5.0, 9.0] {
            let mut impact = Collision::new(&law, bodies, -fall * DVec3::Y, -spin * DVec3::Z);
            impact.run(&mut VelocityVerlet, step);
            let impulse = mu * (1.0 + e) * fall;
            let (speed, left) = if spin * radius >= 3.5 * impulse {
                (impulse, spin - 2.5 * impulse / radius)
            } else {
                (2.0 / 7.0 * spin * radius, 2.0 / 7.0 * spin)
            };
            assert_relative_eq!(impact.velocity.get(0).x, speed, max_relative = 3e-3);
            assert_relative_eq!(-impact.spin.get(0).z, left, max_relative = 3e-3);
        }
    }

    /// Chung & Ooi 2011, test 7: the surfaces of equal spheres with opposite spin do not slip.
    #[test]
    fn opposite_spins_feel_no_friction() {
        let law = HertzTsuji::new(Material::acrylic());
        let mut impact = Collision::new(&law, paper_bodies()[1], -DVec3::Y, 80.0 * DVec3::Z);
        impact.spin.set(1, -80.0 * DVec3::Z);
        impact.run_in(&mut VelocityVerlet, 50.0);
        assert_abs_diff_eq!(impact.velocity.get(0).x, 0.0, epsilon = 1e-12);
        assert_abs_diff_eq!(impact.spin.get(0).z, 80.0, epsilon = 1e-9);
    }

    #[test]
    fn rolling_friction_is_a_couple_when_asked_for() {
        let mut material = acrylic(0.75, 0.2);
        material.interaction = material.interaction.with_rolling_friction(0.01).unwrap();
        let mut contact = Contact::new(DVec3::Y, 1e-5, DVec3::ZERO);
        contact.spins[0] = 100.0 * DVec3::Z;
        let couple = |material: Material| {
            let law = HertzTsuji::new(material);
            let coefficients = law.coefficients(&paper_bodies()[0]).unwrap();
            let force = law.force(&coefficients, &contact, &NormalHistory::default());
            (force.couple.z, force.normal)
        };
        assert!(couple(Material::acrylic()).0.abs() < f64::MIN_POSITIVE);
        let (resisting, normal) = couple(material);
        assert_relative_eq!(resisting, -0.01 * 3e-3 * normal, max_relative = 1e-12);
    }

    #[test]
    fn the_papers_step_is_allowed_and_a_third_of_a_contact_is_not() {
        let law = HertzTsuji::new(Material::acrylic());
        for bodies in paper_bodies() {
            let limit = law.time_step_limit(&law.coefficients(&bodies).unwrap());
            let duration = law.elastic_impact(&bodies, 1.0).unwrap().duration();
            assert!(2e-5 < limit && limit < duration / 3.0);
        }
        assert!(size_of::<Coefficients>() <= 64);
    }

    #[test]
    fn what_the_law_cannot_answer_for_is_refused() {
        let [wall, _] = paper_bodies();
        let law = HertzTsuji::new(acrylic(0.0, 0.2));
        let message = law.coefficients(&wall).unwrap_err().to_string();
        assert!(
            message.ends_with("must lie in [0.001, 1], not 0"),
            "{message}"
        );
        let stranger = Body::wall(MaterialId(3));
        let unknown = law.coefficients(&Bodies::new(wall.first, stranger));
        assert_eq!(unknown, Err(LawError::UnknownMaterial(MaterialId(3))));
        assert!(
            HertzTsuji::new(Material::acrylic())
                .reference_speed(0.0)
                .is_err()
        );
    }
}
