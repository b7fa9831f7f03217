//! The lint: reads a STEP file's text, repairs nothing, and lists what is wrong.
//!
//! CAD kernels mend what they read, so "it loads" proves little: a flipped face or a shell turned inside out
//! comes back as a valid solid. This lint trusts nothing. What it does not know (foreign entities, rational or
//! trimmed surfaces) it passes over.
//!
//! | file | looks at | faults |
//! | --- | --- | --- |
//! | `lexer`, `document` | spelling and sections | `syntax`, `truncated`, `real_without_point`, `bad_real`, `not_step`, `missing_section`, `missing_endsec`, `missing_end`, `duplicate_id` |
//! | `header` | the header | `missing_header_record`, `file_description`, `file_name_arity`, `file_name_argument`, `file_schema`, `unknown_schema` |
//! | `entities` | references and arguments | `dangling_reference`, `wrong_argument_count`, `missing_shape`, `unused_body` |
//! | `units` | contexts | `missing_unit`, `missing_uncertainty`, `bad_uncertainty` |
//! | `splines` | points, curves, surfaces | `bad_argument`, `real_without_point`, `knots_mismatch`, `knots_not_increasing`, `knot_multiplicity` |
//! | `model` | the types along solid, shell, face, loop, edge, vertex | `bad_argument`, `wrong_type` |
//! | `topology` | loops and shells | `open_loop`, `edge_used_once`, `edge_used_too_often`, `edge_same_direction`, `shell_not_connected` |
//! | `edges`, `boundary`, `faces` | geometry | `vertex_off_curve`, `edge_against_curve`, `coincident_edges`, `edge_off_boundary`, `edge_off_surface`, `loop_clockwise`, `inside_out`, `void_inside_out` |

mod boundary;
mod document;
mod edges;
mod entities;
mod faces;
mod header;
mod lexer;
mod model;
mod spline;
mod splines;
mod topology;
mod units;

use document::Document;

/// Something wrong in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// A stable name in snake case.
    pub code: &'static str,
    /// For people.
    pub message: String,
    /// The line, from 1.
    pub line: Option<usize>,
    /// The number of the entity.
    pub id: Option<u64>,
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        if let Some(id) = self.id {
            write!(f, "#{id}: ")?;
        }
        write!(f, "{}", self.message)
    }
}

type Faults = Vec<Fault>;

/// How many there are of what matters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Entities of any kind.
    pub entities: usize,
    /// Solids, with hollows or without.
    pub solids: usize,
    /// Shells, open and closed.
    pub shells: usize,
    /// Faces of shells.
    pub faces: usize,
    /// Edges.
    pub edges: usize,
    /// Vertices.
    pub vertices: usize,
}

/// What the lint found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CheckReport {
    /// Everything wrong, in the order of the passes.
    pub faults: Vec<Fault>,
    /// How many there are of what matters.
    pub counts: Counts,
    /// The first schema that the header names, without its numbers.
    pub schema: Option<String>,
    /// Millimetres in the unit of length.
    pub unit_in_millimetres: Option<f64>,
    /// The uncertainty of lengths, in that unit.
    pub uncertainty: Option<f64>,
    /// Volume of all solids, hollows taken off; `None` unless there are solids and all are of untrimmed
    /// polynomial spline faces.
    pub volume: Option<f64>,
}

impl CheckReport {
    /// True if nothing is wrong.
    pub fn is_clean(&self) -> bool {
        self.faults.is_empty()
    }
}

/// Reads a STEP file's text and lists what is wrong with it. Any bytes may be given.
///
/// Two places are taken for one below a tolerance of 1e-7 of the diagonal of the part, or the uncertainty that
/// the file states, if that is more, but never more than 1e-5 of the diagonal.
///
/// ```
/// let report = ogee_formats::step::check(b"solid cube");
/// assert_eq!(report.faults[0].code, "not_step");
/// ```
pub fn check(text: &[u8]) -> CheckReport {
    let mut faults = Faults::new();
    let document = Document::parse(text, &mut faults);
    let mut report = CheckReport::default();
    if !faults.iter().any(|fault| fault.code == "not_step") {
        report.schema = header::check(&document, &mut faults);
        entities::check(&document, &mut faults);
        let units = units::check(&document, &mut faults);
        report.unit_in_millimetres = units.in_millimetres;
        report.uncertainty = units.uncertainty;
        let splines = splines::read(&document, &mut faults);
        let model = model::read(&document, &splines, &mut faults);
        report.counts = model.counts(&document);
        let free = topology::check(&model, &mut faults);
        let tolerance = faces::tolerance(&model, &splines, units.uncertainty);
        let paths = edges::check(&model, &splines, &free, tolerance, &mut faults);
        report.volume = faces::check(&model, &splines, &paths, tolerance, &mut faults);
    }
    report.faults = faults;
    report
}
