use std::fmt;

use crate::error::{Bound, ValueError};
use crate::excitation::{Base, Harmonic};
use crate::mount::{Mount, SingleDof};
use crate::observer::StepReport;

/// What a structure is driven by: a sine.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Drive {
    /// Amplitude: of a force in N, of a motion in m.
    pub amplitude: f64,
    /// Frequency f in Hz.
    pub frequency: f64,
}

impl Drive {
    /// The sine, zero and rising at time zero.
    ///
    /// # Errors
    /// If the amplitude is not finite, or the frequency is negative or not finite.
    pub fn harmonic(self) -> Result<Harmonic, ValueError> {
        Harmonic::new(self.amplitude, self.frequency)
    }
}

/// A structure of which a response curve is taken: a mount made for each drive, and what is watched of it.
///
/// # Using
/// [`SingleDof`] is an oscillator under a force, its displacement over F/K; [`OnBase`] an oscillator on a
/// moving base, its displacement over the base's; [`Excited`] any mount, made by a closure.
///
/// # Implementing
/// 1. [`mount`](Self::mount) gives the mount under a drive, at rest at time zero. Its drive is periodic with
///    the drive's frequency, and begins at the phase that [`phase_lag`](super::Response::phase_lag) is counted
///    from: that of a sine at time zero.
/// 2. [`watched`](Self::watched) is what is averaged, of the end of a step.
/// 3. [`unit`](Self::unit) is what the averages are over.
///
/// In a [sweep](super::ResponseCurve::sweep) the mount of the next drive takes over coordinates and rates
/// of the last one's.
///
/// A box shaken by hand; watched is the force on it, over the weight of 20 g:
/// ```
/// use std::f64::consts::TAU;
/// use particle_damper::glam::DVec3;
/// use particle_damper::response::{Drive, Structure};
/// use particle_damper::{Motion, Mount, StepReport, ValueError};
///
/// struct Shaken;
/// struct Shaking(Drive);
///
/// impl Mount for Shaking {
///     fn motion(&self, time: f64, _: &[f64], _: &[f64], _: usize) -> Motion {
///         let w = TAU * self.0.frequency;
///         let (sine, cosine) = (w * time).sin_cos();
///         let at = DVec3::Y * self.0.amplitude;
///         Motion::at(at * sine, at * w * cosine)
///     }
/// }
///
/// impl Structure for Shaken {
///     type Mount = Shaking;
///     fn mount(&self, drive: Drive) -> Result<Shaking, ValueError> {
///         Ok(Shaking(drive))
///     }
///     fn watched(&self, report: &StepReport<'_>) -> Option<f64> {
///         report.load(0).map(|load| load.force.y)
///     }
///     fn unit(&self, _drive: Drive) -> f64 {
///         0.02 * 9.81
///     }
/// }
/// ```
pub trait Structure {
    /// The mount.
    type Mount: Mount;

    /// The mount under a drive.
    ///
    /// # Errors
    /// If it cannot be driven like that.
    fn mount(&self, drive: Drive) -> Result<Self::Mount, ValueError>;

    /// What is watched, at the end of a step; the mount's first coordinate unless set. None if there is no
    /// such thing.
    fn watched(&self, report: &StepReport<'_>) -> Option<f64> {
        report.coordinates().first().copied()
    }

    /// What the averages of [`watched`](Self::watched) are over, positive; 1 unless set.
    fn unit(&self, _drive: Drive) -> f64 {
        1.0
    }
}

/// An oscillator under a force in N; its displacement over F/K.
impl Structure for SingleDof {
    type Mount = SingleDof<Harmonic>;

    fn mount(&self, drive: Drive) -> Result<Self::Mount, ValueError> {
        let stiffness = "stiffness of the primary system (N/m)";
        Bound::Positive.check(stiffness, self.stiffness())?;
        Ok(self.excited_by(drive.harmonic()?))
    }

    fn unit(&self, drive: Drive) -> f64 {
        drive.amplitude / self.stiffness()
    }
}

/// An oscillator on a base that moves, in m; its absolute displacement over the base's amplitude. The
/// [`first_harmonic`](super::Response::first_harmonic) is the transmissibility, and so is an RMS times the
/// root of two where motion is a sine (the paper's Fig. 2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OnBase(pub SingleDof);

impl Structure for OnBase {
    type Mount = SingleDof<Base<Harmonic>>;

    fn mount(&self, drive: Drive) -> Result<Self::Mount, ValueError> {
        Ok(self.0.excited_by(Base(drive.harmonic()?)))
    }

    fn unit(&self, drive: Drive) -> f64 {
        drive.amplitude
    }
}

/// What averages are over.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Over {
    /// Over 1: they keep the unit of what is watched.
    One,
    /// Over the amplitude of the drive.
    Amplitude,
    /// Over the static deflection: the amplitude over this stiffness, N/m.
    Deflection(f64),
}

/// What is watched of a mount.
#[derive(Debug, Clone, Copy)]
enum Watched {
    Coordinate(usize),
    Report(fn(&StepReport<'_>) -> f64),
}

/// A structure from a closure that makes the mount under a drive.
///
/// Two masses on springs of 200 N/m, the first one driven; watched is the second one, which carries the
/// damper:
/// ```
/// use std::ops::ControlFlow;
/// use particle_damper::glam::DVec3;
/// use particle_damper::excitation::{Harmonic, Signal};
/// use particle_damper::response::{Excited, Over};
/// use particle_damper::{Load, Material, Motion, Mount, ResponseCurve, RestitutionImpulse};
///
/// struct Two(Harmonic);
///
/// impl Mount for Two {
///     fn degrees(&self) -> usize {
///         2
///     }
///     fn motion(&self, _time: f64, x: &[f64], v: &[f64], _cavity: usize) -> Motion {
///         Motion::at(DVec3::Y * x[1], DVec3::Y * v[1])
///     }
///     fn accelerate(&self, time: f64, x: &[f64], v: &[f64], loads: &[Load], a: &mut [f64]) {
///         let (k, c) = (200.0, 0.1);
///         let [ground, between] = [k * x[0] + c * v[0], k * (x[1] - x[0]) + c * (v[1] - v[0])];
///         a[0] = (self.0.value(time) - ground + between) / 0.1;
///         a[1] = (loads[0].force.y - between) / 0.1;
///     }
///     fn highest_frequency(&self) -> f64 {
///         11.52
///     }
/// }
///
/// let curve = ResponseCurve::new(RestitutionImpulse::new(Material::acrylic()))
///     .structure(
///         Excited::by(|drive| Ok(Two(drive.harmonic()?)))
///             .watching(1)
///             .over(Over::Deflection(200.0)),
///     )
///     .amplitudes([0.25])
///     .particles([10])
///     .frequencies([4.4])
///     .periods(5, 5);
/// let response = &curve.run(|_| ControlFlow::Continue(()))?[0];
/// assert!(response.first_harmonic > 2.0);
/// # Ok::<(), particle_damper::response::ResponseError>(())
/// ```
#[derive(Clone, Copy)]
#[must_use]
pub struct Excited<F> {
    make: F,
    watched: Watched,
    over: Over,
}

impl<F, M> Excited<F>
where
    F: Fn(Drive) -> Result<M, ValueError>,
    M: Mount,
{
    /// The mount that `make` gives for each drive. Its first coordinate is watched, over 1.
    pub const fn by(make: F) -> Self {
        Self {
            make,
            watched: Watched::Coordinate(0),
            over: Over::One,
        }
    }

    /// Watches the coordinate of a number.
    pub const fn watching(mut self, coordinate: usize) -> Self {
        self.watched = Watched::Coordinate(coordinate);
        self
    }

    /// Watches anything that a step report shows.
    pub const fn watching_by(mut self, watched: fn(&StepReport<'_>) -> f64) -> Self {
        self.watched = Watched::Report(watched);
        self
    }

    /// What averages are over.
    pub const fn over(mut self, over: Over) -> Self {
        self.over = over;
        self
    }
}

impl<F> fmt::Debug for Excited<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Excited")
            .field("watched", &self.watched)
            .field("over", &self.over)
            .finish_non_exhaustive()
    }
}

impl<F, M> Structure for Excited<F>
where
    F: Fn(Drive) -> Result<M, ValueError>,
    M: Mount,
{
    type Mount = M;

    fn mount(&self, drive: Drive) -> Result<M, ValueError> {
        (self.make)(drive)
    }

    fn watched(&self, report: &StepReport<'_>) -> Option<f64> {
        match self.watched {
            Watched::Coordinate(number) => report.coordinates().get(number).copied(),
            Watched::Report(watched) => Some(watched(report)),
        }
    }

    fn unit(&self, drive: Drive) -> f64 {
        match self.over {
            Over::One => 1.0,
            Over::Amplitude => drive.amplitude,
            Over::Deflection(stiffness) => drive.amplitude / stiffness,
        }
    }
}
