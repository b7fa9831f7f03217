//! Benchmarks that want more than one function: whole commands, and evaluation beside other programs.
//!
//! Benchmarks of single functions are `cargo bench -p ogee`.

mod accuracy;
mod cages;
pub(crate) mod commands;
mod exchange;
pub(crate) mod limit;
mod peers;
pub(crate) mod report;
mod speed;
pub(crate) mod threads;
pub(crate) mod worker;
