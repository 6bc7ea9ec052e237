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

    /// Integral of t^p from 0 to 1.
    pub(super) fn integral(self) -> f64 {
        1.0 / (self.constants().0 + 1.0)
    }

    /// What t^p at `part` of a step is short of that which [`sampled`](Self::sampled) tells.
    pub(super) fn missed(self, part: f64) -> f64 {
        self.sampled(part) - self.of(part)
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

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    /// -zeta(-p, 1), Abramowitz & Stegun 23.2 and tables.
    #[test]
    fn at_the_touch_it_is_riemanns_zeta() {
        assert_abs_diff_eq!(
            Exponent::ThreeHalves.sampled(0.0),
            0.025_485,
            epsilon = 1e-4
        );
        assert_abs_diff_eq!(Exponent::Half.sampled(0.0), 0.207_886, epsilon = 1e-4);
    }

    #[test]
    fn a_late_first_evaluation_is_as_good_as_an_early_one_before_it() {
        for power in [Exponent::Quarter, Exponent::Half, Exponent::ThreeHalves] {
            // Just one step after the touch, or at the touch and one step later.
            let (late, early) = (power.sampled(1.0), 1.0 + power.sampled(0.0));
            assert_abs_diff_eq!(late, early, epsilon = 2e-4);
        }
    }

    /// Sums of t^p from the touch on, the first term replaced, against the integral.
    #[test]
    fn sums_become_integrals() {
        for power in [Exponent::Quarter, Exponent::Half, Exponent::ThreeHalves] {
            let (p, _) = power.constants();
            for part in [0.01, 0.3, 0.62, 1.0] {
                let count = 2000;
                let rest: f64 = (1..count).map(|n| power.of(f64::from(n) + part)).sum();
                let end = f64::from(count) + part;
                // Half of the last term, and its slope: Euler and Maclaurin at the smooth end.
                let last = 0.5 * power.of(end) - p / 12.0 * power.of(end) / end;
                let sum = power.sampled(part) + rest + last;
                let exact = power.of(end) * end / (p + 1.0);
                assert_abs_diff_eq!(sum, exact, epsilon = 2e-4);
            }
        }
    }
}
