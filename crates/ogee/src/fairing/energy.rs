//! The thin-plate energy of a mesh: second differences of the mesh that it is split into, squared and summed.

use crate::mesh::{FaceId, HalfedgeId, Topology, VertexId};
use crate::rules::Level;
use crate::stencil::StencilTable;

/// Sparse rows over the vertices of a cage.
pub(super) type Rows = Vec<Vec<(u32, f64)>>;

/// The rows `D S` of second differences `D` of the mesh after so many splits `S`, over the points of the cage. In a regular
/// mesh they are those of `f_uu^2 + 2 f_uv^2 + f_vv^2`; around other vertices, the umbrella in place of both straight ones.
/// Nothing bends across sharp edges or at sharp vertices.
pub(super) fn second_differences(cage: &Level, splits: u32) -> Rows {
    let first = cage.refine();
    let (mut level, mut stencils) = (first.level, first.stencils);
    for _ in 1..splits {
        let step = level.refine();
        stencils = stencils.then(&step.stencils);
        level = step.level;
    }
    let topology = level.topology();
    let mut rows = Rows::new();
    for v in (0..topology.vertex_count() as u32).map(VertexId) {
        at_vertex(&level, v, |terms| rows.push(on_cage(&stencils, terms)));
    }
    // Two of the four mixed terms of a vertex are counted at each of its faces.
    let twist = 2.0_f64.sqrt();
    for f in (0..topology.face_count() as u32).map(FaceId) {
        let signs = [twist, -twist, twist, -twist];
        let terms: Vec<(VertexId, f64)> =
            topology.halfedges(f).map(|h| topology.origin(h)).zip(signs).collect();
        rows.push(on_cage(&stencils, &terms));
    }
    rows
}

/// The straight second differences at one vertex.
fn at_vertex(level: &Level, v: VertexId, mut add: impl FnMut(&[(VertexId, f64)])) {
    let topology = level.topology();
    let spokes: Vec<HalfedgeId> = topology.ring(v).collect();
    if level.vertex_sharpness(v) > 0.0 {
        return;
    }
    if topology.is_boundary(v) {
        if let (Some(&first), Some(&last)) = (spokes.first(), spokes.last()) {
            add(&straight(v, topology.target(first), topology.origin(topology.prev(last))));
        }
        return;
    }
    let sharp = |h: HalfedgeId| level.edge_sharpness(h) > 0.0;
    let ends: Vec<VertexId> = spokes.iter().map(|&h| topology.target(h)).collect();
    if let [a, b, c, d] = ends[..] {
        let [along, across] = [sharp(spokes[1]) || sharp(spokes[3]), sharp(spokes[0]) || sharp(spokes[2])];
        if !along {
            add(&straight(v, a, c));
        }
        if !across {
            add(&straight(v, b, d));
        }
    } else if !ends.is_empty() && !spokes.iter().any(|&h| sharp(h)) {
        // As long as the two of a regular vertex together.
        let share = 4.0 / ends.len() as f64 / 2.0_f64.sqrt();
        let mut terms: Vec<(VertexId, f64)> = ends.iter().map(|&end| (end, share)).collect();
        terms.push((v, -4.0 / 2.0_f64.sqrt()));
        add(&terms);
    }
}

fn straight(v: VertexId, before: VertexId, after: VertexId) -> [(VertexId, f64); 3] {
    [(before, 1.0), (v, -2.0), (after, 1.0)]
}

/// Weights on points of the split mesh as weights on the cage, each vertex once.
fn on_cage(stencils: &StencilTable, terms: &[(VertexId, f64)]) -> Vec<(u32, f64)> {
    let mut row = Vec::new();
    for &(v, outer) in terms {
        row.extend(stencils.row(v.index()).map(|(source, inner)| (source, outer * inner)));
    }
    joined(row)
}

/// Each source once, in order.
pub(super) fn joined(mut row: Vec<(u32, f64)>) -> Vec<(u32, f64)> {
    row.sort_by_key(|term| term.0);
    row.dedup_by(|next, kept| {
        let same = next.0 == kept.0;
        if same {
            kept.1 += next.1;
        }
        same
    });
    row
}

/// For each source the rows that name it, with their weights.
pub(super) fn transposed(rows: &Rows, sources: usize) -> Vec<Vec<(u32, f64)>> {
    let mut columns = vec![Vec::new(); sources];
    for (number, row) in (0..).zip(rows) {
        for &(source, weight) in row {
            columns[source as usize].push((number, weight));
        }
    }
    columns
}

/// The product of the transposed rows with the rows, row by row.
pub(super) fn gram(rows: &Rows, sources: usize) -> Rows {
    let columns = transposed(rows, sources);
    let mut sums = vec![0.0; sources];
    let gather = |column: &Vec<(u32, f64)>| {
        let mut touched: Vec<u32> = Vec::new();
        for &(number, outer) in column {
            for &(source, inner) in &rows[number as usize] {
                if sums[source as usize] == 0.0 {
                    touched.push(source);
                }
                sums[source as usize] += outer * inner;
            }
        }
        touched.sort_unstable();
        touched.dedup();
        touched.into_iter().map(|source| (source, std::mem::take(&mut sums[source as usize]))).collect()
    };
    columns.iter().map(gather).collect()
}

/// True if all corners of a level's faces are those of the topology: what a cage's numbers are good for.
pub(super) fn knows(topology: &Topology, vertex: u32) -> bool {
    (vertex as usize) < topology.vertex_count()
}
