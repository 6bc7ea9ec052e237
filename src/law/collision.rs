//! One contact by itself, for testing laws: two spheres, or a sphere above the wall y = 0.

use glam::{DVec3, dvec3};

use super::ForceLaw;
use crate::contact::{Bodies, Body, Contact, ContactForce, Onset};
use crate::damper::state::{Axes, Vectors, Volume, force_and_torques, levers, surface_velocity};
use crate::integrator::{Columns, Integrator, Motions, Stage, System};
use crate::material::{Interaction, Material, Materials};
use crate::step_error::StepError;

pub(super) struct Collision<'l, L: ForceLaw> {
    law: &'l L,
    bodies: Bodies,
    coefficients: L::Coefficients,
    memory: L::Memory,
    position: Vectors,
    pub(super) velocity: Vectors,
    acceleration: Vectors,
    time_step: f64,
    pub(super) spin: Vectors,
    spin_rate: Vectors,
    previous: [Vectors; 2],
    pub(super) touching: bool,
    pub(super) peak: (f64, f64),
}

/// A sphere of the paper's Table 1 against a wall, and against itself.
pub(super) fn paper_bodies() -> [Bodies; 2] {
    let sphere = Body::sphere(3e-3, 0.2e-3, Materials::FIRST);
    [
        Bodies::new(sphere, Body::wall(Materials::FIRST)),
        Bodies::new(sphere, sphere),
    ]
}

/// The paper's acrylic with another restitution and friction.
pub(super) fn acrylic(restitution: f64, friction: f64) -> Material {
    Material {
        interaction: Interaction::new(restitution, friction).unwrap(),
        ..Material::acrylic()
    }
}

/// Impacts at 1 m/s from 0 to 89 degrees with spin of either sign, at a wall and of a pair.
pub(super) fn oblique<L: ForceLaw>(law: &L) -> impl Iterator<Item = Collision<'_, L>> {
    let angles = (0..90).step_by(5).chain([89]).map(f64::from);
    angles.flat_map(move |degrees| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let velocity = dvec3(sine, -cosine, 0.0);
        [-600.0, -100.0, 0.0, 40.0, 600.0]
            .into_iter()
            .flat_map(move |spin| {
                paper_bodies().map(|bodies| Collision::new(law, bodies, velocity, spin * DVec3::Z))
            })
    })
}

impl<'l, L: ForceLaw> Collision<'l, L> {
    /// The first body comes down on the second with `velocity` (m/s) and `spin` (rad/s); they just
    /// touch.
    pub(super) fn new(law: &'l L, bodies: Bodies, velocity: DVec3, spin: DVec3) -> Self {
        let (count, height) = if bodies.at_wall() {
            (1, bodies.first.radius)
        } else {
            (2, bodies.first.radius + bodies.second.radius)
        };
        let column = |first: DVec3| {
            let mut column = Vectors::zeros(Axes::Space, count);
            column.set(0, first);
            column
        };
        Self {
            law,
            bodies,
            coefficients: law.coefficients(&bodies).unwrap(),
            memory: L::Memory::default(),
            position: column(dvec3(0.0, height, 0.0)),
            velocity: column(velocity),
            acceleration: column(DVec3::ZERO),
            time_step: 0.0,
            spin: column(spin),
            spin_rate: column(DVec3::ZERO),
            previous: [column(DVec3::ZERO), column(DVec3::ZERO)],
            touching: true,
            peak: (0.0, 0.0),
        }
    }

    fn body(&self, number: usize) -> Body {
        [self.bodies.first, self.bodies.second][number]
    }

    fn levers(&self, overlap: f64) -> [f64; 2] {
        let Bodies { first, second } = self.bodies;
        if self.bodies.at_wall() {
            [first.radius, 0.0]
        } else {
            levers([first.radius, second.radius], overlap)
        }
    }

    fn contact(&self, elapsed: f64, correction: f64) -> Contact {
        let (towards, prediction_distance) = if self.bodies.at_wall() {
            (self.position.get(0).y * DVec3::Y, self.bodies.first.radius)
        } else {
            let prediction_distance = self.bodies.first.radius + self.bodies.second.radius;
            (
                self.position.get(0) - self.position.get(1),
                prediction_distance,
            )
        };
        let (normal, overlap) = (towards.normalize(), prediction_distance - towards.length());
        let [own, other] = both(&self.velocity);
        let levers = self.levers(overlap);
        let velocity = surface_velocity::<Volume>(normal, own - other, both(&self.spin), levers);
        let mut contact = Contact::new(normal, overlap, velocity);
        contact.spins = both(&self.spin);
        contact.elapsed = elapsed;
        contact.correction = correction;
        contact
    }

    fn answer(&self, contact: &Contact, onset: Onset) -> (ContactForce, L::Memory) {
        let (law, kind, memory) = (self.law, &self.coefficients, &self.memory);
        let speed = contact.approach_speed();
        if law.corrects_onset() && Onset::is_near(contact.overlap, speed, self.time_step) {
            return law.at_onset(kind, contact, memory, &onset);
        }
        let answer = law.force(kind, contact, memory);
        (answer, law.advance(kind, contact, memory))
    }

    pub(super) fn kinetic_energy(&self) -> f64 {
        let energy = |n: usize| {
            let Body { mass, radius, .. } = self.body(n);
            let turning = 0.4 * radius * radius * self.spin.get(n).length_squared();
            0.5 * mass * (self.velocity.get(n).length_squared() + turning)
        };
        (0..self.position.len()).map(energy).sum()
    }

    /// Normal relative velocity, positive when separating.
    pub(super) fn separation_speed(&self) -> f64 {
        -self.contact(0.0, 0.0).approach_speed()
    }

    /// Steps until the bodies have parted; returns how long they touched.
    pub(super) fn run(&mut self, integrator: &mut impl Integrator, time_step: f64) -> f64 {
        self.time_step = time_step;
        let mut steps = 0;
        while self.touching {
            integrator.step(self, time_step).unwrap();
            steps += 1;
            assert!(steps < 1_000_000, "the bodies stay together");
        }
        f64::from(steps) * time_step
    }

    /// The same with `steps` to an elastic contact at the speed of approach.
    pub(super) fn run_in(&mut self, integrator: &mut impl Integrator, steps: f64) -> f64 {
        let slow = self.contact(0.0, 0.0).approach_speed();
        let impact = super::HertzTsuji::new(Material::acrylic()).elastic_impact(&self.bodies, slow);
        self.run(integrator, impact.unwrap().duration() / steps)
    }
}

/// The vectors of both bodies; that of a wall is zero.
fn both(column: &Vectors) -> [DVec3; 2] {
    [0, 1].map(|n| column.iter().nth(n).unwrap_or_default())
}

impl<L: ForceLaw> System for Collision<'_, L> {
    fn motions(&mut self) -> Motions<'_> {
        Motions {
            translation: Columns {
                position: self.position.flat_mut(),
                velocity: self.velocity.flat_mut(),
                acceleration: self.acceleration.flat(),
                previous: self.previous[0].flat(),
            },
            rotation: Columns {
                position: &mut [],
                velocity: self.spin.flat_mut(),
                acceleration: self.spin_rate.flat(),
                previous: self.previous[1].flat(),
            },
            mount: Columns {
                position: &mut [],
                velocity: &mut [],
                acceleration: &[],
                previous: &[],
            },
        }
    }

    fn evaluate(&mut self, elapsed: f64, stage: Stage) -> Result<(), StepError> {
        let predicted = stage == Stage::Predicted;
        let contact = self.contact(elapsed, if predicted { 0.5 * elapsed } else { 0.0 });
        let [ahead, behind] = both(&self.acceleration);
        let onset = Onset::new(self.time_step, (ahead - behind).dot(contact.normal));
        self.previous = [self.acceleration.clone(), self.spin_rate.clone()];
        self.acceleration.flat_mut().fill(0.0);
        self.spin_rate.flat_mut().fill(0.0);
        let touching = contact.overlap > 0.0;
        let mut advanced = L::Memory::default();
        if touching {
            let (answer, memory) = self.answer(&contact, onset);
            let levers = self.levers(contact.overlap);
            let (push, torques) =
                force_and_torques::<Volume, true>(contact.normal, levers, &answer);
            let forces = [push, -push];
            for (n, (force, torque)) in forces.into_iter().zip(torques).enumerate() {
                if n < self.position.len() {
                    let Body { mass, radius, .. } = self.body(n);
                    self.acceleration.set(n, force / mass);
                    let inertia = 0.4 * mass * radius * radius;
                    self.spin_rate.set(n, torque / inertia);
                }
            }
            advanced = memory;
            self.peak.0 = self.peak.0.max(contact.overlap);
            self.peak.1 = self.peak.1.max(answer.normal);
        }
        if stage != Stage::Trial {
            self.touching = touching;
            self.memory = advanced;
        }
        Ok(())
    }
}
