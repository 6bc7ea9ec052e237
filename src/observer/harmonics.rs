use std::f64::consts::TAU;

use glam::DVec3;

use super::{ComplexPower, ContactEvent, Observer, Phasor, StepReport, WallRecorder};
use crate::error::{Bound, ValueError};

/// Sums over the time watched of one container.
#[derive(Debug, Clone, Copy, Default)]
struct Container {
    /// Of the impulses of the host on the particles, by the angle in the middle of their step, N s.
    impulse: Phasor,
    /// The same without the angle.
    total: DVec3,
    /// Of the way of the container, by the angle at the end of the step, m.
    way: Phasor,
}

/// First harmonics of what containers and their walls bear at one frequency, and the impacts on walls.
///
/// From them follow the energy that the particles take per cycle, their apparent mass and more:
/// [`ComplexPower`]. The sums are over the time since the last [`reset`](Self::reset): watch whole periods,
/// in steps that divide one. Values per period are read, and the sums reset, at the end of each.
///
/// Forces of containers are from the impulses of the steps, and exact whatever the law and integrator.
/// Forces of walls are those at the ends of the steps (of an impulse law, held over them). Angles are
/// counted from time zero. A container's rotation is not looked at.
///
/// ```
/// use particle_damper::excitation::Harmonic;
/// use particle_damper::glam::DVec3;
/// use particle_damper::{Cuboid, Damper, Filling, Harmonics, Material, Particle, RestitutionImpulse, Shaker};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// // 30 grains in a box that is shaken by 1 mm at 40 Hz: 6.4 g.
/// let cavity = Cuboid::new(DVec3::splat(0.03))?;
/// let bed = Filling::new(1).with(30, Particle::new(2e-3, 0.04e-3)?).fill(&cavity)?;
/// let mut damper = Damper::builder(cavity, RestitutionImpulse::new(Material::acrylic()))
///     .mount(Shaker::new(DVec3::Y, Harmonic::new(1e-3, 40.0)?)?)
///     .particles(bed)
///     .time_step(1e-4)
///     .build()?;
/// let mut harmonics = Harmonics::new(40.0)?;
/// for step in 0..30 * 250 {
///     if step == 10 * 250 {
///         harmonics.reset(); // ten periods to settle
///     }
///     damper.step_watched(&mut harmonics)?;
/// }
/// let power = harmonics.power(0).unwrap_or_default();
/// assert!(power.energy_per_cycle() > 0.0);
/// assert!(harmonics.impacts(0, 2).unwrap_or_default() > 1.0); // on the floor, per cycle
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct Harmonics {
    angular_frequency: f64,
    time: f64,
    containers: Vec<Container>,
    /// Of each wall, in the order of the recorder's records: impulses of the host on the particles.
    impulses: Vec<Phasor>,
    walls: WallRecorder,
}

impl Harmonics {
    /// Watches the harmonics of `frequency` (Hz).
    ///
    /// # Errors
    /// If the frequency is not positive and finite.
    pub fn new(frequency: f64) -> Result<Self, ValueError> {
        Ok(Self {
            angular_frequency: TAU * Bound::Positive.check("frequency (Hz)", frequency)?,
            time: 0.0,
            containers: Vec::new(),
            impulses: Vec::new(),
            walls: WallRecorder::new(),
        })
    }

    /// Starts all sums afresh. Contacts that go on are no new impacts.
    pub fn reset(&mut self) {
        self.time = 0.0;
        self.containers.fill(Container::default());
        self.impulses.fill(Phasor::default());
        self.walls.reset();
    }

    /// Angular frequency w in rad/s.
    #[must_use]
    pub const fn angular_frequency(&self) -> f64 {
        self.angular_frequency
    }

    /// How many cycles have been watched.
    #[must_use]
    pub fn cycles(&self) -> f64 {
        self.time * self.angular_frequency / TAU
    }

    /// Of a sum over the time watched, the first harmonic.
    fn harmonic(&self, sum: Phasor) -> Phasor {
        if self.time > 0.0 {
            sum.scaled(2.0 / self.time)
        } else {
            sum
        }
    }

    /// First harmonic of the force of a container on the particles in it, N.
    #[must_use]
    pub fn force(&self, cavity: usize) -> Option<Phasor> {
        let container = self.containers.get(cavity)?;
        Some(self.harmonic(container.impulse))
    }

    /// Mean force of a container on the particles in it, N: what carries their weight.
    #[must_use]
    pub fn mean_force(&self, cavity: usize) -> Option<DVec3> {
        let container = self.containers.get(cavity)?;
        (self.time > 0.0).then(|| container.total / self.time)
    }

    /// First harmonic of the velocity of a container, m/s.
    #[must_use]
    pub fn velocity(&self, cavity: usize) -> Option<Phasor> {
        let container = self.containers.get(cavity)?;
        Some(self.harmonic(container.way))
    }

    /// First harmonic of the force of a wall on the particles that touch it, N.
    #[must_use]
    pub fn wall_force(&self, cavity: usize, wall: u32) -> Option<Phasor> {
        let place = self.walls.place(cavity, wall)?;
        Some(self.harmonic(*self.impulses.get(place)?))
    }

    /// The complex power that a container gives its particles.
    #[must_use]
    pub fn power(&self, cavity: usize) -> Option<ComplexPower> {
        Some(ComplexPower::new(
            self.force(cavity)?,
            self.velocity(cavity)?,
            self.angular_frequency,
        ))
    }

    /// How many impacts a wall has in a cycle, as a [`WallRecorder`] counts them.
    #[must_use]
    pub fn impacts(&self, cavity: usize, wall: u32) -> Option<f64> {
        let record = self.walls.wall(cavity, wall)?;
        (self.time > 0.0).then(|| record.impacts as f64 / self.cycles())
    }

    /// What happened at the walls since the last reset.
    #[must_use]
    pub const fn walls(&self) -> &WallRecorder {
        &self.walls
    }
}

impl Observer for Harmonics {
    fn wants_contacts(&self) -> bool {
        true
    }

    fn contact(&mut self, event: &ContactEvent) {
        self.walls.contact(event);
    }

    fn step(&mut self, report: &StepReport<'_>) {
        self.walls.step(report);
        let dt = report.time_step();
        let end = self.angular_frequency * report.time();
        let middle = end - 0.5 * self.angular_frequency * dt;
        self.containers
            .resize(report.cavities(), Container::default());
        for (cavity, container) in self.containers.iter_mut().enumerate() {
            let impulse = -report.impulse(cavity).unwrap_or_default();
            container.impulse.add(impulse, middle);
            container.total += impulse;
            let motion = report.container(cavity).unwrap_or_default();
            container.way.add(motion.velocity * dt, end);
        }
        let records = self.walls.records();
        self.impulses.resize(records.len(), Phasor::default());
        let held = report.holds_forces();
        for (sum, record) in self.impulses.iter_mut().zip(records) {
            sum.add(-record.force * dt, if held { middle } else { end });
        }
        self.time += dt;
    }
}
