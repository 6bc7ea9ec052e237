//! Response curves and effective fields whose points are spread over the ranks of a cluster, or over the jobs
//! of an array.
//!
//! Points are handed out one by one. What is finished is on disk at once, and a second run goes on where
//! the first was stopped; the results are those of one process to the last bit. See README.md.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;

use dispatch::Failure;
use job::Job;
use part::Part;
use sweep::Sweep;
use threads::Threads;

mod dispatch;
mod job;
mod origin;
mod part;
mod progress;
#[cfg(feature = "mpi")]
mod ranks;
mod record;
mod results;
mod summary;
mod sweep;
mod threads;
mod values;

/// Response curves or effective fields of the paper's particle damper, point by point, on as many cores as there are.
///
/// Ends with 1 if points failed or are missing. Points that failed are not tried again unless asked for.
#[derive(Debug, Parser)]
#[command(args_override_self = true)]
struct Options {
    #[command(flatten)]
    sweep: Sweep,
    /// File of results, a line of JSON for each point. If it exists, the sweep goes on.
    #[arg(long, default_value = "target/mpi-sweep/results.jsonl")]
    results: PathBuf,
    /// Only this part of the points, as in 3/16; its file is beside that of the whole sweep.
    #[arg(long, value_name = "K/N")]
    part: Option<Part>,
    /// Measure nothing; put the results of these files into the file of results.
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with = "part")]
    merge: Vec<PathBuf>,
    /// Try points again that failed.
    #[arg(long)]
    retry: bool,
    /// Points that are measured at once, unless ranks do it; by default as many as there are cores.
    #[arg(long)]
    threads: Option<NonZeroUsize>,
    /// A few points and periods.
    #[arg(long)]
    quick: bool,
}

fn main() -> ExitCode {
    start().unwrap_or_else(|error| {
        eprintln!("error: {error}");
        ExitCode::FAILURE
    })
}

#[cfg(not(feature = "mpi"))]
fn start() -> Result<ExitCode, Failure> {
    alone(&Options::parse())
}

/// Rank 0 reads the command line and the files; the others wait for what it sends.
#[cfg(feature = "mpi")]
fn start() -> Result<ExitCode, Failure> {
    use mpi::traits::Communicator;

    let universe = mpi::initialize_with_threading(mpi::Threading::Funneled);
    let (universe, _) = universe.ok_or("MPI has been started before")?;
    let world = universe.world();
    if world.rank() != 0 {
        return ranks::serve(&world).map(|()| ExitCode::SUCCESS);
    }
    let options = match Options::try_parse() {
        Ok(options) => options,
        Err(error) => {
            ranks::dismiss(&world);
            error.print()?;
            return Ok(ExitCode::from(error.exit_code() as u8));
        }
    };
    if world.size() == 1 || !options.merge.is_empty() {
        ranks::dismiss(&world);
        return alone(&options);
    }
    let job = Job::prepare(&options).inspect_err(|_| ranks::dismiss(&world))?;
    let mut workers = ranks::Ranks::start(&world, &job.sweep)?;
    let done = job.work(&mut workers).unwrap_or_else(|error| {
        // The others may be busy for hours.
        eprintln!("error: {error}");
        world.abort(1)
    });
    ranks::dismiss(&world);
    Ok(done)
}

/// The threads of one process.
fn alone(options: &Options) -> Result<ExitCode, Failure> {
    if !options.merge.is_empty() {
        return job::merge(options);
    }
    let job = Job::prepare(options)?;
    let cores = std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let count = options.threads.unwrap_or(cores).get();
    let mut workers = Threads::start(&job.sweep, count);
    job.work(&mut workers)
}
