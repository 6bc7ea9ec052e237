//! A step: the stages in their order.
//!
//! In: the state at its start, an integrator, and who watches. Out: the state at its end. Called by the damper,
//! once for each step of its own and as often as a drive takes.

use super::engine::Engine;
use super::state::Clock;
use crate::cavity::Cavity;
use crate::detector::Detector;
use crate::integrator::{Integrator, Stage};
use crate::law::{ContactLaw, LawKind};
use crate::mount::Mount;
use crate::observer::Observer;
use crate::step_error::StepError;

mod by_law;
mod system;

use by_law::{EvaluateForces, SolveImpulses};
use system::SteppedSystem;

impl<C: Cavity, L: ContactLaw, M: Mount + ?Sized, D: Detector> Engine<C, L, M, D> {
    /// Moves everything on by `dt` (s).
    pub(crate) fn step<I: Integrator + ?Sized, O: Observer>(
        &mut self,
        dt: f64,
        clock: &mut Clock,
        integrator: &mut I,
        observer: &mut O,
    ) -> Result<(), StepError> {
        self.state.begin_step(dt);
        self.state.check_passages()?;
        self.neighbours.sort_in_time(&mut self.state)?;
        self.solve_impulses(observer)?;
        // Asks to evaluate forces, once or more.
        integrator.step(&mut SteppedSystem::new(self, observer, clock), dt)?;
        self.state.end_step();
        self.state.rebase_mount();
        self.state.check_course()?;
        self.state.time = clock.advance(dt);
        Ok(())
    }

    /// Accelerations of the current state at `time`, `elapsed` after the contact history was advanced.
    pub(crate) fn evaluate<O: Observer>(
        &mut self,
        time: f64,
        elapsed: f64,
        stage: Stage,
        afresh: bool,
        observer: &mut O,
    ) -> Result<(), StepError> {
        self.state.place_containers(time)?;
        L::Kind::accept(EvaluateForces {
            engine: self,
            elapsed,
            stage,
            afresh,
            observer,
        })?;
        self.state.keep_mount_accelerations();
        self.state.accelerate_mount(time);
        Ok(())
    }

    /// Works out what holds over the step under an impulse law.
    fn solve_impulses<O: Observer>(&mut self, observer: &mut O) -> Result<(), StepError> {
        L::Kind::accept(SolveImpulses {
            engine: self,
            observer,
        })
    }
}
