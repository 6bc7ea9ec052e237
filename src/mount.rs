//! Mounts: what the container is fixed to, and how it moves.

use glam::{DMat3, DVec3};

use crate::excitation::Jump;

mod driven;
mod shaker;
mod single_dof;

pub use driven::{Driven, Prescribed};
pub use shaker::Shaker;
pub use single_dof::SingleDof;

/// Position and velocity of a container (translation only), fixed frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Motion {
    /// Position of the container's origin in m.
    pub position: DVec3,
    /// Velocity of the container in m/s.
    pub velocity: DVec3,
}

impl Motion {
    /// A container at `position` (m) that moves with `velocity` (m/s).
    #[must_use]
    pub const fn at(position: DVec3, velocity: DVec3) -> Self {
        Self { position, velocity }
    }
}

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
/// [`SingleDof`] is the oscillator of the paper's Eq. (1). [`Driven`] is moved by a host program,
/// [`Shaker`] by a signal along an axis, [`Prescribed`] by any function of time.
///
/// # Implementing
/// 1. [`degrees`](Self::degrees) coordinates, in units of the mount's choice; slices passed in have
///    that length. [`start`](Self::start) sets their initial values.
/// 2. [`motion`](Self::motion) of container `cavity` is a function of time and coordinates. Containers
///    translate; they do not turn.
/// 3. [`accelerate`](Self::accelerate) solves the mount's equations of motion under `loads`, the
///    forces (N) of the particles on each container. It is linear in the loads: from that follows what an
///    impulse on a container does. A mount with coordinates that no load moves is refused.
/// 4. [`highest_frequency`](Self::highest_frequency) and [`shortest_feature`](Self::shortest_feature)
///    say what steps the mount bears.
/// 5. [`energy`](Self::energy) is for observers. A mount without coordinates keeps the default: an
///    [`EnergyLedger`](crate::EnergyLedger) counts the work of moving its containers by itself.
///
/// Two equal masses on a line, coupled by a spring, with a container on each:
/// ```
/// use glam::DVec3;
/// use particle_damper::mount::{Motion, Mount};
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
///     fn accelerate(&self, _time: f64, x: &[f64], _v: &[f64], loads: &[DVec3], a: &mut [f64]) {
///         let spring = self.stiffness * (x[1] - x[0]);
///         a[0] = (loads[0].x + spring) / self.mass;
///         a[1] = (loads[1].x - spring) / self.mass;
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

    /// Sets `accelerations` from the mount's equations of motion under `loads` (N, one force per
    /// cavity, on the container).
    fn accelerate(
        &self,
        _time: f64,
        _coordinates: &[f64],
        _velocities: &[f64],
        _loads: &[DVec3],
        _accelerations: &mut [f64],
    ) {
    }

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

/// Velocity of the second of two containers per unit impulse on the first, 1/kg, row by row; none if the
/// mount has no coordinates. From [`Mount::accelerate`], which is linear in the loads.
pub(crate) fn responses<M: Mount>(
    mount: &M,
    time: f64,
    coordinates: &[f64],
    velocities: &[f64],
    cavities: usize,
) -> Vec<DMat3> {
    let degrees = mount.degrees();
    if degrees == 0 {
        return Vec::new();
    }
    let velocities_under = |loads: &[DVec3]| -> Vec<DVec3> {
        let mut rates = vec![0.0; degrees];
        mount.accelerate(time, coordinates, velocities, loads, &mut rates);
        for (rate, velocity) in rates.iter_mut().zip(velocities) {
            *rate += velocity;
        }
        let motions = (0..cavities).map(|cavity| mount.motion(time, coordinates, &rates, cavity));
        motions.map(|motion| motion.velocity).collect()
    };
    let mut loads = vec![DVec3::ZERO; cavities];
    let free = velocities_under(&loads);
    let mut responses = vec![DMat3::ZERO; cavities * cavities];
    for struck in 0..cavities {
        for axis in 0..3 {
            loads[struck] = DVec3::AXES[axis];
            for (cavity, velocity) in velocities_under(&loads).into_iter().enumerate() {
                *responses[struck * cavities + cavity].col_mut(axis) = velocity - free[cavity];
            }
            loads[struck] = DVec3::ZERO;
        }
    }
    responses
}

impl<M: Mount + ?Sized> Mount for &mut M {
    fn degrees(&self) -> usize {
        (**self).degrees()
    }

    fn start(&self, coordinates: &mut [f64], velocities: &mut [f64]) {
        (**self).start(coordinates, velocities);
    }

    fn motion(&self, time: f64, coordinates: &[f64], velocities: &[f64], cavity: usize) -> Motion {
        (**self).motion(time, coordinates, velocities, cavity)
    }

    fn accelerate(
        &self,
        time: f64,
        coordinates: &[f64],
        velocities: &[f64],
        loads: &[DVec3],
        accelerations: &mut [f64],
    ) {
        (**self).accelerate(time, coordinates, velocities, loads, accelerations);
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
