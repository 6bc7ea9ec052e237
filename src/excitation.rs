//! Excitations: what drives an oscillator, and the signals that they are made of.
//!
//! | signal | value |
//! |---|---|
//! | [`Harmonic`] | a sine |
//! | [`Chirp`] | a sine that sweeps through a band |
//! | [`BandLimitedNoise`] | random, of a given band and RMS |
//! | [`HalfSine`] | a shock pulse |
//! | [`Sampled`] | a measured record |
//! | any closure `Fn(f64) -> [f64; 2]` | its own |
//!
//! Each of the named signals is an excitation by itself, a force in N, and [`Base`] makes any signal
//! the displacement of the base in m.

mod chirp;
mod feature;
mod half_sine;
mod harmonic;
mod noise;
mod sampled;
mod signal;

pub use chirp::Chirp;
pub use feature::Featured;
pub use half_sine::HalfSine;
pub use harmonic::Harmonic;
pub use noise::BandLimitedNoise;
pub use sampled::{Beyond, Sampled, SampledError};
pub use signal::{Jump, Signal};

/// What drives an oscillator: an external force as a function of time, which may depend on the
/// oscillator's support (base excitation).
///
/// # Using
/// Any closure from time (s) to force (N) is an excitation, `()` is none at all, and a pair is the
/// sum of both its parts. [`Harmonic`] and the other signals are forces in N; [`Base`] shakes the
/// base instead.
/// ```
/// use particle_damper::excitation::{Base, Excitation, Harmonic};
/// use particle_damper::mount::SingleDof;
///
/// // The paper's force, its base excitation, and both together with a constant pull.
/// let force = Harmonic::new(0.25, 6.0)?;
/// let base = Base(Harmonic::new(2e-3, 6.0)?);
/// let mount = SingleDof::paper().excited_by(((force, base), |_time: f64| -0.1));
/// assert_eq!(mount.excitation().force(0.0, 0.0, 123.4), -0.1);
/// # Ok::<(), particle_damper::ValueError>(())
/// ```
///
/// # Implementing
/// 1. [`force`](Self::force) is a function of its arguments alone: an integrator asks for any time,
///    in any order.
/// 2. It is positive along the axis of the oscillator.
/// 3. [`shortest_feature`](Self::shortest_feature) is what a damper's steps have to resolve. A closure
///    states none and is taken on trust; [`Featured`] states one for it.
pub trait Excitation {
    /// Force on the mass in N at `time` (s). `damping` (N s/m) and `stiffness` (N/m) are those of the
    /// support.
    fn force(&self, time: f64, damping: f64, stiffness: f64) -> f64;

    /// How long the shortest rise and fall of the force takes, s: of a sine half a period, of a pulse its
    /// length. A step is refused if ten do not fit in: what the force gives is then good to 1 % (of a
    /// half-sine pulse its impulse, of a sine the response to it). Infinite unless stated.
    fn shortest_feature(&self) -> f64 {
        f64::INFINITY
    }

    /// A jump of the base that nobody asked for by name; a damper refuses it. None unless stated.
    fn jump(&self) -> Option<Jump> {
        None
    }
}

impl Excitation for () {
    fn force(&self, _time: f64, _damping: f64, _stiffness: f64) -> f64 {
        0.0
    }
}

impl<F: Fn(f64) -> f64> Excitation for F {
    #[inline]
    fn force(&self, time: f64, _damping: f64, _stiffness: f64) -> f64 {
        self(time)
    }
}

/// The sum of two excitations.
impl<A: Excitation, B: Excitation> Excitation for (A, B) {
    #[inline]
    fn force(&self, time: f64, damping: f64, stiffness: f64) -> f64 {
        self.0.force(time, damping, stiffness) + self.1.force(time, damping, stiffness)
    }

    fn shortest_feature(&self) -> f64 {
        self.0.shortest_feature().min(self.1.shortest_feature())
    }

    fn jump(&self) -> Option<Jump> {
        self.0.jump().or_else(|| self.1.jump())
    }
}

macro_rules! forward_excitation {
    ($boxed:ty) => {
        /// An excitation chosen at run time.
        impl Excitation for $boxed {
            fn force(&self, time: f64, damping: f64, stiffness: f64) -> f64 {
                (**self).force(time, damping, stiffness)
            }

            fn shortest_feature(&self) -> f64 {
                (**self).shortest_feature()
            }

            fn jump(&self) -> Option<Jump> {
                (**self).jump()
            }
        }
    };
}

forward_excitation!(Box<dyn Excitation>);
forward_excitation!(Box<dyn Excitation + Send>);
forward_excitation!(Box<dyn Excitation + Send + Sync>);

macro_rules! force_in_newtons {
    ($($signal:ty),+) => {$(
        /// The signal as a force in N.
        impl Excitation for $signal {
            #[inline]
            fn force(&self, time: f64, _damping: f64, _stiffness: f64) -> f64 {
                self.value(time)
            }

            fn shortest_feature(&self) -> f64 {
                Signal::shortest_feature(self)
            }
        }
    )+};
}

force_in_newtons!(Harmonic, Chirp, BandLimitedNoise, HalfSine, Sampled);

/// Base excitation: spring and dashpot hang on a base that is displaced by the signal Y (m), which
/// drives the mass with K Y + C Y' (the paper's Sec. 2). The oscillator's coordinate stays the
/// absolute displacement of the mass.
///
/// A base known by its *acceleration* (an earthquake record) is integrated first,
/// [`Sampled::integral`]. The usual shortcut, a force -M Y" on the mass with the coordinate counted
/// from the base, is not offered: the particles would not feel it.
///
/// A base that jumps, in place or in speed, would strike the structure without a trace in the equations:
/// a damper refuses it, unless it is asked for by name ([`Sampled::beyond`]). A closure is taken on
/// trust.
///
/// ```
/// use particle_damper::excitation::{Base, Excitation};
///
/// // A base that moves away steadily.
/// let base = Base(|t: f64| [0.5 * t, 0.5]);
/// assert_eq!(base.force(2.0, 3.0, 10.0), 10.0 * 1.0 + 3.0 * 0.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Base<S>(pub S);

impl<S: Signal> Excitation for Base<S> {
    #[inline]
    fn force(&self, time: f64, damping: f64, stiffness: f64) -> f64 {
        let [displacement, velocity] = self.0.at(time);
        stiffness * displacement + damping * velocity
    }

    fn shortest_feature(&self) -> f64 {
        self.0.shortest_feature()
    }

    fn jump(&self) -> Option<Jump> {
        self.0.jump()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn a_harmonic_base_gives_the_force_of_the_paper() {
        let (y, f, k, c) = (2e-3, 6.0, 123.4, 0.08);
        let base = Base(Harmonic::new(y, f).unwrap());
        for step in 0..100 {
            let t = f64::from(step) * 1.37e-2;
            let w = TAU * f;
            let expected = k * y * (w * t).sin() + c * y * w * (w * t).cos();
            assert!((base.force(t, c, k) - expected).abs() < 1e-15);
        }
    }

    #[test]
    fn a_pair_is_the_sum_and_a_box_is_what_it_holds() {
        let harmonic = Harmonic::new(0.25, 6.0).unwrap();
        let pair = (harmonic, |t: f64| 2.0 * t);
        let alone = harmonic.force(0.3, 0.0, 0.0);
        assert!((pair.force(0.3, 0.0, 0.0) - (alone + 0.6)).abs() < 1e-15);
        let boxed: Box<dyn Excitation + Send + Sync> = Box::new(Base(harmonic));
        let base = Base(harmonic).force(0.3, 1.0, 2.0);
        assert!((boxed.force(0.3, 1.0, 2.0) - base).abs() < 1e-15);
    }
}
