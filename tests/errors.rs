//! Whatever cannot be right is refused where it is handed in, by an error that names the quantity, the
//! value and the bound.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    clippy::items_after_statements,
    clippy::too_many_lines
)]

#[path = "errors/builders.rs"]
mod builders;
#[path = "errors/causes.rs"]
mod causes;
#[path = "errors/laws.rs"]
mod laws;
#[path = "errors/parts.rs"]
mod parts;
#[path = "errors/running.rs"]
mod running;
#[path = "errors/steps.rs"]
mod steps;
#[path = "errors/table.rs"]
mod table;
