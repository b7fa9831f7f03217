//! `Model`: the bodies of a file, from solids down to vertices.

use std::collections::HashMap;

use ogee::Vec3;

use super::document::{Document, Instance, Value};
use super::entities::SOLIDS;
use super::splines::Splines;
use super::{Counts, Faults};

/// An edge.
pub(super) struct Edge {
    pub(super) id: u64,
    pub(super) line: usize,
    /// The numbers of its vertices, first and last.
    pub(super) vertices: [u64; 2],
    /// Where they stand; `None` for foreign kinds of points.
    pub(super) places: [Option<Vec3>; 2],
    /// The number of its curve in space.
    pub(super) curve: u64,
    /// True if the curve is a straight line.
    pub(super) straight: bool,
    /// True if the edge runs along its curve.
    pub(super) same_sense: bool,
}

/// A use of an edge by a loop.
#[derive(Clone, Copy)]
pub(super) struct Use {
    pub(super) edge: usize,
    pub(super) forward: bool,
}

/// A loop of edges in the direction in which it bounds its face.
pub(super) struct Bound {
    pub(super) id: u64,
    pub(super) line: usize,
    pub(super) outer: bool,
    pub(super) uses: Vec<Use>,
}

/// A face.
pub(super) struct Face {
    pub(super) id: u64,
    pub(super) line: usize,
    /// The number of its surface.
    pub(super) surface: u64,
    /// The normal of the surface, if that is a plane.
    pub(super) plane: Option<Vec3>,
    /// True if its normal is that of the surface.
    pub(super) same_sense: bool,
    pub(super) bounds: Vec<Bound>,
}

/// A shell.
pub(super) struct Shell {
    pub(super) id: u64,
    pub(super) line: usize,
    pub(super) closed: bool,
    /// False if it holds something that was not understood.
    pub(super) complete: bool,
    pub(super) faces: Vec<Face>,
}

/// A solid: its shells by their place in the model, and whether they are turned.
pub(super) struct Solid {
    pub(super) id: u64,
    pub(super) line: usize,
    pub(super) outer: Option<(usize, bool)>,
    pub(super) voids: Vec<(usize, bool)>,
}

/// The bodies of a file.
#[derive(Default)]
pub(super) struct Model {
    pub(super) edges: Vec<Edge>,
    pub(super) shells: Vec<Shell>,
    pub(super) solids: Vec<Solid>,
}

impl Model {
    pub(super) fn counts(&self, document: &Document<'_>) -> Counts {
        Counts {
            entities: document.instances.len(),
            solids: self.solids.len(),
            shells: self.shells.len(),
            faces: self.shells.iter().map(|shell| shell.faces.len()).sum(),
            edges: self.edges.len(),
            vertices: document.instances.iter().filter(|one| one.record("VERTEX_POINT").is_some()).count(),
        }
    }
}

/// Reads the bodies. Dangling references have been reported before; references to entities of the wrong kind
/// are reported here.
pub(super) fn read(document: &Document<'_>, splines: &Splines, faults: &mut Faults) -> Model {
    let mut reader = Reader { document, splines, faults };
    let mut model = Model::default();
    let mut edges = HashMap::new();
    for instance in &document.instances {
        if instance.record("EDGE_CURVE").is_some() {
            if let Some(edge) = reader.edge(instance) {
                edges.insert(instance.id, model.edges.len());
                model.edges.push(edge);
            }
        }
    }
    let mut shells = HashMap::new();
    for instance in &document.instances {
        let closed = instance.record("CLOSED_SHELL").is_some();
        if closed || instance.record("OPEN_SHELL").is_some() {
            shells.insert(instance.id, model.shells.len());
            model.shells.push(reader.shell(instance, closed, &edges));
        }
    }
    for instance in &document.instances {
        if SOLIDS.iter().any(|name| instance.record(name).is_some()) {
            model.solids.push(reader.solid(instance, &shells));
        }
    }
    model
}

struct Reader<'r, 'a> {
    document: &'r Document<'a>,
    splines: &'r Splines,
    faults: &'r mut Faults,
}

impl<'r, 'a> Reader<'r, 'a> {
    fn bad(&mut self, instance: &Instance<'_>, code: &'static str, message: &str) {
        self.faults.push(instance.fault(code, format!("{}: {message}", instance.name())));
    }

    /// The entity that an argument refers to.
    fn follow(&mut self, from: &Instance<'_>, value: &Value<'_>, what: &str) -> Option<&'r Instance<'a>> {
        match value {
            Value::Reference(id) => self.document.get(*id),
            _ => {
                self.bad(from, "bad_argument", &format!("{what} is a reference"));
                None
            }
        }
    }

    fn logical(&mut self, from: &Instance<'_>, value: &Value<'_>, what: &str) -> Option<bool> {
        match value {
            Value::Enumeration("T") => Some(true),
            Value::Enumeration("F") => Some(false),
            _ => {
                self.bad(from, "bad_argument", &format!("{what} is .T. or .F."));
                None
            }
        }
    }

    fn list<'v>(&mut self, from: &Instance<'_>, value: &'v Value<'a>) -> Option<&'v [Value<'a>]> {
        match value {
            Value::List(items) if !items.is_empty() => Some(items),
            _ => {
                self.bad(from, "bad_argument", "a list that is not empty expected");
                None
            }
        }
    }

    fn edge(&mut self, instance: &Instance<'a>) -> Option<Edge> {
        let record = instance.record("EDGE_CURVE")?;
        let mut vertices = [0; 2];
        let mut places = [None; 2];
        for k in 0..2 {
            let vertex = self.follow(instance, record.get(k + 1), "a vertex")?;
            vertices[k] = vertex.id;
            match vertex.record("VERTEX_POINT") {
                None => self.bad(instance, "wrong_type", &format!("{} is no VERTEX_POINT", vertex.name())),
                Some(vertex) => {
                    if let Value::Reference(point) = vertex.get(1) {
                        places[k] = self.splines.points.get(point).copied();
                    }
                }
            }
        }
        let mut curve = self.follow(instance, record.get(3), "a curve")?;
        // Curves with parameter curves beside them carry the one in space first.
        for name in ["SURFACE_CURVE", "SEAM_CURVE", "INTERSECTION_CURVE"] {
            if let Some(wrapped) = curve.record(name) {
                curve = self.follow(curve, wrapped.get(1), "a curve")?;
                break;
            }
        }
        if ["CARTESIAN_POINT", "VERTEX_POINT", "ADVANCED_FACE"].contains(&curve.name()) {
            self.bad(instance, "wrong_type", &format!("{} is no curve", curve.name()));
        }
        let same_sense = self.logical(instance, record.get(4), "the sense of an edge")?;
        let straight = curve.record("LINE").is_some();
        let (id, line) = (instance.id, instance.line);
        Some(Edge { id, line, vertices, places, curve: curve.id, straight, same_sense })
    }

    fn shell(&mut self, instance: &Instance<'a>, closed: bool, edges: &HashMap<u64, usize>) -> Shell {
        let mut shell =
            Shell { id: instance.id, line: instance.line, closed, complete: true, faces: Vec::new() };
        let record = instance.record(if closed { "CLOSED_SHELL" } else { "OPEN_SHELL" });
        let items = record.and_then(|record| self.list(instance, record.get(1))).unwrap_or_default();
        for item in items {
            let face = self.follow(instance, item, "a face").and_then(|face| {
                let known = ["ADVANCED_FACE", "FACE_SURFACE"].iter().any(|name| face.record(name).is_some());
                if !known && (face.name().starts_with("EDGE_") || face.name().starts_with("B_SPLINE_")) {
                    self.bad(instance, "wrong_type", &format!("{} is no face", face.name()));
                }
                if known { self.face(face, edges) } else { None }
            });
            match face {
                Some(face) => shell.faces.push(face),
                None => shell.complete = false,
            }
        }
        shell
    }

    fn face(&mut self, instance: &Instance<'a>, edges: &HashMap<u64, usize>) -> Option<Face> {
        let record = instance.record("ADVANCED_FACE").or_else(|| instance.record("FACE_SURFACE"))?;
        let surface = self.follow(instance, record.get(2), "a surface")?;
        let plane = surface.record("PLANE").and_then(|plane| self.normal(plane.get(1)));
        let same_sense = self.logical(instance, record.get(3), "the sense of a face")?;
        let mut bounds = Vec::new();
        for bound in self.list(instance, record.get(1))? {
            let bound = self.follow(instance, bound, "a bound")?;
            bounds.push(self.bound(bound, edges)?);
        }
        let (id, line) = (instance.id, instance.line);
        Some(Face { id, line, surface: surface.id, plane, same_sense, bounds })
    }

    /// The normal of a plane from its placement.
    fn normal(&self, placement: &Value<'_>) -> Option<Vec3> {
        let placement = self.document.follow(placement, "AXIS2_PLACEMENT_3D")?;
        if *placement.get(2) == Value::Unset {
            return Some(Vec3::new(0.0, 0.0, 1.0));
        }
        let axis = self.document.follow(placement.get(2), "DIRECTION")?;
        match axis.get(1) {
            Value::List(items) => match items[..] {
                [Value::Real(x), Value::Real(y), Value::Real(z)] => Vec3::new(x, y, z).normalized(),
                _ => None,
            },
            _ => None,
        }
    }

    fn bound(&mut self, instance: &Instance<'a>, edges: &HashMap<u64, usize>) -> Option<Bound> {
        let outer = instance.record("FACE_OUTER_BOUND");
        let Some(record) = outer.or_else(|| instance.record("FACE_BOUND")) else {
            self.bad(instance, "wrong_type", "a FACE_BOUND expected");
            return None;
        };
        let ring = self.follow(instance, record.get(1), "a loop")?;
        let forward = self.logical(instance, record.get(2), "the orientation of a bound")?;
        let (id, line) = (instance.id, instance.line);
        let mut bound = Bound { id, line, outer: outer.is_some(), uses: Vec::new() };
        // A loop of one vertex, or of points, has no edges.
        let Some(edge_loop) = ring.record("EDGE_LOOP") else { return Some(bound) };
        for item in self.list(ring, edge_loop.get(1))? {
            let oriented = self.follow(ring, item, "an oriented edge")?;
            let Some(record) = oriented.record("ORIENTED_EDGE") else {
                self.bad(ring, "wrong_type", &format!("{} is no ORIENTED_EDGE", oriented.name()));
                return None;
            };
            let edge = self.follow(oriented, record.get(3), "an edge")?;
            let sense = self.logical(oriented, record.get(4), "the orientation of an edge")?;
            bound.uses.push(Use { edge: *edges.get(&edge.id)?, forward: sense });
        }
        if !forward {
            bound.uses.reverse();
            bound.uses.iter_mut().for_each(|used| used.forward = !used.forward);
        }
        Some(bound)
    }

    fn solid(&mut self, instance: &Instance<'a>, shells: &HashMap<u64, usize>) -> Solid {
        let mut solid = Solid { id: instance.id, line: instance.line, outer: None, voids: Vec::new() };
        let hollow = instance.record("BREP_WITH_VOIDS");
        let Some(record) = hollow.or_else(|| instance.record("MANIFOLD_SOLID_BREP")) else { return solid };
        // In a complex entity the outer shell may stand in the record above.
        let outer = record.arguments.iter().find(|value| matches!(value, Value::Reference(_)));
        solid.outer = outer.and_then(|outer| self.turned_shell(instance, outer, shells));
        if let Some(Value::List(voids)) = hollow.and_then(|record| record.arguments.last()) {
            for void in voids {
                solid.voids.extend(self.turned_shell(instance, void, shells));
            }
        }
        solid
    }

    fn turned_shell(
        &mut self,
        solid: &Instance<'_>,
        value: &Value<'_>,
        shells: &HashMap<u64, usize>,
    ) -> Option<(usize, bool)> {
        let mut shell = self.follow(solid, value, "a shell")?;
        let mut turned = false;
        if let Some(oriented) = shell.record("ORIENTED_CLOSED_SHELL") {
            turned = !self.logical(shell, oriented.get(3), "the orientation of a shell")?;
            shell = self.follow(shell, oriented.get(2), "a shell")?;
        }
        if shell.record("CLOSED_SHELL").is_none() {
            self.bad(solid, "wrong_type", &format!("{} is no CLOSED_SHELL", shell.name()));
        }
        shells.get(&shell.id).map(|&shell| (shell, turned))
    }
}
