//! ogee.

use anyhow::Result;
use ogee::{ControlMesh, DenseRefinement, FineMesh, Level, Vec3};
use serde_json::Value;

use crate::measure::{self, Shape};

/// Memory that refinement may take: all there is.
const MEMORY: u64 = u64::MAX;

struct Fine(FineMesh);

impl Default for Fine {
    fn default() -> Fine {
        Fine(FineMesh { points: Vec::new(), faces: Vec::new() })
    }
}

pub(crate) fn refine(mesh: &ControlMesh, depth: u32) -> Result<Value> {
    let (Fine(fine), passes) = measure::passes(|Fine(fine): &mut Fine| {
        Level::new(mesh)?.fine_mesh_into(&mesh.points, depth, MEMORY, fine)?;
        Ok(())
    })?;
    Ok(shape(&fine.points, &fine.faces).refinement(&passes))
}

pub(crate) fn animate(mesh: &ControlMesh, depth: u32, frames: usize) -> Result<Value> {
    let (state, set_up) = measure::set_up(|| Animation::new(mesh, depth))?;
    let mut points = Vec::new();
    let seconds = measure::animate(mesh, frames, Vec3::from, |posed| {
        state.pose(posed, &mut points);
        Ok(())
    })?;
    Ok(shape(&points, &state.quads()).animation(&set_up, seconds))
}

/// What is made once for all frames. The level stays until the program ends.
struct Animation(DenseRefinement<'static>);

impl Animation {
    fn new(mesh: &ControlMesh, depth: u32) -> Result<Animation> {
        let level: &'static Level = Box::leak(Box::new(Level::new(mesh)?));
        Ok(Animation(level.dense(depth, MEMORY)?))
    }

    fn pose(&self, cage: &[Vec3], points: &mut Vec<Vec3>) {
        self.0.points(cage, points);
    }

    fn quads(&self) -> Vec<[u32; 4]> {
        let mut quads = Vec::new();
        self.0.quads(&mut quads);
        quads
    }
}

fn shape(
    points: &[Vec3],
    quads: &[[u32; 4]],
) -> Shape<impl Fn(usize) -> [f64; 3], impl Fn(usize) -> [u32; 4]> {
    Shape {
        vertices: points.len(),
        faces: quads.len(),
        point: |v: usize| points[v].into(),
        quad: |f: usize| quads[f],
    }
}
