use super::{Columns, Integrator, Stage, System};
use crate::parallel::{update, update_by_two, update_two};
use crate::step_error::StepError;

/// Velocity Verlet (Swope et al. 1982, doi 10.1063/1.442716) with the velocity predicted for the
/// evaluation (Groot & Warren 1997, doi 10.1063/1.474784, with full prediction): second order, one
/// evaluation a step. The default.
///
/// x' = x + v dt + a dt^2/2; forces at x' and v + a dt; v' = v + (a + a') dt/2.
///
/// So whatever depends on velocities, friction and rolling resistance among it, sees positions, velocities
/// and spins of one time, the end of the step. The prediction is made with accelerations that are a step
/// old, and in an impact of six steps forces change by their whole size in three. Laws that would feel
/// it can therefore know by how much the prediction changes with their own force
/// ([`Contact::correction`](crate::Contact::correction), dt/2): the normal damping of the strict laws is
/// implicit in the contact's own force.
///
/// Second order holds where forces are smooth, dashpots included, and through impacts under the strict
/// laws, which make up for what a step misses where a contact sets in. (A force that starts like t^p,
/// unless its law does so, costs an error of order p + 1 once per contact.) At six steps to a contact the
/// restitution is right to 0.7 % on average; see [`guide::trust`](crate::guide::trust) for other steps.
#[derive(Debug, Clone, Copy, Default)]
pub struct VelocityVerlet;

/// Moves positions by the step, and predicts velocities.
fn predict(columns: Columns<'_>, dt: f64) {
    let Columns {
        position,
        velocity,
        acceleration,
        ..
    } = columns;
    if position.is_empty() {
        update(velocity, acceleration, |v, a| *v += a * dt);
        return;
    }
    let half = 0.5 * dt;
    update_two(position, velocity, acceleration, |x, v, a| {
        *x += (*v + a * half) * dt;
        *v += a * dt;
    });
}

/// Turns the predicted velocities into v + (a + a') dt/2.
fn correct(columns: Columns<'_>, dt: f64) {
    // Accelerations that hold over the step are one column: they were predicted right.
    if std::ptr::eq(columns.acceleration, columns.previous) {
        return;
    }
    let half = 0.5 * dt;
    update_by_two(
        columns.velocity,
        columns.acceleration,
        columns.previous,
        |v, new, old| {
            *v += (new - old) * half;
        },
    );
}

impl Integrator for VelocityVerlet {
    fn step(&mut self, system: &mut dyn System, time_step: f64) -> Result<(), StepError> {
        for columns in system.motions().all() {
            predict(columns, time_step);
        }
        system.evaluate(time_step, Stage::Predicted)?;
        for columns in system.motions().all() {
            correct(columns, time_step);
        }
        Ok(())
    }
}
