//! The parts of a damper that are asked some times a step, and not in innermost loops.

use super::neighbours::Detectors;
use crate::mount::Mount;
use crate::observer::Observer;

/// The parts that a step asks, whatever their types.
pub(crate) struct Parts<'a> {
    pub(crate) mount: &'a dyn Mount,
    pub(crate) detectors: &'a mut dyn Detectors,
    pub(crate) observer: &'a mut dyn Observer,
}
