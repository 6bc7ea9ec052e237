//! The file of results: a line of JSON that says what the sweep is and what measured it, and one for each
//! finished point.
//!
//! A line is written and flushed as soon as its point is finished, whichever that is. When all are there,
//! the lines are put in the order of the points: complete files of one sweep are equal byte for byte.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::Write as _;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::dispatch::Failure;
use crate::origin::{self, Origin};
use crate::record::{Outcome, Record};
use crate::sweep::Sweep;

/// Records by the number of their task.
pub type Records = BTreeMap<usize, Record>;

/// The first line.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    origin: Origin,
    sweep: Sweep,
}

/// What a file holds.
pub struct Contents {
    pub sweep: Sweep,
    pub records: Records,
    /// How many bytes of it are whole lines.
    whole: usize,
    /// Whether a half-written line follows them.
    pub torn: bool,
}

/// Reads a file. A last line without end is left out: whoever wrote it was stopped.
pub fn read(path: &Path) -> Result<Contents, Failure> {
    let bytes = fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let whole = bytes.iter().rposition(|byte| *byte == b'\n');
    let whole = whole.map_or(0, |last| last + 1);
    let mut lines = bytes[..whole].split_inclusive(|byte| *byte == b'\n');
    let first = lines.next().unwrap_or_default();
    let foreign = |reason| format!("{} {reason}", path.display());
    origin::check_version(first).map_err(foreign)?;
    let Header { origin, sweep } = parse(path, 1, first)?;
    Origin::of(&sweep).check(&origin).map_err(foreign)?;
    let tasks = sweep.tasks();
    let mut records = Records::new();
    for (line, number) in lines.zip(2..) {
        let record: Record = parse(path, number, line)?;
        let task = tasks.get(record.number);
        if task.is_none_or(|task| task.point != record.point) {
            let point = record.point;
            let line = format!("{}, line {number}", path.display());
            return Err(format!("{line}: the sweep has no such point: {point}").into());
        }
        join(&mut records, record).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(Contents {
        sweep,
        records,
        whole,
        torn: whole < bytes.len(),
    })
}

fn parse<T: for<'a> Deserialize<'a>>(path: &Path, line: usize, text: &[u8]) -> Result<T, Failure> {
    serde_json::from_slice(text).map_err(|error| {
        let what = if line == 1 {
            "not the first line of a file of results"
        } else {
            "not a result"
        };
        format!("{}, line {line}: {what}: {error}", path.display()).into()
    })
}

/// Takes up a record. A result takes the place of a failure; two results must be the same.
pub fn join(records: &mut Records, record: Record) -> Result<(), Failure> {
    let known = records.get(&record.number).map(|known| &known.outcome);
    match (known, &record.outcome) {
        (Some(known), Outcome::Failed(_)) if !known.failed() => {}
        (Some(known), outcome) if !known.failed() && known != outcome => {
            return Err(format!("two results that differ: {}", record.point).into());
        }
        _ => {
            records.insert(record.number, record);
        }
    }
    Ok(())
}

/// Complains if a file is of another sweep, and says what differs.
pub fn same(path: &Path, found: &Sweep, wanted: &Sweep) -> Result<(), Failure> {
    if found == wanted {
        return Ok(());
    }
    let [found, wanted] = [found, wanted].map(serde_json::to_value);
    let (found, wanted) = (found?, wanted?);
    let mut text = format!("{} is of another sweep:", path.display());
    for (name, wanted) in wanted.as_object().into_iter().flatten() {
        let found = &found[name];
        if found != wanted {
            text += &format!(" {name} {found} instead of {wanted};");
        }
    }
    text.pop();
    Err(text.into())
}

/// A file that results are added to.
pub struct Results {
    path: PathBuf,
    file: File,
    sweep: Sweep,
    records: Records,
}

impl Results {
    /// Opens the file, or makes it, and says whether a half-written last line was dropped.
    pub fn open(path: &Path, sweep: &Sweep) -> Result<(Self, bool), Failure> {
        let context = |error| format!("{}: {error}", path.display());
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).map_err(context)?;
        }
        let mut file = OpenOptions::new();
        let file = file.create(true).read(true).append(true).open(path);
        let file = file.map_err(context)?;
        // Where files cannot be locked, nobody is kept out.
        if matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
            return Err(format!("{}: another run is writing it", path.display()).into());
        }
        let mut results = Self {
            path: path.to_owned(),
            file,
            sweep: sweep.clone(),
            records: Records::new(),
        };
        let header = results.header()?;
        // Stopped while the first line was being written, if not new.
        if header.starts_with(&fs::read(path).map_err(context)?) {
            results.file.set_len(0).map_err(context)?;
            results.write(&header)?;
            return Ok((results, false));
        }
        let contents = read(path)?;
        same(path, &contents.sweep, sweep)?;
        if contents.torn {
            let whole = contents.whole as u64;
            results.file.set_len(whole).map_err(context)?;
        }
        results.records = contents.records;
        Ok((results, contents.torn))
    }

    pub const fn records(&self) -> &Records {
        &self.records
    }

    fn header(&self) -> Result<Vec<u8>, Failure> {
        let sweep = self.sweep.clone();
        let origin = Origin::of(&sweep);
        line(&Header { origin, sweep })
    }

    /// Adds a result; it is on disk when this returns.
    pub fn add(&mut self, record: Record) -> Result<(), Failure> {
        self.write(&line(&record)?)?;
        join(&mut self.records, record)
    }

    /// Takes up results of other files, for [`put_in_order`](Self::put_in_order) to write.
    pub fn join(&mut self, records: Records) -> Result<(), Failure> {
        let mut records = records.into_values();
        records.try_for_each(|record| join(&mut self.records, record))
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        let written = self.file.write_all(bytes);
        written
            .and_then(|()| self.file.sync_data())
            .map_err(|error| format!("{}: {error}", self.path.display()).into())
    }

    /// Puts the lines in order. The old file stays until the new one is whole.
    pub fn put_in_order(&self) -> Result<(), Failure> {
        let mut bytes = self.header()?;
        for record in self.records.values() {
            bytes.extend(line(record)?);
        }
        if fs::read(&self.path)? == bytes {
            return Ok(());
        }
        let new = self.path.with_extension("new");
        let written = File::create(&new).and_then(|mut file| {
            file.write_all(&bytes)?;
            file.sync_all()?;
            fs::rename(&new, &self.path)
        });
        written.map_err(|error| format!("{}: {error}", new.display()).into())
    }
}

fn line(value: &impl Serialize) -> Result<Vec<u8>, Failure> {
    let mut bytes = serde_json::to_vec(value)?;
    bytes.push(b'\n');
    Ok(bytes)
}
