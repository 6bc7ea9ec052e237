use glam::DVec3;

use super::{ContactEvent, Observer, StepReport};
use crate::contact::Stored;
use crate::mount::MountEnergy;

mod accounts;
mod touch;

pub use accounts::{Account, Energies, Losses};
use touch::{Pace, Touch, class};

/// State at the end of the last step.
#[derive(Debug, Clone, Copy, Default)]
struct Balance {
    energies: Energies,
    mount: MountEnergy,
    /// What pairs and walls hold.
    stored: [Stored; 2],
    /// Power of normal damping by itself, W.
    damping: f64,
}

/// Accounts for the energy of a damper, from the forces that its steps are made with.
///
/// The account opens at the end of the first step that it watches. From then on,
/// ```text
/// input = change of energies + structure loss + contact losses + residual
/// ```
/// where each item is counted by itself, and the residual is what the time step leaves open.
///
/// Work in contacts is force times velocity, each the mean of its values at both ends of the step:
/// Verlet's method changes kinetic energy by just that. What other integrators do at their stages
/// besides is known from the change of momentum, and is shared among the normal forces. Losses are
/// that work less what the contacts [store](Stored): along the normal, and across it by slip and
/// rolling. So the losses along the normal are those of the impacts as they happen, at a coarse step,
/// too. What the law's damping, summed up by itself, does not explain of them is told apart by
/// [`integration_loss`](Self::integration_loss): with the paper's damper at resonance (6 Hz, 20
/// particles, 40 periods) it is 3.0 % of the input at a step of 2e-5 s, six to an impact (0.5 % with
/// [`RungeKutta4`](crate::RungeKutta4)), and falls as the step squared, to 0.04 % at 2.5e-6 s. It says
/// how well the step resolves impacts, not how far restitution is off, which is less: see
/// [`guide::trust`](crate::guide::trust#steps-to-a-contact). Powers of the mount are summed by the
/// trapezoidal rule.
/// Where a mount has no coordinates, the input is the work of moving its containers against the
/// particles.
///
/// Under an impulse law each impulse is counted with the kinetic energy it takes, and the account
/// closes to rounding but for the mount's own forces. Overlaps that such a law pushes out again show
/// as a small gain.
///
/// ```
/// use particle_damper::excitation::Harmonic;
/// use particle_damper::{Damper, EnergyLedger, HertzTsuji, Material, Particle, SingleDof, Slot};
/// use particle_damper::glam::dvec3;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut damper = Damper::builder(Slot::paper(), HertzTsuji::new(Material::acrylic()))
///     .mount(SingleDof::paper().excited_by(Harmonic::new(0.25, 6.0)?))
///     .particles([Particle::new(3e-3, 0.2e-3)?.at(dvec3(0.03, 0.0031, 0.0))])
///     .time_step(2e-5)
///     .build()?;
/// let mut ledger = EnergyLedger::new();
/// for _ in 0..20_000 {
///     damper.step_watched(&mut ledger)?;
/// }
/// assert!(ledger.residual().abs() < 1e-5 * ledger.input());
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, Default)]
pub struct EnergyLedger {
    open: bool,
    held: bool,
    opening: Energies,
    last: Balance,
    input: f64,
    structure: f64,
    losses: Losses,
    stored: [Stored; 2],
    damping: f64,
    touches: Vec<Touch>,
    touches_before: Vec<Touch>,
    /// At the end of the step, and the mean over it.
    pace: Pace,
    mean: Pace,
}

impl EnergyLedger {
    /// A ledger that opens its account with the next step.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The account since it was opened.
    #[must_use]
    pub fn account(&self) -> Account {
        Account {
            opening: self.opening,
            closing: self.last.energies,
            input: self.input,
            structure_loss: self.structure,
            losses: self.losses,
            integration_loss: self.integration_loss(),
        }
    }

    /// Hands over the account and opens the next one where it ends: once a period, the energy of each
    /// cycle.
    pub fn close(&mut self) -> Account {
        let account = self.account();
        self.reset();
        account
    }

    /// Opens the account afresh at the end of the last step. Before the first step there is nothing to do.
    pub const fn reset(&mut self) {
        self.opening = self.last.energies;
        self.input = 0.0;
        self.structure = 0.0;
        self.losses = Losses::NONE;
        self.damping = 0.0;
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

    /// Part of the [losses](Self::losses) along the normal, in J, that the law's damping does not
    /// explain when it is summed up by itself: what a time step too coarse for the contacts leaves open
    /// between elastic forces and damping. Zero under an impulse law.
    #[must_use]
    pub fn integration_loss(&self) -> f64 {
        if self.held {
            return 0.0;
        }
        self.losses.pair_normal + self.losses.wall_normal - self.damping
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
        self.account().residual()
    }

    /// Works of the contacts on the particles over the step, by the change of their momentum: what
    /// the containers give, and what is taken from motion relative to them. Whatever the integrator,
    /// these are the works of the forces that it used.
    fn exchanged(&self, report: &StepReport<'_>) -> [f64; 2] {
        let fall = report.gravity() * report.time_step();
        let (mut given, mut taken) = (0.0, 0.0);
        for (now, mean) in self.pace.particles.iter().zip(&self.mean.particles) {
            let impulse = now.mass * (2.0 * (now.velocity - mean.velocity) - fall);
            let container = &self.mean.containers[now.cavity as usize];
            let carried = container.velocity_at(mean.position);
            let turn = now.inertia() * 2.0 * (now.spin - mean.spin);
            given += impulse.dot(carried) + turn.dot(container.angular_velocity);
            taken -= impulse.dot(mean.velocity - carried);
            taken -= turn.dot(mean.spin - container.angular_velocity);
        }
        [given, taken]
    }

    fn count_contacts(&mut self, report: &StepReport<'_>, now: &Balance, all: f64) {
        let dt = report.time_step();
        let mut taken = [[0.0; 2]; 2];
        let mut take = |touch: &Touch, [velocity, spin]: [DVec3; 2], time: f64| {
            let powers = touch.powers(velocity, spin);
            let sums = &mut taken[class(touch.partner)];
            sums[0] += powers[0] * time;
            sums[1] += powers[1] * time;
        };
        if report.holds_forces() {
            for touch in &self.touches {
                take(touch, [touch.working_velocity, touch.working_spin], dt);
            }
        } else {
            for touch in self.touches_before.iter().chain(&self.touches) {
                take(touch, self.mean.of(touch), 0.5 * dt);
            }
            let seen: f64 = taken.as_flattened().iter().sum();
            let [pairs, walls] = taken.map(|[normal, _]| normal.abs() + f64::MIN_POSITIVE);
            taken[0][0] += (all - seen) * (pairs / (pairs + walls));
            taken[1][0] += (all - seen) * (walls / (pairs + walls));
            self.damping += 0.5 * dt * (self.last.damping + now.damping);
        }
        for (class, taken) in taken.iter_mut().enumerate() {
            let (before, now) = (&self.last.stored[class], &now.stored[class]);
            taken[0] -= now.normal - before.normal;
            taken[1] -= now.tangential - before.tangential;
        }
        self.losses.add(&taken);
    }

    fn count_input(&mut self, report: &StepReport<'_>, mount: &MountEnergy, given: f64) {
        let half = 0.5 * report.time_step();
        let before = &self.last.mount;
        self.input += half * (before.input + mount.input);
        self.structure += half * (before.dissipation + mount.dissipation);
        if report.coordinates().is_empty() {
            self.input += given;
        }
    }

    fn balance(&mut self, report: &StepReport<'_>) -> Balance {
        let mount = report.mount_energy();
        let mut energies = Energies {
            mount: mount.kinetic,
            spring: mount.potential,
            ..Energies::default()
        };
        for particle in &self.pace.particles {
            energies.add_particle(particle, report.gravity());
        }
        for stored in &self.stored {
            energies.contacts += stored.normal + stored.tangential;
        }
        let damping = |touch: &Touch| {
            let [velocity, _] = self.pace.of(touch);
            -touch.damping * touch.normal.dot(velocity)
        };
        Balance {
            energies,
            mount,
            stored: std::mem::take(&mut self.stored),
            damping: self.touches.iter().map(damping).sum(),
        }
    }
}

impl Observer for EnergyLedger {
    fn wants_contacts(&self) -> bool {
        true
    }

    fn contact(&mut self, event: &ContactEvent) {
        self.touches.push(Touch::new(event));
        let sum = &mut self.stored[class(event.partner)];
        sum.normal += event.stored.normal;
        sum.tangential += event.stored.tangential;
    }

    fn step(&mut self, report: &StepReport<'_>) {
        std::mem::swap(&mut self.pace, &mut self.mean);
        self.pace.read(report);
        self.mean.average(&self.pace);
        let balance = self.balance(report);
        if self.open {
            let [given, taken] = self.exchanged(report);
            self.count_contacts(report, &balance, taken);
            self.count_input(report, &balance.mount, given);
        } else {
            self.open = true;
            self.opening = balance.energies;
        }
        self.last = balance;
        self.held = report.holds_forces();
        std::mem::swap(&mut self.touches, &mut self.touches_before);
        self.touches.clear();
    }
}
