//! Particle impact dampers.

pub mod cavity;
mod contact;
mod damper;
pub mod detector;
mod error;
pub mod excitation;
mod filling;
pub mod integrator;
mod law;
mod material;
pub mod mount;
mod particle;
mod random;

pub use glam;

pub use contact::{Bodies, Body, Contact, ContactForce};
pub use damper::{BuildError, Partner, StepError};
pub use detector::{AllPairs, Bed, Detector, DetectorError, Pairs};
pub use error::{Bound, ValueError};
pub use filling::{Filling, FillingError};
pub use law::{ContactLaw, Evaluation, LawError};
pub use material::{Interaction, Material, MaterialId, Materials};
pub use particle::Particle;
