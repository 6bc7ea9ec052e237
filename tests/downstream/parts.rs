//! Parts of a damper as a user writes them.

use std::f64::consts::PI;

use particle_damper::cavity::{Cavity, WallPoint};
use particle_damper::glam::{DVec3, dvec3};
use particle_damper::integrator::{Columns, Integrator, Stage, System};
use particle_damper::mount::{Load, Motion, Mount};
use particle_damper::{
    Bed, Bodies, Contact, ContactEvent, ContactForce, ContactLaw, Detector, ForceLaw, Forces,
    LawError, Observer, Pairs, Partner, StepError,
};

/// Sorts the lower ends along x, and sweeps.
#[derive(Debug, Clone, Default)]
pub(crate) struct SweepAndPrune {
    pub(crate) order: Vec<(f64, u32)>,
}

impl Detector for SweepAndPrune {
    fn detect(&mut self, bed: &Bed<'_>, pairs: &mut Pairs) {
        let half = 0.5 * bed.margin();
        self.order.clear();
        for (n, radius) in bed.radii().iter().enumerate() {
            self.order
                .push((bed.position(n).x - radius - half, n as u32));
        }
        self.order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        for (place, &(_, a)) in self.order.iter().enumerate() {
            let end = bed.position(a as usize).x + bed.radii()[a as usize] + half;
            for &(begin, b) in &self.order[place + 1..] {
                if begin > end {
                    break;
                }
                pairs.push(a as usize, b as usize);
            }
        }
    }
}

/// F = k d + c d', never pulling.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SpringDashpot {
    pub(crate) stiffness: f64,
    pub(crate) damping: f64,
}

impl ContactLaw for SpringDashpot {
    type Kind = Forces;
    type Coefficients = f64;

    fn coefficients(&self, bodies: &Bodies) -> Result<f64, LawError> {
        Ok(PI * (bodies.effective_mass() / self.stiffness).sqrt() / 5.0)
    }

    fn time_step_limit(&self, longest: &f64) -> f64 {
        *longest
    }
}

impl ForceLaw for SpringDashpot {
    type Memory = ();

    fn force(&self, _: &f64, contact: &Contact, (): &()) -> ContactForce {
        let normal = self.stiffness * contact.overlap + self.damping * contact.approach_speed();
        ContactForce::new(normal.max(0.0), DVec3::ZERO)
    }
}

/// The same with a tangential spring that slips (Cundall & Strack 1979).
#[derive(Debug, Clone, Copy)]
pub(crate) struct CundallStrack {
    pub(crate) normal: SpringDashpot,
    pub(crate) stiffness: f64,
    pub(crate) friction: f64,
}

impl CundallStrack {
    fn stretch(&self, contact: &Contact, before: DVec3) -> DVec3 {
        let flat = before - before.dot(contact.normal) * contact.normal;
        let stretch = flat + contact.slip() * contact.elapsed;
        let normal = self.normal.force(&0.0, contact, &()).normal;
        stretch.clamp_length_max(self.friction * normal / self.stiffness)
    }
}

impl ContactLaw for CundallStrack {
    type Kind = Forces;
    type Coefficients = f64;

    fn coefficients(&self, bodies: &Bodies) -> Result<f64, LawError> {
        self.normal.coefficients(bodies)
    }

    fn time_step_limit(&self, longest: &f64) -> f64 {
        *longest
    }
}

impl ForceLaw for CundallStrack {
    type Memory = DVec3;

    fn force(&self, own: &f64, contact: &Contact, memory: &DVec3) -> ContactForce {
        let normal = self.normal.force(own, contact, &()).normal;
        ContactForce::new(normal, self.stretch(contact, *memory) * -self.stiffness)
    }

    fn advance(&self, _: &f64, contact: &Contact, memory: &DVec3) -> DVec3 {
        self.stretch(contact, *memory)
    }
}

/// Kick, drift, kick.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Leapfrog;

fn kick(columns: &mut Columns<'_>, dt: f64) {
    for (v, a) in columns.velocity.iter_mut().zip(columns.acceleration) {
        *v += *a * dt;
    }
}

fn drift(columns: &mut Columns<'_>, dt: f64) {
    for (x, v) in columns.position.iter_mut().zip(&*columns.velocity) {
        *x += *v * dt;
    }
}

impl Integrator for Leapfrog {
    fn step(&mut self, system: &mut dyn System, time_step: f64) -> Result<(), StepError> {
        let half = 0.5 * time_step;
        for mut columns in system.motions().all() {
            kick(&mut columns, half);
            drift(&mut columns, time_step);
        }
        system.evaluate(time_step, Stage::End)?;
        for mut columns in system.motions().all() {
            kick(&mut columns, half);
        }
        Ok(())
    }
}

/// Two masses on a line: the ground, a spring, the first, a spring, the second; a cavity on each.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TwoMasses {
    pub(crate) masses: [f64; 2],
    pub(crate) stiffness: [f64; 2],
    pub(crate) speed: f64,
}

impl Mount for TwoMasses {
    fn degrees(&self) -> usize {
        2
    }

    fn start(&self, _coordinates: &mut [f64], velocities: &mut [f64]) {
        velocities[1] = self.speed;
    }

    fn motion(&self, _time: f64, x: &[f64], v: &[f64], cavity: usize) -> Motion {
        // The containers stand a metre apart.
        let place = DVec3::Z * cavity as f64;
        Motion::at(place + DVec3::X * x[cavity], DVec3::X * v[cavity])
    }

    fn accelerate(&self, _time: f64, x: &[f64], _v: &[f64], loads: &[Load], a: &mut [f64]) {
        let spring = self.stiffness[1] * (x[1] - x[0]);
        a[0] = (loads[0].force.x + spring - self.stiffness[0] * x[0]) / self.masses[0];
        a[1] = (loads[1].force.x - spring) / self.masses[1];
    }
}

impl TwoMasses {
    pub(crate) fn energy(&self, x: &[f64], v: &[f64]) -> f64 {
        let kinetic = self.masses[0] * v[0] * v[0] + self.masses[1] * v[1] * v[1];
        let stretch = x[1] - x[0];
        let springs = self.stiffness[0] * x[0] * x[0] + self.stiffness[1] * stretch * stretch;
        0.5 * (kinetic + springs)
    }
}

/// The lower half of a pipe along z, with a lid and two ends.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HalfPipe {
    pub(crate) radius: f64,
    pub(crate) length: f64,
}

impl Cavity for HalfPipe {
    fn walls(&self) -> u32 {
        4
    }

    fn wall(&self, number: u32, point: DVec3) -> WallPoint {
        let half = 0.5 * self.length;
        match number {
            0 => {
                let outwards = dvec3(point.x, point.y - self.radius, 0.0);
                WallPoint {
                    normal: -outwards.normalize_or(DVec3::NEG_Y),
                    distance: self.radius - outwards.length(),
                }
            }
            1 => WallPoint {
                normal: DVec3::NEG_Y,
                distance: self.radius - point.y,
            },
            2 => WallPoint {
                normal: DVec3::Z,
                distance: point.z + half,
            },
            _ => WallPoint {
                normal: DVec3::NEG_Z,
                distance: half - point.z,
            },
        }
    }

    fn bounds(&self) -> [DVec3; 2] {
        let corner = dvec3(self.radius, 0.0, 0.5 * self.length);
        [-corner, corner + DVec3::Y * self.radius]
    }

    fn wall_name(&self, number: u32) -> &'static str {
        ["pipe", "lid", "near end", "far end"][number as usize % 4]
    }
}

/// Adds up the energy of linear springs, and what the walls of the first cavity feel.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    pub(crate) stiffness: f64,
    pub(crate) stored: f64,
    pub(crate) contacts: usize,
    pub(crate) on_first: DVec3,
}

impl Observer for Watch {
    fn wants_contacts(&self) -> bool {
        true
    }

    fn contact(&mut self, event: &ContactEvent) {
        self.contacts += 1;
        self.stored += 0.5 * self.stiffness * event.contact.overlap * event.contact.overlap;
        if let (Partner::Wall(_), 0) = (event.partner, event.cavity) {
            self.on_first -= event.contact.normal * event.force.normal + event.force.tangential;
        }
    }
}
