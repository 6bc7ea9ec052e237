//! The program as users run it: stopped midway, in parts, over ranks, with points that fail and files
//! that do not belong. Whatever the way, the file of results is that of
//! one process, byte for byte.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::OnceLock;
use std::thread::sleep;
use std::time::Duration;

const PROGRAM: &str = env!("CARGO_BIN_EXE_mpi-sweep");

/// A point that takes as long as all others together and more, and twenty that fail.
const SWEEP: [&str; 8] = [
    "--particles=20,5000",
    "--seeds=1",
    "--frequencies=0.1,5:7:19",
    "--discarded=6",
    "--averaged=30",
    "--threads=2",
    "--law=restitution",
    "--amplitudes=0.25",
];
const POINTS: usize = 40;

/// A new folder for the files of a test.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn alone(results: &Path) -> Command {
    let mut command = Command::new(PROGRAM);
    command.arg("--results").arg(results);
    command
}

#[cfg(feature = "mpi")]
fn ranks(results: &Path) -> Command {
    let mut command = Command::new("mpirun");
    command.args(["--allow-run-as-root", "--oversubscribe", "-n", "3", PROGRAM]);
    command.arg("--results").arg(results);
    command
}

fn run(command: &mut Command) -> Output {
    command.output().unwrap()
}

fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// What one process makes of the sweep.
fn expected() -> &'static [u8] {
    static BYTES: OnceLock<Vec<u8>> = OnceLock::new();
    BYTES.get_or_init(one_process)
}

fn one_process() -> Vec<u8> {
    let path = folder("one").join("results.jsonl");
    let output = run(alone(&path).args(SWEEP).arg("--threads=1"));
    // Twenty points fail, and the rest goes on.
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(
        errors(&output).matches("failed: 5000 particles").count(),
        20
    );
    let bytes = fs::read(&path).unwrap();
    let text = String::from_utf8_lossy(&bytes);
    assert_eq!(text.lines().count(), 1 + POINTS);
    assert_eq!(text.matches("\"outcome\":{\"response\"").count(), 20);
    bytes
}

/// How a run is ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kill {
    /// The program, or `mpirun`, is asked to end.
    Politely,
    /// It ends on the spot (SIGKILL), with nothing tidied up.
    AtOnce,
    /// Rank 0, which writes the file, ends on the spot.
    #[cfg(feature = "mpi")]
    Writer,
}

impl Kill {
    fn end(self, child: &mut Child) {
        let signal = |how: &str, process: u32| {
            let kill = Command::new("kill")
                .args([how, &process.to_string()])
                .status();
            assert!(kill.unwrap().success());
        };
        match self {
            Self::Politely => signal("-TERM", child.id()),
            Self::AtOnce => signal("-KILL", child.id()),
            #[cfg(feature = "mpi")]
            Self::Writer => signal("-KILL", writer(child.id())),
        }
    }
}

/// The process of rank 0 under an `mpirun`.
#[cfg(feature = "mpi")]
fn writer(mpirun: u32) -> u32 {
    let processes = fs::read_dir("/proc").unwrap().flatten();
    let numbers = processes.filter_map(|entry| entry.file_name().to_str()?.parse::<u32>().ok());
    let is_writer = |process: &u32| {
        let read = |file| fs::read(format!("/proc/{process}/{file}")).unwrap_or_default();
        let has = |text: &[u8], line: &str| {
            let mut lines = text.split(|byte| [b'\n', 0].contains(byte));
            lines.any(|own| own == line.as_bytes())
        };
        has(&read("environ"), "OMPI_COMM_WORLD_RANK=0")
            && has(&read("status"), &format!("PPid:\t{mpirun}"))
    };
    let mut writers = numbers.filter(is_writer);
    writers.next().expect("rank 0 runs")
}

/// Ends the program when a few points are on disk.
fn stop_midway(mut command: Command, results: &Path, kill: Kill) {
    let command = command.args(SWEEP);
    let quiet = command.stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = quiet.spawn().unwrap();
    let finished = || {
        let text = fs::read_to_string(results).unwrap_or_default();
        text.matches("\"outcome\":{\"response\"").count()
    };
    while finished() < 5 {
        assert!(child.try_wait().unwrap().is_none(), "ended too early");
        sleep(Duration::from_millis(2));
    }
    kill.end(&mut child);
    assert!(!child.wait().unwrap().success());
    // Ranks notice that `mpirun` is gone, and let go of the file.
    let file = fs::File::open(results).unwrap();
    for _ in 0..3000 {
        if file.try_lock().is_ok() {
            break;
        }
        sleep(Duration::from_millis(10));
    }
    file.unlock().unwrap();
    assert!(finished() < 20);
    // The slow point, the first of the sweep, has not kept others from being finished.
    let text = fs::read_to_string(results).unwrap();
    assert!(!text.contains("{\"number\":0,"));
}

/// Ends a run, spoils its last line and has it go on.
fn goes_on(way: impl Fn(&Path) -> Command, test: &str, kill: Kill) {
    let folder = folder(test);
    let results = folder.join("results.jsonl");
    stop_midway(way(&results), &results, kill);
    // The kill may have come in the middle of a line; if not, it does now.
    let bytes = fs::read(&results).unwrap();
    if bytes.last() == Some(&b'\n') {
        fs::write(&results, &bytes[..bytes.len() - 8]).unwrap();
    }

    let output = run(way(&results).args(SWEEP));
    assert!(errors(&output).contains("dropped a half-written last line"));
    assert!(!errors(&output).contains(": 0 of 40 points are done"));
    assert!(fs::read(&results).unwrap() == expected());

    let output = run(way(&results).args(SWEEP));
    assert!(errors(&output).contains(": 40 of 40 points are done"));
    assert!(!errors(&output).contains("failed:"));
    let output = run(way(&results).args(SWEEP).arg("--retry"));
    assert!(errors(&output).contains(": 20 of 40 points are done"));
    assert!(fs::read(&results).unwrap() == expected());
}

#[test]
fn threads_go_on_where_they_were_stopped() {
    goes_on(alone, "threads", Kill::Politely);
    goes_on(alone, "threads-killed", Kill::AtOnce);
}

#[cfg(feature = "mpi")]
#[test]
fn ranks_go_on_where_they_were_stopped() {
    goes_on(ranks, "ranks", Kill::Politely);
    goes_on(ranks, "ranks-killed", Kill::AtOnce);
    goes_on(ranks, "ranks-writer", Kill::Writer);
}

/// Wherever a kill has cut the file, what is whole is kept and the rest is measured again.
#[test]
fn a_file_may_end_anywhere() {
    let results = folder("cut").join("results.jsonl");
    let short = || {
        let short = [
            "--frequencies=5,6",
            "--particles=0",
            "--discarded=1",
            "--averaged=2",
        ];
        run(alone(&results).args(short))
    };
    assert!(short().status.success());
    let whole = fs::read(&results).unwrap();
    let ends: Vec<usize> = (0..whole.len()).filter(|n| whole[*n] == b'\n').collect();
    let [first, second, _] = ends[..] else {
        panic!("{} lines", ends.len());
    };
    let middle = (second + whole.len()) / 2;
    for (cut, done) in [
        (0, 0),
        (1, 0),
        (first, 0),
        (first + 1, 0),
        (first + 2, 0),
        (second, 0),
        (second + 1, 1),
        (second + 2, 1),
        (middle, 1),
        (whole.len() - 1, 1),
        (whole.len(), 2),
    ] {
        fs::write(&results, &whole[..cut]).unwrap();
        let output = short();
        assert!(output.status.success(), "{cut}: {}", errors(&output));
        assert!(errors(&output).contains(&format!(": {done} of 2 points are done")));
        assert!(fs::read(&results).unwrap() == whole, "cut at {cut}");
    }
}

/// A run that has been stopped goes on in any other way.
#[cfg(feature = "mpi")]
#[test]
fn what_ranks_began_is_ended_in_parts() {
    let folder = folder("mixed");
    let results = folder.join("results.jsonl");
    stop_midway(ranks(&results), &results, Kill::Politely);
    run(ranks(&results).args(SWEEP).arg("--part=2/2"));
    run(alone(&results).args(SWEEP).arg("--part=1/2"));
    let parts = [1, 2].map(|k| folder.join(format!("results.{k}-of-2.jsonl")));
    run(alone(&results).arg("--merge").args(parts));
    assert!(fs::read(&results).unwrap() == expected());
}

#[test]
fn parts_are_merged() {
    let folder = folder("parts");
    let results = folder.join("results.jsonl");
    let mut parts = Vec::new();
    for k in 1..=3 {
        let output = run(alone(&results).args(SWEEP).arg(format!("--part={k}/3")));
        assert_eq!(output.status.code(), Some(1));
        parts.push(folder.join(format!("results.{k}-of-3.jsonl")));
    }
    let merge = |parts: &[PathBuf]| run(alone(&results).arg("--merge").args(parts));
    let said = merge(&parts[..2]).stdout;
    assert!(String::from_utf8_lossy(&said).contains("13 are missing"));
    assert!(fs::read_to_string(&results).unwrap().lines().count() == 1 + POINTS - 13);
    merge(&parts);
    assert!(fs::read(&results).unwrap() == expected());
}

/// Effective fields go the same ways, and their cells are the same.
#[test]
fn fields_too() {
    let folder = folder("fields");
    let results = folder.join("results.jsonl");
    let fields = |command: &mut Command| {
        let points = ["--particles=20,60", "--seeds=1,2", "--amplitudes=0.01,0.03"];
        let kind = ["--of=fields", "--frequencies=6,8", "--quick"];
        let output = run(command.args(kind).args(points));
        assert!(output.status.success(), "{}", errors(&output));
    };
    let both = |results: &Path| {
        let cells = results.with_extension("cells.jsonl");
        [results, &cells].map(|path| fs::read(path).unwrap())
    };
    let one = folder.join("one.jsonl");
    fields(alone(&one).arg("--threads=1"));
    let text = String::from_utf8(both(&one)[1].clone()).unwrap();
    assert_eq!(text.lines().count(), 8);

    fields(alone(&results).arg("--part=1/2"));
    #[cfg(feature = "mpi")]
    fields(ranks(&results).arg("--part=2/2"));
    #[cfg(not(feature = "mpi"))]
    fields(alone(&results).arg("--part=2/2"));
    let parts = [1, 2].map(|k| folder.join(format!("results.{k}-of-2.jsonl")));
    fields(alone(&results).arg("--merge").args(parts));
    assert!(both(&results) == both(&one));
}

/// Runs that must fail, that say why, and that leave the file as it was.
#[test]
fn what_does_not_belong_is_refused() {
    let folder = folder("errors");
    let results = folder.join("results.jsonl");
    let short = |extra: &[&str]| {
        let short = ["--frequencies=5,6", "--discarded=1", "--averaged=2"];
        run(alone(&results).args(short).args(extra))
    };
    let refused = |extra: &[&str], reason: &str| {
        let before = fs::read(&results).ok();
        let output = short(extra);
        assert!(!output.status.success());
        assert!(errors(&output).contains(reason), "{}", errors(&output));
        assert!(fs::read(&results).ok() == before);
    };
    refused(&["--part=4/3"], "there is no part 4 of 3");
    refused(&["--part=0/3"], "parts are counted from 1");
    refused(&["--frequencies=0"], "not a number above 0");
    refused(&["--merge", "nowhere.jsonl"], "nowhere.jsonl");

    fs::write(&results, "a note of mine").unwrap();
    refused(&[], "not the first line of a file of results");
    fs::remove_file(&results).unwrap();

    assert!(short(&["--particles=0"]).status.success());
    let whole = fs::read_to_string(&results).unwrap();
    refused(
        &["--particles=0", "--amplitudes=0.5"],
        "is of another sweep: amplitudes [0.25] instead of [0.5]",
    );
    let other = folder.join("other.jsonl");
    fs::copy(&results, &other).unwrap();

    let origin = |name: &str, value: &str| {
        let (from, rest) = whole.split_once(&format!("\"{name}\":\"")).unwrap();
        let (_, to) = rest.split_once('"').unwrap();
        fs::write(&results, format!("{from}\"{name}\":\"{value}\"{to}")).unwrap();
    };
    for (name, value, reason) in [
        (
            "version",
            "0.0.9",
            "was measured by particle-damper 0.0.9, but this is",
        ),
        (
            "settings",
            "00c0ffee",
            "other settings than this program has in sweep.rs",
        ),
        (
            "trial",
            "00c0ffee",
            "was measured by another build of particle-damper",
        ),
    ] {
        origin(name, value);
        refused(&["--particles=0"], reason);
        let foreign = folder.join("foreign.jsonl");
        fs::rename(&results, &foreign).unwrap();
        refused(&["--merge", &foreign.to_string_lossy()], reason);
    }

    fs::write(&results, whole.replace("\"rms_mean\":", "\"rms_mean\" ")).unwrap();
    refused(&["--particles=0"], "line 2: not a result");
    fs::write(&results, whole.replace("\"seed\":1,", "\"seed\":7,")).unwrap();
    refused(&["--particles=0"], "line 2: the sweep has no such point");

    let changed = whole.replacen("\"outside\":0", "\"outside\":1", 1);
    fs::write(&results, changed).unwrap();
    let other = other.to_string_lossy().into_owned();
    refused(&["--merge", &other], "two results that differ");

    // Half a first line, as of a run that was stopped at once, is no obstacle.
    fs::write(&results, &whole[..40]).unwrap();
    assert!(short(&["--particles=0"]).status.success());
    assert!(fs::read_to_string(&results).unwrap() == whole);

    let file = fs::File::open(&results).unwrap();
    file.lock().unwrap();
    refused(&["--particles=0"], "another run is writing it");
}
