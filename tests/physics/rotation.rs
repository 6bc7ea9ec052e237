//! Containers that turn: what theory, symmetry and conservation say of them.

use particle_damper::glam::{DQuat, DVec3};
use particle_damper::{
    ContactLaw, HertzMindlin, HertzTsuji, Interaction, Material, Motion, Particle, Prescribed,
    RestitutionImpulse,
};

use super::AnyCavity;

#[path = "rotation/conserved.rs"]
mod conserved;
#[path = "rotation/frames.rs"]
mod frames;
#[path = "rotation/hosted.rs"]
mod hosted;
#[path = "rotation/known.rs"]
mod known;
#[path = "rotation/pendulum.rs"]
mod pendulum;

fn material(restitution: f64, friction: f64) -> Material {
    let interaction = Interaction::new(restitution, friction).unwrap();
    Material::new(5e6, 0.3, interaction).unwrap()
}

fn tsuji(friction: f64) -> HertzTsuji {
    HertzTsuji::new(material(0.6, friction))
}

fn mindlin(friction: f64) -> HertzMindlin {
    HertzMindlin::new(material(0.6, friction))
}

fn impulses(friction: f64) -> RestitutionImpulse {
    RestitutionImpulse::new(material(0.6, friction))
}

/// A motion of any kind: one type for all tests, which spares compiling.
type Moved = Prescribed<Box<dyn Fn(f64) -> Motion>>;

fn moved(motion: impl Fn(f64) -> Motion + 'static) -> Moved {
    Prescribed(Box::new(motion))
}

/// Rotation vectors of some size.
fn rotation(vector: [f64; 3]) -> DQuat {
    DQuat::from_scaled_axis(DVec3::from(vector))
}

/// The same bed seen from a frame that stands at `orientation`.
fn turned(bed: &[Particle], orientation: DQuat) -> Vec<Particle> {
    let turn = |particle: &Particle| {
        let mut particle = *particle;
        particle.velocity = orientation * particle.velocity;
        particle.spin = orientation * particle.spin;
        particle
    };
    bed.iter().map(turn).collect()
}
