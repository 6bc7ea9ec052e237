//! Simulated time.

use crate::digest::Digest;

/// What the times of a host may be off by, s: those of an interval that ends within 1e7 s of the origin
/// are each rounded by 0.93e-9 s.
const ROUNDING: f64 = 2e-9;

/// The largest part of a step that passes for rounding: what steps differ by, it can be no matter of accuracy.
const SLACK: f64 = 0.01;

/// Counts equal steps, so that time does not gather rounding errors.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Clock {
    epoch: f64,
    steps: u64,
    step: f64,
    /// How far a host's time is ahead of this one, s: rounding, which whole steps leave out.
    ahead: f64,
}

/// How an interval is cut into steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Substeps {
    /// How many steps there are.
    pub(crate) steps: u64,
    /// Length of each in s.
    pub(crate) step: f64,
}

impl Clock {
    /// A clock that shows `time` (s).
    pub(crate) const fn showing(time: f64) -> Self {
        Self {
            epoch: time,
            steps: 0,
            step: 0.0,
            ahead: 0.0,
        }
    }

    pub(crate) const fn time(&self) -> f64 {
        self.epoch + self.steps as f64 * self.step
    }

    /// The time of the host that drives, s.
    pub(crate) const fn host_time(&self) -> f64 {
        self.time() + self.ahead
    }

    /// Whether a clock can show this.
    pub(crate) const fn is_sound(&self) -> bool {
        // Beyond 2^53 steps the count would no longer be exact.
        self.steps < 1 << 53
            && self.time().is_finite()
            && self.step >= 0.0
            && self.ahead.abs() <= 1.0
    }

    /// Adds all that it shows.
    pub(crate) fn add_to(&self, digest: &mut Digest) {
        digest.numbers(&[self.epoch, self.step, self.ahead]);
        digest.word(self.steps);
    }

    /// Goes on by a step (s), and returns the time.
    pub(crate) const fn advance(&mut self, step: f64) -> f64 {
        if step.to_bits() == self.step.to_bits() {
            self.steps += 1;
        } else {
            self.epoch = self.time();
            self.steps = 1;
            self.step = step;
        }
        self.time()
    }

    /// Cuts a host's `interval` (s) into steps of `longest` (s) or less.
    ///
    /// An interval that differs from so many longest steps by no more than the host's times are rounded
    /// becomes just those: their number and their length do not depend on when it begins. What is left
    /// out is kept, and made up for before it adds up.
    pub(crate) fn cut(&mut self, interval: f64, longest: f64) -> Substeps {
        // Of a long interval its own rounding counts, too.
        let slack = ROUNDING.min(SLACK * longest).max(1e-12 * interval);
        let steps = ((interval - slack) / longest).ceil().max(1.0);
        let whole = steps * longest;
        let due = interval + self.ahead;
        let (step, left) = if (interval - whole).abs() <= slack && (due - whole).abs() <= slack {
            (longest, due - whole)
        } else if due > 0.5 * interval {
            (due / steps, 0.0)
        } else {
            (interval / steps, self.ahead)
        };
        self.ahead = left;
        Substeps {
            steps: steps as u64,
            step,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cuts intervals of `interval` as they come out of a host's times from `begin` on, which are worked
    /// out by `time`.
    fn cuts(begin: f64, interval: f64, longest: f64, time: impl Fn(f64, u32) -> f64) {
        let mut clock = Clock::showing(begin);
        let expected = (interval / longest).round();
        let mut from = begin;
        for call in 1..=20_000 {
            let to = time(from, call);
            let cut = clock.cut(to - from, longest);
            assert_eq!(cut.steps, expected as u64, "from {from} to {to}");
            assert!(cut.step <= longest * (1.0 + SLACK));
            for _ in 0..cut.steps {
                clock.advance(cut.step);
            }
            from = to;
            let off = (clock.host_time() - to).abs();
            assert!(off <= 1e-8, "{off} off at {to}");
        }
    }

    #[test]
    fn the_number_of_steps_does_not_depend_on_when_an_interval_begins() {
        for begin in [0.0, 10.0, 86_400.0, 1e7 - 50.0] {
            for (interval, longest) in [(1e-3, 1e-4), (1e-3, 1e-3), (2e-3, 2e-5), (3e-4, 1e-4)] {
                cuts(begin, interval, longest, |_, call| {
                    begin + f64::from(call) * interval
                });
                cuts(begin, interval, longest, |from, _| from + interval);
            }
        }
    }

    #[test]
    fn an_interval_that_is_no_multiple_is_cut_evenly() {
        let mut clock = Clock::default();
        let cut = clock.cut(2.7e-4, 1e-4);
        assert_eq!(cut.steps, 3);
        assert!((cut.step - 0.9e-4).abs() < 1e-18);
        // A hair is not taken for rounding where it could be seen.
        assert_eq!(clock.cut(3.0001e-4, 1e-4).steps, 4);
        assert_eq!(clock.cut(1e-10, 1e-4).steps, 1);
    }
}
