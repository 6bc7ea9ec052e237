//! What a damper is set up of, told apart by how its parts behave.

use glam::{DVec3, dvec3};

use super::{Coefficients, Model, State};
use crate::cavity::Cavity;
use crate::contact::{Body, Contact};
use crate::digest::Digest;
use crate::law::{ContactLaw, ForceLaw, ImpulseLaw, LawKind, LawVisitor};
use crate::mount::Mobility;

/// The setup of a damper, as far as its state means nothing without it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Setup {
    time_step: f64,
    gravity: DVec3,
    kinds: Digest,
    cavities: Digest,
    law: Digest,
    mount: Digest,
}

impl Setup {
    /// Adds all of it.
    pub(crate) fn add_to(&self, digest: &mut Digest) {
        digest.number(self.time_step);
        digest.vector(self.gravity);
        for part in [self.kinds, self.cavities, self.law, self.mount] {
            digest.add(part);
        }
    }

    /// The setup of `state`, as it was built, under a `model`.
    pub(crate) fn new<C: Cavity, L: ContactLaw>(model: &Model<C, L>, state: &State) -> Self {
        let mut cavities = Digest::default();
        let mut mount = Digest::default();
        cavities.word(model.cavities.len() as u64);
        mount.word(state.degrees as u64);
        for number in state.mobilities.all().iter().flat_map(Mobility::numbers) {
            mount.number(number);
        }
        for cavity in &model.cavities {
            add_cavity(&mut cavities, cavity);
        }
        if model.cavities.len() > 1 {
            cavities.words(&state.particles.id);
        }
        Self {
            time_step: state.time_step,
            gravity: state.gravity,
            kinds: of_kinds(&state.particles.kinds),
            cavities,
            law: of_law(&model.law, &model.coefficients, &state.particles.kinds),
            mount,
        }
    }

    /// The same under steps of another length (s).
    pub(crate) const fn under_steps_of(mut self, time_step: f64) -> Self {
        self.time_step = time_step;
        self
    }

    /// What differs first in `other`.
    pub(crate) fn difference(&self, other: &Self) -> Option<&'static str> {
        [
            ("bed: radii, masses or materials", self.kinds == other.kinds),
            ("set of cavities", self.cavities == other.cavities),
            (
                "time step",
                self.time_step.to_bits() == other.time_step.to_bits(),
            ),
            ("gravity", self.gravity == other.gravity),
            ("contact law", self.law == other.law),
            ("mount", self.mount == other.mount),
        ]
        .into_iter()
        .find_map(|(quantity, same)| (!same).then_some(quantity))
    }
}

/// Overlaps (in radii) and velocities (m/s, relative and of the surface) of the contacts that laws are told
/// apart by: shallow and deep, met and parted, at rest, creeping and sliding.
const PROBES: [(f64, DVec3); 6] = [
    (1e-4, DVec3::ZERO),
    (1e-2, dvec3(-0.3, 0.11, 0.07)),
    (1e-2, dvec3(-1e-3, 1e-4, -3e-5)),
    (1e-1, dvec3(-2.0, -1.3, 0.4)),
    (1e-1, dvec3(0.2, 1e-3, 0.0)),
    (5e-2, dvec3(1e-3, 0.0, 5e-2)),
];

/// Adds what `law` answers two bodies in contacts that are the same everywhere.
fn add_answers<L: ContactLaw>(
    digest: &mut Digest,
    law: &L,
    coefficients: &L::Coefficients,
    radius: f64,
) {
    digest.number(law.time_step_limit(coefficients));
    L::Kind::accept(AddAnswers {
        digest,
        law,
        coefficients,
        radius,
    });
}

/// What a law answers at the probes.
struct AddAnswers<'a, L: ContactLaw> {
    digest: &'a mut Digest,
    law: &'a L,
    coefficients: &'a L::Coefficients,
    radius: f64,
}

impl<L: ContactLaw> LawVisitor<L> for AddAnswers<'_, L> {
    type Output = ();

    fn forces(self)
    where
        L: ForceLaw,
    {
        for (depth, velocity) in PROBES {
            let mut contact = Contact::new(DVec3::X, depth * self.radius, velocity);
            contact.spins = [dvec3(10.0, -20.0, 30.0), dvec3(-5.0, 15.0, 2.5)];
            contact.elapsed = 1e-4;
            let memory = L::Memory::default();
            let force = self.law.force(self.coefficients, &contact, &memory);
            self.digest.number(force.normal);
            self.digest.vector(force.tangential);
            self.digest.vector(force.couple);
        }
    }

    fn impulses(self)
    where
        L: ImpulseLaw,
    {
        let Self {
            digest,
            law,
            coefficients,
            ..
        } = self;
        for speed in [1e-3, 0.1, 1.0, 10.0] {
            digest.number(law.restitution(coefficients, speed));
        }
        digest.number(law.friction(coefficients));
        digest.number(law.rolling_arm(coefficients));
        law.solver().tell(&mut |number| digest.number(number));
    }
}

/// A law by its answers for each kind at a wall, and against itself and its neighbour.
fn of_law<L: ContactLaw>(law: &L, table: &Coefficients<L::Coefficients>, kinds: &[Body]) -> Digest {
    let mut digest = Digest::default();
    digest.number(law.design_speed());
    let count = kinds.len() as u32;
    for (kind, body) in (0..count).zip(kinds) {
        add_answers(&mut digest, law, table.wall(kind), body.radius);
        if !table.is_by_pair() {
            for other in [kind, (kind + 1) % count] {
                let pair = table.pair(kind, other, None);
                add_answers(&mut digest, law, &pair, body.radius);
            }
        }
    }
    digest
}

fn of_kinds(kinds: &[Body]) -> Digest {
    let mut digest = Digest::default();
    for kind in kinds {
        digest.numbers(&[kind.radius, kind.mass]);
        digest.word(u64::from(kind.material.0));
    }
    digest
}

/// Adds a cavity by its walls as they stand to the corners of its bounds.
fn add_cavity<C: Cavity>(digest: &mut Digest, cavity: &C) {
    let [low, high] = cavity.bounds();
    digest.vectors(&[low, high]);
    digest.words(&[cavity.walls(), u32::from(cavity.is_planar())]);
    for corner in 0..8_u32 {
        let pick = DVec3::from_array([0, 1, 2].map(|axis| f64::from(corner >> axis & 1)));
        for number in 0..cavity.walls() {
            let wall = cavity.wall(number, low + (high - low) * pick);
            digest.vector(wall.normal);
            digest.number(wall.distance);
        }
    }
}
