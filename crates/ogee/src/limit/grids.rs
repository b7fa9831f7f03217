//! Limits of all vertices of a dense refinement: position and normal, grid by grid.

use super::vertices::{Around, LimitVertex, limit_vertices, masks_hold, masks_of};
use crate::math::{Vec3, pages, par};
use crate::mesh::connectivity::{Connectivity, Quads};
use crate::mesh::{EdgeId, FaceId, HalfedgeId, VertexId};
use crate::patch::masks;
use crate::refine::{DenseRefinement, Grids};
use crate::rules::{EdgeRule, Level};

impl DenseRefinement<'_> {
    /// The limits of all vertices of the last level, from the points of the cage: positions, and unit normals as
    /// [`limit_vertices`] has them, zero where there is none. Both go into the memory that is there.
    ///
    /// Where curves meet, next to finite sharpness that is left, and at lone sharp vertices, levels are made.
    ///
    /// # Panics
    /// If there are fewer points than vertices of the cage.
    pub fn limit(&self, cage: &[Vec3], positions: &mut Vec<Vec3>, normals: &mut Vec<Vec3>) {
        let mut points = Vec::new();
        self.points(cage, &mut points);
        match self.grids(&points) {
            Some((rules, grids)) if holds(&rules, &grids) => {
                pages::resize(positions, points.len());
                pages::resize(normals, points.len());
                on_grids(&rules, &grids, positions, normals);
            }
            _ => {
                let (mut level, mut points) = self.cage().refine_points(cage);
                for _ in 1..self.depth() {
                    (level, points) = level.refine_points(&points);
                }
                let limits = self.from_levels(&level, &limit_vertices(&level, &points));
                positions.clear();
                positions.extend(limits.iter().map(|limit| limit.position));
                normals.clear();
                normals.extend(limits.iter().map(|limit| limit.normal.unwrap_or(Vec3::ZERO)));
            }
        }
    }
}

/// True if no finite sharpness is left, and every corner has a mask.
fn holds(rules: &Level, grids: &Grids<'_, Quads<'_>, Vec3>) -> bool {
    let (edges, tagged) = rules.tagged_rules();
    let corners = || {
        tagged
            .iter()
            .all(|(v, _)| grids.frame.base.outgoing(VertexId(v)).is_none() || masks_hold(rules, VertexId(v)))
    };
    edges.iter().all(|(_, rule)| rule == EdgeRule::Crease) && corners()
}

fn on_grids(rules: &Level, grids: &Grids<'_, Quads<'_>, Vec3>, positions: &mut [Vec3], normals: &mut [Vec3]) {
    let side = grids.frame.side;
    let per_edge = side - 1;
    let (corner_positions, rest) = positions.split_at_mut(grids.frame.corners.len());
    let (inside_positions, side_positions) = rest.split_at_mut(grids.interiors.len());
    let (corner_normals, rest) = normals.split_at_mut(grids.frame.corners.len());
    let (inside_normals, side_normals) = rest.split_at_mut(grids.interiors.len());

    par::chunk_pairs(corner_positions, corner_normals, 1, Vec::<Vec3>::new, |_, v, position, normal| {
        let limit = corner(rules, grids, VertexId(v as u32));
        (position[0], normal[0]) = (limit.position, limit.normal.unwrap_or(Vec3::ZERO));
    });
    par::chunk_pairs(
        side_positions,
        side_normals,
        per_edge,
        Default::default,
        |rows, e, positions, normals| {
            on_side(grids, grids.frame.base.side(EdgeId(e as u32)), rules, rows, positions, normals);
        },
    );
    par::chunk_pairs(
        inside_positions,
        inside_normals,
        per_edge * per_edge,
        Vec::new,
        |grid, f, positions, normals| {
            grids.closed(FaceId(f as u32), grid);
            let width = side + 1;
            for (k, (position, normal)) in positions.iter_mut().zip(normals).enumerate() {
                let at = (k / per_edge + 1) * width + k % per_edge + 1;
                let edges = [at + width, at + 1, at - width, at - 1];
                let diagonals = [at + width + 1, at - width + 1, at - width - 1, at + width - 1];
                let frame = masks::regular(grid[at], edges.map(|at| grid[at]), diagonals.map(|at| grid[at]));
                (*position, *normal) = (frame.position, side_of(&frame));
            }
        },
    );
}

fn side_of(frame: &masks::Frame) -> Vec3 {
    frame.tangents[0].cross(frame.tangents[1]).normalized().unwrap_or(Vec3::ZERO)
}

struct Corner<'a>(&'a Grids<'a, Quads<'a>, Vec3>, VertexId);

impl Around for Corner<'_> {
    fn own(&self) -> Vec3 {
        self.0.frame.corner(self.1)
    }
    fn neighbour(&self, h: HalfedgeId) -> Vec3 {
        self.0.frame.first(h)
    }
    fn diagonal(&self, h: HalfedgeId) -> Vec3 {
        self.0.beside(h)
    }
    fn next_neighbour(&self, h: HalfedgeId) -> Vec3 {
        self.0.frame.last(self.0.frame.base.prev(h))
    }
}

fn corner(rules: &Level, grids: &Grids<'_, Quads<'_>, Vec3>, v: VertexId) -> LimitVertex {
    match grids.frame.base.outgoing(v) {
        None => LimitVertex { position: grids.frame.corner(v), normal: None },
        Some(_) => masks_of(rules, v, &Corner(grids, v)),
    }
}

/// The points inside one edge.
fn on_side(
    grids: &Grids<'_, Quads<'_>, Vec3>,
    h: HalfedgeId,
    rules: &Level,
    [own, left, right]: &mut [Vec<Vec3>; 3],
    positions: &mut [Vec3],
    normals: &mut [Vec3],
) {
    grids.frame.whole_side(h, own);
    grids.row_beside_whole(h, left);
    let twin = grids.frame.base.twin(h);
    if let Some(twin) = twin {
        grids.row_beside_whole(twin, right);
        right.reverse();
    }
    let is_sharp = rules.edge_rule(h) == EdgeRule::Crease;
    for (k, (position, normal)) in positions.iter_mut().zip(normals).enumerate() {
        let [behind, t, ahead] = [k, k + 1, k + 2];
        if !is_sharp {
            let edges = [own[ahead], left[t], own[behind], right[t]];
            let frame =
                masks::regular(own[t], edges, [left[ahead], left[behind], right[behind], right[ahead]]);
            (*position, *normal) = (frame.position, side_of(&frame));
            continue;
        }
        // One side or two, each from one sharp edge to the other.
        let frame = masks::crease(own[t], &[own[ahead], left[t], own[behind]], &[left[ahead], left[behind]]);
        let mut sum = side_of(&frame);
        if twin.is_some() {
            let edges = [own[behind], right[t], own[ahead]];
            sum += side_of(&masks::crease(own[t], &edges, &[right[behind], right[ahead]]));
        }
        (*position, *normal) = (frame.position, sum.normalized().unwrap_or(Vec3::ZERO));
    }
}
