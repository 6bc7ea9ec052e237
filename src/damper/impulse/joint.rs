//! Joints: contacts in reach, as a step's impulses see them.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use glam::{DMat3, DVec3};

use crate::contact::{Contact, ContactForce};
use crate::damper::candidates::make_room;
use crate::damper::particles::Particles;
use crate::law::ContactLaw;

/// A particle between impulses.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mover {
    /// m/s.
    pub(super) velocity: DVec3,
    /// rad/s.
    pub(super) spin: DVec3,
    /// Velocity that a force in N gives it over the step, 1/kg s.
    pub(super) gain: f64,
    /// Spin that a torque in N m gives it over the step, 1/(kg m^2) s.
    pub(super) turn: f64,
}

impl Mover {
    /// Takes a force and a torque for the length of the step.
    #[inline(always)]
    pub(super) fn take(&mut self, force: DVec3, torque: DVec3) {
        self.velocity += force * self.gain;
        self.spin += torque * self.turn;
    }
}

/// Two bodies in reach of each other: where they stand, which lasts for the step, and what the contact
/// remembers of its impulses so far.
#[derive(Debug, Clone, Copy)]
pub(super) struct Joint<M> {
    /// Slots of both, or slot and number of the wall.
    pub(super) bodies: [u32; 2],
    /// Number of their cavity.
    pub(super) cavity: u32,
    /// Whether the memory counts: of the step before at first, then of what was given in this one.
    pub(super) remembers: bool,
    /// Zero for a wall.
    pub(super) radii: [f64; 2],
    /// From the second body to the first.
    pub(super) normal: DVec3,
    pub(super) overlap: f64,
    pub(super) memory: M,
}

impl<M> Joint<M> {
    /// The contact of two particles.
    #[inline(always)]
    pub(super) fn between(&self, [first, second]: [&Mover; 2], container: &Container) -> Contact {
        let velocity = first.velocity - second.velocity;
        self.contact(velocity, [first.spin, second.spin], &container.air[0])
    }

    /// The contact of a particle with a wall of a container.
    #[inline(always)]
    pub(super) fn at_wall(&self, mover: &Mover, container: &Container) -> Contact {
        let velocity = mover.velocity - container.velocity;
        self.contact(velocity, [mover.spin, DVec3::ZERO], &container.air[1])
    }

    #[inline(always)]
    fn contact(&self, velocity: DVec3, spins: [DVec3; 2], air: &Air) -> Contact {
        let turning = spins[0] * self.radii[0] + spins[1] * self.radii[1];
        let velocity = velocity - turning.cross(self.normal);
        Contact {
            normal: self.normal,
            overlap: self.overlap,
            velocity,
            velocity_ahead: velocity + air.ahead,
            fall: air.fall,
            spins,
            elapsed: air.time_step,
            mobility: air.mobility,
        }
    }

    /// Force on the first body, and torques on the first and on the second.
    #[inline(always)]
    pub(super) fn resolve(&self, answer: &ContactForce) -> (DVec3, DVec3, DVec3) {
        let force = self.normal * answer.normal + answer.tangential;
        let turn = answer.tangential.cross(self.normal);
        let first = turn * self.radii[0] + answer.couple;
        let second = turn * self.radii[1] - answer.couple;
        (force, first, second)
    }
}

/// What contacts of one kind in one cavity have in common.
#[derive(Debug, Clone, Copy)]
pub(super) struct Air {
    /// Relative velocity that all but contacts add over the step, m/s.
    pub(super) ahead: DVec3,
    /// Speed that a free particle gains on the container over the step, m/s.
    pub(super) fall: f64,
    pub(super) time_step: f64,
    /// Of the wall, 1/kg.
    pub(super) mobility: DMat3,
}

/// A container between impulses.
#[derive(Debug, Clone, Copy)]
pub(super) struct Container {
    /// Velocity after the impulses so far, m/s.
    pub(super) velocity: DVec3,
    /// Where it was when impulses were struck.
    pub(super) origin: DVec3,
    /// For contacts of two particles, and for those with walls.
    pub(super) air: [Air; 2],
}

/// All that the impulses of a step are worked out with.
#[derive(Debug, Clone)]
pub(crate) struct Joints<L: ContactLaw> {
    pub(super) pairs: Vec<Joint<L::Memory>>,
    pub(super) walls: Vec<Joint<L::Memory>>,
    /// Coefficients of each pair, unless all have the same.
    pub(super) kinds: Vec<L::Coefficients>,
    pub(super) movers: Vec<Mover>,
    pub(super) containers: Vec<Container>,
    /// Velocities of the mount's coordinates after the impulses so far.
    pub(super) rates: Vec<f64>,
    /// What the joints answered to the velocities at the start of the step, pairs and then walls.
    pub(super) answers: Vec<ContactForce>,
    /// What every joint has given in the step so far, pairs and then walls, if an observer wants to
    /// know.
    pub(super) given: Vec<ContactForce>,
}

impl<L: ContactLaw> Default for Joints<L> {
    fn default() -> Self {
        Self {
            pairs: Vec::new(),
            walls: Vec::new(),
            kinds: Vec::new(),
            movers: Vec::new(),
            containers: Vec::new(),
            rates: Vec::new(),
            answers: Vec::new(),
            given: Vec::new(),
        }
    }
}

impl<L: ContactLaw> Joints<L> {
    /// Empties the lists, and makes room for as many joints.
    pub(super) fn clear(&mut self, pairs: usize, walls: usize) {
        self.pairs.clear();
        self.walls.clear();
        self.kinds.clear();
        self.given.clear();
        make_room(&mut self.pairs, pairs);
        make_room(&mut self.walls, walls);
        self.answers.clear();
        make_room(&mut self.answers, pairs + walls);
    }

    /// Sets particles and mount to their velocities at the start of the step.
    pub(super) fn start(&mut self, particles: &Particles, rates: &[f64], time_step: f64) {
        self.movers.clear();
        let motions = particles.velocity.iter().zip(particles.spin.iter());
        let inverse = particles
            .inverse_mass
            .iter()
            .zip(&particles.inverse_inertia);
        let movers = motions
            .zip(inverse)
            .map(|((velocity, spin), (mass, inertia))| Mover {
                velocity,
                spin,
                gain: mass * time_step,
                turn: inertia * time_step,
            });
        self.movers.extend(movers);
        self.rates.clear();
        self.rates.extend_from_slice(rates);
    }

    /// Memory in bytes that is reserved.
    pub(crate) const fn reserved_bytes(&self) -> usize {
        size_of::<Joint<L::Memory>>() * (self.pairs.capacity() + self.walls.capacity())
            + size_of::<L::Coefficients>() * self.kinds.capacity()
            + size_of::<Mover>() * self.movers.capacity()
            + size_of::<ContactForce>() * (self.answers.capacity() + self.given.capacity())
    }
}
