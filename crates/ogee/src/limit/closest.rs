//! `ClosestPoints`: the point of the surface that is closest to a given one.
//!
//! A tree of boxes says which pieces can be close enough. A piece is cut into halves until the square of the distance is
//! convex over a part of it, so that Newton's method finds the least there and no start can be wrong; what can hold
//! nothing better than what is known is left out.

use super::bernstein::{Square, bezier};
use super::bicubic::{self, Net};
use super::walk::{Walk, last_step, narrow, subtract, wide};
use super::{Flags, LimitSurface};
use crate::math::bounds::{Bounds, BoundsTree, TreeNode};
use crate::math::newton::{Foot, Rectangle};
use crate::math::{SurfaceJet, Vec3, par};
use crate::patch::{Location, Piece, Wide, from_corner};

/// The point of a surface that is closest to a given one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// Its address.
    pub location: Location,
    /// Where it is: the surface at that address.
    pub position: Vec3,
    /// How far from the given point.
    pub distance: f64,
}

/// Finds closest points of one surface; made by [`LimitSurface::closest_points`].
#[derive(Clone, Debug)]
pub struct ClosestPoints<'a> {
    surface: &'a LimitSurface<'a>,
    places: Vec<Place>,
    tree: BoundsTree,
    /// The diagonal of the box of the surface.
    size: f64,
    /// The largest coordinate there, signs aside.
    reach: f64,
}

/// A piece of the surface: which, and the square of the parametric face that it covers.
#[derive(Clone, Copy, Debug)]
struct Place {
    root: u32,
    /// `None` where the face is one leaf.
    piece: Option<Piece>,
    origin: [f64; 2],
    width: f64,
}

impl LimitSurface<'_> {
    /// The closest point of the surface, for a single question. It costs as much as
    /// [`LimitSurface::closest_points`]: for more than one, keep that.
    pub fn closest(&self, point: Vec3) -> Option<Closest> {
        self.closest_points().closest(point)
    }

    /// Prepares for questions about closest points.
    ///
    /// Costs about a microsecond for each bicubic patch and each extraordinary corner of a face, on one core, and some 200
    /// bytes; runs on all cores.
    pub fn closest_points(&self) -> ClosestPoints<'_> {
        let table = self.table();
        let mut places = Vec::with_capacity(table.len());
        let visible = (0..table.len()).filter(|&root| table.is_visible(root));
        for root in visible.map(|root| root as u32) {
            let whole = Place { root, piece: None, origin: [0.0; 2], width: 1.0 };
            if table.root_leaf(root).is_some() {
                places.push(whole);
            } else {
                whole.add_pieces(self, table.root_node(root).piece(), &mut places);
            }
        }
        let boxes = par::collect(places.len(), |number| places[number].bounds(self));
        let tree = BoundsTree::new(&boxes);
        let whole = tree.root().map_or(Bounds::of([Vec3::ZERO]), |root| *tree.bounds(root));
        let size = (whole.upper - whole.lower).length();
        ClosestPoints { surface: self, places, tree, size, reach: whole.reach() }
    }
}

impl Place {
    /// The leaves and tails of a piece that covers this place.
    fn add_pieces(self, surface: &LimitSurface<'_>, piece: Piece, places: &mut Vec<Place>) {
        let Piece::Split(split) = piece else {
            places.push(Place { piece: Some(piece), ..self });
            return;
        };
        let width = 0.5 * self.width;
        let [u, v] = self.origin;
        let origins = [[u, v], [u + width, v], [u + width, v + width], [u, v + width]];
        for (node, origin) in surface.table().split(split).iter().zip(origins) {
            Place { origin, width, ..self }.add_pieces(surface, node.piece(), places);
        }
    }

    /// A box around it.
    fn bounds(&self, surface: &LimitSurface<'_>) -> Bounds {
        /// Steps of a chain that are looked into: each takes more of what the ring's box has too much.
        const STEPS: i32 = 3;
        let Some(Piece::Tail(number)) = self.piece else {
            let (net, base) = self.net(surface);
            return moved(Bounds::of(bezier(&net)), base);
        };
        let (table, points) = (surface.table(), surface.points());
        let tail = table.tail(number);
        let basis = table.basis(tail);
        let mut walk = Walk::default();
        let mut bounds = Bounds::EMPTY;
        for step in 1..=STEPS {
            walk.go(table, points, number, tail, step);
            for tile in 0..basis.tiles.len() {
                let net = walk.control_net(basis, tile);
                bounds = bounds.with(moved(Bounds::of(bezier(&net)), walk.base()));
            }
        }
        let rest = walk.rest(basis).iter().copied().map(narrow);
        bounds.with(moved(Bounds::of(rest), walk.base()))
    }

    /// The net of a place that is one patch, relative to a point.
    fn net(&self, surface: &LimitSurface<'_>) -> (Net, Wide) {
        let (table, points) = (surface.table(), surface.points());
        let sources = match self.piece {
            Some(Piece::Leaf(leaf)) => table.leaf(leaf),
            _ => table.root_leaf(self.root).expect("a place without a piece is one leaf"),
        };
        let base = wide(points[sources[5] as usize]);
        (sources.map(|source| subtract(wide(points[source as usize]), base)), base)
    }

    /// The address of a point of this place.
    fn location(&self, [u, v]: [f64; 2]) -> Location {
        let at = |origin: f64, t: f64| (origin + self.width * t).clamp(0.0, 1.0);
        Location { root: self.root, u: at(self.origin[0], u), v: at(self.origin[1], v) }
    }
}

fn moved(bounds: Bounds, by: Wide) -> Bounds {
    let by = narrow(by);
    Bounds { lower: bounds.lower + by, upper: bounds.upper + by }
}

impl ClosestPoints<'_> {
    /// The point of the visible surface that is closest to a point; of several as close, always the same one. `None` where
    /// nothing is visible, or where the point has a coordinate that is infinite or no number.
    ///
    /// The distance is the least there is, to rounding. Costs some microseconds, and more where many parts of the surface
    /// are about as close: at the centre of a sphere, all of them are looked at.
    pub fn closest(&self, point: Vec3) -> Option<Closest> {
        Search::new(self).closest(point)
    }

    /// [`ClosestPoints::closest`] for many points, in the order given, on all cores.
    pub fn closest_batch(&self, points: &[Vec3]) -> Vec<Option<Closest>> {
        const CHUNK: usize = 64;
        let chunks = par::map(points.len().div_ceil(CHUNK), |chunk| {
            let points = &points[chunk * CHUNK..points.len().min((chunk + 1) * CHUNK)];
            let mut search = Search::new(self);
            points.iter().map(|&point| search.closest(point)).collect::<Vec<_>>()
        });
        chunks.into_iter().flatten().collect()
    }
}

/// One search after another; keeps its memory.
///
/// Lengths are in units of about the distance of the farthest part, so that no square leaves the range of numbers.
struct Search<'a> {
    parent: &'a ClosestPoints<'a>,
    walk: Walk,
    stack: Vec<(TreeNode, f64)>,
    point: Vec3,
    scale: f64,
    /// Distances that differ by less are the same.
    tolerance: f64,
    /// Parts of the patch at hand that were looked at, and the factor on the tolerance that this has led to.
    parts: u32,
    loose: f64,
    best: Option<Best>,
    /// The square of a distance from which on nothing is of interest.
    limit: f64,
}

/// The closest point so far.
struct Best {
    location: Location,
    distance: f64,
    /// The unit vector from there to the given point; zero if it is there.
    towards: Vec3,
}

/// A bicubic patch seen from the given point, and where it belongs.
struct Patch {
    /// Coefficients of powers, relative to a point near it: derivatives keep their digits however small the patch is.
    net: Net,
    /// That point, relative to the given one.
    offset: Vec3,
    place: Place,
    /// Where it is a tile of a chain.
    cell: Option<Cell>,
    /// What rounding may do to squares of distances.
    noise: f64,
}

/// A tile of a chain in the frame of its corner.
#[derive(Clone, Copy)]
struct Cell {
    corner: u32,
    origin: [f64; 2],
    width: f64,
}

impl Patch {
    fn jet(&self, [x, y]: [f64; 2]) -> SurfaceJet {
        let [position, du, dv, duu, duv, dvv] = bicubic::single(&self.net, x, y);
        SurfaceJet { position: self.offset + position, du, dv, duu, duv, dvv }
    }

    fn location(&self, [x, y]: [f64; 2]) -> Location {
        let Some(Cell { corner, origin: [i, j], width }) = self.cell else {
            return self.place.location([x, y]);
        };
        self.place.location(from_corner(corner, i + width * x, j + width * y).into())
    }
}

impl<'a> Search<'a> {
    fn new(parent: &'a ClosestPoints<'a>) -> Search<'a> {
        Search {
            parent,
            walk: Walk::default(),
            stack: Vec::new(),
            point: Vec3::ZERO,
            scale: 1.0,
            tolerance: 0.0,
            parts: 0,
            loose: 1.0,
            best: None,
            limit: f64::INFINITY,
        }
    }

    fn closest(&mut self, point: Vec3) -> Option<Closest> {
        /// Of the size of the surface, and of the largest coordinate.
        const TOLERANCES: [f64; 2] = [1e-14, 4.0 * f64::EPSILON];
        let ClosestPoints { surface, tree, size, reach, .. } = self.parent;
        let root = tree.root().filter(|_| point.is_finite())?;
        let reach = Bounds::of([point]).reach().max(*reach);
        self.point = point;
        self.scale = one_over_power_of_two((tree.bounds(root).offset(point).length() + size).min(f64::MAX));
        self.tolerance = self.scale * (TOLERANCES[0] * size + TOLERANCES[1] * reach);
        self.best = None;
        self.start_parts();
        self.stack.clear();
        self.stack.push((root, 0.0));
        while let Some((node, lower)) = self.stack.pop() {
            if lower >= self.limit {
                continue;
            }
            if let Some(number) = tree.single(node) {
                self.place(self.parent.places[number]);
                continue;
            }
            let [a, b] = tree.children(node).map(|child| (child, self.square(tree.bounds(child))));
            // The nearer one is looked at first.
            let (near, far) = if b.1 < a.1 { (b, a) } else { (a, b) };
            self.stack.extend([far, near]);
        }
        let location = self.polished(self.best.as_ref()?.location);
        let position = surface.eval(location).position;
        Some(Closest { location, position, distance: position.distance(point) })
    }

    /// One more step from the best point: it may be a corner of a part, so close to the foot that no distance tells
    /// them apart.
    fn polished(&self, location: Location) -> Location {
        let surface = self.parent.surface;
        let jet = surface.jet(location);
        if jet.flags.contains(Flags::AT_EXTRAORDINARY) {
            return location;
        }
        let relative = |jet: SurfaceJet| SurfaceJet { position: jet.position - self.point, ..jet };
        let foot = Foot::at(location.parameters(), relative(jet.jet));
        let [u, v] = foot
            .polished(&[[0.0, 1.0]; 2], self.tolerance / self.scale, |[u, v]| {
                relative(surface.jet(Location { u, v, ..location }).jet)
            })
            .parameters;
        Location { u, v, ..location }
    }

    /// The square of the distance to a box.
    fn square(&self, bounds: &Bounds) -> f64 {
        let offset = self.scale * bounds.offset(self.point);
        offset.dot(offset)
    }

    fn place(&mut self, place: Place) {
        if let Some(Piece::Tail(number)) = place.piece {
            return self.tail(number, place);
        }
        let (net, base) = place.net(self.parent.surface);
        self.patch(&net, base, place, None);
    }

    /// A chain, step by step as long as what is left of it can be close enough.
    fn tail(&mut self, number: u32, place: Place) {
        let surface = self.parent.surface;
        let (table, points) = (surface.table(), surface.points());
        let tail = table.tail(number);
        let (corner, basis) = (tail.corner, table.basis(tail));
        let (position, _) = self.walk.corner(table, points, number, tail);
        let location = || place.location(from_corner(corner, 0.0, 0.0).into());
        self.consider(self.scale * (position - self.point), location);
        for step in 1..=last_step(basis) {
            let offset = self.scale * (narrow(self.walk.base()) - self.point);
            let rest = self.walk.rest(basis).iter().map(|&p| offset + self.scale * narrow(p));
            if self.is_far(rest) {
                return;
            }
            self.walk.go(table, points, number, tail, step);
            for tile in 0..basis.tiles.len() {
                let net = self.walk.control_net(basis, tile);
                let (origin, width) = basis.tile_cell(tile);
                let scale = 0.5_f64.powi(step);
                let cell = Cell { corner, origin: origin.map(|at| scale * at), width: scale * width };
                self.patch(&net, self.walk.base(), place, Some(cell));
            }
        }
    }

    /// True if a part of the surface that lies between some points is too far away.
    fn is_far(&self, points: impl Iterator<Item = Vec3> + Clone) -> bool {
        let bounds = Bounds::of(points.clone());
        let offset = bounds.offset(Vec3::ZERO);
        if offset.dot(offset) >= self.limit {
            return true;
        }
        // Seen along the line to the closest point so far: boxes are thick where a surface is askew.
        let Some(best) = &self.best else { return false };
        let lower = points.map(|p| -p.dot(best.towards)).fold(f64::INFINITY, f64::min);
        lower > 0.0 && lower * lower >= self.limit
    }

    /// Before every patch, so that the next one is not left out by what was loosened for the last.
    fn start_parts(&mut self) {
        (self.parts, self.loose) = (0, 1.0);
        self.set_limit();
    }

    /// Where a whole curve is as close as its closest point, cells along it would be cut without end to tell which is
    /// closer by a rounding. So the tolerance grows with their number.
    fn count_part(&mut self) {
        const FREE: u32 = 256;
        const DOUBLED_EVERY: u32 = 64;
        self.parts += 1;
        if self.parts > FREE && self.parts.is_multiple_of(DOUBLED_EVERY) {
            self.loose *= 2.0;
            self.set_limit();
        }
    }

    fn set_limit(&mut self) {
        let distance = self.best.as_ref().map_or(f64::INFINITY, |best| best.distance);
        let limit = (distance - self.loose * self.tolerance).max(0.0);
        self.limit = limit * limit;
    }

    fn consider(&mut self, offset: Vec3, location: impl FnOnce() -> Location) {
        let distance = offset.length();
        if self.best.as_ref().is_some_and(|best| best.distance <= distance) {
            return;
        }
        let towards = (-offset).normalized().unwrap_or(Vec3::ZERO);
        self.best = Some(Best { location: location(), distance, towards });
        self.set_limit();
    }

    fn patch(&mut self, net: &Net, base: Wide, place: Place, cell: Option<Cell>) {
        /// Of the largest coefficient: some dozen roundings.
        const NOISE: f64 = 1e-15;
        let scale = self.scale;
        let net = net.map(|p| [scale * p[0], scale * p[1], scale * p[2], 0.0]);
        let offset = scale * (narrow(base) - self.point);
        let bezier = bezier(&net).map(|p| offset + p);
        if self.is_far(bezier.iter().copied()) {
            return;
        }
        let square = Square::of_distance(&bezier);
        let net = bicubic::coefficients_of(&net);
        let patch = Patch { net, offset, place, cell, noise: NOISE * square.size() };
        self.cell(&patch, &square, [[0.0, 1.0]; 2]);
        self.start_parts();
    }

    /// A rectangle of a patch, and the square of the distance over it.
    fn cell(&mut self, patch: &Patch, square: &Square, within: Rectangle) {
        self.count_part();
        let least = square.least();
        if self.limit == 0.0 || least.value - patch.noise >= self.limit {
            return;
        }
        let [[u_from, u_to], [v_from, v_to]] = within;
        let inside = |[s, t]: [f64; 2]| [u_from + s * (u_to - u_from), v_from + t * (v_to - v_from)];
        for (corner, value) in square.corners() {
            // What is no better by its square is not worth to be worked out.
            if self.best.as_ref().is_none_or(|best| value - patch.noise < best.distance * best.distance) {
                let at = inside(corner);
                self.consider(patch.jet(at).position, || patch.location(at));
            }
        }
        if least.is_corner() || least.value - patch.noise >= self.limit {
            return;
        }
        let bend = square.bend();
        let tolerance = self.best.as_ref().map_or(0.0, |best| best.distance * self.loose * self.tolerance);
        let is_convex = bend.deficit <= tolerance + patch.noise;
        // A good guess now and then saves many parts, and spares the rest where it hits.
        if is_convex || self.parts.is_power_of_two() {
            let jet = |at| patch.jet(at);
            let mut start = inside(least.place());
            if !is_convex {
                start = Foot::leapt(start, &within, jet).parameters;
            }
            let foot = Foot::from_start(start, &within, 0.0, jet).polished(&within, self.tolerance, jet);
            self.consider(foot.offset(), || patch.location(foot.parameters));
        }
        if is_convex || least.value - patch.noise >= self.limit {
            return;
        }
        let [lower, upper] = square.halves(bend.along_first);
        let (mut first, mut second) = (within, within);
        let axis = usize::from(!bend.along_first);
        let middle = 0.5 * (within[axis][0] + within[axis][1]);
        (first[axis][1], second[axis][0]) = (middle, middle);
        let mut halves = [(lower, first), (upper, second)];
        if upper.least().value < lower.least().value {
            halves.swap(0, 1);
        }
        for (square, within) in &halves {
            self.cell(patch, square, *within);
        }
    }
}

/// One over the power of two at or below a number; one where that is no number.
fn one_over_power_of_two(value: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    let power = 1.0 / f64::from_bits(value.to_bits() & EXPONENT);
    if power.is_normal() { power } else { 1.0 }
}
