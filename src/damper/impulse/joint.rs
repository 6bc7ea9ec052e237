//! Joints: contacts in reach, as a step's impulses see them.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use glam::{DMat3, DVec3};

use crate::cavity::Cavity;
use crate::contact::{Contact, ContactForce};
use crate::damper::candidates::{Candidates, make_room};
use crate::damper::particles::Particles;
use crate::damper::scene::{Scene, World, at_surface, meeting, resolve};
use crate::damper::vectors::{axial, polar};
use crate::law::{ContactLaw, at_least};

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

/// Two bodies in reach of each other: where they stand, which lasts for the step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Joint {
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
}

impl Joint {
    /// Notes whether `answer` is any, without which there is nothing to remember.
    #[inline(always)]
    pub(super) fn goes_on<M: Default>(&mut self, answer: &ContactForce, memory: &mut M) -> bool {
        self.remembers = *answer != ContactForce::default();
        if !self.remembers {
            *memory = M::default();
        }
        self.remembers
    }

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

/// Joints, and what they remember of their impulses so far.
#[derive(Debug, Clone)]
pub(super) struct Group<M> {
    pub(super) joints: Vec<Joint>,
    /// As many, and what is left of a step that had more.
    pub(super) memories: Vec<M>,
}

impl<M: Copy + Default> Group<M> {
    const fn new() -> Self {
        Self {
            joints: Vec::new(),
            memories: Vec::new(),
        }
    }

    /// Empties the group, and makes room for as many joints.
    fn clear(&mut self, joints: usize) {
        self.joints.clear();
        make_room(&mut self.joints, joints);
        if self.memories.len() < joints {
            make_room(&mut self.memories, joints);
            self.memories.resize(joints, M::default());
        }
    }

    /// Adds the contacts of a list, each as `joint` has it from its two bodies.
    #[inline(always)]
    fn add<L: ContactLaw<Memory = M>>(
        &mut self,
        list: &Candidates<L>,
        stamp: u32,
        joint: impl FnMut([u32; 2]) -> Joint,
    ) {
        let start = self.joints.len();
        let bodies = list.contacts.bodies().iter().copied();
        self.joints.extend(bodies.map(joint));
        let joints = &mut self.joints[start..];
        let places = list.contacts.places();
        for ((place, joint), memory) in places.iter().zip(joints).zip(&mut self.memories[start..]) {
            // Each straight to its place: through a temporary it would be copied twice.
            match list.touched(*place, stamp) {
                Some(remembered) => {
                    *memory = *remembered;
                    joint.remembers = true;
                }
                None => *memory = M::default(),
            }
        }
    }

    /// The joints with their memories.
    pub(super) fn iter_mut(&mut self) -> impl Iterator<Item = (&mut Joint, &mut M)> {
        self.joints.iter_mut().zip(&mut self.memories)
    }

    /// What those joints remember that do, in turn for every joint.
    pub(super) fn remembered(&self) -> impl Iterator<Item = Option<&M>> {
        let all = self.joints.iter().zip(&self.memories);
        all.map(|(joint, memory)| joint.remembers.then_some(memory))
    }

    const fn reserved_bytes(&self) -> usize {
        size_of::<Joint>() * self.joints.capacity() + size_of::<M>() * self.memories.capacity()
    }
}

/// All that the impulses of a step are worked out with.
#[derive(Debug, Clone)]
pub(crate) struct Joints<L: ContactLaw> {
    pub(super) pairs: Group<L::Memory>,
    pub(super) walls: Group<L::Memory>,
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
            pairs: Group::new(),
            walls: Group::new(),
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
        self.pairs.clear(pairs);
        self.walls.clear(walls);
        self.kinds.clear();
        self.given.clear();
    }

    /// Adds the pairs of a list, and returns their largest overlap in m.
    pub(super) fn add_pairs<C: Cavity, const PLANAR: bool>(
        &mut self,
        scene: &Scene<'_, C, L>,
        list: &Candidates<L>,
    ) -> f64 {
        let position = scene.position.polar::<PLANAR>(scene.radius.len());
        let mut deepest = 0.0;
        let mut cavity = 0;
        self.pairs.add(list, scene.stamp, |bodies| {
            let [i, j] = bodies.map(|slot| slot as usize);
            let radii = [scene.radius[i], scene.radius[j]];
            let towards = position.get(i) - position.get(j);
            let (normal, overlap) = meeting::<PLANAR>(towards, radii);
            deepest = at_least(overlap, deepest);
            // Pairs come in the order of their lower slots, and so of their cavities.
            while i >= scene.rooms[cavity].slots.end {
                cavity += 1;
            }
            Joint {
                bodies,
                cavity: cavity as u32,
                remembers: false,
                radii,
                normal,
                overlap,
            }
        });
        if scene.coefficients.only_pair().is_none() {
            let contacts = &list.contacts;
            let kinds = contacts.bodies().iter().zip(contacts.places());
            self.kinds.extend(kinds.map(|(bodies, place)| {
                let [first, second] = bodies.map(|slot| scene.species[slot as usize]);
                let own = list.prepared(*place);
                scene.coefficients.pair(first, second, own)
            }));
        }
        deepest
    }

    /// Adds the walls of a list, and returns their largest overlap in m. Tells `escaped` of particles
    /// that are more than a radius behind one.
    pub(super) fn add_walls<C: Cavity>(
        &mut self,
        scene: &Scene<'_, C, L>,
        list: &Candidates<L>,
        mut escaped: impl FnMut(usize, u32),
    ) -> f64 {
        let mut deepest = 0.0;
        self.walls.add(list, scene.stamp, |bodies| {
            let (slot, wall) = (bodies[0] as usize, bodies[1]);
            let point = scene.wall_point(wall, scene.position.get(slot));
            let radius = scene.radius[slot];
            let overlap = radius - point.distance;
            deepest = at_least(overlap, deepest);
            if overlap > radius {
                escaped(slot, wall);
            }
            Joint {
                bodies,
                cavity: scene.cavity_of_wall(wall) as u32,
                remembers: false,
                radii: [radius, 0.0],
                normal: point.normal,
                overlap,
            }
        });
        deepest
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
        self.pairs.reserved_bytes()
            + self.walls.reserved_bytes()
            + size_of::<L::Coefficients>() * self.kinds.capacity()
            + size_of::<Mover>() * (self.starts.capacity() + self.movers.capacity())
            + self.changed.capacity()
            + size_of::<ContactForce>() * self.given.capacity()
    }
}
