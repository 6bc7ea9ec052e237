use particle_damper::excitation::Harmonic;
use particle_damper::*;
fn main() {
    let a: Vec<f64> = std::env::args()
        .skip(1)
        .map(|a| a.parse().unwrap())
        .collect();
    let (n, f, dt, t) = (a[0] as usize, a[1], a[2], a[3]);
    let mut damper = Damper::builder(Slot::paper(), RestitutionImpulse::new(Material::acrylic()))
        .mount(
            SingleDof::paper()
                .excited_by(Harmonic::new(a.get(4).copied().unwrap_or(0.25), f).unwrap()),
        )
        .detector(Skin::new(CellGrid::paper(), 1.0 / 3.0).unwrap())
        .integrator(VelocityVerlet::default())
        .particles(
            Filling::new(1)
                .with(n, Particle::new(3e-3, 0.2e-3).unwrap())
                .fill(&Slot::paper())
                .unwrap(),
        )
        .time_step(dt)
        .build()
        .unwrap();
    let steps = (t / dt).round() as u64;
    let start = std::time::Instant::now();
    for _ in 0..steps {
        damper.step().unwrap();
    }
    println!(
        "{:.1} ns per particle step",
        start.elapsed().as_secs_f64() / steps as f64 / n as f64 * 1e9
    );
}
