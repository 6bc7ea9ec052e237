//! The usual dampers, compiled with the library.
//!
//! Where little is optimised (`cargo test`, `cargo run`) programs take generic code from here, as far as it is
//! of the same types, and do not compile it once more each. Release builds know nothing of it.

use crate::cavity::{Cavity, Cuboid, Slot};
use crate::damper::Damper;
use crate::law::{ContactLaw, HertzMindlin, HertzTsuji, RestitutionImpulse};
use crate::material::Material;
use crate::mount::Motion;

/// Does with the usual dampers what most programs do.
#[doc(hidden)]
pub fn shared() {
    let material = Material::acrylic();
    under(RestitutionImpulse::new(material));
    under(HertzTsuji::new(material));
    under(HertzMindlin::new(material));
}

fn under<L: ContactLaw + Clone>(law: L) {
    run(Slot::paper(), law.clone());
    if let Ok(cuboid) = Cuboid::new(glam::DVec3::ONE) {
        run(cuboid, law);
    }
}

fn run<C: Cavity, L: ContactLaw>(cavity: C, law: L) {
    if let Ok(mut damper) = Damper::builder(cavity, law).build() {
        let start = damper.snapshot();
        let _ = damper.step();
        let _ = damper.drive(Motion::default(), damper.time_step());
        let _ = damper.restore(&start);
    }
}
