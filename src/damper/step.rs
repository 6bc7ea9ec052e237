//! A step of the damper, as an integrator sees it, and what is behind one that cannot be taken.

mod diagnosis;
mod system;

pub(crate) use diagnosis::StepStart;
pub(crate) use system::Step;
