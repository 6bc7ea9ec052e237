//! What observers are told of contacts that were evaluated.

use super::batch::{Batch, SpherePair, SphereWall};
use crate::cavity::Cavity;
use crate::contact::Partner;
use crate::damper::neighbours::Run;
use crate::damper::state::{Space, StateView};
use crate::law::ForceLaw;
use crate::observer::{ContactEvent, Observer};

/// Tells `observer` of the pairs of a run, which are in `batch`.
#[cold]
pub(super) fn report_pairs<C: Cavity, L: ForceLaw, S: Space>(
    view: &StateView<'_, C, L>,
    run: &Run<'_, L>,
    batch: &Batch<L>,
    observer: &mut dyn Observer,
) {
    for (n, bodies) in run.bodies.iter().copied().enumerate() {
        let (index, other) = (bodies[0] as usize, bodies[1] as usize);
        let kind = run.pair_coefficients(view, n);
        let acceleration = view.acceleration_of_pair(bodies);
        let (contact, force, memory) = batch.evaluate_contact::<SpherePair, S>(
            view.law,
            &kind,
            n,
            view.step_time,
            acceleration,
            &run.memory[n],
        );
        observer.contact(&ContactEvent {
            particle: view.id[index] as usize,
            partner: Partner::Particle(view.id[other] as usize),
            cavity: view
                .compartments
                .partition_point(|compartment| compartment.indices.end <= index),
            contact,
            force,
            stored: view.law.stored(&kind, &contact, &memory),
            working_velocity: contact.velocity,
            working_spin: contact.spins[0] - contact.spins[1],
        });
    }
}

/// Tells `observer` of the contacts of a run with walls, which are in `batch`.
#[cold]
pub(super) fn report_walls<C: Cavity, L: ForceLaw, S: Space>(
    view: &StateView<'_, C, L>,
    run: &Run<'_, L>,
    batch: &Batch<L>,
    observer: &mut dyn Observer,
) {
    for (n, [index, wall]) in run.bodies.iter().enumerate() {
        let (index, wall) = (*index as usize, *wall);
        let kind = view.coefficients.wall(view.species[index]);
        let acceleration = view.acceleration_at_wall(index, wall);
        let (contact, force, memory) = batch.evaluate_contact::<SphereWall, S>(
            view.law,
            kind,
            n,
            view.step_time,
            acceleration,
            &run.memory[n],
        );
        observer.contact(&ContactEvent {
            particle: view.id[index] as usize,
            partner: Partner::Wall(wall - view.compartment_of_wall(wall).first_wall),
            cavity: view.cavity_of_wall(wall),
            contact,
            force,
            stored: view.law.stored(kind, &contact, &memory),
            working_velocity: contact.velocity,
            working_spin: contact.spins[0] - contact.spins[1],
        });
    }
}
