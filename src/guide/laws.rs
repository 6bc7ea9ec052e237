//! # Write a law
//!
//! A law is of one of two kinds. A [`ForceLaw`](crate::ForceLaw) answers the question what force two bodies
//! exert that overlap by so much and move so; an [`ImpulseLaw`](crate::ImpulseLaw) how they part when they
//! meet. The whole contract is on these pages and on that of what both have,
//! [`ContactLaw`](crate::ContactLaw). Signs: overlap is positive when bodies touch, a positive normal force
//! pushes them apart, forces are those on the first body.
//!
//! # A law of forces
//!
//! Here the spring is stiffer when the contact opens than when it closes (Walton & Braun 1986,
//! doi 10.1122/1.549893), which makes the restitution e = sqrt(k1/k2) whatever the speed. Which of
//! the two it is on depends on how far the contact was pressed: it has a memory.
//!
//! ```
//! use particle_damper::glam::DVec3;
//! use particle_damper::{Bodies, Contact, ContactForce, ContactLaw, ForceLaw, Forces, LawError};
//! use particle_damper::{Damper, Particle, Slot};
//!
//! struct WaltonBraun {
//!     loading: f64,   // N/m
//!     unloading: f64, // N/m, not less
//! }
//!
//! impl WaltonBraun {
//!     fn push(&self, overlap: f64, deepest: f64) -> f64 {
//!         let rest = deepest * (1.0 - self.loading / self.unloading);
//!         (self.loading * overlap).min(self.unloading * (overlap - rest)).max(0.0)
//!     }
//! }
//!
//! impl ContactLaw for WaltonBraun {
//!     type Kind = Forces;
//!     type Coefficients = f64; // longest time step, s
//!
//!     fn coefficients(&self, bodies: &Bodies) -> Result<f64, LawError> {
//!         Ok(0.1 * (bodies.effective_mass() / self.unloading).sqrt())
//!     }
//!
//!     fn time_step_limit(&self, longest: &f64) -> f64 {
//!         *longest
//!     }
//! }
//!
//! impl ForceLaw for WaltonBraun {
//!     type Memory = f64; // the greatest overlap so far, m
//!
//!     fn force(&self, _: &f64, contact: &Contact, deepest: &f64) -> ContactForce {
//!         let deepest = deepest.max(contact.overlap);
//!         ContactForce::new(self.push(contact.overlap, deepest), DVec3::ZERO)
//!     }
//!
//!     fn advance(&self, _: &f64, contact: &Contact, deepest: &f64) -> f64 {
//!         deepest.max(contact.overlap)
//!     }
//! }
//!
//! // By itself, before it meets a bed.
//! let law = WaltonBraun { loading: 1e4, unloading: 4e4 };
//! let contact = Contact::new(DVec3::Y, 1e-5, DVec3::ZERO);
//! assert!((law.force(&0.0, &contact, &0.0).normal - 0.1).abs() < 1e-12);
//! assert!(law.force(&0.0, &contact, &1.2e-5).normal < 0.1);
//!
//! // In a damper: a ball thrown at a wall comes back with half its speed.
//! let ball = Particle::new(3e-3, 2e-4)?;
//! let ball = ball.at(DVec3::new(4e-3, 0.03, 0.0)).moving(DVec3::NEG_X);
//! let mut damper = Damper::builder(Slot::paper(), law)
//!     .particles([ball])
//!     .gravity(DVec3::ZERO)
//!     .build()?;
//! for _ in 0..1000 {
//!     damper.step()?;
//! }
//! let speed = damper.particle(0).map_or(0.0, |ball| ball.velocity.x);
//! assert!((speed - 0.5).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Evaluating a force law changes nothing: integrators ask several times within a step.
//! [`advance`](crate::ForceLaw::advance) comes once per accepted step.
//!
//! # A law of impulses
//! At coarse steps an impact is over within one, and what counts is how the bodies part. An
//! [`ImpulseLaw`](crate::ImpulseLaw) says so in numbers, and the contact dynamics solver
//! ([`SolverParameters`](crate::SolverParameters)) makes impulses of them. Here restitution falls with
//! the speed of impact as that of metals does once they yield, e = e1 (v1/v)^(1/4) (Johnson, Contact
//! Mechanics, 1985, Eq. 11.47):
//!
//! ```
//! use particle_damper::glam::DVec3;
//! use particle_damper::{Bodies, ContactLaw, Damper, ImpulseLaw, Impulses, LawError, Particle, Slot};
//!
//! struct Yielding {
//!     restitution: f64, // at 1 m/s
//!     friction: f64,
//! }
//!
//! impl ContactLaw for Yielding {
//!     type Kind = Impulses;
//!     type Coefficients = f64; // longest step, s
//!
//!     fn coefficients(&self, bodies: &Bodies) -> Result<f64, LawError> {
//!         Ok(0.1 * bodies.first.radius.min(bodies.second.radius)) // a tenth of a radius at 1 m/s
//!     }
//!     fn time_step_limit(&self, longest: &f64) -> f64 {
//!         *longest
//!     }
//! }
//!
//! impl ImpulseLaw for Yielding {
//!     fn restitution(&self, _: &f64, approach_speed: f64) -> f64 {
//!         (self.restitution * approach_speed.powf(-0.25)).min(1.0)
//!     }
//!     fn friction(&self, _: &f64) -> f64 {
//!         self.friction
//!     }
//! }
//!
//! let ball = Particle::new(3e-3, 2e-4)?;
//! let ball = ball.at(DVec3::new(4e-3, 0.03, 0.0)).moving(DVec3::NEG_X * 0.5);
//! let mut damper = Damper::builder(Slot::paper(), Yielding { restitution: 0.4, friction: 0.2 })
//!     .particles([ball])
//!     .gravity(DVec3::ZERO)
//!     .time_step(1e-4)
//!     .build()?;
//! for _ in 0..100 {
//!     damper.step()?;
//! }
//! let speed = damper.particle(0).map_or(0.0, |ball| ball.velocity.x);
//! assert!((speed / 0.5 - 0.4 * 0.5_f64.powf(-0.25)).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Before trusting a law of your own, throw one ball at a wall at several speeds, angles and time
//! steps, as `examples/custom_law.rs` does: an error in a law shows there, and hides in a bed.
