//! A step: the stages in their order.
//!
//! In: the state at its start, an integrator, and who watches. Out: the state at its end. Called by the damper,
//! once for each step of its own and as often as a drive takes.

use super::engine::Engine;
use super::state::{Clock, StepTime};
use crate::cavity::Cavity;
use crate::detector::Detector;
use crate::integrator::{Integrator, Stage};
use crate::law::{ContactLaw, ForceLaw, ImpulseLaw, LawKind, LawVisitor};
use crate::mount::Mount;
use crate::observer::{Observer, StepReport};
use crate::step_error::StepError;

mod system;

use system::SteppedSystem;

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Moves everything on by `dt` (s).
    pub(crate) fn step<I: Integrator, O: Observer>(
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
        observer.step(&StepReport::new(self.state.time, dt, self));
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

/// Forces of the current state: worked out anew under a force law, held under an impulse law.
struct EvaluateForces<'a, E, O> {
    engine: &'a mut E,
    elapsed: f64,
    stage: Stage,
    afresh: bool,
    observer: &'a mut O,
}

impl<C, L, M, D, O> LawVisitor<L> for EvaluateForces<'_, Engine<C, L, M, D>, O>
where
    C: Cavity,
    L: ContactLaw,
    M: Mount,
    D: Detector,
    O: Observer,
{
    type Output = Result<(), StepError>;

    fn forces(self) -> Self::Output
    where
        L: ForceLaw,
    {
        let Engine {
            state,
            neighbours,
            forces,
            ..
        } = self.engine;
        neighbours.find_contacts(state, self.afresh)?;
        let predicted = self.stage == Stage::Predicted;
        let now = StepTime {
            elapsed: self.elapsed,
            correction: if predicted { 0.5 * self.elapsed } else { 0.0 },
            time_step: state.time_step,
        };
        let blocks = &mut neighbours.blocks;
        match self.stage {
            Stage::Trial => forces.evaluate::<C, M, (), false>(state, blocks, now, &mut ()),
            Stage::End | Stage::Predicted => {
                forces.evaluate::<C, M, O, true>(state, blocks, now, self.observer)
            }
        }?;
        neighbours.check_overlaps(state)
    }

    fn impulses(self) -> Self::Output
    where
        L: ImpulseLaw,
    {
        Ok(())
    }
}

/// The impulses of a step, under a law that has such.
struct SolveImpulses<'a, E, O> {
    engine: &'a mut E,
    observer: &'a mut O,
}

impl<C, L, M, D, O> LawVisitor<L> for SolveImpulses<'_, Engine<C, L, M, D>, O>
where
    C: Cavity,
    L: ContactLaw,
    M: Mount,
    D: Detector,
    O: Observer,
{
    type Output = Result<(), StepError>;

    fn forces(self) -> Self::Output
    where
        L: ForceLaw,
    {
        self.engine.state.update_mobilities();
        Ok(())
    }

    fn impulses(self) -> Self::Output
    where
        L: ImpulseLaw,
    {
        let engine = self.engine;
        match &mut engine.impulses {
            Some(solver) => solver.solve(&mut engine.state, &mut engine.neighbours, self.observer),
            None => Ok(()),
        }
    }
}
