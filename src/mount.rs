//! Mounts: what the container is fixed to, and how it moves.

use crate::excitation::Jump;

mod driven;
mod load;
mod mobility;
mod motion;
mod rigid_body;
mod shaker;
mod single_dof;

pub use driven::{Driven, Prescribed};
pub use load::Load;
pub(crate) use mobility::{Mobilities, Mobility};
pub use motion::Motion;
pub use rigid_body::RigidBody;
pub use shaker::Shaker;
pub use single_dof::SingleDof;

/// Energy of a mount at an instant, and the powers that change it, the particles' apart.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct MountEnergy {
    /// Kinetic energy in J, containers included.
    pub kinetic: f64,
    /// Potential energy in J: springs.
    pub potential: f64,
    /// Power of the excitation in W, positive when it feeds the mount.
    pub input: f64,
    /// Power in W that the mount's damping takes away, not negative.
    pub dissipation: f64,
}

impl MountEnergy {
    /// Kinetic and potential energy (J) without powers.
    #[must_use]
    pub const fn new(kinetic: f64, potential: f64) -> Self {
        Self {
            kinetic,
            potential,
            input: 0.0,
            dissipation: 0.0,
        }
    }

    /// The same with the powers (W) of the excitation and of damping.
    #[must_use]
    pub const fn with_powers(mut self, input: f64, dissipation: f64) -> Self {
        self.input = input;
        self.dissipation = dissipation;
        self
    }
}

/// What carries the containers: a structure with generalised coordinates of its own, solved together
/// with the particles, or a prescribed motion (no coordinates).
///
/// # Using
/// [`SingleDof`] is the oscillator of the paper's Eq. (1), [`RigidBody`] moves and turns freely. [`Driven`]
/// is moved by a host program, [`Shaker`] by a signal along an axis, [`Prescribed`] by any function of time.
///
/// # Implementing
/// 1. [`degrees`](Self::degrees) coordinates, in units of the mount's choice; slices passed in have
///    that length. [`start`](Self::start) sets their initial values.
/// 2. [`motion`](Self::motion) of container `cavity` is a function of time and coordinates: position and
///    orientation of those alone, velocity and angular velocity linear in the rates.
/// 3. [`accelerate`](Self::accelerate) solves the mount's equations of motion under `loads`, force (N) and
///    torque about its origin (N m) of the particles on each container. A coordinate q feels
///    `force . dv/dq' + torque . dw/dq'`, where v and w are velocity and angular velocity of the container:
///    one that turns it feels the torque. It is linear in the loads: from that follows what an
///    impulse on a container does. A mount with coordinates that no load moves is refused.
/// 4. [`highest_frequency`](Self::highest_frequency) and [`shortest_feature`](Self::shortest_feature)
///    say what steps the mount bears.
/// 5. [`energy`](Self::energy) is for observers. A mount without coordinates keeps the default: an
///    [`EnergyLedger`](crate::EnergyLedger) counts the work of moving its containers by itself.
/// 6. An angle in the plane is a coordinate like any other. Large rotations in space have no three
///    coordinates that serve everywhere; [`rebase`](Self::rebase) lets a mount begin each step with
///    others, as [`RigidBody`] does.
///
/// Two equal masses on a line, coupled by a spring, with a container on each:
/// ```
/// use glam::DVec3;
/// use particle_damper::mount::{Load, Motion, Mount};
///
/// struct Pair {
///     mass: f64,
///     stiffness: f64,
/// }
///
/// impl Mount for Pair {
///     fn degrees(&self) -> usize {
///         2
///     }
///     fn motion(&self, _time: f64, x: &[f64], v: &[f64], cavity: usize) -> Motion {
///         Motion::at(DVec3::X * x[cavity], DVec3::X * v[cavity])
///     }
///     fn accelerate(&self, _time: f64, x: &[f64], _v: &[f64], loads: &[Load], a: &mut [f64]) {
///         let spring = self.stiffness * (x[1] - x[0]);
///         a[0] = (loads[0].force.x + spring) / self.mass;
///         a[1] = (loads[1].force.x - spring) / self.mass;
///     }
///     fn highest_frequency(&self) -> f64 {
///         (2.0 * self.stiffness / self.mass).sqrt() / std::f64::consts::TAU
///     }
/// }
/// ```
pub trait Mount {
    /// How many generalised coordinates the mount has.
    fn degrees(&self) -> usize {
        0
    }

    /// Initial coordinates and their velocities; zero unless set.
    fn start(&self, _coordinates: &mut [f64], _velocities: &mut [f64]) {}

    /// The motion of the container of a cavity.
    fn motion(&self, time: f64, coordinates: &[f64], velocities: &[f64], cavity: usize) -> Motion;

    /// Sets `accelerations` from the mount's equations of motion under `loads`, one per cavity, on the
    /// container.
    fn accelerate(
        &self,
        _time: f64,
        _coordinates: &[f64],
        _velocities: &[f64],
        _loads: &[Load],
        _accelerations: &mut [f64],
    ) {
    }

    /// Called at the end of each step: may describe the same motion by other coordinates and rates. The
    /// accelerations stay those of the coordinates before. Does nothing unless set.
    fn rebase(&self, _coordinates: &mut [f64], _velocities: &mut [f64]) {}

    /// Energy and powers at an instant; zero unless said otherwise.
    fn energy(&self, _time: f64, _coordinates: &[f64], _velocities: &[f64]) -> MountEnergy {
        MountEnergy::default()
    }

    /// The highest natural frequency in Hz, or the highest rate of decay (rad/s) over 2 pi if that is
    /// higher; zero if there is none. A damper takes 20 steps to a period at the least, which keep the
    /// frequency to 0.5 % under [`VelocityVerlet`](crate::VelocityVerlet), and the amplitude to 2e-4 a
    /// period under [`RungeKutta4`](crate::RungeKutta4). A mount that states none is taken on trust.
    fn highest_frequency(&self) -> f64 {
        0.0
    }

    /// How long the [shortest feature](crate::excitation::Excitation::shortest_feature) of what drives
    /// the mount takes, s; infinite unless stated.
    fn shortest_feature(&self) -> f64 {
        f64::INFINITY
    }

    /// A jump of the mount's base that nobody asked for. None unless stated.
    fn jump(&self) -> Option<Jump> {
        None
    }

    /// Told that the damper was restored to a state with the containers at `motions`. Only a mount
    /// that keeps state of its own besides its coordinates cares.
    fn resume(&mut self, _motions: &[Motion]) {}
}

macro_rules! forward_mount {
    ($reference:ty) => {
        impl<M: Mount + ?Sized> Mount for $reference {
            fn degrees(&self) -> usize {
                (**self).degrees()
            }

            fn start(&self, coordinates: &mut [f64], velocities: &mut [f64]) {
                (**self).start(coordinates, velocities);
            }

            fn motion(
                &self,
                time: f64,
                coordinates: &[f64],
                velocities: &[f64],
                cavity: usize,
            ) -> Motion {
                (**self).motion(time, coordinates, velocities, cavity)
            }

            fn accelerate(
                &self,
                time: f64,
                coordinates: &[f64],
                velocities: &[f64],
                loads: &[Load],
                accelerations: &mut [f64],
            ) {
                (**self).accelerate(time, coordinates, velocities, loads, accelerations);
            }

            fn rebase(&self, coordinates: &mut [f64], velocities: &mut [f64]) {
                (**self).rebase(coordinates, velocities);
            }

            fn energy(&self, time: f64, coordinates: &[f64], velocities: &[f64]) -> MountEnergy {
                (**self).energy(time, coordinates, velocities)
            }

            fn highest_frequency(&self) -> f64 {
                (**self).highest_frequency()
            }

            fn shortest_feature(&self) -> f64 {
                (**self).shortest_feature()
            }

            fn jump(&self) -> Option<Jump> {
                (**self).jump()
            }

            fn resume(&mut self, motions: &[Motion]) {
                (**self).resume(motions);
            }
        }
    };
}

forward_mount!(&mut M);
forward_mount!(Box<M>);
