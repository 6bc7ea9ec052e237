//! What a step shows to an integrator.

use crate::cavity::Cavity;
use crate::damper::engine::Engine;
use crate::damper::parts::Parts;
use crate::damper::state::Clock;
use crate::integrator::{Columns, Motions, Stage, System};
use crate::law::{ContactLaw, LawKind};
use crate::step_error::StepError;

/// The engine in one step, as an integrator sees it.
pub(super) struct SteppedSystem<'a, 'p, C, L: ContactLaw> {
    engine: &'a mut Engine<C, L>,
    parts: &'a mut Parts<'p>,
    /// When the step began, s.
    begin: f64,
    /// Whether nothing has been evaluated in this step yet.
    fresh: bool,
}

impl<'a, 'p, C, L: ContactLaw> SteppedSystem<'a, 'p, C, L> {
    /// At the beginning of a step.
    pub(super) const fn new(
        engine: &'a mut Engine<C, L>,
        parts: &'a mut Parts<'p>,
        clock: &Clock,
    ) -> Self {
        Self {
            begin: clock.time(),
            engine,
            parts,
            fresh: true,
        }
    }
}

impl<C: Cavity, L: ContactLaw> System for SteppedSystem<'_, '_, C, L> {
    fn motions(&mut self) -> Motions<'_> {
        let state = &mut self.engine.state;
        let (particles, mount) = (&mut state.particles, &mut state.mount_coordinates);
        let [previous, turning] = if L::Kind::HELD {
            [&particles.acceleration, &particles.angular_acceleration]
        } else {
            state.previous.particles.each_ref()
        };
        Motions {
            translation: Columns {
                position: particles.position.flat_mut(),
                velocity: particles.velocity.flat_mut(),
                acceleration: particles.acceleration.flat(),
                previous: previous.flat(),
            },
            rotation: Columns {
                position: &mut [],
                velocity: particles.spin.flat_mut(),
                acceleration: particles.angular_acceleration.flat(),
                previous: turning.flat(),
            },
            mount: Columns {
                position: &mut mount.position,
                velocity: &mut mount.velocity,
                acceleration: &mount.acceleration,
                previous: &state.previous.mount,
            },
        }
    }

    fn evaluate(&mut self, elapsed: f64, stage: Stage) -> Result<(), StepError> {
        let afresh = std::mem::take(&mut self.fresh);
        let time = self.begin + elapsed;
        self.engine
            .evaluate(time, elapsed, stage, afresh, self.parts)
    }
}
