//! How far patches are from the limit surface.
//!
//! Only the cells next to irregular corners differ from it. There the mesh is refined a few steps beyond the patches,
//! its nodes are moved to the limit, and for each the closest point is sought on the patch of its quad, or on the one
//! across the nearest side.

use crate::limit::limit_vertex;
use crate::math::newton::Foot;
use crate::math::{Vec3, par};
use crate::mesh::{FaceId, HalfedgeId};
use crate::nurbs::{NurbsSurface, SurfaceJet};
use crate::patch::{Neighbourhood, with_ring};
use crate::pccm::{Cells, CornerClass, view};
use crate::refine::sub_grid;
use crate::rules::Level;

/// Steps beyond the level of the patches.
const STEPS_BEYOND: u32 = 2;

/// Patches as the measurement wants them: one surface per quad of the base, over `[0, 2^level]` in both directions.
pub(super) struct Measured<'a> {
    pub(super) base: &'a Level,
    pub(super) points: &'a [Vec3],
    pub(super) level: u32,
    pub(super) surfaces: &'a [NurbsSurface],
}

/// A cell of a quad.
pub(super) type QuadCell = (u32, usize, usize);

/// The cells of visible quads that smoothing changes, a few more where the variant changes fewer.
pub(super) fn changed_cells(base: &Level, level: u32, classes: &[[CornerClass; 4]]) -> Vec<QuadCell> {
    let m = 1usize << level;
    let mut cells = Vec::new();
    for (quad, corners) in
        classes.iter().enumerate().filter(|&(quad, _)| base.is_visible(FaceId(quad as u32)))
    {
        for (k, class) in corners.iter().enumerate().filter(|&(_, &class)| class != CornerClass::Regular) {
            let changed: &[(usize, usize)] = match class {
                CornerClass::Meeting => &[(0, 0), (1, 0), (0, 1), (1, 1)],
                _ => &[(0, 0), (1, 0), (2, 0), (0, 1), (0, 2)],
            };
            for &(a, b) in changed {
                if a < m && b < m {
                    let (i, j) = view(k, a, b, m - 1);
                    cells.push((quad as u32, i, j));
                }
            }
        }
    }
    cells.sort_unstable();
    cells.dedup();
    cells
}

/// All cells of all visible quads.
pub(super) fn all_cells(base: &Level, level: u32) -> Vec<QuadCell> {
    let m = 1usize << level;
    let quads = (0..base.topology().face_count() as u32).filter(|&quad| base.is_visible(FaceId(quad)));
    quads.flat_map(|quad| (0..m).flat_map(move |i| (0..m).map(move |j| (quad, i, j)))).collect()
}

/// The largest distance of the limit surface, over the given cells, from the patches.
pub(super) fn largest_deviation(measured: &Measured<'_>, cells: &[QuadCell], steps_more: u32) -> f64 {
    if cells.is_empty() {
        return 0.0;
    }
    let Measured { base, points, level, .. } = *measured;
    let (mut fine, mut fine_points) = (base.clone(), points.to_vec());
    for _ in 0..level {
        (fine, fine_points) = fine.refine_points(&fine_points);
    }
    let template = Cells::new(base, &fine, level);
    let faces: Vec<FaceId> = cells.iter().map(|&(quad, i, j)| FaceId(template.face(quad, i, j))).collect();
    let own_faces = with_ring(&fine, &faces);
    let part = Neighbourhood::new(&fine, &own_faces);
    let (mut level_beyond, mut nodes) = (part.level.clone(), part.take(&fine_points));
    let depth = STEPS_BEYOND + steps_more;
    for _ in 0..depth {
        (level_beyond, nodes) = level_beyond.refine_points(&nodes);
    }
    let distances = par::map(cells.len(), |number| {
        let (quad, i, j) = cells[number];
        let Ok(own) = own_faces.binary_search(&faces[number]) else { return 0.0 };
        let grid = sub_grid(&level_beyond, own as u32, template.turns(i, j), depth);
        let spacing = 1.0 / (grid.rows() - 1) as f64;
        let mut worst: f64 = 0.0;
        for a in 0..grid.rows() {
            for b in 0..grid.cols() {
                let limit = limit_vertex(&level_beyond, &nodes, grid[(a, b)]).position;
                let start = (i as f64 + a as f64 * spacing, j as f64 + b as f64 * spacing);
                worst = worst.max(measured.distance(quad, start, limit));
            }
        }
        worst
    });
    distances.into_iter().fold(0.0, f64::max)
}

impl Measured<'_> {
    /// Distance of a point from the patch of a quad near given parameters, or from its neighbours there.
    fn distance(&self, quad: u32, start: (f64, f64), point: Vec3) -> f64 {
        let m = f64::from(1u32 << self.level);
        let ((u, v), mut best) = closest(&self.surfaces[quad as usize], m, start, point);
        let sides = [(v == 0.0, u), (u == m, v), (v == m, m - u), (u == 0.0, m - v)];
        for (k, &(on_side, along)) in sides.iter().enumerate() {
            let Some(twin) = self.base.topology().twin(HalfedgeId(4 * quad + k as u32)).filter(|_| on_side)
            else {
                continue;
            };
            let start = corner_frame(twin.index() % 4, m - along, 0.0, m);
            best = best.min(closest(&self.surfaces[twin.index() / 4], m, start, point).1);
        }
        best
    }
}

/// What corner `k` of a quad of side `m` sees at `(a, b)`, in the quad's own parameters.
fn corner_frame(k: usize, a: f64, b: f64, m: f64) -> (f64, f64) {
    match k {
        0 => (a, b),
        1 => (m - b, a),
        2 => (m - a, m - b),
        _ => (b, m - a),
    }
}

/// The point of a patch nearest to a point, from a start.
pub(super) fn closest(surface: &NurbsSurface, m: f64, start: (f64, f64), point: Vec3) -> ((f64, f64), f64) {
    // The last digits of a distance do not matter here.
    const WORTH: f64 = 1e-6;
    let foot = Foot::from_start([start.0, start.1], &[[0.0, m]; 2], WORTH, |[u, v]| {
        let jet = surface.jet(u, v);
        SurfaceJet { position: jet.position - point, ..jet }
    });
    let [u, v] = foot.parameters;
    ((u, v), foot.distance)
}
