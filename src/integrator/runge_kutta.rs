use super::{Columns, Integrator, Stage, System};
use crate::parallel::{update, update_by_two};
use crate::step_error::StepError;

/// The classical Runge-Kutta method of fourth order (the paper's): four evaluations a step, the
/// last of which serves as the next step's first.
///
/// Fourth order holds for mounts, free flight and contacts that last. An impact is of second order, as
/// under [`VelocityVerlet`](super::VelocityVerlet), with a half of its error at 100 steps to a contact
/// but more at coarse ones: at six the mean restitution is up to 0.016 too low here, 0.003 too high there.
#[derive(Debug, Clone, Default)]
pub struct RungeKutta4 {
    groups: [Tableau; 3],
}

/// Of a group of coordinates, positions and velocities at the start of a step, and the weighted sums
/// of the slopes.
#[derive(Debug, Clone, Default)]
struct Tableau {
    position: Weighted,
    velocity: Weighted,
}

/// A column at the start of a step, and the weighted sum of its slopes.
#[derive(Debug, Clone, Default)]
struct Weighted {
    start: Vec<f64>,
    sum: Vec<f64>,
}

impl Weighted {
    fn begin(&mut self, column: &[f64]) {
        self.start.clear();
        self.start.extend_from_slice(column);
        self.sum.clear();
        self.sum.resize(column.len(), 0.0);
    }

    /// Adds `slope` with `weight`, and moves the column on by `reach` from the start along it.
    fn stage(&mut self, column: &mut [f64], slope: &[f64], weight: f64, reach: f64) {
        update(&mut self.sum, slope, |sum, slope| *sum += slope * weight);
        update_by_two(column, &self.start, slope, |value, start, slope| {
            *value = start + slope * reach;
        });
    }

    /// Adds the last `slope`, and moves the column from the start along the sum.
    fn finish(&self, column: &mut [f64], slope: &[f64], weight: f64) {
        update_by_two(column, &self.start, &self.sum, |value, start, sum| {
            *value = start + sum;
        });
        update(column, slope, |value, slope| *value += slope * weight);
    }
}

impl Tableau {
    fn begin(&mut self, columns: &Columns<'_>) {
        self.position.begin(columns.position);
        self.velocity.begin(columns.velocity);
    }

    fn stage(&mut self, columns: Columns<'_>, weight: f64, reach: f64) {
        let Columns {
            position,
            velocity,
            acceleration,
            ..
        } = columns;
        self.position.stage(position, velocity, weight, reach);
        self.velocity.stage(velocity, acceleration, weight, reach);
    }

    fn finish(&self, columns: Columns<'_>, weight: f64) {
        let Columns {
            position,
            velocity,
            acceleration,
            ..
        } = columns;
        self.position.finish(position, velocity, weight);
        self.velocity.finish(velocity, acceleration, weight);
    }
}

impl Integrator for RungeKutta4 {
    fn step(&mut self, system: &mut dyn System, time_step: f64) -> Result<(), StepError> {
        let groups = &mut self.groups;
        for (tableau, columns) in groups.iter_mut().zip(system.motions().all()) {
            tableau.begin(&columns);
        }
        let (sixth, third, half) = (time_step / 6.0, time_step / 3.0, time_step / 2.0);
        for (weight, reach) in [(sixth, half), (third, half), (third, time_step)] {
            for (tableau, columns) in groups.iter_mut().zip(system.motions().all()) {
                tableau.stage(columns, weight, reach);
            }
            system.evaluate(reach, Stage::Trial)?;
        }
        for (tableau, columns) in groups.iter_mut().zip(system.motions().all()) {
            tableau.finish(columns, sixth);
        }
        system.evaluate(time_step, Stage::End)
    }
}
