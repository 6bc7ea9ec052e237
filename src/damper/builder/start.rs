//! The start of a damper that was just built: everything in its place, and nothing overlaps.

use glam::DVec3;

use super::BuildError;
use super::check::in_plane;
use crate::cavity::Cavity;
use crate::damper::engine::Engine;
use crate::detector::Detector;
use crate::integrator::Stage;
use crate::law::ContactLaw;
use crate::mount::{Mobility, Mount};

impl<C: Cavity, L: ContactLaw, M: Mount + ?Sized, D: Detector> Engine<C, L, M, D> {
    /// Places the containers and the particles in them, refuses overlaps of more than `allowed` (m),
    /// and evaluates the first accelerations.
    pub(super) fn start(&mut self, allowed: f64) -> Result<(), BuildError> {
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
        let compartments = &self.state.model.compartments;
        for (mobility, compartment) in mobilities.iter().zip(compartments.iter().cycle()) {
            if compartment.cavity.is_planar() {
                check_plane(mobility)?;
            }
        }
        Ok(())
    }

    /// Refuses two particles, or a particle and a wall, that overlap by more than `limit` (m).
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

/// Refuses a mount that leaves the plane, as it shows in how it yields.
fn check_plane(mobility: &Mobility) -> Result<(), BuildError> {
    let linear = mobility.linear;
    in_plane("axis of the mount", linear.z_axis + linear.row(2))?;
    let loads = [DVec3::X, DVec3::Y].map(|force| [force, DVec3::ZERO]);
    for [force, torque] in loads.into_iter().chain([[DVec3::ZERO, DVec3::Z]]) {
        let [velocity, turning] = mobility.motion(force, torque);
        in_plane("axis of the mount", velocity)?;
        if turning.x != 0.0 || turning.y != 0.0 {
            return Err(BuildError::OutOfPlane {
                quantity: "axis about which the mount turns",
                value: turning,
            });
        }
    }
    Ok(())
}
