use super::fit::{DropFit, Impact, Interval, NUMBER};
use super::least_squares::{Solution, least_squares};
use super::{DropTest, DropTestError, check_times};

/// Parameters: time of the first impact, logarithm of the speed after it, damping number.
const PARAMETERS: usize = 3;

/// Time (s), speed (m/s) and number from what is fitted.
fn meaning(parameters: &[f64; PARAMETERS], times: &[f64]) -> [f64; PARAMETERS] {
    let unit = times[1] - times[0];
    let start = times[0] + unit * parameters[0];
    [start, libm::exp(parameters[1]), NUMBER * parameters[2]]
}

impl DropTest {
    /// Fits the times (s) at which impacts begin, in their order, none left out. Whether the first of them is
    /// the first of the ball does not matter.
    ///
    /// # Errors
    /// If there are fewer than 4 times, one is not finite or not after the one before, or no bouncing ball
    /// fits them.
    pub fn times(&self, times: &[f64]) -> Result<DropFit, DropTestError> {
        check_times(times)?;
        let least = PARAMETERS + 1;
        if times.len() < least {
            return Err(DropTestError::TooFew {
                what: "impacts",
                found: times.len(),
                least,
            });
        }
        let solution = self.fit_times(times).ok_or(DropTestError::NoFit)?;
        let degrees = times.len() - PARAMETERS;
        // In units of the first interval.
        let variance = solution.variance().unwrap_or_default();
        let interval = Interval::new(self.confidence, degrees, variance)?;
        let mut fit = DropFit::new(self.bounces, &solution, 2, &interval);
        let unit = times[1] - times[0];
        let [start, speed, number] = meaning(&solution.parameters, times);
        let speeds = self.bounces.speeds(number, speed);
        let fitted = self.impacts(start, speed, number);
        let residuals = solution.residuals.iter().map(|residual| residual * unit);
        fit.impacts = fitted
            .zip(speeds)
            .zip(residuals)
            .map(|((time, speed), residual)| Impact {
                time,
                speed,
                residual,
            })
            .collect();
        Ok(fit)
    }

    /// Times (s) of impacts from `start` on, after the first of which the ball rises at `speed` (m/s).
    pub(super) fn impacts(&self, start: f64, speed: f64, number: f64) -> impl Iterator<Item = f64> {
        let flights = self.bounces.speeds(number, speed);
        let next = move |time: &mut f64, speed: f64| {
            let now = *time;
            *time += self.contact_duration + self.bounces.flight(speed);
            Some(now)
        };
        flights.scan(start, next)
    }

    fn fit_times(&self, times: &[f64]) -> Option<Solution<PARAMETERS>> {
        let (unit, last) = (times[1] - times[0], times.len() - 1);
        // Of a geometric series, what is left without its first term over what is left without its last.
        let restitution = (times[last] - times[1]) / (times[last - 1] - times[0]);
        let number = self.number_of(restitution);
        let flight = (unit - self.contact_duration).max(0.1 * unit);
        let speed = 0.5 * self.bounces.gravity * flight;
        least_squares([0.0, libm::log(speed), number / NUMBER], |parameters| {
            let [start, speed, number] = meaning(parameters, times);
            let fitted = self.impacts(start, speed, number);
            let measured = times.iter().zip(fitted);
            measured
                .map(|(time, fitted)| (time - fitted) / unit)
                .collect()
        })
    }

    /// About the damping number of a restitution, to start from.
    pub(super) fn number_of(&self, restitution: f64) -> f64 {
        let restitution = if restitution.is_finite() {
            restitution.clamp(0.05, 0.999)
        } else {
            0.5
        };
        let number = self
            .bounces
            .damping
            .number(restitution, self.bounces.ending);
        number.unwrap_or(NUMBER)
    }
}
