use std::ops::ControlFlow;

use super::run::telling;
use super::{
    Branches, Line, Period, Point, Progress, Response, ResponseCurve, ResponseError, Structure,
    Swept,
};
use crate::cavity::Cavity;
use crate::damper::Damper;
use crate::detector::Detector;
use crate::integrator::Integrator;
use crate::law::ContactLaw;
use crate::tasks::{Hear, Ledger, Told, spread};

impl<L, C, D, I, S> ResponseCurve<L, C, D, I, S> {
    /// The lines of a [sweep](Self::sweep): every combination of number of particles, seed and what is not
    /// swept.
    #[must_use]
    pub fn lines(&self, swept: Swept) -> Vec<Line> {
        let others = match swept {
            Swept::Amplitude => &self.frequencies,
            Swept::Frequency => &self.amplitudes,
        };
        let mut lines = Vec::new();
        for &particles in &self.particles {
            for &seed in &self.seeds {
                lines.extend(others.iter().map(|&other| Line {
                    particles,
                    seed,
                    swept,
                    other,
                }));
            }
        }
        lines
    }

    /// The points of a line as they follow each other: up and down again, the last one not twice.
    fn course(&self, line: &Line) -> [Vec<Point>; 2] {
        let values = match line.swept {
            Swept::Amplitude => &self.amplitudes,
            Swept::Frequency => &self.frequencies,
        };
        let mut up: Vec<Point> = values.iter().map(|&value| line.at(value)).collect();
        let value = |point: &Point| line.swept.of(point);
        up.sort_by(|a, b| value(a).total_cmp(&value(b)));
        let down = up.iter().rev().copied().collect();
        [up, down]
    }
}

impl Swept {
    /// Its value at a point.
    pub(super) const fn of(self, point: &Point) -> f64 {
        match self {
            Self::Amplitude => point.amplitude,
            Self::Frequency => point.frequency,
        }
    }
}

impl<L, C, D, I, S> ResponseCurve<L, C, D, I, S>
where
    L: ContactLaw + Clone,
    C: Cavity + Clone,
    D: Detector + Clone,
    I: Integrator + Clone,
    S: Structure,
{
    /// Measures one line, of the curve's amplitudes or frequencies: what [`sweep`](Self::sweep) gives for
    /// it, to the bit. `each_period` is called at the end of every period with its point and what it was,
    /// and may cancel.
    ///
    /// # Errors
    /// As [`sweep`](Self::sweep).
    pub fn follow(
        &self,
        line: Line,
        mut each_period: impl FnMut(Point, Period) -> ControlFlow<()>,
    ) -> Result<Branches, ResponseError> {
        self.check()?;
        self.follow_line(&line, &mut each_period, &mut |_, _| {
            ControlFlow::Continue(())
        })
    }

    fn follow_line(
        &self,
        line: &Line,
        each_period: &mut dyn FnMut(Point, Period) -> ControlFlow<()>,
        each_point: &mut dyn FnMut(&Response, u64) -> ControlFlow<()>,
    ) -> Result<Branches, ResponseError> {
        let mut last: Option<Damper<C, L, S::Mount, D, I>> = None;
        let mut branches = [Vec::new(), Vec::new()];
        for (points, branch) in self.course(line).iter().zip(&mut branches) {
            for &point in points {
                let mut damper = self.damper(point)?;
                if let Some(last) = &last {
                    let taken = damper.take_over(last);
                    taken
                        .map_err(Box::new)
                        .map_err(|error| ResponseError::Sweep { point, error })?;
                }
                let mut left = self.periods.most();
                let response = self.observe(point, &mut damper, |period| {
                    left -= 1;
                    each_period(point, period)
                })?;
                if each_point(&response, left).is_break() {
                    return Err(ResponseError::Cancelled);
                }
                branch.push(response);
                last = Some(damper);
            }
        }
        let [up, down] = branches;
        Ok(Branches {
            line: *line,
            up,
            down,
        })
    }
}

impl<L, C, D, I, S> ResponseCurve<L, C, D, I, S>
where
    L: ContactLaw + Clone,
    C: Cavity + Clone + Sync,
    D: Detector + Clone + Sync,
    I: Integrator + Clone + Sync,
    S: Structure + Sync,
{
    /// Goes up through the amplitudes or the frequencies and down again, and keeps the state from point
    /// to point: particles, contacts and mount go on as they were while the drive changes, at the end of
    /// a period, where it is zero and rising. So the response may be told apart by where it comes from:
    /// [`Branches::parted`] says where.
    ///
    /// The first point starts at rest, from the filling. Then [`periods`](Self::periods) are discarded at
    /// every point; the closer the points are, the less there is to settle.
    ///
    /// There is one result for each of the [`lines`](Self::lines), in their order. `progress` is as in
    /// [`run`](Self::run); a point counts twice, up and down. With the feature `rayon` lines are followed
    /// on all threads, with the same bits.
    ///
    /// # Errors
    /// As [`run`](Self::run), or if a mount cannot take over the state of the one before, because it
    /// yields otherwise to forces of the particles.
    pub fn sweep<F>(&self, swept: Swept, progress: F) -> Result<Vec<Branches>, ResponseError>
    where
        F: FnMut(&Progress<'_>) -> ControlFlow<()> + Send,
    {
        self.check()?;
        let lines = self.lines(swept);
        let most = self.periods.most() as f64;
        let points = |line: &Line| self.course(line).concat();
        let cost = |line: &Line| -> f64 {
            let works = points(line).into_iter().map(Point::work);
            works.sum::<f64>() * most
        };
        let count = lines.iter().map(|line| points(line).len()).sum();
        let ledger = Ledger::new(count, lines.iter().map(cost).sum(), telling(progress));
        let cancelled = ResponseError::Cancelled;
        spread(
            &lines,
            cost,
            &cancelled,
            ledger,
            |line, hear: &mut Hear<'_, Response>| {
                let hear = std::cell::RefCell::new(hear);
                self.follow_line(
                    line,
                    &mut |point, _| (hear.borrow_mut())(&Told::Period(point.work())),
                    &mut |response, left| {
                        let unneeded = response.point.work() * left as f64;
                        (hear.borrow_mut())(&Told::Point(response, unneeded))
                    },
                )
            },
        )
    }
}
