//! Frequency response of a structure that carries a particle damper (the paper's Figs 2, 4 and 9 to 11).
//!
//! A [`ResponseCurve`] says what is measured; each of its [`Point`]s is a run of its own: a container
//! filled at random from a seed, a harmonic drive of an amplitude and a frequency, a structure at rest, some
//! periods discarded and some averaged. What comes of it is a [`Response`] that says how sure it is. A
//! [sweep](ResponseCurve::sweep) keeps the state from point to point instead.
//!
//! The structure is the paper's oscillator under the force F sin 2 pi f t unless set otherwise; [`OnBase`],
//! [`Excited`] and any [`Structure`] of one's own are others.
//!
//! A period is cut into as many equal steps as keep them within the asked time step, so that averages
//! are over whole periods exactly. The start fades as exp(-C t / 2 M), M with the particles' mass as
//! long as they rest: to be rid of it, discard more than 9 time constants (20 s with the paper's
//! oscillator), or let [`periods_until`](ResponseCurve::periods_until) find out. The paper averages over 40
//! periods and says nothing of the start; 20 are discarded here unless set.

mod average;
mod branches;
mod curve;
mod error;
mod line;
mod measure;
mod period;
mod point;
mod run;
mod structure;
mod sweep;

pub use branches::{Branches, Parting};
pub use curve::ResponseCurve;
pub use error::ResponseError;
pub use line::{Line, Swept};
pub use period::Period;
pub use point::{HalfWidths, Point, Response};
pub use run::Progress;
pub use structure::{Drive, Excited, OnBase, Over, Structure};
