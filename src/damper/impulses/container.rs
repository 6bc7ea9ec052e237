//! Containers while impulses are worked out: how they move and yield.

use glam::{DMat3, DVec3};

use crate::damper::state::{Compartment, Space, State};
use crate::mount::{Load, Mobility, Motion, Mount};

/// The container of a cavity.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Container<S: Space> {
    /// Velocity after the impulses so far, m/s.
    pub(super) velocity: S::Vector,
    /// Velocity that the step leaves it without impulses, m/s.
    pub(super) free: S::Vector,
    /// Velocity that a free particle gains on it over the step, m/s.
    pub(super) velocity_gain: DVec3,
    /// The same as a speed.
    pub(super) speed_gain: f64,
    /// Where it was when contacts were looked for, m.
    pub(super) origin: DVec3,
}

impl<S: Space> Container<S> {
    /// One that moves from `start` to `end` without impulses, while a particle gains the velocity `fall`
    /// (m/s).
    fn new(start: &Motion, end: &Motion, fall: DVec3) -> Self {
        let velocity_gain = fall - (end.velocity - start.velocity);
        Self {
            velocity: S::vector(end.velocity),
            free: S::vector(end.velocity),
            velocity_gain,
            speed_gain: velocity_gain.length(),
            origin: start.position,
        }
    }
}

/// How a container turns.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct TurningContainer<S: Space> {
    /// Angular velocity after the impulses so far, rad/s.
    pub(super) spin: S::Spin,
    /// Angular velocity that the step leaves it without impulses, rad/s.
    pub(super) free: S::Spin,
    /// Angular velocity at the beginning of the step, rad/s.
    pub(super) start: DVec3,
}

impl<S: Space> TurningContainer<S> {
    /// One that moves from `start` to `end` without impulses.
    pub(super) fn new(start: &Motion, end: &Motion) -> Self {
        let free = S::spin(end.angular_velocity);
        Self {
            spin: free,
            free,
            start: start.angular_velocity,
        }
    }
}

/// All containers, and what impulses do to them.
#[derive(Debug, Clone, Default)]
pub(super) struct Containers<S: Space> {
    pub(super) each: Vec<Container<S>>,
    /// How they turn; empty if none does.
    pub(super) turning: Vec<TurningContainer<S>>,
    /// Their motions at the beginning of the step.
    pub(super) starts: Vec<Motion>,
    /// Velocity of the second of two containers per unit impulse on the first, 1/kg, row by row; empty if
    /// none yields.
    responses: Vec<DMat3>,
    /// The same with what turns; empty if none does.
    pub(super) mobilities: Vec<Mobility>,
    /// Scratch: the mount's coordinates and their rates at the middle of the step, both at its end,
    /// accelerations, and loads.
    middle: [Vec<f64>; 2],
    end: [Vec<f64>; 2],
    accelerations: Vec<f64>,
    loads: Vec<Load>,
}

impl<S: Space> Containers<S> {
    /// Inverse effective mass of the container of a cavity, 1/kg: its velocity per unit impulse on it.
    pub(super) fn inverse_mass(&self, cavity: usize) -> Option<&DMat3> {
        self.responses.get(cavity * (self.each.len() + 1))
    }

    /// The same with what turns; none if nothing does.
    pub(super) fn mobility(&self, cavity: usize) -> Option<&Mobility> {
        self.mobilities.get(cavity * (self.each.len() + 1))
    }

    /// Whether impulses move any container.
    pub(super) fn yield_at_all(&self) -> bool {
        !self.responses.is_empty()
    }

    /// Takes an impulse (N s) on the container of a cavity.
    #[inline(always)]
    pub(super) fn add(&mut self, cavity: usize, impulse: S::Vector) {
        let row = cavity * self.each.len();
        for (container, response) in self
            .each
            .iter_mut()
            .zip(self.responses.get(row..).unwrap_or_default())
        {
            container.velocity += S::transform(response, impulse);
        }
    }
}

impl<S: Space> Containers<S> {
    /// The containers' free velocities over a step of `time_step` (s), and how they yield.
    pub(super) fn set_free(&mut self, state: &State, mount: &dyn Mount, time_step: f64) {
        self.loads.clear();
        let cavities = state.compartments.len();
        self.loads.resize(cavities, Load::default());
        self.go_halfway(state, mount, time_step);
        self.set_rates(state, mount, time_step);
        self.set_coordinates(state, time_step);
        self.each.clear();
        self.turning.clear();
        self.starts.clear();
        let mut turns = false;
        for (cavity, compartment) in state.compartments.iter().enumerate() {
            let motion = self.at_end(state, mount, time_step, cavity);
            let start = compartment.motion;
            let fall = state.gravity * time_step;
            self.each.push(Container::new(&start, &motion, fall));
            self.turning.push(TurningContainer::new(&start, &motion));
            self.starts.push(start);
            turns |= compartment.turned || !motion.is_translation();
        }
        if !turns {
            self.turning.clear();
        }
        self.set_responses(state, mount, time_step, turns);
    }

    /// The mount in the middle of the step, without loads.
    fn go_halfway(&mut self, state: &State, mount: &dyn Mount, time_step: f64) {
        let [position, velocity] = state.mount_state();
        self.accelerations.clear();
        self.accelerations.resize(velocity.len(), 0.0);
        let rates = &mut self.accelerations;
        mount.accelerate(state.time, position, velocity, &self.loads, rates);
        let [middle, before] = &mut self.middle;
        advance(position, velocity, 0.5 * time_step, middle);
        advance(velocity, rates, 0.5 * time_step, before);
    }

    /// The mount's rates at the end of the step under the loads, of second order: with the accelerations at its
    /// middle.
    #[inline]
    fn set_rates(&mut self, state: &State, mount: &dyn Mount, time_step: f64) {
        let [middle, before] = &self.middle;
        let time = state.time + 0.5 * time_step;
        let accelerations = &mut self.accelerations;
        mount.accelerate(time, middle, before, &self.loads, accelerations);
        let [_, velocity] = state.mount_state();
        advance(velocity, accelerations, time_step, &mut self.end[1]);
    }

    /// The mount's coordinates at the end of the step: how a container stands counts where it turns alone.
    fn set_coordinates(&mut self, state: &State, time_step: f64) {
        let [coordinates, rates] = &mut self.end;
        let turned = |compartment: &Compartment| compartment.turned;
        if state.compartments.iter().any(turned) {
            advance(&self.middle[0], rates, 0.5 * time_step, coordinates);
        } else {
            coordinates.clear();
            coordinates.extend_from_slice(state.mount_state()[0]);
        }
    }

    /// How the container of a cavity moves at the end of the step.
    fn at_end(&self, state: &State, mount: &dyn Mount, time_step: f64, cavity: usize) -> Motion {
        let [coordinates, rates] = &self.end;
        let end = state.time + time_step;
        mount.motion(end, coordinates, rates, cavity)
    }

    /// What unit impulses on each container do to all of them.
    fn set_responses(&mut self, state: &State, mount: &dyn Mount, time_step: f64, turns: bool) {
        self.responses.clear();
        self.mobilities.clear();
        if state.degrees == 0 {
            return;
        }
        let cavities = self.each.len();
        self.responses.resize(cavities * cavities, DMat3::ZERO);
        let axes = if turns {
            self.mobilities.resize(cavities * cavities, Mobility::ZERO);
            6
        } else {
            S::WIDTH
        };
        for struck in 0..cavities {
            for axis in 0..axes {
                self.loads[struck] = Load::unit(axis);
                self.set_rates(state, mount, time_step);
                self.loads[struck] = Load::default();
                for cavity in 0..cavities {
                    let motion = self.at_end(state, mount, time_step, cavity);
                    let gained = motion.velocity - S::in_space(self.each[cavity].free);
                    let place = struck * cavities + cavity;
                    if axis < S::WIDTH {
                        *self.responses[place].col_mut(axis) = gained / time_step;
                    }
                    if turns {
                        let free = S::spin_in_space(self.turning[cavity].free);
                        let turned = (motion.angular_velocity - free) / time_step;
                        self.mobilities[place].set(axis, gained / time_step, turned);
                    }
                }
            }
        }
    }
}

/// Goes on `from` numbers for `time` at the rates `by`.
#[inline]
fn advance(from: &[f64], by: &[f64], time: f64, to: &mut Vec<f64>) {
    to.clear();
    to.extend(from.iter().zip(by).map(|(from, by)| from + by * time));
}
