//! Effective fields: what a damper by itself is to a host that moves it to and fro, over amplitude and
//! frequency.
//!
//! The container is moved along an axis by x = A sin wt, whatever the particles do. [`EffectiveFields`] says
//! with what, and where; each of its [`Point`]s is a run of its own, from which comes a [`Measurement`], a
//! list of periods; and measurements that differ by their seed make a [`Cell`], with means and intervals.
//!
//! # What a cell holds
//! A first harmonic is the part of a force or motion that goes with the frequency of the motion, Re F e^(iwt).
//! The complex power P = F V*/2 of the host on the particles has as real part what is lost, and as imaginary
//! part what is moved to and fro: [`ComplexPower`](crate::ComplexPower) has the formulas, their signs and
//! limits. In short:
//!
//! | field | meaning | of a bed at rest in the container |
//! |---|---|---|
//! | energy per cycle E | taken from the host, positive | 0 |
//! | apparent mass | moves in phase with the container; negative where the bed pushes like a spring | m |
//! | viscous coefficient c | of a dashpot to a fixed floor: E = pi c w A^2 | 0 |
//! | normalised loss | E/(m A^2 w^2/2), at most 8 without rebound | 0 |
//! | loss factor eta | Re P/Im P; none where the apparent mass is not positive | 0 |
//!
//! Masses are the bed's: the container's own mass is for the host to add. The loss factor diverges where the
//! apparent mass passes zero, which is where a bouncing bed takes most: maps of damping are drawn from the
//! energy or the viscous coefficient.
//!
//! The energy is found twice: from the force of the walls, and from what each contact lost. Over whole periods
//! the two agree, but for what the bed's own energy has grown by; a cell reports the
//! [difference](Cell::difference) and the [gain](Cell::gain).
//!
//! A cell says as well in which [`Regime`] the bed is, in the literature's words, and the numbers behind that
//! ([`BedState`]).
//!
//! # How sure
//! Cells hold [`Estimate`]s: the mean, a half-width at 95 % from the periods and seeds, and how far the
//! farthest seed is. Motions can coexist, and the start decides between them; then seeds differ by more than
//! the intervals. A cell whose start was not over is not [settled](Cell::settled).
//!
//! # Choosing steps
//! An impact comes up to half a step early or late. One ball that hits twice a cycle is within 1 % of theory at
//! 2000 steps a period under the coarse law, and within 2 % under a strict one whose contacts last a
//! five-hundredth of it ([`ElasticImpact::lasting`](crate::ElasticImpact::lasting) chooses such a stiffness).

mod cell;
mod error;
mod estimate;
mod measure;
mod point;
mod regime;
mod run;
mod settings;

pub use cell::Cell;
pub use error::FieldError;
pub use estimate::Estimate;
pub use point::{Cycle, Measurement, Point};
pub use regime::{BedState, Regime};
pub use run::Progress;
pub use settings::EffectiveFields;
