//! What stands around a quad in the common case: no tags, no lens, no boundary, no other polygons.
//!
//! A second statement of [`super::surroundings`], several times as fast, and for levels that are not made
//! ([`crate::refine::Ahead`]); the test `the_quick_way_is_the_general_way` holds it to the first.

use super::surroundings::{BELOW, DIAGONAL, LEFT, SLOTS};
use crate::mesh::HalfedgeId;
use crate::mesh::connectivity::Connectivity;

/// What the quick way finds around one quad.
#[derive(Clone, Copy, Debug)]
pub(super) enum Plain {
    /// All corners regular: the net, `i + 4 j`.
    Leaf([u32; 16]),
    /// One corner irregular.
    Tail(PlainTail),
    /// Several are, or there is a boundary or another polygon.
    Other,
}

/// A quad of which one corner is irregular, a smooth vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlainTail {
    /// Leaves the irregular corner.
    pub(super) halfedge: HalfedgeId,
    pub(super) corner: u32,
    pub(super) valence: u32,
    /// The last seven points of the ring.
    pub(super) outer: [u32; 7],
}

impl Plain {
    /// What the quad is of which `h` leaves the corner at `(0, 0)`. The caller knows that no tag touches it, and that none of
    /// its corners is a lens.
    #[inline]
    pub(super) fn of(mesh: &impl Connectivity, h: HalfedgeId) -> Plain {
        let mut net = [0; 16];
        let mut irregular = None;
        let mut halfedge = h;
        for (corner, slots) in (0..).zip(&SLOTS) {
            let (Some(under), Some(beside)) = (mesh.twin(halfedge), mesh.twin(mesh.prev(halfedge))) else {
                return Plain::Other;
            };
            let down = mesh.next(under);
            let Some(opposite) = mesh.twin(down) else { return Plain::Other };
            let quads = [under, beside, opposite].iter().all(|&h| mesh.face_size(mesh.face(h)) == 4);
            if !quads {
                return Plain::Other;
            }
            net[slots[0]] = mesh.origin(halfedge).0;
            net[slots[1 + BELOW]] = mesh.target(down).0;
            net[slots[1 + DIAGONAL]] = mesh.origin(mesh.prev(opposite)).0;
            let left = mesh.prev(beside);
            net[slots[1 + LEFT]] = mesh.origin(left).0;
            // Four quads close the ring here; two would as well, but a lens has a rule of its own.
            if mesh.twin(left) != Some(mesh.next(opposite)) {
                if irregular.is_some() {
                    return Plain::Other;
                }
                irregular = Some((corner, halfedge));
            }
            halfedge = mesh.next(halfedge);
        }
        let Some((corner, halfedge)) = irregular else { return Plain::Leaf(net) };
        let Some(valence) = plain_valence(mesh, halfedge) else { return Plain::Other };
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
        Plain::Tail(PlainTail { halfedge, corner, valence, outer: outer.map(|slot| net[slot]) })
    }
}

/// How many quads stand around the corner that `h` leaves; nothing if there is a boundary or another polygon.
#[inline]
fn plain_valence(mesh: &impl Connectivity, h: HalfedgeId) -> Option<u32> {
    let (mut valence, mut g) = (0, h);
    loop {
        g = mesh.twin(mesh.prev(g)).filter(|_| mesh.face_size(mesh.face(g)) == 4)?;
        valence += 1;
        if g == h {
            return Some(valence);
        }
    }
}

impl PlainTail {
    /// Number of points of the ring.
    #[inline]
    pub(super) fn ring_count(&self) -> usize {
        2 * self.valence as usize + 8
    }

    /// The points of the ring, in the order of [`super::chain`].
    #[inline]
    pub(super) fn ring(&self, mesh: &impl Connectivity, out: &mut [u32]) {
        let (around, outer) = out.split_at_mut(self.ring_count() - 7);
        around[0] = mesh.origin(self.halfedge).0;
        let mut g = self.halfedge;
        for pair in around[1..].chunks_exact_mut(2) {
            let across = mesh.next(g);
            pair.copy_from_slice(&[mesh.origin(across).0, mesh.target(across).0]);
            g = mesh.twin(mesh.prev(g)).expect("a plain ring is closed");
        }
        outer.copy_from_slice(&self.outer);
    }
}

#[cfg(test)]
mod tests {
    use super::super::kind::Kind;
    use super::super::surroundings::{CornerKind, Mirrored, Surroundings};
    use super::*;
    use crate::mesh::{FaceId, shapes};
    use crate::rules::Level;

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
                    match Plain::of(topology, corners[0]) {
                        Plain::Leaf(net) => {
                            assert_eq!(kinds, [CornerKind::Regular; 4]);
                            assert_eq!(plain(&surroundings.net(corners[0])), net);
                            regular += 1;
                        }
                        Plain::Tail(tail) => {
                            let h = corners[tail.corner as usize];
                            let kind = Kind::Smooth { valence: tail.valence };
                            let mut ring = vec![0; tail.ring_count()];
                            tail.ring(topology, &mut ring);
                            assert_eq!(tail.halfedge, h);
                            assert_eq!(kinds[tail.corner as usize], CornerKind::Irregular(kind));
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
