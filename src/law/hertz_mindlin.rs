use std::f64::consts::PI;

use glam::DVec3;

use super::friction::{PART_PER_STEP, Rolling, SLIP_INVERSE_MASS, share};
use super::normal::{Normal, NormalCoefficients, NormalForce, damped_steps, strict_law};
use super::tangent::Tangent;
use super::{ContactLaw, ForceLaw, Forces, LawError};
use crate::contact::{Bodies, Contact, ContactForce, Onset, Stored};
use crate::error::{Bound, ValueError};
use crate::material::Materials;
use crate::numbers::{at_least, at_most, vector};

/// The most that one step may turn the tangential oscillation of a contact, in rad. A lone contact bears 2,
/// several on one particle sqrt 2.
const GREATEST_TURN: f64 = 1.25;

/// Hertz's spring with damping along the normal as in [`HertzTsuji`](crate::HertzTsuji), and across
/// it a spring that remembers: bodies can stick, and rebound sideways.
///
/// ```text
/// f_t = -k_t xi - c_t v_t, cut to mu f_n
/// k_t = 8 G* sqrt(r* d)
/// ```
/// Tangential force `f_t` (N) on the first body, tangential stretch `xi` (m) of the contact, its
/// slip `v_t` (m/s) and overlap `d` (m), normal force `f_n` (N, positive when pushing), effective
/// shear modulus `G*` (Pa) and radius `r*` (m). `xi` follows the slip, turns with the contact and is
/// shortened to `mu f_n / k_t` where the contact slides. While `d` grows, `k_t xi` is kept (the new
/// part of the contact area is unstressed); while `d` falls, `xi` is. Either way the spring's energy
/// `k_t xi^2 / 2` falls, so the law never gives back more than it took. Mindlin & Deresiewicz 1953,
/// doi 10.1115/1.4010702, without their slip annulus; Thornton et al. 2013,
/// doi 10.1016/j.powtec.2012.08.012. (Stretching `xi` alone, as the simplest codes do, gains energy
/// on loading: Elata & Berryman 1996, doi 10.1016/S0167-6636(96)00034-8.)
///
/// `c_t` is the normal damping, `c d^(1/2)` or `c d^(1/4)`, times a ratio, one by default (Tsuji et
/// al. 1992, doi 10.1016/0032-5910(92)88030-L), and never takes away more than half of the slip in
/// one step.
///
/// # Time step
/// As for [`HertzTsuji`](crate::HertzTsuji#time-step). The tangential oscillation is quicker than the normal one,
/// because it moves 2/7 m*: of an impact at the reference speed a step resolves it to the greatest overlap if it is
/// two elevenths of the contact duration or less. In a longer step, and in a harder impact, `k_t` grows no further
/// than where [`VelocityVerlet`](crate::VelocityVerlet) turns the oscillation by 1.25 rad in a step. With friction of
/// 0.2 and a restitution of 0.75, tangential velocities after impacts at any angle with any spin are then off by
/// 0.9 % of the impact speed (RMS) at the longest step, a quarter of the duration, and by 0.7 % at two elevenths; with
/// friction of 1 by 5 %, with either. Where damping is weak (e above 0.86), steps are counted on the tangential
/// oscillation: there are twice as many.
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
    /// The stiffness that a step resolves, times its square, in kg.
    resolved: f64,
    friction: f64,
    /// The most that damping may resist, times the step, in kg.
    stop: f64,
    rolling: Rolling,
    longest: f64,
}

/// What a contact under [`HertzMindlin`] remembers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TangentialSpring {
    /// What the spring bears, `k_t xi`, in N. In the plane z = 0 it is a number, its component along the normal
    /// turned by a quarter, which turns with the contact: the z of this.
    load: DVec3,
    /// What it bears more with time for the slip, `k_t v_t`, in N/s, likewise.
    rate: DVec3,
    /// Tangential stiffness in N/m.
    stiffness: f64,
    /// Normal force in N.
    force: f64,
}

impl Coefficients {
    /// The greatest tangential stiffness that a step resolves, in N/m. There is no bound where velocities are not
    /// predicted: other integrators bear more.
    #[inline(always)]
    fn resolved_stiffness(&self, contact: &Contact) -> f64 {
        let step = 2.0 * contact.correction;
        let mut resolved = self.resolved;
        if contact.wall_inverse_mass > 0.0 {
            let mass = resolved / (GREATEST_TURN * GREATEST_TURN);
            resolved /= 1.0 + contact.wall_inverse_mass * mass;
        }
        resolved * (1.0 / (step * step))
    }
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

    /// The force of a contact, and what it remembers if that is at the end of a step.
    #[inline(always)]
    fn answer(
        &self,
        coefficients: &Coefficients,
        contact: &Contact,
        normal: &Normal,
        memory: &TangentialSpring,
    ) -> (ContactForce, TangentialSpring) {
        if contact.planar {
            self.answer_in::<f64>(coefficients, contact, normal, memory)
        } else {
            self.answer_in::<DVec3>(coefficients, contact, normal, memory)
        }
    }

    #[inline(always)]
    fn answer_in<T: Tangent>(
        &self,
        coefficients: &Coefficients,
        contact: &Contact,
        normal: &Normal,
        memory: &TangentialSpring,
    ) -> (ContactForce, TangentialSpring) {
        let (slip, dt) = (T::slip(contact), contact.elapsed);
        let [load, rate] = [memory.load, memory.rate].map(T::from_memory);
        let stiffness = at_most(
            coefficients.shear * normal.root,
            coefficients.resolved_stiffness(contact),
        );
        // While the overlap grows the load is kept, while it falls the stretch.
        let kept = at_most(stiffness / memory.stiffness, 1.0);
        // The trapezoidal rule. A contact that begins has slipped for half of the step on average.
        let half = 0.5 * dt;
        let load = (load + rate * half).turned(contact) * kept;
        let rate = slip * stiffness;
        let load = load + rate * half;

        let bearable = coefficients.stop * (1.0 / dt);
        let damping = slip * at_most(self.damping_ratio * normal.resistance, bearable);
        let pressing = at_least(normal.force, 0.0);
        let whole = load + damping;
        // Where the contact slides, the load falls along with the force.
        let share = share(whole, coefficients.friction * pressing);
        let force = ContactForce {
            normal: normal.force,
            tangential: -(whole * share).in_space(contact),
            couple: coefficients.rolling.couple(contact, pressing),
        };
        let memory = TangentialSpring {
            load: (load * share).remembered(memory.load),
            rate: rate.remembered(memory.rate),
            stiffness,
            force: normal.force,
        };
        (force, memory)
    }
}

strict_law!(HertzMindlin);

impl ContactLaw for HertzMindlin {
    type Kind = Forces;
    type Coefficients = Coefficients;

    fn coefficients(&self, bodies: &Bodies) -> Result<Coefficients, LawError> {
        let [first, second] = self.normal.materials(bodies)?;
        let interaction = self.normal.interaction(bodies)?;
        let shear = 8.0 * first.effective_shear_modulus(second) * bodies.effective_radius().sqrt();
        let inverse_mass = SLIP_INVERSE_MASS / bodies.effective_mass();
        // Where damping is weak, the tangential oscillation has to be resolved to its greatest overlap.
        let frequency = if damped_steps(interaction.restitution) > PI / GREATEST_TURN {
            let deepest = self.normal.reference(bodies)?.overlap();
            (shear * deepest.sqrt() * inverse_mass).sqrt()
        } else {
            0.0
        };
        let (normal, longest) = self.normal.coefficients(bodies, frequency)?;
        Ok(Coefficients {
            normal,
            shear,
            resolved: GREATEST_TURN * GREATEST_TURN / inverse_mass,
            friction: interaction.friction,
            stop: PART_PER_STEP / inverse_mass,
            rolling: Rolling::new(bodies, &interaction),
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

impl ForceLaw for HertzMindlin {
    type Memory = TangentialSpring;

    #[inline(always)]
    fn force(
        &self,
        coefficients: &Coefficients,
        contact: &Contact,
        memory: &TangentialSpring,
    ) -> ContactForce {
        let normal = self.normal.at(&coefficients.normal, contact, memory.force);
        self.answer(coefficients, contact, &normal, memory).0
    }

    #[inline(always)]
    fn advance(
        &self,
        coefficients: &Coefficients,
        contact: &Contact,
        memory: &TangentialSpring,
    ) -> TangentialSpring {
        let normal = self.normal.at(&coefficients.normal, contact, memory.force);
        self.answer(coefficients, contact, &normal, memory).1
    }

    #[inline]
    fn has_couple(&self, coefficients: &Coefficients) -> bool {
        coefficients.rolling.resists()
    }

    #[inline]
    fn corrects_onset(&self) -> bool {
        true
    }

    fn at_onset(
        &self,
        coefficients: &Coefficients,
        contact: &Contact,
        memory: &TangentialSpring,
        onset: &Onset,
    ) -> (ContactForce, TangentialSpring) {
        let own = &coefficients.normal;
        let normal = self.normal.at_onset(own, contact, memory.force, onset);
        self.answer(coefficients, contact, &normal, memory)
    }

    fn stored(
        &self,
        coefficients: &Coefficients,
        contact: &Contact,
        memory: &TangentialSpring,
    ) -> Stored {
        let stretched = if memory.stiffness > 0.0 {
            0.5 * memory.load.length_squared() / memory.stiffness
        } else {
            0.0
        };
        NormalForce::stored(&coefficients.normal, contact, stretched)
    }

    fn tell_memory(&self, memory: &TangentialSpring, tell: &mut dyn FnMut(f64)) {
        let [load, rate] = [memory.load, memory.rate].map(|vector| vector.to_array());
        load.into_iter()
            .chain(rate)
            .chain([memory.stiffness, memory.force])
            .for_each(tell);
    }

    fn recall_memory(&self, told: &mut dyn Iterator<Item = f64>) -> Option<TangentialSpring> {
        Some(TangentialSpring {
            load: vector(told)?,
            rate: vector(told)?,
            stiffness: told.next()?,
            force: told.next()?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrator::{RungeKutta4, VelocityVerlet};
    use crate::law::collision::{Collision, acrylic, oblique, paper_bodies};
    use crate::{Body, Interaction, Material};
    use approx::{assert_abs_diff_eq, assert_relative_eq};
    use glam::dvec3;

    /// Tangential speed after over before an impact at `degrees` from the normal: Kharaz, Gorham & Salman 2001, doi 10.1016/S0032-5910(01)00283-2, aluminium oxide on
    /// glass at 3.9 m/s.
    fn kharaz(degrees: f64, steps: f64) -> f64 {
        let interaction = Interaction::new(0.98, 0.092).unwrap();
        let sphere = Material::new(380e9, 0.23, interaction).unwrap();
        let mut materials = Materials::from(sphere);
        let plate = materials.add(Material::new(70e9, 0.25, interaction).unwrap());
        let law = HertzMindlin::new(materials).reference_speed(3.9).unwrap();
        let mass = 4000.0 * 4.0 / 3.0 * std::f64::consts::PI * 2.5e-3_f64.powi(3);
        let body = Body::sphere(2.5e-3, mass, Materials::FIRST);
        let bodies = Bodies::new(body, Body::wall(plate));
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let velocity = 3.9 * dvec3(sine, -cosine, 0.0);
        let mut impact = Collision::new(&law, bodies, velocity, DVec3::ZERO);
        let duration = law.elastic_impact(&bodies, 3.9).unwrap().duration();
        impact.run(&mut VelocityVerlet, duration / steps);
        impact.velocity.get(0).x / velocity.x
    }

    #[test]
    fn an_oblique_rebound_dips_below_rolling_as_measured() {
        for (degrees, measured) in [
            (9.63, 0.673),
            (20.08, 0.596),
            (30.22, 0.688),
            (49.55, 0.847),
        ] {
            assert_abs_diff_eq!(kharaz(degrees, 1000.0), measured, epsilon = 0.05);
        }
        assert!(kharaz(20.08, 100.0) < 5.0 / 7.0 - 0.08);
    }

    #[test]
    fn a_sliding_rebound_follows_coulomb() {
        let tangent = 49.55_f64.to_radians().tan();
        let coulomb = 1.0 - 0.092 * 1.98 / tangent;
        assert_abs_diff_eq!(kharaz(49.55, 100.0), coulomb, epsilon = 1e-3);
    }

    #[test]
    fn a_sticking_rebound_is_of_second_order_in_the_step() {
        let exact = kharaz(15.0, 5000.0);
        assert_abs_diff_eq!(kharaz(15.0, 50.0), exact, epsilon = 2e-3);
        assert_abs_diff_eq!(kharaz(15.0, 500.0), exact, epsilon = 2e-5);
    }

    #[test]
    fn an_oblique_impact_never_gains_energy() {
        for (e, mu) in [
            (0.5, 0.2),
            (0.75, 1.0),
            (0.98, 0.0),
            (0.98, 0.3),
            (0.98, 1.0),
        ] {
            let law = HertzMindlin::new(acrylic(e, mu));
            for steps in [20.0, 100.0] {
                for mut impact in oblique(&law) {
                    let before = impact.kinetic_energy();
                    impact.run_in(&mut VelocityVerlet, steps);
                    assert!(impact.kinetic_energy() < before, "{e} {mu} {steps}");
                }
                for mut impact in oblique(&law) {
                    let before = impact.kinetic_energy();
                    impact.run_in(&mut RungeKutta4::default(), steps);
                    assert!(impact.kinetic_energy() < before, "{e} {mu} {steps}");
                }
            }
        }
    }

    #[test]
    fn a_stuck_contact_holds_a_force_at_rest() {
        let law = HertzMindlin::new(Material::acrylic());
        let coefficients = law.coefficients(&paper_bodies()[0]).unwrap();
        let mut contact = Contact::new(DVec3::Y, 1e-6, 1e-3 * DVec3::X);
        contact.elapsed = 2e-5;
        let memory = law.advance(&coefficients, &contact, &TangentialSpring::default());
        contact.velocity = DVec3::ZERO;
        contact.elapsed = 0.0;
        let held = law.force(&coefficients, &contact, &memory);
        let stiffness = 8.0 * 0.4e9 / (4.0 * 1.3 * 1.7) * (3e-3 * 1e-6_f64).sqrt();
        // Half of a step is what it has slipped on average when it is met first.
        assert_relative_eq!(-held.tangential.x, stiffness * 1e-8, max_relative = 1e-12);
    }

    #[test]
    fn friction_ends_at_the_coulomb_force() {
        let law = HertzMindlin::new(Material::acrylic());
        let coefficients = law.coefficients(&paper_bodies()[0]).unwrap();
        let mut contact = Contact::new(DVec3::Y, 1e-6, dvec3(0.6, 0.0, -0.8));
        contact.elapsed = 2e-5;
        let memory = law.advance(&coefficients, &contact, &TangentialSpring::default());
        let force = law.force(&coefficients, &contact, &memory);
        assert_relative_eq!(
            force.tangential.length(),
            0.2 * force.normal,
            max_relative = 1e-12
        );
        assert!(force.tangential.dot(contact.velocity) < 0.0);
        assert!(memory.load.length() <= 0.2 * force.normal);
    }

    #[test]
    fn the_spring_turns_with_the_contact() {
        let law = HertzMindlin::new(Material::acrylic());
        let coefficients = law.coefficients(&paper_bodies()[0]).unwrap();
        let mut contact = Contact::new(DVec3::Y, 1e-6, 1e-3 * DVec3::X);
        contact.elapsed = 2e-5;
        let before = law.advance(&coefficients, &contact, &TangentialSpring::default());
        contact.velocity = DVec3::ZERO;
        contact.normal = dvec3(1e-3, 1.0, 0.0).normalize();
        contact.elapsed = 0.0;
        let after = law.advance(&coefficients, &contact, &before);
        assert_abs_diff_eq!(after.load.dot(contact.normal), 0.0, epsilon = 1e-15);
        assert_relative_eq!(
            after.load.length(),
            before.load.length(),
            max_relative = 1e-6
        );
    }

    /// Bodies that touch to within rounding had a force that was no number.
    #[test]
    fn a_touch_without_overlap_has_a_finite_force() {
        let law = HertzMindlin::new(Material::acrylic());
        let coefficients = law.coefficients(&paper_bodies()[1]).unwrap();
        for overlap in [0.0, -1e-19] {
            let mut contact = Contact::new(DVec3::Y, overlap, dvec3(0.1, -0.1, 0.0));
            contact.elapsed = 1e-5;
            let memory = law.advance(&coefficients, &contact, &TangentialSpring::default());
            let force = law.force(&coefficients, &contact, &memory);
            assert!(force.normal.abs() < 1e-100 && force.tangential.length() < 1e-100);
            contact.overlap = 1e-6;
            assert!(
                law.force(&coefficients, &contact, &memory)
                    .tangential
                    .is_finite()
            );
        }
    }

    #[test]
    fn without_friction_nothing_is_tangential() {
        let law = HertzMindlin::new(acrylic(0.75, 0.0));
        let coefficients = law.coefficients(&paper_bodies()[1]).unwrap();
        let mut contact = Contact::new(DVec3::Y, 1e-6, DVec3::X);
        contact.elapsed = 1e-5;
        let memory = law.advance(&coefficients, &contact, &TangentialSpring::default());
        let force = law.force(&coefficients, &contact, &memory);
        assert_eq!((force.tangential, memory.load), (DVec3::ZERO, DVec3::ZERO));
    }

    #[test]
    fn the_papers_step_is_allowed_and_weak_damping_takes_more_steps() {
        let law = HertzMindlin::new(Material::acrylic());
        for bodies in paper_bodies() {
            let limit = law.time_step_limit(&law.coefficients(&bodies).unwrap());
            let duration = law.elastic_impact(&bodies, 1.0).unwrap().duration();
            assert_relative_eq!(limit, duration / 4.0, max_relative = 1e-12);
        }
        let bodies = paper_bodies()[0];
        let weak = HertzMindlin::new(acrylic(0.99, 0.2));
        let limit = weak.time_step_limit(&weak.coefficients(&bodies).unwrap());
        let duration = weak.elastic_impact(&bodies, 1.0).unwrap().duration();
        assert!(limit < duration / 12.0, "{}", duration / limit);
        assert!(law.tangential_damping(-1.0).is_err());
    }

    /// What a law answers over 100 steps in which a contact turns, slips back and forth, and twists.
    fn answers(law: &HertzMindlin, planar: bool) -> Vec<DVec3> {
        let coefficients = law.coefficients(&paper_bodies()[1]).unwrap();
        let mut memory = TangentialSpring::default();
        let step = |n: i32| {
            let time = 0.05 * f64::from(n);
            let normal = dvec3((0.02 * time).cos(), (0.02 * time).sin(), 0.0);
            let velocity = dvec3(0.3 * (3.0 * time).sin(), 0.4 * time.cos(), 0.0);
            let mut contact = Contact::new(normal, 2e-5 * (2.0 + time.sin()), velocity);
            contact.spins = [30.0 * DVec3::Z, -20.0 * DVec3::Z];
            contact.elapsed = 2e-5;
            contact.correction = 1e-5;
            contact.planar = planar;
            let force = law.force(&coefficients, &contact, &memory).tangential;
            memory = law.advance(&coefficients, &contact, &memory);
            force
        };
        (0..100).map(step).collect()
    }

    #[test]
    fn in_the_plane_a_number_stands_for_the_tangential_vector() {
        let law = HertzMindlin::new(acrylic(0.75, 0.3));
        let [space, plane] = [false, true].map(|planar| answers(&law, planar));
        for (space, plane) in space.iter().zip(&plane) {
            assert!((*space - *plane).length() < 1e-9 * space.length().max(1.0));
        }
    }

    /// Energy and velocities after impacts in a step that does not resolve the tangential oscillation.
    #[test]
    fn a_long_step_softens_the_tangential_spring_and_gains_nothing() {
        let law = HertzMindlin::new(acrylic(0.75, 0.2));
        let (mut sum, mut count) = (0.0, 0.0);
        for (mut fine, mut coarse) in oblique(&law).zip(oblique(&law)) {
            let before = coarse.kinetic_energy();
            fine.run_in(&mut VelocityVerlet, 400.0);
            coarse.run_in(&mut VelocityVerlet, 4.0);
            assert!(coarse.kinetic_energy() < before);
            let off = coarse.velocity.get(0).x - fine.velocity.get(0).x;
            (sum, count) = (sum + off * off, count + 1.0);
        }
        let deviation: f64 = sum / count;
        assert!(deviation.sqrt() < 0.012, "{}", deviation.sqrt());
    }
}
