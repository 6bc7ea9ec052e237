//! # Trust it
//!
//! What to check before a number is believed, in the order of what goes wrong most often.
//!
//! 1. **The time step.** Halve it; the number should stay. A builder without a
//!    [`time_step`](crate::Builder::time_step) takes half of what the law bears. What a step is worth
//!    is said below, [under a strict law](#steps-to-a-contact) and [under the coarse one](#coarse-steps).
//! 2. **The overlaps.** A bed that is pressed into itself by more than a few hundredths of a radius is
//!    too soft or stepped too coarsely: [`Damper::largest_overlap`](crate::Damper::largest_overlap).
//! 3. **The energy.** An [`EnergyLedger`](crate::EnergyLedger) follows where it goes; what it cannot
//!    account for should be small against what was lost, and fall with the time step. So should what
//!    the step leaves [open](crate::EnergyLedger::integration_loss) of impacts.
//! 4. **The momentum.** What the container got is what the particles lost, to rounding.
//! 5. **Chance.** Fill with other [seeds](crate::Filling::new) and look at the spread.
//!
//! ```
//! use particle_damper::excitation::Harmonic;
//! use particle_damper::glam::DVec3;
//! use particle_damper::{Damper, EnergyLedger, Filling, HertzTsuji, Material, Particle, SingleDof, Slot};
//!
//! let grains = Filling::new(1).with(20, Particle::new(3e-3, 2e-4)?);
//! let mount = SingleDof::paper().excited_by(Harmonic::new(0.25, 6.0)?);
//! let gravity = DVec3::NEG_Y * 9.81;
//! let mut damper = Damper::builder(Slot::paper(), HertzTsuji::new(Material::acrylic()))
//!     .mount(mount)
//!     .gravity(gravity)
//!     .particles(grains.fill(&Slot::paper())?)
//!     .time_step(5e-6)
//!     .build()?;
//! let mut ledger = EnergyLedger::new();
//! let (before, mut received) = (damper.momentum(), DVec3::ZERO);
//! let mut deepest = 0.0_f64;
//! for _ in 0..10_000 {
//!     damper.step_watched(&mut ledger)?;
//!     received += damper.reaction(0).map_or(DVec3::ZERO, |reaction| reaction.impulse);
//!     deepest = deepest.max(damper.largest_overlap());
//! }
//! assert!(deepest < 0.05 * 3e-3);
//! assert!(ledger.residual().abs() < 0.01 * ledger.losses().total());
//! assert!(ledger.integration_loss() < 0.01 * ledger.losses().total());
//! let weight = gravity * (20.0 * 2e-4) * damper.time();
//! let lost = before - damper.momentum() + weight;
//! assert!((received - lost).length() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Steps to a contact
//! A strict law has to follow every impact. How long one lasts the law says
//! ([`elastic_impact`](crate::HertzTsuji::elastic_impact)); it depends little on the speed, as its
//! power -1/5. What a number of steps to a contact is worth is how far the restitution comes out from
//! the one asked for. Where in a step the bodies first touch is a matter of chance: the mean over this
//! phase is a systematic error, like another material, and what single impacts deviate by besides mostly
//! averages out over many. For any restitution from 0.3 to 0.95, with both forms of damping, at walls and
//! between particles, equal or not:
//!
//! | steps to a contact | [`VelocityVerlet`](crate::VelocityVerlet): mean | farthest of all phases | [`RungeKutta4`](crate::RungeKutta4): mean | farthest |
//! |---|---|---|---|---|
//! | 4 (the fewest) | +0.006 | 0.07 | -0.03 | 0.05 |
//! | 4.5 | +0.006 | 0.020 | -0.026 | 0.043 |
//! | 6 (the paper's) | +0.002 | 0.009 | -0.016 | 0.029 |
//! | 8 (the default) | +0.0013 | 0.004 | -0.008 | 0.018 |
//! | 12 | +0.0007 | 0.002 | -0.003 | 0.009 |
//! | 20 | +0.0002 | 0.0007 | -0.0008 | 0.0013 |
//! | 50 | 0.0000 | 0.0001 | -0.0001 | 0.0001 |
//!
//! The farthest are those of low restitutions: from 0.75 on, the farthest phase under `VelocityVerlet` is 0.007
//! off at four and a half steps and 0.003 at six. So the step that a builder takes by default realises the
//! restitution to 1 %. The means fall as the square of the step. Where contacts may
//! [pull](crate::Ending::PullingAllowed), means are smaller by a third, and the farthest phases 0.024 off at six
//! steps, 0.018 at eight and 0.006 at twenty. The table is printed by
//! `cargo run --release --example restitution`, with each restitution by itself after `-- --each`.
//!
//! A step for impacts of up to 0.5 m/s each of which is right to a thousandth:
//!
//! ```
//! use particle_damper::{Bodies, Body, HertzTsuji, Material, Materials};
//!
//! let law = HertzTsuji::new(Material::acrylic());
//! let grain = Body::sphere(3e-3, 2e-4, Materials::FIRST);
//! let time_step = law.elastic_impact(&Bodies::new(grain, grain), 0.5)?.duration() / 20.0;
//! assert!((time_step - 7.0e-6).abs() < 1e-8);
//! # Ok::<(), particle_damper::LawError>(())
//! ```
//!
//! # Coarse steps
//! An impulse law does not follow impacts: what counts is how far bodies come in a step. Under
//! [`RestitutionImpulse`](crate::RestitutionImpulse#accuracy-and-limits) the paper's damper, at speeds of up
//! to 1.5 m/s and with grains of 3 mm, is worth
//!
//! | step | way in it | RMS response against the strict law of the same restitution: worst, mean of 21 points | largest overlap |
//! |---|---|---|---|
//! | 0.1 ms | 0.05 radii | 1.4 %, 0.3 % | 0.08 radii |
//! | 0.2 ms | 0.1 radii | 1.9 %, 0.4 % | 0.17 radii |
//!
//! The overlaps are those of blows, which last some steps; an error comes at
//! [0.7 radii](crate::Builder::overlap_limit). To be rerun with
//! `cargo test --release --test physics -- --ignored --nocapture coarse_law::responses`.
//!
//! What the crate itself is checked against, with sources and tolerances: `examples/validation/`. Which
//! bits stay the same: same inputs, same bits, whatever the detector, the number of threads, and
//! whether a run was interrupted by a [`Snapshot`](crate::Snapshot); and on every platform whose `f64` is
//! that of IEEE 754 (not 32-bit x86 without SSE2), as the sines and powers come from the `libm` crate and
//! nothing is fused. Laws, excitations and hosts of one's own have to do likewise.
//!
//! # What is refused, and what is not
//! A step that a law, a mount or an excitation cannot bear is refused when a damper is built, and so is a
//! base that jumps. A step is an error if a container leaves the course that it began it with by half a
//! radius, at its farthest point where it turns, if a [prescribed](crate::Prescribed) velocity is not the rate
//! of its position, or an angular velocity not that of its orientation, and if a particle is out of its cavity or deep in another; the error says what may [lie behind](crate::Cause) it.
//!
//! Taken on trust are a closure and a mount of one's own that state nothing of themselves
//! ([`Featured`](crate::excitation::Featured), [`Mount::highest_frequency`](crate::Mount::highest_frequency)),
//! and the velocity that a host hands in. Particles that are some times faster than the law is set up for
//! are named only once they do harm.
//!
//! # Containers that turn
//! Tests hold a tilted box to tilted gravity, single spheres in a drum, on a turntable and on a plane that tips
//! to closed forms, and a box that flies and tumbles with its grains to its momentum and angular momentum, over
//! 1e5 steps to 1e-10 under either kind of law. That is exact under
//! [`VelocityVerlet`](crate::VelocityVerlet), and under an impulse law as long as contacts are looked for at the
//! [midpoint](crate::SolverParameters::prediction) of the step; else it is so to the order of the integrator.
//! An impulse law takes a wall to move in a straight line over the step: what is carried around sinks in by
//! about `(w dt)^2 r / 2` at a distance r from the axis, until position correction holds it. Of how a container
//! yields, a force law takes the state at the beginning of the step.
//!
//! # What it leaves out
//! Particles are spheres, containers are rigid, air and electric charge have no effect, and walls do not wear.
//! Contact laws take walls for flat: a contact with a rod as thin as the grain is in truth softer, by up to a
//! third.
