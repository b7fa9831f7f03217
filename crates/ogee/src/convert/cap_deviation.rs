//! How far the surfaces around irregular vertices are from the limit surface.
//!
//! The mesh is refined a few steps further around them, its nodes are moved to the limit, and for each the closest point is
//! sought on the surface of its sector, or of the one beyond the nearest edge. Far sides are the limit's own.

use super::PlacedChart;
use super::deviation::closest;
use crate::limit::limit_vertex;
use crate::math::{Grid, par};
use crate::mesh::{FaceId, HalfedgeId};
use crate::nurbs::NurbsSurface;
use crate::patch::Adaptive;
use crate::pccm::{Chart, Part, Placed};
use crate::refine::sub_grid;

/// Steps beyond the level of a fan.
const STEPS_BEYOND: u32 = 3;

/// What takes the place of the faces of a sector around an irregular vertex.
pub(super) struct Fan {
    pub(super) level: usize,
    /// The number that the vertex keeps on all levels.
    pub(super) number: u32,
    /// The halfedges that leave the vertex, one for each face.
    pub(super) halfedges: Vec<HalfedgeId>,
    /// True if the last face and the first share an edge that is smooth.
    pub(super) closed: bool,
    /// One for each face, over the unit square; the vertex is at `(0, 0)`, and `u` runs along the halfedge.
    pub(super) surfaces: Vec<NurbsSurface>,
}

impl Fan {
    /// The halfedges in faces that are part of the surface, with their surfaces.
    pub(super) fn visible<'a>(
        &'a self,
        adaptive: &'a Adaptive,
    ) -> impl Iterator<Item = (HalfedgeId, &'a NurbsSurface)> {
        let level = &adaptive.levels()[self.level];
        let faces = self.halfedges.iter().copied().zip(&self.surfaces);
        faces.filter(|&(h, _)| level.is_visible(level.level.topology().face(h)))
    }

    /// A chart for each of them.
    pub(super) fn charts<'a>(&'a self, adaptive: &'a Adaptive) -> impl Iterator<Item = PlacedChart> + 'a {
        let topology = adaptive.levels()[self.level].level.topology();
        self.visible(adaptive).map(|(h, surface)| {
            let face = topology.face(h);
            // A face of its own has its parameters from its own first corner, like all others.
            let chart = Chart { quads: Grid::from_fn(1, 1, |_, _| Placed { quad: face.0, turn: 0 }) };
            PlacedChart { level: self.level, chart, surface: surface.turned(h.0 - topology.first(face).0) }
        })
    }

    /// The sector next to one, across its second edge or, backwards, its first.
    fn neighbour(&self, sector: usize, forward: bool) -> Option<usize> {
        let count = self.surfaces.len();
        match (forward, self.closed) {
            (true, true) => Some((sector + 1) % count),
            (true, false) => Some(sector + 1).filter(|&next| next < count),
            (false, true) => Some((sector + count - 1) % count),
            (false, false) => sector.checked_sub(1),
        }
    }
}

/// For each fan the largest distance of the limit surface from it, over the faces that are part of the surface.
pub(super) fn of_fans(adaptive: &Adaptive, fans: &[Fan]) -> Vec<f64> {
    let mut deviations = vec![0.0; fans.len()];
    for (number, level) in adaptive.levels().iter().enumerate() {
        let topology = level.level.topology();
        let sectors: Vec<(usize, usize, HalfedgeId)> = (0..)
            .zip(fans)
            .filter(|(_, fan)| fan.level == number)
            .flat_map(|(number, fan)| (0..).zip(&fan.halfedges).map(move |(sector, &h)| (number, sector, h)))
            .filter(|&(_, _, h)| level.is_visible(topology.face(h)))
            .collect();
        if sectors.is_empty() {
            continue;
        }
        let mut faces: Vec<FaceId> = sectors.iter().map(|&(_, _, h)| topology.face(h)).collect();
        faces.sort_unstable();
        let part = Part::new(&level.level, 0, &faces);
        let (mut fine, mut nodes) = part.base().refine_points(&part.points(&level.points));
        for _ in 1..STEPS_BEYOND {
            (fine, nodes) = fine.refine_points(&nodes);
        }
        let found = par::map(sectors.len(), |number| {
            let (fan, sector, h) = sectors[number];
            let Some(own) = part.along(h).first().copied() else { return 0.0 };
            let grid = sub_grid(&fine, own.0 / 4, (4 - own.0 % 4) % 4, STEPS_BEYOND);
            let limit = grid.map(|&node| limit_vertex(&fine, &nodes, node).position);
            let cells = (limit.rows() - 1) as f64;
            let mut worst: f64 = 0.0;
            for i in 0..limit.rows() - 1 {
                for j in 0..limit.cols() - 1 {
                    let (u, v) = (i as f64 / cells, j as f64 / cells);
                    let distance = |sector: usize, u: f64, v: f64| {
                        closest(&fans[fan].surfaces[sector], 1.0, (u, v), limit[(i, j)]).1
                    };
                    let mut least = distance(sector, u, v);
                    if let Some(next) = fans[fan].neighbour(sector, true).filter(|_| i == 0) {
                        least = least.min(distance(next, v, 0.0));
                    }
                    if let Some(before) = fans[fan].neighbour(sector, false).filter(|_| j == 0) {
                        least = least.min(distance(before, 0.0, u));
                    }
                    worst = worst.max(least);
                }
            }
            worst
        });
        for ((fan, _, _), distance) in sectors.into_iter().zip(found) {
            deviations[fan] = f64::max(deviations[fan], distance);
        }
    }
    deviations
}
