//! What one run of the program does: its part of a sweep, or the merging of parts.

use std::path::PathBuf;
use std::process::ExitCode;

use crate::Options;
use crate::dispatch::{Failure, Workers, work_off};
use crate::part::Part;
use crate::progress::Progress;
use crate::record::Task;
use crate::results::{self, Records, Results};
use crate::summary;
use crate::sweep::Sweep;

/// A sweep that is about to run, or to go on.
pub struct Job {
    pub sweep: Sweep,
    path: PathBuf,
    results: Results,
    /// All of this part.
    part: Vec<Task>,
    to_do: Vec<Task>,
}

impl Job {
    /// Opens the file of results and finds out what is left to do.
    pub fn prepare(options: &Options) -> Result<Self, Failure> {
        let sweep = &options.sweep;
        let part = options.part.unwrap_or(Part::WHOLE);
        let path = part.file(&options.results);
        let (results, torn) = Results::open(&path, sweep)?;
        if torn {
            eprintln!("{}: dropped a half-written last line", path.display());
        }
        let mut tasks = sweep.tasks();
        tasks.retain(|task| part.holds(task.number));
        let left = |task: &Task| match results.records().get(&task.number) {
            None => true,
            Some(record) => options.retry && record.outcome.failed(),
        };
        let mut to_do: Vec<Task> = tasks.iter().copied().filter(left).collect();
        // The longest first, so that nobody waits for another at the end.
        to_do.sort_by(|a, b| b.point.work().total_cmp(&a.point.work()));
        eprintln!(
            "{}: {} of {} points are done",
            path.display(),
            tasks.len() - to_do.len(),
            tasks.len()
        );
        Ok(Self {
            sweep: sweep.clone(),
            path,
            results,
            part: tasks,
            to_do,
        })
    }

    /// Has all done that is left.
    pub fn work(self, workers: &mut impl Workers) -> Result<ExitCode, Failure> {
        let Self {
            sweep,
            path,
            mut results,
            part,
            to_do,
        } = self;
        let mut progress = Progress::new(&sweep.tasks(), &to_do);
        work_off(to_do, workers, |record| {
            let told = record.clone();
            results.add(record)?;
            progress.finished(&told);
            Ok(())
        })?;
        results.put_in_order()?;
        println!("results in {}", path.display());
        summary::write_cells(&sweep, results.records(), &path)?;
        Ok(summary::tell(results.records(), &part))
    }
}

/// Puts the results of several files into the one of the options, with those that it has.
pub fn merge(options: &Options) -> Result<ExitCode, Failure> {
    let mut paths = options.merge.clone();
    if options.results.exists() {
        paths.push(options.results.clone());
    }
    let mut sweep = None;
    let mut records = Records::new();
    for path in &paths {
        let contents = results::read(path)?;
        results::same(
            path,
            &contents.sweep,
            sweep.get_or_insert(contents.sweep.clone()),
        )?;
        if contents.torn {
            eprintln!("{}: left out a half-written last line", path.display());
        }
        for record in contents.records.into_values() {
            results::join(&mut records, record)
                .map_err(|error| format!("{}: {error}", path.display()))?;
        }
    }
    let sweep = sweep.ok_or("nothing to merge")?;
    let (mut results, _) = Results::open(&options.results, &sweep)?;
    results.join(records)?;
    results.put_in_order()?;
    println!("results in {}", options.results.display());
    summary::write_cells(&sweep, results.records(), &options.results)?;
    Ok(summary::tell(results.records(), &sweep.tasks()))
}
