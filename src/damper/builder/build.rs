//! From a builder to a damper.

use super::check::{cavity_limits, check_counts, check_particles};
use super::{BuildError, Builder};
use crate::cavity::Cavity;
use crate::contact::{Body, WallLoad};
use crate::damper::Damper;
use crate::damper::engine::Engine;
use crate::damper::forces::Forces;
use crate::damper::impulses::ContactSolver;
use crate::damper::neighbours::Neighbours;
use crate::damper::state::{
    Clock, Coefficients, Compartment, Model, MountCoordinates, Particles, PreviousAccelerations,
    Setup, State, StepStart,
};
use crate::detector::Detector;
use crate::error::ValueError;
use crate::integrator::Integrator;
use crate::law::{ContactLaw, ForceLaw, ImpulseLaw, LawKind, LawVisitor};
use crate::mount::{Load, Mobilities, Mount};
use crate::particle::Particle;

/// Candidates without a skin are listed up to this fraction of the smallest radius, so that they
/// last over the stages of a step. At 1 m/s a strict law's step moves a grain of the paper's by a hundredth.
const STAGE_MARGIN: f64 = 0.05;

impl<C, L, M, D, I> Builder<C, L, M, D, I>
where
    C: Cavity,
    L: ContactLaw,
    M: Mount,
    D: Detector,
    I: Integrator,
{
    /// Checks everything, and builds the damper.
    ///
    /// # Errors
    /// A [`BuildError`] for the first thing that cannot be: it holds the value and the bound.
    pub fn build(mut self) -> Result<Damper<C, L, M, D, I>, BuildError> {
        self.check_numbers()?;
        let walls = check_counts(&self.particles, &self.cavities)?;
        self.hand_out_detectors()?;
        check_particles(
            &self.particles,
            &cavity_limits(&self.cavities),
            self.initial_overlap,
        )?;
        let numbers = order_by_cavity(&mut self.particles);
        let planar = self.cavities.iter().all(Cavity::is_planar);
        let particles = Particles::new(&self.particles, numbers, planar);
        let coefficients = Coefficients::new(&self.law, &particles.kinds, self.wall_material)?;
        L::Kind::accept(CheckLaw(&self.law))?;
        let mount_coordinates = MountCoordinates::new(&self.mount, self.cavities.len());
        let smallest = particles.smallest_radius;
        let degrees = self.mount.degrees();
        let own = &mount_coordinates;
        let own = [own.own(degrees), own.own_rates(degrees)];
        let count = self.cavities.len();
        let mobilities = Mobilities::new(&self.mount, self.start_time, own, count);
        let compartments = self.compartments(smallest, &mobilities);
        let yielding = compartments.iter().map(Compartment::greatest_inverse_mass);
        let wall = Body {
            mass: 1.0 / yielding.fold(0.0, f64::max),
            ..Body::wall(self.wall_material)
        };
        let time_step = self.choose_time_step(&coefficients, wall, &particles)?;
        let neighbours = Neighbours::new(self.detectors, &particles);
        // What the kind of the law does not need is not there.
        let blocks = if L::Kind::HELD {
            0
        } else {
            neighbours.blocks.len()
        };
        let mut engine = Engine {
            neighbours,
            forces: Forces::new(blocks, walls),
            impulses: L::Kind::HELD.then(|| ContactSolver::new(&particles.position, planar)),
            state: State {
                previous: PreviousAccelerations::new(&particles, &mount_coordinates),
                mount_coordinates,
                mount: self.mount,
                gravity: self.gravity,
                particles,
                wall_loads: vec![WallLoad::default(); walls],
                loads: vec![Load::default(); compartments.len()],
                mobilities,
                model: Model {
                    law: self.law,
                    coefficients,
                    compartment_of_wall: compartment_of_wall(&compartments),
                    compartments,
                },
                time: self.start_time,
                stamp: 0,
                time_step,
                step_start: StepStart::default(),
                overlap_limit: self.overlap_limit * smallest,
                contained: self.contained,
            },
        };
        engine.start(self.initial_overlap * smallest)?;
        Ok(Damper {
            setup: Setup::new(&engine.state, time_step),
            engine,
            integrator: self.integrator,
            clock: Clock::showing(self.start_time),
            time_step,
        })
    }

    /// Gives each cavity a detector of its own.
    fn hand_out_detectors(&mut self) -> Result<(), BuildError> {
        let cavities = self.cavities.len();
        if let ([detector], Some(copy)) = (&self.detectors[..], self.copy) {
            let more: Vec<D> = (1..cavities).map(|_| copy(detector)).collect();
            self.detectors.extend(more);
        }
        if self.detectors.len() == cavities {
            return Ok(());
        }
        Err(BuildError::DetectorCount {
            detectors: self.detectors.len(),
            cavities,
        })
    }

    fn compartments(
        &mut self,
        smallest_radius: f64,
        mobilities: &Mobilities,
    ) -> Vec<Compartment<C>> {
        let (mut index, mut wall) = (0, 0);
        let mut compartments = Vec::new();
        for (number, cavity) in std::mem::take(&mut self.cavities).into_iter().enumerate() {
            let own = |particle: &&Particle| particle.cavity as usize == number;
            let end = index + self.particles.iter().filter(own).count();
            let walls = cavity.walls();
            let margin = if smallest_radius.is_finite() {
                let skin = self.detectors[number].skin(smallest_radius);
                skin.max(STAGE_MARGIN * smallest_radius)
            } else {
                0.0
            };
            let mut compartment = Compartment::new(cavity, index..end, wall, margin);
            compartment.mobility = mobilities.own(number);
            compartments.push(compartment);
            index = end;
            wall += walls;
        }
        compartments
    }
}

/// Refuses an impulse law whose solver cannot work so.
struct CheckLaw<'a, L>(&'a L);

impl<L: ContactLaw> LawVisitor<L> for CheckLaw<'_, L> {
    type Output = Result<(), ValueError>;

    fn forces(self) -> Self::Output
    where
        L: ForceLaw,
    {
        Ok(())
    }

    fn impulses(self) -> Self::Output
    where
        L: ImpulseLaw,
    {
        self.0.solver().check()
    }
}

/// Orders `particles` by cavity; returns their numbers.
fn order_by_cavity(particles: &mut Vec<Particle>) -> Vec<u32> {
    let mut numbers: Vec<u32> = (0..particles.len() as u32).collect();
    numbers.sort_by_key(|number| particles[*number as usize].cavity);
    *particles = numbers
        .iter()
        .map(|number| particles[*number as usize])
        .collect();
    numbers
}

/// Number of the compartment of each wall.
fn compartment_of_wall<C: Cavity>(compartments: &[Compartment<C>]) -> Vec<u32> {
    let compartments = compartments.iter().zip(0..);
    compartments
        .flat_map(|(compartment, number)| (0..compartment.cavity.walls()).map(move |_| number))
        .collect()
}
