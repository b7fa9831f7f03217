//! First legs turned at meeting points: opposite to one another (`straighten`), then into one plane (`flatten`). Both
//! change the curves that were asked for, so every turn is told.

use super::network::CurveNetwork;
use super::plan::{MeetingVertex, NetworkPlan, Segment, SegmentEnd};
use super::tangent_plane::{TangentPlane, kink, straighten};
use super::target_curve::TargetCurve;
use super::warning::NetworkWarning;
use crate::math::Vec3;

/// Turns below this are rounding, in degrees.
const ROUNDING: f64 = 1e-6;

impl NetworkPlan {
    /// Turns first legs where that is wanted; `ring_normals` are those of the mesh at the meeting points. For a plan that
    /// needs no more splits: a segment with meeting points at both ends has three legs, so that either end has a second
    /// control point of its own.
    pub(super) fn turn_legs(&mut self, network: &CurveNetwork, ring_normals: &[Vec3]) -> Vec<NetworkWarning> {
        let mut warnings = Vec::new();
        for (meeting, &ring_normal) in self.meetings.clone().iter().zip(ring_normals) {
            let options = network.meeting(meeting.vertex);
            if options.straighten == Some(true) {
                self.straighten(network, meeting, &mut warnings);
            }
            if options.flatten == Some(true) {
                self.flatten(network, meeting, ring_normal, &mut warnings);
            }
        }
        warnings
    }

    /// Takes the kinks of curves that go through a meeting point away.
    fn straighten(
        &mut self,
        network: &CurveNetwork,
        meeting: &MeetingVertex,
        warnings: &mut Vec<NetworkWarning>,
    ) {
        let curve_of = |plan: &NetworkPlan, i: usize| plan.segments[meeting.arrivals[i].0].curve;
        for i in 0..meeting.arrivals.len() {
            let later = i + 1..meeting.arrivals.len();
            let Some(j) = later.into_iter().find(|&j| curve_of(self, j) == curve_of(self, i)) else {
                continue;
            };
            let legs = [i, j].map(|k| self.leg(meeting.arrivals[k]));
            let (Some(angle_deg), Some(turned)) = (kink(legs[0], legs[1]), straighten(legs[0], legs[1]))
            else {
                continue;
            };
            if angle_deg > ROUNDING {
                for (k, leg) in [i, j].into_iter().zip(turned) {
                    self.set_leg(meeting.arrivals[k], leg);
                }
                let curve = network.curves[curve_of(self, i)].name.clone();
                warnings.push(NetworkWarning::Straightened { vertex: meeting.vertex, curve, angle_deg });
            }
        }
    }

    /// Turns all legs at a meeting point into the plane of its tangents, or across the normal that was given.
    fn flatten(
        &mut self,
        network: &CurveNetwork,
        meeting: &MeetingVertex,
        ring_normal: Vec3,
        warnings: &mut Vec<NetworkWarning>,
    ) {
        let legs: Vec<Vec3> = meeting.arrivals.iter().map(|&arrival| self.leg(arrival)).collect();
        let wanted = network.meeting(meeting.vertex).normal;
        let Some(plane) = TangentPlane::new(&legs, ring_normal, wanted) else { return };
        for (&arrival, &leg) in meeting.arrivals.iter().zip(&legs) {
            let Some((flat, angle_deg)) = plane.flatten(leg).filter(|flat| flat.1 > ROUNDING) else {
                continue;
            };
            self.set_leg(arrival, flat);
            let curve = network.curves[self.segments[arrival.0].curve].name.clone();
            warnings.push(NetworkWarning::Flattened { vertex: meeting.vertex, curve, angle_deg });
        }
    }

    fn leg(&self, (segment, end): (usize, SegmentEnd)) -> Vec3 {
        self.segments[segment].leg(end)
    }

    fn set_leg(&mut self, (segment, end): (usize, SegmentEnd), leg: Vec3) {
        let Segment { target, .. } = &mut self.segments[segment];
        let mut control = target.control().to_vec();
        let last = control.len() - 1;
        match end {
            SegmentEnd::Start => control[1] = control[0] + leg,
            SegmentEnd::End => control[last - 1] = control[last] + leg,
        }
        // As many finite points as before.
        if let Ok(turned) = TargetCurve::new(control, target.is_closed()) {
            *target = turned;
        }
    }
}
