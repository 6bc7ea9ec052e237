use particle_damper::*;
fn main() {
    let a: Vec<f64> = std::env::args()
        .skip(1)
        .map(|a| a.parse().unwrap())
        .collect();
    let (n, e, dt, t) = (a[0] as usize, a[1], a[2], a[3]);
    let material = Material::new(0.4e9, 0.3, Interaction::new(e, 0.2).unwrap()).unwrap();
    let slot = Slot::paper();
    let mut damper = Damper::builder(slot.clone(), RestitutionImpulse::new(material))
        .particles(
            Filling::new(a.get(4).map_or(1, |s| *s as u64))
                .with(n, Particle::new(3e-3, 0.2e-3).unwrap())
                .fill(&slot)
                .unwrap(),
        )
        .time_step(dt)
        .build()
        .unwrap();
    let mut reference: Vec<glam::DVec3> = vec![];
    let mut last: Vec<glam::DVec3> = vec![];
    let every = (t / 12.0 / dt) as u64;
    for k in 0..12 {
        for _ in 0..every {
            damper.step().unwrap();
        }
        let now: Vec<glam::DVec3> = damper.particles().map(|p| p.position).collect();
        let v = damper
            .particles()
            .map(|p| p.velocity.length())
            .fold(0.0, f64::max);
        if k == 1 {
            reference = now.clone();
            last = now.clone();
        }
        if k > 1 {
            let d = |r: &Vec<glam::DVec3>| {
                now.iter()
                    .zip(r)
                    .map(|(a, b)| a.distance(*b))
                    .fold(0.0, f64::max)
                    / 3e-3
            };
            println!(
                "{:.2} s drift {:.2e} r, in window {:.2e}, vmax {:.2e} g dt, overlap {:.2e}",
                damper.time(),
                d(&reference),
                d(&last),
                v / 9.81 / dt,
                damper.largest_overlap() / 3e-3
            );
        }
        last = now;
    }
}
