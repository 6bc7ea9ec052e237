//! Particle impact dampers: a container full of grains, mounted on a vibrating structure, turns
//! vibration into collisions and friction. This crate computes what the grains do and what the
//! structure feels of it, by a discrete element method: every grain is a sphere with position,
//! velocity and spin, every contact a force.
//!
//! It does all that T. Komatsuzaki and Y. Iwata describe (Int. J. Mech. Mater. Des. 13 (2017) 407-417,
//! doi 10.1007/s10999-016-9344-3, "the paper" on these pages) and goes on from there.
//!
//! # A damper in a program of one's own
//!
//! ```
//! use particle_damper::glam::{DVec3, dvec3};
//! use particle_damper::{Cuboid, Damper, Filling, Material, Motion, Particle, RestitutionImpulse};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // A box of 40 x 60 x 40 mm with 200 acrylic spheres of 4 mm.
//! let cavity = Cuboid::new(dvec3(0.04, 0.06, 0.04))?;
//! let bed = Filling::new(1).with(200, Particle::new(2e-3, 0.04e-3)?).fill(&cavity)?;
//! let law = RestitutionImpulse::new(Material::acrylic());
//! let mut damper = Damper::builder(cavity, law).particles(bed).time_step(1e-4).build()?;
//!
//! // The host's loop: it moves the box, and takes the reaction back. Here a mass on a spring.
//! let (mass, stiffness, interval) = (0.1, 400.0, 5e-4);
//! let (mut x, mut v) = (0.0, 1.0);
//! for _ in 0..400 {
//!     v -= stiffness * x / mass * interval;
//!     x += v * interval;
//!     let end = Motion::at(DVec3::Y * x, DVec3::Y * v);
//!     let reaction = damper.drive(end, interval)?;
//!     v += reaction.impulse.y / mass;
//! }
//! assert!(mass * v * v + stiffness * x * x < 0.5 * mass); // less than half its energy is left
//! # Ok(())
//! # }
//! ```
//!
//! # Where to go
//!
//! | to | read |
//! |---|---|
//! | embed a damper in a simulator | [`guide::embedding`] |
//! | write a contact law | [`guide::laws`] |
//! | write a contact detector | [`guide::detectors`] |
//! | run a response curve | [`guide::responses`] |
//! | design a damper | [`guide::design`] |
//! | know what the numbers are worth | [`guide::trust`] |
//!
//! # The parts
//!
//! A [`Damper`] is put together from five parts, each behind a trait that user code can implement:
//!
//! | part | trait | at hand |
//! |---|---|---|
//! | contact law | [`ContactLaw`]: [`ForceLaw`] or [`ImpulseLaw`] | [`HertzTsuji`] (the paper's strict law) and [`HertzMindlin`] (a tangential spring besides) give forces; [`RestitutionImpulse`] (the paper's approximate law, for coarse steps) gives impulses |
//! | contact detector | [`Detector`] | [`AllPairs`], [`CellGrid`] (the paper's cellular automaton), [`LinkedCells`]; [`Skin`] makes any of them last |
//! | integrator | [`Integrator`] | [`VelocityVerlet`], [`RungeKutta4`] (the paper's) |
//! | mount | [`Mount`] | [`SingleDof`] (the paper's oscillator), [`RigidBody`] (free to move and turn), [`Driven`] (by a host), [`Shaker`], [`Prescribed`] |
//! | cavity | [`Cavity`] | [`Slot`] (the paper's) and [`Disc`](cavity::Disc) in the plane, [`Cuboid`], [`Cylinder`](cavity::Cylinder), [`Sphere`](cavity::Sphere); [`Composite`](cavity::Composite)s of [`Part`](cavity::Part)s at any angle, with obstacles |
//!
//! Around them: [`Materials`] and their pairs, [`Filling`], [`excitation`]s of an oscillator,
//! [`Observer`]s such as the [`EnergyLedger`], [`Snapshot`]s, [`response`] curves, and [`statistics`] that
//! say how sure a mean is. For design: restitution from a [`drop_test`], closed forms of an
//! [`impact_damper`], the effective [`fields`] of a damper by itself, and the [`equivalent`] damper.
//!
//! # What happens in a step
//!
//! 1. Under an impulse law the impulses of all contacts are worked out together
//!    ([`SolverParameters`] has the stages); as forces they hold until the end of the step.
//! 2. The integrator moves particles and mount. Whenever it asks for accelerations, the containers are
//!    placed; a force law answers each contact that touches, in an order that does not depend on the
//!    detector; and the mount feels the sum.
//! 3. Candidates are proposed anew by the detector when some particle has moved by half the skin.
//! 4. Contacts advance their memory once, and observers are told of each once; then of the end of the
//!    step.
//!
//! # Units, frames and signs
//!
//! SI units and `f64` throughout; [`glam`] vectors. Particles and forces are in the fixed frame, walls
//! in the container's, which moves as a rigid body. y points up. An overlap is positive when bodies
//! touch; a reaction is the force of the particles *on* the container.
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | `serde` | [`Snapshot`]s, [`Recording`]s, and the points and results of [`response`] curves and [`fields`] can be written and read |
//! | `rayon` | response curves, fields and large beds on all cores |
//!
//! Neither is on by default, and neither changes a bit of any result.
//!
//! # Goals, in this order
//!
//! 1. Right: theory and published tests are met to the digits they give (`examples/validation`).
//! 2. The same bits from run to run, whichever detector, however many threads, after a restore, and on
//!    every platform whose `f64` is that of IEEE 754.
//! 3. Fast.
//! 4. Pleasant to embed. Bad input is refused when a damper is built; the library never panics,
//!    prints, reads a clock or starts a thread of its own.

#![forbid(unsafe_code)]
#![warn(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::print_stderr
)]
// Bits of its own, not of the platform.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod cavity;
mod contact;
mod damper;
pub mod detector;
mod digest;
pub mod drop_test;
pub mod equivalent;
mod error;
pub mod excitation;
pub mod fields;
mod filling;
pub mod guide;
pub mod impact_damper;
pub mod integrator;
pub mod law;
mod material;
pub mod mount;
mod numbers;
mod observer;
mod parallel;
mod particle;
mod periods;
mod random;
pub mod response;
mod rotation;
#[cfg(all(debug_assertions, not(test)))]
#[doc(hidden)]
pub mod shared;
pub mod statistics;
mod step_error;
mod tasks;

/// The version of this library, as in `0.1.0`. To be kept with results: those of one version have the same bits
/// everywhere, and what changes them is listed in the changelog.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

pub use glam;

pub use cavity::{Cavity, Cuboid, Slot};
pub use contact::{
    Bodies, Body, Contact, ContactForce, HeldForce, Onset, Partner, Stored, WallLoad,
};
pub use damper::{
    AnySnapshot, BuildError, Builder, Damper, DrivenDamper, Reaction, Recorded, Recording,
    ReplayError, RestoreError, Snapshot, StepBound,
};
pub use detector::{
    AllPairs, Bed, CellGrid, Counted, Detector, DetectorError, LinkedCells, Neighbourhood, Pairs,
    Skin,
};
pub use error::{Bound, ValueError};
pub use fields::EffectiveFields;
pub use filling::{Filling, FillingError};
pub use integrator::{Integrator, RungeKutta4, VelocityVerlet};
pub use law::{
    ContactLaw, ContactMemory, Damping, EitherLaw, ElasticImpact, Ending, ForceLaw, Forces,
    Friction, HertzMindlin, HertzTsuji, ImpulseLaw, Impulses, LawError, LawKind, NormalHistory,
    RestitutionImpulse, SolverParameters, SweepOrder, TangentialSpring,
};
pub use material::{Interaction, Material, MaterialId, Materials};
pub use mount::{
    Driven, Load, Motion, Mount, MountEnergy, Prescribed, RigidBody, Shaker, SingleDof,
};
pub use observer::{
    Account, BedRegime, ComplexPower, ContactEvent, Energies, EnergyLedger, EventLog, Extremes,
    Harmonics, LoggedContact, Losses, Observer, Phasor, StepReport, WallRecord, WallRecorder,
};
pub use particle::Particle;
pub use response::ResponseCurve;
pub use step_error::{Cause, StepError};
