//! The peaks of a height trace, by parabolas.

use super::least_squares::least_squares;

/// The fewest samples that a flight is fitted to.
const FEWEST: usize = 6;
/// Of a flight, the part about its peak that is fitted: contacts at its ends are left out.
const FITTED: f64 = 0.9;
/// A flight stands out of the noise by this many of its standard deviations.
const STANDS_OUT: f64 = 10.0;

/// Where a flight is highest, with standard errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Peak {
    /// s.
    pub(super) time: f64,
    /// m.
    pub(super) height: f64,
    pub(super) time_error: f64,
    pub(super) height_error: f64,
    /// Acceleration downwards in m/s^2.
    pub(super) fall: f64,
}

/// A parabola a + b t + c t^2 about the middle of its samples.
struct Parabola {
    middle: f64,
    coefficients: [f64; 3],
    covariance: [[f64; 3]; 3],
    squares: f64,
    samples: usize,
}

impl Parabola {
    fn through(times: &[f64], heights: &[f64]) -> Option<Self> {
        let middle = 0.5 * (times.first()? + times.last()?);
        let half = 0.5 * (times.last()? - times.first()?);
        // Parameters of the size of the flight: as time counts in halves of it.
        let fit = least_squares([0.0; 3], |p: &[f64; 3]| {
            let off = |(t, h): (&f64, &f64)| {
                let s = (t - middle) / half;
                p[0] + s * (p[1] + s * p[2]) - h
            };
            times.iter().zip(heights).map(off).collect()
        })?;
        let scale = [1.0, 1.0 / half, 1.0 / (half * half)];
        let covariance = std::array::from_fn(|row| {
            std::array::from_fn(|k| fit.covariance[row][k] * scale[row] * scale[k])
        });
        Some(Self {
            middle,
            coefficients: std::array::from_fn(|k| fit.parameters[k] * scale[k]),
            covariance,
            squares: fit.residuals.iter().map(|off| off * off).sum(),
            samples: times.len(),
        })
    }

    /// Where it is highest, if it is so anywhere, for noise of one unit.
    fn peak(&self) -> Option<Peak> {
        let [a, b, c] = self.coefficients;
        if c >= 0.0 {
            return None;
        }
        let error = |slopes: [f64; 3]| {
            let mut variance = 0.0;
            for (row, slope) in slopes.iter().enumerate() {
                for (k, other) in slopes.iter().enumerate() {
                    variance += slope * other * self.covariance[row][k];
                }
            }
            variance.max(0.0).sqrt()
        };
        let part = b / (2.0 * c);
        Some(Peak {
            time: self.middle - part,
            height: a - part * part * c,
            time_error: error([0.0, 0.5 / c, -part / c]),
            height_error: error([1.0, -part, part * part]),
            fall: -2.0 * c,
        })
    }
}

/// Standard deviation of the noise, from third differences: those of parabolas vanish. The median does not
/// heed impacts.
fn noise(heights: &[f64]) -> f64 {
    let mut third: Vec<f64> = heights
        .windows(4)
        .map(|h| (h[3] - 3.0 * h[2] + 3.0 * h[1] - h[0]).abs())
        .collect();
    third.sort_by(f64::total_cmp);
    let median = third.get(third.len() / 2).copied().unwrap_or_default();
    median / (0.674_49 * 20.0_f64.sqrt())
}

/// The samples at which the ball is lowest between flights that stand out by `least`: a low is passed once
/// the height has risen that far, a peak once it has fallen that far.
fn lows(heights: &[f64], least: f64) -> Vec<usize> {
    let mut lows = Vec::new();
    let (mut lowest, mut highest, mut falling) = (0, 0, true);
    for (now, height) in heights.iter().enumerate() {
        if falling {
            if *height < heights[lowest] {
                lowest = now;
            }
            if height - heights[lowest] > least {
                lows.push(lowest);
                (highest, falling) = (now, false);
            }
        } else {
            if *height > heights[highest] {
                highest = now;
            }
            if heights[highest] - height > least {
                (lowest, falling) = (now, true);
            }
        }
    }
    if falling && !lows.is_empty() {
        // Flights too low to be told apart follow: the last one that counts ends where it comes down to them.
        let down = |n: &usize| heights[*n] - heights[lowest] < least;
        lows.extend((highest..heights.len()).find(down));
    }
    lows
}

/// The parabola of the flight between two lows.
fn flight(times: &[f64], heights: &[f64], [from, to]: [usize; 2]) -> Option<Parabola> {
    let floor = 0.5 * (heights[from] + heights[to]);
    let top = heights[from..to].iter().fold(floor, |top, h| top.max(*h));
    // First by height, which picks among noisy samples; then by time, which does not.
    let above = |n: &usize| heights[*n] > floor + 0.2 * (top - floor);
    let first = (from + 1..to).find(above)?;
    let last = (from + 1..to).rev().find(above)?;
    let fit = |first: usize, last: usize| {
        (last + 1 >= first + FEWEST)
            .then(|| Parabola::through(&times[first..=last], &heights[first..=last]))?
    };
    let rough = fit(first, last)?.peak()?;
    let half = FITTED * (2.0 * (rough.height - floor) / rough.fall).max(0.0).sqrt();
    let near = |n: &usize| (times[*n] - rough.time).abs() <= half;
    fit((from + 1..to).find(near)?, (from + 1..to).rev().find(near)?)
}

/// The peaks of the whole flights of a trace, from the first on, as far as they stand out of the noise and
/// hold samples enough.
pub(super) fn peaks(times: &[f64], heights: &[f64]) -> Vec<Peak> {
    let range = |pick: fn(f64, f64) -> f64| heights.iter().copied().fold(heights[0], pick);
    let least = (STANDS_OUT * noise(heights)).max(1e-3 * (range(f64::max) - range(f64::min)));
    let lows = lows(heights, least);
    let flights: Vec<Parabola> = lows
        .windows(2)
        .map_while(|pair| flight(times, heights, [pair[0], pair[1]]))
        .collect();
    let squares: f64 = flights.iter().map(|flight| flight.squares).sum();
    let left: usize = flights.iter().map(|flight| flight.samples - 3).sum();
    let deviation = (squares / left.max(1) as f64).sqrt();
    flights
        .iter()
        .map_while(Parabola::peak)
        .map(|peak| Peak {
            time_error: peak.time_error * deviation,
            height_error: peak.height_error * deviation,
            ..peak
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A trace of a ball let go at 0.2 m, restitution 0.6, at 1 ms, 2 mm above zero.
    fn trace() -> (Vec<f64>, Vec<f64>, Vec<[f64; 2]>) {
        let (g, floor) = (9.81_f64, 2e-3);
        let mut impacts = vec![(2.0 * 0.2 / g).sqrt()];
        let mut speeds = vec![0.6 * (2.0 * g * 0.2_f64).sqrt()];
        for n in 0..8 {
            impacts.push(impacts[n] + 2.0 * speeds[n] / g);
            speeds.push(0.6 * speeds[n]);
        }
        let times: Vec<f64> = (0..1000).map(|n| f64::from(n) * 1e-3).collect();
        let height = |t: &f64| {
            let Some(n) = impacts.iter().rposition(|impact| impact <= t) else {
                return floor + 0.2 - 0.5 * g * t * t;
            };
            let since = t - impacts[n];
            floor + since * (speeds[n] - 0.5 * g * since).max(0.0)
        };
        let heights = times.iter().map(height).collect();
        let tops = speeds.iter().zip(&impacts);
        let tops = tops.map(|(v, t)| [t + v / g, floor + 0.5 * v * v / g]);
        (times, heights, tops.collect())
    }

    #[test]
    fn peaks_of_a_clean_trace_are_exact() {
        let (times, heights, tops) = trace();
        let found = peaks(&times, &heights);
        assert!(found.len() >= 4, "{}", found.len());
        for (peak, [time, height]) in found.iter().zip(&tops) {
            assert!((peak.time - time).abs() < 1e-9, "{peak:?}");
            assert!((peak.height - height).abs() < 1e-9, "{peak:?}");
            assert!((peak.fall - 9.81).abs() < 1e-5, "{peak:?}");
        }
    }

    #[test]
    fn standard_errors_are_those_of_the_noise() {
        let (times, heights, tops) = trace();
        let mut random = crate::random::Random::new(3);
        let sigma = 0.5e-3;
        let (mut squares, mut count) = ([0.0; 2], 0.0);
        for _ in 0..60 {
            let noisy: Vec<f64> = heights
                .iter()
                .map(|h| h + sigma * 3.0_f64.sqrt() * random.symmetric())
                .collect();
            let found = peaks(&times, &noisy);
            assert!(found.len() >= 2, "{}", found.len());
            for (peak, [time, height]) in found.iter().zip(&tops).take(2) {
                squares[0] += ((peak.time - time) / peak.time_error).powi(2);
                squares[1] += ((peak.height - height) / peak.height_error).powi(2);
                count += 1.0;
            }
        }
        for square in squares {
            assert!((0.7..1.4).contains(&(square / count)), "{}", square / count);
        }
    }
}
