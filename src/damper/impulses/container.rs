//! Containers while impulses are worked out: how they move and yield.

use glam::{DMat3, DVec3};

use super::turning::TurningContainer;
use crate::cavity::Cavity;
use crate::damper::state::{Compartment, MountCoordinates, Space, State};
use crate::law::ContactLaw;
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
    pub(super) fn set_free<C: Cavity, L: ContactLaw, M: Mount + ?Sized>(
        &mut self,
        state: &State<C, L, M>,
        time_step: f64,
    ) {
        let MountCoordinates {
            position, velocity, ..
        } = &state.mount_coordinates;
        let degrees = state.mount.degrees();
        let (position, velocity) = (&position[..degrees], &velocity[..degrees]);
        let cavities = state.model.compartments.len();
        let Containers {
            each,
            turning,
            starts,
            responses,
            mobilities,
            middle: [middle, before],
            end: [coordinates, rates],
            accelerations,
            loads,
        } = self;
        loads.clear();
        loads.resize(cavities, Load::default());
        accelerations.clear();
        accelerations.resize(degrees, 0.0);
        let advance = |from: &[f64], by: &[f64], time: f64, to: &mut Vec<f64>| {
            to.clear();
            to.extend(from.iter().zip(by).map(|(from, by)| from + by * time));
        };
        // Of second order: with the accelerations at the middle of the step.
        let half = 0.5 * time_step;
        state
            .mount
            .accelerate(state.time, position, velocity, loads, accelerations);
        advance(position, velocity, half, middle);
        advance(velocity, accelerations, half, before);
        let mut rates_under = |loads: &[Load], rates: &mut Vec<f64>| {
            let time = state.time + half;
            state
                .mount
                .accelerate(time, middle, before, loads, accelerations);
            advance(velocity, accelerations, time_step, rates);
        };
        let end = state.time + time_step;
        rates_under(loads, rates);
        // How a container stands counts where it turns alone.
        let turned = |compartment: &Compartment<C>| compartment.turned;
        if state.model.compartments.iter().any(turned) {
            advance(middle, rates, half, coordinates);
        } else {
            coordinates.clear();
            coordinates.extend_from_slice(position);
        }
        let at_end = |rates: &[f64], cavity| state.mount.motion(end, coordinates, rates, cavity);

        each.clear();
        turning.clear();
        starts.clear();
        let mut turns = false;
        for (cavity, compartment) in state.model.compartments.iter().enumerate() {
            let (start, motion) = (compartment.motion, at_end(rates, cavity));
            each.push(Container::new(&start, &motion, state.gravity * time_step));
            turning.push(TurningContainer::new(&start, &motion));
            starts.push(start);
            turns |= compartment.turned || !motion.is_translation();
        }
        responses.clear();
        mobilities.clear();
        if !turns {
            turning.clear();
        }
        if degrees == 0 {
            return;
        }
        responses.resize(cavities * cavities, DMat3::ZERO);
        let axes = if turns {
            mobilities.resize(cavities * cavities, Mobility::ZERO);
            6
        } else {
            S::WIDTH
        };
        for struck in 0..cavities {
            for axis in 0..axes {
                loads[struck] = Load::unit(axis);
                rates_under(loads, rates);
                loads[struck] = Load::default();
                for (cavity, container) in each.iter().enumerate() {
                    let motion = at_end(rates, cavity);
                    let gained = motion.velocity - S::in_space(container.free);
                    let place = struck * cavities + cavity;
                    if axis < S::WIDTH {
                        *responses[place].col_mut(axis) = gained / time_step;
                    }
                    if turns {
                        let free = S::spin_in_space(turning[cavity].free);
                        let turned = (motion.angular_velocity - free) / time_step;
                        mobilities[place].set(axis, gained / time_step, turned);
                    }
                }
            }
        }
    }
}
