//! The crate `subdiv-kernels`, in single precision, which its weights have, with its feature `parallel`.

use std::num::NonZeroU8;

use anyhow::{Context, Result, anyhow};
use ogee::ControlMesh;
use serde_json::Value;
use subdiv_kernels::topology::Mesh;
use subdiv_kernels::{
    BoundaryInterpolation, RefinementResult, Refiner, Scheme, SchemeOptions, UniformRefine,
};

use crate::measure::{self, Shape};

#[derive(Default)]
struct Fine {
    points: Vec<[f32; 3]>,
    corners: Vec<u32>,
}

pub(crate) fn refine(mesh: &ControlMesh, depth: u32) -> Result<Value> {
    let cage: Vec<[f32; 3]> = mesh.points.iter().map(|&point| single(point.into())).collect();
    // It takes its cage away, so each pass is given one, made beforehand.
    let mut topologies = vec![topology(mesh), topology(mesh), topology(mesh)];
    let (fine, passes) = measure::passes(|fine: &mut Fine| {
        let result = refined(topologies.pop().context("three passes")?, depth)?;
        *fine = Fine { points: result.interpolate(&cage), corners: result.topology.face_vertex_indices };
        Ok(())
    })?;
    Ok(shape(&fine.points, &fine.corners).refinement(&passes))
}

pub(crate) fn animate(mesh: &ControlMesh, depth: u32, frames: usize) -> Result<Value> {
    let cage = topology(mesh);
    let ((table, corners), set_up) = measure::set_up(|| {
        let result = refined(cage, depth)?;
        Ok((result.compose_stencils(mesh.points.len()), result.topology.face_vertex_indices))
    })?;
    let mut points = Vec::new();
    let seconds = measure::animate(mesh, frames, single, |posed| {
        points = table.interpolate(posed);
        Ok(())
    })?;
    Ok(shape(&points, &corners).animation(&set_up, seconds))
}

/// The cage without points. Edges are named for their sharpness only; the crate finds them itself.
fn topology(mesh: &ControlMesh) -> Mesh {
    let sharpness = |value: ogee::Sharpness| value.value().min(10.0) as f32;
    let mut vertex_corners = vec![0.0; mesh.points.len()];
    for corner in &mesh.corners {
        vertex_corners[corner.vertex as usize] = sharpness(corner.sharpness);
    }
    Mesh {
        vertex_count: mesh.points.len() as u32,
        face_vertex_counts: mesh.faces.iter().map(|face| face.len() as u32).collect(),
        face_vertex_indices: mesh.faces.corners().to_vec(),
        edge_vertices: mesh.creases.iter().map(|crease| crease.vertices).collect(),
        edge_creases: mesh.creases.iter().map(|crease| sharpness(crease.sharpness)).collect(),
        vertex_corners,
    }
}

fn refined(topology: Mesh, depth: u32) -> Result<RefinementResult> {
    let options = SchemeOptions {
        boundary_interpolation: BoundaryInterpolation::EdgesAndCorners,
        // Where three sharp edges meet there is a corner for all others.
        auto_corner: true,
        ..SchemeOptions::default()
    };
    let levels = NonZeroU8::new(depth as u8).context("one level at least")?;
    let refiner = Refiner::new(topology, Scheme::CatmullClark, options);
    refiner
        .and_then(|refiner| refiner.refine_uniform(&UniformRefine::from(levels)))
        .map_err(|error| anyhow!("the cage was refused: {error:?}"))
}

fn single(point: [f64; 3]) -> [f32; 3] {
    point.map(|coordinate| coordinate as f32)
}

fn shape(
    points: &[[f32; 3]],
    corners: &[u32],
) -> Shape<impl Fn(usize) -> [f64; 3], impl Fn(usize) -> [u32; 4]> {
    Shape {
        vertices: points.len(),
        faces: corners.len() / 4,
        point: |v: usize| points[v].map(f64::from),
        quad: |f: usize| [0, 1, 2, 3].map(|k| corners[4 * f + k]),
    }
}
