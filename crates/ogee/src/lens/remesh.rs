//! Re-meshing of lenses: figures 11 and 12 of the paper, which make ordinary vertices of valence 3 and 4 of a lens.
//!
//! The index of a vertex of valence 2 is that of two vertices of valence 3. All new points are computed from the original mesh, then
//! the connectivity is changed once.

use super::LensError;
use super::detect::regular_net;
use super::layout::{BICUBIC_POINTS, LensNet, lattice_index, lattice_point};
use crate::math::Interpolate;
use crate::mesh::{ControlMesh, Corner, Crease, FaceId, FaceList, FaceVarying, LensShape, Meeting, VertexId};
use crate::rules::Level;

/// What becomes of the centre of a lens. Numbers are those of [`lattice_index`](super::lattice_index).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remesh {
    /// Figure 11 right: point 0 and its two faces give way to the quad `(1, 2, 3, 4)`. Points 1 and 3 get valence 3 and share this
    /// face: take one Catmull-Clark step before anything that wants them apart. The surface stays as it is beyond layer 2.
    RemoveCentre,
    /// Figure 11 left: edge 0-1 becomes one with edge 0-3, point 1 the middle of points 1 and 3; point 0 and its two faces
    /// vanish. Points 2 and 4 get valence 3 and share no face. The surface stays as it is beyond layer 3. The paper takes one
    /// Catmull-Clark step afterwards, which is left to the caller.
    Identify,
    /// Figure 12: connectivity as [`Remesh::Identify`], points 1, 2 and 4 are means of points of one bi-3 step, and no step follows.
    Merge(Averaging),
}

impl Default for Remesh {
    fn default() -> Remesh {
        Remesh::Merge(Averaging::default())
    }
}

/// Which points of one bi-3 step are averaged in figure 12.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Averaging {
    /// Those on the axes: 0, 1, 3; 2, 7, 16; 4, 11, 22. Gives the better curvature.
    #[default]
    Axis,
    /// All that lie inside old layer 1, once each: 0, 1, 3, 5, 9; 2, 6, 7, 8; 4, 10, 11, 12.
    Cluster,
}

/// A cage without some of its lenses.
#[derive(Clone, Debug, PartialEq)]
pub struct Remeshed {
    /// The cage. Tags and texture coordinates go along; where a seam runs through a lens, corners of faces keep their texture
    /// coordinates.
    pub mesh: ControlMesh,
    /// For each old vertex its new id; both of two that were identified have the same. `None` if it was removed.
    pub vertices: Vec<Option<VertexId>>,
    /// For each old face its new id; two that gave way to one have its. `None` if it was removed.
    pub faces: Vec<Option<FaceId>>,
}

impl Remesh {
    /// New values at points of a net, by number; all others stay. They depend on points 0 to 12 alone.
    pub fn new_values<T: Interpolate>(self, net: &[T; BICUBIC_POINTS]) -> Vec<(usize, T)> {
        let groups: [(usize, &[usize]); 3] = match self {
            Remesh::RemoveCentre => return Vec::new(),
            Remesh::Identify => return vec![(1, weighted([(0.5, &net[1]), (0.5, &net[3])]))],
            Remesh::Merge(Averaging::Axis) => [(1, &[0, 1, 3]), (2, &[2, 7, 16]), (4, &[4, 11, 22])],
            Remesh::Merge(Averaging::Cluster) => {
                [(1, &[0, 1, 3, 5, 9]), (2, &[2, 6, 7, 8]), (4, &[4, 10, 11, 12])]
            }
        };
        let mean = |group: &[usize]| {
            let share = 1.0 / group.len() as f64;
            let mut sum = T::zero();
            for &number in group {
                sum.add_scaled(share, &refined_value(net, number));
            }
            sum
        };
        groups.into_iter().map(|(number, group)| (number, mean(group))).collect()
    }

    /// True if points 1 and 3 become one.
    fn identifies(self) -> bool {
        !matches!(self, Remesh::RemoveCentre)
    }
}

/// Point `number` after one bi-3 step. The stencils are the regular ones of the grid, on an even function, but for the centre.
fn refined_value<T: Interpolate>(net: &[T; BICUBIC_POINTS], number: usize) -> T {
    if number == 0 {
        let LensShape { beta, gamma } = LensShape::default();
        let (edge, diagonal) = (beta / 2.0, gamma / 2.0);
        return weighted([
            (1.0 - beta - gamma, &net[0]),
            (edge, &net[1]),
            (edge, &net[3]),
            (diagonal, &net[2]),
            (diagonal, &net[4]),
        ]);
    }
    let mask = |position: i32| {
        let old = position.div_euclid(2);
        if position.rem_euclid(2) == 0 {
            [(old - 1, 0.125), (old, 0.75), (old + 1, 0.125)]
        } else {
            [(old, 0.5), (old + 1, 0.5), (old, 0.0)]
        }
    };
    let (i, j) = lattice_point(number);
    let (along_i, along_j) = (mask(i), mask(j));
    let terms = along_i.iter().flat_map(|&(a, s)| along_j.iter().map(move |&(b, t)| (a, b, s * t)));
    weighted(terms.filter(|term| term.2 > 0.0).map(|(a, b, weight)| (weight, &net[lattice_index(a, b)])))
}

fn weighted<'a, T: Interpolate + 'a>(terms: impl IntoIterator<Item = (f64, &'a T)>) -> T {
    let mut sum = T::zero();
    for (weight, value) in terms {
        sum.add_scaled(weight, value);
    }
    sum
}

/// Re-meshes some lenses of a cage. Vertices and faces that stay keep their order.
///
/// # Errors
/// If the cage has defects, a vertex is no lens, layers 1 and 2 of one are not regular and smooth, as where lenses are too near
/// to each other, or a lens is named twice.
///
/// ```
/// use ogee::lens::{detect, remesh, Remesh};
/// use ogee::{ControlMesh, FaceList, Level, Vec3};
///
/// // Two lenses, joined by a slit of four edges, inside two circles of eight points.
/// let column = |x: u32, y: u32| if y == 0 { x.min(8 - x) } else { 5 + 8 * (y - 1) + x % 8 };
/// let mut faces = FaceList::new();
/// for y in 0..3 {
///     for x in 0..8 {
///         faces.push(&[column(x, y), column(x + 1, y), column(x + 1, y + 1), column(x, y + 1)]);
///     }
/// }
/// let points = (0..29).map(|v| Vec3::new(f64::from(v), f64::from(v * v % 7), 0.0)).collect();
/// let mesh = ControlMesh::new(points, faces);
///
/// let found = detect(&Level::new(&mesh)?)?;
/// let lenses: Vec<_> = found.isolated().map(|lens| lens.vertex).collect();
/// let smaller = remesh(&mesh, &lenses, Remesh::default())?;
/// assert_eq!((smaller.mesh.points.len(), smaller.mesh.faces.len()), (25, 20));
/// assert!(detect(&Level::new(&smaller.mesh)?)?.lenses.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn remesh(mesh: &ControlMesh, lenses: &[VertexId], how: Remesh) -> Result<Remeshed, LensError> {
    let level = Level::new(mesh).map_err(LensError::Mesh)?;
    let nets: Vec<LensNet> =
        lenses.iter().map(|&vertex| regular_net(&level, vertex)).collect::<Result<_, _>>()?;
    require_distinct(lenses)?;

    let mut points = mesh.points.clone();
    for net in &nets {
        for (number, point) in how.new_values(&net.vertices.map(|v| mesh.points[v.index()])) {
            points[net.vertices[number].index()] = point;
        }
    }
    let vertices = renumber_vertices(&nets, how, mesh.points.len());
    let connectivity = Connectivity::new(mesh, &level, &nets, how, &vertices);
    // Of two vertices with one number the first is the one that stays.
    let mut kept = Vec::with_capacity(points.len());
    for (point, new) in points.into_iter().zip(&vertices) {
        if new.is_some_and(|new| new.index() == kept.len()) {
            kept.push(point);
        }
    }
    let new_vertex = |v: u32| vertices[v as usize].map(|new| new.0);
    let mesh = ControlMesh {
        points: kept,
        creases: mesh
            .creases
            .iter()
            .filter_map(|crease| {
                let [a, b] = crease.vertices.map(new_vertex);
                Some(Crease { vertices: [a?, b?], ..*crease })
            })
            .collect(),
        corners: mesh
            .corners
            .iter()
            .filter_map(|corner| Some(Corner { vertex: new_vertex(corner.vertex)?, ..*corner }))
            .collect(),
        holes: mesh.holes.iter().filter_map(|&f| connectivity.map[f as usize].map(|new| new.0)).collect(),
        meetings: mesh
            .meetings
            .iter()
            .filter_map(|meeting| {
                let ports = meeting.ports.iter().map(|&v| new_vertex(v)).collect::<Option<_>>()?;
                Some(Meeting { vertex: new_vertex(meeting.vertex)?, ports, t: meeting.t })
            })
            .collect(),
        scheme: mesh.scheme,
        uv: connectivity.uv,
        faces: connectivity.faces,
    };
    Ok(Remeshed { mesh, vertices, faces: connectivity.map })
}

/// Each lens may be named once. That two regular ones share no vertex of layers 0 and 1 needs no check: one would lie in layer 2 of
/// the other.
fn require_distinct(lenses: &[VertexId]) -> Result<(), LensError> {
    let mut sorted = lenses.to_vec();
    sorted.sort_unstable();
    match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(LensError::NamedTwice { vertex: pair[0] }),
        None => Ok(()),
    }
}

fn renumber_vertices(nets: &[LensNet], how: Remesh, count: usize) -> Vec<Option<VertexId>> {
    let mut stays = vec![true; count];
    for net in nets {
        stays[net.centre().index()] = false;
        if how.identifies() {
            stays[net.vertices[3].index()] = false;
        }
    }
    let mut next = 0;
    let mut vertices: Vec<Option<VertexId>> = stays
        .into_iter()
        .map(|stays| {
            let id = VertexId(next);
            next += u32::from(stays);
            stays.then_some(id)
        })
        .collect();
    if how.identifies() {
        for net in nets {
            vertices[net.vertices[3].index()] = vertices[net.vertices[1].index()];
        }
    }
    vertices
}

/// The faces of the new cage with their texture coordinates.
struct Connectivity {
    faces: FaceList,
    map: Vec<Option<FaceId>>,
    uv: Option<FaceVarying>,
}

impl Connectivity {
    fn new(
        mesh: &ControlMesh,
        level: &Level,
        nets: &[LensNet],
        how: Remesh,
        vertices: &[Option<VertexId>],
    ) -> Connectivity {
        let topology = level.topology();
        let texture = mesh.uv.as_ref().map(|uv| remeshed_texture(mesh, uv, level, nets, how));
        // For each face at the centre of a lens, which lens.
        let mut central: Vec<Option<usize>> = vec![None; mesh.faces.len()];
        for (k, net) in nets.iter().enumerate() {
            for f in net.faces(topology, 1) {
                central[f.index()] = Some(k);
            }
        }
        let mut quads: Vec<Option<FaceId>> = vec![None; nets.len()];
        let mut faces = FaceList::with_capacity(mesh.faces.len(), mesh.faces.corners().len());
        let mut indices = Vec::new();
        let new_vertex = |v: u32| vertices[v as usize].map(|new| new.0);
        let map = mesh.faces.iter().enumerate().map(|(f, corners)| {
            let corner_indices = |c: usize| texture.as_ref().map(|uv| uv.indices[c]);
            let Some(k) = central[f] else {
                let id = FaceId(faces.len() as u32);
                faces.push(&corners.iter().filter_map(|&v| new_vertex(v)).collect::<Vec<_>>());
                let start = mesh.faces.starts()[f] as usize;
                indices.extend((start..start + corners.len()).filter_map(corner_indices));
                return Some(id);
            };
            if how.identifies() {
                return None;
            }
            let id = *quads[k].get_or_insert_with(|| {
                let id = FaceId(faces.len() as u32);
                let ring = [1, 2, 3, 4].map(|number| nets[k].vertices[number].0);
                faces.push(&ring.into_iter().filter_map(new_vertex).collect::<Vec<_>>());
                let [first, second] = [0, 1].map(|q| nets[k].cells[q][0][0]);
                let around = [topology.next(first), topology.next(topology.next(first))];
                let back = [topology.next(second), topology.next(topology.next(second))];
                let halfedges = around.into_iter().chain(back).map(|h| h.index());
                indices.extend(halfedges.filter_map(corner_indices));
                id
            });
            Some(id)
        });
        let map = map.collect();
        Connectivity { faces, map, uv: texture.map(|uv| FaceVarying { indices, ..uv }) }
    }
}

/// Texture coordinates by the corners of the old faces. Where no seam runs through the disk of a lens they follow its points.
fn remeshed_texture(
    mesh: &ControlMesh,
    uv: &FaceVarying,
    level: &Level,
    nets: &[LensNet],
    how: Remesh,
) -> FaceVarying {
    let topology = level.topology();
    let mut texture = uv.clone();
    let starts = mesh.faces.starts();
    for net in nets {
        let corners: Vec<usize> = net
            .disk(topology)
            .iter()
            .flat_map(|f| starts[f.index()] as usize..starts[f.index() + 1] as usize)
            .collect();
        let corner_vertex = |c: usize| VertexId(mesh.faces.corners()[c]);
        let mut seam = false;
        let values: [[f64; 2]; BICUBIC_POINTS] = std::array::from_fn(|number| {
            let mut at = corners.iter().filter(|&&c| corner_vertex(c) == net.vertices[number]);
            let first = at.next().map(|&c| uv.indices[c]);
            seam |= at.any(|&c| Some(uv.indices[c]) != first);
            first.map_or([0.0; 2], |index| uv.values[index as usize])
        });
        if seam {
            continue;
        }
        for (number, value) in how.new_values(&values) {
            let index = texture.values.len() as u32;
            texture.values.push(value);
            let moved = |vertex: VertexId| {
                vertex == net.vertices[number] || (number == 1 && vertex == net.vertices[3])
            };
            for &c in corners.iter().filter(|&&c| moved(corner_vertex(c))) {
                texture.indices[c] = index;
            }
        }
    }
    texture
}
