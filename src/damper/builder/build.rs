//! From a builder to a damper: whatever can be refused is.

use glam::DVec3;

use super::{BuildError, Builder};
use crate::cavity::Cavity;
use crate::contact::{Body, WallLoad};
use crate::damper::Damper;
use crate::damper::engine::Engine;
use crate::damper::forces::Forces;
use crate::damper::impulses::ContactSolver;
use crate::damper::neighbours::{BLOCK, Neighbours};
use crate::damper::state::{
    Clock, Coefficients, Compartment, Model, MountCoordinates, Particles, PreviousAccelerations,
    Setup, State, StepStart,
};
use crate::detector::Detector;
use crate::error::{Bound, ValueError};
use crate::integrator::{Integrator, Stage};
use crate::law::{ContactLaw, ForceLaw, ImpulseLaw, LawKind, LawVisitor};
use crate::mount::{Load, Mobilities, Mobility, Mount};
use crate::particle::Particle;

/// Candidates without a skin are listed up to this fraction of the smallest radius, so that they
/// last over the stages of a step.
const STAGE_MARGIN: f64 = 0.05;

/// The most walls: each block of particles keeps a sum for each.
const MOST_WALLS: u64 = 1 << 20;

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
        self.check_counts()?;
        self.check_particles()?;
        let numbers = self.order_by_cavity();
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
        let wall_count = compartments.iter().map(|own| own.cavity.walls() as usize);
        let walls = wall_count.sum();
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

    fn check_numbers(&self) -> Result<(), BuildError> {
        for component in self.gravity.to_array() {
            Bound::Finite.check("gravity (m/s^2)", component)?;
        }
        if let Some(time_step) = self.time_step {
            Bound::Positive.check("time step (s)", time_step)?;
        }
        Bound::Finite.check("start time (s)", self.start_time)?;
        Bound::NonNegative.check(
            "initial overlap (fraction of a radius)",
            self.initial_overlap,
        )?;
        if self.overlap_limit.is_nan() || self.overlap_limit <= 0.0 {
            Bound::Positive.check("overlap limit (fraction of a radius)", self.overlap_limit)?;
        }
        if let Some(jump) = self.mount.jump() {
            return Err(BuildError::BaseJumps(jump));
        }
        if self.cavities.iter().any(Cavity::is_planar) {
            in_plane("gravity", self.gravity)?;
        }
        Ok(())
    }

    /// Counts particles and walls, and hands out detectors.
    fn check_counts(&mut self) -> Result<(), BuildError> {
        let limit = u32::MAX as usize - BLOCK;
        if self.particles.len() > limit {
            return Err(BuildError::TooManyParticles {
                count: self.particles.len(),
                limit,
            });
        }
        let walls = self.cavities.iter().map(|cavity| u64::from(cavity.walls()));
        let walls = walls.sum();
        if walls > MOST_WALLS {
            return Err(BuildError::TooManyWalls {
                count: walls,
                limit: MOST_WALLS,
            });
        }
        if let ([detector], Some(copy)) = (&self.detectors[..], self.copy) {
            let more = self.cavities.len() - 1;
            let copies: Vec<D> = std::iter::repeat_with(|| copy(detector))
                .take(more)
                .collect();
            self.detectors.extend(copies);
        }
        if self.detectors.len() != self.cavities.len() {
            return Err(BuildError::DetectorCount {
                detectors: self.detectors.len(),
                cavities: self.cavities.len(),
            });
        }
        Ok(())
    }

    fn check_particles(&self) -> Result<(), BuildError> {
        let radii = self.particles.iter().map(|particle| particle.radius);
        let squeeze = self.initial_overlap * radii.fold(f64::INFINITY, f64::min);
        for (number, particle) in self.particles.iter().enumerate() {
            check_particle(particle).map_err(|error| BuildError::Particle {
                particle: number,
                error,
            })?;
            let Some(cavity) = self.cavities.get(particle.cavity as usize) else {
                return Err(BuildError::UnknownCavity {
                    particle: number,
                    cavity: particle.cavity,
                    cavities: self.cavities.len(),
                });
            };
            if cavity.is_planar() {
                in_plane("particle position", particle.position)?;
                in_plane("particle velocity", particle.velocity)?;
                for spin in [particle.spin.x, particle.spin.y] {
                    if spin != 0.0 {
                        return Err(BuildError::OutOfPlane {
                            quantity: "particle spin",
                            value: particle.spin,
                        });
                    }
                }
            }
            let [low, high] = cavity.bounds();
            let size = high - low;
            let extent = if cavity.is_planar() {
                size.x.min(size.y)
            } else {
                size.min_element()
            };
            // Pressed into two opposite walls at once.
            if 2.0 * particle.radius > extent + 2.0 * squeeze {
                return Err(BuildError::TooLarge {
                    particle: number,
                    diameter: 2.0 * particle.radius,
                    extent,
                });
            }
            let rounding = cavity.rounding();
            if particle.radius > rounding {
                return Err(BuildError::TooLargeForEdge {
                    particle: number,
                    radius: particle.radius,
                    rounding,
                });
            }
        }
        Ok(())
    }

    /// Orders the particles by cavity; returns their numbers.
    fn order_by_cavity(&mut self) -> Vec<u32> {
        let mut numbers: Vec<u32> = (0..self.particles.len() as u32).collect();
        numbers.sort_by_key(|number| self.particles[*number as usize].cavity);
        self.particles = numbers
            .iter()
            .map(|number| self.particles[*number as usize])
            .collect();
        numbers
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

/// Number of the compartment of each wall.
fn compartment_of_wall<C: Cavity>(compartments: &[Compartment<C>]) -> Vec<u32> {
    let compartments = compartments.iter().zip(0..);
    compartments
        .flat_map(|(compartment, number)| (0..compartment.cavity.walls()).map(move |_| number))
        .collect()
}

fn check_particle(particle: &Particle) -> Result<(), ValueError> {
    Bound::Positive.check("radius (m)", particle.radius)?;
    Bound::Positive.check("mass (kg)", particle.mass)?;
    // Their reciprocals have to be finite.
    let smallest = Bound::AtLeast(f64::MIN_POSITIVE);
    smallest.check("mass (kg)", particle.mass)?;
    smallest.check("moment of inertia (kg m^2)", particle.inertia())?;
    for (quantity, vector) in [
        ("position (m)", particle.position),
        ("velocity (m/s)", particle.velocity),
        ("spin (rad/s)", particle.spin),
    ] {
        for component in vector.to_array() {
            Bound::Finite.check(quantity, component)?;
        }
    }
    Ok(())
}

fn in_plane(quantity: &'static str, value: DVec3) -> Result<(), BuildError> {
    if value.z == 0.0 {
        Ok(())
    } else {
        Err(BuildError::OutOfPlane { quantity, value })
    }
}

impl<C: Cavity, L: ContactLaw, M: Mount, D: Detector> Engine<C, L, M, D> {
    /// Places the containers and the particles in them, refuses overlaps of more than `allowed` (m),
    /// and evaluates the first accelerations.
    fn start(&mut self, allowed: f64) -> Result<(), BuildError> {
        self.check_mount()?;
        self.state.place_containers(self.state.time)?;
        for compartment in &self.state.model.compartments {
            for index in compartment.indices.clone() {
                let position = compartment.to_fixed(self.state.particles.position.get(index));
                self.state.particles.position.set(index, position);
            }
        }
        self.neighbours.prepare_detectors(&self.state)?;
        self.neighbours.sort(&mut self.state);
        self.neighbours.find_contacts(&self.state, true)?;
        self.check_initial_overlaps(allowed)?;
        Ok(self.evaluate(self.state.time, 0.0, Stage::Trial, false, &mut ())?)
    }

    /// Refuses a mount that loads cannot move, and one that leaves the plane of a planar cavity.
    fn check_mount(&self) -> Result<(), BuildError> {
        let mobilities = self.state.mobilities.all();
        if self.state.mount.degrees() > 0 && mobilities.iter().all(|own| *own == Mobility::ZERO) {
            return Err(BuildError::ImmovableMount {
                degrees: self.state.mount.degrees(),
            });
        }
        let cavities = self.state.model.compartments.len();
        for (number, mobility) in mobilities.iter().enumerate() {
            if self.state.model.compartments[number % cavities]
                .cavity
                .is_planar()
            {
                // A mount that leaves the plane shows it in how it yields.
                let linear = mobility.linear;
                in_plane("axis of the mount", linear.z_axis + linear.row(2))?;
                let loads = [DVec3::X, DVec3::Y].map(|force| [force, DVec3::ZERO]);
                for [force, torque] in loads.into_iter().chain([[DVec3::ZERO, DVec3::Z]]) {
                    let [velocity, turning] = mobility.motion(force, torque);
                    in_plane("axis of the mount", velocity)?;
                    let DVec3 { x, y, .. } = turning;
                    if x != 0.0 || y != 0.0 {
                        return Err(BuildError::OutOfPlane {
                            quantity: "axis about which the mount turns",
                            value: turning,
                        });
                    }
                }
            }
        }
        Ok(())
    }

    fn check_initial_overlaps(&self, limit: f64) -> Result<(), BuildError> {
        let view = self.state.view(0.0);
        for block in &self.neighbours.blocks {
            let mut pairs = block.overlapping_pairs(&view);
            if let Some((overlap, first, second)) = pairs.find(|pair| pair.0 > limit) {
                return Err(BuildError::InitialOverlap {
                    first: self.state.particles.id[first] as usize,
                    second: self.state.particles.id[second] as usize,
                    overlap,
                    limit,
                });
            }
            let mut walls = block.overlapping_walls(&view);
            if let Some((overlap, index, wall)) = walls.find(|wall| wall.0 > limit) {
                let compartment = view.compartment_of_wall(wall);
                return Err(BuildError::OutsideCavity {
                    particle: self.state.particles.id[index] as usize,
                    position: compartment.to_local(self.state.particles.position.get(index)),
                    wall: wall - compartment.first_wall,
                    overlap,
                    limit,
                });
            }
        }
        Ok(())
    }
}
