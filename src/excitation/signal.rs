/// A jump of a signal, of its value or of its rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// When it jumps, s.
    pub time: f64,
    /// By how much the value does.
    pub value: f64,
    /// By how much the rate does, per second.
    pub rate: f64,
}

/// A function of time with its rate: a force, the displacement of a base.
///
/// # Using
/// [`Harmonic`](super::Harmonic), [`Chirp`](super::Chirp),
/// [`BandLimitedNoise`](super::BandLimitedNoise) and [`Sampled`](super::Sampled) are signals, and so
/// is any closure from time (s) to `[value, rate]`.
///
/// # Implementing
/// 1. [`at`](Self::at) is defined and finite at every finite time, negative ones included.
/// 2. The rate is the derivative of the value, wherever that exists.
/// 3. [`value`](Self::value), if written again to save the rate, gives the same bits as `at`.
/// 4. [`shortest_feature`](Self::shortest_feature) and [`jump`](Self::jump) tell a damper what to refuse.
///
/// A half-sine shock:
/// ```
/// use std::f64::consts::PI;
/// use particle_damper::excitation::Signal;
///
/// struct Shock {
///     peak: f64,
///     duration: f64,
/// }
///
/// impl Signal for Shock {
///     fn at(&self, time: f64) -> [f64; 2] {
///         if !(0.0..=self.duration).contains(&time) {
///             return [0.0; 2];
///         }
///         let omega = PI / self.duration;
///         let (sin, cos) = (omega * time).sin_cos();
///         [self.peak * sin, self.peak * omega * cos]
///     }
///     fn shortest_feature(&self) -> f64 {
///         self.duration
///     }
/// }
/// let shock = Shock { peak: 30.0, duration: 0.01 };
/// assert!((shock.value(0.005) - 30.0).abs() < 1e-12);
/// ```
pub trait Signal {
    /// Value and rate (value per second) at `time` (s).
    fn at(&self, time: f64) -> [f64; 2];

    /// Value at `time` (s).
    #[inline]
    fn value(&self, time: f64) -> f64 {
        self.at(time)[0]
    }

    /// How long the shortest rise and fall of the value takes, s: of a sine half a period. Infinite unless
    /// stated.
    fn shortest_feature(&self) -> f64 {
        f64::INFINITY
    }

    /// A jump that nobody asked for by name, which the motion of a base cannot have. None unless stated.
    fn jump(&self) -> Option<Jump> {
        None
    }
}

impl<F: Fn(f64) -> [f64; 2]> Signal for F {
    #[inline]
    fn at(&self, time: f64) -> [f64; 2] {
        self(time)
    }
}

/// Asserts that the rate is the derivative of the value at `times`, to `tolerance`, and that the two
/// ways to a value agree.
#[cfg(test)]
pub(super) fn assert_rate_is_derivative(
    signal: &impl Signal,
    times: impl Iterator<Item = f64>,
    step: f64,
    tolerance: f64,
) {
    for time in times {
        let [value, rate] = signal.at(time);
        assert_eq!(value.to_bits(), signal.value(time).to_bits(), "at {time}");
        // Fourth-order central difference.
        let near = signal.value(time + step) - signal.value(time - step);
        let far = signal.value(time + 2.0 * step) - signal.value(time - 2.0 * step);
        let difference = (8.0 * near - far) / (12.0 * step);
        assert!(
            (rate - difference).abs() < tolerance,
            "at {time}: rate {rate}, difference {difference}"
        );
    }
}
