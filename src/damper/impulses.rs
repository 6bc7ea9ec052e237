//! Contact dynamics: the impulses of a step under an impulse law.
//!
//! Nonsmooth contact dynamics, Moreau's time stepping with projected Gauss-Seidel sweeps (sources and
//! stages: [`SolverParameters`]). Called once at the beginning of a step; in comes the state there, out go
//! accelerations of particles and loads on walls that hold over the step, with which an integrator then
//! moves everything: x' = x + (v + v') dt/2. What is here serves the step alone, but for the forces that
//! contacts at rest bore, from which the next step starts.

use super::neighbours::{Detectors, Neighbours};
use super::parts::Parts;
use super::state::{Model, Plane, Space, State, Vectors, Volume};
use crate::cavity::Cavity;
use crate::law::{ImpulseLaw, SolverParameters, SweepOrder};
use crate::step_error::StepError;
use constraint::{ContactConstraint, RollingConstraint};
use container::{Container, Containers, TurningContainer};
use pairs::Lanes;
use prepare::ConstraintInfo;

mod apply;
mod constraint;
mod container;
mod energy;
mod pairs;
mod predict;
mod prepare;
mod report;
mod sweep;
mod turning;

/// A particle while impulses are worked out.
#[derive(Debug, Clone, Copy, Default)]
struct SolverBody<S: Space> {
    /// m/s.
    velocity: S::Vector,
    /// Spin times radius, m/s.
    spin: S::Spin,
    /// 1/kg.
    inverse_mass: f64,
}

/// Bodies and containers as a simultaneous sweep finds them.
#[derive(Debug, Clone, Default)]
struct BeforeSweep<S: Space> {
    bodies: Vec<SolverBody<S>>,
    containers: Vec<Container<S>>,
    turning: Vec<TurningContainer<S>>,
}

/// What the impulses of a step are worked out with.
#[derive(Debug, Clone, Default)]
pub(crate) struct ImpulseSolver<S: Space> {
    /// Where the particles will be when contacts are looked for, fixed frame.
    predicted: Vectors,
    bodies: Vec<SolverBody<S>>,
    containers: Containers<S>,
    /// Both as a simultaneous sweep found them.
    before_sweep: BeforeSweep<S>,
    /// Active contacts: pairs, then walls.
    constraints: Vec<ContactConstraint<S>>,
    /// Of each constraint, what sweeps do not need.
    infos: Vec<ConstraintInfo>,
    /// Of each constraint at a wall, from the container's origin to the point of contact, m; empty if no
    /// container turns.
    arms: Vec<S::Vector>,
    /// What resists rolling in each; empty if nothing does.
    rolling: Vec<RollingConstraint<S>>,
    /// How many constraints are pairs.
    pairs: usize,
    /// How many active contacts each particle has.
    contact_counts: Vec<u16>,
    /// The constraints that one solve does not settle, in ascending order.
    coupled: Vec<u32>,
    lanes: Lanes<S>,
    /// Where the constraints of each list of contacts end.
    list_ends: Vec<usize>,
    /// Gap at the prediction up to which contacts may be active, m.
    prediction_distance: f64,
}

/// The solver, in the plane or in space.
#[derive(Debug, Clone)]
pub(crate) enum ContactSolver {
    Plane(Box<ImpulseSolver<Plane>>),
    Volume(Box<ImpulseSolver<Volume>>),
}

impl ContactSolver {
    /// A solver for particles that stand at `position`.
    pub(crate) fn new(position: &Vectors, planar: bool) -> Self {
        if planar {
            Self::Plane(Box::new(ImpulseSolver::new(position)))
        } else {
            Self::Volume(Box::new(ImpulseSolver::new(position)))
        }
    }

    /// Memory in bytes that is reserved.
    pub(crate) fn reserved_bytes(&self) -> usize {
        match self {
            Self::Plane(solver) => solver.reserved_bytes(),
            Self::Volume(solver) => solver.reserved_bytes(),
        }
    }
}

impl<S: Space> ImpulseSolver<S> {
    fn new(position: &Vectors) -> Self {
        Self {
            predicted: position.clone(),
            ..Self::default()
        }
    }

    fn reserved_bytes(&self) -> usize {
        self.predicted.reserved_bytes()
            + size_of::<SolverBody<S>>() * self.bodies.capacity()
            + size_of::<ContactConstraint<S>>() * self.constraints.capacity()
            + size_of::<ConstraintInfo>() * self.infos.capacity()
            + size_of::<RollingConstraint<S>>() * self.rolling.capacity()
            + size_of::<u16>() * self.contact_counts.capacity()
            + size_of::<u32>() * self.coupled.capacity()
            + size_of::<SolverBody<S>>() * self.before_sweep.bodies.capacity()
    }
}

/// A step of the solver.
#[derive(Debug, Clone, Copy)]
struct SolverStep {
    /// Length in s.
    time_step: f64,
    parameters: SolverParameters,
}

impl ContactSolver {
    /// Works out the impulses of the step of `state` that begins, and leaves the accelerations and the loads
    /// on walls that hold over it.
    pub(crate) fn solve<C: Cavity, L: ImpulseLaw>(
        &mut self,
        model: &Model<C, L>,
        state: &mut State,
        neighbours: &mut Neighbours<L>,
        parts: &mut Parts<'_>,
    ) -> Result<(), StepError> {
        match self {
            Self::Plane(solver) => solver.solve(model, state, neighbours, parts),
            Self::Volume(solver) => solver.solve(model, state, neighbours, parts),
        }
    }
}

impl<S: Space> ImpulseSolver<S> {
    fn solve<C: Cavity, L: ImpulseLaw>(
        &mut self,
        model: &Model<C, L>,
        state: &mut State,
        neighbours: &mut Neighbours<L>,
        parts: &mut Parts<'_>,
    ) -> Result<(), StepError> {
        let step = SolverStep {
            time_step: state.time_step,
            parameters: model.law.solver(),
        };
        state.place_containers(parts.mount, state.time)?;
        self.predict(&step, state, parts.mount)?;
        std::mem::swap(&mut state.particles.position, &mut self.predicted);
        let found = self.find_constraints(&step, model, state, neighbours, parts.detectors);
        std::mem::swap(&mut state.particles.position, &mut self.predicted);
        found?;
        self.list_coupled();
        self.warm_start();
        for sweep in 0..step.parameters.sweeps {
            match step.parameters.order {
                SweepOrder::Sequential => self.sweep(sweep),
                SweepOrder::Simultaneous => self.sweep_at_once(),
            }
        }
        self.apply(&step, state, &mut neighbours.blocks)?;
        state.accelerate_mount(parts.mount, state.time);
        if parts.observer.wants_contacts() {
            self.report(&step, state, parts.observer);
        }
        Ok(())
    }

    /// Lists what is in reach, and prepares the constraints, of the bed where it will be.
    fn find_constraints<C: Cavity, L: ImpulseLaw>(
        &mut self,
        step: &SolverStep,
        model: &Model<C, L>,
        state: &State,
        neighbours: &mut Neighbours<L>,
        detectors: &mut dyn Detectors,
    ) -> Result<(), StepError> {
        neighbours.set_prediction_distance(state, detectors, self.prediction_distance)?;
        neighbours.find_contacts(model, state, detectors, true)?;
        self.prepare(step, &state.view(model, 0.0), &mut neighbours.blocks);
        neighbours.check_overlaps(model, state)
    }
}
