//! The figures as people read them on a terminal.

use super::figures::{At, Figures, MetricFigures, Place, Radius};
use super::place;
use super::verdict::Verdict;
use crate::report::{Table, count, figure};

/// Points that are listed without `--verbose`.
const FEW: usize = 3;

/// The table; `verbose` lists more places.
pub(crate) fn table(figures: &Figures, verbose: bool) -> Table {
    let mut table = Table::default();
    let Figures { continuity, curvature, extraordinary, .. } = figures;
    let (one, many) = if figures.kind == "cage" { ("face", "faces") } else { ("patch", "patches") };
    let border = match continuity.border_sides {
        0 => "closed".to_owned(),
        sides => format!("open, {} on its border", count(sides, "side", "sides")),
    };
    table.row("surface", format!("{}, {border}", count(figures.faces, one, many)));
    table.row("area", figure(figures.area));
    table.row("size", figure(figures.size));
    let smooth = &continuity.smooth;
    table.row("smooth joints", smooth.joints.to_string());
    let rows = [
        ("gap G0", &smooth.gap, ""),
        ("angle G1", &smooth.angle_deg, " deg"),
        ("curvature G2", &smooth.curvature_relative, ""),
        ("kink of lines", &smooth.kink_deg, " deg"),
    ];
    let verdicts = Verdict::on(continuity, figures.size);
    for ((label, found, unit), verdict) in rows.into_iter().zip(verdicts).filter(|(row, _)| row.1.samples > 0)
    {
        table.row(label, metric(found, unit));
        // Where rounding is largest interests nobody.
        let listed = if verbose { usize::MAX } else { usize::from(verdict != Verdict::Exact) };
        for worst in found.worst.iter().take(listed) {
            let beside = place(&worst.beside);
            table.row("", format!("{}{unit} on {}, beside {beside}", figure(worst.value), place(&worst.at)));
        }
    }
    if continuity.sharp.joints > 0 {
        table.row("creases", continuity.sharp.joints.to_string());
        table.row("their angle", metric(&continuity.sharp.angle_deg, " deg"));
        table.row("their gap", metric(&continuity.sharp.gap, ""));
    }
    let radius = |found: &Option<Radius>, kind: &str| {
        found.as_ref().map(|found| format!("{} {kind}, on {}", figure(found.radius), place(&found.at)))
    };
    let radii = &curvature.smallest_radius;
    for found in [radius(&radii.convex, "convex"), radius(&radii.concave, "concave")].into_iter().flatten() {
        table.row("smallest radius", found);
    }
    for (label, spread) in [("mean curvature", &curvature.mean), ("Gauss curvature", &curvature.gauss)] {
        let [low, middle, high] = [spread.p5, spread.p50, spread.p95].map(figure);
        table.row(label, format!("median {middle}, 90 % of the area within {low} to {high}"));
    }
    if curvature.undefined_normals > 0 {
        table.row(
            "without normal",
            format!("{} of {} samples", curvature.undefined_normals, curvature.samples),
        );
    }
    let examined = match extraordinary.examined {
        all if all == extraordinary.found => String::new(),
        some => format!(", the first {some} examined"),
    };
    table.row("extraordinary", format!("{}{examined}", count(extraordinary.found, "point", "points")));
    for valence in &extraordinary.by_valence {
        let growth = match valence.growing {
            0 => "curvature bounded".to_owned(),
            _ => format!("curvature grows by {} a halving", figure(valence.growth_mean)),
        };
        let swing = figure(valence.swing_max);
        let points = count(valence.count, "point", "points");
        table.row(
            "",
            format!("{points} of {} {}: {growth}, swing {swing}", valence.faces, faces_of(valence.kind)),
        );
    }
    for point in extraordinary.points.iter().take(if verbose { usize::MAX } else { FEW }) {
        table.row("swings most", format!("{} at {}", figure(point.swing), named(&point.place)));
    }
    if extraordinary.without_plane_found > 0 {
        table.row("no tangent plane", count(extraordinary.without_plane_found, "point", "points"));
    }
    for point in extraordinary.without_plane.iter().take(if verbose { usize::MAX } else { FEW }) {
        let spread = figure(point.spread_deg);
        let what = match point.cause {
            "slow" => "normals settle slowly".to_owned(),
            _ => format!("normals {spread} deg apart"),
        };
        table.row("", format!("{}: {what}", named(&point.place)));
    }
    table
}

fn metric(metric: &MetricFigures, unit: &str) -> String {
    let [max, p95, mean] = [metric.max, metric.p95, metric.mean].map(figure);
    format!("max {max}{unit}, 95 % {p95}{unit}, mean {mean}{unit}")
}

/// How faces lie around a point of a kind.
pub(super) fn faces_of(kind: &str) -> &'static str {
    match kind {
        "interior" => "faces",
        "dart" => "faces with a crease that ends",
        "crease" => "faces along creases",
        _ => "faces on the border",
    }
}

/// `vertex 12, 5 faces`, or the place on a face where the point is no vertex.
pub(crate) fn named(point: &Place) -> String {
    let what = match (point.vertex, point.at) {
        (Some(vertex), _) => format!("vertex {vertex}"),
        (None, At { face, corner: Some(_), u: 1.0, v: 1.0 }) => format!("the middle of face {face}"),
        (None, at) => place(&at),
    };
    format!("{what}, {} {}", point.faces, faces_of(point.kind))
}
