//! Whose numbers they are: what results depend on besides the options of a sweep.

use std::num::NonZeroU32;

use particle_damper::{VERSION, fields, response};
use serde::{Deserialize, Serialize};

use crate::record::{Point, Task};
use crate::sweep::{Kind, Sweep};

/// The library and the settings that results were measured with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Origin {
    /// Version of the library.
    version: String,
    /// Digest of all settings, those in `sweep.rs` included: structure, cavity, law and material.
    settings: String,
    /// Digest of what a short run gives: libraries of one version may differ as well.
    trial: String,
}

/// The version in a first line, whatever else that holds.
#[derive(Deserialize)]
struct Line {
    origin: Version,
}

#[derive(Deserialize)]
struct Version {
    version: String,
}

impl Origin {
    /// Of what this program measures for a sweep.
    pub fn of(sweep: &Sweep) -> Self {
        Self {
            version: VERSION.into(),
            settings: digest(&sweep.settings()),
            trial: digest(&trial(sweep)),
        }
    }

    /// Says in what way a file is of another origin than this one.
    pub fn check(&self, found: &Self) -> Result<(), String> {
        refuse_version(&found.version)?;
        let Self {
            settings, trial, ..
        } = found;
        if *settings != self.settings {
            return Err(format!(
                "was measured with other settings than this program has in sweep.rs: digest {settings} \
                 instead of {}; begin a new file",
                self.settings
            ));
        }
        if *trial != self.trial {
            return Err(format!(
                "was measured by another build of particle-damper {VERSION}, whose numbers are others: digest \
                 {trial} instead of {}; begin a new file",
                self.trial
            ));
        }
        Ok(())
    }
}

/// Complains about a first line of another version, even if nothing else of it can be understood.
pub fn check_version(line: &[u8]) -> Result<(), String> {
    match serde_json::from_slice::<Line>(line) {
        Ok(line) => refuse_version(&line.origin.version),
        Err(_) => Ok(()),
    }
}

fn refuse_version(found: &str) -> Result<(), String> {
    if found == VERSION {
        return Ok(());
    }
    Err(format!(
        "was measured by particle-damper {found}, but this is {VERSION}, whose numbers may be others; begin \
         a new file"
    ))
}

/// What two periods of a small bed give, as a text.
fn trial(sweep: &Sweep) -> String {
    let (particles, seed, frequency) = (20, 1, 8.0);
    let point = match sweep.of {
        Kind::Responses => Point::Response(response::Point {
            particles,
            seed,
            amplitude: 0.25,
            frequency,
        }),
        Kind::Fields => Point::Field {
            particles,
            at: fields::Point {
                amplitude: 0.01,
                frequency,
                seed,
            },
        },
    };
    let short = Sweep {
        time_step: 2e-5,
        discarded: 0,
        averaged: NonZeroU32::MIN.saturating_add(1),
        ..sweep.clone()
    };
    let record = short.measure(Task { number: 0, point });
    format!("{:?}", record.outcome)
}

/// After FNV-1a (Fowler, Noll & Vo); the same on every platform.
fn digest(text: &str) -> String {
    let hash = text.bytes().fold(0xCBF2_9CE4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3)
    });
    format!("{hash:016x}")
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Options {
        #[command(flatten)]
        sweep: Sweep,
        #[arg(long)]
        quick: bool,
    }

    fn origin(options: &[&str]) -> Origin {
        let options = Options::parse_from(["test", "--quick"].iter().chain(options));
        assert!(options.quick);
        Origin::of(&options.sweep)
    }

    #[test]
    fn whatever_changes_numbers_is_in_the_origin() {
        let one = origin(&[]);
        assert_eq!(one, origin(&[]));
        let law = origin(&["--law=hertz-tsuji", "--time-step=1e-4"]);
        assert!(law.settings != one.settings && law.trial != one.trial);
        let periods = origin(&["--averaged=11"]);
        assert!(periods.settings != one.settings && periods.trial == one.trial);
        let fields = origin(&["--of=fields"]);
        assert!(fields.settings != one.settings && fields.trial != one.trial);
        for (old, reason) in [
            (
                Origin {
                    version: "0.0.9".into(),
                    ..one.clone()
                },
                "by particle-damper 0.0.9, but this is",
            ),
            (law, "other settings than this program has"),
            (
                Origin {
                    trial: fields.trial,
                    ..one.clone()
                },
                "another build of particle-damper",
            ),
        ] {
            assert!(one.check(&old).unwrap_err().contains(reason));
        }
    }

    /// A file of a version whose options were others is told by its version.
    #[test]
    fn a_version_is_read_from_a_line_that_means_nothing_else() {
        let line = br#"{"origin":{"version":"9.0.0","hash":1},"sweep":{"laws":[]}}"#;
        assert!(
            check_version(line)
                .unwrap_err()
                .contains("particle-damper 9.0.0")
        );
        assert!(check_version(b"a note of mine").is_ok());
    }
}
