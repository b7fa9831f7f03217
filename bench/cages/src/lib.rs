//! What the programs of a benchmark are given: cages that are the same in every run ([`gyroid`]), and files of
//! little-endian numbers that every language reads in a few lines ([`exchange`]).

pub mod exchange;
pub mod gyroid;
mod voxels;
