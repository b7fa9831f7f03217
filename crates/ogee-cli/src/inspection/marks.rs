//! The places that a page points at, each with one number in all pictures and tables.

use ogee::Vec3;

use super::figures::{Figures, Radius, WorstPlace};
use super::table::named;
use super::verdict::Verdict;
use super::{number, place};

/// A place, and everything that is remarkable there.
pub(super) struct Mark {
    pub(super) position: Vec3,
    pub(super) remarks: Vec<Remark>,
}

/// Something remarkable.
pub(super) struct Remark {
    /// What it is.
    pub(super) what: &'static str,
    /// Its value, with its unit.
    pub(super) value: String,
    /// Where it is, in terms of the cage.
    pub(super) place: String,
}

/// Marks on a page; more would hide the surface.
const MOST: usize = 12;

/// Of the size: places nearer to each other than this are one.
const NEAR: f64 = 0.02;

/// Places of one kind.
const EACH: usize = 3;

/// The worst places of whatever is not exact, then what is sharpest, where curvature swings, where there is no tangent plane.
pub(super) fn marks(figures: &Figures) -> Vec<Mark> {
    let mut found = Found { marks: Vec::new(), near: NEAR * figures.size };
    let smooth = &figures.continuity.smooth;
    let verdicts = Verdict::on(&figures.continuity, figures.size);
    let metrics = [
        ("gap", &smooth.gap, ""),
        ("angle", &smooth.angle_deg, " deg"),
        ("curvature gap", &smooth.curvature_relative, ""),
        ("kink of lines", &smooth.kink_deg, " deg"),
    ];
    for ((what, metric, unit), _) in
        metrics.into_iter().zip(verdicts).filter(|(_, verdict)| *verdict != Verdict::Exact)
    {
        for WorstPlace { value, at, beside, position } in metric.worst.iter().take(EACH) {
            let place = format!("{}, beside face {}", place(at), beside.face);
            found.add(*position, Remark { what, value: number(*value) + unit, place });
        }
    }
    for point in figures.extraordinary.without_plane.iter().take(EACH) {
        let (what, value) = match point.cause {
            "slow" => ("normals settle slowly", String::new()),
            _ => ("no tangent plane", format!("{} deg apart", number(point.spread_deg))),
        };
        let place = named(&point.place);
        found.add(point.place.position, Remark { what, value, place });
    }
    let radii = &figures.curvature.smallest_radius;
    for (what, radius) in
        [("smallest radius, concave", &radii.concave), ("smallest radius, convex", &radii.convex)]
    {
        if let Some(Radius { radius, at, position }) = radius {
            found.add(*position, Remark { what, value: number(*radius), place: place(at) });
        }
    }
    for point in figures.extraordinary.points.iter().take(EACH).filter(|point| point.swing > 0.0) {
        let (value, place) = (number(point.swing), named(&point.place));
        found.add(point.place.position, Remark { what: "swing of curvature", value, place });
    }
    found.marks
}

struct Found {
    marks: Vec<Mark>,
    near: f64,
}

impl Found {
    fn add(&mut self, position: [f64; 3], remark: Remark) {
        let position = Vec3::from(position);
        let known = self.marks.iter().position(|mark| mark.position.distance(position) <= self.near);
        match known {
            Some(known) => self.marks[known].remarks.push(remark),
            None if self.marks.len() < MOST => self.marks.push(Mark { position, remarks: vec![remark] }),
            None => {}
        }
    }
}
