use glam::{DMat3, DQuat, DVec3, dvec3};

use super::{Load, Motion, Mount, MountEnergy};
use crate::error::{Bound, ValueError};
use crate::rotation::exp;

/// The most rounds in which the middle of a turn is found. Each leaves about half of the angle, in radians,
/// of what the last one left, if the body is no rod: at a tenth of a radian to the step, 12 reach the last digit.
const ROUNDS: usize = 16;

/// A rigid body that moves and turns freely, with the container fixed to it: in space with six degrees of
/// freedom, or in the plane z = 0 with three. Nothing acts on it but the particles and, if it is given a
/// weight, gravity.
///
/// Under [`VelocityVerlet`](crate::VelocityVerlet) momentum and angular momentum of body and particles
/// together are kept to rounding, whatever the step.
///
/// # Coordinates
/// In the plane: x and y of the centre of mass (m), and the angle about z (rad).
///
/// In space there are ten. The rates of the first three are the velocity of the centre of mass (m/s), and
/// those of the next three the angular momentum about it, J (kg m^2/s): so that torque is their
/// acceleration, and what a step adds up is exactly what particles lose. The last four, x, y, z and w of a
/// quaternion, are the orientation at the beginning of the step, in which they rest. With the inverse
/// W(q) of the tensor of inertia of a body that stands at q, and the integral A of J since then, the body is
/// turned by the vector W(m) A, where m is the orientation halfway: an implicit midpoint rule, reversible and
/// of second order (Hairer, Lubich & Wanner 2006, doi 10.1007/3-540-30666-8, section VII.5).
///
/// ```
/// use particle_damper::glam::{DMat3, DVec3, dvec3};
/// use particle_damper::mount::RigidBody;
/// use particle_damper::{Cuboid, Damper, Filling, HertzTsuji, Material, Motion, Particle};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// // A box of 40 x 60 x 40 mm, 0.1 kg, thrown with a spin.
/// let cavity = Cuboid::new(dvec3(0.04, 0.06, 0.04))?;
/// let grains = Filling::new(1).with(20, Particle::new(3e-3, 2e-4)?).fill(&cavity)?;
/// let inertia = DMat3::from_diagonal(dvec3(5e-5, 3e-5, 5e-5));
/// let body = RigidBody::new(0.1, inertia)?
///     .centre_of_mass(dvec3(0.02, 0.03, 0.02))
///     .released(Motion::at(DVec3::ZERO, DVec3::Y).turned(Default::default(), DVec3::X * 3.0))
///     .weighing(DVec3::NEG_Y * 9.81);
/// let mut damper = Damper::builder(cavity, HertzTsuji::new(Material::acrylic()))
///     .mount(body)
///     .particles(grains)
///     .build()?;
/// damper.step()?;
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidBody {
    mass: f64,
    /// Inverse of the tensor of inertia, container's frame.
    mobility: DMat3,
    inertia: DMat3,
    centre: DVec3,
    gravity: DVec3,
    start: Motion,
    planar: bool,
}

impl RigidBody {
    /// A body of `mass` (kg) and the tensor of `inertia` about its centre of mass (kg m^2, container's
    /// frame), at rest at the origin.
    ///
    /// # Errors
    /// If the mass is not positive, or the tensor not symmetric and positive definite.
    pub fn new(mass: f64, inertia: DMat3) -> Result<Self, ValueError> {
        let mass = Bound::Positive.check("mass of the body (kg)", mass)?;
        let columns = [inertia.x_axis, inertia.y_axis, inertia.z_axis];
        let largest = columns
            .iter()
            .fold(0.0_f64, |most, column| most.max(column.length()));
        let skew = columns
            .iter()
            .zip(0..)
            .fold(0.0_f64, |most, (column, row)| {
                most.max((*column - inertia.row(row)).length())
            });
        Bound::AtMost(1e-9 * largest).check("asymmetry of the inertia (kg m^2)", skew)?;
        let [x, y, _] = columns;
        let minors = [x.x, x.x * y.y - x.y * y.x, inertia.determinant()];
        for minor in minors {
            Bound::Positive.check("principal minor of the inertia", minor)?;
        }
        Ok(Self {
            mass,
            mobility: inertia.inverse(),
            inertia,
            centre: DVec3::ZERO,
            gravity: DVec3::ZERO,
            start: Motion::default(),
            planar: false,
        })
    }

    /// A body in the plane z = 0, of `mass` (kg) and the moment of `inertia` about its centre of mass
    /// (kg m^2).
    ///
    /// # Errors
    /// If a number is not positive.
    pub fn in_plane(mass: f64, inertia: f64) -> Result<Self, ValueError> {
        let inertia = Bound::Positive.check("moment of inertia (kg m^2)", inertia)?;
        Ok(Self {
            planar: true,
            ..Self::new(mass, DMat3::from_diagonal(DVec3::splat(inertia)))?
        })
    }

    /// The same body with its centre of mass elsewhere than at the container's origin (m, container's
    /// frame).
    #[must_use]
    pub const fn centre_of_mass(mut self, place: DVec3) -> Self {
        self.centre = place;
        self
    }

    /// The same body under gravity (m/s^2).
    #[must_use]
    pub const fn weighing(mut self, gravity: DVec3) -> Self {
        self.gravity = gravity;
        self
    }

    /// The same body let go with its container at `motion`.
    #[must_use]
    pub const fn released(mut self, motion: Motion) -> Self {
        self.start = motion;
        self
    }

    /// The motion of the container where the body stands at `orientation` with its centre of mass at
    /// `place`.
    fn container(
        &self,
        place: DVec3,
        velocity: DVec3,
        orientation: DQuat,
        turning: DVec3,
    ) -> Motion {
        let arm = orientation * self.centre;
        Motion::at(place - arm, velocity - turning.cross(arm)).turned(orientation, turning)
    }

    /// Angular velocity (rad/s) with the angular momentum `momentum` at an orientation.
    fn turning(&self, orientation: DQuat, momentum: DVec3) -> DVec3 {
        orientation * (self.mobility * (orientation.conjugate() * momentum))
    }

    /// Where the body stands at coordinates in space.
    fn orientation(&self, x: &[f64]) -> DQuat {
        let start = DQuat::from_slice(&x[6..10]);
        let integral = dvec3(x[3], x[4], x[5]);
        if integral == DVec3::ZERO {
            return start;
        }
        let mut vector = self.turning(start, integral);
        for _ in 0..ROUNDS {
            let next = self.turning(exp(vector * 0.5) * start, integral);
            let settled = next == vector;
            vector = next;
            if settled {
                break;
            }
        }
        (exp(vector) * start).normalize()
    }
}

impl Mount for RigidBody {
    fn degrees(&self) -> usize {
        if self.planar { 3 } else { 10 }
    }

    fn start(&self, x: &mut [f64], v: &mut [f64]) {
        let Motion {
            orientation,
            angular_velocity,
            ..
        } = self.start;
        let place = self.start.to_fixed(self.centre);
        let velocity = self.start.velocity_at(place);
        if self.planar {
            let angle = 2.0 * libm::atan2(orientation.z, orientation.w);
            x.copy_from_slice(&[place.x, place.y, angle]);
            v.copy_from_slice(&[velocity.x, velocity.y, angular_velocity.z]);
            return;
        }
        let local = orientation.conjugate() * angular_velocity;
        let momentum = orientation * (self.inertia * local);
        place.write_to_slice(x);
        velocity.write_to_slice(v);
        orientation.normalize().write_to_slice(&mut x[6..]);
        momentum.write_to_slice(&mut v[3..]);
    }

    fn motion(&self, _time: f64, x: &[f64], v: &[f64], _cavity: usize) -> Motion {
        if self.planar {
            let (place, velocity) = (dvec3(x[0], x[1], 0.0), dvec3(v[0], v[1], 0.0));
            let orientation = exp(DVec3::Z * x[2]);
            return self.container(place, velocity, orientation, DVec3::Z * v[2]);
        }
        let orientation = self.orientation(x);
        let turning = self.turning(orientation, dvec3(v[3], v[4], v[5]));
        self.container(
            DVec3::from_slice(x),
            DVec3::from_slice(v),
            orientation,
            turning,
        )
    }

    fn accelerate(&self, _time: f64, x: &[f64], _v: &[f64], loads: &[Load], a: &mut [f64]) {
        let orientation = if self.planar {
            exp(DVec3::Z * x[2])
        } else {
            self.orientation(x)
        };
        let arm = orientation * self.centre;
        let (mut force, mut torque) = (DVec3::ZERO, DVec3::ZERO);
        for load in loads {
            force += load.force;
            torque += load.torque_about(arm);
        }
        let acceleration = force / self.mass + self.gravity;
        if self.planar {
            let turning = torque.z * self.mobility.z_axis.z;
            a.copy_from_slice(&[acceleration.x, acceleration.y, turning]);
            return;
        }
        acceleration.write_to_slice(a);
        torque.write_to_slice(&mut a[3..]);
        a[6..].fill(0.0);
    }

    fn rebase(&self, x: &mut [f64], _v: &mut [f64]) {
        if !self.planar {
            let orientation = self.orientation(x);
            x[3..6].fill(0.0);
            orientation.write_to_slice(&mut x[6..]);
        }
    }

    fn energy(&self, time: f64, x: &[f64], v: &[f64]) -> MountEnergy {
        let turning = self.motion(time, x, v, 0).angular_velocity;
        let momentum = if self.planar {
            self.inertia * turning
        } else {
            dvec3(v[3], v[4], v[5])
        };
        let flat = |slice: &[f64]| {
            let z = if self.planar { 0.0 } else { slice[2] };
            dvec3(slice[0], slice[1], z)
        };
        let (place, velocity) = (flat(x), flat(v));
        let kinetic = self.mass * velocity.length_squared() + momentum.dot(turning);
        MountEnergy::new(0.5 * kinetic, -self.mass * self.gravity.dot(place))
    }
}
