//! A step of an engine, as an integrator sees it.

use crate::cavity::Cavity;
use crate::damper::engine::Engine;
use crate::detector::Detector;
use crate::integrator::{Columns, Motions, Stage, System};
use crate::law::{ContactLaw, LawKind};
use crate::mount::Mount;
use crate::observer::Observer;
use crate::step_error::StepError;

/// One step of an engine, as an integrator sees it.
pub(crate) struct Step<'a, C, L: ContactLaw, M, D, O> {
    pub(crate) engine: &'a mut Engine<C, L, M, D>,
    pub(crate) observer: &'a mut O,
    pub(crate) begin: f64,
    /// Whether nothing has been evaluated in this step yet.
    pub(crate) fresh: bool,
}

impl<C, L, M, D, O> System for Step<'_, C, L, M, D, O>
where
    C: Cavity,
    L: ContactLaw,
    M: Mount,
    D: Detector,
    O: Observer,
{
    fn motions(&mut self) -> Motions<'_> {
        let particles = &mut self.engine.particles;
        let mount = &mut self.engine.mount_state;
        let scratch = &self.engine.scratch;
        let [previous, turning] = if L::Kind::HELD {
            [&particles.acceleration, &particles.angular_acceleration]
        } else {
            scratch.previous.each_ref()
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
                previous: &scratch.previous_of_mount,
            },
        }
    }

    fn evaluate(&mut self, elapsed: f64, stage: Stage) -> Result<(), StepError> {
        let afresh = std::mem::take(&mut self.fresh);
        let time = self.begin + elapsed;
        self.engine
            .evaluate(time, elapsed, stage, afresh, self.observer)
    }
}
