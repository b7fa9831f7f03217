//! Who meets whom, from a list of faces: twins, edges, and one halfedge that leaves each vertex.
//!
//! Nothing is sorted or hashed. While twins are sought each vertex has a list of its edges to greater vertices, a few entries
//! long; an edge with a third side is seen there. That the faces of a vertex form a single fan is seen without going round
//! most of them: in each fan a halfedge *leads*, its number is smaller than those of both beside it. Where only one does there
//! is one fan; others are walked.
//!
//! Results do not depend on the number of threads: each array is defined by the faces alone, whoever finds an entry.

use std::ops::Range;

use super::cycles::FaceCycles;
use super::topology::NONE;
use crate::math::{pages, par};

/// Halfedges that one task looks at in one go.
const CHUNK: usize = 1 << 15;

/// The arrays of [`super::Topology`] that say who meets whom.
pub(super) struct Adjacency {
    pub(super) twin: Vec<u32>,
    pub(super) edge: Vec<u32>,
    pub(super) first_side: Vec<u32>,
    pub(super) outgoing: Vec<u32>,
    pub(super) lenses: Vec<u32>,
    /// True if the faces of each vertex form a single fan.
    pub(super) single_fans: bool,
}

impl Adjacency {
    /// Of faces whose corners are less than `vertices`, and different in each face. Nothing if an edge has more than two
    /// sides, or two that run the same way.
    pub(super) fn new(cycles: impl FaceCycles, origin: &[u32], vertices: usize) -> Option<Adjacency> {
        let twin = pair_halfedges(cycles, origin, vertices)?;
        Some(Adjacency::with_twins(cycles, origin, vertices, twin))
    }

    /// Of halfedges whose twins are known.
    pub(super) fn with_twins(
        cycles: impl FaceCycles,
        origin: &[u32],
        vertices: usize,
        twin: Vec<u32>,
    ) -> Adjacency {
        let (edge, first_side) = number_edges(&twin);
        let fans = Fans::new(cycles, origin, &twin, vertices);
        let single_fans = fans.are_single(cycles, &twin);
        Adjacency { twin, edge, first_side, outgoing: fans.outgoing, lenses: fans.lenses, single_fans }
    }
}

/// Finds the twin of every halfedge: the other side of its edge, `NONE` on a boundary.
fn pair_halfedges(cycles: impl FaceCycles, origin: &[u32], vertices: usize) -> Option<Vec<u32>> {
    let first = par::Numbers::new(vertices, NONE);
    let twin = par::Numbers::new(origin.len(), NONE);
    let shares = Share::all(origin.len());
    let sound = par::map(shares.len(), |k| {
        let mut matching = Matching::new(cycles, origin, &first, &twin);
        matching.meet_all(shares[k]) && matching.meet_late()
    });
    sound.into_iter().all(|sound| sound).then(|| twin.into_vec())
}

/// The vertices that one of several tasks sees to, each of which looks at all halfedges. They are stripes of all vertices:
/// so all tasks have as much to do, whatever the order.
#[derive(Clone, Copy)]
struct Share {
    own: u32,
    tasks: u32,
}

impl Share {
    const STRIPES: u32 = 64;
    const WIDTH: u32 = 1024;

    fn all(halfedges: usize) -> Vec<Share> {
        let tasks =
            if halfedges > 2 * CHUNK { par::threads().min(Share::STRIPES as usize) as u32 } else { 1 };
        (0..tasks).map(|own| Share { own, tasks }).collect()
    }

    fn holds(self, vertex: u32) -> bool {
        self.tasks == 1 || (vertex / Share::WIDTH % Share::STRIPES) * self.tasks / Share::STRIPES == self.own
    }

    /// All halfedges. Tasks begin in different places, so as not to write to the same lines of memory at the same time.
    fn ranges(self, halfedges: usize) -> [Range<usize>; 2] {
        let start = halfedges / self.tasks as usize * self.own as usize;
        [start..halfedges, 0..start]
    }
}

/// Pairs the halfedges of a share.
struct Matching<'a, C> {
    cycles: C,
    origin: &'a [u32],
    /// For each vertex the head of the list of its edges to greater ones, `NONE` if it is empty.
    first: &'a par::Numbers,
    twin: &'a par::Numbers,
    /// The entries of all lists.
    entries: Vec<Entry>,
    /// What came too late for a list.
    late: Vec<Side>,
}

/// An edge in the list of its smaller end.
struct Entry {
    greater: u32,
    /// The side that was met first; `NONE` once the other one has been met.
    side: u32,
    next: u32,
}

/// A halfedge behind the ends of its edge, the smaller one first.
type Side = [u32; 3];

impl<'a, C: FaceCycles> Matching<'a, C> {
    /// The longest list. What comes later is sorted, so that a vertex of a hundred thousand faces takes no longer than others.
    const LONGEST: usize = 32;

    fn new(cycles: C, origin: &'a [u32], first: &'a par::Numbers, twin: &'a par::Numbers) -> Self {
        Matching { cycles, origin, first, twin, entries: Vec::new(), late: Vec::new() }
    }

    /// Meets all halfedges whose smaller end is in the share; false if an edge is no manifold one.
    fn meet_all(&mut self, share: Share) -> bool {
        // An edge for two halfedges, and some more for boundaries.
        let edges = self.origin.len() / 2 / share.tasks as usize;
        pages::reserve(&mut self.entries, edges + edges / 8);
        share.ranges(self.origin.len()).into_iter().all(|mut range| {
            range.all(|h| {
                let (a, b) = (self.origin[h], self.origin[self.cycles.next(h as u32) as usize]);
                !share.holds(a.min(b)) || self.meet(h as u32, a, b)
            })
        })
    }

    /// Looks for the other side of `h`, which runs from `a` to `b`, in the list of its smaller end.
    #[inline]
    fn meet(&mut self, h: u32, a: u32, b: u32) -> bool {
        let (smaller, greater) = (a.min(b), a.max(b));
        let head = self.first.get(smaller);
        let (mut next, mut length) = (head, 0);
        while let Some(entry) = self.entries.get_mut(next as usize) {
            if entry.greater == greater {
                let side = std::mem::replace(&mut entry.side, NONE);
                return side != NONE && self.pair(side, h);
            }
            next = entry.next;
            length += 1;
        }
        if length < Self::LONGEST {
            self.first.set(smaller, self.entries.len() as u32);
            self.entries.push(Entry { greater, side: h, next: head });
        } else {
            self.late.push([smaller, greater, h]);
        }
        true
    }

    /// Makes twins of two halfedges; false if they run the same way.
    #[inline]
    fn pair(&self, g: u32, h: u32) -> bool {
        self.twin.set(g, h);
        self.twin.set(h, g);
        self.origin[g as usize] != self.origin[h as usize]
    }

    /// Pairs those that found a list too long; false if an edge is no manifold one.
    fn meet_late(&mut self) -> bool {
        self.late.sort_unstable();
        self.late.chunk_by(|x, y| x[..2] == y[..2]).all(|edge| match *edge {
            [_] => true,
            [[.., g], [.., h]] => self.pair(g, h),
            _ => false,
        })
    }
}

/// Numbers edges in the order of first meeting them along the halfedges: for each halfedge its edge, and for each edge its
/// halfedge with the smaller number.
fn number_edges(twin: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let edge = par::Numbers::new(twin.len(), NONE);
    // A twin with a smaller number was met first; `NONE` is greater than all.
    let is_first = |h: usize| twin[h] as usize > h;
    let chunks = chunks(twin.len());
    let counts = par::map(chunks.len(), |c| chunks[c].clone().filter(|&h| is_first(h)).count());
    let edges = counts.iter().sum();
    let mut first_side = pages::vector(edges);
    first_side.resize(edges, 0);
    let mut rest = first_side.as_mut_slice();
    let mut met = 0;
    let mut tasks = Vec::with_capacity(chunks.len());
    for (chunk, count) in chunks.iter().zip(counts) {
        let (own, others) = rest.split_at_mut(count);
        tasks.push((chunk.clone(), met, own));
        rest = others;
        met += count as u32;
    }
    par::each(tasks, |(chunk, met, sides)| {
        // Without a branch, which the processor could not foresee: what is written for a second side is written over.
        let mut own = 0;
        for h in chunk {
            edge.set(h as u32, met + own as u32);
            if let Some(side) = sides.get_mut(own) {
                *side = h as u32;
            }
            own += usize::from(is_first(h));
        }
    });
    par::map(chunks.len(), |c| {
        for h in chunks[c].clone() {
            edge.set(h as u32, edge.get(twin[h].min(h as u32)));
        }
    });
    (edge.into_vec(), first_side)
}

/// For each vertex the first halfedge that leaves it, `NONE` if it is isolated.
fn first_leaving(origin: &[u32], vertices: usize) -> Vec<u32> {
    let first = par::Numbers::new(vertices, NONE);
    let shares = Share::all(origin.len());
    par::map(shares.len(), |k| {
        for h in shares[k].ranges(origin.len()).into_iter().flatten() {
            let v = origin[h];
            if shares[k].holds(v) {
                first.set(v, first.get(v).min(h as u32));
            }
        }
    });
    first.into_vec()
}

/// For each vertex a halfedge that leaves it, and what is special about vertices.
struct Fans {
    /// On a boundary the halfedge without twin, else the first; `NONE` if isolated.
    outgoing: Vec<u32>,
    /// The interior vertices of two faces, in order.
    lenses: Vec<u32>,
    /// The vertices of halfedges that lead, but not first.
    led_again: Vec<u32>,
    /// True if a vertex is at the end of two stretches of boundary.
    pinched: bool,
}

impl Fans {
    /// Looks at all vertices.
    fn new(cycles: impl FaceCycles, origin: &[u32], twin: &[u32], vertices: usize) -> Fans {
        let around = Around { cycles, twin };
        let mut outgoing = first_leaving(origin, vertices);
        let chunks = chunks(origin.len());
        let found = par::map(chunks.len(), |c| {
            let (mut led_again, mut open, mut lenses) = (Vec::new(), Vec::new(), Vec::new());
            for h in chunks[c].clone() {
                let (v, h) = (origin[h], h as u32);
                let (before, after) = (around.before(h), around.after(h));
                let leads = (h < before) & (h < after);
                let again = leads & (outgoing[v as usize] != h);
                // One test for all that is rare.
                if again | (leads & (before == after)) | (before == NONE) {
                    if again {
                        led_again.push(v);
                    }
                    if before == NONE {
                        open.push(h);
                    } else if before == after {
                        lenses.push(v);
                    }
                }
            }
            (led_again, open, lenses)
        });
        let (mut led_again, mut lenses) = (Vec::new(), Vec::new());
        let mut pinched = false;
        for (more_led_again, open, more_lenses) in found {
            led_again.extend(more_led_again);
            lenses.extend(more_lenses);
            for h in open {
                let held = &mut outgoing[origin[h as usize] as usize];
                pinched |= *held != h && twin[*held as usize] == NONE;
                *held = h;
            }
        }
        lenses.sort_unstable();
        led_again.sort_unstable();
        Fans { outgoing, lenses, led_again, pinched }
    }

    /// True if the faces of each vertex form a single fan.
    fn are_single(&self, cycles: impl FaceCycles, twin: &[u32]) -> bool {
        let around = Around { cycles, twin };
        let groups: Vec<&[u32]> = self.led_again.chunk_by(|v, w| v == w).collect();
        let is_single = |i: usize| {
            let leaders = around.fan(self.outgoing[groups[i][0] as usize]).filter(|&h| around.leads(h));
            leaders.count() == 1 + groups[i].len()
        };
        !self.pinched && par::collect(groups.len(), is_single).into_iter().all(|single| single)
    }
}

/// Halfedges that leave a vertex, seen from one of them.
#[derive(Clone, Copy)]
struct Around<'a, C> {
    cycles: C,
    twin: &'a [u32],
}

impl<'a, C: FaceCycles> Around<'a, C> {
    /// The next one counter-clockwise; `NONE` at the end of an open fan.
    #[inline]
    fn after(self, h: u32) -> u32 {
        self.twin[self.cycles.prev(h) as usize]
    }

    /// The next one clockwise; `NONE` at the beginning of an open fan.
    #[inline]
    fn before(self, h: u32) -> u32 {
        let twin = self.twin[h as usize];
        if twin == NONE { NONE } else { self.cycles.next(twin) }
    }

    /// True if its number is smaller than that of both beside it. One halfedge of a fan leads at least.
    #[inline]
    fn leads(self, h: u32) -> bool {
        h < self.before(h) && h < self.after(h)
    }

    /// From this one on counter-clockwise, once round or to the end.
    fn fan(self, first: u32) -> impl Iterator<Item = u32> {
        std::iter::successors(Some(first), move |&h| {
            Some(self.after(h)).filter(|&after| after != NONE && after != first)
        })
    }
}

/// All halfedges in order.
fn chunks(halfedges: usize) -> Vec<Range<usize>> {
    (0..halfedges.div_ceil(CHUNK)).map(|c| c * CHUNK..halfedges.min((c + 1) * CHUNK)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::cycles::{PolygonCycles, QuadCycles};
    use crate::mesh::plain_adjacency::PlainAdjacency;
    use crate::mesh::{ControlMesh, FaceList, shapes};
    use proptest::collection::vec;
    use proptest::prelude::*;

    /// Holds it to the simple way, by the layout of polygons and, where all are, that of quads.
    fn compare(faces: &FaceList, vertices: usize) {
        let expected = PlainAdjacency::new(faces, vertices);
        let face: Vec<u32> =
            faces.iter().zip(0..).flat_map(|(face, f)| face.iter().map(move |_| f)).collect();
        let cycles = PolygonCycles { starts: faces.starts(), face: &face };
        compare_by(cycles, faces, vertices, expected.as_ref());
        if faces.iter().all(|face| face.len() == 4) {
            compare_by(QuadCycles, faces, vertices, expected.as_ref());
        }
    }

    fn compare_by(
        cycles: impl FaceCycles,
        faces: &FaceList,
        vertices: usize,
        expected: Option<&PlainAdjacency>,
    ) {
        let found = Adjacency::new(cycles, faces.corners(), vertices);
        assert_eq!(found.is_some(), expected.is_some());
        let (Some(found), Some(expected)) = (found, expected) else { return };
        assert_eq!(found.twin, expected.twin);
        assert_eq!(found.edge, expected.edge);
        assert_eq!(found.first_side, expected.first_side);
        assert_eq!(found.outgoing, expected.outgoing);
        assert_eq!(found.single_fans, expected.single_fans);
        // A lens among several fans of a vertex is none, and there the mesh is refused.
        if expected.single_fans {
            assert_eq!(found.lenses, expected.lenses);
        }
    }

    fn shuffled(faces: &FaceList, block: usize) -> FaceList {
        let mut state = 7u64;
        let mut blocks: Vec<Vec<&[u32]>> = Vec::new();
        for (k, face) in faces.iter().enumerate() {
            if k % block == 0 {
                blocks.push(Vec::new());
            }
            blocks.last_mut().unwrap().push(face);
        }
        for k in (1..blocks.len()).rev() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            blocks.swap(k, (state >> 33) as usize % (k + 1));
        }
        let mut list = FaceList::new();
        blocks.into_iter().flatten().for_each(|face| list.push(face));
        list
    }

    #[test]
    fn shapes_in_any_order() {
        let cages: [ControlMesh; 9] = [
            shapes::cube(),
            shapes::grid(5, 4),
            shapes::torus(40, 25),
            shapes::studded_torus(36, 24, 6),
            shapes::body(),
            shapes::lens(),
            shapes::disk(3, 2),
            shapes::disk(300, 2),
            shapes::grid(1, 1),
        ];
        for mesh in cages {
            for block in [1, 7, usize::MAX] {
                compare(&shuffled(&mesh.faces, block), mesh.points.len() + 1);
            }
        }
    }

    /// More edges at a vertex than a list takes: sound, with a third side at one of them, and with a face turned over.
    #[test]
    fn a_vertex_of_many_faces() {
        let disk = shapes::disk(300, 1);
        let vertices = disk.points.len() as u32;
        for f in [0, 40, 299] {
            let mut winged = disk.faces.clone();
            winged.push(&[0, disk.faces.face(f)[1], vertices, vertices + 1]);
            let turned = disk.faces.iter().enumerate().map(|(g, face)| {
                let [a, b, c, d] = face.try_into().unwrap();
                if f == g { [d, c, b, a] } else { [a, b, c, d] }
            });
            compare(&disk.faces, disk.points.len());
            compare(&winged, disk.points.len() + 2);
            compare(&turned.collect(), disk.points.len());
        }
    }

    /// Large enough for several tasks and chunks; isolated vertices, and faces missing here and there.
    #[test]
    #[cfg(feature = "rayon")]
    fn threads_change_nothing() {
        let whole = shapes::studded_torus(180, 150, 9);
        let mut holed = FaceList::new();
        whole.faces.iter().enumerate().filter(|(f, _)| f % 101 > 3).for_each(|(_, face)| holed.push(face));
        let mut doubled = holed.clone();
        doubled.push(holed.face(holed.len() / 2));
        for faces in [&whole.faces, &shuffled(&whole.faces, 1), &holed, &doubled, &shuffled(&doubled, 20)] {
            for threads in [1, 2, 3, 8] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                pool.install(|| compare(faces, whole.points.len() + 3000));
            }
        }
    }

    /// Faces of different corners, else as they come: edges of many sides, flipped faces, vertices of several fans.
    fn soup() -> impl Strategy<Value = FaceList> {
        let face = vec(0u32..9, 3..6).prop_map(|corners| {
            let mut face: Vec<u32> = Vec::new();
            for v in corners {
                if !face.contains(&v) {
                    face.push(v);
                }
            }
            face
        });
        vec(face, 0..9).prop_map(|faces| {
            let mut list = FaceList::new();
            faces.iter().filter(|face| face.len() > 2).for_each(|face| list.push(face));
            list
        })
    }

    /// A sound mesh with vertices made one and faces left out, doubled and turned over.
    fn damaged() -> impl Strategy<Value = FaceList> {
        let base = prop_oneof![
            Just(shapes::grid(4, 3)),
            Just(shapes::torus(4, 3)),
            Just(shapes::disk(5, 2)),
            Just(shapes::lens()),
            Just(shapes::body())
        ];
        let index = any::<prop::sample::Index>;
        (base, vec((0..4u8, index(), index()), 0..4), any::<bool>()).prop_map(|(mesh, damages, mixed)| {
            let mut faces: Vec<Vec<u32>> = mesh.faces.iter().map(<[u32]>::to_vec).collect();
            for (kind, one, other) in damages {
                let f = one.index(faces.len());
                match kind {
                    0 => drop(faces.swap_remove(f)),
                    1 => faces[f].reverse(),
                    2 => faces.push(faces[f].clone()),
                    _ => {
                        let (v, w) = (one.index(mesh.points.len()), other.index(mesh.points.len()));
                        for corner in faces.iter_mut().flatten().filter(|corner| **corner == v as u32) {
                            *corner = w as u32;
                        }
                        faces.retain(|face| (1..face.len()).all(|k| !face[..k].contains(&face[k])));
                    }
                }
                if faces.is_empty() {
                    break;
                }
            }
            let mut list = FaceList::new();
            for face in &faces {
                if mixed && face[0] % 3 == 0 {
                    list.push(&face[..3]);
                    list.push(&[face[0], face[2], face[3]]);
                } else {
                    list.push(face);
                }
            }
            list
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn soups(faces in soup()) {
            compare(&faces, 10);
        }

        #[test]
        fn damaged_meshes(faces in damaged()) {
            let vertices = faces.corners().iter().max().map_or(0, |&v| v as usize + 1);
            compare(&faces, vertices);
        }
    }
}
