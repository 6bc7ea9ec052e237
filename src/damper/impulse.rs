//! Impulse laws: one evaluation at the start of a step, held over the step.

use super::Partner;
use super::block::{Block, Place};
use super::candidates::Candidates;
use super::engine::Engine;
use super::error::StepError;
use super::scene::WallLoad;
use super::smallest_radius;
use crate::cavity::Cavity;
use crate::contact::ContactForce;
use crate::detector::Detector;
use crate::law::{ContactLaw, Evaluation};
use crate::mount::Mount;
use crate::observer::Observer;

mod joint;
mod pass;
mod report;
mod together;

use joint::{Container, Surroundings};
use pass::Round;

pub(crate) use joint::Joints;

/// How often a contact is struck at the most.
const ROUNDS: u8 = 16;

/// How often one at rest is.
const RESTING_ROUNDS: u8 = 3;

/// Speed given in a round, as a part of what a particle gains in free fall over the step, that needs no
/// further round of contacts at rest.
const STILL: f64 = 0.02;

/// Speed given in a round, as a multiple of what a particle gains in free fall over the step, from which
/// a bed is not taken for one at rest.
const STIRRED: f64 = 100.0;

/// Way in a step at the speed given in a round, as a fraction of the smallest radius, that needs no
/// further round.
const NEGLIGIBLE: f64 = 0.01;

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Strikes all contacts, and leaves the accelerations that hold over a step of `time_step`.
    ///
    /// Where contacts follow one another, each sees the velocities that those before it left.
    pub(crate) fn strike<O: Observer>(
        &mut self,
        time_step: f64,
        observer: &mut O,
    ) -> Result<(), StepError> {
        self.place_containers(self.time)?;
        self.find_contacts(true)?;
        self.look_ahead(time_step);
        self.list_joints();
        if observer.wants_contacts() {
            let joints = self.joints.pairs.joints.len() + self.joints.walls.joints.len();
            self.joints.given.resize(joints, ContactForce::default());
        }
        self.joints.start(&self.particles, time_step);
        self.start_impulses();
        if self.world.law.evaluation() == Evaluation::Sequential {
            let resting = Candidates::<L>::REMEMBERS && self.carry_impulses(time_step);
            self.strike_in_rounds(time_step, resting);
        } else {
            self.strike_at_once();
        }
        self.keep_memories();
        if observer.wants_contacts() {
            self.report_impulses(observer);
        }
        self.hold(time_step)?;
        self.world.stamp = self.world.stamp.wrapping_add(1);
        self.accelerate_mount(self.time);
        self.check_overlaps()
    }

    /// Rounds to and fro, so that an impulse crosses the bed in one step whichever way it goes, among
    /// the particles that were notably changed, until there are none.
    fn strike_in_rounds(&mut self, time_step: f64, mut resting: bool) {
        let negligible = NEGLIGIBLE * smallest_radius(&self.particles.kinds) / time_step;
        self.joints.changed.clear();
        self.joints.changed.resize(self.particles.len(), 0);
        let containers = self.joints.containers.iter();
        let fall = containers.map(|container| container.surroundings.fall);
        let fall = fall.fold(0.0, f64::max);
        for number in 0..ROUNDS {
            resting &= number + 1 < RESTING_ROUNDS;
            let round = Round {
                number,
                negligible,
                resting,
            };
            let speed = self.strike_in_turn(&round);
            if !round.notes(speed, fall) {
                break;
            }
            resting &= speed < STIRRED * fall;
        }
    }

    /// Looks ahead to what the containers gain over the step without impulses.
    fn look_ahead(&mut self, time_step: f64) {
        self.wall_loads.fill(WallLoad::default());
        self.accelerate_mount(self.time);
        let degrees = self.mount.degrees();
        let state = &self.mount_state;
        let joints = &mut self.joints;
        let rates = state.velocity[..degrees].iter();
        let ahead = rates
            .zip(&state.acceleration)
            .map(|(v, a)| v + a * time_step);
        joints.rates.clear();
        joints.rates.extend(ahead);
        joints.containers.clear();
        let end = self.time + time_step;
        for (cavity, room) in self.world.rooms.iter().enumerate() {
            let coordinates = &state.position[..degrees];
            let ahead = self.mount.motion(end, coordinates, &joints.rates, cavity);
            let gain = ahead.velocity - room.motion.velocity;
            let ahead = self.gravity * time_step - gain;
            joints.containers.push(Container {
                velocity: room.motion.velocity,
                origin: room.motion.position,
                surroundings: Surroundings {
                    ahead,
                    fall: ahead.length(),
                    time_step,
                    mobility: self.mount.mobility(cavity),
                },
            });
        }
    }

    /// Lists the contacts in reach as they stand: of all blocks the pairs, then the walls.
    fn list_joints(&mut self) {
        let count = |list: fn(&Block<L>) -> usize| self.blocks.iter().map(list).sum();
        let pairs = count(|block| block.pairs.contacts.len() + block.border.contacts.len());
        self.joints
            .clear(pairs, count(|block| block.walls.contacts.len()));
        let scene = self.world.scene(&self.particles, 0.0);
        for block in &mut self.blocks {
            block.forget();
            block.contacts = block.contacts_in_reach();
            let mut deepest = 0.0_f64;
            for list in [&block.pairs, &block.border] {
                deepest = deepest.max(if scene.planar {
                    self.joints.add_pairs::<C, true>(&scene, list)
                } else {
                    self.joints.add_pairs::<C, false>(&scene, list)
                });
            }
            let escaped = |slot, wall| {
                let partner = Partner::Wall(wall - scene.room_of_wall(wall).first_wall);
                block.escaped = Some(Place { slot, partner });
            };
            let at_walls = self.joints.add_walls(&scene, &block.walls, escaped);
            block.largest_overlap = deepest.max(at_walls);
        }
    }

    /// Sets out from the velocities at the start of the step.
    fn start_impulses(&mut self) {
        let joints = &mut self.joints;
        joints.movers.clone_from(&joints.starts);
        joints.rates.clear();
        let rates = &self.mount_state.velocity[..self.mount.degrees()];
        joints.rates.extend_from_slice(rates);
        for (container, room) in joints.containers.iter_mut().zip(&self.world.rooms) {
            container.velocity = room.motion.velocity;
        }
        joints.given.fill(ContactForce::default());
        self.wall_loads.fill(WallLoad::default());
    }

    /// Keeps what joints remember in the lists of their contacts.
    fn keep_memories(&mut self) {
        if !Candidates::<L>::REMEMBERS {
            return;
        }
        let stamp = self.world.stamp.wrapping_add(1);
        let mut pairs = self.joints.pairs.remembered();
        let mut walls = self.joints.walls.remembered();
        for block in &mut self.blocks {
            block.pairs.keep_all(stamp, &mut pairs);
            block.border.keep_all(stamp, &mut pairs);
            block.walls.keep_all(stamp, &mut walls);
        }
    }

    /// Refuses particles that a container has left behind in the step: where it moves by more than a
    /// radius, the walls that meet them are not looked at before the next.
    pub(crate) fn check_left_behind(&self) -> Result<(), StepError> {
        let radius = smallest_radius(&self.particles.kinds);
        for (room, container) in self.world.rooms.iter().zip(&self.joints.containers) {
            let position = room.motion.position;
            if !self.contained || position.distance(container.origin) <= radius {
                continue;
            }
            for slot in room.slots.clone() {
                let point = self.particles.position.get(slot) - position;
                let outside = |wall: &u32| room.cavity.wall(*wall, point).distance < 0.0;
                if let Some(wall) = (0..room.cavity.walls()).find(outside) {
                    return Err(self.escaped(slot, Partner::Wall(wall)));
                }
            }
        }
        Ok(())
    }

    /// Turns the velocities after the impulses into accelerations that lead to them.
    fn hold(&mut self, time_step: f64) -> Result<(), StepError> {
        let (joints, particles) = (&self.joints, &mut self.particles);
        let rate = 1.0 / time_step;
        for (slot, (mover, start)) in joints.movers.iter().zip(&joints.starts).enumerate() {
            let gain = mover.velocity - start.velocity;
            particles.acceleration.set(slot, gain * rate + self.gravity);
            let turn = mover.spin - start.spin;
            particles.angular_acceleration.set(slot, turn * rate);
        }
        if particles.acceleration.is_finite() && particles.angular_acceleration.is_finite() {
            Ok(())
        } else {
            self.check_accelerations()
        }
    }
}
