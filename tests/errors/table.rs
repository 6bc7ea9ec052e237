//! What is refused, row by row.

use std::error::Error;

use particle_damper::glam::dvec3;
use particle_damper::{Bound, HertzTsuji, Material, Particle, ValueError};

/// What was refused so far, or was not.
#[derive(Default)]
pub(crate) struct Table {
    rows: usize,
    wrong: Vec<String>,
}

impl Table {
    /// A row: `result` has to be an error of which `is` is true and whose text holds all of `texts`.
    pub(crate) fn row<T, E: Error>(
        &mut self,
        result: Result<T, E>,
        is: impl Fn(&E) -> bool,
        texts: &[&str],
    ) {
        self.rows += 1;
        let row = self.rows;
        let Err(error) = result else {
            self.wrong
                .push(format!("row {row} ({texts:?}) is accepted"));
            return;
        };
        let text = error.to_string();
        if !is(&error) {
            self.wrong
                .push(format!("row {row} is of another type: {error:?}"));
        }
        for part in texts.iter().filter(|part| !text.contains(**part)) {
            self.wrong
                .push(format!("row {row} does not say {part:?}: {text}"));
        }
    }

    /// A row whose error is a number outside `bound`.
    pub(crate) fn value<T>(
        &mut self,
        result: Result<T, ValueError>,
        quantity: &str,
        bound: Bound,
        value: &str,
    ) {
        let is = |error: &ValueError| error.bound == bound && !bound.admits(error.value);
        self.row(result, is, &[quantity, &bound.to_string(), value]);
    }

    pub(crate) fn end(self, at_least: usize) {
        assert!(self.wrong.is_empty(), "{:#?}", self.wrong);
        assert!(self.rows >= at_least, "{} rows", self.rows);
    }
}

pub(crate) const NAN: f64 = f64::NAN;
pub(crate) const INF: f64 = f64::INFINITY;

pub(crate) fn particle() -> Particle {
    Particle::new(3e-3, 0.2e-3)
        .unwrap()
        .at(dvec3(0.03, 0.01, 0.0))
}

pub(crate) fn law() -> HertzTsuji {
    HertzTsuji::new(Material::acrylic())
}
