//! Particle impact dampers.

#![forbid(unsafe_code)]

pub mod cavity;
mod contact;
mod damper;
pub mod detector;
mod error;
pub mod excitation;
mod filling;
pub mod guide;
pub mod integrator;
pub mod law;
mod material;
pub mod mount;
mod observer;
mod particle;
mod random;
pub mod response;

pub use glam;

pub use cavity::{Cavity, Cuboid, Slot};
pub use contact::{Bodies, Body, Contact, ContactForce, Stored};
pub use damper::{
    BuildError, Builder, Damper, Partner, Reaction, RestoreError, Snapshot, StepError, WallLoad,
};
pub use detector::{
    AllPairs, Bed, CellGrid, Counted, Detector, DetectorError, LinkedCells, Neighbourhood, Pairs,
    Skin,
};
pub use error::{Bound, ValueError};
pub use filling::{Filling, FillingError};
pub use integrator::{Integrator, RungeKutta4, VelocityVerlet};
pub use law::{
    ContactLaw, Damping, ElasticImpact, Ending, Evaluation, Friction, HertzMindlin, HertzTsuji,
    LawError, RestitutionImpulse, TangentialSpring,
};
pub use material::{Interaction, Material, MaterialId, Materials};
pub use mount::{Driven, Motion, Mount, MountEnergy, Prescribed, SingleDof};
pub use observer::{
    BedRegime, ContactEvent, Energies, EnergyLedger, Extremes, Frame, Losses, Observer, WallRecord,
    WallRecorder,
};
pub use particle::Particle;
pub use response::ResponseCurve;
