//! The equivalent damper: the field of an isolated damper put on a structure, instead of its grains.
//!
//! A damper that is shaken by itself at an amplitude A and an angular frequency w shows an apparent mass and
//! an equivalent viscous coefficient. Where a [`Field`] knows these, a structure with the damper on it is
//! solved by harmonic balance within a millisecond: A |1 + H_dd D(A)| = |H_df| F, with D = -w^2 m + i w c, H_dd the
//! structure's receptance at the damper and H_df that from the force to the damper.
//! [`EquivalentDamper::solutions`] gives *all* amplitudes that fulfil it, as several may;
//! [`EquivalentDamper::backbone`] the resonances over amplitude.
//!
//! ```
//! use std::f64::consts::TAU;
//! use particle_damper::SingleDof;
//! use particle_damper::equivalent::{EquivalentDamper, ModalStructure};
//! use particle_damper::impact_damper::OneBall;
//!
//! // The paper's oscillator with a ball of 4 g that has 70 mm to fly.
//! let structure = ModalStructure::oscillator(&SingleDof::paper())?;
//! let damper = EquivalentDamper::new(structure, OneBall::new(4e-3, 0.75, 70e-3)?);
//! let found = damper.solutions(0.25, TAU * 6.0288)?;
//! assert_eq!(found.len(), 1);
//! let rms = found[0].amplitude / f64::sqrt(2.0);
//! assert!((rms - 11.010e-3).abs() < 1e-6); // simulated, and by exact theory, 11.255 mm
//! # Ok::<(), particle_damper::ValueError>(())
//! ```
//!
//! # What it is worth
//! It takes the motion for a sine and what the damper does for what it does in a box that nothing stops. Both
//! fail as the damper becomes heavy: blows then shake the box at higher harmonics. Against the exact motion of
//! a ball in the box of the paper's oscillator (Masri & Caughey; e from 0.4 to 0.8, clearances up to 0.16 m, 5.7
//! to 6.3 Hz, where the motion is stable) the RMS is off by
//!
//! | ball over structure | worst |
//! |---|---|
//! | 0.01 | 0.4 % |
//! | 0.02 | 1.5 % |
//! | 0.05 | 6 % |
//! | 0.1 | 12 % |
//!
//! and in some places there is [no solution](EquivalentDamper::solutions) where there is a motion. Each
//! [`Solution`] says what speaks against it: [`mass_ratio`](Solution::mass_ratio), whose
//! [bound](Solution::doubtful) is a twentieth, and, if the field knows the third harmonic, how much of the
//! motion is no sine. The full simulation has the last word; `examples/equivalent.rs` lays both side by side.

mod balance;
mod field;
mod structure;

pub use balance::{BackbonePoint, EquivalentDamper, Solution};
pub use field::{Effect, Field, FieldTable};
pub use structure::{ModalStructure, Mode};
