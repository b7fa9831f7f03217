//! Files of ogee: control meshes in, parts and meshes out.
//!
//! Readers take bytes and writers take anything that can be written to: which file is opened, and under
//! what name a result appears, is the caller's business. [`FileBytes`] are the bytes of a file, quickly.
//!
//! ```
//! use ogee::convert;
//! use ogee_formats::{CageFormat, read_cage, step};
//!
//! // A cage in, here from a text; a file's bytes do as well.
//! let text = b"v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
//! let mesh = read_cage(text, CageFormat::Obj)?.mesh;
//!
//! // A solid out, and read back by a lint that trusts nothing.
//! let part = convert::to_part(&mesh, &convert::Options::default())?;
//! let mut file = Vec::new();
//! step::write(&part, &step::Options::default(), &mut file)?;
//! let found = step::check(&file);
//! assert!(found.is_clean() && found.counts.solids == 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | files | read with | written with |
//! | --- | --- | --- |
//! | cages: OBJ with subdivision tags, OFF, PLY, JSON | [`read_cage`] | [`obj::write_cage`], [`json::write_cage`] |
//! | curves on a cage: JSON, lines of OBJ | [`network::read`] | [`network::write_obj`], [`network::write_json`] |
//! | refined meshes: OBJ, PLY, OFF, STL, GLB, JSON | | [`write_mesh`], [`write_mesh_blocks`] |
//! | parts: STEP | checked with [`step::check`] | [`step::write`] |
//! | parts: patches in JSON | [`patches::read`] | [`patches::write`] |
//! | parts: BezierView | | [`bv::write`] |
//! | curves: STEP, OBJ | | [`curves::write_step`], [`curves::write_obj`] |
//! | lines on a surface: SVG, OBJ, JSON | | [`lines::write_svg`], [`lines::write_obj`], [`lines::write_json`] |
//! | samples: JSON lines, CSV | [`samples::AddressReader`] | [`samples::write_sample`] |
//!
//! What each of them accepts and writes is described in `docs/formats.md` of the repository.

mod blocks;
mod builder;
pub mod bv;
mod cage;
pub mod curves;
mod error;
mod file;
mod finite;
mod glb;
pub mod json;
pub mod lines;
mod mesh;
pub mod network;
mod number;
pub mod obj;
pub mod off;
mod par;
pub mod patches;
pub mod ply;
pub mod samples;
pub mod step;
mod stl;
mod text;
mod triangles;

pub use blocks::{MeshBlocks, write_mesh_blocks};
pub use cage::{CageFile, CageFormat, read_cage};
pub use error::{Fault, ReadError, Warning};
pub use file::FileBytes;
pub use mesh::{Faces, MeshFormat, MeshView, Placement, write_mesh};

/// The front page of the repository: its program is a test.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct FrontPage;
