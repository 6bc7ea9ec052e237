//! A comparison with a known answer.

use std::fmt;

/// How near is near enough.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Tolerance {
    /// In the unit of the quantity.
    Absolute(f64),
    /// As a fraction of the expected value.
    Relative(f64),
    /// The expected value is an upper bound.
    AtMost,
}

/// One quantity: what theory, a paper or a measurement says, and what the crate gives.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) source: &'static str,
    pub(crate) expected: f64,
    pub(crate) got: f64,
    pub(crate) tolerance: Tolerance,
}

impl Case {
    pub(crate) fn new(
        name: impl Into<String>,
        source: &'static str,
        expected: f64,
        got: f64,
        tolerance: Tolerance,
    ) -> Self {
        Self {
            name: name.into(),
            source,
            expected,
            got,
            tolerance,
        }
    }

    /// A quantity that must not exceed `bound`.
    pub(crate) fn bounded(
        name: impl Into<String>,
        source: &'static str,
        bound: f64,
        got: f64,
    ) -> Self {
        Self::new(name, source, bound, got, Tolerance::AtMost)
    }

    /// Difference to the expected value, relative to it where the tolerance is.
    pub(crate) fn deviation(&self) -> f64 {
        let difference = self.got - self.expected;
        match self.tolerance {
            Tolerance::Relative(_) => difference / self.expected.abs(),
            Tolerance::Absolute(_) | Tolerance::AtMost => difference,
        }
    }

    /// Whether the case holds. NaN never does.
    pub(crate) fn holds(&self) -> bool {
        match self.tolerance {
            Tolerance::Absolute(bound) | Tolerance::Relative(bound) => {
                self.deviation().abs() <= bound
            }
            Tolerance::AtMost => self.got <= self.expected,
        }
    }

    /// Whether it holds, in a word.
    pub(crate) fn verdict(&self) -> &'static str {
        if self.holds() { "holds" } else { "FAILS" }
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            name,
            source,
            expected,
            got,
            ..
        } = self;
        let (deviation, tolerance) = (self.deviation(), self.tolerance);
        let verdict = self.verdict();
        write!(
            f,
            "{name} [{source}]: expected {expected:.7e}, got {got:.7e}, deviation {deviation:.2e}, {tolerance:?}: {verdict}"
        )
    }
}
