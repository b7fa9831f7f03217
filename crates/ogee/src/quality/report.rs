//! `Report`: everything that is measured on a surface, in one value.

use super::continuity::Gauge;
use super::{Continuity, CurvatureStatistics, Extraordinary, Field, Surface, bounding_box};
use crate::math::Vec3;

/// What a report is made with.
#[derive(Clone, Debug)]
pub struct ReportOptions {
    /// The level lines of this field are those whose kinks are measured.
    pub field: Field,
    /// How many of the worst places of each number are listed.
    pub worst: usize,
    /// How many extraordinary points are examined at most, from the first face on.
    pub points: usize,
    /// Joints whose faces bend by this or more somewhere, in degrees, count as creases. For patches, which do not know
    /// their creases; a fault as large as that is then listed among them. `None` leaves it to the layout.
    pub crease_angle: Option<f64>,
}

/// Figures on the quality of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The corners of its box, by samples.
    pub bounding_box: [Vec3; 2],
    /// How many squares of parameters it has.
    pub squares: usize,
    /// How well faces meet.
    pub continuity: Continuity,
    /// Curvature over all of it.
    pub curvature: CurvatureStatistics,
    /// Curvature near extraordinary points.
    pub extraordinary: Extraordinary,
}

impl ReportOptions {
    /// Ten worst places and ten thousand extraordinary points; creases are those of the layout.
    pub fn new(field: Field) -> ReportOptions {
        ReportOptions { field, worst: 10, points: 10_000, crease_angle: None }
    }
}

impl Report {
    /// Measures a surface; `None` if it has no face or its points are not finite.
    ///
    /// Costs some 40 microseconds a face and 2 milliseconds an extraordinary point on two cores; runs on all there are.
    pub fn new(surface: &dyn Surface, options: &ReportOptions) -> Option<Report> {
        let bounding_box = bounding_box(surface)?;
        let diagonal = bounding_box[1].distance(bounding_box[0]);
        // A surface that is one point has no size to be measured by.
        let size = if diagonal > 0.0 { diagonal } else { 1.0 };
        let ReportOptions { field, worst, points, crease_angle } = options;
        let gauge = Gauge { field, size, crease_angle: *crease_angle, worst: *worst };
        let (continuity, is_sharp) = Continuity::new(surface, &gauge);
        Some(Report {
            bounding_box,
            squares: surface.layout().squares().len(),
            continuity,
            curvature: CurvatureStatistics::new(surface, size),
            extraordinary: Extraordinary::new(surface, &is_sharp, size, *points),
        })
    }

    /// True if every side has a neighbour.
    pub fn is_closed(&self) -> bool {
        self.continuity.border == 0
    }

    /// The diagonal of the box.
    pub fn size(&self) -> f64 {
        self.bounding_box[1].distance(self.bounding_box[0])
    }
}
