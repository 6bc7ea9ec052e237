//! Force laws: time per force, averaged over contacts of different overlap and speed.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use particle_damper::glam::DVec3;
use particle_damper::{
    Bodies, Body, Contact, ForceLaw, Friction, HertzMindlin, HertzTsuji, Material, Materials,
};

/// Contacts of two of the paper's spheres, approaching and parting, sliding either way.
fn contacts() -> Vec<Contact> {
    (0..64_u32)
        .map(|number| {
            let part = |step: u32| f64::from(number * step % 64) / 64.0;
            let velocity = DVec3::new(part(7) - 0.5, part(19) - 0.5, 0.0);
            let mut contact = Contact::new(DVec3::Y, 1e-6 + 40e-6 * part(1), velocity);
            contact.elapsed = 2e-5;
            contact
        })
        .collect()
}

fn measure<L: ForceLaw>(c: &mut Criterion, name: &str, law: &L) {
    let sphere = Body::sphere(3e-3, 0.2e-3, Materials::FIRST);
    let coefficients = law.coefficients(&Bodies::new(sphere, sphere)).unwrap();
    let contacts = contacts();
    let mut group = c.benchmark_group("law");
    group
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_secs(1))
        .throughput(Throughput::Elements(contacts.len() as u64))
        .bench_function(name, |bencher| {
            bencher.iter(|| {
                let forces = black_box(&contacts).iter().map(|contact| {
                    law.force(&coefficients, contact, &L::Memory::default())
                        .normal
                });
                black_box(forces.sum::<f64>())
            });
        });
    group.finish();
}

fn laws(c: &mut Criterion) {
    let acrylic = Material::acrylic();
    let tsuji = HertzTsuji::new(acrylic);
    measure(c, "hertz_tsuji", &tsuji);
    measure(
        c,
        "hertz_tsuji_as_printed",
        &tsuji.friction(Friction::as_printed()),
    );
    measure(c, "hertz_mindlin", &HertzMindlin::new(acrylic));
}

criterion_group!(benches, laws);
criterion_main!(benches);
