//! Energies of a damper between steps.

use super::Damper;
use super::engine::Engine;
use super::neighbours::NeighbourList;
use super::state::{StateView, Volume, levers, normal_and_overlap, surface_velocity};
use crate::cavity::Cavity;
use crate::contact::{Contact, Stored};
use crate::detector::Detector;
use crate::integrator::Integrator;
use crate::law::{ContactLaw, ForceLaw, ImpulseLaw, LawKind, LawVisitor};
use crate::mount::{Mount, MountEnergy};
use crate::observer::{Energies, Observable};

impl<C, L, M, D, I> Damper<C, L, M, D, I>
where
    C: Cavity,
    L: ContactLaw,
    M: Mount,
    D: Detector,
    I: Integrator,
{
    /// Energy of the mount, and the powers that change it besides the particles' forces.
    #[must_use]
    pub fn mount_energy(&self) -> MountEnergy {
        self.observed().mount_energy()
    }

    /// Energies of mount, particles and contacts. Those of contacts are what the law says that they
    /// [hold](Stored), as they were evaluated last: none under an impulse law.
    ///
    /// ```
    /// use particle_damper::glam::dvec3;
    /// use particle_damper::{Damper, HertzTsuji, Material, Particle, SingleDof, Slot};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mut damper = Damper::builder(Slot::paper(), HertzTsuji::new(Material::acrylic()))
    ///     .mount(SingleDof::paper().released_from(0.01, 0.0)?)
    ///     .particles([Particle::new(3e-3, 0.2e-3)?.at(dvec3(0.03, 0.02, 0.0))])
    ///     .time_step(2e-5)
    ///     .build()?;
    /// let start = damper.energies().total();
    /// while damper.time() < 1.0 {
    ///     damper.step()?;
    /// }
    /// assert!(damper.energies().total() < start);
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    pub fn energies(&self) -> Energies {
        let mount = self.mount_energy();
        let mut energies = Energies {
            mount: mount.kinetic,
            spring: mount.potential,
            ..Energies::default()
        };
        for particle in self.particles() {
            energies.add_particle(&particle, self.engine.state.gravity);
        }
        let stored = L::Kind::accept(StoredInContacts(&self.engine));
        energies.contacts = stored.normal + stored.tangential;
        energies
    }
}

/// What all contacts hold.
struct StoredInContacts<'a, C, L: ContactLaw>(&'a Engine<C, L>);

impl<C: Cavity, L: ContactLaw> LawVisitor<L> for StoredInContacts<'_, C, L> {
    type Output = Stored;

    fn forces(self) -> Stored
    where
        L: ForceLaw,
    {
        let view = self.0.state.view(&self.0.model, 0.0);
        let mut sum = Stored::default();
        for block in &self.0.neighbours.blocks {
            for list in [&block.pairs, &block.halo] {
                add(&mut sum, &view, list, pair);
            }
            add(&mut sum, &view, &block.walls, wall);
        }
        sum
    }

    fn impulses(self) -> Stored
    where
        L: ImpulseLaw,
    {
        Stored::default()
    }
}

/// Adds what the contacts among `list` hold; `contact` tells what two bodies of a view are to each other,
/// and their coefficients.
fn add<C: Cavity, L: ForceLaw>(
    sum: &mut Stored,
    view: &StateView<'_, C, L>,
    list: &NeighbourList<L>,
    contact: impl Fn(
        &StateView<'_, C, L>,
        &NeighbourList<L>,
        u32,
        [u32; 2],
    ) -> (L::Coefficients, Contact),
) {
    let mut memories = list.memories();
    for (candidate, bodies) in list.all() {
        let (kind, contact) = contact(view, list, candidate, bodies);
        if contact.overlap > 0.0 {
            let memory = memories.of(candidate).copied();
            let stored = view
                .law
                .stored(&kind, &contact, &memory.unwrap_or_default());
            sum.normal += stored.normal;
            sum.tangential += stored.tangential;
        }
    }
}

fn pair<C: Cavity, L: ForceLaw>(
    view: &StateView<'_, C, L>,
    list: &NeighbourList<L>,
    candidate: u32,
    bodies: [u32; 2],
) -> (L::Coefficients, Contact) {
    let [first, second] = bodies.map(|index| view.grain(index as usize));
    let radii = [first.radius, second.radius];
    let (normal, overlap) = normal_and_overlap::<Volume>(first.position - second.position, radii);
    let spins = [first.spin, second.spin];
    let towards = first.velocity - second.velocity;
    let velocity = surface_velocity::<Volume>(normal, towards, spins, levers(radii, overlap));
    let mut contact = Contact::new(normal, overlap, velocity);
    contact.spins = spins;
    (list.pair_coefficients(view, bodies, candidate), contact)
}

fn wall<C: Cavity, L: ForceLaw>(
    view: &StateView<'_, C, L>,
    _list: &NeighbourList<L>,
    _candidate: u32,
    [index, wall]: [u32; 2],
) -> (L::Coefficients, Contact) {
    let grain = view.grain(index as usize);
    let point = view.wall_point(wall, grain.position);
    let compartment = view.compartment_of_wall(wall);
    let spins = [grain.spin, compartment.motion.angular_velocity];
    let levers = [grain.radius, 0.0];
    let touch = || grain.position - point.normal * grain.radius;
    let towards = compartment.relative(touch, grain.velocity);
    let velocity = surface_velocity::<Volume>(point.normal, towards, spins, levers);
    let mut contact = Contact::new(point.normal, grain.radius - point.distance, velocity);
    contact.spins = spins;
    contact.wall_inverse_mass = compartment.inverse_mass_along::<Volume>(point.normal, touch);
    let species = view.species[index as usize];
    (*view.coefficients.wall(species), contact)
}
