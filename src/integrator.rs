//! Time integration.

use crate::step_error::StepError;

mod runge_kutta;
mod verlet;

pub use runge_kutta::RungeKutta4;
pub use verlet::VelocityVerlet;

/// One group of coordinates: their values, rates and accelerations, in columns of equal length.
/// Vectors are one after the other: x, y and z of the first, then of the second. Where a bed stays in
/// a plane, what is always zero is left out.
#[derive(Debug)]
pub struct Columns<'a> {
    /// Positions. Empty for coordinates of which only the rate matters (the spin of spheres).
    pub position: &'a mut [f64],
    /// Velocities.
    pub velocity: &'a mut [f64],
    /// Accelerations, as the last evaluation left them.
    pub acceleration: &'a [f64],
    /// Accelerations, as the evaluation before it left them.
    pub previous: &'a [f64],
}

/// Everything that moves.
#[derive(Debug)]
pub struct Motions<'a> {
    /// Centres of the particles, fixed frame: m, m/s, m/s^2.
    pub translation: Columns<'a>,
    /// Angular velocity (rad/s) and acceleration of the particles; no positions.
    pub rotation: Columns<'a>,
    /// Coordinates of the mount.
    pub mount: Columns<'a>,
}

impl<'a> Motions<'a> {
    /// All groups of coordinates.
    #[must_use]
    pub fn all(self) -> [Columns<'a>; 3] {
        [self.translation, self.rotation, self.mount]
    }
}

/// Which evaluation of a step is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// A trial on the way.
    Trial,
    /// The one at the end of the step: positions are final, contacts advance their memory.
    End,
    /// The same with velocities v + a dt, predicted with the accelerations a of the evaluation before,
    /// which the step ends by correcting to v + (a + a') dt/2. A contact's own force can then be worked
    /// out with the velocity that it will leave ([`Contact::correction`](crate::Contact::correction)).
    Predicted,
}

/// A mechanical system as an integrator sees it: columns to move, and a way to ask for
/// accelerations.
pub trait System {
    /// The columns.
    fn motions(&mut self) -> Motions<'_>;

    /// Sets the accelerations to those of the current positions and velocities, `elapsed` seconds
    /// after the start of the step.
    ///
    /// # Errors
    /// If the state has become unusable; the step has to be given up.
    fn evaluate(&mut self, elapsed: f64, stage: Stage) -> Result<(), StepError>;
}

/// Takes a [`System`] from one step to the next.
///
/// # Using
/// [`VelocityVerlet`] is the default, one evaluation a step; [`RungeKutta4`] is the paper's, four. One that
/// is chosen at run time is a `Box<dyn Integrator>`.
///
/// # Implementing
/// 1. On entry the accelerations are those of the current state.
/// 2. Call [`System::evaluate`] any number of times with [`Stage::Trial`], and then exactly once with
///    [`Stage::End`] or [`Stage::Predicted`] at `time_step`, with the final positions. Velocities may
///    still be corrected after that.
/// 3. The accelerations that the last evaluation left serve as the next step's first.
/// 4. Keep scratch in the integrator, and nothing else: a step may follow a restored state.
///
/// Symplectic Euler, complete:
/// ```
/// use particle_damper::integrator::{Columns, Integrator, Stage, System};
/// use particle_damper::StepError;
///
/// struct SymplecticEuler;
///
/// fn push(columns: Columns<'_>, dt: f64) {
///     for (v, a) in columns.velocity.iter_mut().zip(columns.acceleration) {
///         *v += *a * dt;
///     }
///     for (x, v) in columns.position.iter_mut().zip(columns.velocity) {
///         *x += *v * dt;
///     }
/// }
///
/// impl Integrator for SymplecticEuler {
///     fn step(&mut self, system: &mut dyn System, time_step: f64) -> Result<(), StepError> {
///         for columns in system.motions().all() {
///             push(columns, time_step);
///         }
///         system.evaluate(time_step, Stage::End)
///     }
/// }
/// ```
pub trait Integrator {
    /// Moves `system` on by `time_step` seconds.
    ///
    /// # Errors
    /// Whatever an evaluation reports.
    fn step(&mut self, system: &mut dyn System, time_step: f64) -> Result<(), StepError>;
}

macro_rules! forward_integrator {
    ($reference:ty) => {
        impl<I: Integrator + ?Sized> Integrator for $reference {
            fn step(&mut self, system: &mut dyn System, time_step: f64) -> Result<(), StepError> {
                (**self).step(system, time_step)
            }
        }
    };
}

forward_integrator!(&mut I);
forward_integrator!(Box<I>);
