/// What is watched, x, over one period, over the structure's [unit](super::Structure::unit).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Period {
    /// How many periods are done, this one included.
    pub number: u64,
    /// Mean of x.
    pub mean: f64,
    /// Mean of x^2.
    pub mean_square: f64,
    /// Amplitude of the part of x that is in phase with the drive.
    pub in_phase: f64,
    /// Amplitude of the part of x that is a quarter of a period ahead of it.
    pub quadrature: f64,
}

impl Period {
    /// RMS of x about the period's own mean.
    #[must_use]
    pub fn rms(&self) -> f64 {
        let variance = self.mean_square - self.mean * self.mean;
        variance.max(0.0).sqrt()
    }

    /// The period of a number from sums over it.
    pub(super) fn new(number: u64, sums: &Sums, unit: f64) -> Self {
        let samples = sums.samples as f64;
        let [in_phase, quadrature] = sums.harmonic();
        Self {
            number,
            mean: sums.sum / samples / unit,
            mean_square: sums.squares / samples / (unit * unit),
            in_phase: in_phase / unit,
            quadrature: quadrature / unit,
        }
    }
}

/// Running sums of a quantity sampled evenly over whole periods.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sums {
    samples: u64,
    sum: f64,
    squares: f64,
    in_phase: f64,
    quadrature: f64,
}

impl Sums {
    /// Takes up a value where the drive has `sine` and `cosine` of its angle.
    pub(super) fn add(&mut self, value: f64, [sine, cosine]: [f64; 2]) {
        self.samples += 1;
        self.sum += value;
        self.squares += value * value;
        self.in_phase += value * sine;
        self.quadrature += value * cosine;
    }

    /// Takes up all that another has.
    pub(super) fn join(&mut self, other: &Self) {
        self.samples += other.samples;
        self.sum += other.sum;
        self.squares += other.squares;
        self.in_phase += other.in_phase;
        self.quadrature += other.quadrature;
    }

    /// Mean, and mean of squares.
    pub(super) fn means(&self) -> [f64; 2] {
        [self.sum, self.squares].map(|sum| sum / self.samples as f64)
    }

    /// Amplitudes in phase and in quadrature.
    pub(super) fn harmonic(&self) -> [f64; 2] {
        [self.in_phase, self.quadrature].map(|sum| 2.0 * sum / self.samples as f64)
    }
}
