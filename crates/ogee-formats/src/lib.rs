//! Files of ogee: control meshes in, parts and meshes out.
//!
//! Readers take bytes and writers take anything that can be written to: which file is opened, and under
//! what name a result appears, is the caller's business.

mod builder;
pub mod bv;
mod cage;
mod error;
mod finite;
mod glb;
pub mod json;
mod mesh;
mod number;
pub mod obj;
pub mod off;
pub mod patches;
pub mod ply;
pub mod step;
mod stl;
mod text;
mod triangles;

pub use cage::{CageFile, CageFormat, read_cage};
pub use error::{Fault, ReadError, Warning};
pub use mesh::{Faces, MeshFormat, MeshView, Placement, write_mesh};
