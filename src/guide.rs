//! Six short pages, each with code that runs.
//!
//! | page | for whom |
//! |---|---|
//! | [Embed it](embedding) | a simulator that has a container of its own to damp |
//! | [Write a law](laws) | another force between two bodies |
//! | [Write a detector](detectors) | another way to find out who touches whom |
//! | [Run a response curve](responses) | how much is damped, at which frequency |
//! | [Design a damper](design) | from a structure to an order of grains, in five steps |
//! | [Trust it](trust) | what to check before believing a number |
//!
//! `examples/` goes on from here: programs of about 80 lines, to be copied.

pub mod design;
pub mod detectors;
pub mod embedding;
pub mod laws;
pub mod responses;
pub mod trust;
