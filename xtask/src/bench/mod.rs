//! Benchmarks that want more than one function: whole commands, and evaluation, refinement, animation and reading beside
//! other programs.
//!
//! Benchmarks of single functions are `cargo bench -p ogee`.

mod accuracy;
mod cages;
pub(crate) mod commands;
mod figures;
pub(crate) mod limit;
pub(crate) mod machine;
mod peers;
pub(crate) mod refine;
pub(crate) mod report;
mod speed;
pub(crate) mod threads;
pub(crate) mod worker;
