//! The crate `opensubdiv-rs`, in single precision, as its documentation uses it.

use anyhow::{Context, Result, anyhow};
use ogee::ControlMesh;
use opensubdiv_rs::far::{
    PrimvarRefiner, StencilTableFactory, StencilTableOptions, TopologyDescriptor, TopologyRefiner,
    TopologyRefinerFactory, UniformOptions,
};
use opensubdiv_rs::sdc;
use serde_json::Value;

use crate::measure::{self, Shape};

/// A cage as the crate takes it.
struct Cage {
    points: Vec<[f32; 3]>,
    sizes: Vec<usize>,
    crease_ends: Vec<[u32; 2]>,
    crease_sharpness: Vec<f32>,
    sharp_vertices: Vec<u32>,
    vertex_sharpness: Vec<f32>,
}

#[derive(Default)]
struct Fine {
    points: Vec<[f32; 3]>,
    quads: Vec<[u32; 4]>,
}

pub(crate) fn refine(mesh: &ControlMesh, depth: u32) -> Result<Value> {
    let cage = Cage::new(mesh);
    let (fine, passes) = measure::passes(|fine: &mut Fine| {
        let refiner = cage.refiner(mesh, depth)?;
        let primvar = PrimvarRefiner::new(&refiner);
        let mut points = Vec::new();
        for level in 1..refiner.max_level() {
            let mut next = vec![[0.0; 3]; refiner.level(level).num_vertices()];
            primvar.interpolate(level, if level == 1 { &cage.points } else { &points }, &mut next);
            points = next;
        }
        let last = refiner.max_level();
        fine.points.resize(refiner.level(last).num_vertices(), [0.0; 3]);
        primvar.interpolate(last, if last == 1 { &cage.points } else { &points }, &mut fine.points);
        quads(&refiner, &mut fine.quads)
    })?;
    Ok(shape(&fine.points, &fine.quads).refinement(&passes))
}

pub(crate) fn animate(mesh: &ControlMesh, depth: u32, frames: usize) -> Result<Value> {
    let cage = Cage::new(mesh);
    let (table, set_up) = measure::set_up(|| {
        let refiner = cage.refiner(mesh, depth)?;
        let options = StencilTableOptions { generate_intermediate_levels: false, ..Default::default() };
        Ok(StencilTableFactory::create(&refiner, options))
    })?;
    let mut points = vec![[0.0; 3]; table.num_stencils()];
    let seconds = measure::animate(mesh, frames, single, |posed| {
        table.update_values(posed, &mut points);
        Ok(())
    })?;
    let mut faces = Vec::new();
    quads(&cage.refiner(mesh, depth)?, &mut faces)?;
    Ok(shape(&points, &faces).animation(&set_up, seconds))
}

impl Cage {
    fn new(mesh: &ControlMesh) -> Cage {
        let sharpness = |value: ogee::Sharpness| value.value().min(10.0) as f32;
        Cage {
            points: mesh.points.iter().map(|&point| single(point.into())).collect(),
            sizes: mesh.faces.iter().map(<[u32]>::len).collect(),
            crease_ends: mesh.creases.iter().map(|crease| crease.vertices).collect(),
            crease_sharpness: mesh.creases.iter().map(|crease| sharpness(crease.sharpness)).collect(),
            sharp_vertices: mesh.corners.iter().map(|corner| corner.vertex).collect(),
            vertex_sharpness: mesh.corners.iter().map(|corner| sharpness(corner.sharpness)).collect(),
        }
    }

    fn refiner(&self, mesh: &ControlMesh, depth: u32) -> Result<TopologyRefiner> {
        let descriptor = TopologyDescriptor::new(self.points.len(), &self.sizes, mesh.faces.corners())
            .with_creases(&self.crease_ends, &self.crease_sharpness)
            .with_corners(&self.sharp_vertices, &self.vertex_sharpness);
        let options = sdc::Options::default()
            .with_vtx_boundary_interpolation(sdc::VtxBoundaryInterpolation::EdgeAndCorner);
        let refiner = TopologyRefinerFactory::create(descriptor, sdc::SchemeType::Catmark, options);
        let mut refiner = refiner.map_err(|error| anyhow!("the cage was refused: {error:?}"))?;
        refiner.refine_uniform(UniformOptions::new(depth as usize));
        Ok(refiner)
    }
}

fn single(point: [f64; 3]) -> [f32; 3] {
    point.map(|coordinate| coordinate as f32)
}

fn quads(refiner: &TopologyRefiner, quads: &mut Vec<[u32; 4]>) -> Result<()> {
    let last = refiner.level(refiner.max_level());
    quads.clear();
    quads.reserve(last.num_faces());
    for face in 0..last.num_faces() {
        quads.push(last.face_vertices(face).try_into().context("a face that is no quad")?);
    }
    Ok(())
}

fn shape(
    points: &[[f32; 3]],
    quads: &[[u32; 4]],
) -> Shape<impl Fn(usize) -> [f64; 3], impl Fn(usize) -> [u32; 4]> {
    Shape {
        vertices: points.len(),
        faces: quads.len(),
        point: |v: usize| points[v].map(f64::from),
        quad: |f: usize| quads[f],
    }
}
