//! `NetworkPlan`: a network that has been looked at: its curves cut where they meet, and how often the cage must be split.

use super::check::{check_crossings, check_curves, check_together, x_adjacent};
use super::complex::{rim_start, smooth_crossing};
use super::defect::{NetworkDefect, NetworkError};
use super::incidence::{Incidence, Role, spokes};
use super::network::{CurveNetwork, PreSplit};
use super::place::{Arrival, Site};
use super::target_curve::TargetCurve;
use super::through::resolved;
use super::warning::NetworkWarning;
use crate::math::Vec3;
use crate::mesh::{Boundary, ControlMesh, Topology, VertexId};

/// A curve is moved onto the border curve it starts on without a warning below this distance, of the size of the mesh.
const SAME_POINT: f64 = 1e-9;

/// The sine of an angle that is none.
const STRAIGHT: f64 = 1e-9;

/// A piece of a curve between meeting points, or a whole one.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Which curve of the network.
    pub curve: usize,
    /// Which piece of it, from 0.
    pub piece: usize,
    /// The vertices of the cage along it. A closed curve with one meeting point begins and ends with its vertex.
    pub vertices: Vec<u32>,
    /// The curve that the surface is to have, one control point per vertex.
    pub target: TargetCurve,
    /// True if it follows the border: its control points are the border's vertices.
    pub along_border: bool,
    /// Whether it starts and ends at a meeting point.
    pub meets: [bool; 2],
}

/// A vertex where curves meet.
#[derive(Clone, Debug, PartialEq)]
pub struct MeetingVertex {
    /// The vertex of the cage.
    pub vertex: u32,
    /// The segments that end there and with which end, counter-clockwise around the vertex.
    pub arrivals: Vec<(usize, SegmentEnd)>,
}

/// One end of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SegmentEnd {
    /// Where it starts.
    Start,
    /// Where it ends.
    End,
}

/// What is to be done to a cage for its surface to contain a network.
///
/// ```
/// use ogee::curve_network::{CurveNetwork, NetworkCurve, NetworkPlan};
///
/// // Three edges of a cube meet at a corner; each ends at a point of its own.
/// let curve = |name: &str, end| NetworkCurve { name: name.into(), vertices: vec![0, end], ..Default::default() };
/// let network = CurveNetwork { curves: vec![curve("x", 1), curve("y", 2), curve("z", 4)], ..Default::default() };
/// let plan = NetworkPlan::new(&network, &ogee::shapes::cube())?;
/// assert_eq!((plan.segments.len(), plan.meetings.len(), plan.pre_split), (3, 4, 2));
/// # Ok::<(), ogee::curve_network::NetworkError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct NetworkPlan {
    /// The curves, cut at meeting points, in the order of the network.
    pub segments: Vec<Segment>,
    /// The meeting points, by vertex.
    pub meetings: Vec<MeetingVertex>,
    /// Vertices where two curves cross with plain rules.
    pub smooth_crossings: Vec<u32>,
    /// How often the cage is split before the network is laid.
    pub pre_split: u32,
    /// What is not as it was asked for.
    pub warnings: Vec<NetworkWarning>,
}

impl NetworkPlan {
    /// Looks at a network over a cage.
    ///
    /// # Errors
    /// If the cage is no sound mesh, or the network has any defect; then all that can be seen are named.
    pub fn new(network: &CurveNetwork, mesh: &ControlMesh) -> Result<NetworkPlan, NetworkError> {
        let topology = Topology::new(mesh).map_err(|error| NetworkError {
            defects: error.defects.into_iter().map(NetworkDefect::Mesh).collect(),
        })?;
        // Room for new curves would not spare what lies around old ones.
        let already = mesh.meetings.iter().map(|old| NetworkDefect::MeetingAlready { vertex: old.vertex });
        refuse(already.collect())?;
        refuse(check_curves(network, mesh, &topology))?;
        let incidence = Incidence::new(network, &topology);
        let network = &*resolved(network, &topology, &incidence);
        refuse(check_together(network, mesh, &topology, &incidence))?;
        let mut warnings = Vec::new();
        let targets = targets(network, mesh, &topology, &incidence, &mut warnings);
        let segments = cut(network, &topology, &incidence, &targets);
        warnings.extend(border_ends(network, mesh, &topology, &segments));
        let crossing = network.options.crossing;
        let of_role = |role| {
            let vertices = incidence.vertices.keys().copied();
            let (incidence, topology) = (&incidence, &topology);
            vertices.filter(move |&v| incidence.role(v, topology, crossing) == role)
        };
        let smooth_crossings: Vec<u32> = of_role(Role::SmoothCrossing).map(|v| v.0).collect();
        let pre_split = match network.options.pre_split {
            PreSplit::Fixed(splits) => splits,
            PreSplit::Auto => {
                let needed = segments.iter().map(|segment| splits_needed(segment, &smooth_crossings));
                needed.max().unwrap_or(0)
            }
        };
        let adjacent = segments
            .iter()
            .filter(|s| x_adjacent(network.options.pre_split, s.vertices.len() - 1, s.meets))
            .map(|s| NetworkDefect::XAdjacent {
                curve: network.curves[s.curve].name.clone(),
                from: s.vertices[0],
                to: s.vertices[1],
            });
        refuse(adjacent.chain(check_crossings(network, &topology, &incidence, pre_split)).collect())?;
        let meetings: Vec<MeetingVertex> =
            of_role(Role::Meeting).map(|v| meeting(v, &topology, &segments)).collect();
        let meets = |vertex: &u32| meetings.binary_search_by_key(vertex, |meeting| meeting.vertex).is_ok();
        let choices = network.meetings.keys().copied();
        warnings.extend(choices.filter(|v| !meets(v)).map(|vertex| NetworkWarning::NoMeeting { vertex }));
        Ok(NetworkPlan { segments, meetings, smooth_crossings, pre_split, warnings })
    }

    /// A meeting point of this plan, ready to be [placed](super::place()); the normal of the mesh there points to its outer
    /// side and need not be a unit vector.
    pub fn site(&self, network: &CurveNetwork, meeting: &MeetingVertex, ring_normal: Vec3) -> Site {
        let arrivals = meeting.arrivals.iter().map(|&(segment, end)| {
            let segment = &self.segments[segment];
            Arrival { tangent: segment.leg(end), curve: network.curves[segment.curve].name.clone() }
        });
        let mut options = network.meeting(meeting.vertex);
        if options.normal.is_none() {
            options.normal = self.wanted_normal(network, meeting);
        }
        let arrivals = arrivals.collect();
        Site { vertex: meeting.vertex, arrivals, ring_normal, spokes: Vec::new(), options }
    }
}

impl NetworkPlan {
    /// The normal that a curve wants where it ends alone, or goes straight through: there its direction leaves a choice.
    fn wanted_normal(&self, network: &CurveNetwork, meeting: &MeetingVertex) -> Option<Vec3> {
        let legs: Vec<Vec3> = meeting
            .arrivals
            .iter()
            .map(|&(segment, end)| self.segments[segment].leg(end).normalized())
            .collect::<Option<_>>()?;
        let along = *legs.first()?;
        if legs.len() > 2 || legs.iter().any(|leg| leg.cross(along).length() > STRAIGHT) {
            return None;
        }
        let wanted = meeting.arrivals.iter().find_map(|&(segment, _)| {
            let curve = &network.curves[self.segments[segment].curve];
            let at = curve.vertices.iter().position(|&v| v == meeting.vertex)?;
            curve.normals.get(at).copied().flatten()
        })?;
        (wanted - along.dot(wanted) * along).normalized()
    }
}

impl Segment {
    /// The first leg of the control polygon, seen from an end.
    pub fn leg(&self, end: SegmentEnd) -> Vec3 {
        let control = self.target.control();
        let last = control.len() - 1;
        match end {
            SegmentEnd::Start => control[1] - control[0],
            SegmentEnd::End => control[last - 1] - control[last],
        }
    }
}

/// The normal of a mesh at a vertex: that of the polygon of its neighbours (Newell's), twice its area long.
pub fn ring_normal(topology: &Topology, points: &[Vec3], vertex: u32) -> Vec3 {
    let v = VertexId(vertex);
    let spokes: Vec<Vec3> = spokes(topology, v).map(|to| points[to.index()] - points[v.index()]).collect();
    let pairs = spokes.iter().zip(spokes.iter().cycle().skip(1));
    pairs.fold(Vec3::ZERO, |sum, (a, b)| sum + a.cross(*b))
}

fn refuse(defects: Vec<NetworkDefect>) -> Result<(), NetworkError> {
    if defects.is_empty() { Ok(()) } else { Err(NetworkError { defects }) }
}

/// The control points of every curve, with starts on border curves and smooth crossings moved to where they can be.
fn targets(
    network: &CurveNetwork,
    mesh: &ControlMesh,
    topology: &Topology,
    incidence: &Incidence,
    warnings: &mut Vec<NetworkWarning>,
) -> Vec<Vec<Vec3>> {
    let mut targets: Vec<Vec<Vec3>> = network.curves.iter().map(|curve| curve.target(&mesh.points)).collect();
    let around = |targets: &[Vec<Vec3>], curve: usize, position: usize| {
        let control = &targets[curve];
        let count = control.len();
        let closed = network.curves[curve].closed;
        (closed || (position > 0 && position + 1 < count)).then(|| {
            [control[(position + count - 1) % count], control[position], control[(position + 1) % count]]
        })
    };
    for (v, edges) in incidence.vertices.iter().filter(|(v, _)| topology.is_boundary(**v)) {
        let rim = edges.iter().find(|edge| edge.border);
        let start = edges.iter().find(|edge| !edge.border);
        let (Some(rim), Some(start)) = (rim, start) else { continue };
        let point = match around(&targets, rim.curve, rim.position) {
            Some([before, at, after]) => rim_start(before, at, after),
            None => targets[rim.curve][rim.position],
        };
        let distance = targets[start.curve][start.position].distance(point);
        if distance > SAME_POINT * mesh.size() {
            let curve = network.curves[start.curve].name.clone();
            warnings.push(NetworkWarning::RimEndMoved { vertex: v.0, curve, distance });
        }
        targets[start.curve][start.position] = point;
    }
    for (&v, edges) in &incidence.vertices {
        if incidence.role(v, topology, network.options.crossing) != Role::SmoothCrossing {
            continue;
        }
        let of_curve = |curve: usize| edges.iter().find(|edge| edge.curve == curve);
        let places = incidence.crossing_curves(v).map(|curves| curves.map(of_curve));
        let Some([Some(one), Some(other)]) = places else { continue };
        let both = [one, other].map(|edge| around(&targets, edge.curve, edge.position));
        if let [Some(first), Some(second)] = both {
            let moved = smooth_crossing(first, second);
            targets[one.curve][one.position] = moved[0];
            targets[other.curve][other.position] = moved[1];
        }
    }
    targets
}

/// Ends of curves along the border where the border goes on: the vertex has two faces or more and is not sharp.
fn border_ends(
    network: &CurveNetwork,
    mesh: &ControlMesh,
    topology: &Topology,
    segments: &[Segment],
) -> Vec<NetworkWarning> {
    let sharp = |v: u32| mesh.corners.iter().any(|c| c.vertex == v && c.sharpness.value() == f64::INFINITY);
    let one_face_is_sharp = mesh.scheme.boundary == Boundary::EdgeAndCorner;
    let goes_on = |v: &u32| {
        let one_face = topology.ring(VertexId(*v)).count() == 1;
        !(sharp(*v) || one_face && one_face_is_sharp)
    };
    let on_border = segments.iter().filter(|segment| segment.along_border && !segment.target.is_closed());
    on_border
        .flat_map(|segment| {
            let path = &segment.vertices;
            let name = &network.curves[segment.curve].name;
            [path[0], path[path.len() - 1]]
                .into_iter()
                .filter(goes_on)
                .map(|vertex| NetworkWarning::BorderEnd { vertex, curve: name.clone() })
        })
        .collect()
}

/// Cuts every curve at its meeting points.
fn cut(
    network: &CurveNetwork,
    topology: &Topology,
    incidence: &Incidence,
    targets: &[Vec<Vec3>],
) -> Vec<Segment> {
    let mut segments = Vec::new();
    for (number, (curve, target)) in network.curves.iter().zip(targets).enumerate() {
        // Points are finite and enough: the network has been checked.
        let Ok(target) = TargetCurve::new(target.clone(), curve.closed) else { continue };
        let count = curve.vertices.len();
        let meets = |i: usize| {
            let v = VertexId(curve.vertices[i % count]);
            incidence.role(v, topology, network.options.crossing) == Role::Meeting
        };
        let mut stops: Vec<usize> = (0..count).filter(|&i| meets(i)).collect();
        if !curve.closed {
            stops.extend([0, count - 1]);
            stops.sort_unstable();
            stops.dedup();
        } else if let Some(&first) = stops.first() {
            stops.push(first + count);
        }
        let along_border =
            incidence.at(VertexId(curve.vertices[0])).iter().any(|edge| edge.curve == number && edge.border);
        let segment = |piece: usize, from: usize, target: TargetCurve, meets: [bool; 2]| Segment {
            curve: number,
            piece,
            vertices: (0..target.control().len()).map(|k| curve.vertices[(from + k) % count]).collect(),
            target,
            along_border,
            meets,
        };
        if stops.is_empty() {
            segments.push(segment(0, 0, target, [false; 2]));
            continue;
        }
        segments.extend(stops.windows(2).enumerate().map(|(piece, stop)| {
            segment(piece, stop[0], target.cut(stop[0], stop[1] - stop[0]), [meets(stop[0]), meets(stop[1])])
        }));
    }
    segments
}

/// The least number of splits after which what surrounds meeting points and smooth crossings does not touch.
fn splits_needed(segment: &Segment, smooth_crossings: &[u32]) -> u32 {
    let mut needed = 0;
    let last = segment.vertices.len() - 1;
    let crosses = |i: usize| smooth_crossings.binary_search(&segment.vertices[i]).is_ok();
    let is_stop = |i: &usize| !segment.target.is_closed() && (*i == 0 || *i == last) || crosses(*i);
    let stops: Vec<usize> = (0..=last).filter(is_stop).collect();
    let mut gaps: Vec<[usize; 2]> = stops.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    if let (true, [first, .., end]) = (segment.target.is_closed(), &stops[..]) {
        gaps.push([*end, first + last + 1]);
    }
    for [from, to] in gaps {
        let meets = [from == 0 && segment.meets[0], to == last && segment.meets[1]];
        let special = |i: usize, meets: bool| meets || crosses(i % (last + 1));
        let edges = match (meets, special(from, meets[0]) && special(to, meets[1])) {
            ([true, true], _) => 3,
            ([true, false] | [false, true], _) | (_, true) => 2,
            _ => 1,
        };
        while ((to - from) << needed) < edges {
            needed += 1;
        }
    }
    needed
}

/// The ends of segments at a meeting point, in the order of its edges.
fn meeting(v: VertexId, topology: &Topology, segments: &[Segment]) -> MeetingVertex {
    let ends: Vec<(u32, usize, SegmentEnd)> = segments
        .iter()
        .enumerate()
        .filter(|(_, segment)| !segment.target.is_closed())
        .flat_map(|(number, segment)| {
            let last = segment.vertices.len() - 1;
            let path = &segment.vertices;
            let start = (path[0] == v.0).then(|| (path[1], number, SegmentEnd::Start));
            let end = (path[last] == v.0).then(|| (path[last - 1], number, SegmentEnd::End));
            start.into_iter().chain(end)
        })
        .collect();
    let arrivals = spokes(topology, v)
        .filter_map(|to| ends.iter().find(|end| end.0 == to.0).map(|&(_, segment, end)| (segment, end)))
        .collect();
    MeetingVertex { vertex: v.0, arrivals }
}
