//! Known answers, in their short form: every case states its source and its tolerance. The long form
//! is `cargo run --release --example validation`.
#![allow(clippy::float_cmp)]

#[path = "validation/cases.rs"]
mod cases;

use cases::Form;

/// Runs a family, and lists what does not hold.
fn check(family: &str) {
    let (_, compute) = cases::FAMILIES
        .iter()
        .find(|(name, _)| *name == family)
        .unwrap();
    let cases = compute(Form::Short);
    let failed: Vec<String> = cases
        .iter()
        .filter(|case| !case.holds())
        .map(ToString::to_string)
        .collect();
    assert!(
        failed.is_empty(),
        "{} of {} cases fail:\n{}",
        failed.len(),
        cases.len(),
        failed.join("\n")
    );
    assert!(!cases.is_empty());
}

macro_rules! families {
    ($($name:ident)*) => {
        $(
            #[test]
            fn $name() {
                check(stringify!($name));
            }
        )*

        #[test]
        fn every_family_is_tested() {
            let listed: Vec<&str> = cases::FAMILIES.iter().map(|(name, _)| *name).collect();
            assert_eq!(listed, [$(stringify!($name)),*]);
        }
    };
}

families! {
    contacts impulses chung_ooi oblique mfix impact_damper events shortcut inelastic paper_system integrators restitution
    size_ratio energy rest defects isolated floor_and_lid columns
}
