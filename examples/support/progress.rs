//! How far long work has come.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar from 0 to `whole`, with the time left; nothing is drawn where there is no terminal.
pub(crate) fn bar(whole: u64) -> ProgressBar {
    let bar = ProgressBar::new(whole);
    if let Ok(style) =
        ProgressStyle::with_template("{bar:40} {percent:>3} %  {elapsed} gone, {eta} left  {msg}")
    {
        bar.set_style(style);
    }
    bar
}
