//! Everything with a known answer, in its long form: a table on the screen and as a file, and the
//! plots that are compared by eye.
//!
//! `cargo run --release --example validation` leaves `target/validation/validation.csv` and four
//! pictures beside it; `-- --quick` takes the short form. It fails if a case does. Names of families
//! (`-- contacts rest`) restrict it to those, `-- pictures` to the pictures.
//!
//! `cargo test` runs every family in its short form; `cargo test --example validation -- contacts` runs one.

mod cases;
#[path = "../support/chart.rs"]
mod chart;
#[path = "../support/output.rs"]
#[allow(dead_code)] // Shared by the examples, each of which uses a part.
mod output;

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use cases::case::{Case, Tolerance};
use cases::oblique::{Law, MEASURED, rebound, rigid_e_t};
use cases::{FAMILIES, Form, contacts, impact_damper, inelastic};
use chart::{Chart, Line, POINTS};
use particle_damper::{Damping, Ending};
use plotters::prelude::SeriesLabelPosition;

/// Stands for the pictures among the families.
const PICTURES: &str = "pictures";

type Failure = Box<dyn Error + Send + Sync>;

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let form = if arguments.iter().any(|argument| argument == "--quick") {
        Form::Short
    } else {
        Form::Long
    };
    let named: Vec<&String> = arguments.iter().filter(|name| *name != "--quick").collect();
    for name in &named {
        if *name != PICTURES && !FAMILIES.iter().any(|(family, _)| family == name) {
            let known: Vec<&str> = FAMILIES.iter().map(|(family, _)| *family).collect();
            return Err(format!("{name} is none of {}, {PICTURES}", known.join(", ")).into());
        }
    }

    let (mut rows, mut failed) = (Vec::new(), 0);
    for (family, compute) in FAMILIES {
        if !named.is_empty() && !named.iter().any(|name| name == family) {
            continue;
        }
        let begin = Instant::now();
        println!("\n{family} ...");
        let cases = compute(form);
        let broken = cases.iter().filter(|case| !case.holds()).count();
        failed += broken;
        println!(
            "{family}: {} cases, {broken} fail, {:.1} s",
            cases.len(),
            begin.elapsed().as_secs_f64()
        );
        for case in &cases {
            println!("  {}", on_screen(case));
            rows.push(as_row(family, case));
        }
    }
    let directory = output::directory("validation")?;
    println!();
    output::write_table(
        &directory.join("validation.csv"),
        "family,case,source,expected,got,deviation,tolerance,kind,verdict",
        rows.iter().cloned(),
    )?;
    if named.is_empty() || named.iter().any(|name| *name == PICTURES) {
        draw(&directory)?;
    }
    println!("{} cases, {failed} fail", rows.len());
    if failed > 0 {
        return Err(format!("{failed} cases fail").into());
    }
    Ok(())
}

fn on_screen(case: &Case) -> String {
    let bound = match case.tolerance {
        Tolerance::Absolute(bound) => format!("+-{bound:.1e}"),
        Tolerance::Relative(bound) => format!("+-{bound:.1e} rel"),
        Tolerance::AtMost => "at most".into(),
    };
    format!(
        "{} {:<90} expected {:>14.7e} got {:>14.7e} deviation {:>9.2e} ({bound}) [{}]",
        case.verdict(),
        case.name,
        case.expected,
        case.got,
        case.deviation(),
        case.source
    )
}

fn as_row(family: &str, case: &Case) -> String {
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    let (kind, bound) = match case.tolerance {
        Tolerance::Absolute(bound) => ("absolute", bound),
        Tolerance::Relative(bound) => ("relative", bound),
        Tolerance::AtMost => ("at most", 0.0),
    };
    format!(
        "{family},{},{},{:e},{:e},{:e},{bound:e},{kind},{}",
        quoted(&case.name),
        quoted(case.source),
        case.expected,
        case.got,
        case.deviation(),
        case.verdict()
    )
}

fn line(label: &str, colour: usize, dash: i32, marked: bool, points: Vec<(f64, f64)>) -> Line {
    Line {
        label: label.into(),
        colour,
        dash,
        marked,
        points,
    }
}

fn draw(directory: &Path) -> Result<(), Failure> {
    restitution(&directory.join("restitution.svg"))?;
    oblique(&directory.join("oblique.svg"))?;
    masri_caughey(&directory.join("masri_caughey.svg"))?;
    loss(&directory.join("loss.svg"))
}

/// Restitution against impact speed: 0.75 asked for at 1 m/s.
fn restitution(path: &Path) -> Result<(), Failure> {
    let speeds = (-20..=10).map(|n| 10.0_f64.powf(0.1 * f64::from(n)));
    let curve = |damping| -> Vec<(f64, f64)> {
        let at = |v| {
            (
                v,
                contacts::restitution_at(damping, Ending::NeverPulling, 0.75, v),
            )
        };
        speeds.clone().map(at).collect()
    };
    let theory = |v: f64| {
        let beta = Damping::Viscoelastic.number(0.75, Ending::NeverPulling)?;
        Damping::Viscoelastic.restitution(beta * v.powf(0.2), Ending::NeverPulling)
    };
    let theory: Result<Vec<_>, _> = speeds.clone().map(|v| Ok((v, theory(v)?))).collect();
    let theory: Vec<(f64, f64)> = theory.map_err(|error: particle_damper::ValueError| error)?;
    let chart = Chart {
        title: "Restitution of a particle at a wall, 0.75 asked for at 1 m/s",
        axes: ["impact speed (m/s)", "restitution coefficient"],
        x: 0.01..10.0,
        y: 0.6..0.95,
        logarithmic: [true, false],
        legend: SeriesLabelPosition::UpperRight,
    };
    let constant = speeds.clone().map(|v| (v, 0.75)).collect();
    let half = curve(Damping::Viscoelastic);
    let lines = [
        line("d^(1/2) damping, exact", 0, 0, false, theory),
        line("d^(1/2) damping, HertzTsuji", 1, POINTS, true, half),
        line("d^(1/4) damping, exact", 3, 0, false, constant),
        line(
            "d^(1/4) damping, HertzTsuji",
            2,
            POINTS,
            true,
            curve(Damping::Tsuji),
        ),
    ];
    chart.draw(path, &lines)?;
    output::say_where("picture", path);
    Ok(())
}

/// e_t against the angle, with the points measured by Kharaz, Gorham and Salman.
fn oblique(path: &Path) -> Result<(), Failure> {
    let angles = || (1..=85).map(f64::from);
    let curve = |law| -> Vec<(f64, f64)> {
        let at = |angle: f64| {
            let [along, ..] = rebound(law, angle, 0.092, 0.98);
            (angle, along / (3.9 * angle.to_radians().sin()))
        };
        angles().map(at).collect()
    };
    let rigid = angles()
        .map(|angle| (angle, rigid_e_t(angle, 0.092, 0.98)))
        .collect();
    let chart = Chart {
        title: "Oblique impact of aluminium oxide on glass: 3.9 m/s, e 0.98, mu 0.092",
        axes: [
            "angle from the normal (degrees)",
            "tangential speed after / before",
        ],
        x: 0.0..90.0,
        y: 0.5..1.0,
        logarithmic: [false, false],
        legend: SeriesLabelPosition::LowerRight,
    };
    let lines = [
        line("rigid bodies", 0, 0, false, rigid),
        line("HertzTsuji", 1, 6, false, curve(Law::HertzTsuji)),
        line("HertzMindlin", 2, 0, false, curve(Law::HertzMindlin)),
        line(
            "RestitutionImpulse",
            3,
            2,
            false,
            curve(Law::RestitutionImpulse),
        ),
        line(
            "measured, Kharaz, Gorham & Salman 2001",
            4,
            POINTS,
            true,
            MEASURED.into(),
        ),
    ];
    chart.draw(path, &lines)?;
    output::say_where("picture", path);
    Ok(())
}

/// RMS of an oscillator with one free mass, against its travel.
fn masri_caughey(path: &Path) -> Result<(), Failure> {
    let (m, e, f) = (8.6e-3, 0.6, 6.0288);
    let travels = || (12..=32).map(|n| 2e-3 * f64::from(n));
    let theory = travels().filter_map(|d| {
        let solved = impact_damper::two_impacts(m, e, d, f)?;
        Some((1e3 * d, 1e3 * solved.rms))
    });
    let crate_ = travels().map(|d| {
        let interaction = particle_damper::Interaction::new(e, 0.0)?;
        let mut material = particle_damper::Material::acrylic();
        material.interaction = interaction;
        let law = particle_damper::RestitutionImpulse::new(material);
        Ok((
            1e3 * d,
            1e3 * impact_damper::by_crate(law, (m, d, f), 8000, 50).rms,
        ))
    });
    let computed: Result<Vec<_>, particle_damper::ValueError> = crate_.collect();
    let chart = Chart {
        title: "One mass of 8.6 g in the paper's box, e 0.6, 6.03 Hz",
        axes: ["free travel (mm)", "RMS displacement of the box (mm)"],
        x: 20.0..68.0,
        y: 0.0..12.0,
        logarithmic: [false, false],
        legend: SeriesLabelPosition::UpperRight,
    };
    let lines = [
        line(
            "Masri & Caughey 1966, two impacts per cycle",
            0,
            0,
            false,
            theory.collect(),
        ),
        line(
            "RestitutionImpulse; irregular under 32 and over 48 mm",
            2,
            POINTS,
            true,
            computed?,
        ),
    ];
    chart.draw(path, &lines)?;
    output::say_where("picture", path);
    Ok(())
}

/// Loss per cycle of a completely inelastic mass against G.
fn loss(path: &Path) -> Result<(), Failure> {
    let all = || (5..=72).map(|n| 0.05 * f64::from(n));
    let chart = Chart {
        title: "Completely inelastic mass on a shaken floor",
        axes: [
            "G = A ω² / g, acceleration of the floor over gravity",
            "loss per cycle / (m A² ω²)",
        ],
        x: 0.0..3.7,
        y: 0.0..3.0,
        logarithmic: [false, false],
        legend: SeriesLabelPosition::UpperLeft,
    };
    let theory = all().map(|g| (g, inelastic::on_floor(g).loss)).collect();
    let computed = all()
        .map(|g| (g, inelastic::on_floor_by_crate(g, 4000).loss))
        .collect();
    let lines = [
        line("exact: free flight and sticking", 0, 0, false, theory),
        line(
            "RestitutionImpulse, 4000 steps a cycle",
            2,
            POINTS,
            true,
            computed,
        ),
    ];
    chart.draw(path, &lines)?;
    output::say_where("picture", path);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::cases::{FAMILIES, Form};

    /// Runs a family, and lists what does not hold.
    fn check(family: &str) {
        let (_, compute) = FAMILIES.iter().find(|(name, _)| *name == family).unwrap();
        let cases = compute(Form::Short);
        let failed: Vec<String> = cases
            .iter()
            .filter(|case| !case.holds())
            .map(ToString::to_string)
            .collect();
        assert!(
            failed.is_empty(),
            "{} of {} cases fail:\n{}",
            failed.len(),
            cases.len(),
            failed.join("\n")
        );
        assert!(!cases.is_empty());
    }

    macro_rules! families {
        ($($name:ident)*) => {
            $(
                #[test]
                fn $name() {
                    check(stringify!($name));
                }
            )*

            #[test]
            fn every_family_is_tested() {
                let listed: Vec<&str> = FAMILIES.iter().map(|(name, _)| *name).collect();
                assert_eq!(listed, [$(stringify!($name)),*]);
            }
        };
    }

    families! {
        contacts impulses chung_ooi oblique mfix impact_damper events shortcut inelastic paper_system integrators restitution
        size_ratio energy rest defects isolated floor_and_lid columns
    }
}
