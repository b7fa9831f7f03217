//! The page of one cage by several methods: pictures side by side, and how far curvature ranges by each.

use std::fmt::Write;

use ogee::quality::Surface;

use super::page::{DEGREES, document, ending, frame, short};
use super::pictures::{Row, rows};
use super::table::named;
use super::{chart, escape, number};
use crate::comparison::Comparison;
use crate::error::Finding;
use crate::report::count;

/// The whole file, with the pictures that there are, and why others are not there.
pub(crate) fn compared_page(
    name: &str,
    comparison: &Comparison,
    surfaces: &[&dyn Surface],
    notes: &[Finding],
) -> (String, Option<Finding>) {
    let (pictures, fault) = match rows(surfaces, comparison.size) {
        Ok(rows) => (views(comparison, &rows), None),
        Err(fault) => {
            let message = format!("the page has no pictures: {fault}");
            (String::new(), Some(Finding::in_file(fault.code(), message, name)))
        }
    };
    let title = short(name);
    let content = [
        header(&title, comparison),
        pictures,
        surfaces_table(comparison),
        points_table(comparison),
        ending(notes),
    ];
    (document(&title, &content.concat()), fault)
}

fn header(title: &str, comparison: &Comparison) -> String {
    let methods: Vec<&str> = comparison.surfaces.iter().map(|surface| surface.method).collect();
    format!(
        "<header>\n<p class=\"kicker\">Surface quality by method</p>\n<h1>{title}</h1>\n<p class=\"lead\">A cage of {} by {}: {}. \
         Lengths are in the unit of the file, curvatures in one over it, angles in degrees.</p>\n</header>\n",
        count(comparison.faces, "face", "faces"),
        count(methods.len(), "method", "methods"),
        methods.join(", ")
    )
}

fn views(comparison: &Comparison, rows: &[Row]) -> String {
    let mut html = "<section>\n<h2>Pictures</h2>\n<p class=\"about\">All surfaces are seen from the same place, in the same \
                    light and with the same colours.</p>\n<div class=\"pictures pairs\">\n"
        .to_owned();
    for Row { title, caption, sources, limit } in rows {
        let frames = sources.iter().zip(&comparison.surfaces).map(|(source, surface)| {
            let drawn = match source {
                Ok(source) => frame(source, title, ""),
                Err(error) => format!("<div class=\"frame empty\">{}</div>", escape(&error.to_string())),
            };
            format!("<div>{drawn}<p class=\"which\">{}</p></div>", surface.method)
        });
        let frames: String = frames.collect();
        let scale = limit.map(chart::scale).unwrap_or_default();
        let _ = writeln!(
            html,
            "<figure><div class=\"row\">{frames}</div>{scale}<figcaption><b>{title}</b>{caption}</figcaption></figure>"
        );
    }
    html + "</div>\n</section>\n"
}

fn surfaces_table(comparison: &Comparison) -> String {
    let mut rows = String::new();
    for surface in &comparison.surfaces {
        let figures = &surface.figures;
        let smooth = &figures.continuity.smooth;
        let [low, high] = [figures.curvature.mean.min, figures.curvature.mean.max].map(number);
        let _ = writeln!(
            rows,
            "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}{DEGREES}</td><td class=\"n\">{}</td>\
             <td class=\"n\">{}{DEGREES}</td><td class=\"n\">{low} to {high}</td></tr>",
            surface.method,
            figures.squares,
            number(smooth.angle_deg.max),
            number(smooth.curvature_relative.max),
            number(smooth.kink_deg.max),
        );
    }
    format!(
        "<section>\n<h2>Over all joints</h2>\n<p class=\"about\">The largest of each over smooth joints, both sides measured in \
         their own faces; the jump of curvature is a share of the largest curvature there. Mean curvature is that of samples \
         inside the faces.</p>\n<div class=\"wide\"><table>\n<thead><tr><th>method</th><th class=\"n\">squares</th>\
         <th class=\"n\">angle</th><th class=\"n\">jump of curvature</th><th class=\"n\">kink of lines</th>\
         <th class=\"n\">mean curvature</th></tr></thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n</section>\n"
    )
}

fn points_table(comparison: &Comparison) -> String {
    if comparison.points.is_empty() {
        return String::new();
    }
    let heads: String = comparison
        .surfaces
        .iter()
        .map(|surface| format!("<th class=\"n\">{}</th>", surface.method))
        .collect();
    let mut rows = String::new();
    for point in comparison.points.iter().take(LISTED) {
        let cells = point.ranges.iter().map(|range| match range {
            Some(range) => {
                let [low, high] = range.mean.map(number);
                let span = number(range.mean[1] - range.mean[0]);
                format!("<td class=\"n\">{span}<br><small>{low} to {high}</small></td>")
            }
            None => "<td class=\"n\"></td>".to_owned(),
        });
        let cells: String = cells.collect();
        let _ = writeln!(rows, "<tr><td>{}</td>{cells}</tr>", named(&point.place));
    }
    let listed = match comparison.points.len() {
        all if all > LISTED => format!(" The first {LISTED} of {all}."),
        _ => String::new(),
    };
    format!(
        "<section>\n<h2>Around extraordinary points</h2>\n<p class=\"about\">How far mean curvature ranges over the faces where \
         not four of them meet: greatest less least. On the limit surface, where it has no bound from five faces on, no \
         nearer than a 32nd of a face.{listed}</p>\n<div class=\"wide\"><table>\n<thead><tr><th>where</th>{heads}</tr></thead>\n\
         <tbody>\n{rows}</tbody>\n</table></div>\n</section>\n"
    )
}

/// Points that are listed.
const LISTED: usize = 40;
