//! `cargo xtask reproduce PAPER`: a paper's figures and tables, made again.

pub(crate) mod interrogation;
