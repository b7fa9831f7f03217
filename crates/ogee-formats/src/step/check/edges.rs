//! Edges lie on their curves, from vertex to vertex.

use std::borrow::Cow;

use ogee::Vec3;

use super::model::{Edge, Model};
use super::spline::Curve;
use super::splines::Splines;
use super::{Fault, Faults};

/// The piece of a curve that is an edge, in the direction of the edge.
pub(super) struct Path<'s> {
    pub(super) curve: Cow<'s, Curve>,
    /// The parameters of the curve at the first and the last vertex.
    pub(super) range: [f64; 2],
    /// True if the edge is the whole curve.
    pub(super) whole: bool,
}

impl Path<'_> {
    /// The point at the share `s` of the way, in parameters.
    pub(super) fn at(&self, s: f64) -> Vec3 {
        let [from, to] = self.range;
        self.curve.at(from * (1.0 - s) + to * s)
    }
}

/// Finds every edge on its curve; `None` for curves that are not known. `free` are the edges that each shell
/// uses once: those that lie on one another are reported.
pub(super) fn check<'s>(
    model: &Model,
    splines: &'s Splines,
    free: &[Vec<usize>],
    tolerance: f64,
    faults: &mut Faults,
) -> Vec<Option<Path<'s>>> {
    let paths: Vec<_> = model.edges.iter().map(|edge| path(edge, splines, tolerance, faults)).collect();
    for edges in free {
        coincident(model, &paths, edges, tolerance, faults);
    }
    paths
}

fn path<'s>(edge: &Edge, splines: &'s Splines, tolerance: f64, faults: &mut Faults) -> Option<Path<'s>> {
    let places = [edge.places[0]?, edge.places[1]?];
    if edge.straight {
        let curve = Cow::Owned(Curve::segment(places[0], places[1]));
        return Some(Path { curve, range: [0.0, 1.0], whole: true });
    }
    let curve = splines.curves.get(&edge.curve)?;
    let mut fault = |code, message| {
        faults.push(Fault { code, message, line: Some(edge.line), id: Some(edge.id) });
    };
    let domain = curve.knots.domain();
    let ends = curve.ends();
    let turned = |pair: [f64; 2]| if edge.same_sense { pair } else { [pair[1], pair[0]] };
    let away = |k: usize, other: usize| places[k].distance(ends[other]);
    let (along, against) = (away(0, 0).max(away(1, 1)), away(0, 1).max(away(1, 0)));
    let (wanted, opposite) = if edge.same_sense { (along, against) } else { (against, along) };
    let whole = Path { curve: Cow::Borrowed(curve), range: turned(domain), whole: true };
    if wanted <= tolerance {
        return Some(whole);
    }
    if opposite <= tolerance {
        fault("edge_against_curve", "the edge runs against its curve".to_owned());
        return Some(whole);
    }
    // The vertices may cut a piece out of the curve.
    let found = places.map(|place| curve.closest(place, domain));
    for (k, (_, distance)) in found.into_iter().enumerate() {
        if distance > tolerance {
            let which = ["first", "last"][k];
            let message = format!("the {which} vertex is {distance:.3e} off the curve of the edge");
            fault("vertex_off_curve", message);
        }
    }
    let range = found.map(|(t, _)| t);
    let closed = ends[0].distance(ends[1]) <= tolerance;
    if !closed && (range[1] < range[0]) == edge.same_sense {
        fault("edge_against_curve", "the edge runs against its curve".to_owned());
    }
    // A piece of a closed curve may run over its seam.
    if closed { None } else { Some(Path { range, whole: range == turned(domain), ..whole }) }
}

/// Two free edges of a shell with the same ends and the same middle should have been one.
fn coincident(
    model: &Model,
    paths: &[Option<Path<'_>>],
    free: &[usize],
    tolerance: f64,
    faults: &mut Faults,
) {
    let mut places: Vec<_> = free
        .iter()
        .filter_map(|&edge| {
            let path = paths[edge].as_ref()?;
            Some((edge, [path.at(0.0), path.at(0.5), path.at(1.0)]))
        })
        .collect();
    places.sort_by(|a, b| a.1[1].x.total_cmp(&b.1[1].x));
    for (i, (edge, [start, middle, end])) in places.iter().enumerate() {
        let near = places[i + 1..].iter().take_while(|(_, other)| other[1].x <= middle.x + tolerance);
        for (other, [first, between, last]) in near {
            let close = |a: &Vec3, b: &Vec3| a.distance(*b) <= tolerance;
            let ends_meet =
                (close(start, first) && close(end, last)) || (close(start, last) && close(end, first));
            if close(middle, between) && ends_meet {
                let [one, two] = [&model.edges[*edge], &model.edges[*other]];
                let message = format!("the edge lies on #{}; they should be one, used twice", one.id);
                faults.push(Fault {
                    code: "coincident_edges",
                    message,
                    line: Some(two.line),
                    id: Some(two.id),
                });
            }
        }
    }
}
