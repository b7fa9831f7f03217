//! Which vertices are lenses, pairs and poles, and what their neighbourhoods allow.
//!
//! Everything is found by walking along halfedges, so that nothing has to be looked up by pairs of vertices, and in time
//! linear in the mesh: straight walks through vertices of valence 4 never share an edge.

use super::circles::{Circle, PolarNeighbourhood};
use super::layout::{LensNet, layer, lens_halfedges};
use super::{LensError, Obstacle};
use crate::mesh::{FaceId, HalfedgeId, Topology, Valence, VertexId};
use crate::rules::Level;

/// The lenses, pairs and poles of a level.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Detection {
    /// The lens vertices, by id.
    pub lenses: Vec<Lens>,
    /// Two lenses each, joined by a straight path; by the lower id.
    pub pairs: Vec<LensPair>,
    /// The fans of triangles in the midst of quads, by id.
    pub poles: Vec<Pole>,
    /// Boundary vertices with one face: ordinary corners, never lenses.
    pub corners: Vec<VertexId>,
}

/// A lens: an inner vertex with two faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Lens {
    /// The vertex.
    pub vertex: VertexId,
    /// Whether it has a partner.
    pub kind: LensKind,
    /// Its regular neighbourhood, or what is in the way: layers 1 and 2 have to be inner vertices of valence 4, without
    /// sharp edges or vertices and without faces that are no part of the surface, and all faces up to layer 3 quads.
    pub net: Result<LensNet, Obstacle>,
}

/// Whether a lens has a partner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LensKind {
    /// No straight path leads to another lens that has this one for its nearest.
    Single,
    /// A straight path of `length` edges leads to the partner.
    Paired {
        /// The other lens.
        partner: VertexId,
        /// Number of edges, 2 or more.
        length: u32,
    },
    /// Both straight paths lead to a lens, after equally many edges; treated as single.
    Ambiguous,
}

/// Two lenses that are joined by a straight path of edges through regular vertices, the slit.
#[derive(Clone, Debug, PartialEq)]
pub struct LensPair {
    /// The vertices of the path, from the lens with the lower id to the other.
    pub slit: Vec<VertexId>,
    /// Its circles, or what is in the way of a polar cap. Column `x` of circle 1 stands beside slit vertex `min(x, 2 m - x)`, with `m`
    /// edges in the slit; columns run counter-clockwise, opposite to those of the paper's map `cos z`.
    pub neighbourhood: Result<PolarNeighbourhood, Obstacle>,
}

/// An inner vertex with triangles all round, and quads next to these, with a ring of vertices of valence 4.
#[derive(Clone, Debug, PartialEq)]
pub struct Pole {
    /// The vertex.
    pub vertex: VertexId,
    /// Its circles, or what is in the way of a polar cap. Circle 1 is in the order of [`Topology::ring`].
    pub neighbourhood: Result<PolarNeighbourhood, Obstacle>,
}

impl LensPair {
    /// The two lenses.
    pub fn ends(&self) -> [VertexId; 2] {
        [self.slit[0], self.slit[self.slit.len() - 1]]
    }
}

impl Detection {
    /// The lenses whose neighbourhood is regular.
    pub fn isolated(&self) -> impl Iterator<Item = &Lens> {
        self.lenses.iter().filter(|lens| lens.net.is_ok())
    }

    /// The lenses that want refinement before they can be treated, with the reason, other polygons than quads apart.
    pub fn needing_refinement(&self) -> impl Iterator<Item = (VertexId, Obstacle)> {
        let obstacles = self.lenses.iter().filter_map(|lens| Some((lens.vertex, lens.net.clone().err()?)));
        obstacles.filter(|(_, obstacle)| !matches!(obstacle, Obstacle::NotAQuad { .. }))
    }

    /// The lenses with two partners at equal distance.
    pub fn ambiguous(&self) -> impl Iterator<Item = VertexId> {
        self.lenses.iter().filter(|lens| lens.kind == LensKind::Ambiguous).map(|lens| lens.vertex)
    }

    /// The lens at a vertex.
    pub fn lens(&self, vertex: VertexId) -> Option<&Lens> {
        let at = self.lenses.binary_search_by_key(&vertex, |lens| lens.vertex).ok()?;
        Some(&self.lenses[at])
    }
}

/// Finds all lenses, pairs and poles of a level.
///
/// # Errors
/// [`LensError::AdjacentLensVertices`] if two quads are glued along all four edges.
pub fn detect(level: &Level) -> Result<Detection, LensError> {
    let topology = level.topology();
    let mut found = Detection::default();
    for vertex in (0..topology.vertex_count() as u32).map(VertexId) {
        match topology.valence(vertex) {
            Valence::Interior(2) => {
                refuse_pillow(topology, vertex)?;
                let kind = nearest_lens(topology, vertex).map_or(LensKind::Single, |nearest| nearest.kind());
                if let Some(net) = LensNet::new(topology, vertex) {
                    let net = net.and_then(|net| smooth_net(level, &net).map_or(Ok(net), Err));
                    found.lenses.push(Lens { vertex, kind, net });
                }
            }
            Valence::Boundary(1) => found.corners.push(vertex),
            Valence::Interior(n) if n >= 3 => found.poles.extend(pole(level, vertex)),
            _ => {}
        }
    }
    keep_mutual_pairs(&mut found);
    found.pairs = pairs(level, &found);
    Ok(found)
}

/// The regular and smooth neighbourhood of a lens.
///
/// # Errors
/// [`LensError::NotALens`], or [`LensError::Blocked`] with what is in the way.
pub fn regular_net(level: &Level, vertex: VertexId) -> Result<LensNet, LensError> {
    let net = LensNet::new(level.topology(), vertex).ok_or(LensError::NotALens { vertex })?;
    let net = net.and_then(|net| smooth_net(level, &net).map_or(Ok(net), Err));
    net.map_err(|obstacle| LensError::Blocked { vertex, obstacle, refinements: 0 })
}

fn refuse_pillow(topology: &Topology, vertex: VertexId) -> Result<(), LensError> {
    let Some([first, second]) = lens_halfedges(topology, vertex) else { return Ok(()) };
    let is_quad = |h: HalfedgeId| topology.face_size(topology.face(h)) == 4;
    let diagonal = |h: HalfedgeId| topology.target(topology.next(h));
    if is_quad(first) && is_quad(second) && diagonal(first) == diagonal(second) {
        let vertices = [vertex, topology.target(first), diagonal(first), topology.target(second)];
        return Err(LensError::AdjacentLensVertices { vertices });
    }
    Ok(())
}

/// The lens that straight walks from a lens come to first.
enum Nearest {
    One { partner: VertexId, length: u32 },
    Two,
}

impl Nearest {
    fn kind(self) -> LensKind {
        match self {
            Nearest::One { partner, length } => LensKind::Paired { partner, length },
            Nearest::Two => LensKind::Ambiguous,
        }
    }
}

fn nearest_lens(topology: &Topology, vertex: VertexId) -> Option<Nearest> {
    let starts = lens_halfedges(topology, vertex)?;
    let hits = starts.map(|start| {
        let path = straight_path(topology, start)?;
        let partner = topology.target(*path.last()?);
        (partner != vertex && path.len() > 1).then_some((partner, path.len() as u32))
    });
    let one = |(partner, length)| Nearest::One { partner, length };
    match hits {
        [None, None] => None,
        [Some(hit), None] | [None, Some(hit)] => Some(one(hit)),
        [Some(a), Some(b)] if a.1 == b.1 => Some(Nearest::Two),
        [Some(a), Some(b)] => Some(one(if a.1 < b.1 { a } else { b })),
    }
}

/// The halfedges straight on through inner vertices of valence 4, up to a lens; `None` if they end elsewhere.
fn straight_path(topology: &Topology, start: HalfedgeId) -> Option<Vec<HalfedgeId>> {
    let mut path = vec![start];
    let mut h = start;
    loop {
        match topology.valence(topology.target(h)) {
            Valence::Interior(2) => return Some(path),
            Valence::Interior(4) => {
                h = topology.next(topology.twin(topology.next(h))?);
                path.push(h);
            }
            _ => return None,
        }
    }
}

/// A lens whose nearest one is nearer to a third stays single.
fn keep_mutual_pairs(found: &mut Detection) {
    let partner = |lens: &Lens| match lens.kind {
        LensKind::Paired { partner, .. } => Some(partner),
        _ => None,
    };
    let jilted: Vec<usize> = (0..found.lenses.len())
        .filter(|&k| {
            let lens = &found.lenses[k];
            let back = |other: VertexId| found.lens(other).and_then(partner);
            partner(lens).is_some_and(|other| back(other) != Some(lens.vertex))
        })
        .collect();
    for k in jilted {
        found.lenses[k].kind = LensKind::Single;
    }
}

fn pairs(level: &Level, found: &Detection) -> Vec<LensPair> {
    let topology = level.topology();
    let first_of_pair = |lens: &Lens| match lens.kind {
        LensKind::Paired { partner, length } if lens.vertex < partner => Some((lens.vertex, partner, length)),
        _ => None,
    };
    let path = |(vertex, partner, length): (VertexId, VertexId, u32)| {
        let paths = lens_halfedges(topology, vertex)?.map(|start| straight_path(topology, start));
        paths.into_iter().flatten().find(|path| {
            path.len() as u32 == length && path.last().is_some_and(|&h| topology.target(h) == partner)
        })
    };
    let pair = |path: Vec<HalfedgeId>| {
        let mut slit: Vec<VertexId> = path.iter().map(|&h| topology.origin(h)).collect();
        slit.extend(path.last().map(|&h| topology.target(h)));
        let neighbourhood = around_slit(level, &slit, &path);
        LensPair { slit, neighbourhood }
    };
    found.lenses.iter().filter_map(first_of_pair).filter_map(path).map(pair).collect()
}

fn around_slit(
    level: &Level,
    slit: &[VertexId],
    path: &[HalfedgeId],
) -> Result<PolarNeighbourhood, Obstacle> {
    let topology = level.topology();
    let boundary = Obstacle::Boundary { vertex: slit[0], layer: 0 };
    let zero = Circle::around_slit(topology, path).ok_or(boundary)?;
    let one = zero.next(topology, 1)?;
    let two = one.next(topology, 2)?;
    let faces = [zero.faces(topology), one.faces(topology)];
    polar_neighbourhood(level, slit, &one, &two, faces)
}

fn pole(level: &Level, vertex: VertexId) -> Option<Pole> {
    let topology = level.topology();
    let is_size = |h: HalfedgeId, corners: u32| topology.face_size(topology.face(h)) == corners;
    if !topology.ring(vertex).all(|spoke| is_size(spoke, 3)) {
        return None;
    }
    let one = Circle::around_pole(topology, vertex)?;
    let is_regular = |&v: &VertexId| topology.valence(v) == Valence::Interior(4);
    if !one.halfedges.iter().all(|&h| is_size(h, 4)) || !one.vertices(topology).iter().all(is_regular) {
        return None;
    }
    let neighbourhood = one.next(topology, 2).and_then(|two| {
        let triangles = topology.ring(vertex).map(|spoke| topology.face(spoke)).collect();
        polar_neighbourhood(level, &[vertex], &one, &two, [triangles, one.faces(topology)])
    });
    Some(Pole { vertex, neighbourhood })
}

fn polar_neighbourhood(
    level: &Level,
    centre: &[VertexId],
    one: &Circle,
    two: &Circle,
    disk: [Vec<FaceId>; 2],
) -> Result<PolarNeighbourhood, Obstacle> {
    let topology = level.topology();
    let circles = [one.vertices(topology), two.vertices(topology), two.next_vertices(topology, 3)?];
    let vertices = (0..).zip([centre, &circles[0], &circles[1]]);
    let vertices = vertices.flat_map(|(layer, list)| list.iter().map(move |&v| (v, layer)));
    let outside = two.faces(topology);
    let faces = (1..).zip([&disk[0], &disk[1], &outside]);
    let faces = faces.flat_map(|(layer, list)| list.iter().map(move |&f| (f, layer)));
    match roughness(level, vertices, faces) {
        Some(obstacle) => Err(obstacle),
        None => Ok(PolarNeighbourhood { circles, disk: disk.concat() }),
    }
}

/// What keeps the rules of a regular net from being the smooth ones.
fn smooth_net(level: &Level, net: &LensNet) -> Option<Obstacle> {
    let vertices = net.vertices.iter().enumerate().map(|(number, &v)| (v, layer(number)));
    let faces = (1..=3).flat_map(|k| net.faces(level.topology(), k).into_iter().map(move |f| (f, k as u32)));
    roughness(level, vertices.filter(|&(_, layer)| layer < 3), faces)
}

/// The first sharp edge at one of these vertices, sharp one among them, meeting at these faces or hidden face inside layer 2.
/// Beyond it hidden faces do no harm: nothing there is replaced.
fn roughness(
    level: &Level,
    vertices: impl Iterator<Item = (VertexId, u32)>,
    faces: impl Iterator<Item = (FaceId, u32)>,
) -> Option<Obstacle> {
    let topology = level.topology();
    for (vertex, layer) in vertices {
        for h in topology.ring(vertex) {
            if level.edge_sharpness(h) > 0.0 {
                return Some(Obstacle::SharpEdge { a: vertex, b: topology.target(h), layer });
            }
        }
        if level.vertex_sharpness(vertex) > 0.0 {
            return Some(Obstacle::SharpVertex { vertex, layer });
        }
    }
    for (face, layer) in faces {
        if level.has_slices() && level.slice(face).is_some() {
            return Some(Obstacle::Meeting { face, layer });
        }
        if layer < 3 && !level.is_visible(face) {
            return Some(Obstacle::HiddenFace { face, layer });
        }
    }
    None
}
