//! Curves given by points on them: their control points, piece by piece.

use super::incidence::{Incidence, Role};
use super::network::{CurveNetwork, NetworkCurve};
use super::target_curve::TargetCurve;
use crate::math::Vec3;
use crate::mesh::{Topology, VertexId};
use std::borrow::Cow;

/// The network with control points in place of points to go through. At a meeting point a curve ends, so each piece between
/// two of them has natural ends of its own and a knot at each of its points. Points are finite, one per vertex.
pub(super) fn resolved<'a>(
    network: &'a CurveNetwork,
    topology: &Topology,
    incidence: &Incidence,
) -> Cow<'a, CurveNetwork> {
    if network.curves.iter().all(|curve| curve.through.is_none()) {
        return Cow::Borrowed(network);
    }
    let crossing = network.options.crossing;
    let meets = |v: &u32| incidence.role(VertexId(*v), topology, crossing) == Role::Meeting;
    let mut network = network.clone();
    for curve in &mut network.curves {
        if let Some(points) = curve.through.take() {
            let stops = (0..curve.vertices.len()).filter(|&i| meets(&curve.vertices[i])).collect();
            curve.control = Some(control(curve, &points, stops));
        }
    }
    Cow::Owned(network)
}

/// The control points of a curve that is cut at some of its vertices, for points that it goes through.
pub(super) fn control(curve: &NetworkCurve, points: &[Vec3], mut stops: Vec<usize>) -> Vec<Vec3> {
    let count = points.len();
    let solved = |points: &[Vec3], closed: bool| match TargetCurve::through(points, closed) {
        Ok(curve) => curve.control().to_vec(),
        // Finite and enough, as the gate has seen.
        Err(_) => points.to_vec(),
    };
    match (curve.closed, stops.first().copied()) {
        (true, None) => return solved(points, true),
        (true, Some(first)) => stops.push(first + count),
        (false, _) => {
            stops.extend([0, count - 1]);
            stops.sort_unstable();
            stops.dedup();
        }
    }
    let mut control = points.to_vec();
    for stop in stops.windows(2) {
        let piece: Vec<Vec3> = (stop[0]..=stop[1]).map(|i| points[i % count]).collect();
        for (i, point) in (stop[0]..=stop[1]).zip(solved(&piece, false)) {
            control[i % count] = point;
        }
    }
    control
}
