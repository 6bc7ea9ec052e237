//! What a bed does to a structure: response curves, sweeps and effective fields.
//!
//! A program beside that of `physics.rs`, so that both are compiled at the same time.

#[path = "response/curves.rs"]
mod curves;
#[path = "response/fields.rs"]
mod fields;
#[path = "response/structures.rs"]
mod structures;
#[path = "response/surety.rs"]
mod surety;
#[path = "response/sweeps.rs"]
mod sweeps;
