use super::fit::{DropFit, HeightFit, Interval, NUMBER, Peak};
use super::least_squares::{Solution, least_squares};
use super::{DropTest, DropTestError, check_times, trace};
use crate::error::Bound;

/// Parameters: time of the impact before the first flight, logarithm of the speed after it, damping number,
/// height of the floor, scale of heights.
const PARAMETERS: usize = 5;
/// Each flight gives a time and a height.
const LEAST_FLIGHTS: usize = 3;

impl DropTest {
    /// Fits a height trace: `heights` (m) of any point of the ball, from any level, at `times` (s). Each whole
    /// flight, from impact to impact, is fitted by a parabola; their peaks, in time and height, are then
    /// fitted together. What comes before the first impact is left out, so that it does not matter when the
    /// ball was let go.
    ///
    /// Heights need not be to scale: the [scale](HeightFit::scale) is found, from the times; so it tells what
    /// gravity is where heights are known to be right. Flights count as far as they stand out of the noise by
    /// ten of its standard deviations, and hold six samples. Noise is taken for independent from sample to
    /// sample. Under drag flights are not quite parabolas: up to a
    /// fiftieth of its effect on restitution is left.
    ///
    /// # Errors
    /// If there are fewer than 3 whole flights, a number is not finite, a time is not after the one before, or
    /// no bouncing ball fits the peaks.
    pub fn heights(&self, times: &[f64], heights: &[f64]) -> Result<HeightFit, DropTestError> {
        check_times(times)?;
        if times.len() != heights.len() {
            return Err(DropTestError::Lengths {
                times: times.len(),
                heights: heights.len(),
            });
        }
        for height in heights {
            Bound::Finite.check("height (m)", *height)?;
        }
        let peaks = if heights.len() < 4 {
            Vec::new()
        } else {
            trace::peaks(times, heights)
        };
        if peaks.len() < LEAST_FLIGHTS {
            return Err(DropTestError::TooFew {
                what: "whole flights",
                found: peaks.len(),
                least: LEAST_FLIGHTS,
            });
        }
        let fit = Peaks { test: self, peaks };
        let solution = fit.solve().ok_or(DropTestError::NoFit)?;
        fit.report(&solution)
    }
}

/// Peaks of a trace, to be fitted.
struct Peaks<'a> {
    test: &'a DropTest,
    peaks: Vec<trace::Peak>,
}

impl Peaks<'_> {
    /// Units of time (s) and height (m): the first flight's.
    fn units(&self) -> [f64; 2] {
        let interval = self.peaks[1].time - self.peaks[0].time;
        [interval, self.peaks[0].fall * interval * interval / 8.0]
    }

    /// Times and heights of the peaks of a bouncing ball.
    fn fitted(&self, parameters: &[f64; PARAMETERS]) -> impl Iterator<Item = [f64; 2]> {
        let [time, height] = self.units();
        let start = self.peaks[0].time + time * parameters[0];
        let speed = libm::exp(parameters[1]);
        let number = NUMBER * parameters[2];
        let (floor, scale) = (height * parameters[3], parameters[4]);
        let bounces = &self.test.bounces;
        let impacts = self.test.impacts(start, speed, number);
        let speeds = bounces.speeds(number, speed);
        let contact = self.test.contact_duration;
        impacts.zip(speeds).map(move |(impact, speed)| {
            let top = impact + contact + bounces.ascent(speed);
            [top, floor + scale * bounces.height(speed)]
        })
    }

    fn solve(&self) -> Option<Solution<PARAMETERS>> {
        let [interval, height] = self.units();
        // Tops follow each other by half of either flight, so that their intervals shrink as flights do.
        let restitution = (self.peaks[2].time - self.peaks[1].time) / interval;
        let flight = 2.0 * interval / (1.0 + restitution);
        let gravity = self.test.bounces.gravity;
        let start = [
            -0.5 * flight / interval,
            libm::log(0.5 * gravity * flight),
            self.test.number_of(restitution) / NUMBER,
            (self.peaks[0].height - self.peaks[0].fall * flight * flight / 8.0) / height,
            self.peaks[0].fall / gravity,
        ];
        least_squares(start, |parameters| {
            let fitted = self.peaks.iter().zip(self.fitted(parameters));
            let off = fitted.flat_map(|(peak, [time, height])| {
                [
                    (peak.time - time) / peak.time_error.max(1e-9 * interval),
                    (peak.height - height) / peak.height_error.max(1e-9 * peak.height.abs()),
                ]
            });
            off.collect()
        })
    }

    fn report(&self, solution: &Solution<PARAMETERS>) -> Result<HeightFit, DropTestError> {
        let degrees = solution.residuals.len() - PARAMETERS;
        // Residuals are in units of their errors. What exceeds these is a ball that is not quite the model's.
        let variance = solution.variance().unwrap_or_default().max(1.0);
        let interval = Interval::new(self.test.confidence, degrees, variance)?;
        let fitted = self.peaks.iter().zip(self.fitted(&solution.parameters));
        let peaks = fitted.map(|(peak, [time, height])| Peak {
            time,
            height,
            time_residual: peak.time - time,
            height_residual: peak.height - height,
        });
        Ok(HeightFit {
            contact: DropFit::new(self.test.bounces, solution, 2, &interval),
            peaks: peaks.collect(),
            floor: interval.of(solution, 3, self.units()[1]),
            scale: interval.of(solution, 4, 1.0),
        })
    }
}
