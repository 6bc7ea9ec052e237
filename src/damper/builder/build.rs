//! From a builder to a damper.

use super::check::check;
use super::time_step::{choose_time_step, contacts_bear};
use super::{BuildError, Builder, Settings};
use crate::cavity::Cavity;
use crate::contact::{Body, WallLoad};
use crate::damper::Damper;
use crate::damper::engine::Engine;
use crate::damper::forces::Forces;
use crate::damper::impulses::ContactSolver;
use crate::damper::neighbours::Neighbours;
use crate::damper::parts::Parts;
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
    pub fn build(self) -> Result<Damper<C, L, M, D, I>, BuildError> {
        let cavities = self.cavities.len();
        let mut detectors = hand_out(self.detectors, self.copy, cavities)?;
        let start_time = self.settings.start_time;
        let mut parts = Parts {
            mount: &self.mount,
            detectors: &mut detectors,
            observer: &mut (),
        };
        let engine = assemble(self.cavities, self.law, self.settings, &mut parts)?;
        Ok(Damper {
            setup: Setup::new(&engine.model, &engine.state),
            time_step: engine.state.time_step,
            engine,
            mount: self.mount,
            detectors,
            integrator: self.integrator,
            clock: Clock::showing(start_time),
        })
    }
}

/// Gives each of so many `cavities` a detector of its own.
fn hand_out<D>(
    mut detectors: Vec<D>,
    copy: Option<fn(&D) -> D>,
    cavities: usize,
) -> Result<Vec<D>, BuildError> {
    if let ([detector], Some(copy)) = (&detectors[..], copy) {
        let more: Vec<D> = (1..cavities).map(|_| copy(detector)).collect();
        detectors.extend(more);
    }
    if detectors.len() == cavities {
        return Ok(detectors);
    }
    Err(BuildError::DetectorCount {
        detectors: detectors.len(),
        cavities,
    })
}

/// The engine of a damper, at its start.
fn assemble<C: Cavity, L: ContactLaw>(
    cavities: Vec<C>,
    law: L,
    mut settings: Settings,
    parts: &mut Parts<'_>,
) -> Result<Engine<C, L>, BuildError> {
    let mount = parts.mount;
    let walls = check(&settings, &cavities, mount)?;
    let numbers = order_by_cavity(&mut settings.particles);
    let planar = cavities.iter().all(Cavity::is_planar);
    let particles = Particles::new(&settings.particles, numbers, planar);
    let coefficients = Coefficients::new(&law, &particles.kinds, settings.wall_material)?;
    L::Kind::accept(CheckLaw(&law))?;
    let mount_coordinates = MountCoordinates::new(mount, cavities.len());
    let smallest = particles.smallest_radius;
    let degrees = mount.degrees();
    let own = mount_coordinates.own(degrees);
    let mobilities = Mobilities::new(mount, settings.start_time, own, cavities.len());
    let margins = |cavity| {
        if smallest.is_finite() {
            let skin = parts.detectors.of(cavity).skin(smallest);
            skin.max(STAGE_MARGIN * smallest)
        } else {
            0.0
        }
    };
    let compartments = compartments(&cavities, &settings.particles, margins, &mobilities);
    let yielding = compartments.iter().map(Compartment::greatest_inverse_mass);
    let wall = Body {
        mass: 1.0 / yielding.fold(0.0, f64::max),
        ..Body::wall(settings.wall_material)
    };
    let contacts = contacts_bear(&law, &coefficients, wall, &particles)?;
    let time_step = choose_time_step(settings.time_step, contacts, mount)?;
    let neighbours = Neighbours::new(&particles);
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
            gravity: settings.gravity,
            particles,
            planar,
            degrees,
            wall_loads: vec![WallLoad::default(); walls],
            loads: vec![Load::default(); compartments.len()],
            mobilities,
            compartment_of_wall: compartment_of_wall(&compartments),
            compartments,
            time: settings.start_time,
            time_step,
            step_start: StepStart::default(),
            overlap_limit: settings.overlap_limit * smallest,
            contained: settings.contained,
            holds_forces: L::Kind::HELD,
            design_speed: law.design_speed(),
        },
        model: Model {
            law,
            coefficients,
            cavities,
        },
    };
    engine.start(settings.initial_overlap * smallest, parts)?;
    Ok(engine)
}

/// A compartment for each of `cavities`, with those of `particles` that are in it; `margin` tells how much
/// farther than they reach its candidates are listed, m.
fn compartments<C: Cavity>(
    cavities: &[C],
    particles: &[Particle],
    mut margin: impl FnMut(usize) -> f64,
    mobilities: &Mobilities,
) -> Vec<Compartment> {
    let (mut index, mut wall) = (0, 0);
    let mut compartments = Vec::new();
    for (number, cavity) in cavities.iter().enumerate() {
        let own = |particle: &&Particle| particle.cavity as usize == number;
        let end = index + particles.iter().filter(own).count();
        let mut compartment = Compartment::new(cavity, index..end, wall, margin(number));
        compartment.set_mobility(&mobilities.own(number));
        index = end;
        wall += compartment.walls;
        compartments.push(compartment);
    }
    compartments
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
fn compartment_of_wall(compartments: &[Compartment]) -> Vec<u32> {
    let compartments = compartments.iter().zip(0..);
    compartments
        .flat_map(|(compartment, number)| (0..compartment.walls).map(move |_| number))
        .collect()
}
