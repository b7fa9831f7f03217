//! Files of ogee: control meshes in, parts and meshes out.
pub mod bv;
mod finite;
pub mod patches;
pub mod step;
