//! The surface of a chart: one B-spline surface over a rectangle of quads, with as few knots as it really has.
//!
//! A coefficient is the polar form of any polynomial piece inside its support. Pieces come from the coarsest mesh level
//! on which they are polynomial and untouched by smoothing, so that nothing is extrapolated far; next to irregular
//! corners from the patches themselves. `docs/methods/packing.md`, Changes from the paper.

use super::packing::{Chart, Placed};
use super::{Cells, CornerClass, Layer, Patches, view};
use crate::math::{Grid, Vec3, par};
use crate::mesh::{FaceId, HalfedgeId};
use crate::nurbs::curve::polar_of;
use crate::nurbs::{KnotVector, NurbsSurface};
use crate::rules::Level;

/// Cells along an edge, counted from an irregular corner, that smoothing changes.
const CHANGED_CELLS: usize = 3;

/// What chart surfaces are read from.
pub(crate) struct Pieces<'a> {
    patches: &'a Patches,
    layer: Layer,
    /// `nets[j][quad]`: the layered net of the quad on mesh level `j`, up to the level of the patches.
    nets: Vec<Vec<Grid<Vec3>>>,
    /// For each quad the level from which on it is made of bicubic cells away from irregular corners: 0, or more where
    /// a semi-sharp crease touches it.
    settled: Vec<u32>,
}

impl<'a> Pieces<'a> {
    pub(crate) fn new(base: &'a Level, points: &[Vec3], patches: &'a Patches, layer: Layer) -> Pieces<'a> {
        let mut nets = Vec::new();
        let (mut level, mut data) = (base.clone(), points.to_vec());
        for depth in 0..=patches.level {
            if depth > 0 {
                (level, data) = level.refine_points(&data);
            }
            let cells = Cells::new(base, &level, depth);
            nets.push(par::map(patches.nets.len(), |quad| cells.layered_net(quad as u32, &data)));
        }
        Pieces { patches, layer, nets, settled: settled_levels(base) }
    }

    /// The surface of a chart, one unit of knot per quad.
    pub(crate) fn surface(&self, chart: &Chart) -> NurbsSurface {
        let m = 1usize << self.patches.level;
        let (width, height) = (chart.quads.rows(), chart.quads.cols());
        let corner = |i: usize, j: usize, k: usize| {
            let placed = chart.quads[(i, j)];
            self.patches.classes[placed.quad as usize][(placed.turn as usize + k) % 4] != CornerClass::Regular
        };
        let (a, b, c, d) = (
            corner(0, 0, 0),
            corner(width - 1, 0, 1),
            corner(width - 1, height - 1, 2),
            corner(0, height - 1, 3),
        );
        let settled = |placed: &Placed| self.settled[placed.quad as usize];
        let columns: Vec<u32> =
            (0..width).map(|i| chart.quads.row(i).iter().map(settled).max().unwrap_or(0)).collect();
        let rows: Vec<u32> = (0..height)
            .map(|j| (0..width).map(|i| settled(&chart.quads[(i, j)])).max().unwrap_or(0))
            .collect();
        let u = self.chart_knots([a || d, b || c], &columns);
        let v = self.chart_knots([a || b, c || d], &rows);
        let (u_places, v_places) = (places(&u), places(&v));
        let net = Grid::from_fn(u.coefficients(), v.coefficients(), |i, j| {
            self.coefficient(chart, &u_places[i], &v_places[j])
        });
        // From cells to quads: dividing by a power of two is exact.
        let in_quads = |knots: &KnotVector| {
            KnotVector::new(3, knots.knots().iter().map(|knot| knot / m as f64).collect())
        };
        NurbsSurface { u: in_quads(&u), v: in_quads(&v), net }
    }

    /// Knots of one direction in cells: quad lines, the knots that smoothing put next to irregular ends, dyadic ones
    /// further out, and those that semi-sharp creases leave.
    fn chart_knots(&self, irregular: [bool; 2], settled: &[u32]) -> KnotVector {
        let level = self.patches.level;
        let m = 1usize << level;
        let length = settled.len() * m;
        let mut times = vec![0usize; length + 1];
        let mut raise = |at: usize, to: usize| {
            if 0 < at && at < length {
                times[at] = times[at].max(to);
            }
        };
        for (quad, &settled) in settled.iter().enumerate() {
            let spacing = m >> settled.min(level);
            (0..m).step_by(spacing).for_each(|cell| raise(quad * m + cell, 1));
        }
        for (end, irregular) in irregular.into_iter().enumerate() {
            if !irregular {
                continue;
            }
            let from_end = |cells: usize| if end == 0 { cells } else { length.saturating_sub(cells) };
            let doubled = if self.layer == Layer::Second { 2 } else { 1 };
            for cells in 1..=CHANGED_CELLS {
                raise(from_end(cells), if cells <= doubled { 2 } else { 1 });
            }
            for power in 2..level {
                raise(from_end(1 << power), 1);
            }
        }
        times[0] = 4;
        times[length] = 4;
        KnotVector::from_multiplicities(
            3,
            times.iter().enumerate().map(|(knot, &times)| (knot as f64, times)),
        )
    }

    fn coefficient(&self, chart: &Chart, u: &Place, v: &Place) -> Vec3 {
        let m = 1usize << self.patches.level;
        let placed = chart.quads[(u.cell / m, v.cell / m)];
        let (origin_u, origin_v) = (u.cell / m * m, v.cell / m * m);
        let (cell_u, cell_v) = (u.cell - origin_u, v.cell - origin_v);
        let local = |place: &Place, origin: usize| place.arguments.map(|knot| knot - origin as f64);
        let (args_u, args_v) = (local(u, origin_u), local(v, origin_v));
        for level in self.settled[placed.quad as usize]..=self.patches.level {
            let size = m >> level;
            let (a, b) = (cell_u / size, cell_v / size);
            // One polynomial over the whole coarse cell, however many knots of the chart cross it.
            if self.is_untouched(placed, level, a, b) {
                let scaled = |arguments: [f64; 3]| arguments.map(|knot| knot / size as f64);
                return self.by_nodes(placed, level, (a, b), scaled(args_u), scaled(args_v));
            }
        }
        self.by_patch(placed, (cell_u, cell_v), args_u, args_v)
    }

    /// True if cell `(a, b)` of mesh level `level` is one bicubic piece that smoothing left alone.
    fn is_untouched(&self, placed: Placed, level: u32, a: usize, b: usize) -> bool {
        let (last, size) = ((1usize << level) - 1, (1usize << self.patches.level) >> level);
        (0..4).all(|k| {
            if self.patches.classes[placed.quad as usize][(placed.turn as usize + k) % 4]
                == CornerClass::Regular
            {
                return true;
            }
            // The cell as corner k of the chart's own frame sees it.
            let (x, y) = view((4 - k) % 4, a, b, last);
            !(y == 0 && x * size < CHANGED_CELLS || x == 0 && y * size < CHANGED_CELLS)
        })
    }

    /// From the sixteen nodes around a cell of a mesh level: they are the coefficients of the uniform bicubic there.
    fn by_nodes(&self, placed: Placed, level: u32, (a, b): (usize, usize), u: [f64; 3], v: [f64; 3]) -> Vec3 {
        let net = &self.nets[level as usize][placed.quad as usize];
        let last = net.rows() - 1;
        let knots = |cell: usize| std::array::from_fn(|k| cell as f64 + k as f64 - 2.0);
        tensor_polar([&knots(a), &knots(b)], [u, v], |i, j| {
            net[view(placed.turn as usize, a + i, b + j, last)]
        })
    }

    /// From the piece of the patch on one cell.
    fn by_patch(&self, placed: Placed, (a, b): (usize, usize), u: [f64; 3], v: [f64; 3]) -> Vec3 {
        let net = &self.patches.nets[placed.quad as usize];
        let knots = &self.patches.knots;
        let last = net.rows() - 1;
        let [span_u, span_v] = [a, b].map(|cell| knots.span(cell as f64 + 0.5));
        let around = |span: usize| std::array::from_fn(|k| knots.knots()[span + k - 2]);
        tensor_polar([&around(span_u), &around(span_v)], [u, v], |i, j| {
            net[view(placed.turn as usize, span_u + i - 3, span_v + j - 3, last)]
        })
    }
}

/// The polar form of a bicubic piece: six knots around its span and three arguments in each direction, and its sixteen
/// coefficients.
fn tensor_polar(knots: [&[f64; 6]; 2], arguments: [[f64; 3]; 2], at: impl Fn(usize, usize) -> Vec3) -> Vec3 {
    let mut column: [Vec3; 4] = std::array::from_fn(|i| {
        let mut row: [Vec3; 4] = std::array::from_fn(|j| at(i, j));
        polar_of(knots[1], &mut row, &arguments[1])
    });
    polar_of(knots[0], &mut column, &arguments[0])
}

/// Where a coefficient is read: its inner knots, and a cell of its support next to the Greville abscissa.
struct Place {
    arguments: [f64; 3],
    cell: usize,
}

fn places(knots: &KnotVector) -> Vec<Place> {
    let values = knots.knots();
    (0..knots.coefficients())
        .map(|i| {
            let arguments = [values[i + 1], values[i + 2], values[i + 3]];
            let greville = arguments.iter().sum::<f64>() / 3.0;
            let distance = |&s: &usize| (values[s] - greville).max(greville - values[s + 1]).max(0.0);
            let spans = (i..=i + 3).filter(|&s| values[s] < values[s + 1]);
            let s = spans.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(i);
            let cell = (greville.floor() as usize).clamp(values[s] as usize, values[s + 1] as usize - 1);
            Place { arguments, cell }
        })
        .collect()
}

/// For each quad the number of steps after which no finite sharpness is left at its corners.
fn settled_levels(base: &Level) -> Vec<u32> {
    let topology = base.topology();
    let mut settled = vec![0; topology.face_count()];
    let mut touch = |v: crate::mesh::VertexId, sharpness: f64| {
        for h in topology.ring(v) {
            let f: FaceId = topology.face(h);
            settled[f.index()] = settled[f.index()].max(sharpness.ceil() as u32);
        }
    };
    for (h, sharpness) in base.semi_sharp_edges() {
        let h: HalfedgeId = h;
        touch(topology.origin(h), sharpness);
        touch(topology.target(h), sharpness);
    }
    for (v, sharpness) in base.semi_sharp_vertices() {
        touch(v, sharpness);
    }
    settled
}
