//! Counting collisions: a column of beads on a wall, and two balls that count the digits of pi.

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    AllPairs, ContactLaw, Damper, Damping, ElasticImpact, EventLog, HertzTsuji, Particle,
    RestitutionImpulse, Slot,
};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::acrylic;

const COLUMN: &str = "column of beads on a wall; Bernu & Mazighi, J. Phys. A 23 (1990) 5745";
const DIGITS: &str = "Galperin 2003, doi 10.1070/RD2003v008n04ABEH000252";
const EXACTLY: Tolerance = Tolerance::Absolute(0.0);

/// Free gaps in m in front of beads, the wall's first.
const GAPS: [f64; 6] = [0.01, 0.02, 0.013, 0.017, 0.011, 0.019];
const RADIUS: f64 = 2e-3;

/// Collisions until the end, and the mean speed of what leaves.
#[derive(Debug, Clone, Copy)]
struct Outcome {
    collisions: usize,
    speed: f64,
    /// Time of the last collision in s, or of the end.
    end: f64,
}

/// Points on a line in front of a wall at zero, `gaps` apart, event by event.
fn event_by_event(e: f64, gaps: &[f64], masses: &[f64], mut speed: Vec<f64>) -> Outcome {
    let mut place: Vec<f64> = Vec::new();
    for gap in gaps {
        place.push(place.last().unwrap_or(&0.0) + gap);
    }
    let (mut collisions, mut end) = (0, 0.0);
    loop {
        // Pair n is body n and the one below it, or the wall.
        let gap = |n: usize| place[n] - if n > 0 { place[n - 1] } else { 0.0 };
        let closing = |n: usize| if n > 0 { speed[n - 1] } else { 0.0 } - speed[n];
        let due = (0..gaps.len()).filter(|&n| closing(n) > 1e-12);
        let Some((n, time)) = due
            .map(|n| (n, gap(n).max(0.0) / closing(n)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
        else {
            break;
        };
        for (place, speed) in place.iter_mut().zip(&speed) {
            *place += speed * time;
        }
        collisions += 1;
        end += time;
        if n == 0 {
            speed[0] *= -e;
        } else {
            let share = masses[n] / (masses[n - 1] + masses[n]);
            let change = (1.0 + e) * closing(n);
            speed[n - 1] -= share * change;
            speed[n] += (1.0 - share) * change;
        }
    }
    Outcome {
        collisions,
        speed: speed.iter().sum::<f64>() / gaps.len() as f64,
        end,
    }
}

/// Steps until a time, without gravity, and counts the contacts.
fn run<L: ContactLaw>(
    law: L,
    slot: Slot,
    bodies: Vec<Particle>,
    time_step: f64,
    until: f64,
) -> Outcome {
    let mut damper = Damper::builder(slot, law)
        .detector(AllPairs)
        .gravity(DVec3::ZERO)
        .particles(bodies)
        .time_step(time_step)
        .build()
        .unwrap();
    let mut log = EventLog::new();
    while damper.time() < until {
        damper.step_watched(&mut log).unwrap();
    }
    let collisions = log.records().len();
    let speed = damper.particles().map(|body| body.velocity.x).sum::<f64>() / damper.len() as f64;
    Outcome {
        collisions,
        speed,
        end: until,
    }
}

fn column(count: usize) -> Vec<Particle> {
    let mut x = -RADIUS;
    let beads = GAPS[..count].iter().map(|gap| {
        x += gap + 2.0 * RADIUS;
        Particle::new(RADIUS, 1e-4)
            .unwrap()
            .at(dvec3(x, 0.01, 0.0))
            .moving(DVec3::NEG_X)
    });
    beads.collect()
}

fn column_cases(cases: &mut Vec<Case>, form: Form) {
    let slot = Slot::new(200.0, 0.02).unwrap();
    let largest = if form == Form::Short { 4 } else { 6 };
    for e in [1.0, 0.95, 0.9] {
        for count in 1..=largest {
            let expected = event_by_event(e, &GAPS[..count], &[1.0; 6], vec![-1.0; count]);
            let name = format!("{count} beads, e {e}");
            if e > 0.99 {
                let number = (count * (count + 1) / 2) as f64;
                let name = format!("{name}: N(N + 1)/2 event by event");
                cases.push(Case::new(
                    name,
                    COLUMN,
                    number,
                    expected.collisions as f64,
                    EXACTLY,
                ));
            } else if count <= 3 {
                let number = (count * count) as f64;
                let name = format!("{name}: N^2 event by event");
                cases.push(Case::new(
                    name,
                    COLUMN,
                    number,
                    expected.collisions as f64,
                    EXACTLY,
                ));
            }
            let mut check = |law: &str, got: Outcome, close| {
                let (collisions, speed) = (expected.collisions as f64, expected.speed);
                let name = format!("{name}, {law}");
                cases.push(Case::new(
                    format!("{name}: collisions"),
                    COLUMN,
                    collisions,
                    got.collisions as f64,
                    EXACTLY,
                ));
                cases.push(Case::new(
                    format!("{name}: mean speed out"),
                    COLUMN,
                    speed,
                    got.speed,
                    close,
                ));
            };
            let coarse = RestitutionImpulse::new(acrylic(e, 0.0));
            let until = expected.end + 0.01;
            let got = run(coarse, slot, column(count), 2e-5, until);
            check("coarse law", got, Tolerance::Absolute(1e-9));
            if form == Form::Short && until > 0.2 {
                continue;
            }
            let impact = ElasticImpact::lasting(1e-4, 5e-5, 1.0).unwrap();
            let hard = acrylic(e, 0.0).with_contact_stiffness(impact.stiffness(), 0.5 * RADIUS);
            let strict = HertzTsuji::new(hard.unwrap()).damping(Damping::Tsuji);
            let got = run(strict, slot, column(count), 1.9e-6, until);
            check("strict law", got, Tolerance::Absolute(1e-3));
        }
    }
    for (count, row) in [(2, 0.809_75), (3, 0.728_07)] {
        let name = format!("{count} beads, e 0.9, printed row: mean speed out");
        let speed = event_by_event(0.9, &GAPS[..count], &[1.0; 6], vec![-1.0; count]).speed;
        cases.push(Case::new(
            name,
            COLUMN,
            row,
            speed,
            Tolerance::Absolute(5e-6),
        ));
    }
}

/// Wall, a ball at rest, and one 100^k as heavy coming in, elastic.
fn digits_cases(cases: &mut Vec<Case>, form: Form) {
    let largest = if form == Form::Short { 2 } else { 3 };
    for (k, number) in (0..=largest).zip([3.0, 31.0, 314.0, 3141.0]) {
        let ratio = 10_f64.powi(k);
        let radius = 0.05;
        let balls = vec![
            Particle::new(radius, 1.0)
                .unwrap()
                .at(dvec3(1.0 + radius, 0.1, 0.0)),
            Particle::new(radius, ratio * ratio)
                .unwrap()
                .at(dvec3(1.2 + 3.0 * radius, 0.1, 0.0))
                .moving(DVec3::NEG_X),
        ];
        let slot = Slot::new(2e3, 0.2).unwrap();
        let law = RestitutionImpulse::new(acrylic(1.0, 0.0));
        let exact = event_by_event(1.0, &[1.0, 0.2], &[1.0, ratio * ratio], vec![0.0, -1.0]);
        // The light ball goes to and fro in 2/ratio^2 at the closest.
        let step = 5e-3_f64.min(0.1 / (ratio * ratio));
        let got = run(law, slot, balls, step, exact.end + 0.1);
        let name = format!("wall, ball 1, ball 100^{k}: collisions");
        cases.push(Case::new(
            name,
            DIGITS,
            number,
            got.collisions as f64,
            EXACTLY,
        ));
    }
}

pub(crate) fn cases(form: Form) -> Vec<Case> {
    let mut cases = Vec::new();
    column_cases(&mut cases, form);
    digits_cases(&mut cases, form);
    cases
}
