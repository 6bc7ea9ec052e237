use super::bounces::Bounces;
use super::least_squares::Solution;
use crate::error::ValueError;
use crate::law::ElasticImpact;
use crate::statistics::student_t;

/// A fitted value and the interval that holds the true one with the [confidence](super::DropTest::confidence) asked
/// for.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Fitted {
    /// The value.
    pub value: f64,
    /// The lower end of the interval.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

impl Fitted {
    /// A value and what lies `within` of it on both sides.
    pub(super) fn new(value: f64, within: f64) -> Self {
        Self {
            value,
            low: value - within,
            high: value + within,
        }
    }

    /// The estimate of a monotonous function of it.
    fn map(self, function: impl Fn(f64) -> f64) -> Self {
        let ends = [function(self.low), function(self.high)];
        Self {
            value: function(self.value),
            low: ends[0].min(ends[1]),
            high: ends[0].max(ends[1]),
        }
    }
}

/// An impact, as the fit has it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Impact {
    /// When it begins, s.
    pub time: f64,
    /// Speed in m/s at which the ball leaves.
    pub speed: f64,
    /// The time measured less the one fitted, s.
    pub residual: f64,
}

/// A peak of a height trace.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Peak {
    /// When it is passed as the fit has it, s.
    pub time: f64,
    /// How high it is in the trace as the fit has it, m.
    pub height: f64,
    /// The time of the parabola's peak less the one fitted, s.
    pub time_residual: f64,
    /// The height of the parabola's peak less the one fitted, m.
    pub height_residual: f64,
}

/// What a drop test tells of the contact.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DropFit {
    /// Restitution at the [reference speed](super::DropTest::reference_speed). Noise may take it, or its
    /// interval, above one.
    pub restitution: Fitted,
    /// The damping number ([`Damping`](crate::Damping)) at the reference speed. Negative where restitution is
    /// above one.
    pub number: Fitted,
    /// The impacts; none of a height trace.
    pub impacts: Vec<Impact>,
    pub(super) bounces: Bounces,
}

/// What a height trace tells.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct HeightFit {
    /// Restitution and damping.
    pub contact: DropFit,
    /// The peaks of the whole flights.
    pub peaks: Vec<Peak>,
    /// Height of the trace at impact, m.
    pub floor: Fitted,
    /// How large heights are in the trace over what flights of their duration reach: 1 if it is
    /// calibrated and gravity is as it was given.
    pub scale: Fitted,
}

impl DropFit {
    /// From the parameter `place` of a solution, whose variance is at least `variance`.
    pub(super) fn new<const P: usize>(
        bounces: Bounces,
        solution: &Solution<P>,
        place: usize,
        interval: &Interval,
    ) -> Self {
        let number = interval.of(solution, place, NUMBER);
        Self {
            restitution: number.map(|number| bounces.restitution(number, bounces.reference)),
            number,
            impacts: Vec::new(),
            bounces,
        }
    }

    /// Restitution at an impact speed (m/s).
    #[must_use]
    pub fn restitution_at(&self, speed: f64) -> Fitted {
        self.number
            .map(|number| self.bounces.restitution(number, speed))
    }

    /// The damping coefficient c of a strict law for an impact of these bodies, in N s/m^(3/2)
    /// (viscoelastic) or N s/m^(5/4) (Tsuji): that of [`HertzTsuji`](crate::HertzTsuji) and
    /// [`HertzMindlin`](crate::HertzMindlin) alike, whose `elastic_impact` gives the impact. Its speed does
    /// not matter.
    #[must_use]
    pub fn damping_coefficient(&self, impact: &ElasticImpact) -> Fitted {
        let Bounces {
            damping, reference, ..
        } = self.bounces;
        self.number.map(|number| {
            let here = damping.at_speed(number, impact.speed() / reference);
            damping.coefficient(here, impact)
        })
    }

    /// Root of the mean square of the impacts' residuals, s; zero without any.
    #[must_use]
    pub fn rms_residual(&self) -> f64 {
        let squares = self
            .impacts
            .iter()
            .map(|impact| impact.residual * impact.residual);
        (squares.sum::<f64>() / self.impacts.len().max(1) as f64).sqrt()
    }
}

/// A damping number is fitted in units of this.
pub(super) const NUMBER: f64 = 0.1;

/// How wide intervals are.
pub(super) struct Interval {
    /// Student's t.
    quantile: f64,
    /// Standard deviation of the residuals.
    deviation: f64,
}

impl Interval {
    /// Of residuals whose variance is `variance`, known from `degrees` of freedom.
    pub(super) fn new(confidence: f64, degrees: usize, variance: f64) -> Result<Self, ValueError> {
        Ok(Self {
            quantile: student_t(confidence, degrees as f64)?,
            deviation: variance.sqrt(),
        })
    }

    /// Of a parameter that is counted in `unit`s.
    pub(super) fn of<const P: usize>(
        &self,
        solution: &Solution<P>,
        place: usize,
        unit: f64,
    ) -> Fitted {
        let error = solution.covariance[place][place].sqrt() * self.deviation;
        Fitted::new(
            solution.parameters[place] * unit,
            self.quantile * error * unit,
        )
    }
}
