//! Which rule each element of a level obeys: read off the sharpness of this level and of the next.

use super::inherit::half_sharpness;
use super::{EdgeRule, Level, Sparse, VertexMask, VertexRule};
use crate::crease::rule::{blend_weight, fade};
use crate::mesh::{Boundary, FaceId, HalfedgeId, Scheme, Topology, VertexId};

/// Rules of all edges that are neither smooth nor boundary.
pub(super) fn classify_edges(level: &Level) -> Sparse<EdgeRule> {
    let rules =
        level.sharp_edges.iter().map(|(e, edge)| (e, edge_rule(level, edge.halfedge, edge.sharpness)));
    Sparse::new(rules.collect())
}

fn edge_rule(level: &Level, h: HalfedgeId, sharpness: f64) -> EdgeRule {
    let stays = if level.is_chaikin() {
        // Both halves have to stay sharp, and the weight is not clamped: so OpenSubdiv has it.
        let topology = &level.topology;
        [h, topology.twin(h).unwrap_or(h)]
            .iter()
            .all(|&side| half_sharpness(level, topology.origin(side), h) > 0.0)
    } else {
        sharpness >= 1.0
    };
    if stays { EdgeRule::Crease } else { EdgeRule::Blend { weight: sharpness } }
}

/// Rules of all vertices that a tag touches, and of lenses.
pub(super) fn classify_vertices(level: &Level) -> Sparse<VertexRule> {
    let mut touched: Vec<u32> = level.vertex_sharpness.iter().map(|(v, _)| v).collect();
    for (_, edge) in level.sharp_edges.iter() {
        touched.extend([level.topology.origin(edge.halfedge).0, level.topology.target(edge.halfedge).0]);
    }
    touched.extend(level.topology.lenses().map(|v| v.0));
    touched.sort_unstable();
    touched.dedup();
    Sparse::new(touched.into_iter().map(|v| (v, vertex_rule(level, VertexId(v)))).collect())
}

fn vertex_rule(level: &Level, v: VertexId) -> VertexRule {
    if level.topology.outgoing(v).is_none() {
        return VertexRule::Of(VertexMask::Corner);
    }
    let own = level.vertex_sharpness(v);
    // Neighbour, sharpness now and one level on, of every edge that is sharp now.
    let mut sharp: Vec<(VertexId, f64, f64)> = Vec::new();
    let topology = &level.topology;
    let mut visit = |h: HalfedgeId, neighbour: VertexId| {
        let s = level.edge_sharpness(h);
        if s > 0.0 {
            sharp.push((neighbour, s, half_sharpness(level, v, h)));
        }
    };
    for h in topology.ring(v) {
        visit(h, topology.target(h));
        let before = topology.prev(h);
        if topology.twin(before).is_none() {
            visit(before, topology.origin(before));
        }
    }
    let smooth = if topology.is_lens(v) { VertexMask::Lens } else { VertexMask::Smooth };
    let parent = mask(smooth, own, sharp.iter().map(|&(end, ..)| end));
    let child = mask(smooth, fade(own), sharp.iter().filter(|edge| edge.2 > 0.0).map(|&(end, ..)| end));
    if parent == child {
        return VertexRule::Of(parent);
    }
    let vertex = (own > 0.0 && fade(own) == 0.0).then_some(own);
    let edges = sharp.iter().filter(|edge| edge.2 == 0.0).map(|&(_, s, _)| s);
    VertexRule::Blend { parent, child, weight: blend_weight(vertex.into_iter().chain(edges)) }
}

/// `smooth` is what it is with no sharp edge or one.
fn mask(smooth: VertexMask, own_sharpness: f64, sharp_ends: impl Iterator<Item = VertexId>) -> VertexMask {
    if own_sharpness > 0.0 {
        return VertexMask::Corner;
    }
    let ends: Vec<VertexId> = sharp_ends.take(3).collect();
    match ends[..] {
        [] | [_] => smooth,
        [a, b] => VertexMask::Crease { ends: [a, b] },
        _ => VertexMask::Corner,
    }
}

/// Faces that are no part of the surface: holes, and those at the boundary where the scheme leaves them out.
pub(super) fn hidden_faces(topology: &Topology, scheme: Scheme, holes: &[u32]) -> Vec<FaceId> {
    let mut hidden: Vec<FaceId> = holes.iter().map(|&f| FaceId(f)).collect();
    if scheme.boundary == Boundary::None {
        let at_boundary =
            |f: &FaceId| topology.halfedges(*f).any(|h| topology.is_boundary(topology.origin(h)));
        hidden.extend((0..topology.face_count() as u32).map(FaceId).filter(at_boundary));
    }
    hidden.sort_unstable();
    hidden.dedup();
    hidden
}
