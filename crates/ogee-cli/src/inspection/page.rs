//! The page: one file of HTML with everything in it, which opens without a network.

use std::fmt::Write;

use super::figures::{Figures, MetricFigures, Spread};
use super::marks::Mark;
use super::pictures::{Picture, SIZE};
use super::table::{faces_of, named};
use super::verdict::Verdict;
use super::{Second, chart, escape, number};
use crate::error::Finding;
use crate::report::count;

/// What a page is made from.
pub(super) struct Page<'a> {
    /// The name of the file that was inspected.
    pub(super) name: &'a str,
    pub(super) figures: &'a Figures,
    /// The largest angle that was allowed, if one was.
    pub(super) max_angle: Option<f64>,
    pub(super) marks: &'a [Mark],
    pub(super) pictures: &'a [Picture],
    /// What pictures show beside it.
    pub(super) beside: Option<&'a Second<'a>>,
    pub(super) notes: &'a [Finding],
}

impl Page<'_> {
    /// The whole file.
    pub(super) fn html(&self) -> String {
        let name = short(self.name);
        let sections = [
            self.header(&name),
            self.cards(),
            self.views(),
            self.places(),
            self.curvature(),
            self.points(),
            self.notes(),
        ];
        document(&name, &sections.concat())
    }

    fn header(&self, name: &str) -> String {
        let figures = self.figures;
        let what = match figures.kind {
            "cage" => {
                let faces = count(figures.faces, "face", "faces");
                format!("The exact limit surface of a cage of {faces}")
            }
            _ => format!("A surface of {}", count(figures.faces, "patch", "patches")),
        };
        let state = match figures.continuity.border_sides {
            0 => "closed".to_owned(),
            sides => format!("open, with {} on its border", count(sides, "side", "sides")),
        };
        let [low, high] = figures.bbox;
        let size: Vec<String> = low.iter().zip(high).map(|(low, high)| number(high - low)).collect();
        let check = self.max_angle.map(|limit| {
            let is_passed = figures.continuity.smooth.angle_deg.max <= limit;
            let (class, word) = if is_passed { ("exact", "Passed") } else { ("look", "Failed") };
            let [found, limit] = [figures.continuity.smooth.angle_deg.max, limit].map(number);
            format!(
                "<p class=\"check {class}\"><b>{word}.</b> <span>The largest angle over a smooth joint is {found}{DEGREES}; \
                 {limit}{DEGREES} is allowed.</span></p>\n"
            )
        });
        format!(
            "<header>\n<p class=\"kicker\">Surface quality</p>\n<h1>{name}</h1>\n<p class=\"lead\">{what}, {state}. {} in size, {} \
             in area. Lengths are in the unit of the file, curvatures in one over it, angles in degrees.</p>\n{}</header>\n",
            size.join(" × "),
            number(figures.area),
            check.unwrap_or_default()
        )
    }

    fn cards(&self) -> String {
        let figures = self.figures;
        let smooth = &figures.continuity.smooth;
        if smooth.joints == 0 {
            let nothing = "<section>\n<p class=\"about\">No two faces meet smoothly, so nothing is measured between \
                           them.</p>\n</section>\n";
            return nothing.to_owned() + &self.creases();
        }
        let metrics = [
            ("Gap", "G0", &smooth.gap, ""),
            ("Angle", "G1", &smooth.angle_deg, DEGREES),
            ("Curvature", "G2", &smooth.curvature_relative, ""),
            ("Kink of lines", "", &smooth.kink_deg, DEGREES),
        ];
        let mut html = "<section class=\"cards\">\n".to_owned();
        for ((label, grade, metric, unit), verdict) in
            metrics.into_iter().zip(Verdict::on(&figures.continuity, figures.size))
        {
            let (class, word) = match verdict {
                _ if metric.samples == 0 => ("", "not measured"),
                Verdict::Exact => ("exact", "exact to rounding"),
                Verdict::Fine => ("fine", "within tolerance"),
                Verdict::Look => ("look", "worth a look"),
            };
            let [max, p95, mean] = [metric.max, metric.p95, metric.mean].map(number);
            let _ = writeln!(
                html,
                "<div class=\"card\"><div class=\"label\"><span>{label}</span><b>{grade}</b></div>\
                 <div class=\"big\">{max}{unit}</div><div class=\"small\">95 % below {p95}{unit}<br>mean {mean}{unit}</div>\
                 <div class=\"verdict {class}\">{word}</div></div>"
            );
        }
        html += "</section>\n";
        let _ = writeln!(
            html,
            "<p class=\"about gap\">The largest of each over {} at five places, both sides measured in their own faces: the \
             distance of the points; the angle of the normals; the difference of principal curvatures as a share of the \
             largest; the angle between the two ends of a reflection line.</p>",
            count(smooth.joints, "smooth joint", "smooth joints")
        );
        html + &self.creases()
    }

    fn creases(&self) -> String {
        let sharp = &self.figures.continuity.sharp;
        if sharp.joints == 0 {
            return String::new();
        }
        let row = |label: &str, metric: &MetricFigures, unit: &str| {
            let [max, p95, mean] = [metric.max, metric.p95, metric.mean].map(number);
            let place = metric.worst.first().map(|worst| super::place(&worst.at)).unwrap_or_default();
            format!(
                "<tr><td>{label}</td><td class=\"n\">{max}{unit}</td><td class=\"n\">{p95}{unit}</td><td class=\"n\">{mean}{unit}\
                 </td><td class=\"where\">{place}</td></tr>\n"
            )
        };
        format!(
            "<div class=\"wide\"><table>\n<thead><tr><th>{}</th><th class=\"n\">largest</th><th class=\"n\">95 %</th>\
             <th class=\"n\">mean</th><th>largest on</th></tr></thead>\n<tbody>\n{}{}</tbody>\n</table></div>\n",
            count(sharp.joints, "joint on a crease", "joints on creases"),
            row("Angle", &sharp.angle_deg, DEGREES),
            row("Gap", &sharp.gap, "")
        )
    }

    fn views(&self) -> String {
        if self.pictures.is_empty() {
            return String::new();
        }
        let (class, about) = match self.beside {
            Some(_) => (
                " pairs",
                " Both surfaces are seen from the same place, in the same light and with the same colours.",
            ),
            None => ("", ""),
        };
        let mut html = format!(
            "<section>\n<h2>Pictures</h2>\n<p class=\"about\">Every pixel shows the exact point of the \
             surface.{about}</p>\n<div class=\"pictures{class}\">\n"
        );
        for picture in self.pictures {
            let Picture { title, caption, limit, .. } = picture;
            let frames = self.frames(picture);
            let scale = limit.map(chart::scale).unwrap_or_default();
            let _ = writeln!(
                html,
                "<figure>{frames}{scale}<figcaption><b>{title}</b>{caption}</figcaption></figure>"
            );
        }
        html + "</div>\n</section>\n"
    }

    /// What is seen of the surface, and of the second one if there is one.
    fn frames(&self, picture: &Picture) -> String {
        let Picture { title, source, beside, marks, .. } = picture;
        let marks = if marks.is_empty() { String::new() } else { chart::marks(picture) };
        let first = frame(source, title, &marks);
        let (Some(second), Some(drawn)) = (self.beside, beside) else { return first };
        let other = match drawn {
            Ok(source) => frame(source, title, ""),
            Err(error) => format!("<div class=\"frame empty\">{}</div>", escape(&error.to_string())),
        };
        let label = |name: &str, is_limit: bool| {
            format!("{}, {}", short(name), if is_limit { "the limit surface" } else { "patches" })
        };
        format!(
            "<div class=\"pair\"><div>{first}<p class=\"which\">{}</p></div>\
             <div>{other}<p class=\"which\">{}</p></div></div>",
            label(self.name, self.figures.kind == "cage"),
            label(second.name, second.is_limit)
        )
    }

    fn places(&self) -> String {
        if self.marks.is_empty() {
            return String::new();
        }
        let mut rows = String::new();
        for (label, mark) in (1..).zip(self.marks) {
            for (k, remark) in mark.remarks.iter().enumerate() {
                let (class, no) = match k {
                    0 => ("", format!("<span class=\"no\">{label}</span>")),
                    _ => (" class=\"more\"", String::new()),
                };
                let _ = writeln!(
                    rows,
                    "<tr{class}><td class=\"tight\">{no}</td><td>{}</td><td class=\"n\">{}</td><td class=\"where\">{}</td></tr>",
                    remark.what, remark.value, remark.place
                );
            }
        }
        format!(
            "<section>\n<h2>Places to look at</h2>\n<p class=\"about\">The worst of what is not exact, the sharpest bends, and \
             where curvature is least settled. (u, v) run from 0 to 1 over a face, (0, 0) at its first vertex, (1, 0) at the \
             second.</p>\n<div class=\"wide\"><table>\n<thead><tr><th></th><th>what</th><th class=\"n\">value</th><th>where</th></tr>\
             </thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n</section>\n"
        )
    }

    fn curvature(&self) -> String {
        let curvature = &self.figures.curvature;
        let card = |title: &str, spread: &Spread| {
            let [p5, p50, p95] = [spread.p5, spread.p50, spread.p95].map(number);
            format!(
                "<div class=\"card\"><h3>{title}</h3>{}<dl class=\"facts\"><dt>median</dt><dd>{p50}</dd><dt>90 % of the area</dt>\
                 <dd><span>{p5} to</span> <span>{p95}</span></dd><dt>all</dt><dd><span>{} to</span> <span>{}</span></dd></dl></div>\n",
                chart::histogram(spread, title),
                number(spread.min),
                number(spread.max)
            )
        };
        let lost = match curvature.undefined_normals {
            0 => String::new(),
            lost => format!(" {lost} of {} samples lie where the surface has no normal.", curvature.samples),
        };
        format!(
            "<section>\n<h2>Curvature</h2>\n<p class=\"about\">Shares of the area, by {} samples; the outermost hundredth on either side \
             is left out, and the red mark is the median. Positive where the surface is hollow, negative where it bulges, \
             seen from outside.{lost}</p>\n<div class=\"cards\">\n{}{}{}</div>\n</section>\n",
            curvature.samples,
            card("Mean curvature", &curvature.mean),
            card("Gauss curvature", &curvature.gauss),
            card("Strongest curvature", &curvature.greatest)
        )
    }

    fn points(&self) -> String {
        let found = &self.figures.extraordinary;
        if found.found == 0 {
            return String::new();
        }
        let mut valences = String::new();
        for valence in &found.by_valence {
            let behaviour = match valence.growing {
                0 => "bounded".to_owned(),
                _ => format!("grows by {} at each halving", number(valence.growth_mean)),
            };
            let _ = writeln!(
                valences,
                "<tr><td>{} {}</td><td class=\"n\">{}</td><td>{behaviour}</td><td class=\"n\">{}</td></tr>",
                valence.faces,
                faces_of(valence.kind),
                valence.count,
                number(valence.swing_max)
            );
        }
        let mut ranked = String::new();
        for point in found.points.iter().take(LISTED).filter(|point| point.swing > 0.0) {
            let _ = writeln!(
                ranked,
                "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"tight\">{}</td><td>{}</td></tr>",
                named(&point.place),
                number(point.swing),
                chart::rings(point),
                point.behaviour
            );
        }
        let mut without = String::new();
        for point in found.without_plane.iter().take(LISTED) {
            let cause = match point.cause {
                "rules" => "the rules of subdivision give none",
                "slow" => "there is one, but normals reach it only slowly",
                _ => "its faces disagree",
            };
            let _ = writeln!(
                without,
                "<tr><td>{}</td><td>{cause}</td><td class=\"n\">{}{DEGREES}</td></tr>",
                named(&point.place),
                number(point.spread_deg)
            );
        }
        let examined = match found.examined {
            all if all == found.found => String::new(),
            some => format!(" The first {some} of {} were examined.", found.found),
        };
        let mut html = format!(
            "<section>\n<h2>Extraordinary points</h2>\n<p class=\"about\">Where not four faces meet. Beside them curvature neither \
             settles nor, from five faces on, stays bounded; it is measured on rings, each half as large as the one before. \
             Swing is how much mean curvature varies round the ring of a 64th of a face, as a share of its \
             mean.{examined}</p>\n<div class=\"wide\"><table>\n<thead><tr><th>faces</th><th class=\"n\">points</th><th>mean curvature \
             towards the point</th><th class=\"n\">largest swing</th></tr></thead>\n<tbody>\n{valences}</tbody>\n</table></div>\n"
        );
        if !ranked.is_empty() {
            let _ = writeln!(
                html,
                "<div class=\"wide gap\"><table>\n<thead><tr><th>where it swings most</th><th class=\"n\">swing</th><th>mean curvature, \
                 inwards</th><th></th></tr></thead>\n<tbody>\n{ranked}</tbody>\n</table></div>"
            );
        }
        if !without.is_empty() {
            let _ = writeln!(
                html,
                "<div class=\"wide gap\"><table>\n<thead><tr><th>{}</th><th>why</th><th class=\"n\">normals apart</th></tr></thead>\n\
                 <tbody>\n{without}</tbody>\n</table></div>",
                count(
                    found.without_plane_found,
                    "point without a tangent plane",
                    "points without a tangent plane"
                )
            );
        }
        html + "</section>\n"
    }

    fn notes(&self) -> String {
        ending(self.notes)
    }
}

/// A file of HTML with everything in it.
pub(super) fn document(name: &str, content: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" \
         content=\"width=device-width, initial-scale=1\">\n<title>{name} \u{2013} surface quality</title>\n<style>\n{}</style>\n\
         </head>\n<body>\n<main>\n{content}</main>\n</body>\n</html>\n",
        include_str!("page.css"),
    )
}

/// What else is worth knowing, and the end of a page.
pub(super) fn ending(notes: &[Finding]) -> String {
    let items: String = notes.iter().map(|note| format!("<li>{}</li>\n", escape(&note.message))).collect();
    let notes = match items.is_empty() {
        true => String::new(),
        false => format!("<section>\n<h2>Notes</h2>\n<ul class=\"notes\">\n{items}</ul>\n</section>\n"),
    };
    format!("{notes}<footer>Measured by ogee {}.</footer>\n", env!("CARGO_PKG_VERSION"))
}

/// A picture and what is drawn over it.
pub(super) fn frame(source: &str, title: &str, marks: &str) -> String {
    let [width, height] = SIZE;
    format!(
        "<div class=\"frame\"><img src=\"{source}\" width=\"{width}\" height=\"{height}\" alt=\"{title}\">{marks}</div>"
    )
}

/// The name of a file without its folders.
pub(super) fn short(name: &str) -> String {
    let last = std::path::Path::new(name).file_name();
    escape(&last.map_or_else(|| name.into(), |last| last.to_string_lossy()))
}

/// The unit of angles.
pub(super) const DEGREES: &str = "<small> deg</small>";

/// Points that are listed.
const LISTED: usize = 10;
