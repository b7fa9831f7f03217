//! The surface of a chart: one B-spline surface over a rectangle of quads, with as few knots as it really has.
//!
//! A coefficient is the polar form of any polynomial piece inside its support. Pieces come from the coarsest mesh level
//! on which they are polynomial and untouched by smoothing, so that nothing is extrapolated far; next to irregular
//! corners from the patches themselves. `docs/methods/packing.md`, Changes from the paper.

use super::packing::{Chart, Placed};
use super::{CAP_CELLS, Cap, Cells, CornerClass, Layer, Patches, view};
use crate::math::{Grid, Vec3, par};
use crate::mesh::{FaceId, HalfedgeId};
use crate::nurbs::curve::{polar_of, raised};
use crate::nurbs::{KnotVector, NurbsSurface};
use crate::rules::Level;
use std::collections::BTreeMap;

/// Cells along an edge, counted from an irregular corner, that smoothing changes.
const CHANGED_CELLS: usize = 3;

/// What chart surfaces are read from.
pub(crate) struct Pieces<'a> {
    patches: &'a Patches,
    layer: Layer,
    /// `nets[j][quad]`: the layered net of the quad on mesh level `j`, up to the level of the patches.
    nets: Vec<Vec<Grid<Vec3>>>,
    /// Caps by quad and corner.
    caps: BTreeMap<(u32, u32), &'a Cap>,
    /// For each quad the level from which on it is made of bicubic cells away from irregular corners: 0, or more where
    /// a semi-sharp crease touches it, another polygon, or a quad at a meeting of curves.
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
            nets.push(par::map(patches.nets.len(), |quad| {
                let converted = !patches.nets[quad].cells().is_empty();
                if converted { cells.layered_net(quad as u32, &data) } else { patches.nets[quad].clone() }
            }));
        }
        let caps = patches.caps.iter().map(|cap| ((cap.quad, cap.corner), cap)).collect();
        Pieces { patches, layer, nets, caps, settled: settled_levels(base) }
    }

    /// The surface of a chart, one unit of knot per quad.
    pub(crate) fn surface(&self, chart: &Chart) -> NurbsSurface {
        let m = 1usize << self.patches.level;
        let (width, height) = (chart.quads.rows(), chart.quads.cols());
        let corner = |i: usize, j: usize, k: usize| self.class(chart.quads[(i, j)], k);
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
        // Next to a meeting of curves a chart is of degree five throughout: every knot stands twice more.
        let degree = if [a, b, c, d].contains(&CornerClass::Meeting) { 5 } else { 3 };
        let u = self.chart_knots(degree, [[a, d], [b, c]], &columns);
        let v = self.chart_knots(degree, [[a, b], [c, d]], &rows);
        let net = if degree == 3 {
            let (u_places, v_places) = (places::<3>(&u), places::<3>(&v));
            Grid::from_fn(u_places.len(), v_places.len(), |i, j| {
                self.coefficient(chart, &u_places[i], &v_places[j])
            })
        } else {
            let (u_places, v_places) = (places::<5>(&u), places::<5>(&v));
            Grid::from_fn(u_places.len(), v_places.len(), |i, j| {
                self.quintic_coefficient(chart, &u_places[i], &v_places[j])
            })
        };
        // From cells to quads: dividing by a power of two is exact.
        let in_quads = |knots: &KnotVector| {
            KnotVector::new(degree, knots.knots().iter().map(|knot| knot / m as f64).collect())
        };
        NurbsSurface { u: in_quads(&u), v: in_quads(&v), net }
    }

    /// The surface of one quad, over `[0, 2^level]` in both directions.
    pub(crate) fn in_cells(&self, quad: u32) -> NurbsSurface {
        let chart = Chart { quads: Grid::from_fn(1, 1, |_, _| Placed { quad, turn: 0 }) };
        let surface = self.surface(&chart);
        let m = (1usize << self.patches.level) as f64;
        let in_cells = |knots: &KnotVector| {
            KnotVector::new(knots.degree(), knots.knots().iter().map(|knot| knot * m).collect())
        };
        NurbsSurface { u: in_cells(&surface.u), v: in_cells(&surface.v), net: surface.net }
    }

    /// Knots of one direction in cells: quad lines, the knots that smoothing put next to irregular ends, dyadic ones
    /// further out, and those that semi-sharp creases leave.
    fn chart_knots(&self, degree: usize, ends: [[CornerClass; 2]; 2], settled: &[u32]) -> KnotVector {
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
        for (end, corners) in ends.into_iter().enumerate() {
            let from_end = |cells: usize| if end == 0 { cells } else { length.saturating_sub(cells) };
            if corners.iter().any(|class| !matches!(class, CornerClass::Regular | CornerClass::Meeting)) {
                let doubled = if self.layer == Layer::Second { 2 } else { 1 };
                for cells in 1..=CHANGED_CELLS {
                    raise(from_end(cells), if cells <= doubled { 2 } else { 1 });
                }
                for power in 2..level {
                    raise(from_end(1 << power), 1);
                }
            }
            if corners.contains(&CornerClass::Meeting) {
                // On every mesh level the cells beyond the first two are bicubic.
                raise(from_end(1), 2);
                for power in 1..level {
                    raise(from_end(1 << power), 1);
                    raise(from_end(3 << (power - 1)), 1);
                }
            }
        }
        times[0] = 4;
        times[length] = 4;
        let raised = |times: usize| if times == 0 { 0 } else { times + degree - 3 };
        KnotVector::from_multiplicities(
            degree,
            times.iter().enumerate().map(|(knot, &times)| (knot as f64, raised(times))),
        )
    }

    /// What the corner `k` of a quad is, in the frame of its chart.
    fn class(&self, placed: Placed, k: usize) -> CornerClass {
        self.patches.classes[placed.quad as usize][(placed.turn as usize + k) % 4]
    }

    /// A coefficient of a chart of degree five: of a cap, or of a bicubic piece raised.
    fn quintic_coefficient(&self, chart: &Chart, u: &Place<5>, v: &Place<5>) -> Vec3 {
        let m = 1usize << self.patches.level;
        let placed = chart.quads[(u.cell / m, v.cell / m)];
        let cell = (u.cell % m, v.cell % m);
        for k in (0..4).filter(|&k| self.class(placed, k) == CornerClass::Meeting) {
            let own = view((4 - k) % 4, cell.0, cell.1, m - 1);
            let Some(cap) = self.caps.get(&(placed.quad, (placed.turn + k as u32) % 4)) else { continue };
            if own.0 < CAP_CELLS && own.1 < CAP_CELLS {
                let local = |place: &Place<5>| place.arguments.map(|knot| knot - (place.cell / m * m) as f64);
                let back = |arguments: [f64; 5]| arguments.map(|knot| m as f64 - knot);
                let (x, y) = (local(u), local(v));
                let (a, b) = match k {
                    0 => (x, y),
                    1 => (y, back(x)),
                    2 => (back(x), back(y)),
                    _ => (back(y), x),
                };
                return cap.polar(own, &a, &b);
            }
        }
        let of = |place: &Place<5>, k: usize| {
            let [low, high] = place.span;
            Place::<3> {
                arguments: std::array::from_fn(|i| if i < k { high } else { low }),
                span: place.span,
                cell: place.cell,
            }
        };
        let bezier = Grid::from_fn(4, 4, |i, j| self.coefficient(chart, &of(u, i), &of(v, j)));
        let half: [Vec3; 4] = std::array::from_fn(|i| quintic_polar(bezier.row(i), v));
        quintic_polar(&half, u)
    }

    fn coefficient(&self, chart: &Chart, u: &Place<3>, v: &Place<3>) -> Vec3 {
        let m = 1usize << self.patches.level;
        let placed = chart.quads[(u.cell / m, v.cell / m)];
        let (origin_u, origin_v) = (u.cell / m * m, v.cell / m * m);
        let (cell_u, cell_v) = (u.cell - origin_u, v.cell - origin_v);
        let local = |place: &Place<3>, origin: usize| place.arguments.map(|knot| knot - origin as f64);
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
            // The cell as corner k of the chart's own frame sees it.
            let (x, y) = view((4 - k) % 4, a, b, last);
            match self.class(placed, k) {
                CornerClass::Regular => true,
                CornerClass::Meeting => x.max(y) >= CAP_CELLS,
                _ => !(y == 0 && x * size < CHANGED_CELLS || x == 0 && y * size < CHANGED_CELLS),
            }
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

/// The polar form of a cubic Bezier piece over a span, raised to degree five.
fn quintic_polar(cubic: &[Vec3], place: &Place<5>) -> Vec3 {
    let quartic: [Vec3; 5] = raised(cubic);
    let mut work: [Vec3; 6] = raised(&quartic);
    let [low, high] = place.span;
    let knots: [f64; 10] = std::array::from_fn(|k| if k < 5 { low } else { high });
    polar_of(&knots, &mut work, &place.arguments)
}

/// Where a coefficient is read: its inner knots, a span of its support next to the Greville abscissa, and a cell of it.
struct Place<const DEGREE: usize> {
    arguments: [f64; DEGREE],
    span: [f64; 2],
    cell: usize,
}

fn places<const DEGREE: usize>(knots: &KnotVector) -> Vec<Place<DEGREE>> {
    let values = knots.knots();
    (0..knots.coefficients())
        .map(|i| {
            let arguments: [f64; DEGREE] = std::array::from_fn(|k| values[i + 1 + k]);
            let greville = arguments.iter().sum::<f64>() / DEGREE as f64;
            let distance = |&s: &usize| (values[s] - greville).max(greville - values[s + 1]).max(0.0);
            let spans = (i..=i + DEGREE).filter(|&s| values[s] < values[s + 1]);
            let s = spans.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(i);
            let cell = (greville.floor() as usize).clamp(values[s] as usize, values[s + 1] as usize - 1);
            Place { arguments, span: [values[s], values[s + 1]], cell }
        })
        .collect()
}

/// For each face the number of steps after which no finite sharpness is left at its corners, and it touches no polygon
/// but quads and no quad at a meeting of curves.
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
    for (slice, _) in base.slices() {
        topology.halfedges(slice).for_each(|h| touch(topology.origin(h), 1.0));
    }
    let polygons = (0..topology.face_count() as u32).map(FaceId).filter(|&f| topology.face_size(f) != 4);
    for h in polygons.flat_map(|f| topology.halfedges(f)) {
        touch(topology.origin(h), 1.0);
    }
    settled
}
