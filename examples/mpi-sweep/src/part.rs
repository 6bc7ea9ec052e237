//! A part of a sweep, for job arrays.

use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Part k of n, counted from 1: every n-th task. So each part has its share of the long ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    k: usize,
    n: usize,
}

impl Part {
    /// The whole sweep.
    pub const WHOLE: Self = Self { k: 1, n: 1 };

    /// Whether the task of this number belongs to it.
    pub const fn holds(self, number: usize) -> bool {
        number % self.n == self.k - 1
    }

    /// The file of a part beside that of the whole sweep: `a.jsonl` becomes `a.3-of-16.jsonl`.
    pub fn file(self, whole: &Path) -> PathBuf {
        if self == Self::WHOLE {
            return whole.to_owned();
        }
        let mut name = whole.file_stem().unwrap_or_default().to_owned();
        name.push(format!(".{}-of-{}", self.k, self.n));
        if let Some(extension) = whole.extension() {
            name.push(".");
            name.push(extension);
        }
        whole.with_file_name(name)
    }
}

impl FromStr for Part {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(k, n)| {
            let (k, n) = (k.trim().parse().ok()?, n.trim().parse().ok()?);
            Some(Self { k, n })
        });
        match numbers {
            None => Err(format!("`{text}` is not K/N, as in 3/16")),
            Some(Self { k: 0, .. }) => Err("parts are counted from 1".into()),
            Some(Self { k, n }) if k > n => Err(format!("there is no part {k} of {n}")),
            Some(part) => Ok(part),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::Part;

    #[test]
    fn parts_share_the_tasks_without_overlap() {
        let parts: Vec<Part> = ["1/3", "2/3", "3/3"]
            .map(|text| text.parse().unwrap())
            .into();
        for number in 0..10 {
            let holders = parts.iter().filter(|part| part.holds(number));
            assert_eq!(holders.count(), 1);
        }
        assert_eq!(
            parts[1].file(Path::new("a/b.jsonl")),
            Path::new("a/b.2-of-3.jsonl")
        );
        for bad in ["", "1", "0/3", "4/3", "1/0", "a/3", "1/3/5"] {
            assert!(bad.parse::<Part>().is_err(), "{bad}");
        }
    }
}
