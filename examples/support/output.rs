//! Where examples leave their tables and pictures, and how far they have come.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressStyle};

/// `target/<example>/`, made if it does not exist.
pub fn directory(example: &str) -> io::Result<PathBuf> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("target")
        .join(example);
    fs::create_dir_all(&directory)?;
    Ok(directory)
}

/// Writes a table of comma-separated values and says where.
pub fn write_table(
    path: &Path,
    columns: &str,
    rows: impl IntoIterator<Item = String>,
) -> io::Result<()> {
    let mut text = format!("{columns}\n");
    for row in rows {
        let _ = writeln!(text, "{row}");
    }
    fs::write(path, text)?;
    say_where("table", path);
    Ok(())
}

/// Says where a file is.
pub fn say_where(what: &str, path: &Path) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let shown = path.strip_prefix(root).unwrap_or(path);
    println!("{what:8}{}", shown.display());
}

/// A bar from 0 to `whole`, with the time left; nothing is drawn where there is no terminal.
pub fn progress_bar(whole: u64) -> ProgressBar {
    let bar = ProgressBar::new(whole);
    if let Ok(style) =
        ProgressStyle::with_template("{bar:40} {percent:>3} %  {elapsed} gone, {eta} left  {msg}")
    {
        bar.set_style(style);
    }
    bar
}
