//! The powers of time that forces set in with, as evaluations a step apart see them: see [`onset`](super::onset).

/// Exponents of time that forces set in with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Exponent {
    Quarter,
    Half,
    ThreeHalves,
}

impl Exponent {
    /// Exponent p, and p (p-1) (p-2)/720.
    #[inline]
    const fn constants(self) -> (f64, f64) {
        match self {
            Self::Quarter => (0.25, 0.328_125 / 720.0),
            Self::Half => (0.5, 0.375 / 720.0),
            Self::ThreeHalves => (1.5, -0.375 / 720.0),
        }
    }

    #[inline]
    pub(super) fn of(self, base: f64) -> f64 {
        let root = base.sqrt();
        match self {
            Self::Quarter => root.sqrt(),
            Self::Half => root,
            Self::ThreeHalves => base * root,
        }
    }

    /// What the evaluation at `part` of a step (0 to 1) after the touch has to give for t^p, t in
    /// steps: -zeta(-p, 1 + part), by Euler and Maclaurin to four digits or better.
    #[inline]
    pub(super) fn sampled(self, part: f64) -> f64 {
        let (p, third) = self.constants();
        let x = 1.0 + part;
        let inverse = 1.0 / x;
        let cube = inverse * inverse * inverse;
        self.of(x) * (x / (p + 1.0) - 0.5 + p / 12.0 * inverse - third * cube)
    }
}
