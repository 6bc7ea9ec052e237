use glam::DVec3;

use super::{ContactEvent, Observer, StepReport};
use crate::contact::Partner;
use crate::error::{Bound, ValueError};

/// A contact from beginning to end.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LoggedContact {
    /// Number of the first particle; of two, the lower number.
    pub particle: usize,
    /// What it touched.
    pub partner: Partner,
    /// Number of the cavity.
    pub cavity: usize,
    /// When the bodies met, s.
    pub begin: f64,
    /// When they parted, s.
    pub end: f64,
    /// Speed with which the surfaces approached when the contact was seen first, m/s.
    pub approach_speed: f64,
    /// Impulse on the particle from beginning to end, N s.
    pub impulse: DVec3,
    /// Largest normal force in N; of an impulse law, the largest impulse over the time step.
    pub peak_force: f64,
}

impl LoggedContact {
    /// The two bodies, by which a contact is known from step to step.
    const fn key(&self) -> (usize, bool, usize) {
        match self.partner {
            Partner::Wall(wall) => (self.particle, false, wall as usize),
            Partner::Particle(other) => (self.particle, true, other),
        }
    }
}

/// A contact of the present step, and one that is going on.
#[derive(Debug, Clone, Copy)]
struct Touch {
    record: LoggedContact,
    overlap: f64,
    approach: f64,
}

/// Lists contacts from beginning to end: when, between whom, with what impulse.
///
/// A contact begins with the step in which two bodies touch that did not in the one before, and has ended
/// when they are seen apart (under an impulse law: when a step gives them no impulse). The times are
/// between steps: by the overlap, and the speed at which the surfaces approach or part. Contacts of the
/// same bodies can be [joined](Self::joining) over short gaps.
///
/// Memory grows with the contacts that have ended, until they are [taken](Self::take) or forgotten.
///
/// ```
/// use particle_damper::glam::{DVec3, dvec3};
/// use particle_damper::{Damper, EventLog, HertzTsuji, Material, Particle, Partner, Slot};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let ball = Particle::new(3e-3, 0.2e-3)?.at(dvec3(0.03, 0.053, 0.0));
/// let mut damper = Damper::builder(Slot::paper(), HertzTsuji::new(Material::acrylic()))
///     .particles([ball])
///     .time_step(1e-5)
///     .build()?;
/// let mut log = EventLog::new();
/// while damper.time() < 0.15 {
///     damper.step_watched(&mut log)?;
/// }
/// let fall = (2.0 * 0.05 / 9.81_f64).sqrt();
/// let first = log.records()[0];
/// assert_eq!((first.particle, first.partner), (0, Partner::Wall(2)));
/// assert!((first.begin - fall).abs() < 1e-7);
/// assert!((first.approach_speed - 9.81 * fall).abs() < 1e-2);
/// assert!((first.impulse.y - 0.2e-3 * 1.75 * 9.81 * fall).abs() < 1e-6);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, Default)]
pub struct EventLog {
    gap: f64,
    ended: Vec<LoggedContact>,
    /// Those that go on, by their keys.
    open: Vec<Touch>,
    kept: Vec<Touch>,
    /// Of the present step.
    now: Vec<Touch>,
}

impl EventLog {
    /// An empty log, in which each parting ends a contact.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The same log, in which contacts of the same bodies count as one when they are apart for no longer
    /// than `gap` (s).
    ///
    /// # Errors
    /// If the gap is negative or not finite.
    pub fn joining(mut self, gap: f64) -> Result<Self, ValueError> {
        self.gap = Bound::NonNegative.check("gap between contacts (s)", gap)?;
        Ok(self)
    }

    /// The contacts that have ended, in the order in which they did.
    #[must_use]
    pub fn records(&self) -> &[LoggedContact] {
        &self.ended
    }

    /// The contacts that go on, by their particles, as far as they have come.
    #[must_use]
    pub fn open(&self) -> impl ExactSizeIterator<Item = LoggedContact> {
        self.open.iter().map(|touch| touch.record)
    }

    /// Hands over the contacts that have ended, and forgets them.
    pub fn take(&mut self) -> Vec<LoggedContact> {
        std::mem::take(&mut self.ended)
    }

    /// Forgets the contacts that have ended, and keeps their room.
    pub fn clear(&mut self) {
        self.ended.clear();
    }

    /// Gives the contacts of this step their times.
    fn place_in_time(&mut self, report: &StepReport<'_>) {
        let (end, dt) = (report.time(), report.time_step());
        let seen = if report.holds_forces() {
            end - 0.5 * dt
        } else {
            end
        };
        for touch in &mut self.now {
            let since = touch.overlap / touch.approach;
            touch.record.begin = if touch.approach > 0.0 {
                (seen - since).clamp(end - dt, end)
            } else {
                end - dt
            };
            // How long until the surfaces part, as far as can be seen from here.
            touch.record.end = if !report.holds_forces() && touch.approach < 0.0 {
                end + (-since).clamp(0.0, dt)
            } else {
                end
            };
            touch.record.impulse *= dt;
        }
    }
}

impl Observer for EventLog {
    fn wants_contacts(&self) -> bool {
        true
    }

    fn contact(&mut self, event: &ContactEvent) {
        let push = event.contact.normal * event.force.normal + event.force.tangential;
        let (particle, partner, force) = match event.partner {
            Partner::Particle(other) if other < event.particle => {
                (other, Partner::Particle(event.particle), -push)
            }
            partner => (event.particle, partner, push),
        };
        self.now.push(Touch {
            record: LoggedContact {
                particle,
                partner,
                cavity: event.cavity,
                begin: 0.0,
                end: 0.0,
                approach_speed: event.contact.approach_speed().max(0.0),
                // Until the end of the step a force.
                impulse: force,
                peak_force: event.force.normal,
            },
            overlap: event.contact.overlap,
            approach: event.contact.approach_speed(),
        });
    }

    fn step(&mut self, report: &StepReport<'_>) {
        self.place_in_time(report);
        self.now.sort_unstable_by_key(|touch| touch.record.key());
        let begin = report.time() - report.time_step();
        // A hair more, for rounding of times.
        let latest = begin - self.gap - 1e-6 * report.time_step();
        let mut now = self.now.drain(..).peekable();
        for before in self.open.drain(..) {
            let key = before.record.key();
            while let Some(new) = now.next_if(|touch| touch.record.key() < key) {
                self.kept.push(new);
            }
            let again = now.next_if(|touch| touch.record.key() == key);
            match again {
                Some(mut touch) if before.record.end >= latest => {
                    let (old, record) = (before.record, &mut touch.record);
                    record.begin = old.begin;
                    record.approach_speed = old.approach_speed;
                    record.impulse += old.impulse;
                    record.peak_force = record.peak_force.max(old.peak_force);
                    self.kept.push(touch);
                }
                Some(touch) => {
                    self.ended.push(before.record);
                    self.kept.push(touch);
                }
                None if before.record.end + self.gap > report.time() => self.kept.push(before),
                None => self.ended.push(before.record),
            }
        }
        self.kept.extend(now);
        std::mem::swap(&mut self.open, &mut self.kept);
    }
}
