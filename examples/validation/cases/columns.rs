//! Counting collisions: a column of beads on a wall, and two balls that count the digits of pi.

use std::f64::consts::PI;

use particle_damper::glam::{DVec3, dvec3};
use particle_damper::{
    AllPairs, ContactLaw, Damper, Damping, ElasticImpact, EventLog, HertzTsuji, Particle,
    RestitutionImpulse, Slot,
};

use super::Form;
use super::case::{Case, Tolerance};
use super::setup::acrylic;

const COLUMN: &str = "column of beads on a wall; Bernu & Mazighi, J. Phys. A 23 (1990) 5745";
const SHRINKING: &str = "eigenvalues of a round of collisions, and Hertz's contact time";
const DIGITS: &str = "Galperin 2003, doi 10.1070/RD2003v008n04ABEH000252";
const EXACTLY: Tolerance = Tolerance::Absolute(0.0);

/// Free gaps in m in front of beads, the wall's first.
const GAPS: [f64; 6] = [0.01, 0.02, 0.013, 0.017, 0.011, 0.019];
const RADIUS: f64 = 2e-3;
const MASS: f64 = 1e-4;

/// Collisions until the end, and the mean speed of what leaves.
#[derive(Debug, Clone, Copy)]
struct Outcome {
    collisions: usize,
    speed: f64,
    /// Mean square of the speeds out, m^2/s^2.
    square: f64,
    /// Time of the last collision in s, or of the end.
    end: f64,
}

/// So many collisions without an end are taken for no end.
const ENDLESS: usize = 4000;

/// Points on a line in front of a wall at zero, `gaps` apart, event by event, to [`ENDLESS`].
fn event_by_event(e: f64, gaps: &[f64], masses: &[f64], mut speed: Vec<f64>) -> Outcome {
    let mut place: Vec<f64> = Vec::new();
    for gap in gaps {
        place.push(place.last().unwrap_or(&0.0) + gap);
    }
    let (mut collisions, mut end) = (0, 0.0);
    while collisions < ENDLESS {
        // Pair n is body n and the one below it, or the wall.
        let gap = |n: usize| place[n] - if n > 0 { place[n - 1] } else { 0.0 };
        let closing = |n: usize| if n > 0 { speed[n - 1] } else { 0.0 } - speed[n];
        let fastest = speed
            .iter()
            .fold(0.0_f64, |most, speed| most.max(speed.abs()));
        let due = (0..gaps.len()).filter(|&n| closing(n) > 1e-12 * fastest);
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
        square: speed.iter().map(|own| own * own).sum::<f64>() / gaps.len() as f64,
        end,
    }
}

/// Bodies that come together more slowly (m/s) have parted: elastic ones leave side by side, to within rounding.
const PARTING: f64 = 1e-6;

/// Steps without gravity until a time, and on until all bodies leave the wall and one another, or as much time
/// again has gone; counts the contacts. (A restitution that is off by 4e-5 moves the last meeting of two beads of
/// 0.95, which come together at 2 mm/s, by half a second.)
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
    while damper.time() < 2.0 * until
        && (log.open().len() > 0 || closing(damper.particles()) > PARTING)
    {
        damper.step_watched(&mut log).unwrap();
    }
    let collisions = log.records().len();
    let count = damper.len() as f64;
    let speed = damper.particles().map(|body| body.velocity.x).sum::<f64>() / count;
    let squares = damper.particles().map(|body| body.velocity.x.powi(2));
    Outcome {
        collisions,
        speed,
        square: squares.sum::<f64>() / count,
        end: damper.time(),
    }
}

/// The largest speed (m/s) at which the first body nears the wall, or one the next; negative if all part.
fn closing(bodies: impl Iterator<Item = Particle>) -> f64 {
    let mut before = 0.0;
    let speeds = bodies.map(|body| {
        let closing = before - body.velocity.x;
        before = body.velocity.x;
        closing
    });
    speeds.fold(f64::NEG_INFINITY, f64::max)
}

/// Beads in front of the wall, `gaps` apart, that fall on it with 1 m/s.
fn column(gaps: &[f64]) -> Vec<Particle> {
    let mut x = -RADIUS;
    let beads = gaps.iter().map(|gap| {
        x += gap + 2.0 * RADIUS;
        Particle::new(RADIUS, MASS)
            .unwrap()
            .at(dvec3(x, 0.01, 0.0))
            .moving(DVec3::NEG_X)
    });
    beads.collect()
}

fn fallen(e: f64, gaps: &[f64]) -> Outcome {
    event_by_event(e, gaps, &[1.0; 6][..gaps.len()], vec![-1.0; gaps.len()])
}

fn by_coarse_law(e: f64, gaps: &[f64], until: f64) -> Outcome {
    let law = RestitutionImpulse::new(acrylic(e, 0.0));
    run(law, room(), column(gaps), 2e-5, until)
}

/// Under a force whose contacts last for `contact` (s) at 1 m/s, if elastic.
fn by_strict_law(e: f64, gaps: &[f64], until: f64, contact: f64) -> Outcome {
    let impact = ElasticImpact::lasting(contact, 0.5 * MASS, 1.0).unwrap();
    let hard = acrylic(e, 0.0).with_contact_stiffness(impact.stiffness(), 0.5 * RADIUS);
    let law = HertzTsuji::new(hard.unwrap()).damping(Damping::Tsuji);
    run(law, room(), column(gaps), 0.019 * contact, until)
}

fn room() -> Slot {
    Slot::new(200.0, 0.02).unwrap()
}

/// Collisions and mean speed of a run against the exact ones.
fn compare(cases: &mut Vec<Case>, name: &str, expected: &Outcome, got: &Outcome, close: f64) {
    let counts = [expected, got].map(|outcome| outcome.collisions as f64);
    let name_of = |what: &str| format!("{name}: {what}");
    let case = Case::new(name_of("collisions"), COLUMN, counts[0], counts[1], EXACTLY);
    cases.push(case);
    let close = Tolerance::Absolute(close);
    let case = Case::new(
        name_of("mean speed out"),
        COLUMN,
        expected.speed,
        got.speed,
        close,
    );
    cases.push(case);
}

fn column_cases(cases: &mut Vec<Case>, form: Form) {
    let largest = if form == Form::Short { 4 } else { 6 };
    for e in [1.0, 0.95, 0.9] {
        for count in 1..=largest {
            let gaps = &GAPS[..count];
            let expected = fallen(e, gaps);
            let name = format!("{count} beads, e {e}");
            let (number, formula) = if e > 0.99 {
                (count * (count + 1) / 2, "N(N + 1)/2")
            } else {
                (count * count, "N^2")
            };
            cases.push(Case::new(
                format!("{name}: {formula} event by event"),
                COLUMN,
                number as f64,
                expected.collisions as f64,
                EXACTLY,
            ));
            let until = expected.end + 0.01;
            let got = by_coarse_law(e, gaps, until);
            compare(cases, &format!("{name}, coarse law"), &expected, &got, 1e-9);
            // The last meeting of two at 0.95 is one that a slightly wrong restitution puts off.
            if form == Form::Long || until < 0.2 || (count == 2 && e > 0.94) {
                let got = by_strict_law(e, gaps, until, 1e-4);
                compare(cases, &format!("{name}, strict law"), &expected, &got, 1e-3);
            }
        }
    }
    for (count, row) in [(2, 0.809_75), (3, 0.728_07)] {
        let name = format!("{count} beads, e 0.9, printed row: mean speed out");
        let speed = fallen(0.9, &GAPS[..count]).speed;
        let close = Tolerance::Absolute(5e-6);
        cases.push(Case::new(name, COLUMN, row, speed, close));
    }
}

/// Below this restitution collisions of `count` beads find no end: exact for two; for three where they come in
/// their regular order, as from equal gaps.
fn collapse_limit(count: usize) -> f64 {
    let angle = 0.25 * PI * (1.0 - 1.0 / count as f64);
    angle.tan().powi(2)
}

/// Where a column of equal gaps collapses: more than 500 collisions, in which speeds fall by 1e70 and more.
fn collapse_found(count: usize) -> f64 {
    let (mut low, mut high) = (0.05, 0.9);
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if fallen(middle, &[0.01; 6][..count]).collisions > 500 {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

fn collapse_cases(cases: &mut Vec<Case>, form: Form) {
    for (count, row) in [(2, 0.171_57), (3, 1.0 / 3.0)] {
        let name = |what: &str| format!("{count} beads, collapse: {what}");
        let limit = collapse_limit(count);
        let close = Tolerance::Absolute(5e-6);
        cases.push(Case::new(name("printed row"), COLUMN, row, limit, close));
        let found = collapse_found(count);
        let close = Tolerance::Absolute(2e-4);
        cases.push(Case::new(
            name("event by event"),
            COLUMN,
            limit,
            found,
            close,
        ));
    }
    // As long as contacts and steps are short against the time between collisions, both laws follow.
    for (count, e) in [(2, 0.3), (2, 0.25), (2, 0.2), (3, 0.5), (3, 0.4), (3, 0.36)] {
        let gaps = &GAPS[..count];
        let expected = fallen(e, gaps);
        let until = expected.end + 0.01;
        let name = format!("{count} beads, e {e}");
        let got = by_coarse_law(e, gaps, until);
        compare(cases, &format!("{name}, coarse law"), &expected, &got, 1e-9);
        let contact = if expected.collisions > 20 { 1e-5 } else { 1e-4 };
        if form == Form::Long || contact > 2e-5 {
            let got = by_strict_law(e, gaps, until, contact);
            compare(cases, &format!("{name}, strict law"), &expected, &got, 5e-5);
        }
    }
    // Below, they end it where a contact or a step is as long as the time between collisions.
    for (count, e) in [
        (2, 0.14),
        (2, 0.12),
        (2, 0.1),
        (2, 0.08),
        (3, 0.32),
        (3, 0.2),
    ] {
        let gaps = &GAPS[..count];
        let until = fallen(e, gaps).end + 0.01;
        let name = |what: &str| format!("{count} beads, e {e}, collapse, {what}");
        let left = by_coarse_law(e, gaps, until).speed;
        let name_of = name("coarse law: mean speed out");
        cases.push(Case::bounded(name_of, COLUMN, 0.02, left));
        let (ratio, close) = match form {
            Form::Short => (0.1_f64, 0.05),
            Form::Long => (0.01, 0.03),
        };
        let [long, short] =
            [1.0, ratio].map(|part| by_strict_law(e, gaps, until, part * 1e-4).speed);
        if count == 2 {
            let slope = (long / short).ln() / ratio.recip().ln();
            let name = name("strict law: power of the contact time that the speed out goes with");
            let close = Tolerance::Absolute(close);
            cases.push(Case::new(name, SHRINKING, left_over(e), slope, close));
        } else {
            let name = name("strict law: speed out, contacts a tenth or less as long");
            cases.push(Case::bounded(name, COLUMN, 0.8 * long, short));
        }
    }
}

/// The power of the contact time at 1 m/s with which the speed goes that two beads have left: from round to
/// round (wall, pair) speeds shrink by L and gaps by l, the eigenvalues of the map of speeds, L + l = (1 - e)^2/2
/// and L l = e^2; so speeds go with the time between collisions to the power a = ln L/ln(l/L). It ends where a
/// contact lasts as long, T v^(-1/5), and v goes with T^(1/(1/a + 1/5)).
fn left_over(e: f64) -> f64 {
    let half = 0.25 * (1.0 - e).powi(2);
    let speeds = half + (half * half - e * e).sqrt();
    let gaps = e * e / speeds;
    let power = speeds.ln() / (gaps / speeds).ln();
    1.0 / (1.0 / power + 0.2)
}

/// Five beads of 0.75: what is left of their energy, where they come one by one and where they touch. Touching ones
/// hand a pulse through under the strict law; under the coarse law their blows are those of one step, and what is
/// left depends on their numbers.
fn touching_cases(cases: &mut Vec<Case>) {
    let apart = fallen(0.75, &GAPS[..5]);
    let printed = Tolerance::Absolute(1e-3);
    let left = |case: &str| format!("5 beads, e 0.75, {case}: part of the energy left");
    let coarse = by_coarse_law(0.75, &GAPS[..5], apart.end + 0.01).square;
    for (name, got) in [("event by event", apart.square), ("coarse law", coarse)] {
        cases.push(Case::new(left(name), COLUMN, 0.040, got, printed));
    }
    let touching = [0.01, 0.0, 0.0, 0.0, 0.0];
    let strict = by_strict_law(0.75, &touching, 0.02, 1e-5).square;
    let name = left("touching, strict law");
    let printed = Tolerance::Absolute(5e-3);
    cases.push(Case::new(name, COLUMN, 0.71, strict, printed));
    let coarse = by_coarse_law(0.75, &touching, 0.02).square;
    let name = left("touching, coarse law");
    cases.push(Case::bounded(name, COLUMN, 0.2, coarse));
}

/// Wall, a ball at rest, and one 100^k as heavy coming in, elastic: under a force to k = 1, and 2 in the long form.
fn digits_cases(cases: &mut Vec<Case>, form: Form) {
    let (largest, by_force) = if form == Form::Short { (2, 1) } else { (3, 2) };
    for (k, number) in (0..=largest).zip([3.0, 31.0, 314.0, 3141.0]) {
        let ratio = 10_f64.powi(k);
        let radius = 0.05;
        let balls = || {
            let light = Particle::new(radius, 1.0).unwrap();
            let heavy = Particle::new(radius, ratio * ratio).unwrap();
            vec![
                light.at(dvec3(1.0 + radius, 0.1, 0.0)),
                heavy
                    .at(dvec3(1.2 + 3.0 * radius, 0.1, 0.0))
                    .moving(DVec3::NEG_X),
            ]
        };
        let slot = Slot::new(2e3, 0.2).unwrap();
        let exact = event_by_event(1.0, &[1.0, 0.2], &[1.0, ratio * ratio], vec![0.0, -1.0]);
        // The light ball goes to and fro in 2/ratio^2 at the closest.
        let step = 5e-3_f64.min(0.1 / (ratio * ratio));
        let law = RestitutionImpulse::new(acrylic(1.0, 0.0));
        let coarse = run(law, slot, balls(), step, exact.end + 0.1).collisions;
        let mut counts = vec![("coarse law", coarse)];
        if k <= by_force {
            let contact = 0.1 / (ratio * ratio);
            let impact = ElasticImpact::lasting(contact, 1.0, ratio).unwrap();
            let hard = acrylic(1.0, 0.0).with_contact_stiffness(impact.stiffness(), 0.5 * radius);
            let law = HertzTsuji::new(hard.unwrap()).reference_speed(ratio);
            let step = 0.01 * contact;
            let strict = run(law.unwrap(), slot, balls(), step, exact.end + 0.1);
            counts.push(("strict law", strict.collisions));
        }
        for (law, got) in counts {
            let name = format!("wall, ball 1, ball 100^{k}, {law}: collisions");
            cases.push(Case::new(name, DIGITS, number, got as f64, EXACTLY));
        }
    }
}

pub(crate) fn cases(form: Form) -> Vec<Case> {
    let mut cases = Vec::new();
    column_cases(&mut cases, form);
    collapse_cases(&mut cases, form);
    touching_cases(&mut cases);
    digits_cases(&mut cases, form);
    cases
}
