//! What a sweep came to, for people; and the cells of effective fields.

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use particle_damper::fields::{Cell, Measurement};
use serde::Serialize;

use crate::dispatch::Failure;
use crate::record::{Outcome, Point, Task};
use crate::results::Records;
use crate::sweep::{Kind, Sweep};

/// Prints the highest point of each number of particles, and whether all is well.
pub fn tell(records: &Records, tasks: &[Task]) -> ExitCode {
    let of_tasks = || tasks.iter().map(|task| records.get(&task.number));
    let missing = of_tasks().filter(Option::is_none).count();
    let failed = of_tasks()
        .flatten()
        .filter(|record| record.outcome.failed());
    let failed = failed.count();
    let mut peaks = Vec::<(usize, f64, Point)>::new();
    for record in of_tasks().flatten() {
        let (particles, height) = match (&record.point, &record.outcome) {
            (Point::Response(point), Outcome::Response(response)) => {
                (point.particles, response.first_harmonic)
            }
            (Point::Field { particles, .. }, Outcome::Field(measurement)) => {
                let cell = Cell::pooled(&[(**measurement).clone()]);
                (*particles, cell.map_or(0.0, |cell| cell.normalised_loss()))
            }
            _ => continue,
        };
        match peaks.iter_mut().find(|peak| peak.0 == particles) {
            Some(peak) if peak.1 >= height => {}
            Some(peak) => *peak = (particles, height, record.point),
            None => peaks.push((particles, height, record.point)),
        }
    }
    for (_, height, point) in peaks {
        let what = match point {
            Point::Response(_) => "first harmonic over F/K",
            Point::Field { .. } => "normalised loss",
        };
        println!("highest {what} {height:.3}: {point}");
    }
    if missing + failed == 0 {
        println!("all {} points are there", tasks.len());
        return ExitCode::SUCCESS;
    }
    println!(
        "of {} points {failed} failed, {missing} are missing",
        tasks.len()
    );
    ExitCode::FAILURE
}

/// A line of the file of cells.
#[derive(Serialize)]
struct Line {
    particles: usize,
    cell: Cell,
}

/// Writes the cells of effective fields that all seeds are there for, a line of JSON for each, beside the
/// results.
pub fn write_cells(sweep: &Sweep, records: &Records, results: &Path) -> Result<(), Failure> {
    if sweep.of != Kind::Fields {
        return Ok(());
    }
    let mut text = String::new();
    // Seeds follow each other first.
    for tasks in sweep.tasks().chunks(sweep.seeds.len()) {
        let of = |task: &Task| match (&task.point, &records.get(&task.number)?.outcome) {
            (Point::Field { particles, .. }, Outcome::Field(measurement)) => {
                Some((*particles, (**measurement).clone()))
            }
            _ => None,
        };
        let group: Option<Vec<(usize, Measurement)>> = tasks.iter().map(of).collect();
        let Some((counts, group)) =
            group.map(|group| group.into_iter().unzip::<_, _, Vec<_>, Vec<_>>())
        else {
            continue;
        };
        if let (Some(&particles), Some(cell)) = (counts.first(), Cell::pooled(&group)) {
            text += &serde_json::to_string(&Line { particles, cell })?;
            text.push('\n');
        }
    }
    let path = results.with_extension("cells.jsonl");
    fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    println!("cells in {}", path.display());
    Ok(())
}
