//! `cargo xtask reproduce PAPER`: a paper's figures and tables, made again.

#[cfg(feature = "gpu")]
mod adapters;
pub(crate) mod curve_networks;
pub(crate) mod g2;
pub(crate) mod interrogation;
pub(crate) mod lens;
mod plot;
mod timing;
