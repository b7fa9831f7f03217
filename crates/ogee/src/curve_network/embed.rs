//! The whole way from a cage and a network to a cage whose surface contains it.

use super::between::faired;
use super::complex::reposition;
use super::defect::{NetworkDefect, NetworkError};
use super::network::{CurveNetwork, Placing, PreSplit};
use super::place::{Placement, Site, place};
use super::plan::{MeetingVertex, NetworkPlan, Segment, SegmentEnd, ring_normal};
use super::repair::{MeetingPorts, Repaired, Ribbons, TaggedPath, repair};
use super::tangent_plane::TangentPlane;
use super::wants::{shape_rows, tell_missed};
use super::warning::NetworkWarning;
use crate::math::Vec3;
use crate::mesh::{ControlMesh, Meeting, Topology, VertexId};

/// How many splits more than needed are tried where there is no room.
const MORE_SPLITS: u32 = 3;

/// A cage with a network in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Embedding {
    /// The cage: split, repaired, with points in their places and the meetings of the network.
    pub mesh: ControlMesh,
    /// The curves, cut at meeting points, with the vertices of this cage that carry them. Equation (1) of the path and its
    /// side vertices gives the target's control points, on every level.
    pub segments: Vec<Segment>,
    /// For each segment and each of its vertices the side vertices on the left and on the right; empty along the border.
    pub sides: Vec<Vec<[u32; 2]>>,
    /// Its meetings, with their rings.
    pub x_configurations: Vec<XConfiguration>,
    /// How often the cage that was given was split.
    pub splits: u32,
    /// How many vertices repair put beside the curves.
    pub inserted_vertices: usize,
    /// What is not as it was hoped for.
    pub warnings: Vec<NetworkWarning>,
}

/// An X-configuration in a cage.
#[derive(Clone, Debug, PartialEq)]
pub struct XConfiguration {
    /// The vertex in the middle.
    pub center: u32,
    /// Its neighbours counter-clockwise: ports at even places, free spokes at odd ones.
    pub ring: Vec<u32>,
    /// The parameter `t` of its rules.
    pub parameter: f64,
}

impl XConfiguration {
    fn meeting(&self) -> Meeting {
        let ports = self.ring.iter().copied().step_by(2).collect();
        Meeting { vertex: self.center, ports, t: self.parameter }
    }
}

/// Prepares a cage so that its surface contains the curves of a network (Abbas and Nasri 2004, and their generalised scheme):
/// split, repair, place X-configurations, move paths.
///
/// # Errors
/// If the network has any defect, or there is no room for it.
pub fn embed(network: &CurveNetwork, mesh: &ControlMesh) -> Result<Embedding, NetworkError> {
    let mut plan = NetworkPlan::new(network, mesh)?;
    let most = match network.options.pre_split {
        PreSplit::Auto => plan.pre_split + MORE_SPLITS,
        PreSplit::Fixed(splits) => splits,
    };
    loop {
        let result = embed_split(network, &plan, mesh);
        let crowded = match &result {
            Ok((embedding, crowded)) => {
                *crowded || embedding.warnings.iter().any(|warning| warning.code() == "W_X_OVERLAP")
            }
            Err(error) => error.code() == "E_REPAIR",
        };
        if !crowded || plan.pre_split >= most {
            return result.map(|(embedding, _)| embedding);
        }
        plan.pre_split += 1;
    }
}

/// The same with the plan's number of splits; and whether something that is wanted along a curve has no room.
fn embed_split(
    network: &CurveNetwork,
    plan: &NetworkPlan,
    mesh: &ControlMesh,
) -> Result<(Embedding, bool), NetworkError> {
    let (cage, mut split) = plan.split(mesh)?;
    let topology = Topology::new(&cage).map_err(|error| NetworkError {
        defects: error.defects.into_iter().map(NetworkDefect::Mesh).collect(),
    })?;
    let paths: Vec<TaggedPath> = split.segments.iter().map(path).collect();
    // Before repair and after it a point has one normal: a sector that gets a dummy port keeps it.
    let normals: Vec<Vec3> =
        split.meetings.iter().map(|meeting| ring_normal(&topology, &cage.points, meeting.vertex)).collect();
    let mut warnings = plan.warnings.clone();
    warnings.extend(split.turn_legs(network, &normals));
    let sites: Vec<Site> = split
        .meetings
        .iter()
        .zip(normals)
        .map(|(meeting, normal)| split.site(network, meeting, normal))
        .collect();
    let ports: Vec<MeetingPorts> =
        split.meetings.iter().zip(&sites).map(|(meeting, site)| dummy_ports(&split, meeting, site)).collect();
    let ribbons = Ribbons { forced: network.options.force_ribbons, width: network.options.ribbon_width };
    let Repaired { mesh: mut room, sides, rings, overlaps, changed, .. } =
        repair(&cage, &paths, &ports, &split.smooth_crossings, ribbons)?;
    if let (false, Some(&vertex)) = (network.options.repair, changed.first()) {
        let at = split.segments.iter().find(|segment| segment.vertices.contains(&vertex));
        let curve = at.map_or_else(String::new, |segment| network.curves[segment.curve].name.clone());
        return Err(NetworkError { defects: vec![NetworkDefect::PathValence { curve, vertex }] });
    }
    let topology = Topology::new(&room).map_err(|error| NetworkError {
        defects: error.defects.into_iter().map(NetworkDefect::Mesh).collect(),
    })?;
    if let (true, Some(&vertex)) = (cage.uv.is_some() && room.uv.is_none(), changed.first()) {
        warnings.push(NetworkWarning::UvDropped { vertex });
    }
    warnings.extend(overlaps.into_iter().map(|vertex| NetworkWarning::XOverlap { vertex }));
    let mut x_configurations = Vec::new();
    for ((meeting, site), mut ring) in split.meetings.iter().zip(&sites).zip(rings) {
        // The first port is that of the first curve, as in the site.
        let first = ring.iter().position(|&spoke| spoke == neighbour(&split, meeting.arrivals[0]));
        ring.rotate_left(first.unwrap_or(0));
        let at = room.points[meeting.vertex as usize];
        // After repair: its new vertices are where there is room.
        let spokes = ring.iter().map(|&spoke| room.points[spoke as usize] - at).collect();
        let site = Site { spokes, ..site.clone() };
        let fits = |placement: &Placement| placement.ring.ring.len() == ring.len();
        let placement = place(&site).filter(fits).ok_or_else(|| NetworkError {
            defects: vec![NetworkDefect::Repair { vertex: meeting.vertex }],
        })?;
        let (segment, end) = meeting.arrivals[0];
        room.points[meeting.vertex as usize] = end_point(&split.segments[segment], end);
        if site.options.placing != Some(Placing::Keep) {
            put(&mut room.points, &topology, meeting.vertex, &ring, &placement);
        }
        let center = meeting.vertex;
        x_configurations.push(XConfiguration { center, ring, parameter: placement.parameter });
        warnings.extend(placement.warnings);
    }
    move_border(&mut room.points, &split);
    let decided = x_vertices(&topology, &x_configurations);
    let missed = shape_rows(&mut room.points, network, &split, &sides, &decided, &mut warnings);
    move_paths(&mut room.points, &split, &sides);
    room.meetings = x_configurations.iter().map(XConfiguration::meeting).collect();
    if network.options.fair {
        let points = faired(&room, network, &split, &sides, &decided, &mut warnings)?;
        room.points = points;
        // Rows are met to rounding; the curves are exact.
        move_paths(&mut room.points, &split, &sides);
    }
    warnings.extend(tell_missed(&missed, network, &split.segments, &room));
    let crowded = missed.iter().any(|missed| missed.crowded);
    let (segments, splits) = (split.segments, plan.pre_split);
    let inserted_vertices = room.points.len() - cage.points.len();
    let embedding =
        Embedding { mesh: room, segments, sides, x_configurations, splits, inserted_vertices, warnings };
    Ok((embedding, crowded))
}

fn path(segment: &Segment) -> TaggedPath {
    TaggedPath { vertices: segment.vertices.clone(), closed: segment.target.is_closed() }
}

fn end_point(segment: &Segment, end: SegmentEnd) -> Vec3 {
    let control = segment.target.control();
    match end {
        SegmentEnd::Start => control[0],
        SegmentEnd::End => control[control.len() - 1],
    }
}

/// The dummy ports that a meeting point needs, by the neighbours its curves leave to.
fn dummy_ports(plan: &NetworkPlan, meeting: &MeetingVertex, site: &Site) -> MeetingPorts {
    let tangents: Vec<Vec3> = site.arrivals.iter().map(|arrival| arrival.tangent).collect();
    let plane = TangentPlane::new(&tangents, site.ring_normal, site.options.normal);
    let counts = plane.map(|plane| plane.dummies()).unwrap_or_default();
    let neighbours = meeting.arrivals.iter().map(|&arrival| neighbour(plan, arrival));
    MeetingPorts { vertex: meeting.vertex, dummies: neighbours.zip(counts).collect() }
}

/// The vertex that a segment leaves an end to.
fn neighbour(plan: &NetworkPlan, (segment, end): (usize, SegmentEnd)) -> u32 {
    let path = &plan.segments[segment].vertices;
    match end {
        SegmentEnd::Start => path[1],
        SegmentEnd::End => path[path.len() - 2],
    }
}

/// The vertices of all X-configurations: centres, rings and corners. One that two of them share is there twice.
fn x_vertices(topology: &Topology, x_configurations: &[XConfiguration]) -> Vec<u32> {
    let around = |x: &XConfiguration| {
        let slices = topology.ring(VertexId(x.center));
        let corners = slices.map(|h| topology.target(topology.next(h)).0);
        [x.center].into_iter().chain(x.ring.iter().copied()).chain(corners).collect::<Vec<u32>>()
    };
    x_configurations.iter().flat_map(around).collect()
}

/// Puts free spokes, corners and dummy ports of an X-configuration in their places, and ports for a start.
fn put(points: &mut [Vec3], topology: &Topology, center: u32, ring: &[u32], placement: &Placement) {
    let at = points[center as usize];
    for (&spoke, &offset) in ring.iter().zip(&placement.ring.ring) {
        points[spoke as usize] = at + offset;
    }
    for h in topology.ring(VertexId(center)) {
        let corner = topology.target(topology.next(h));
        if let Some(i) = ring.iter().position(|&spoke| spoke == topology.target(h).0) {
            points[corner.index()] = at + placement.ring.corners[i];
        }
    }
}

/// Puts the vertices of curves along the border on their control points.
fn move_border(points: &mut [Vec3], plan: &NetworkPlan) {
    for segment in plan.segments.iter().filter(|segment| segment.along_border) {
        for (&v, &point) in segment.vertices.iter().zip(segment.target.control()) {
            points[v as usize] = point;
        }
    }
}

/// Gives every path inside its curve, where two of them cross last.
fn move_paths(points: &mut [Vec3], plan: &NetworkPlan, sides: &[Vec<[u32; 2]>]) {
    for crossings in [false, true] {
        for (segment, sides) in plan.segments.iter().zip(sides).filter(|(segment, _)| !segment.along_border) {
            let last = segment.vertices.len() - 1;
            let control = segment.target.control();
            for (i, (&v, &[left, right])) in segment.vertices.iter().zip(sides).enumerate() {
                let at_meeting = (i == 0 && segment.meets[0]) || (i == last && segment.meets[1]);
                let crosses = plan.smooth_crossings.binary_search(&v).is_ok();
                if !at_meeting && crosses == crossings {
                    points[v as usize] =
                        reposition(control[i], points[left as usize], points[right as usize]);
                }
            }
        }
    }
}
