//! The longest step that every part bears.

use super::{BuildError, StepBound};
use crate::contact::Body;
use crate::damper::state::{Coefficients, Particles};
use crate::error::Bound;
use crate::law::{ContactLaw, LawError};
use crate::mount::Mount;

/// Steps to a period of a mount's highest natural frequency: Verlet's method rings faster by a part
/// (2 pi/n)^2/24 of n steps to a period, 0.4 %.
const PER_PERIOD: f64 = 20.0;

/// Steps to the shortest feature of an excitation, which is half a period of a sine: as many as above.
const PER_FEATURE: f64 = 10.0;

/// A longest step (s), and what sets it.
pub(super) type Limit = (f64, Option<StepBound>);

/// The step that was `asked` for, or half of what contacts bear and no more than the mount and its excitation
/// do.
pub(super) fn choose_time_step(
    asked: Option<f64>,
    contacts: Limit,
    mount: &dyn Mount,
) -> Result<f64, BuildError> {
    let others = shorter(mount_bears(mount)?, excitation_bears(mount)?);
    if let Some(time_step) = asked {
        return match shorter(contacts, others) {
            (limit, Some(bound)) if time_step > limit => Err(BuildError::TimeStepTooLong {
                time_step,
                limit,
                bound,
            }),
            _ => Ok(time_step),
        };
    }
    let time_step = others.0.min(0.5 * contacts.0);
    if time_step.is_finite() {
        Ok(Bound::Positive.check("time step (s) from the limits of the parts", time_step)?)
    } else {
        Err(BuildError::NoTimeStep)
    }
}

/// What `law` bears of contacts; `wall` yields like the lightest container.
pub(super) fn contacts_bear<L: ContactLaw>(
    law: &L,
    coefficients: &Coefficients<L::Coefficients>,
    wall: Body,
    particles: &Particles,
) -> Result<Limit, LawError> {
    let (limit, kinds) = coefficients.time_step_limit(law, wall)?;
    let example = |kind: u32| {
        let mut indices = particles.species.iter().zip(&particles.id);
        indices.find_map(|(species, number)| (*species == kind).then_some(*number as usize))
    };
    let bound = kinds.and_then(|(kind, other)| {
        let particle = example(kind)?;
        Some(match other {
            // A kind may stand for a single particle.
            Some(other) => StepBound::Pair {
                first: particle,
                second: example(other)?,
            },
            None => StepBound::Wall { particle },
        })
    });
    Ok((limit, bound))
}

fn mount_bears(mount: &dyn Mount) -> Result<Limit, BuildError> {
    let quantity = "highest natural frequency of the mount (Hz)";
    let frequency = Bound::NonNegative.check(quantity, mount.highest_frequency())?;
    let bound = StepBound::NaturalFrequency { frequency };
    Ok((1.0 / (PER_PERIOD * frequency), Some(bound)))
}

fn excitation_bears(mount: &dyn Mount) -> Result<Limit, BuildError> {
    let duration = mount.shortest_feature();
    if duration < f64::INFINITY || duration.is_nan() {
        Bound::Positive.check("shortest feature of the excitation (s)", duration)?;
    }
    let bound = StepBound::Feature { duration };
    Ok((duration / PER_FEATURE, Some(bound)))
}

fn shorter(first: Limit, second: Limit) -> Limit {
    if second.0 < first.0 { second } else { first }
}
