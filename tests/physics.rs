//! What a bed does: mechanics, energy, laws and fillings.
//!
//! One program, so that what several files build dampers of is compiled once.

use particle_damper::Cavity;

#[path = "physics/coarse_law.rs"]
mod coarse_law;
#[path = "physics/composed.rs"]
mod composed;
#[path = "physics/failures.rs"]
mod failures;
#[path = "physics/filling.rs"]
mod filling;
#[path = "physics/impulses.rs"]
mod impulses;
#[path = "physics/ledger.rs"]
mod ledger;
#[path = "physics/mechanics.rs"]
mod mechanics;
#[path = "physics/mixed.rs"]
mod mixed;
#[path = "physics/no_panic.rs"]
mod no_panic;
#[path = "physics/rolling.rs"]
mod rolling;
#[path = "physics/rotation.rs"]
mod rotation;

/// A cavity of any kind: one type for many tests, which spares compiling.
type AnyCavity<'a> = &'a dyn Cavity;
