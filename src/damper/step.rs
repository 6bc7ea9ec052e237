//! A step: the stages in their order.
//!
//! In: the state at its start, an integrator, and the parts that it asks. Out: the state at its end, and what
//! observers are told. Called by the damper, once for each step of its own and as often as a drive takes.

use super::engine::Engine;
use super::observable::Observed;
use super::parts::Parts;
use super::state::Clock;
use crate::cavity::Cavity;
use crate::integrator::{Integrator, Stage};
use crate::law::{ContactLaw, LawKind};
use crate::observer::StepReport;
use crate::step_error::StepError;

mod by_law;
mod system;

use by_law::{EvaluateForces, SolveImpulses};
use system::SteppedSystem;

impl<C: Cavity, L: ContactLaw> Engine<C, L> {
    /// Moves everything on by `dt` (s).
    pub(crate) fn step(
        &mut self,
        dt: f64,
        clock: &mut Clock,
        integrator: &mut dyn Integrator,
        parts: &mut Parts<'_>,
    ) -> Result<(), StepError> {
        self.state.begin_step(dt);
        self.state.check_passages()?;
        self.sort_in_time(parts)?;
        self.solve_impulses(parts)?;
        // Asks to evaluate forces, once or more.
        integrator.step(&mut SteppedSystem::new(self, parts, clock), dt)?;
        self.state.rebase_mount(parts.mount);
        self.state.check_course()?;
        self.state.time = clock.advance(dt);
        let observed = Observed::new(self, parts.mount);
        parts
            .observer
            .step(&StepReport::new(clock.time(), dt, &observed));
        Ok(())
    }

    /// Sorts a large bed if it is time to.
    fn sort_in_time(&mut self, parts: &mut Parts<'_>) -> Result<(), StepError> {
        let Self {
            model,
            state,
            neighbours,
            ..
        } = self;
        neighbours.sort_in_time(model, state, parts.detectors)
    }

    /// Accelerations of the current state at `time`, `elapsed` after the contact history was advanced.
    pub(crate) fn evaluate(
        &mut self,
        time: f64,
        elapsed: f64,
        stage: Stage,
        afresh: bool,
        parts: &mut Parts<'_>,
    ) -> Result<(), StepError> {
        self.state.place_containers(parts.mount, time)?;
        L::Kind::accept(EvaluateForces {
            engine: self,
            elapsed,
            stage,
            afresh,
            parts,
        })?;
        self.state.keep_mount_accelerations();
        self.state.accelerate_mount(parts.mount, time);
        Ok(())
    }

    /// Works out what holds over the step under an impulse law.
    fn solve_impulses(&mut self, parts: &mut Parts<'_>) -> Result<(), StepError> {
        L::Kind::accept(SolveImpulses {
            engine: self,
            parts,
        })
    }
}
