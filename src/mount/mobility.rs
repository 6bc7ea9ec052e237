//! What impulses on containers do, from [`Mount::accelerate`], which is linear in the loads.

use glam::{DMat3, DVec3};

use super::{Load, Motion, Mount};

/// What an impulse on one container does to another, or to itself: a unit impulse per column.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Mobility {
    /// Velocity of the origin per impulse, 1/kg.
    pub(crate) linear: DMat3,
    /// Velocity of the origin per angular impulse, 1/(kg m).
    pub(crate) linear_by_torque: DMat3,
    /// Angular velocity per impulse, 1/(kg m).
    pub(crate) angular_by_force: DMat3,
    /// Angular velocity per angular impulse, 1/(kg m^2).
    pub(crate) angular: DMat3,
}

impl Mobility {
    pub(crate) const ZERO: Self = Self {
        linear: DMat3::ZERO,
        linear_by_torque: DMat3::ZERO,
        angular_by_force: DMat3::ZERO,
        angular: DMat3::ZERO,
    };

    /// Whether an impulse turns the container, or an angular impulse moves it.
    pub(crate) fn turns(&self) -> bool {
        let turning = [self.linear_by_torque, self.angular_by_force, self.angular];
        turning.iter().any(|part| *part != DMat3::ZERO)
    }

    /// Velocity and angular velocity that an impulse and an angular impulse about the origin give.
    #[inline]
    pub(crate) fn motion(&self, impulse: DVec3, angular: DVec3) -> [DVec3; 2] {
        [
            self.linear * impulse + self.linear_by_torque * angular,
            self.angular_by_force * impulse + self.angular * angular,
        ]
    }

    /// Velocity at `arm` (m) from the origin per unit impulse there along `direction`, along it, 1/kg.
    #[inline]
    pub(crate) fn along(&self, direction: DVec3, arm: DVec3) -> f64 {
        let turning = arm.cross(direction);
        let [velocity, angular] = self.motion(direction, turning);
        direction.dot(velocity) + turning.dot(angular)
    }

    /// The greatest velocity per unit impulse at up to `reach` (m) from the origin, from above
    /// (Gershgorin), 1/kg.
    pub(crate) fn greatest(&self, reach: f64) -> f64 {
        let [linear, mixed, turned, angular] = [
            self.linear,
            self.linear_by_torque,
            self.angular_by_force,
            self.angular,
        ]
        .map(|part| {
            let rows = [0, 1, 2].map(|row| part.row(row).abs().element_sum());
            rows.into_iter().fold(0.0, f64::max)
        });
        if self.turns() {
            linear + (mixed + turned) * reach + angular * reach * reach
        } else {
            linear
        }
    }

    /// All numbers, those of translation first.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> {
        [
            self.linear,
            self.linear_by_torque,
            self.angular_by_force,
            self.angular,
        ]
        .into_iter()
        .flat_map(|part| part.to_cols_array())
    }

    /// Sets column `axis` of the six to the motion that the unit load of that number leads to.
    pub(crate) fn set(&mut self, axis: usize, velocity: DVec3, turning: DVec3) {
        let (linear, angular) = if axis < 3 {
            (&mut self.linear, &mut self.angular_by_force)
        } else {
            (&mut self.linear_by_torque, &mut self.angular)
        };
        *linear.col_mut(axis % 3) = velocity;
        *angular.col_mut(axis % 3) = turning;
    }
}

/// The mobilities of all containers, and what they are worked out with.
#[derive(Debug, Clone, Default)]
pub(crate) struct Mobilities {
    /// Of the second of two containers to the first, row by row; none if the mount has no coordinates.
    each: Vec<Mobility>,
    /// Whether loads turn any container.
    turn: bool,
    cavities: usize,
    loads: Vec<Load>,
    rates: Vec<f64>,
    free: Vec<Motion>,
}

impl Mobilities {
    /// Those of a mount in a state.
    pub(crate) fn new(mount: &dyn Mount, time: f64, state: [&[f64]; 2], cavities: usize) -> Self {
        let mut new = Self {
            cavities,
            ..Self::default()
        };
        new.update(mount, time, state);
        new
    }

    /// Works them out in another state: coordinates and their rates.
    pub(crate) fn update(
        &mut self,
        mount: &dyn Mount,
        time: f64,
        [coordinates, velocities]: [&[f64]; 2],
    ) {
        self.each.clear();
        if mount.degrees() == 0 {
            return;
        }
        let cavities = self.cavities;
        self.each.resize(cavities * cavities, Mobility::ZERO);
        self.loads.clear();
        self.loads.resize(cavities, Load::default());
        let rates = &mut self.rates;
        let mut rates_under = |loads: &[Load], motions: &mut dyn FnMut(usize, Motion)| {
            rates.clear();
            rates.resize(mount.degrees(), 0.0);
            mount.accelerate(time, coordinates, velocities, loads, rates);
            for (rate, velocity) in rates.iter_mut().zip(velocities) {
                *rate += velocity;
            }
            for cavity in 0..cavities {
                motions(cavity, mount.motion(time, coordinates, rates, cavity));
            }
        };
        let free = &mut self.free;
        free.clear();
        rates_under(&self.loads, &mut |_, motion| free.push(motion));
        for struck in 0..cavities {
            for axis in 0..6 {
                self.loads[struck] = Load::unit(axis);
                rates_under(&self.loads, &mut |cavity, motion| {
                    let velocity = motion.velocity - free[cavity].velocity;
                    let turning = motion.angular_velocity - free[cavity].angular_velocity;
                    self.each[struck * cavities + cavity].set(axis, velocity, turning);
                });
            }
            self.loads[struck] = Load::default();
        }
        self.turn = self.each.iter().any(Mobility::turns);
    }

    /// All of them, row by row.
    pub(crate) fn all(&self) -> &[Mobility] {
        &self.each
    }

    /// That of a container by itself.
    pub(crate) fn own(&self, cavity: usize) -> Mobility {
        let own = self.each.get(cavity * (self.cavities + 1));
        own.copied().unwrap_or(Mobility::ZERO)
    }

    /// Whether loads turn any container.
    pub(crate) const fn turn(&self) -> bool {
        self.turn
    }
}
