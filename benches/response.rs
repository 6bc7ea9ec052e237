//! One point of the paper's response curve: 20 periods discarded and 40 averaged at 6 Hz, against the
//! number of particles.

use std::ops::ControlFlow;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use particle_damper::response::Point;
use particle_damper::{ContactLaw, HertzTsuji, Material, ResponseCurve, RestitutionImpulse};

fn measure<L: ContactLaw + Clone>(c: &mut Criterion, name: &str, curve: &ResponseCurve<L>) {
    let mut group = c.benchmark_group("response");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(1))
        .measurement_time(Duration::from_secs(1));
    for particles in [0, 20, 60] {
        let point = Point {
            particles,
            seed: 1,
            amplitude: 0.25,
            frequency: 6.0,
        };
        group
            .throughput(Throughput::Elements(particles as u64))
            .bench_function(BenchmarkId::new(name, particles), |bencher| {
                bencher.iter(|| curve.measure(point, |_| ControlFlow::Continue(())).unwrap());
            });
    }
    group.finish();
}

fn curves(c: &mut Criterion) {
    let acrylic = Material::acrylic();
    let strict = ResponseCurve::new(HertzTsuji::new(acrylic)).time_step(2e-5);
    measure(c, "hertz_tsuji", &strict);
    measure(
        c,
        "restitution",
        &ResponseCurve::new(RestitutionImpulse::new(acrylic)),
    );
}

criterion_group!(benches, curves);
criterion_main!(benches);
