//! Cases with known answers, each computed by the public API alone, in a short form for tests and a long
//! one for tables.

pub(crate) mod case;
pub(crate) mod setup;

pub(crate) mod chung_ooi;
pub(crate) mod columns;
pub(crate) mod contacts;
pub(crate) mod defects;
pub(crate) mod energy;
pub(crate) mod events;
pub(crate) mod floor_and_lid;
pub(crate) mod impact_damper;
pub(crate) mod impulses;
pub(crate) mod inelastic;
pub(crate) mod integrators;
pub(crate) mod isolated;
pub(crate) mod mfix;
pub(crate) mod oblique;
pub(crate) mod paper_system;
pub(crate) mod rest;
pub(crate) mod restitution;
pub(crate) mod shortcut;
pub(crate) mod size_ratio;

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
    ("impact_damper", impact_damper::cases),
    ("events", events::cases),
    ("shortcut", shortcut::cases),
    ("inelastic", inelastic::cases),
    ("paper_system", paper_system::cases),
    ("integrators", integrators::cases),
    ("restitution", restitution::cases),
    ("size_ratio", size_ratio::cases),
    ("energy", energy::cases),
    ("rest", rest::cases),
    ("defects", defects::cases),
    ("isolated", isolated::cases),
    ("floor_and_lid", floor_and_lid::cases),
    ("columns", columns::cases),
];
