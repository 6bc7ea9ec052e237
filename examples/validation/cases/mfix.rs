//! MFIX-DEM's verification cases DEM01 to DEM04: a bouncing ball and two stacked balls under a linear
//! spring and dashpot, which is written here as a law of a downstream crate, and slip to rolling.

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    Bodies, Contact, ContactForce, ContactLaw, Cuboid, Damper, ForceLaw, Forces, HertzMindlin,
    HertzTsuji, Integrator, LawError, Particle, RestitutionImpulse, RungeKutta4, Slot,
    VelocityVerlet,
};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::material;

const BALL: &str = "Garg et al. 2012 (MFIX-DEM 01, 02), doi 10.1016/j.powtec.2011.09.019";
const STACK: &str = "Garg et al. 2012 (MFIX-DEM 03), doi 10.1016/j.powtec.2011.09.019";
const ROLL: &str =
    "Garg et al. 2012 (MFIX-DEM 04), doi 10.1016/j.powtec.2011.09.019; 2 u0/(7 mu g), 5 u0/7";
const G: f64 = 9.81;

/// F = k d + c d', the same for every pair; c from the restitution coefficient and m*.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SpringDashpot {
    /// Stiffness k in N/m.
    pub(crate) stiffness: f64,
    /// Restitution coefficient of a free impact.
    pub(crate) restitution: f64,
}

impl SpringDashpot {
    fn damping_ratio(&self) -> f64 {
        let log = self.restitution.ln();
        -log / (std::f64::consts::PI.powi(2) + log * log).sqrt()
    }
}

/// c in N s/m and the longest step in s.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Prepared {
    damping: f64,
    longest: f64,
}

impl ContactLaw for SpringDashpot {
    type Kind = Forces;
    type Coefficients = Prepared;

    fn coefficients(&self, bodies: &Bodies) -> Result<Prepared, LawError> {
        let m = bodies.effective_mass();
        Ok(Prepared {
            damping: 2.0 * self.damping_ratio() * (m * self.stiffness).sqrt(),
            longest: 0.2 * std::f64::consts::PI * (m / self.stiffness).sqrt(),
        })
    }

    fn time_step_limit(&self, own: &Prepared) -> f64 {
        own.longest
    }
}

impl ForceLaw for SpringDashpot {
    type Memory = ();

    fn force(&self, own: &Prepared, contact: &Contact, (): &()) -> ContactForce {
        let force = self.stiffness * contact.overlap + own.damping * contact.approach_speed();
        ContactForce::new(force, DVec3::ZERO)
    }
}

pub(crate) fn cases(_: Form) -> Vec<Case> {
    let mut cases = bouncing();
    cases.extend(stacked());
    cases.extend(rolling());
    cases
}

/// Speed after a contact under gravity that begins at `v`: s" + 2 z w s' + w^2 s = g from s = 0,
/// s' = v, until s is back at zero. In closed form; the end by bisection.
fn speed_after(v: f64, w: f64, z: f64) -> (f64, f64) {
    let wd = w * (1.0 - z * z).sqrt();
    let rest = G / (w * w);
    let at = |t: f64| {
        let (sine, cosine) = (wd * t).sin_cos();
        let fade = (-z * w * t).exp();
        let b = (v - z * w * rest) / wd;
        let s = rest + fade * (b * sine - rest * cosine);
        let rate = fade * ((b * wd + z * w * rest) * cosine + (rest * wd - z * w * b) * sine);
        (s, rate)
    };
    let (mut low, mut high) = (
        0.5 * std::f64::consts::PI / wd,
        2.0 * std::f64::consts::PI / wd,
    );
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if at(middle).0 > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    (-at(low).1, low)
}

/// DEM01, DEM02: heights of a ball that bounces on a spring and dashpot, and when it gets there.
fn bouncing() -> Vec<Case> {
    let mut cases = Vec::new();
    for (radius, density, k, e, drop) in [
        (0.1, 2600.0, 5e4, 0.9, 0.5),
        (0.1, 2600.0, 5e6, 0.6, 0.5),
        (3e-3, 1768.0, 1e4, 0.75, 0.05),
    ] {
        let law = SpringDashpot {
            stiffness: k,
            restitution: e,
        };
        let ball = Particle::with_density(radius, density).unwrap();
        let w = (k / ball.mass).sqrt();
        let dt = 1e-3 / w;
        let side = 20.0 * radius + 2.0 * drop;
        let mut damper = Damper::builder(Cuboid::new(DVec3::splat(side)).unwrap(), law)
            .integrator(RungeKutta4::default())
            .particles([ball.at(dvec3(0.5 * side, radius + drop, 0.5 * side))])
            .gravity(DVec3::NEG_Y * G)
            .time_step(dt)
            .build()
            .unwrap();
        let (mut height, mut time) = (drop, 0.0);
        for bounce in 1..=3 {
            let down = (2.0 * G * height).sqrt();
            let (up, contact) = speed_after(down, w, law.damping_ratio());
            time += (down + up) / G + contact;
            height = up * up / (2.0 * G);
            // To the apex: the sign of the velocity changes twice.
            let mut before;
            loop {
                before = damper.particle(0).unwrap();
                damper.step().unwrap();
                let now = damper.particle(0).unwrap();
                if before.velocity.y > 0.0 && now.velocity.y <= 0.0 {
                    break;
                }
            }
            let rest = before.velocity.y / G;
            let apex = before.position.y - radius + 0.5 * G * rest * rest;
            let at = damper.time() - dt + rest;
            let name =
                |what| format!("ball r {radius} m, k {k} N/m, e {e}, bounce {bounce}: {what}");
            // The dashpot sets in with a jump, of which a step misses half at the worst: that
            // changes the speed by z w dt of itself, the height by twice that, at every bounce.
            let missed = law.damping_ratio() * w * dt;
            let close = Tolerance::Relative(2.0 * f64::from(bounce) * missed);
            cases.push(Case::new(name("height (m)"), BALL, height, apex, close));
            cases.push(Case::new(
                name("time of the apex (s)"),
                BALL,
                time,
                at,
                close,
            ));
        }
    }
    cases
}

/// DEM03's balls between walls: the equation of motion of their two heights.
pub(crate) fn stack_rates(masses: [f64; 2], k: f64, e: f64, radius: f64, y: [f64; 4]) -> [f64; 4] {
    let law = SpringDashpot {
        stiffness: k,
        restitution: e,
    };
    let c = |m: f64| 2.0 * law.damping_ratio() * (m * k).sqrt();
    let [m1, m2] = masses;
    let [y1, y2, v1, v2] = y;
    let floor = k * (radius - y1) - c(m1) * v1;
    let lid = k * (radius - (3.6 * radius - y2)) + c(m2) * v2;
    let pair = k * (2.0 * radius - (y2 - y1)) - c(m1 * m2 / (m1 + m2)) * (v2 - v1);
    [v1, v2, (floor - pair) / m1 - G, (pair - lid) / m2 - G]
}

/// The stack at `time`, by Runge-Kutta steps of a two-thousandth of what the crate takes.
pub(crate) fn stack_at(masses: [f64; 2], k: f64, e: f64, radius: f64, time: f64) -> [f64; 4] {
    let mut y = [0.9 * radius, 2.7 * radius, 0.0, 0.0];
    let steps = 200_000;
    let h = time / f64::from(steps);
    let along = |y: [f64; 4], slope: [f64; 4], h: f64| std::array::from_fn(|n| y[n] + h * slope[n]);
    for _ in 0..steps {
        let a = stack_rates(masses, k, e, radius, y);
        let b = stack_rates(masses, k, e, radius, along(y, a, 0.5 * h));
        let c = stack_rates(masses, k, e, radius, along(y, b, 0.5 * h));
        let d = stack_rates(masses, k, e, radius, along(y, c, h));
        y = std::array::from_fn(|n| y[n] + h / 6.0 * (a[n] + 2.0 * b[n] + 2.0 * c[n] + d[n]));
    }
    y
}

/// DEM03's balls under the crate, after `steps` of them to `time`: heights and velocities.
pub(crate) fn stack_by_crate<I: Integrator>(
    integrator: I,
    densities: [f64; 2],
    k: f64,
    e: f64,
    (radius, time, steps): (f64, f64, u32),
) -> [f64; 4] {
    let law = SpringDashpot {
        stiffness: k,
        restitution: e,
    };
    let ball = |n: usize, height: f64| {
        let ball = Particle::with_density(radius, densities[n]).unwrap();
        ball.at(dvec3(5.0 * radius, height * radius, 0.0))
    };
    let mut damper = Damper::builder(Slot::new(10.0 * radius, 3.6 * radius).unwrap(), law)
        .integrator(integrator)
        .particles([ball(0, 0.9), ball(1, 2.7)])
        .initial_overlap(0.25)
        .gravity(DVec3::NEG_Y * G)
        .time_step(time / f64::from(steps))
        .build()
        .unwrap();
    for _ in 0..steps {
        damper.step().unwrap();
    }
    let [a, b] = [0, 1].map(|n| damper.particle(n).unwrap());
    [a.position.y, b.position.y, a.velocity.y, b.velocity.y]
}

/// DEM03: two balls of unequal density, pressed between a floor and a lid.
fn stacked() -> Vec<Case> {
    let mut cases = Vec::new();
    let (radius, densities) = (5e-4, [2e4, 1e4]);
    let volume = 4.0 / 3.0 * std::f64::consts::PI * f64::powi(radius, 3);
    let masses = densities.map(|density| density * volume);
    for (k, e) in [(1e3, 1.0), (1e3, 0.9), (1e3, 0.5), (3e3, 0.7)] {
        for time in [2e-4, 1e-3] {
            let expected = stack_at(masses, k, e, radius, time);
            let plan = (radius, time, 1000);
            let verlet = stack_by_crate(VelocityVerlet, densities, k, e, plan);
            let kutta = stack_by_crate(RungeKutta4::default(), densities, k, e, plan);
            for (got, integrator) in [(verlet, "VelocityVerlet"), (kutta, "RungeKutta4")] {
                for n in 0..2 {
                    let name = format!(
                        "stack, k {k} N/m, e {e}, {time} s, {integrator}: height {} (m)",
                        n + 1
                    );
                    let close = Tolerance::Relative(1e-4);
                    cases.push(Case::new(name, STACK, expected[n], got[n], close));
                }
            }
        }
    }
    cases
}

/// DEM04: a ball set down sliding on the floor comes to roll.
fn rolling() -> Vec<Case> {
    let mut cases = Vec::new();
    let (radius, u0) = (5e-4, 0.1);
    for mu in [0.2, 0.4, 0.6, 0.8, 1.0] {
        let stuff = material(1e8, 0.3, 0.5, mu);
        let ball = Particle::with_density(radius, 1e4).unwrap();
        let k = super::setup::hertz_constant((radius, 1e8, 0.3), (f64::INFINITY, 1e8, 0.3));
        let sunk = (ball.mass * G / k).powf(2.0 / 3.0);
        let tsuji = HertzTsuji::new(stuff).reference_speed(u0).unwrap();
        let mindlin = HertzMindlin::new(stuff).reference_speed(u0).unwrap();
        let impulse = RestitutionImpulse::new(stuff).reference_speed(u0).unwrap();
        for (law, [end, speed, surface]) in [
            ("HertzTsuji", roll(tsuji, ball, sunk, u0, 5e-6)),
            ("HertzMindlin", roll(mindlin, ball, sunk, u0, 5e-6)),
            ("RestitutionImpulse", roll(impulse, ball, 0.0, u0, 1e-5)),
        ] {
            let name = |what| format!("slip to roll, mu {mu}, {law}: {what}");
            let close = Tolerance::Relative(3e-3);
            let due = 2.0 * u0 / (7.0 * mu * G);
            cases.push(Case::new(name("end of slip (s)"), ROLL, due, end, close));
            let due = 5.0 / 7.0 * u0;
            cases.push(Case::new(name("u (m/s)"), ROLL, due, speed, close));
            cases.push(Case::new(name("w r (m/s)"), ROLL, due, surface, close));
        }
    }
    cases
}

/// When slip ends (from its course between 90 % and 10 %), and u and w r at three times that.
fn roll<L: ContactLaw>(law: L, ball: Particle, sunk: f64, u0: f64, dt: f64) -> [f64; 3] {
    let start = dvec3(5e-3, ball.radius - sunk, 5e-3);
    let mut damper = Damper::builder(Cuboid::new(dvec3(0.05, 0.01, 0.01)).unwrap(), law)
        .particles([ball.at(start).moving(DVec3::X * u0)])
        .gravity(DVec3::NEG_Y * G)
        .time_step(dt)
        .build()
        .unwrap();
    let state = |ball: Particle| (ball.velocity.x, -ball.spin.z * ball.radius);
    let mut crossings = [0.0; 2];
    let mut slip = u0;
    let mut rest = 2;
    while rest > 0 {
        damper.step().unwrap();
        let (u, surface) = state(damper.particle(0).unwrap());
        let now = u - surface;
        let level = u0 * [0.1, 0.9][rest - 1];
        if now <= level {
            crossings[rest - 1] = damper.time() - dt * (level - now) / (slip - now);
            rest -= 1;
        }
        slip = now;
    }
    let [late, early] = crossings;
    let end = late + (late - early) / 8.0;
    while damper.time() < 3.0 * end {
        damper.step().unwrap();
    }
    let (u, surface) = state(damper.particle(0).unwrap());
    [end, u, surface]
}
