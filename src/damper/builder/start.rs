//! The start of a damper that was just built: everything in its place, and nothing overlaps.

use glam::DVec3;

use super::BuildError;
use super::check::in_plane;
use crate::cavity::Cavity;
use crate::damper::engine::Engine;
use crate::damper::parts::Parts;
use crate::damper::state::State;
use crate::integrator::Stage;
use crate::law::ContactLaw;
use crate::mount::Mobility;

impl<C: Cavity, L: ContactLaw> Engine<C, L> {
    /// Places the containers and the particles in them, refuses overlaps of more than `allowed` (m),
    /// and evaluates the first accelerations.
    pub(super) fn start(&mut self, allowed: f64, parts: &mut Parts<'_>) -> Result<(), BuildError> {
        let Self {
            model,
            state,
            neighbours,
            ..
        } = self;
        check_mount(state)?;
        state.place_containers(parts.mount, state.time)?;
        for compartment in &state.compartments {
            for index in compartment.indices.clone() {
                let position = compartment.to_fixed(state.particles.position.get(index));
                state.particles.position.set(index, position);
            }
        }
        neighbours.prepare_detectors(state, parts.detectors)?;
        neighbours.sort(state);
        neighbours.find_contacts(model, state, parts.detectors, true)?;
        self.check_initial_overlaps(allowed)?;
        Ok(self.evaluate(self.state.time, 0.0, Stage::Trial, false, parts)?)
    }

    /// Refuses two particles, or a particle and a wall, that overlap by more than `limit` (m).
    fn check_initial_overlaps(&self, limit: f64) -> Result<(), BuildError> {
        let view = self.state.view(&self.model, 0.0);
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

/// Refuses a mount that loads cannot move, and one that leaves the plane of a planar cavity.
fn check_mount(state: &State) -> Result<(), BuildError> {
    let mobilities = state.mobilities.all();
    if state.degrees > 0 && mobilities.iter().all(|own| *own == Mobility::ZERO) {
        return Err(BuildError::ImmovableMount {
            degrees: state.degrees,
        });
    }
    for (mobility, compartment) in mobilities.iter().zip(state.compartments.iter().cycle()) {
        if compartment.planar {
            check_plane(mobility)?;
        }
    }
    Ok(())
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
