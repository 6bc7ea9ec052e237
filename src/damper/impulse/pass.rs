//! Going through all contacts once.

use std::ops::AddAssign;

use glam::{DMat3, DVec3};

use super::struck;
use crate::cavity::Cavity;
use crate::contact::{Contact, ContactForce};
use crate::damper::Partner;
use crate::damper::block::Place;
use crate::damper::candidates::Candidates;
use crate::damper::engine::Engine;
use crate::damper::scene::{PairContact, wall_contact};
use crate::damper::vectors::vector;
use crate::detector::Detector;
use crate::law::ContactLaw;
use crate::mount::Mount;

/// How contacts are gone through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Pass {
    /// Each gives this part of what it remembers of a step.
    Carried { part: f64, stamp: u32 },
    /// All from the velocities at the start of the step.
    Simultaneous,
    /// Each with the velocities that those before it left.
    Sequential { ascending: bool },
}

/// What came of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Passed {
    /// Largest speed in m/s at which two bodies approached that were struck.
    pub(super) approach: f64,
    /// Power in W of the forces, at the velocities which they met.
    pub(super) power: f64,
    /// Whether there was any force.
    pub(super) any: bool,
}

impl Passed {
    const NOTHING: Self = Self {
        approach: 0.0,
        power: 0.0,
        any: false,
    };

    fn count(&mut self, contact: &Contact, answer: &ContactForce) {
        let force = contact.normal * answer.normal + answer.tangential;
        let spin = contact.spins[0] - contact.spins[1];
        let ahead = -contact.velocity_ahead.dot(contact.normal);
        self.approach = self.approach.max(contact.approach_speed()).max(ahead.abs());
        self.power += force.dot(contact.velocity_ahead) + answer.couple.dot(spin);
        self.any = true;
    }
}

impl AddAssign for Passed {
    fn add_assign(&mut self, other: Self) {
        self.approach = self.approach.max(other.approach);
        self.power += other.power;
        self.any |= other.any;
    }
}

impl Pass {
    const fn is_ascending(self) -> bool {
        !matches!(self, Self::Sequential { ascending: false })
    }

    const fn is_sequential(self) -> bool {
        matches!(self, Self::Sequential { .. })
    }

    /// Whether there is nothing to do for a contact at `place` in `list`.
    #[inline]
    fn skips<L: ContactLaw>(self, list: &Candidates<L>, place: u32) -> bool {
        matches!(self, Self::Carried { stamp, .. } if !list.remembers(place, stamp))
    }

    /// The law's answer to a contact at `place` in `list`; `stamp` is the last step's.
    #[inline(always)]
    fn ask<L: ContactLaw>(
        self,
        law: &L,
        kind: &L::Coefficients,
        contact: &Contact,
        (list, place, stamp): (&mut Candidates<L>, u32, u32),
    ) -> ContactForce {
        let now = stamp.wrapping_add(1);
        let remembered = match self {
            Self::Carried { stamp, .. } => stamp,
            Self::Simultaneous => stamp,
            Self::Sequential { .. } => now,
        };
        let mut memory = list.memory(place, remembered);
        let answer = match self {
            Self::Carried { part, .. } => law.carry(kind, contact, &mut memory, part),
            Self::Simultaneous => return law.force(kind, contact, &memory),
            Self::Sequential { .. } => law.strike(kind, contact, &mut memory),
        };
        // A part that was given before is taken back even where nothing is left of it.
        if answer != ContactForce::default()
            || matches!(self, Self::Carried { part, .. } if part < 1.0)
        {
            list.keep(place, now, memory);
        }
        answer
    }
}

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Strikes all pairs, then all walls.
    pub(super) fn pass(&mut self, pass: Pass, time_step: f64) -> Passed {
        let mut passed = self.pass_pairs(pass, time_step);
        passed += self.pass_walls(pass, time_step);
        passed
    }

    fn pass_pairs(&mut self, pass: Pass, time_step: f64) -> Passed {
        let mut passed = Passed::NOTHING;
        let particles = &self.particles;
        let scene = self.world.scene(particles, time_step);
        let scratch = &mut self.scratch;
        let (velocity, spin) = (&mut scratch.velocity, &mut scratch.spin);
        let mut first = 0;
        for block in &mut self.blocks {
            let border = first + block.pairs.contacts.len();
            let end = border + block.border.contacts.len();
            let mut lists = [(first, &mut block.pairs), (border, &mut block.border)];
            first = end + block.walls.contacts.len();
            if !pass.is_ascending() {
                lists.reverse();
            }
            for (first, list) in lists {
                let count = list.contacts.len();
                for turn in 0..count {
                    let ascending = pass.is_ascending();
                    let number = if ascending { turn } else { count - 1 - turn };
                    let touch = list.touch(number);
                    if pass.skips(list, touch.place) {
                        continue;
                    }
                    let [i, j] = touch.bodies.map(|slot| slot as usize);
                    let mut pair = if pass.is_sequential() {
                        let grain = |slot| struck(&scene, slot, velocity, spin);
                        PairContact::new(&grain(i), &grain(j), time_step)
                    } else {
                        PairContact::new(&scene.grain(i), &scene.grain(j), time_step)
                    };
                    let inverse_mass = DVec3::splat(particles.inverse_mass[j]);
                    pair.contact.mobility = DMat3::from_diagonal(inverse_mass);
                    pair.contact.fall = scratch.fall[self.world.cavity_of(i)];
                    let own = list.prepared(touch.place);
                    let kinds = (particles.species[i], particles.species[j]);
                    let kind = scene.coefficients.pair(kinds.0, kinds.1, own);
                    let place = (&mut *list, touch.place, scene.stamp);
                    let answer = pass.ask(scene.law, &kind, &pair.contact, place);

                    block.largest_overlap = block.largest_overlap.max(pair.contact.overlap);
                    if answer == ContactForce::default() {
                        continue;
                    }
                    passed.count(&pair.contact, &answer);
                    let (force, turn, other) = pair.resolve(&answer);
                    velocity[i] += force * (time_step * particles.inverse_mass[i]);
                    velocity[j] -= force * (time_step * particles.inverse_mass[j]);
                    spin[i] += turn * (time_step * particles.inverse_inertia[i]);
                    spin[j] += other * (time_step * particles.inverse_inertia[j]);
                    if let Some(given) = scratch.given.get_mut(first + number) {
                        given.add(&answer);
                    }
                }
            }
        }
        passed
    }

    fn pass_walls(&mut self, pass: Pass, time_step: f64) -> Passed {
        let mut passed = Passed::NOTHING;
        let degrees = self.mount.degrees();
        let particles = &self.particles;
        let scene = self.world.scene(&self.particles, time_step);
        let scratch = &mut self.scratch;
        let (velocity, spin) = (&mut scratch.velocity, &mut scratch.spin);
        let rates = &mut scratch.rates;
        let gravity = self.gravity * time_step;
        let mut first = 0;
        for block in &mut self.blocks {
            first += block.pairs.contacts.len() + block.border.contacts.len();
            for number in 0..block.walls.contacts.len() {
                let touch = block.walls.touch(number);
                if pass.skips(&block.walls, touch.place) {
                    continue;
                }
                let (slot, wall) = (touch.bodies[0] as usize, touch.bodies[1]);
                let cavity = scene.cavity_of_wall(wall);
                let room = &self.world.rooms[cavity];
                let point = scene.wall_point(wall, vector(&scene.position, slot));
                let mut contact = if pass.is_sequential() {
                    let coordinates = &self.mount_state.position[..degrees];
                    let container = self.mount.motion(self.time, coordinates, rates, cavity);
                    let grain = struck(&scene, slot, velocity, spin);
                    wall_contact(&grain, &point, container.velocity, time_step)
                } else {
                    wall_contact(&scene.grain(slot), &point, room.motion.velocity, time_step)
                };
                contact.velocity_ahead = contact.velocity + gravity - scratch.gain[cavity];
                contact.fall = scratch.fall[cavity];
                contact.mobility = self.mount.mobility(cavity);
                let kind = scene.coefficients.wall(particles.species[slot]);
                let place = (&mut block.walls, touch.place, scene.stamp);
                let answer = pass.ask(scene.law, kind, &contact, place);

                block.largest_overlap = block.largest_overlap.max(contact.overlap);
                if point.distance < 0.0 {
                    let partner = Partner::Wall(wall - room.first_wall);
                    block.escaped = Some(Place { slot, partner });
                }
                if answer == ContactForce::default() {
                    continue;
                }
                passed.count(&contact, &answer);
                let force = contact.normal * answer.normal + answer.tangential;
                let arm = contact.normal * -particles.radius[slot];
                let torque = arm.cross(answer.tangential) + answer.couple;
                velocity[slot] += force * (time_step * particles.inverse_mass[slot]);
                spin[slot] += torque * (time_step * particles.inverse_inertia[slot]);
                self.mount.strike(cavity, -force * time_step, rates);
                let place = particles.position.get(slot) - room.motion.position + arm;
                self.wall_loads[wall as usize].react(force, answer.couple, place);
                if let Some(given) = scratch.given.get_mut(first + number) {
                    given.add(&answer);
                }
            }
            first += block.walls.contacts.len();
        }
        passed
    }
}
