//! What a step does in one way under a force law and in another under an impulse law.

use crate::cavity::Cavity;
use crate::damper::engine::Engine;
use crate::damper::parts::Parts;
use crate::damper::state::StepTime;
use crate::integrator::Stage;
use crate::law::{ContactLaw, ForceLaw, ImpulseLaw, LawVisitor};
use crate::step_error::StepError;

/// Forces of the current state: worked out anew under a force law, held under an impulse law.
pub(super) struct EvaluateForces<'a, 'p, C, L: ContactLaw> {
    pub(super) engine: &'a mut Engine<C, L>,
    pub(super) elapsed: f64,
    pub(super) stage: Stage,
    pub(super) afresh: bool,
    pub(super) parts: &'a mut Parts<'p>,
}

impl<C: Cavity, L: ContactLaw> LawVisitor<L> for EvaluateForces<'_, '_, C, L> {
    type Output = Result<(), StepError>;

    fn forces(self) -> Self::Output
    where
        L: ForceLaw,
    {
        let Engine {
            model,
            state,
            neighbours,
            forces,
            ..
        } = self.engine;
        let Parts {
            detectors,
            observer,
            ..
        } = self.parts;
        neighbours.find_contacts(model, state, *detectors, self.afresh)?;
        let predicted = self.stage == Stage::Predicted;
        let now = StepTime {
            elapsed: self.elapsed,
            correction: if predicted { 0.5 * self.elapsed } else { 0.0 },
            time_step: state.time_step,
        };
        let blocks = &mut neighbours.blocks;
        match self.stage {
            Stage::Trial => forces.evaluate::<C, false>(model, state, blocks, now, &mut ()),
            Stage::End | Stage::Predicted => {
                forces.evaluate::<C, true>(model, state, blocks, now, *observer)
            }
        }?;
        neighbours.check_overlaps(model, state)
    }

    fn impulses(self) -> Self::Output
    where
        L: ImpulseLaw,
    {
        Ok(())
    }
}

/// The impulses of a step, under a law that has such.
pub(super) struct SolveImpulses<'a, 'p, C, L: ContactLaw> {
    pub(super) engine: &'a mut Engine<C, L>,
    pub(super) parts: &'a mut Parts<'p>,
}

impl<C: Cavity, L: ContactLaw> LawVisitor<L> for SolveImpulses<'_, '_, C, L> {
    type Output = Result<(), StepError>;

    fn forces(self) -> Self::Output
    where
        L: ForceLaw,
    {
        self.engine.state.update_mobilities(self.parts.mount);
        Ok(())
    }

    fn impulses(self) -> Self::Output
    where
        L: ImpulseLaw,
    {
        let Engine {
            model,
            state,
            neighbours,
            impulses,
            ..
        } = self.engine;
        match impulses {
            Some(solver) => solver.solve(model, state, neighbours, self.parts),
            None => Ok(()),
        }
    }
}
