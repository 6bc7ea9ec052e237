//! Where examples leave their tables and pictures.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// `target/<example>/`, made if it does not exist.
pub(crate) fn directory(example: &str) -> io::Result<PathBuf> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("target")
        .join(example);
    fs::create_dir_all(&directory)?;
    Ok(directory)
}

/// Writes a table of comma-separated values and says where.
pub(crate) fn write_table(
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
pub(crate) fn say_where(what: &str, path: &Path) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let shown = path.strip_prefix(root).unwrap_or(path);
    println!("{what:8}{}", shown.display());
}
