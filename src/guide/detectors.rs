//! # Write a detector
//!
//! A detector proposes pairs that *might* touch. The damper tests the distance, and evaluates contacts
//! in an order of its own, so that every detector gives the same trajectory to the bit: swapping one
//! is a decision about speed alone. The contract is on [`Detector`](crate::Detector); the one thing
//! that must never happen is a missing pair.
//!
//! Sorting along one axis and sweeping is enough for a long, narrow cavity:
//!
//! ```
//! use particle_damper::{Bed, Damper, Detector, Filling, HertzTsuji, Material, Pairs, Particle, Skin};
//! use particle_damper::{AllPairs, Slot};
//!
//! #[derive(Clone, Default)]
//! struct Sweep {
//!     order: Vec<u32>, // kept, so that nothing is allocated once warm
//! }
//!
//! impl Detector for Sweep {
//!     fn detect(&mut self, bed: &Bed<'_>, pairs: &mut Pairs) {
//!         let x = |n: u32| bed.position(n as usize).x;
//!         let reach = 2.0 * bed.largest_radius() + bed.margin();
//!         self.order.clear();
//!         self.order.extend(0..bed.len() as u32);
//!         self.order.sort_unstable_by(|a, b| x(*a).total_cmp(&x(*b)));
//!         for (place, a) in self.order.iter().enumerate() {
//!             let near = |b: &&u32| x(**b) - x(*a) < reach;
//!             for b in self.order[place + 1..].iter().take_while(near) {
//!                 pairs.push(*a as usize, *b as usize);
//!             }
//!         }
//!     }
//! }
//!
//! let bed = Filling::new(3).with(40, Particle::new(3e-3, 2e-4)?).fill(&Slot::paper())?;
//! let builder = Damper::builder(Slot::paper(), HertzTsuji::new(Material::acrylic())).particles(bed);
//! let mut reference = builder.clone().detector(AllPairs).build()?;
//! let mut swept = builder.clone().detector(Sweep::default()).build()?;
//! let mut skinned = builder.detector(Skin::new(Sweep::default(), 0.5)?).build()?;
//! for _ in 0..500 {
//!     reference.step()?;
//!     swept.step()?;
//!     skinned.step()?;
//! }
//! assert!(reference.particles().eq(swept.particles()));
//! assert!(reference.particles().eq(skinned.particles()));
//! assert!(skinned.detections() * 5 < swept.detections());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Skin`](crate::Skin) makes any detector last over many steps; [`Counted`](crate::Counted) tells how
//! many pairs it proposed. `examples/custom_detector.rs` compares one
//! with those of the crate.
