//! All methods as lists of Bezier patches, so that they are measured and drawn alike.

use anyhow::Result;
use ogee::lens::{
    Averaging, Biquartic, Detection, Entry, PolarCap, PolarFaces, PolarVariant, Remesh, detect, pair_pole,
    remesh,
};
use ogee::nurbs::{FaceAddress, NurbsSurface};
use ogee::{
    ControlMesh, FaceId, FacePiece, Grid, LensShape, Level, LimitSurface, PatchNet, PatchTable, SurfaceJet,
    Vec3, VertexId,
};

use super::bezier::{bezier, from_cubic};
use super::bicubic::{BicubicNet, CATMULL_CLARK};

/// How far down patches are taken where there are infinitely many.
#[derive(Clone, Copy)]
pub(super) struct Depth {
    /// Rings of a lens, from ring 0.
    rings: u32,
    /// Steps around vertices of valence 3.
    steps: usize,
}

impl Depth {
    /// For figures.
    pub(super) const MEASURED: Depth = Depth { rings: 6, steps: 6 };
    /// For pictures: what is left out is smaller than a pixel.
    pub(super) const DRAWN: Depth = Depth { rings: 7, steps: 12 };
}

/// What is done with lenses.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Method {
    CatmullClark,
    Bicubic,
    Biquartic(Entry),
    Remesh(Remesh),
    Polar(PolarVariant),
}

impl Method {
    pub(super) const ALL: [Method; 11] = [
        Method::CatmullClark,
        Method::Bicubic,
        Method::Biquartic(Entry::DegreeRaise),
        Method::Biquartic(Entry::Refit),
        Method::Remesh(Remesh::Identify),
        Method::Remesh(Remesh::RemoveCentre),
        Method::Remesh(Remesh::Merge(Averaging::Cluster)),
        Method::Remesh(Remesh::Merge(Averaging::Axis)),
        Method::Polar(PolarVariant::SixFive),
        Method::Polar(PolarVariant::FiveFive),
        Method::Polar(PolarVariant::SixSix),
    ];

    pub(super) fn name(self) -> &'static str {
        match self {
            Method::CatmullClark => "Catmull-Clark",
            Method::Bicubic => "bi-3",
            Method::Biquartic(Entry::DegreeRaise) => "bi-4 plain",
            Method::Biquartic(Entry::Refit) => "bi-4 + Fig. 10",
            Method::Remesh(Remesh::Identify) => "Fig. 11 left",
            Method::Remesh(Remesh::RemoveCentre) => "Fig. 11 right",
            Method::Remesh(Remesh::Merge(Averaging::Cluster)) => "Fig. 12 cluster",
            Method::Remesh(Remesh::Merge(Averaging::Axis)) => "Fig. 12 axis",
            Method::Polar(PolarVariant::SixFive) => "polar 65",
            Method::Polar(PolarVariant::FiveFive) => "polar 55",
            Method::Polar(PolarVariant::SixSix) => "polar 66",
        }
    }
}

/// A surface with lenses treated by a method.
pub(super) struct Treatment {
    /// Bezier patches over their own domains.
    pub(super) patches: Vec<NurbsSurface>,
    /// The surface at the poles of caps, where patches are singular.
    pub(super) poles: Vec<SurfaceJet>,
}

/// The surface of a cage of quads by a method, without the faces at its border; `None` for polar caps where no lenses are in pairs.
pub(super) fn treatment(mesh: &ControlMesh, method: Method, depth: Depth) -> Result<Option<Treatment>> {
    let level = Level::new(mesh)?;
    let found = detect(&level)?;
    let (mut patches, mut poles) = (Vec::new(), Vec::new());
    match method {
        Method::CatmullClark | Method::Bicubic => {
            let shape = if method == Method::Bicubic { LensShape::default() } else { CATMULL_CLARK };
            for net in nets(&found, mesh) {
                patches.extend(net.rings(shape, depth.rings).into_iter().flatten());
            }
        }
        Method::Biquartic(entry) => {
            for net in nets(&found, mesh) {
                let first = Biquartic::from_bicubic(&net.points, entry);
                for net in
                    std::iter::successors(Some(first), |net| Some(net.step())).take(depth.rings as usize)
                {
                    patches.extend(net.ring_patches().map(|patch| bezier(patch.net)));
                }
            }
        }
        Method::Remesh(how) => {
            let lenses: Vec<VertexId> = found.lenses.iter().map(|lens| lens.vertex).collect();
            let mesh = remesh(mesh, &lenses, how)?.mesh;
            let level = Level::new(&mesh)?;
            return Ok(Some(Treatment { patches: limit_patches(&level, &mesh.points, &[], depth), poles }));
        }
        Method::Polar(variant) => {
            if found.pairs.is_empty() {
                return Ok(None);
            }
            for pair in &found.pairs {
                let around = pair.neighbourhood.clone().map_err(|why| anyhow::anyhow!("{why:?}"))?;
                let points = |of: &[VertexId]| of.iter().map(|v| mesh.points[v.index()]).collect::<Vec<_>>();
                let circles = around.circles.each_ref().map(|circle| points(circle));
                let pole = pair_pole(&points(&pair.slit), &circles[0])?;
                let cap = PolarCap::new(circles.each_ref().map(Vec::as_slice), pole, variant)?;
                let columns = around.columns();
                let replaced =
                    Grid::from_fn(2, columns, |k, i| FaceAddress::whole(around.disk[k * columns + i]));
                let faces = cap.faces(&around.circles[1], &replaced, PolarFaces::PerSector)?.faces;
                patches.extend(faces.into_iter().map(|face| face.surface));
                poles.push(cap.pole());
            }
        }
    }
    patches.extend(limit_patches(&level, &mesh.points, &replaced(&found, &level, method), depth));
    Ok(Some(Treatment { patches, poles }))
}

/// The nets of all lenses.
pub(super) fn nets(found: &Detection, mesh: &ControlMesh) -> Vec<BicubicNet> {
    let nets = found.lenses.iter().filter_map(|lens| lens.net.as_ref().ok());
    nets.map(|net| BicubicNet { points: net.vertices.map(|v| mesh.points[v.index()]) }).collect()
}

/// The faces that a method has patches of its own for.
fn replaced(found: &Detection, level: &Level, method: Method) -> Vec<FaceId> {
    let caps = || found.pairs.iter().filter_map(|pair| pair.neighbourhood.as_ref().ok());
    let nets = || found.lenses.iter().filter_map(|lens| lens.net.as_ref().ok());
    match method {
        Method::Polar(_) => caps().flat_map(|cap| cap.disk.clone()).collect(),
        _ => nets().flat_map(|net| net.disk(level.topology())).collect(),
    }
}

/// The limit surface of a level of quads but for some faces, and those at its border.
fn limit_patches(level: &Level, points: &[Vec3], except: &[FaceId], depth: Depth) -> Vec<NurbsSurface> {
    let topology = level.topology();
    let table = PatchTable::new(level);
    let surface = LimitSurface::new(&table, points);
    let mut patches = Vec::new();
    for face in (0..topology.face_count() as u32).map(FaceId) {
        let at_border = topology.halfedges(face).any(|h| topology.is_boundary(topology.origin(h)));
        if !at_border && !except.contains(&face) {
            let piece = surface.face_piece(face.index(), 0.25_f64.powi(depth.steps as i32));
            collect(&piece, depth.steps, &mut patches);
        }
    }
    patches
}

/// The patches of a piece, as far as they come from the next `steps` steps.
pub(in crate::reproduce) fn collect(piece: &FacePiece, steps: usize, patches: &mut Vec<NurbsSurface>) {
    let patch = |net: &PatchNet, origin: Vec3| from_cubic(|i, j| net[i + 4 * j] + origin);
    match piece {
        FacePiece::Leaf(net) => patches.push(patch(net, Vec3::ZERO)),
        FacePiece::Split(quarters) => {
            for quarter in quarters.iter() {
                collect(quarter, steps.saturating_sub(1), patches);
            }
        }
        FacePiece::Tail(tail) => {
            let nets = tail.steps.iter().take(steps).flatten();
            patches.extend(nets.map(|net| patch(net, tail.limit)));
        }
    }
}
