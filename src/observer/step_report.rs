use std::fmt;

use glam::DVec3;

use crate::contact::WallLoad;
use crate::mount::{Load, Motion, MountEnergy};
use crate::particle::Particle;

/// What a damper shows of itself, whatever it is made of.
pub(crate) trait Observable {
    fn count(&self) -> usize;
    fn particle(&self, number: usize) -> Option<Particle>;
    fn cavities(&self) -> usize;
    fn container(&self, cavity: usize) -> Option<Motion>;
    fn load(&self, cavity: usize) -> Option<Load>;
    fn impulse(&self, cavity: usize) -> Option<DVec3>;
    fn walls(&self, cavity: usize) -> u32;
    fn wall_load(&self, cavity: usize, wall: u32) -> Option<WallLoad>;
    fn wall_name(&self, cavity: usize, wall: u32) -> Option<&str>;
    fn coordinates(&self) -> &[f64];
    fn rates(&self) -> &[f64];
    fn mount_energy(&self) -> MountEnergy;
    fn gravity(&self) -> DVec3;
    fn holds_forces(&self) -> bool;
    fn contacts(&self) -> usize;
    fn largest_overlap(&self) -> f64;
}

/// A damper at the end of a step. What is asked for is looked up or computed then, and nothing
/// before.
#[derive(Clone, Copy)]
pub struct StepReport<'a> {
    time: f64,
    time_step: f64,
    view: &'a dyn Observable,
}

impl<'a> StepReport<'a> {
    pub(crate) const fn new(time: f64, time_step: f64, view: &'a dyn Observable) -> Self {
        Self {
            time,
            time_step,
            view,
        }
    }

    /// Simulated time in s.
    #[must_use]
    pub const fn time(&self) -> f64 {
        self.time
    }

    /// Length in s of the step that ends here.
    #[must_use]
    pub const fn time_step(&self) -> f64 {
        self.time_step
    }

    /// How many particles there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.view.count()
    }

    /// Whether the containers are empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The particle of a number, in the fixed frame.
    #[must_use]
    pub fn particle(&self, number: usize) -> Option<Particle> {
        self.view.particle(number)
    }

    /// The particles in the order of their numbers.
    pub fn particles(&self) -> impl Iterator<Item = Particle> {
        let view = self.view;
        (0..view.count()).map_while(|number| view.particle(number))
    }

    /// How many cavities there are.
    #[must_use]
    pub fn cavities(&self) -> usize {
        self.view.cavities()
    }

    /// How the container of a cavity moves.
    #[must_use]
    pub fn container(&self, cavity: usize) -> Option<Motion> {
        self.view.container(cavity)
    }

    /// Force and torque of the particles on a container, at the end of the step or, of an impulse law,
    /// over the step.
    #[must_use]
    pub fn load(&self, cavity: usize) -> Option<Load> {
        self.view.load(cavity)
    }

    /// Impulse in N s of the particles on a container over the step that ends here: exactly the momentum
    /// that they lost, but for gravity.
    #[must_use]
    pub fn impulse(&self, cavity: usize) -> Option<DVec3> {
        self.view.impulse(cavity)
    }

    /// How many walls a cavity has.
    #[must_use]
    pub fn walls(&self, cavity: usize) -> u32 {
        self.view.walls(cavity)
    }

    /// Load of the particles on a wall, at the end of the step or, of an impulse law, over the step.
    #[must_use]
    pub fn wall_load(&self, cavity: usize, wall: u32) -> Option<WallLoad> {
        self.view.wall_load(cavity, wall)
    }

    /// What a cavity calls a wall.
    #[must_use]
    pub fn wall_name(&self, cavity: usize, wall: u32) -> Option<&'a str> {
        self.view.wall_name(cavity, wall)
    }

    /// The mount's generalised coordinates.
    #[must_use]
    pub fn coordinates(&self) -> &'a [f64] {
        self.view.coordinates()
    }

    /// The rates of the mount's generalised coordinates.
    #[must_use]
    pub fn rates(&self) -> &'a [f64] {
        self.view.rates()
    }

    /// Energy and powers of the mount.
    #[must_use]
    pub fn mount_energy(&self) -> MountEnergy {
        self.view.mount_energy()
    }

    /// Acceleration of gravity in m/s^2.
    #[must_use]
    pub fn gravity(&self) -> DVec3 {
        self.view.gravity()
    }

    /// Whether contact forces are held over a step, as those of an impulse law are.
    #[must_use]
    pub fn holds_forces(&self) -> bool {
        self.view.holds_forces()
    }

    /// How many contacts there were when they were evaluated last, walls included.
    #[must_use]
    pub fn contacts(&self) -> usize {
        self.view.contacts()
    }

    /// The largest overlap in m: under a force law when contacts were evaluated last, under an impulse law at
    /// the start of the last step.
    #[must_use]
    pub fn largest_overlap(&self) -> f64 {
        self.view.largest_overlap()
    }
}

impl fmt::Debug for StepReport<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("StepReport")
            .field("time", &self.time)
            .field("time_step", &self.time_step)
            .field("particles", &self.len())
            .finish_non_exhaustive()
    }
}
