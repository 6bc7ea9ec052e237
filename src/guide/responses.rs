//! # Run a response curve
//!
//! How much does a damper take off a resonance? Each point of a
//! [`ResponseCurve`](crate::ResponseCurve) is a run of its own: a container filled at random, a
//! harmonic force, some periods thrown away, some averaged. Point by point the result is the RMS
//! displacement over F/K, about zero and about its mean: they differ by the sag under the particles'
//! weight.
//!
//! ```
//! use std::ops::ControlFlow;
//! use particle_damper::{Material, ResponseCurve, RestitutionImpulse};
//!
//! let curve = ResponseCurve::new(RestitutionImpulse::new(Material::acrylic()))
//!     .particles([0, 40])
//!     .frequencies([6.0])
//!     .periods(3, 3); // 20 and 40 for a figure that is to be quoted
//! let responses = curve.run(|_| ControlFlow::Continue(()))?;
//! let [bare, damped] = [responses[0].rms_mean, responses[1].rms_mean];
//! assert!(damped < bare);
//! # Ok::<(), particle_damper::response::ResponseError>(())
//! ```
//!
//! # How sure
//!
//! A [`Response`](crate::response::Response) holds [half-widths](crate::response::HalfWidths) of 95 %
//! intervals, from the values of its periods, and whether the start was over. How long to wait: the start
//! fades as exp(-C t / 2M), which particles at rest do not hasten. Or say how sure you want to be:
//!
//! ```
//! use std::ops::ControlFlow;
//! use particle_damper::{Material, ResponseCurve, RestitutionImpulse};
//!
//! let curve = ResponseCurve::new(RestitutionImpulse::new(Material::acrylic()))
//!     .particles([10])
//!     .frequencies([6.5])
//!     .periods_until(0.05, 500); // 5 %, or give up after 500 periods
//! for response in curve.run(|_| ControlFlow::Continue(()))? {
//!     let width = response.half_widths.map_or(f64::INFINITY, |widths| widths.rms_mean);
//!     assert!(response.settled && width <= 0.05 * response.rms_mean);
//! }
//! # Ok::<(), particle_damper::response::ResponseError>(())
//! ```
//!
//! The RMS of one period is averaged with its neighbours' as if the motion went on like this for ever.
//! What another filling would give is not in the interval: several seeds tell. The periods' own values
//! come with the callback of [`measure`](crate::ResponseCurve::measure), and
//! [`statistics`](crate::statistics) are for series of any kind.
//!
//! # A structure of your own
//!
//! [`OnBase`](crate::response::OnBase) shakes the oscillator's base, which gives the transmissibility;
//! [`Excited`](crate::response::Excited) takes any mount from a closure, and names the coordinate that is
//! watched; a [`Structure`](crate::response::Structure) can be anything.
//!
//! # Where it comes from
//!
//! Impact dampers have more than one steady motion. A [`sweep`](crate::ResponseCurve::sweep) in amplitude or
//! frequency keeps the state from point to point, up and down, and
//! [`Branches::parted`](crate::response::Branches::parted) says where the two ways differ. With `periods` few
//! and points close it is a slow sweep; with many each point is a steady state.
//!
//! # Many points
//!
//! Points are independent; the feature `rayon` runs them on all cores, with the same bits. With the
//! feature `serde` they can be written, [measured](crate::ResponseCurve::measure) elsewhere one by one, and
//! their responses gathered: the same bits again. A [line](crate::response::Line) of a sweep goes out as a whole.
//!
//! # A damper by itself
//!
//! Without a structure, a damper is what it does to a container that is moved to and fro: what it takes per
//! cycle, and the mass that it seems to have. [`EffectiveFields`](crate::EffectiveFields) measures both over
//! amplitude and frequency; [`fields`](crate::fields) tells what the numbers mean. One ball, completely
//! inelastic, takes 4 m A^2 w^2 per cycle in a box of clear travel pi A, the most that it can:
//!
//! ```
//! use std::f64::consts::{PI, TAU};
//! use std::ops::ControlFlow;
//! use particle_damper::glam::{DVec3, dvec3};
//! use particle_damper::{EffectiveFields, Interaction, Material, Particle, RestitutionImpulse, Slot};
//!
//! let (amplitude, frequency, radius) = (0.01, 10.0, 3e-3);
//! let cavity = Slot::new(PI * amplitude + 2.0 * radius, 0.02)?;
//! let start = dvec3(radius, 0.01, 0.0); // on the wall behind, as fast as it
//! let ball = Particle::new(radius, 2e-4)?.at(start).moving(DVec3::X * (TAU * frequency * amplitude));
//! let soft = Material::new(0.4e9, 0.3, Interaction::new(0.0, 0.0)?)?;
//! let cells = EffectiveFields::new(RestitutionImpulse::new(soft), cavity)
//!     .along(DVec3::X)
//!     .gravity(DVec3::ZERO)
//!     .placed([ball])
//!     .amplitudes([amplitude])
//!     .frequencies([frequency])
//!     .periods(4, 4)
//!     .run(|_| ControlFlow::Continue(()))?;
//! assert!((cells[0].normalised_loss() - 8.0).abs() < 0.1);
//! assert!((cells[0].apparent_mass.value / ball.mass).abs() < 0.05);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Other experiments
//!
//! An experiment of another kind (a sweep, a shock, a record) is a loop over
//! [`Damper::step`](crate::Damper::step) with its own [excitation](crate::excitation); a free decay is a
//! [`SingleDof::released_from`](crate::SingleDof::released_from):
//!
//! ```
//! use particle_damper::{Damper, Filling, Material, Particle, RestitutionImpulse, SingleDof, Slot};
//!
//! let grains = Filling::new(1).with(60, Particle::new(3e-3, 2e-4)?);
//! let mut damper = Damper::builder(Slot::paper(), RestitutionImpulse::new(Material::acrylic()))
//!     .mount(SingleDof::paper().released_from(0.02, 0.0)?)
//!     .particles(grains.fill(&Slot::paper())?)
//!     .time_step(1e-4)
//!     .build()?;
//! let mut largest = 0.0_f64;
//! while damper.time() < 0.5 {
//!     damper.step()?;
//!     if damper.time() > 0.3 {
//!         largest = largest.max(damper.coordinates()[0].abs());
//!     }
//! }
//! let undamped_by_grains = 0.02 * f64::exp(-0.08 / (2.0 * 0.098) * 0.3);
//! assert!(largest < 0.8 * undamped_by_grains);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! `examples/response.rs` draws the paper's curves, `examples/effective_field.rs` the loss of a bed over
//! amplitude and gap, `examples/beam.rs` loss factors over amplitude.
