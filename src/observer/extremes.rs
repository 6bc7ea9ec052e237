use super::{ContactEvent, Observer, StepReport};

/// The largest values met so far, zero at the start.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Extremes {
    /// Largest normal force of a contact in N. Of an impulse law, the largest impulse over the time
    /// step.
    pub force: f64,
    /// Largest overlap in m.
    pub overlap: f64,
    /// Largest speed with which two bodies in contact approach, in m/s.
    pub approach_speed: f64,
    /// Largest speed of a particle in m/s, fixed frame, at the end of a step.
    pub speed: f64,
}

impl Extremes {
    /// Nothing met yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }
}

impl Observer for Extremes {
    fn wants_contacts(&self) -> bool {
        true
    }

    fn contact(&mut self, event: &ContactEvent) {
        self.force = self.force.max(event.force.normal);
        self.overlap = self.overlap.max(event.contact.overlap);
        self.approach_speed = self.approach_speed.max(event.contact.approach_speed());
    }

    fn step(&mut self, report: &StepReport<'_>) {
        let speeds = report
            .particles()
            .map(|particle| particle.velocity.length());
        self.speed = speeds.fold(self.speed, f64::max);
    }
}
