//! What stands around a quad: whether its corners are regular, and the points just outside.
//!
//! Two statements of the same thing. [`Surroundings`] knows tags, boundaries and polygons. [`plain_corners`] knows only
//! the common case, untagged quads away from boundaries, and is several times as fast; the test
//! `the_quick_way_is_the_general_way` holds it to the first.

use super::chain::Kind;
use crate::mesh::HalfedgeId;
use crate::mesh::connectivity::Connectivity;
use crate::rules::Level;

/// A point outside a quad as a combination of vertices: a vertex, or one mirrored at sharp edges.
pub(super) type Mirrored = Vec<(u32, f64)>;

/// The three points around a corner, outside the quad: below, diagonal, left, where the quad is above and right of it.
pub(super) const BELOW: usize = 0;
pub(super) const DIAGONAL: usize = 1;
pub(super) const LEFT: usize = 2;

/// Slots in a net of 4 x 4 points (`i + 4 j`) of corner `r` of the inner cell, and of the three points around it.
pub(super) const SLOTS: [[usize; 4]; 4] = [[5, 1, 0, 4], [6, 7, 3, 2], [10, 14, 15, 11], [9, 8, 12, 13]];

/// What a corner of a quad is, seen from this quad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum CornerKind {
    /// The quad continues as a bicubic grid there.
    Regular,
    /// Irregular, but the same again after every step.
    Irregular(Kind),
    /// Finite sharpness, or other polygons: one has to refine first.
    Unsettled,
}

/// The general case.
pub(super) struct Surroundings<'a> {
    level: &'a Level,
}

impl<'a> Surroundings<'a> {
    pub(super) fn new(level: &'a Level) -> Surroundings<'a> {
        Surroundings { level }
    }

    /// What the corner is that `h` leaves.
    pub(super) fn corner(&self, h: HalfedgeId) -> CornerKind {
        let (level, topology) = (self.level, self.level.topology());
        let v = topology.origin(h);
        let settled = |s: f64| s == 0.0 || s.is_infinite();
        let own = level.vertex_sharpness(v);
        if !settled(own) || topology.ring(v).any(|h| !settled(level.edge_sharpness(h))) {
            return CornerKind::Unsettled;
        }
        let mut sharp = usize::from(topology.is_boundary(v));
        sharp += topology.ring(v).filter(|&h| level.is_sharp(h)).count();
        let is_corner = own > 0.0 || sharp > 2;
        let halfedges = self.sector(h);
        if halfedges.iter().any(|&h| topology.face_size(topology.face(h)) != 4) {
            return CornerKind::Unsettled;
        }
        let faces = halfedges.len() as u32;
        let position = halfedges.iter().position(|&other| other == h).unwrap_or(0) as u32;
        let kind = match (sharp, is_corner) {
            (0, false) => Kind::Smooth { valence: faces },
            (0, true) => Kind::Cone { valence: faces },
            // The crease that ends here, counted from this quad's own edge.
            (1, false) => Kind::Dart { valence: faces, crease: (faces - position) % faces },
            (_, false) => Kind::Crease { faces, position },
            (_, true) => Kind::Corner { faces, position },
        };
        match kind {
            Kind::Smooth { valence: 4 } | Kind::Crease { faces: 2, .. } | Kind::Corner { faces: 1, .. } => {
                CornerKind::Regular
            }
            _ => CornerKind::Irregular(kind),
        }
    }

    /// The halfedges that leave the corner, over the sector that `h` lies in, counter-clockwise: from its first sharp
    /// edge, or from `h` where there is none.
    fn sector(&self, h: HalfedgeId) -> Vec<HalfedgeId> {
        let topology = self.level.topology();
        let mut first = h;
        while !self.level.is_sharp(first) {
            // Towards the first edge, clockwise; an edge without twin is sharp.
            let Some(twin) = topology.twin(first) else { break };
            first = topology.next(twin);
            if first == h {
                break;
            }
        }
        let mut halfedges = vec![first];
        let mut last = first;
        loop {
            let before = topology.prev(last);
            match topology.twin(before) {
                Some(next) if next != first && !self.level.is_sharp(before) => {
                    halfedges.push(next);
                    last = next;
                }
                _ => return halfedges,
            }
        }
    }

    /// The ring of the irregular corner that `h` leaves, in the order of [`super::chain`].
    pub(super) fn ring(&self, h: HalfedgeId, kind: Kind) -> Vec<Mirrored> {
        let topology = self.level.topology();
        let mut halfedges = self.sector(h);
        let vertex = |v: crate::mesh::VertexId| vec![(v.0, 1.0)];
        if kind.is_closed() {
            let own = halfedges.iter().position(|&other| other == h).unwrap_or(0);
            halfedges.rotate_left(own);
        }
        let mut out = vec![vertex(topology.origin(h))];
        for &g in &halfedges {
            out.push(vertex(topology.target(g)));
            out.push(vertex(topology.target(topology.next(g))));
        }
        if let (false, Some(&last)) = (kind.is_closed(), halfedges.last()) {
            out.push(vertex(topology.origin(topology.prev(last))));
        }
        let next = topology.next(h);
        let [first, second, third] =
            [next, topology.next(next), topology.prev(h)].map(|corner| self.outside(corner));
        let [below_first, diagonal_first, _] = first;
        let [below_second, diagonal_second, left_second] = second;
        let [_, diagonal_third, left_third] = third;
        if kind.continues_below() {
            out.push(diagonal_first);
        }
        out.extend([below_first, left_second, diagonal_second, below_second, left_third]);
        if kind.continues_left() {
            out.push(diagonal_third);
        }
        out
    }

    /// The three points around the regular corner that `h` leaves: below, diagonal, left.
    pub(super) fn outside(&self, h: HalfedgeId) -> [Mirrored; 3] {
        let (level, topology) = (self.level, self.level.topology());
        let before = topology.prev(h);
        let own = topology.origin(h).0;
        let right = topology.target(h).0;
        let above = topology.origin(before).0;
        let across = topology.target(topology.next(h)).0;
        let open = |h: HalfedgeId| topology.twin(h).filter(|_| !level.is_sharp(h));
        let vertex = |v: crate::mesh::VertexId| v.0;
        match (open(h), open(before)) {
            (Some(under), Some(beside)) => {
                let down = topology.next(under);
                let below = vertex(topology.target(down));
                let left = vertex(topology.origin(topology.prev(beside)));
                // Where the corner is regular, the quad opposite has both.
                let opposite = topology.twin(down).map_or(own, |h| topology.origin(topology.prev(h)).0);
                [vec![(below, 1.0)], vec![(opposite, 1.0)], vec![(left, 1.0)]]
            }
            (None, Some(beside)) => {
                let left = vertex(topology.origin(topology.prev(beside)));
                let above_left = vertex(topology.target(topology.next(beside)));
                [mirror(own, above), mirror(left, above_left), vec![(left, 1.0)]]
            }
            (Some(under), None) => {
                let below = vertex(topology.target(topology.next(under)));
                let below_right = vertex(topology.origin(topology.prev(under)));
                [vec![(below, 1.0)], mirror(below, below_right), mirror(own, right)]
            }
            (None, None) => {
                let diagonal = vec![(own, 4.0), (right, -2.0), (above, -2.0), (across, 1.0)];
                [mirror(own, above), diagonal, mirror(own, right)]
            }
        }
    }

    /// The 4 x 4 points of a quad with regular corners, `i + 4 j`, where `h` leaves the corner at `(0, 0)`.
    pub(super) fn net(&self, h: HalfedgeId) -> [Mirrored; 16] {
        let topology = self.level.topology();
        let mut net: [Mirrored; 16] = Default::default();
        let mut corner = h;
        for slots in SLOTS {
            let [below, diagonal, left] = self.outside(corner);
            net[slots[0]] = vec![(topology.origin(corner).0, 1.0)];
            net[slots[1 + BELOW]] = below;
            net[slots[1 + DIAGONAL]] = diagonal;
            net[slots[1 + LEFT]] = left;
            corner = topology.next(corner);
        }
        net
    }
}

/// `2 a - b`: what makes the spline reproduce a crease along its edge.
fn mirror(edge: u32, inner: u32) -> Mirrored {
    vec![(edge, 2.0), (inner, -1.0)]
}

/// What the quick way finds around one quad.
#[derive(Clone, Copy, Debug)]
pub(super) enum Plain {
    /// All corners regular: the net, `i + 4 j`.
    Regular([u32; 16]),
    /// One corner of another valence, all three others regular: the last seven points of the ring of that corner.
    OneIrregular { corner: u32, outer: [u32; 7] },
    /// Not for the quick way.
    Other,
}

/// The common case: `h` leaves the corner at `(0, 0)`. The caller knows that no tag touches the quad.
#[inline]
pub(super) fn plain_corners(mesh: &impl Connectivity, h: HalfedgeId) -> Plain {
    let mut net = [0; 16];
    let mut irregular = None;
    let mut corner = h;
    for (r, slots) in SLOTS.iter().enumerate() {
        let (Some(under), Some(beside)) = (mesh.twin(corner), mesh.twin(mesh.prev(corner))) else {
            return Plain::Other;
        };
        let down = mesh.next(under);
        let Some(opposite) = mesh.twin(down) else { return Plain::Other };
        let quads = [under, beside, opposite].iter().all(|&h| mesh.face_size(mesh.face(h)) == 4);
        if !quads {
            return Plain::Other;
        }
        net[slots[0]] = mesh.origin(corner).0;
        net[slots[1 + BELOW]] = mesh.target(down).0;
        net[slots[1 + DIAGONAL]] = mesh.origin(mesh.prev(opposite)).0;
        let left = mesh.prev(beside);
        net[slots[1 + LEFT]] = mesh.origin(left).0;
        // Four quads close the ring here; two do so as well, on the second time round.
        if mesh.twin(left) != Some(mesh.next(opposite)) || mesh.face(opposite) == mesh.face(corner) {
            if irregular.is_some() {
                return Plain::Other;
            }
            irregular = Some(r as u32);
        }
        corner = mesh.next(corner);
    }
    match irregular {
        None => Plain::Regular(net),
        Some(corner) => {
            let [first, second, third] = [1, 2, 3].map(|next| SLOTS[(corner + next) as usize % 4]);
            let outer = [
                first[1 + DIAGONAL],
                first[1 + BELOW],
                second[1 + LEFT],
                second[1 + DIAGONAL],
                second[1 + BELOW],
                third[1 + LEFT],
                third[1 + DIAGONAL],
            ];
            Plain::OneIrregular { corner, outer: outer.map(|slot| net[slot]) }
        }
    }
}

/// Appends the inner points of the ring of the irregular corner that `h` leaves. Gives its valence; or nothing, and
/// appends nothing, if there is a boundary or another polygon.
#[inline]
pub(super) fn plain_ring(mesh: &impl Connectivity, h: HalfedgeId, out: &mut Vec<u32>) -> Option<u32> {
    let start = out.len();
    out.push(mesh.origin(h).0);
    let mut valence = 0;
    let mut g = h;
    loop {
        let across = mesh.next(g);
        let (Some(next), 4) = (mesh.twin(mesh.prev(g)), mesh.face_size(mesh.face(g))) else {
            out.truncate(start);
            return None;
        };
        out.push(mesh.origin(across).0);
        out.push(mesh.target(across).0);
        valence += 1;
        if next == h {
            return Some(valence);
        }
        g = next;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{FaceId, shapes};

    #[test]
    fn the_quick_way_is_the_general_way() {
        let meshes = [
            shapes::torus(7, 5),
            shapes::studded_torus(12, 8, 4),
            shapes::cube(),
            shapes::grid(4, 3),
            shapes::disk(5, 2),
        ];
        let plain = |points: &[Mirrored]| -> Vec<u32> {
            points
                .iter()
                .map(|point| if let [(vertex, 1.0)] = point[..] { vertex } else { u32::MAX })
                .collect()
        };
        let (mut regular, mut irregular, mut other) = (0, 0, 0);
        for mesh in meshes {
            let coarse = Level::new(&mesh).unwrap();
            for level in [coarse.split(), coarse] {
                let (topology, surroundings) = (level.topology(), Surroundings::new(&level));
                for face in (0..topology.face_count() as u32).map(FaceId) {
                    let corners: Vec<HalfedgeId> = topology.halfedges(face).collect();
                    let kinds: Vec<CornerKind> = corners.iter().map(|&h| surroundings.corner(h)).collect();
                    let boundary = corners.iter().any(|&h| topology.is_boundary(topology.origin(h)));
                    match plain_corners(topology, corners[0]) {
                        Plain::Regular(net) => {
                            assert_eq!(kinds, [CornerKind::Regular; 4]);
                            assert_eq!(plain(&surroundings.net(corners[0])), net);
                            regular += 1;
                        }
                        Plain::OneIrregular { corner, outer } => {
                            let h = corners[corner as usize];
                            let mut ring = Vec::new();
                            let valence = plain_ring(topology, h, &mut ring).unwrap();
                            ring.extend(outer);
                            let kind = Kind::Smooth { valence };
                            assert_eq!(kinds[corner as usize], CornerKind::Irregular(kind));
                            assert_eq!(kinds.iter().filter(|&&kind| kind == CornerKind::Regular).count(), 3);
                            assert_eq!(plain(&surroundings.ring(h, kind)), ring);
                            irregular += 1;
                        }
                        Plain::Other => {
                            let several =
                                kinds.iter().filter(|&&kind| kind != CornerKind::Regular).count() > 1;
                            assert!(boundary || several);
                            other += 1;
                        }
                    }
                }
            }
        }
        assert!(regular > 100 && irregular > 100 && other > 10, "{regular} {irregular} {other}");
    }
}
