//! What stands around a quad: whether its corners are regular, and the points just outside.
//!
//! This is the general case, with tags, boundaries and polygons; [`super::plain`] is the common one.

use super::kind::Kind;
use crate::curve_network::rule::Slice;
use crate::mesh::HalfedgeId;
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
        if level.has_slices() {
            match self.meeting(h) {
                Some(Some(kind)) => return CornerKind::Irregular(kind),
                Some(None) => return CornerKind::Unsettled,
                None => {}
            }
        }
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
            (0, false) if faces == 2 => Kind::lens(level.scheme().lens, None),
            (0, false) => Kind::Smooth { valence: faces },
            (0, true) => Kind::Cone { valence: faces },
            // The crease that ends here, counted from this quad's own edge.
            (1, false) if faces == 2 => Kind::lens(level.scheme().lens, Some((faces - position) % faces)),
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

    /// What a meeting of curves makes of the corner: its kind where it is the meeting, nothing settled beside another's quads,
    /// and `None` where no meeting is near but that of the quad itself.
    fn meeting(&self, h: HalfedgeId) -> Option<Option<Kind>> {
        let (level, topology) = (self.level, self.level.topology());
        let v = topology.origin(h);
        let centre = |h: HalfedgeId| {
            let slice = level.slice(topology.face(h))?;
            Some((topology.origin(slice.halfedge), slice))
        };
        let own = centre(h);
        if let Some((at, Slice { port_first, t, .. })) = own
            && at == v
        {
            let ports = topology.ring(v).count() as u32 / 2;
            return Some(Some(Kind::Meeting { ports, port_first, t: t.to_bits() }));
        }
        let own = own.map(|(at, _)| at);
        let others = topology.ring(v).filter_map(centre).any(|(at, _)| own != Some(at));
        // Points mirrored at a sharp edge would have to be mirrored with the rule.
        let is_sharp = |h| level.is_sharp(h) || level.is_sharp(topology.prev(h));
        (others || own.is_some() && topology.ring(v).any(is_sharp)).then_some(None)
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
