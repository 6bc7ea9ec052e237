//! # Design a damper
//!
//! From a structure that vibrates to an order of grains, in five steps.
//!
//! **1. What the grains are.** Let one fall on a plate of the container's material and record when it is heard:
//! [`drop_test`](crate::drop_test) gives restitution and the damping of a strict law, with intervals.
//!
//! ```
//! use particle_damper::drop_test::DropTest;
//! use particle_damper::{Interaction, Material};
//!
//! let heard = [0.101, 0.2527, 0.3663, 0.4512, 0.5156, 0.5632]; // s
//! let measured = DropTest::new().times(&heard)?.restitution;
//! assert!(measured.high - measured.low < 0.02);
//! let mut material = Material::acrylic(); // its stiffness and friction
//! material.interaction = Interaction::new(measured.value, 0.2)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! **2. What the structure is, and what may stay.** Its mass where the damper goes, natural frequency, damping
//! and force say how far it moves without a damper; the use says how far it may. A bed of mass m at its best
//! takes 4 m A^2 w^2 in a cycle, which adds a damping ratio of (2/pi) m/M: that says what mass it takes at the
//! least.
//!
//! ```
//! use std::f64::consts::PI;
//!
//! // 0.5 kg, a damping ratio of 0.005: the peak is 100 static deflections. 20 may stay.
//! let (mass, own, wanted) = (0.5, 0.5 / 100.0, 0.5 / 20.0);
//! let bed = 0.5 * PI * (wanted - own) * mass;
//! assert!((bed - 0.0157).abs() < 1e-4); // kg; order half as much again
//! ```
//!
//! **3. How much room to leave.** The [rules for the clearance](crate::impact_damper) start from the amplitude
//! that is wanted with the damper. They are exact without gravity and on a structure that does not feel the
//! damper; where A w^2 is not well above g, less is better than they say, and below g the grains hardly move.
//!
//! ```
//! use particle_damper::impact_damper::{ball_clearance, bed_clearance, collecting_amplitude};
//!
//! let wanted = 2e-3; // m
//! let many = bed_clearance(wanted)?;
//! assert!((many - 6.3e-3).abs() < 1e-4);
//! assert!(collecting_amplitude(many)? <= wanted * (1.0 + 1e-12)); // below this a bed does little
//! assert!(ball_clearance(wanted, 0.75)? > many); // a single ball that rebounds
//! # Ok::<(), particle_damper::ValueError>(())
//! ```
//!
//! **4. What it does.** [`EffectiveFields`](crate::EffectiveFields) measure what a bed does in a box that nothing
//! stops, over amplitude and frequency; the [`equivalent`](crate::equivalent) damper puts that on any
//! structure, within a millisecond, as long as the bed is light. Many structures, forces and places to put it can be
//! tried so. For one structure a response curve does as well: `examples/design.rs` draws the map of the peak
//! over fill and grain size, and lets an optimiser find the best, both under the coarse law.
//!
//! ```
//! use std::f64::consts::TAU;
//! use std::ops::ControlFlow;
//! use particle_damper::equivalent::{EquivalentDamper, FieldTable, ModalStructure};
//! use particle_damper::{
//!     EffectiveFields, Material, Particle, RestitutionImpulse, SingleDof, Slot,
//! };
//!
//! let cells = EffectiveFields::new(RestitutionImpulse::new(Material::acrylic()), Slot::new(0.04, 0.02)?)
//!     .with(12, Particle::new(3e-3, 2e-4)?)
//!     .amplitudes([0.2e-3, 1e-3, 5e-3])
//!     .frequencies([18.0, 20.0])
//!     .periods(5, 10) // more for a figure that is to be relied on
//!     .run(|_| ControlFlow::Continue(()))?;
//! let field = FieldTable::from_cells(&cells)?;
//! let w = TAU * 20.0;
//! let structure = ModalStructure::oscillator(&SingleDof::new(0.2, 0.05, 0.2 * w * w)?)?;
//! let damper = EquivalentDamper::new(structure, field);
//! let force = 2.0;
//! for motion in damper.solutions(force, TAU * 19.9)? {
//!     assert!(motion.amplitude < force / (0.05 * w)); // less than without
//!     assert!(motion.effect.viscous_coefficient > 0.0 && !motion.doubtful());
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! **5. How sure that is, and what to order.** The design that was found is measured once more under the strict
//! law, with several seeds, until the [half-width](crate::response::HalfWidths) is what can be borne; see
//! [what to check](super::trust) before a number is believed. The order is number and diameter of the grains,
//! and the inner height of the container, which is that of the bed at rest and the clearance. A
//! [`WallRecorder`](crate::WallRecorder) says what the walls have to bear, and how often: wear and noise.
