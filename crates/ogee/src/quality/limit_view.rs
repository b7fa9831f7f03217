//! The limit surface of a cage, as instruments look at it.

use super::{Address, Joint, Layout, Side, Square, Surface};
use crate::limit::{Derivatives, Evaluator, LimitSurface, Samples};
use crate::mesh::{FaceId, HalfedgeId, Topology};
use crate::patch::{Location, PatchTable};
use crate::rules::Level;

/// The limit surface of a cage with the layout of its faces, or another surface over the same faces, as
/// [`crate::lens::TreatedSurface`] is.
#[derive(Clone, Debug)]
pub struct LimitView<'a, S = LimitSurface<'a>> {
    surface: &'a S,
    layout: Layout,
}

impl<'a, S: Evaluator> LimitView<'a, S> {
    /// Lays the faces of a level side by side; `surface` is that of a table of the same level. Hidden faces are left
    /// out.
    pub fn new(level: &Level, surface: &'a S) -> LimitView<'a, S> {
        LimitView { surface, layout: layout(level, surface.table()) }
    }

    /// The surface.
    pub fn surface(&self) -> &'a S {
        self.surface
    }
}

impl<S: Evaluator> Surface for LimitView<'_, S> {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn evaluate(&self, at: &[Location], what: Derivatives, out: &mut Samples) {
        self.surface.eval_into(at, what, out);
    }

    fn address(&self, at: Location) -> Address {
        let face = self.surface.table().parametric_face(at.parametric_face());
        let [u, v] = at.parameters();
        Address { face: face.face, corner: face.corner, u, v }
    }
}

/// Corner `k` of a quad that is cut in four, in its parameters.
const QUARTERS: [[f64; 2]; 4] = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];

fn layout(level: &Level, table: &PatchTable) -> Layout {
    let topology = level.topology();
    let cut = !topology.is_quads();
    let mut squares = Vec::new();
    // The first square of every face that is visible.
    let mut firsts = vec![None; topology.face_count()];
    for face in (0..topology.face_count() as u32).map(FaceId).filter(|&face| level.is_visible(face)) {
        firsts[face.index()] = Some(squares.len() as u32);
        let size = topology.face_size(face);
        let corner = |corner| {
            let located = table.locate(face, corner, 0.0, 0.0);
            located.expect("a visible face has its parameters")
        };
        match (size, cut) {
            (4, false) => {
                squares.push(Square::whole(corner(None), [1.0; 2], [true; 4]));
            }
            (4, true) => squares.extend((0..4).map(|k| {
                let [u, v] = QUARTERS[k];
                let edges = [0, 1, 2, 3].map(|side| side == k || side == (k + 3) % 4);
                Square::whole(corner(None).clamped(u, v), [0.5; 2], edges)
            })),
            _ => squares.extend(
                (0..size).map(|k| Square::whole(corner(Some(k)), [1.0; 2], [true, false, false, true])),
            ),
        }
    }
    let sides = Sides { topology, firsts, cut };
    let mut joints = Vec::new();
    for face in (0..topology.face_count() as u32).map(FaceId) {
        if cut && sides.firsts[face.index()].is_some() {
            joints.extend(sides.inside(face));
        }
        for h in topology.halfedges(face) {
            let Some(twin) = topology.twin(h).filter(|twin| h.index() < twin.index()) else { continue };
            let is_sharp = level.edge_sharpness(h) == f64::INFINITY;
            // The first half of one is the second half of the other.
            for (mine, other) in sides.of(h).into_iter().zip(sides.of(twin).into_iter().rev()) {
                if let (Some(mine), Some(other)) = (mine, other) {
                    joints.push(Joint { sides: [mine, other], is_sharp });
                }
            }
        }
    }
    Layout::new(squares, joints)
}

/// Which sides of squares lie where.
struct Sides<'a> {
    topology: &'a Topology,
    firsts: Vec<Option<u32>>,
    cut: bool,
}

impl Sides<'_> {
    /// The sides along a halfedge: one, or one for each half of it.
    fn of(&self, h: HalfedgeId) -> Vec<Option<Side>> {
        let face = self.topology.face(h);
        let Some(first) = self.firsts[face.index()] else { return vec![None; 1 + usize::from(self.cut)] };
        let corner = h.0 - self.topology.first(face).0;
        if !self.cut {
            return vec![Some(Side { square: first, side: corner })];
        }
        let size = self.topology.face_size(face);
        let next = (corner + 1) % size;
        // A corner of another polygon starts at its vertex; a quarter of a quad is not turned.
        let (leaving, arriving) = if size == 4 { (corner, corner) } else { (0, 3) };
        vec![
            Some(Side { square: first + corner, side: leaving }),
            Some(Side { square: first + next, side: arriving }),
        ]
    }

    /// The joints from the middles of a face's edges to its own middle.
    fn inside(&self, face: FaceId) -> impl Iterator<Item = Joint> {
        let size = self.topology.face_size(face);
        let first = self.firsts[face.index()].unwrap_or_default();
        (0..size).map(move |corner| {
            let next = (corner + 1) % size;
            let (mine, other) = if size == 4 { ((corner + 1) % 4, (corner + 3) % 4) } else { (1, 2) };
            let sides =
                [Side { square: first + corner, side: mine }, Side { square: first + next, side: other }];
            Joint { sides, is_sharp: false }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{ControlMesh, FaceList, shapes};
    use crate::{PatchTable, Vec3};

    fn pyramid() -> ControlMesh {
        let points = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut faces = FaceList::new();
        faces.push(&[3, 2, 1, 0]);
        for [a, b] in [[0, 1], [1, 2], [2, 3], [3, 0]] {
            faces.push(&[a, b, 4]);
        }
        ControlMesh::new(points.map(Vec3::from).to_vec(), faces)
    }

    #[test]
    fn sides_of_a_joint_are_one_curve() {
        let mut holed = pyramid();
        holed.holes.push(2);
        for mesh in [shapes::cube(), pyramid(), shapes::grid(3, 2), shapes::torus(5, 4), holed] {
            let level = Level::new(&mesh).unwrap();
            let table = PatchTable::new(&level);
            let surface = LimitSurface::new(&table, &mesh.points);
            let view = LimitView::new(&level, &surface);
            let layout = view.layout();
            for joint in layout.joints() {
                for x in [0.0, 0.25, 0.7, 1.0] {
                    let [first, second] = joint.sides;
                    let a = layout.squares()[first.square as usize].on_side(first.side, x);
                    let b = layout.squares()[second.square as usize].on_side(second.side, 1.0 - x);
                    let gap = surface.eval(a).position.distance(surface.eval(b).position);
                    assert!(gap < 1e-14, "{joint:?} at {x}: {gap}");
                }
            }
            let sides = 2 * layout.joints().len() + layout.border().count();
            assert_eq!(sides, 4 * layout.squares().len());
        }
    }
}
