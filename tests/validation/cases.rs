//! Cases with known answers, each computed by the public API alone. Shared by `tests/validation.rs`
//! (short form) and `examples/validation` (long form, with tables and plots).

pub(crate) mod case;
pub(crate) mod setup;

pub(crate) mod chung_ooi;
pub(crate) mod contacts;
pub(crate) mod impulses;
pub(crate) mod mfix;
pub(crate) mod oblique;

use case::Case;

/// How much to compute.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    Short,
    Long,
}

/// A family of cases.
pub(crate) type Family = (&'static str, fn(Form) -> Vec<Case>);

/// All families, in the order of the table.
pub(crate) const FAMILIES: &[Family] = &[
    ("contacts", contacts::cases),
    ("impulses", impulses::cases),
    ("chung_ooi", chung_ooi::cases),
    ("oblique", oblique::cases),
    ("mfix", mfix::cases),
];
