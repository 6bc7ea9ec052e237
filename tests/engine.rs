//! What a damper promises whatever it computes: the same bits from every detector, after a restore and from
//! any number of threads; hosts; and imports that run one way.
//!
//! One program, so that what several files build dampers of is compiled once.

#[path = "engine/bits.rs"]
mod bits;
#[path = "engine/detector_contract.rs"]
mod detector_contract;
#[path = "engine/hosts.rs"]
mod hosts;
#[path = "engine/imports.rs"]
mod imports;
#[path = "engine/large_bed.rs"]
mod large_bed;
#[path = "engine/paper_neighbourhood.rs"]
mod paper_neighbourhood;
#[path = "engine/snapshots.rs"]
mod snapshots;
