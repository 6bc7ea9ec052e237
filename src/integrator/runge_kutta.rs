use glam::DVec3;

use super::{Columns, Coordinate, Integrator, Motions, Stage, System};
use crate::damper::StepError;

/// The classical Runge-Kutta method of fourth order (the paper's): four evaluations a step, the
/// last of which serves as the next step's first.
///
/// Fourth order holds for mounts, free flight and contacts that last. An impact loses it where it sets
/// in, as under [`VelocityVerlet`](super::VelocityVerlet): to 5/2 in an elastic Hertz contact, 3/2 with
/// d^(1/2) damping, 5/4 with d^(1/4) damping.
#[derive(Debug, Clone, Default)]
pub struct RungeKutta4 {
    translation: Tableau<DVec3>,
    rotation: Tableau<DVec3>,
    mount: Tableau<f64>,
}

/// Start of the step, and the weighted sums of the stages' velocities and accelerations.
#[derive(Debug, Clone, Default)]
struct Tableau<T> {
    start: Vec<[T; 2]>,
    sums: Vec<[T; 2]>,
}

impl<T: Coordinate> Tableau<T> {
    fn begin(&mut self, columns: &Columns<'_, T>) {
        let position = columns.position.iter().copied();
        let position = position.chain(std::iter::repeat(T::default()));
        self.start.clear();
        self.start.extend(
            position
                .zip(columns.velocity.iter().copied())
                .map(<[T; 2]>::from),
        );
        self.sums.clear();
        self.sums.resize(self.start.len(), [T::default(); 2]);
    }

    /// Adds the stage just evaluated with `weight` to the sums, and moves on by `reach` from the
    /// start along its slope.
    fn stage(&mut self, columns: Columns<'_, T>, weight: f64, reach: f64) {
        for (n, (v, a)) in columns
            .velocity
            .iter_mut()
            .zip(columns.acceleration)
            .enumerate()
        {
            let [x0, v0] = self.start[n];
            let [sum_v, sum_a] = &mut self.sums[n];
            *sum_v = *sum_v + *v * weight;
            *sum_a = *sum_a + *a * weight;
            if let Some(x) = columns.position.get_mut(n) {
                *x = x0 + *v * reach;
            }
            *v = v0 + *a * reach;
        }
    }

    /// Adds the last stage, and moves from the start along the weighted slopes.
    fn finish(&self, columns: Columns<'_, T>, weight: f64) {
        for (n, (v, a)) in columns
            .velocity
            .iter_mut()
            .zip(columns.acceleration)
            .enumerate()
        {
            let [x0, v0] = self.start[n];
            let [sum_v, sum_a] = self.sums[n];
            if let Some(x) = columns.position.get_mut(n) {
                *x = x0 + sum_v + *v * weight;
            }
            *v = v0 + sum_a + *a * weight;
        }
    }
}

impl Integrator for RungeKutta4 {
    fn step<S: System>(&mut self, system: &mut S, time_step: f64) -> Result<(), StepError> {
        let motions = system.motions();
        self.translation.begin(&motions.translation);
        self.rotation.begin(&motions.rotation);
        self.mount.begin(&motions.mount);

        let (sixth, third, half) = (time_step / 6.0, time_step / 3.0, time_step / 2.0);
        for (weight, reach) in [(sixth, half), (third, half), (third, time_step)] {
            let Motions {
                translation,
                rotation,
                mount,
            } = system.motions();
            self.translation.stage(translation, weight, reach);
            self.rotation.stage(rotation, weight, reach);
            self.mount.stage(mount, weight, reach);
            system.evaluate(reach, Stage::Trial)?;
        }

        let Motions {
            translation,
            rotation,
            mount,
        } = system.motions();
        self.translation.finish(translation, sixth);
        self.rotation.finish(rotation, sixth);
        self.mount.finish(mount, sixth);
        system.evaluate(time_step, Stage::End)
    }
}
