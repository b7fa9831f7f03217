//! Figures on the quality of a surface: as JSON, as a table, as a page.

pub(crate) mod figures;
mod table;

pub(crate) use figures::Figures;
pub(crate) use table::table;

use ogee::ControlMesh;
use ogee::quality::{Address, Sector};

use crate::report::figure;

/// The vertex of the cage that a point is, if it is one.
fn vertex_of(mesh: Option<&ControlMesh>, sector: &Sector) -> Option<u32> {
    let Address { face, corner, u, v } = sector.at;
    let corners = mesh?.faces.iter().nth(face.index())?;
    let at = match (corner, (u, v)) {
        (Some(corner), (0.0, 0.0)) => corner,
        (None, (0.0, 0.0)) => 0,
        (None, (1.0, 0.0)) => 1,
        (None, (1.0, 1.0)) => 2,
        (None, (0.0, 1.0)) => 3,
        _ => return None,
    };
    corners.get(at as usize).copied()
}

/// `face 3 corner 1 at (0.5, 0)`.
fn place(address: &figures::At) -> String {
    let figures::At { face, corner, u, v } = address;
    let corner = corner.map(|corner| format!(" corner {corner}")).unwrap_or_default();
    format!("face {face}{corner} at ({}, {})", figure(*u), figure(*v))
}
