//! Joints: contacts in reach, as a step's impulses see them.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use glam::{DMat3, DVec3};

use crate::cavity::Cavity;
use crate::contact::{Contact, ContactForce};
use crate::damper::candidates::{Candidates, Touch, make_room};
use crate::damper::particles::Particles;
use crate::damper::scene::{Scene, World, at_surface, meeting, resolve};
use crate::damper::vectors::{axial, polar};
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
    pub(super) fn take<const PLANAR: bool>(&mut self, force: DVec3, torque: DVec3) {
        if PLANAR {
            self.velocity.x += force.x * self.gain;
            self.velocity.y += force.y * self.gain;
            self.spin.z += torque.z * self.turn;
        } else {
            self.velocity += force * self.gain;
            self.spin += torque * self.turn;
        }
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

impl<M: Default> Joint<M> {
    /// Notes whether `answer` is any, without which there is nothing to remember.
    #[inline(always)]
    pub(super) fn goes_on(&mut self, answer: &ContactForce) -> bool {
        self.remembers = *answer != ContactForce::default();
        if !self.remembers {
            self.memory = M::default();
        }
        self.remembers
    }
}

impl<M> Joint<M> {
    /// The contact of two particles. With `PLANAR` all motion is in the plane z = 0.
    #[inline(always)]
    pub(super) fn between<const PLANAR: bool>(
        &self,
        movers: &[Mover],
        containers: &[Container],
    ) -> Contact {
        let [first, second] = self.bodies.map(|slot| &movers[slot as usize]);
        let velocity = polar::<PLANAR>(first.velocity) - polar::<PLANAR>(second.velocity);
        let spins = [first.spin, second.spin].map(axial::<PLANAR>);
        let normal = polar::<PLANAR>(self.normal);
        let surroundings = &containers[self.cavity as usize].surroundings;
        self.contact::<PLANAR>(normal, velocity, spins, surroundings)
    }

    /// The contact of a particle with a wall. With `PLANAR` all motion is in the plane z = 0.
    #[inline(always)]
    pub(super) fn at_wall<const PLANAR: bool>(
        &self,
        movers: &[Mover],
        containers: &[Container],
    ) -> Contact {
        let mover = &movers[self.bodies[0] as usize];
        let container = &containers[self.cavity as usize];
        let velocity = polar::<PLANAR>(mover.velocity) - polar::<PLANAR>(container.velocity);
        let spins = [axial::<PLANAR>(mover.spin), DVec3::ZERO];
        let normal = polar::<PLANAR>(self.normal);
        let surroundings = &container.surroundings;
        let contact = self.contact::<PLANAR>(normal, velocity, spins, surroundings);
        Contact {
            velocity_ahead: contact.velocity + polar::<PLANAR>(surroundings.ahead),
            mobility: surroundings.mobility,
            ..contact
        }
    }

    #[inline(always)]
    fn contact<const PLANAR: bool>(
        &self,
        normal: DVec3,
        velocity: DVec3,
        spins: [DVec3; 2],
        surroundings: &Surroundings,
    ) -> Contact {
        let velocity = at_surface::<PLANAR>(normal, velocity, spins, self.radii);
        Contact {
            spins,
            fall: surroundings.fall,
            elapsed: surroundings.time_step,
            ..Contact::new(normal, self.overlap, velocity)
        }
    }

    /// Force on the first body, and torques on both.
    #[inline(always)]
    pub(super) fn resolve<const PLANAR: bool>(&self, answer: &ContactForce) -> (DVec3, [DVec3; 2]) {
        resolve::<PLANAR, true>(polar::<PLANAR>(self.normal), self.radii, answer)
    }
}

/// The coefficients of a pair: those that all have, or its own among `kinds`.
#[inline(always)]
pub(super) fn kind_of_pair<'a, C, L: ContactLaw>(
    world: &'a World<C, L>,
    kinds: &'a [L::Coefficients],
    number: usize,
) -> &'a L::Coefficients {
    let only = world.coefficients.only_pair();
    only.unwrap_or_else(|| &kinds[number])
}

/// What happens to all bodies in a cavity over the step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surroundings {
    /// Velocity that a free particle gains on the container over the step, m/s.
    pub(super) ahead: DVec3,
    /// As a speed.
    pub(super) fall: f64,
    pub(super) time_step: f64,
    /// Of the container, 1/kg.
    pub(super) mobility: DMat3,
}

/// A container between impulses.
#[derive(Debug, Clone, Copy)]
pub(super) struct Container {
    /// Velocity after the impulses so far, m/s.
    pub(super) velocity: DVec3,
    /// Where it was when impulses were struck.
    pub(super) origin: DVec3,
    pub(super) surroundings: Surroundings,
}

/// All that the impulses of a step are worked out with.
#[derive(Debug, Clone)]
pub(crate) struct Joints<L: ContactLaw> {
    pub(super) pairs: Vec<Joint<L::Memory>>,
    pub(super) walls: Vec<Joint<L::Memory>>,
    /// Coefficients of each pair, unless all have the same.
    pub(super) kinds: Vec<L::Coefficients>,
    /// The particles at the start of the step.
    pub(super) starts: Vec<Mover>,
    /// The particles after the impulses so far.
    pub(super) movers: Vec<Mover>,
    /// The round in which each particle was notably changed last, counted from one; zero for none.
    pub(super) changed: Vec<u8>,
    pub(super) containers: Vec<Container>,
    /// Velocities of the mount's coordinates after the impulses so far.
    pub(super) rates: Vec<f64>,
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
            starts: Vec::new(),
            movers: Vec::new(),
            changed: Vec::new(),
            containers: Vec::new(),
            rates: Vec::new(),
            given: Vec::new(),
        }
    }
}

impl<L: ContactLaw> Joints<L> {
    /// Lists with room for so many joints of pairs, and of walls.
    pub(crate) fn with_room(joints: usize) -> Self {
        let mut own = Self::default();
        own.clear(joints, joints);
        own
    }

    /// Empties the lists, and makes room for as many joints.
    pub(super) fn clear(&mut self, pairs: usize, walls: usize) {
        self.pairs.clear();
        self.walls.clear();
        self.kinds.clear();
        self.given.clear();
        make_room(&mut self.pairs, pairs);
        make_room(&mut self.walls, walls);
    }

    /// Adds a pair in reach, and returns its overlap in m.
    #[inline(always)]
    pub(super) fn add_pair<C: Cavity>(
        &mut self,
        scene: &Scene<'_, C, L>,
        list: &Candidates<L>,
        touch: Touch,
        cavity: usize,
    ) -> f64 {
        let [i, j] = touch.bodies.map(|slot| slot as usize);
        let radii = [scene.radius[i], scene.radius[j]];
        let towards = scene.position.get(i) - scene.position.get(j);
        let (normal, overlap) = meeting::<false>(towards, radii);
        let remembered = list.touched(touch.place, scene.stamp);
        self.pairs.push(Joint {
            bodies: touch.bodies,
            cavity: cavity as u32,
            remembers: remembered.is_some(),
            radii,
            normal,
            overlap,
            memory: remembered.copied().unwrap_or_default(),
        });
        if scene.coefficients.only_pair().is_none() {
            let own = list.prepared(touch.place);
            let [first, second] = [scene.species[i], scene.species[j]];
            self.kinds.push(scene.coefficients.pair(first, second, own));
        }
        overlap
    }

    /// Adds a wall in reach of a particle, and returns their overlap in m.
    #[inline(always)]
    pub(super) fn add_wall<C: Cavity>(
        &mut self,
        scene: &Scene<'_, C, L>,
        list: &Candidates<L>,
        touch: Touch,
    ) -> f64 {
        let (slot, wall) = (touch.bodies[0] as usize, touch.bodies[1]);
        let point = scene.wall_point(wall, scene.position.get(slot));
        let radius = scene.radius[slot];
        let overlap = radius - point.distance;
        let remembered = list.touched(touch.place, scene.stamp);
        self.walls.push(Joint {
            bodies: touch.bodies,
            cavity: scene.cavity_of_wall(wall) as u32,
            remembers: remembered.is_some(),
            radii: [radius, 0.0],
            normal: point.normal,
            overlap,
            memory: remembered.copied().unwrap_or_default(),
        });
        overlap
    }

    /// Takes over the velocities at the start of the step.
    pub(super) fn start(&mut self, particles: &Particles, time_step: f64) {
        let count = particles.len();
        let (velocity, spin) = (particles.velocity.rows(), particles.spin.rows());
        let inverse = (
            &particles.inverse_mass[..count],
            &particles.inverse_inertia[..count],
        );
        self.starts.clear();
        self.starts.extend((0..count).map(|slot| Mover {
            velocity: velocity.get(slot),
            spin: spin.get(slot),
            gain: inverse.0[slot] * time_step,
            turn: inverse.1[slot] * time_step,
        }));
    }

    /// Memory in bytes that is reserved.
    pub(crate) const fn reserved_bytes(&self) -> usize {
        size_of::<Joint<L::Memory>>() * (self.pairs.capacity() + self.walls.capacity())
            + size_of::<L::Coefficients>() * self.kinds.capacity()
            + size_of::<Mover>() * (self.starts.capacity() + self.movers.capacity())
            + self.changed.capacity()
            + size_of::<ContactForce>() * self.given.capacity()
    }
}
