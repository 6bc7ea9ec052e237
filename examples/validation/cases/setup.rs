//! What the cases share: materials, bodies, and one collision from touch to parting.

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    AllPairs, ContactEvent, ContactLaw, Cuboid, Damper, HertzTsuji, Integrator, Interaction,
    LawKind, Material, MaterialId, Materials, Observer, Particle, RungeKutta4,
};

use super::case::{Case, Tolerance};

/// A material; `e` and `mu` against itself and, through [`Materials`], against everything else.
pub(crate) fn material(modulus: f64, ratio: f64, e: f64, mu: f64) -> Material {
    Material::new(modulus, ratio, Interaction::new(e, mu).unwrap()).unwrap()
}

/// The paper's acrylic with another restitution and friction.
pub(crate) fn acrylic(e: f64, mu: f64) -> Material {
    material(0.4e9, 0.3, e, mu)
}

/// A material, and a rigid one that meets it in the same way.
pub(crate) fn on_rigid(material: Material) -> (Materials, MaterialId) {
    let mut materials = Materials::from(material);
    let mut plane = material;
    plane.youngs_modulus = 1e30;
    let rigid = materials.add(plane);
    (materials, rigid)
}

/// The paper's particle.
pub(crate) fn paper_particle() -> Particle {
    Particle::new(3e-3, 0.2e-3).unwrap()
}

/// Hertz's force constant 4/3 E* sqrt(r*) for two bodies given as (radius, E, nu).
pub(crate) fn hertz_constant(a: (f64, f64, f64), b: (f64, f64, f64)) -> f64 {
    let modulus = 1.0 / ((1.0 - a.2 * a.2) / a.1 + (1.0 - b.2 * b.2) / b.1);
    let radius = 1.0 / (1.0 / a.0 + 1.0 / b.0);
    4.0 / 3.0 * modulus * radius.sqrt()
}

/// Duration of an elastic Hertz impact, 3.2180655 (m*^2/(k^2 v))^(1/5).
pub(crate) fn hertz_duration(k: f64, effective_mass: f64, v: f64) -> f64 {
    3.218_065_5 * (effective_mass.powi(2) / (k * k * v)).powf(0.2)
}

/// What a collision did.
pub(crate) struct Collision {
    /// The bodies after it.
    pub(crate) bodies: Vec<Particle>,
    /// Largest overlap in m.
    pub(crate) overlap: f64,
    /// Largest normal force in N.
    pub(crate) force: f64,
    /// How long the bodies overlapped, in s.
    pub(crate) duration: f64,
}

#[derive(Default)]
struct Watch {
    events: usize,
    overlap: f64,
    force: f64,
}

impl Observer for Watch {
    fn wants_contacts(&self) -> bool {
        true
    }
    fn contact(&mut self, event: &ContactEvent) {
        self.events += 1;
        self.overlap = self.overlap.max(event.contact.overlap);
        self.force = self.force.max(event.force.normal);
    }
}

/// One body on the floor y = 0 of a box, or two above each other, without gravity, `gap` (m) short of
/// touching: the first comes down on the second. Steps until they have parted.
pub(crate) fn collide<L: ContactLaw, I: Integrator>(
    law: L,
    walls: MaterialId,
    integrator: I,
    dt: f64,
    gap: f64,
    bodies: &[Particle],
) -> Collision {
    let largest = bodies.iter().map(|body| body.radius).fold(0.0, f64::max);
    let side = 60.0 * largest;
    let mut placed = bodies.to_vec();
    let foot = dvec3(0.5 * side, 0.0, 0.5 * side);
    if bodies.len() == 1 {
        placed[0].position = foot + DVec3::Y * (bodies[0].radius + gap);
    } else {
        let reach = bodies[0].radius + bodies[1].radius + gap;
        placed[1].position = foot + DVec3::Y * 0.5 * side;
        placed[0].position = placed[1].position + DVec3::Y * reach;
    }
    let mut damper = Damper::builder(Cuboid::new(DVec3::splat(side)).unwrap(), law)
        .detector(AllPairs)
        .integrator(integrator)
        .gravity(DVec3::ZERO)
        .walls_of(walls)
        .particles(placed)
        .time_step(dt)
        .build()
        .unwrap();

    let overlap = |now: &[Particle]| match now {
        [first, second] => first.radius + second.radius - first.position.distance(second.position),
        _ => now[0].radius - now[0].position.y,
    };
    let impulsive = <L::Kind as LawKind<L>>::HELD;
    let mut watch = Watch::default();
    let (mut begin, mut end) = (0.0, 0.0);
    let mut now: Vec<Particle> = damper.particles().collect();
    for step in 0..100_000_000_u64 {
        let (before, events) = (overlap(&now), watch.events);
        damper.step_watched(&mut watch).unwrap();
        now.clear();
        now.extend(damper.particles());
        let after = overlap(&now);
        let at = |part: f64| (step as f64 + part) * dt;
        if before <= 0.0 && after > 0.0 {
            begin = at(before / (before - after));
        }
        if before > 0.0 && after <= 0.0 {
            end = at(before / (before - after));
        }
        if events > 0 && watch.events == events && (after <= 0.0 || impulsive) {
            break;
        }
        assert!(step < 50_000_000, "the bodies stay together");
    }
    Collision {
        bodies: now,
        overlap: watch.overlap,
        force: watch.force,
        duration: end - begin,
    }
}

/// Overlap, force and duration of an elastic impact at `v` (m/s) of `bodies` with the force constant `k`
/// and the effective mass `m`, against Hertz: 2000 steps to a contact.
pub(crate) fn elastic_impact(
    name: &str,
    source: &'static str,
    (materials, rigid): (Materials, MaterialId),
    bodies: &[Particle],
    (k, m, v): (f64, f64, f64),
) -> [Case; 3] {
    let duration = hertz_duration(k, m, v);
    let depth = (1.25 * m * v * v / k).powf(0.4);
    let law = HertzTsuji::new(materials).reference_speed(v).unwrap();
    let dt = duration / 2000.0;
    let gap = 0.3 * v * dt;
    let impact = collide(law, rigid, RungeKutta4::default(), dt, gap, bodies);
    [
        ("overlap (m)", depth, impact.overlap),
        ("force (N)", k * depth.powf(1.5), impact.force),
        ("duration (s)", duration, impact.duration),
    ]
    .map(|(what, expected, got)| {
        let close = Tolerance::Relative(1e-5);
        Case::new(format!("{name}: {what}"), source, expected, got, close)
    })
}
