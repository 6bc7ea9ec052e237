//! What a step does in one way under a force law and in another under an impulse law.

use crate::cavity::Cavity;
use crate::damper::engine::Engine;
use crate::damper::state::StepTime;
use crate::detector::Detector;
use crate::integrator::Stage;
use crate::law::{ContactLaw, ForceLaw, ImpulseLaw, LawVisitor};
use crate::mount::Mount;
use crate::observer::Observer;
use crate::step_error::StepError;

/// Forces of the current state: worked out anew under a force law, held under an impulse law.
pub(super) struct EvaluateForces<'a, C, L: ContactLaw, M: ?Sized, D, O> {
    pub(super) engine: &'a mut Engine<C, L, M, D>,
    pub(super) elapsed: f64,
    pub(super) stage: Stage,
    pub(super) afresh: bool,
    pub(super) observer: &'a mut O,
}

impl<C, L, M, D, O> LawVisitor<L> for EvaluateForces<'_, C, L, M, D, O>
where
    C: Cavity,
    L: ContactLaw,
    M: Mount + ?Sized,
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
pub(super) struct SolveImpulses<'a, C, L: ContactLaw, M: ?Sized, D, O> {
    pub(super) engine: &'a mut Engine<C, L, M, D>,
    pub(super) observer: &'a mut O,
}

impl<C, L, M, D, O> LawVisitor<L> for SolveImpulses<'_, C, L, M, D, O>
where
    C: Cavity,
    L: ContactLaw,
    M: Mount + ?Sized,
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
