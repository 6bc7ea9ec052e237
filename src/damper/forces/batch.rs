//! Contacts side by side: what a law is asked of several of them, in columns.
//!
//! The law is asked in a loop over columns of numbers, without a branch of the engine's own: so the
//! compiler can answer as many contacts at a time as the processor's vectors hold. The bits are those
//! of one at a time.

// Small functions of the innermost loop: the compiler must see the loop whole.
#![allow(clippy::inline_always)]

use glam::DVec3;

use crate::cavity::Cavity;
use crate::contact::{Contact, ContactForce, Onset};
use crate::damper::neighbours::LONGEST_RUN;
use crate::damper::state::{
    Space, StateView, StepTime, force_and_torques, levers, normal_and_overlap, surface_velocity,
};
use crate::law::{ContactLaw, ContactMemory, ForceLaw};
use crate::numbers::at_least;

/// What the contacts of a batch are between.
pub(super) trait ContactKind {
    /// Whether two spheres meet; else a sphere and a wall.
    const IS_PAIR: bool;
    /// Whether the second body may be a wall that yields.
    const YIELDS: bool;
}

/// Two spheres.
pub(super) struct SpherePair;

impl ContactKind for SpherePair {
    const IS_PAIR: bool = true;
    const YIELDS: bool = false;
}

/// A sphere and a wall.
pub(super) struct SphereWall;

impl ContactKind for SphereWall {
    const IS_PAIR: bool = false;
    const YIELDS: bool = true;
}

/// A sphere and a wall whose motion is given.
struct SphereFixedWall;

impl ContactKind for SphereFixedWall {
    const IS_PAIR: bool = false;
    const YIELDS: bool = false;
}

/// How many contacts are side by side at the most.
pub(super) const BATCH_SIZE: usize = LONGEST_RUN;

type Column = [f64; BATCH_SIZE];

/// As many of `bodies` as there is room for. Loops that count them need no other comparison for the columns
/// of a batch, where an iterator over them would not let the compiler see that.
#[inline(always)]
pub(super) fn side_by_side(bodies: &[[u32; 2]]) -> &[[u32; 2]] {
    &bodies[..bodies.len().min(BATCH_SIZE)]
}

/// A column of vectors.
#[derive(Debug, Clone)]
struct Lanes {
    x: Column,
    y: Column,
    z: Column,
}

impl Lanes {
    const ZERO: Self = Self {
        x: [0.0; BATCH_SIZE],
        y: [0.0; BATCH_SIZE],
        z: [0.0; BATCH_SIZE],
    };

    #[inline(always)]
    const fn set(&mut self, n: usize, vector: DVec3) {
        self.x[n] = vector.x;
        self.y[n] = vector.y;
        self.z[n] = vector.z;
    }

    #[inline(always)]
    const fn get(&self, n: usize) -> DVec3 {
        DVec3::new(self.x[n], self.y[n], self.z[n])
    }

    /// Sets a velocity, force or direction. In the plane its z stays zero.
    #[inline(always)]
    const fn set_vector<S: Space>(&mut self, n: usize, vector: DVec3) {
        self.x[n] = vector.x;
        self.y[n] = vector.y;
        if !S::PLANAR {
            self.z[n] = vector.z;
        }
    }

    /// Sets a spin or torque. In the plane its x and y stay zero.
    #[inline(always)]
    const fn set_spin<S: Space>(&mut self, n: usize, vector: DVec3) {
        if S::PLANAR {
            self.z[n] = vector.z;
        } else {
            self.set(n, vector);
        }
    }
}

/// The columns of the state that contacts are gathered from, of one length, so that one comparison stands
/// for all their bounds.
struct Columns<'a, S: Space> {
    position: &'a [S::Row],
    velocity: &'a [S::Row],
    spin: &'a [S::SpinRow],
    radius: &'a [f64],
}

/// Where the centre of a particle is, and how it moves.
struct Centre<S: Space> {
    position: S::Vector,
    velocity: S::Vector,
    spin: S::Spin,
}

impl<'a, S: Space> Columns<'a, S> {
    #[inline(always)]
    fn new<C, L: ContactLaw>(view: &StateView<'a, C, L>) -> Self {
        let count = view.radius.len();
        Self {
            position: &S::rows(view.position.flat())[..count],
            velocity: &S::rows(view.velocity.flat())[..count],
            spin: &S::spin_rows(view.spin.flat())[..count],
            radius: view.radius,
        }
    }

    #[inline(always)]
    fn centre(&self, index: usize) -> Centre<S> {
        Centre {
            position: S::from_row(self.position[index]),
            velocity: S::from_row(self.velocity[index]),
            spin: S::from_spin_row(self.spin[index]),
        }
    }
}

/// What contacts remember, and where it is put what they will at the end of the step.
type Histories<'a, L> = (&'a [ContactMemory<L>], &'a mut [ContactMemory<L>]);

/// Up to [`BATCH_SIZE`] contacts, all of pairs or all with walls, and what the law answers.
#[derive(Clone)]
pub(super) struct Batch<L: ContactLaw> {
    count: usize,
    /// From the second body to the first: until their kinematics are [worked out](Self::work_out_kinematics), of two
    /// spheres as far as their centres are apart (m); then the normal.
    towards: Lanes,
    /// Velocity of the first centre relative to the second body's, and then of the surfaces, m/s.
    velocity: Lanes,
    spins: [Lanes; 2],
    /// Zero for a wall.
    radii: [Column; 2],
    overlap: Column,
    /// Rate of overlap, m/s.
    approach: Column,
    /// Of walls: velocity that they gain along the normal per unit impulse, 1/kg.
    wall_inverse_mass: Column,
    kinds: Vec<L::Coefficients>,
    /// Normal force, N.
    force: Column,
    /// Tangential force on the first body, and then the whole force, N.
    push: Lanes,
    /// Couple on the first body, if the law gives any, and then the torques on both, N m.
    torques: [Lanes; 2],
}

impl<L: ContactLaw> Default for Batch<L> {
    fn default() -> Self {
        Self {
            count: 0,
            towards: Lanes::ZERO,
            velocity: Lanes::ZERO,
            spins: [Lanes::ZERO; 2],
            radii: [[0.0; BATCH_SIZE]; 2],
            overlap: [0.0; BATCH_SIZE],
            approach: [0.0; BATCH_SIZE],
            wall_inverse_mass: [0.0; BATCH_SIZE],
            kinds: Vec::with_capacity(BATCH_SIZE),
            force: [0.0; BATCH_SIZE],
            push: Lanes::ZERO,
            torques: [Lanes::ZERO; 2],
        }
    }
}

impl<L: ForceLaw> Batch<L> {
    /// Makes ready for pairs, whose bodies may all be of `only` one radius (m).
    pub(super) fn begin_pairs(&mut self, only: Option<f64>) {
        if let Some(radius) = only {
            self.radii = [[radius; BATCH_SIZE]; 2];
        }
    }

    /// Takes over the pairs of `bodies`, at most [`BATCH_SIZE`] of them.
    #[inline(always)]
    #[allow(clippy::needless_range_loop)] // See `side_by_side`.
    pub(super) fn gather_pairs<C: Cavity, S: Space>(
        &mut self,
        view: &StateView<'_, C, L>,
        bodies: &[[u32; 2]],
    ) {
        let columns = Columns::<S>::new(view);
        let bodies = side_by_side(bodies);
        self.count = bodies.len();
        for n in 0..bodies.len() {
            let [i, j] = &bodies[n];
            let first = columns.centre(*i as usize);
            let second = columns.centre(*j as usize);
            let towards = S::in_space(first.position - second.position);
            let velocity = S::in_space(first.velocity - second.velocity);
            self.towards.set_vector::<S>(n, towards);
            self.velocity.set_vector::<S>(n, velocity);
            self.spins[0].set_spin::<S>(n, S::spin_in_space(first.spin));
            self.spins[1].set_spin::<S>(n, S::spin_in_space(second.spin));
        }
        if view.coefficients.only_radius().is_none() {
            for (n, [i, j]) in bodies.iter().enumerate() {
                self.radii[0][n] = columns.radius[*i as usize];
                self.radii[1][n] = columns.radius[*j as usize];
            }
        }
    }

    /// Takes over the contacts with walls of `bodies`, at most [`BATCH_SIZE`] of them.
    #[inline(always)]
    #[allow(clippy::needless_range_loop)] // See `side_by_side`.
    pub(super) fn gather_walls<C: Cavity, S: Space>(
        &mut self,
        view: &StateView<'_, C, L>,
        bodies: &[[u32; 2]],
    ) {
        let columns = Columns::<S>::new(view);
        let bodies = side_by_side(bodies);
        self.count = bodies.len();
        for n in 0..bodies.len() {
            let [index, wall] = &bodies[n];
            let index = *index as usize;
            let (centre, radius) = (columns.centre(index), columns.radius[index]);
            let position = S::in_space(centre.position);
            let compartment = view.compartment_of_wall(*wall);
            let point = view.wall_point(*wall, position);
            let normal = S::flattened(point.normal);
            // Where the sphere's surface would be: there the wall moves as it turns.
            let touch = || position - normal * radius;
            let velocity = compartment.relative(touch, S::in_space(centre.velocity));
            self.wall_inverse_mass[n] = compartment.inverse_mass_along::<S>(normal, touch);
            self.towards.set_vector::<S>(n, normal);
            self.velocity.set_vector::<S>(n, velocity);
            self.spins[0].set_spin::<S>(n, S::spin_in_space(centre.spin));
            self.spins[1].set_spin::<S>(n, compartment.motion.angular_velocity);
            self.radii[0][n] = radius;
            self.radii[1][n] = 0.0;
            self.overlap[n] = radius - point.distance;
        }
    }

    /// Works out where and how fast the bodies meet. Apart from the law, so that the roots and
    /// quotients of more contacts are under way at a time.
    #[inline(never)]
    fn work_out_kinematics<K: ContactKind, S: Space>(&mut self) {
        for n in 0..self.count.min(BATCH_SIZE) {
            let radii = self.radii.each_ref().map(|radii| radii[n]);
            let towards = S::flattened(self.towards.get(n));
            let normal = if K::IS_PAIR {
                let (normal, overlap) = normal_and_overlap::<S>(towards, radii);
                self.overlap[n] = overlap;
                self.towards.set_vector::<S>(n, normal);
                normal
            } else {
                towards
            };
            let spins = self
                .spins
                .each_ref()
                .map(|spins| S::flattened_spin(spins.get(n)));
            let velocity = S::flattened(self.velocity.get(n));
            let levers = self.levers::<K>(n);
            let velocity = surface_velocity::<S>(normal, velocity, spins, levers);
            self.velocity.set_vector::<S>(n, velocity);
            self.approach[n] = -velocity.dot(normal);
        }
    }

    /// Levers in m at which friction turns the bodies of a contact. A wall gives way nowhere, and turns
    /// the sphere by its radius.
    #[inline(always)]
    fn levers<K: ContactKind>(&self, n: usize) -> [f64; 2] {
        let radii = self.radii.each_ref().map(|radii| radii[n]);
        if K::IS_PAIR {
            levers(radii, self.overlap[n])
        } else {
            radii
        }
    }

    /// A contact at a time of the step.
    #[inline(always)]
    pub(super) fn contact<K: ContactKind, S: Space>(
        &self,
        n: usize,
        step_time: StepTime,
    ) -> Contact {
        let spins = self
            .spins
            .each_ref()
            .map(|spins| S::flattened_spin(spins.get(n)));
        let normal = S::flattened(self.towards.get(n));
        let velocity = S::flattened(self.velocity.get(n));
        Contact {
            spins,
            elapsed: step_time.elapsed,
            correction: step_time.correction,
            planar: S::PLANAR,
            wall_inverse_mass: if K::YIELDS {
                self.wall_inverse_mass[n]
            } else {
                0.0
            },
            ..Contact::new(normal, self.overlap[n], velocity)
        }
    }

    /// Has `law` answer the contacts, with the `only` coefficients that there are, or else with those
    /// of each contact in turn. With `END` their memory advances. `acceleration` is that of a contact's first
    /// centre relative to its second body, as it was evaluated last (m/s^2).
    #[inline(always)]
    pub(super) fn evaluate<K: ContactKind, S: Space, const END: bool>(
        &mut self,
        law: &L,
        only: Option<&L::Coefficients>,
        kinds: impl Iterator<Item = L::Coefficients>,
        step_time: StepTime,
        (memory, advanced): Histories<'_, L>,
        acceleration: impl Fn(usize) -> DVec3,
    ) {
        self.work_out_kinematics::<K, S>();
        let memories = (memory, &mut *advanced);
        if let Some(only) = only {
            if K::YIELDS && !self.has_yielding_wall() {
                self.evaluate_only::<SphereFixedWall, S, END>(law, only, step_time, memories);
            } else {
                self.evaluate_only::<K, S, END>(law, only, step_time, memories);
            }
        } else {
            self.kinds.clear();
            self.kinds.extend(kinds);
            self.evaluate_mixed::<K, S, END>(law, step_time, memories);
        }
        if law.corrects_onset() {
            let memories = (memory, advanced);
            self.correct_onsets::<K, S, END>(law, only, step_time, acceleration, memories);
        }
        if only.is_some_and(|only| !law.has_couple(only)) {
            self.work_out_reactions::<K, S, false>();
        } else {
            self.work_out_reactions::<K, S, true>();
        }
    }

    #[inline(always)]
    fn evaluate_only<K: ContactKind, S: Space, const END: bool>(
        &mut self,
        law: &L,
        only: &L::Coefficients,
        step_time: StepTime,
        memories: Histories<'_, L>,
    ) {
        if law.has_couple(only) {
            self.evaluate_alike::<K, S, END, true>(law, only, step_time, memories);
        } else {
            self.evaluate_alike::<K, S, END, false>(law, only, step_time, memories);
        }
    }

    /// Whether a wall among the contacts yields.
    #[inline(always)]
    fn has_yielding_wall(&self) -> bool {
        let own = &self.wall_inverse_mass[..self.count.min(BATCH_SIZE)];
        own.iter().any(|inverse_mass| *inverse_mass > 0.0)
    }

    #[inline(never)]
    fn evaluate_alike<K: ContactKind, S: Space, const END: bool, const COUPLE: bool>(
        &mut self,
        law: &L,
        kind: &L::Coefficients,
        step_time: StepTime,
        (memory, advanced): Histories<'_, L>,
    ) {
        let kind = *kind;
        let count = self.count.min(BATCH_SIZE);
        let (memory, advanced) = (&memory[..count], &mut advanced[..count]);
        for n in 0..count {
            let memories = (&memory[n], &mut advanced[n]);
            self.evaluate_one::<K, S, END, COUPLE>(law, &kind, n, step_time, memories);
        }
    }

    #[inline(never)]
    fn evaluate_mixed<K: ContactKind, S: Space, const END: bool>(
        &mut self,
        law: &L,
        step_time: StepTime,
        (memory, advanced): Histories<'_, L>,
    ) {
        for n in 0..self.kinds.len().min(BATCH_SIZE) {
            let kind = self.kinds[n];
            let memories = (&memory[n], &mut advanced[n]);
            self.evaluate_one::<K, S, END, true>(law, &kind, n, step_time, memories);
        }
    }

    #[inline(always)]
    fn evaluate_one<K: ContactKind, S: Space, const END: bool, const COUPLE: bool>(
        &mut self,
        law: &L,
        kind: &L::Coefficients,
        n: usize,
        step_time: StepTime,
        (memory, advanced): (&ContactMemory<L>, &mut ContactMemory<L>),
    ) {
        let contact = self.contact::<K, S>(n, step_time);
        let answer = law.force(kind, &contact, memory);
        if END {
            *advanced = law.advance(kind, &contact, memory);
        }
        self.store::<S, COUPLE>(n, &answer);
    }

    /// Stores an answer.
    #[inline(always)]
    fn store<S: Space, const COUPLE: bool>(&mut self, n: usize, answer: &ContactForce) {
        self.force[n] = answer.normal;
        self.push.set_vector::<S>(n, answer.tangential);
        if COUPLE {
            self.torques[0].set_spin::<S>(n, answer.couple);
        }
    }

    /// Works out what the answers do to the bodies. Apart from the law, as the kinematics are.
    #[inline(never)]
    fn work_out_reactions<K: ContactKind, S: Space, const COUPLE: bool>(&mut self) {
        for n in 0..self.count.min(BATCH_SIZE) {
            let normal = S::flattened(self.towards.get(n));
            let mut answer = ContactForce::new(self.force[n], S::flattened(self.push.get(n)));
            if COUPLE {
                answer.couple = S::flattened_spin(self.torques[0].get(n));
            }
            let levers = self.levers::<K>(n);
            let (push, [first, second]) = force_and_torques::<S, COUPLE>(normal, levers, &answer);
            self.push.set_vector::<S>(n, push);
            self.torques[0].set_spin::<S>(n, first);
            self.torques[1].set_spin::<S>(n, second);
        }
    }

    /// Has `law` answer once more where bodies may have met or may part within the step.
    fn correct_onsets<K: ContactKind, S: Space, const END: bool>(
        &mut self,
        law: &L,
        only: Option<&L::Coefficients>,
        step_time: StepTime,
        acceleration: impl Fn(usize) -> DVec3,
        (memories, advanced): Histories<'_, L>,
    ) {
        for n in 0..self.count.min(BATCH_SIZE) {
            if self.is_near_onset(n, step_time) {
                let kind = only.unwrap_or_else(|| &self.kinds[n]);
                let (_, answer, memory) =
                    self.at_onset::<K, S>(law, kind, n, step_time, acceleration(n), &memories[n]);
                self.store::<S, true>(n, &answer);
                if END {
                    advanced[n] = memory;
                }
            }
        }
    }

    /// Whether the bodies of a contact may have met or may part within the step.
    #[inline(always)]
    const fn is_near_onset(&self, n: usize, step_time: StepTime) -> bool {
        Onset::is_near(self.overlap[n], self.approach[n], step_time.time_step)
    }

    /// Such a contact, the answer of the `law` with coefficients `kind`, and what the contact remembers at the
    /// end of the step.
    #[inline(always)]
    fn at_onset<K: ContactKind, S: Space>(
        &self,
        law: &L,
        kind: &L::Coefficients,
        n: usize,
        step_time: StepTime,
        acceleration: DVec3,
        memory: &ContactMemory<L>,
    ) -> (Contact, ContactForce, ContactMemory<L>) {
        let contact = self.contact::<K, S>(n, step_time);
        let onset = Onset::new(step_time.time_step, acceleration.dot(contact.normal));
        let (answer, memory) = law.at_onset(kind, &contact, memory, &onset);
        (contact, answer, memory)
    }

    /// The same of any contact.
    pub(super) fn evaluate_contact<K: ContactKind, S: Space>(
        &self,
        law: &L,
        kind: &L::Coefficients,
        n: usize,
        step_time: StepTime,
        acceleration: DVec3,
        memory: &ContactMemory<L>,
    ) -> (Contact, ContactForce, ContactMemory<L>) {
        if law.corrects_onset() && self.is_near_onset(n, step_time) {
            return self.at_onset::<K, S>(law, kind, n, step_time, acceleration, memory);
        }
        let contact = self.contact::<K, S>(n, step_time);
        let answer = law.force(kind, &contact, memory);
        (contact, answer, law.advance(kind, &contact, memory))
    }

    /// Force on the first body of a contact, in N; the second feels the opposite.
    #[inline(always)]
    pub(super) const fn push(&self, n: usize) -> DVec3 {
        self.push.get(n)
    }

    /// Torques on the two bodies of a contact, in N m.
    #[inline(always)]
    pub(super) const fn torques(&self, n: usize) -> [DVec3; 2] {
        [self.torques[0].get(n), self.torques[1].get(n)]
    }

    /// The overlap of a contact in m.
    #[inline(always)]
    pub(super) const fn overlap(&self, n: usize) -> f64 {
        self.overlap[n]
    }

    /// The largest overlap in m.
    #[inline(always)]
    pub(super) fn largest_overlap(&self) -> f64 {
        let overlaps = &self.overlap[..self.count.min(BATCH_SIZE)];
        let (fours, rest) = overlaps.as_chunks::<4>();
        // Four at a time, to be vectors.
        let mut deepest = [0.0; 4];
        for four in fours {
            for (deepest, overlap) in deepest.iter_mut().zip(four) {
                *deepest = at_least(*overlap, *deepest);
            }
        }
        let deeper = |deepest, overlap: &f64| at_least(*overlap, deepest);
        deepest.iter().chain(rest).fold(0.0, deeper)
    }
}
