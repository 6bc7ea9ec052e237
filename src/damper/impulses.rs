//! Contact dynamics: the impulses of a step under an impulse law.
//!
//! Nonsmooth contact dynamics, Moreau's time stepping with projected Gauss-Seidel sweeps (sources and
//! stages: [`SolverParameters`]). Called once at the beginning of a step; in comes the state there, out go
//! accelerations of particles and loads on walls that hold over the step, with which an integrator then
//! moves everything: x' = x + (v + v') dt/2. What is here serves the step alone, but for the forces that
//! contacts at rest bore, from which the next step starts.

use super::engine::Engine;
use super::state::{Plane, Space, Vectors, Volume};
use crate::cavity::Cavity;
use crate::detector::Detector;
use crate::law::{ImpulseLaw, SolverParameters, SweepOrder};
use crate::mount::Mount;
use crate::observer::Observer;
use crate::step_error::StepError;
use constraint::{ContactConstraint, RollingConstraint};
use container::{Container, Containers};
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

/// What the impulses of a step are worked out with.
#[derive(Debug, Clone, Default)]
pub(crate) struct ImpulseSolver<S: Space> {
    /// Where the particles will be when contacts are looked for, fixed frame.
    predicted: Vectors,
    bodies: Vec<SolverBody<S>>,
    containers: Containers<S>,
    /// Both as a simultaneous sweep found them.
    before_sweep: (Vec<SolverBody<S>>, Vec<Container<S>>),
    /// Active contacts: pairs, then walls.
    constraints: Vec<ContactConstraint<S>>,
    /// Of each constraint, what sweeps do not need.
    infos: Vec<ConstraintInfo>,
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
    }
}

/// A step of the solver.
#[derive(Debug, Clone, Copy)]
struct SolverStep {
    /// Length in s.
    time_step: f64,
    parameters: SolverParameters,
}

impl<C: Cavity, L: ImpulseLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Works out the impulses of a step of `time_step` (s), and leaves the accelerations and the loads on
    /// walls that hold over it.
    pub(crate) fn solve_contacts<O: Observer>(
        &mut self,
        time_step: f64,
        observer: &mut O,
    ) -> Result<(), StepError> {
        let step = SolverStep {
            time_step,
            parameters: self.model.law.solver(),
        };
        // Out of the engine while it works on the rest of it.
        let mut plane_or_volume = self.solver.take();
        let outcome = match &mut plane_or_volume {
            Some(ContactSolver::Plane(solver)) => self.solve(&step, solver, observer),
            Some(ContactSolver::Volume(solver)) => self.solve(&step, solver, observer),
            None => Ok(()),
        };
        self.solver = plane_or_volume;
        outcome
    }

    /// Lists what is in reach, and prepares the constraints, of the bed where it will be.
    fn find_constraints<S: Space>(
        &mut self,
        step: &SolverStep,
        solver: &mut ImpulseSolver<S>,
    ) -> Result<(), StepError> {
        self.set_prediction_distance(solver.prediction_distance)?;
        self.find_contacts(true)?;
        self.prepare(step, solver);
        self.check_overlaps()
    }

    fn solve<S: Space, O: Observer>(
        &mut self,
        step: &SolverStep,
        solver: &mut ImpulseSolver<S>,
        observer: &mut O,
    ) -> Result<(), StepError> {
        self.place_containers(self.time)?;
        self.predict(step, solver)?;
        std::mem::swap(&mut self.particles.position, &mut solver.predicted);
        let found = self.find_constraints(step, solver);
        std::mem::swap(&mut self.particles.position, &mut solver.predicted);
        found?;
        solver.list_coupled();
        solver.warm_start();
        for sweep in 0..step.parameters.sweeps {
            match step.parameters.order {
                SweepOrder::Sequential => solver.sweep(sweep),
                SweepOrder::Simultaneous => solver.sweep_at_once(),
            }
        }
        self.apply(step, solver)?;
        if observer.wants_contacts() {
            self.report(step, solver, observer);
        }
        Ok(())
    }
}
