use glam::DVec3;

use super::{ContactEvent, Frame, Observer};
use crate::contact::Stored;
use crate::damper::Partner;
use crate::mount::MountEnergy;

/// Energies at an instant, in J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Energies {
    /// Kinetic energy of the mount.
    pub mount: f64,
    /// Potential energy of the mount's springs.
    pub spring: f64,
    /// Kinetic energy of the particles' centres.
    pub translation: f64,
    /// Kinetic energy of the particles' spin.
    pub spin: f64,
    /// Potential energy of the particles in gravity, zero at the origin of the fixed frame.
    pub gravity: f64,
    /// Elastic energy in contacts.
    pub contacts: f64,
}

impl Energies {
    /// Their sum in J.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.mount + self.spring + self.translation + self.spin + self.gravity + self.contacts
    }
}

/// Energies lost in contacts, in J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Losses {
    /// Normal damping between particles.
    pub pair_normal: f64,
    /// Friction between particles, rolling resistance and tangential damping included.
    pub pair_friction: f64,
    /// Normal damping at walls.
    pub wall_normal: f64,
    /// Friction at walls, rolling resistance and tangential damping included.
    pub wall_friction: f64,
}

impl Losses {
    /// Their sum in J.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.pair_normal + self.pair_friction + self.wall_normal + self.wall_friction
    }

    fn add(&mut self, partner: Partner, normal: f64, friction: f64) {
        match partner {
            Partner::Particle(_) => {
                self.pair_normal += normal;
                self.pair_friction += friction;
            }
            Partner::Wall(_) => {
                self.wall_normal += normal;
                self.wall_friction += friction;
            }
        }
    }
}

/// A contact's forces that take energy away.
#[derive(Debug, Clone, Copy)]
struct Loss {
    particle: usize,
    partner: Partner,
    cavity: usize,
    normal: DVec3,
    /// What the normal force has besides its elastic part, N.
    damping: f64,
    tangential: DVec3,
    couple: DVec3,
    working_velocity: DVec3,
    working_spin: DVec3,
}

impl Loss {
    /// Powers in W lost along the normal and across it at a relative velocity and spin.
    fn powers(&self, velocity: DVec3, spin: DVec3) -> [f64; 2] {
        [
            -self.damping * self.normal.dot(velocity),
            -self.tangential.dot(velocity) - self.couple.dot(spin),
        ]
    }
}

/// Where velocities were at the end of a step.
#[derive(Debug, Clone, Default)]
struct Pace {
    radius: Vec<f64>,
    velocity: Vec<DVec3>,
    spin: Vec<DVec3>,
    container: Vec<DVec3>,
}

impl Pace {
    fn read(&mut self, frame: &Frame<'_>) {
        self.radius.clear();
        self.velocity.clear();
        self.spin.clear();
        for particle in frame.particles() {
            self.radius.push(particle.radius);
            self.velocity.push(particle.velocity);
            self.spin.push(particle.spin);
        }
        self.container.clear();
        let containers = (0..frame.cavities()).map_while(|cavity| frame.container(cavity));
        self.container
            .extend(containers.map(|motion| motion.velocity));
    }

    /// Velocity of the first body's surface relative to the second's, and relative spin.
    fn of(&self, loss: &Loss) -> [DVec3; 2] {
        let (first, spin) = (self.velocity[loss.particle], self.spin[loss.particle]);
        let turning = spin * self.radius[loss.particle];
        match loss.partner {
            Partner::Particle(other) => {
                let turning = turning + self.spin[other] * self.radius[other];
                let surface = first - self.velocity[other] - turning.cross(loss.normal);
                [surface, spin - self.spin[other]]
            }
            Partner::Wall(_) => {
                let surface = first - self.container[loss.cavity] - turning.cross(loss.normal);
                [surface, spin]
            }
        }
    }
}

/// State at the end of the last step.
#[derive(Debug, Clone, Copy, Default)]
struct Balance {
    energies: Energies,
    mount: MountEnergy,
    /// Energy of tangential stretch in pairs and at walls, J.
    stretched: [f64; 2],
}

/// Accounts for the energy of a damper, from the forces that its steps are made with.
///
/// The account opens at the end of the first step that it watches. From then on,
/// ```text
/// input = change of energies + structure loss + contact losses + residual
/// ```
/// where each item is counted by itself, and the residual is what the time step leaves open.
///
/// Work in contacts is force times velocity, each the mean of its values at both ends of the step;
/// Verlet's method changes kinetic energy by just that. Normal loss is the work of what the normal
/// force has besides its [elastic part](Stored); friction loss is the work against slip and rolling,
/// less what the tangential stretch gained. Powers of the mount are summed by the trapezoidal rule.
/// Where a mount has no coordinates, the input is the work of moving its containers against the
/// particles.
///
/// Under an impulse law each impulse is counted with the kinetic energy it takes, and the account
/// closes to rounding but for the mount's own forces. Overlaps that such a law pushes out again show
/// as a small gain.
#[derive(Debug, Clone, Default)]
pub struct EnergyLedger {
    open: bool,
    opening: Energies,
    last: Balance,
    input: f64,
    structure: f64,
    losses: Losses,
    stored: [Stored; 2],
    before: Vec<Loss>,
    now: Vec<Loss>,
    pace: Pace,
    mean: Pace,
    loads: Vec<DVec3>,
}

impl EnergyLedger {
    /// A ledger that opens its account with the next step.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Work of the excitation since the account was opened, in J.
    #[must_use]
    pub const fn input(&self) -> f64 {
        self.input
    }

    /// Energy lost in the damping of the mount, in J.
    #[must_use]
    pub const fn structure_loss(&self) -> f64 {
        self.structure
    }

    /// Energies lost in contacts.
    #[must_use]
    pub const fn losses(&self) -> Losses {
        self.losses
    }

    /// Energies when the account was opened.
    #[must_use]
    pub const fn opening(&self) -> Energies {
        self.opening
    }

    /// Energies now.
    #[must_use]
    pub const fn energies(&self) -> Energies {
        self.last.energies
    }

    /// Energy in J that is not accounted for: positive when more was put in than can be found.
    #[must_use]
    pub fn residual(&self) -> f64 {
        let change = self.last.energies.total() - self.opening.total();
        self.input - change - self.structure - self.losses.total()
    }

    /// Turns the velocities of the last step into the means over this one.
    fn average(&mut self, frame: &Frame<'_>) {
        std::mem::swap(&mut self.pace, &mut self.mean);
        self.pace.read(frame);
        for (mean, now) in [
            (&mut self.mean.velocity, &self.pace.velocity),
            (&mut self.mean.spin, &self.pace.spin),
            (&mut self.mean.container, &self.pace.container),
        ] {
            for (mean, now) in mean.iter_mut().zip(now) {
                *mean = 0.5 * (*mean + *now);
            }
        }
    }

    fn count_contacts(&mut self, frame: &Frame<'_>) {
        let dt = frame.time_step();
        if frame.holds_forces() {
            for loss in &self.now {
                let [normal, friction] = loss.powers(loss.working_velocity, loss.working_spin);
                self.losses.add(loss.partner, dt * normal, dt * friction);
            }
        } else {
            for loss in self.before.iter().chain(&self.now) {
                let [velocity, spin] = self.mean.of(loss);
                let [normal, friction] = loss.powers(velocity, spin);
                let half = 0.5 * dt;
                self.losses
                    .add(loss.partner, half * normal, half * friction);
            }
        }
    }

    fn count_input(&mut self, frame: &Frame<'_>, mount: &MountEnergy) {
        let dt = frame.time_step();
        let before = &self.last.mount;
        self.input += 0.5 * dt * (before.input + mount.input);
        self.structure += 0.5 * dt * (before.dissipation + mount.dissipation);
        for (cavity, last) in self.loads.iter_mut().enumerate() {
            let load = frame.load(cavity).unwrap_or_default();
            if frame.coordinates().is_empty() {
                let mean = if frame.holds_forces() {
                    load
                } else {
                    0.5 * (load + *last)
                };
                self.input -= dt * mean.dot(self.mean.container[cavity]);
            }
            *last = load;
        }
    }

    fn balance(&self, frame: &Frame<'_>) -> Balance {
        let mount = frame.mount_energy();
        let mut energies = Energies {
            mount: mount.kinetic,
            spring: mount.potential,
            ..Energies::default()
        };
        for particle in frame.particles() {
            energies.translation += 0.5 * particle.mass * particle.velocity.length_squared();
            energies.spin += 0.5 * particle.inertia() * particle.spin.length_squared();
            energies.gravity -= particle.mass * frame.gravity().dot(particle.position);
        }
        for stored in &self.stored {
            energies.contacts += stored.normal + stored.tangential;
        }
        Balance {
            energies,
            mount,
            stretched: self.stored.map(|stored| stored.tangential),
        }
    }
}

impl Observer for EnergyLedger {
    fn wants_contacts(&self) -> bool {
        true
    }

    fn contact(&mut self, event: &ContactEvent) {
        self.now.push(Loss {
            particle: event.particle,
            partner: event.partner,
            cavity: event.cavity,
            normal: event.contact.normal,
            damping: event.force.normal - event.stored.normal_force,
            tangential: event.force.tangential,
            couple: event.force.couple,
            working_velocity: event.working_velocity,
            working_spin: event.working_spin,
        });
        let sum = &mut self.stored[usize::from(matches!(event.partner, Partner::Wall(_)))];
        sum.normal += event.stored.normal;
        sum.tangential += event.stored.tangential;
    }

    fn step(&mut self, frame: &Frame<'_>) {
        let balance = self.balance(frame);
        if self.open {
            self.average(frame);
            self.count_contacts(frame);
            self.count_input(frame, &balance.mount);
            let gained = |n: usize| balance.stretched[n] - self.last.stretched[n];
            self.losses.pair_friction -= gained(0);
            self.losses.wall_friction -= gained(1);
        } else {
            self.open = true;
            self.opening = balance.energies;
            self.pace.read(frame);
            self.mean.clone_from(&self.pace);
            let loads = (0..frame.cavities()).map_while(|cavity| frame.load(cavity));
            self.loads = loads.collect();
        }
        self.last = balance;
        self.stored = [Stored::default(); 2];
        std::mem::swap(&mut self.before, &mut self.now);
        self.now.clear();
    }
}
