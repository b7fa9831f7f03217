//! `ogee info`: what is in a cage, and everything that decides what can be done with it.

use std::collections::BTreeMap;
use std::process::ExitCode;

use clap::Args;
use ogee::{Boundary, Creasing, Statistics};
use serde::Serialize;

use crate::cage::CageArguments;
use crate::error::{Exit, Failure, Finding};
use crate::report::{Console, Table, count, figure};

/// Describe a cage, and everything that is wrong with it
#[derive(Debug, Args)]
pub(crate) struct Info {
    #[command(flatten)]
    cage: CageArguments,
}

/// The report for programs.
#[derive(Serialize)]
struct Report<'a> {
    vertices: usize,
    faces: usize,
    edges: usize,
    quads: usize,
    triangles: usize,
    ngons: usize,
    boundary_edges: usize,
    boundary_loops: Option<usize>,
    components: Vec<Component>,
    valences: &'a BTreeMap<u32, usize>,
    extraordinary: usize,
    extraordinary_edges: usize,
    creases: Creases,
    corners: usize,
    holes: usize,
    /// Where curves meet.
    meetings: usize,
    valence2: Vec<u32>,
    bbox: Option<[[f64; 3]; 2]>,
    boundary: &'static str,
    creasing: &'static str,
    uvs: usize,
    defects: &'a [Finding],
    notes: &'a [Finding],
}

#[derive(Serialize)]
struct Component {
    faces: usize,
    closed: bool,
    genus: Option<usize>,
}

#[derive(Serialize)]
struct Creases {
    semi_sharp: usize,
    infinite: usize,
}

impl Info {
    pub(crate) fn run(&self, console: &Console) -> Result<ExitCode, Failure> {
        let progress = console.progress();
        progress.step("reading");
        let cage = self.cage.read()?;
        let mesh = cage.mesh();
        let statistics = Statistics::new(mesh);
        drop(progress);
        let defects = cage.findings(&statistics.defects);
        let mut notes = cage.warnings();
        notes.extend(ogee::mesh::notes(mesh).iter().map(Finding::of_note));
        let components = statistics.components.iter();
        let report = Report {
            vertices: statistics.vertices,
            faces: statistics.faces,
            edges: statistics.edges,
            quads: statistics.quads,
            triangles: statistics.triangles,
            ngons: statistics.other_polygons,
            boundary_edges: statistics.boundary_edges,
            boundary_loops: statistics.boundary_loops,
            components: components
                .map(|piece| Component { faces: piece.faces, closed: piece.closed, genus: piece.genus })
                .collect(),
            valences: &statistics.valences,
            extraordinary: statistics.extraordinary,
            extraordinary_edges: statistics.extraordinary_edges,
            creases: Creases {
                semi_sharp: statistics.semi_sharp_creases,
                infinite: statistics.infinite_creases,
            },
            corners: statistics.corners,
            holes: statistics.holes,
            meetings: mesh.meetings.len(),
            valence2: statistics.valence_two.iter().map(|vertex| vertex.0).collect(),
            bbox: statistics.bounding_box.map(|bbox| bbox.map(<[f64; 3]>::from)),
            boundary: match mesh.scheme.boundary {
                Boundary::EdgeAndCorner => "edge-and-corner",
                Boundary::EdgeOnly => "edge-only",
                Boundary::None => "none",
            },
            creasing: match mesh.scheme.creasing {
                Creasing::Uniform => "uniform",
                Creasing::Chaikin => "chaikin",
            },
            uvs: mesh.uv.as_ref().map_or(0, |uv| uv.values.len()),
            defects: &defects,
            notes: &notes,
        };
        let refusal = (!defects.is_empty()).then(|| Failure::refused(defects.clone(), 0));
        if let Some(refusal) = &refusal {
            console.refusal(refusal);
        }
        console.table(&cage.name, &table(&report), &notes);
        console.json(&report)?;
        Ok(if refusal.is_some() { ExitCode::from(Exit::Input as u8) } else { ExitCode::SUCCESS })
    }
}

fn table(report: &Report<'_>) -> Table {
    let mut table = Table::default();
    table.row("vertices", report.vertices.to_string());
    let kinds = [
        (report.quads, "quad", "quads"),
        (report.triangles, "triangle", "triangles"),
        (report.ngons, "other polygon", "other polygons"),
    ];
    let kinds = kinds.into_iter().filter(|(n, ..)| *n > 0).map(|(n, one, many)| count(n, one, many));
    table.row("faces", format!("{}: {}", report.faces, kinds.collect::<Vec<_>>().join(", ")));
    table.row("edges", report.edges.to_string());
    if report.boundary_edges > 0 {
        let loops = report.boundary_loops.map(|n| format!(" in {}", count(n, "loop", "loops")));
        table.row("boundary", format!("{} edges{}", report.boundary_edges, loops.unwrap_or_default()));
    }
    for piece in report.components.iter().take(MOST_PIECES) {
        let state = if piece.closed { "closed" } else { "open" };
        let genus = piece.genus.map(|genus| format!(", genus {genus}")).unwrap_or_default();
        table.row("piece", format!("{}, {state}{genus}", count(piece.faces, "face", "faces")));
    }
    if report.components.len() > MOST_PIECES {
        table.row("pieces", format!("{} in all", report.components.len()));
    }
    let valences = report.valences.iter().map(|(valence, n)| format!("{valence}: {n}"));
    table.row("valences", valences.collect::<Vec<_>>().join("   "));
    let joined = count(report.extraordinary_edges, "edge joins", "edges join");
    table.row("extraordinary", format!("{}; {joined} two of them", report.extraordinary));
    let Creases { semi_sharp, infinite } = report.creases;
    table.row("creases", format!("{infinite} infinitely sharp, {semi_sharp} semi-sharp"));
    if report.corners > 0 {
        table.row("corners", report.corners.to_string());
    }
    if report.holes > 0 {
        table.row("holes", report.holes.to_string());
    }
    if report.meetings > 0 {
        table.row("meetings", format!("of curves at {}", count(report.meetings, "vertex", "vertices")));
    }
    if !report.valence2.is_empty() {
        let first: Vec<String> = report.valence2.iter().take(MOST_PIECES).map(u32::to_string).collect();
        let more = if report.valence2.len() > MOST_PIECES { ", .." } else { "" };
        table.row("valence 2", format!("{}: vertex {}{more}", report.valence2.len(), first.join(", ")));
    }
    table.row("rules", format!("boundary {}, creasing {}", report.boundary, report.creasing));
    if let Some([low, high]) = report.bbox {
        let [low, high] = [low, high].map(|corner| corner.map(figure).join(" "));
        table.row("bounding box", format!("({low}) to ({high})"));
    }
    table
}

/// Pieces and vertices that are listed for people.
const MOST_PIECES: usize = 8;
