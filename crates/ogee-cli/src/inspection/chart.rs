//! Drawings of a page: histograms, marks on pictures, the scale of a map, rings around a point.

use std::fmt::Write;

use ogee_render::{Quantity, colour, shade};

use super::figures::{Point, Spread};
use super::number;
use super::pictures::{Picture, SIZE};

/// Shares of the area over the values of a quantity.
pub(super) fn histogram(spread: &Spread, label: &str) -> String {
    const WIDTH: f64 = 340.0;
    const HEIGHT: f64 = 120.0;
    let bars = &spread.histogram;
    let most = bars.shares.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let step = WIDTH / bars.shares.len().max(1) as f64;
    let x = |value: f64| {
        let span = bars.to - bars.from;
        if span > 0.0 { ((value - bars.from) / span * WIDTH).clamp(0.0, WIDTH) } else { WIDTH / 2.0 }
    };
    let mut svg = format!(
        "<svg class=\"chart\" viewBox=\"-1 -4 342 148\" role=\"img\" aria-label=\"Histogram of {label}\">"
    );
    for (k, share) in bars.shares.iter().enumerate().filter(|(_, share)| **share > 0.0) {
        // What is there is seen.
        let height = (share / most * HEIGHT).max(0.7);
        let _ = write!(
            svg,
            "<rect class=\"bar\" x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{height:.2}\"/>",
            k as f64 * step + 0.4,
            HEIGHT - height,
            (step - 0.8).max(0.4),
        );
    }
    let _ = write!(svg, "<line class=\"axis\" x1=\"0\" y1=\"120\" x2=\"340\" y2=\"120\"/>");
    if bars.from < 0.0 && bars.to > 0.0 {
        let zero = x(0.0);
        let _ = write!(svg, "<line class=\"zero\" x1=\"{zero:.2}\" y1=\"0\" x2=\"{zero:.2}\" y2=\"120\"/>");
        if (64.0..WIDTH - 64.0).contains(&zero) {
            let _ = write!(svg, "<text x=\"{zero:.2}\" y=\"138\" text-anchor=\"middle\">0</text>");
        }
    }
    let median = x(spread.p50);
    let _ = write!(svg, "<path class=\"median\" d=\"M{median:.2} 121l-4 6h8z\"/>");
    for (at, anchor, value) in [(0.0, "start", bars.from), (WIDTH, "end", bars.to)] {
        // Rounding is zero.
        let value = number(if value.abs() < 1e-9 * (bars.to - bars.from) { 0.0 } else { value });
        let _ = write!(svg, "<text x=\"{at}\" y=\"138\" text-anchor=\"{anchor}\">{value}</text>");
    }
    svg + "</svg>"
}

/// Numbers in circles beside the places that they belong to.
pub(super) fn marks(picture: &Picture) -> String {
    const RADIUS: f64 = 11.0;
    const REACH: f64 = 30.0;
    let [width, height] = SIZE.map(f64::from);
    let mut svg = format!("<svg class=\"marks\" viewBox=\"0 0 {width} {height}\" aria-hidden=\"true\">");
    let mut taken: Vec<[f64; 2]> = Vec::new();
    for &(label, [x, y]) in &picture.marks {
        // The direction in which the circle is farthest from everything else.
        let free = |[a, b]: [f64; 2]| {
            let others =
                picture.marks.iter().filter(|mark| mark.0 != label).map(|mark| &mark.1).chain(&taken);
            let near = others.map(|[c, d]| (a - c).hypot(b - d)).fold(200.0, f64::min);
            let edge = a.min(width - a).min(b).min(height - b) - RADIUS;
            near.min(10.0 * edge)
        };
        let around = (0..16).map(|k| {
            let angle = f64::from(k) * std::f64::consts::TAU / 16.0 - 0.9;
            [x + REACH * angle.cos(), y + REACH * angle.sin()]
        });
        let best = around.reduce(|best, next| if free(next) > free(best) + 1e-9 { next } else { best });
        let [a, b] = best.unwrap_or([x, y]);
        taken.push([a, b]);
        let _ = write!(
            svg,
            "<g><path class=\"leader\" d=\"M{x:.1} {y:.1}L{a:.1} {b:.1}\"/>\
             <circle class=\"point\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"/>\
             <circle class=\"bubble\" cx=\"{a:.1}\" cy=\"{b:.1}\" r=\"{RADIUS}\"/>\
             <text x=\"{a:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{label}</text></g>",
            b + 4.2
        );
    }
    svg + "</svg>"
}

/// The colours of a map of mean curvature, from one end to the other.
pub(super) fn scale(limit: f64) -> String {
    let stops: Vec<String> = (0..=8)
        .map(|k| {
            let share = f64::from(k) / 4.0 - 1.0;
            let [red, green, blue] = colour::bytes(shade::map(Quantity::Mean, Some(share), 1.0));
            format!("rgb({red} {green} {blue})")
        })
        .collect();
    format!(
        "<div class=\"scale\"><div class=\"ramp\" style=\"background:linear-gradient(to right,{})\"></div>\
         <div class=\"ends\"><span>{}</span><span>0</span><span>{}</span></div></div>",
        stops.join(","),
        number(-limit),
        number(limit)
    )
}

/// How mean curvature grows towards a point: one dot for each ring, from far to near.
pub(super) fn rings(point: &Point) -> String {
    let most = point.rings.iter().map(|ring| ring.mean).fold(f64::MIN_POSITIVE, f64::max);
    let spot = |k: usize| (4.0 + 14.4 * k as f64, 22.0 - 18.0 * point.rings[k].mean / most);
    let line: Vec<String> = (0..point.rings.len()).map(spot).map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
    let mut svg = format!(
        "<svg class=\"spark\" viewBox=\"0 0 80 26\" role=\"img\" aria-label=\"Mean curvature on smaller and smaller rings\">\
         <polyline points=\"{}\"/>",
        line.join(" ")
    );
    for (x, y) in (0..point.rings.len()).map(spot) {
        let _ = write!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"1.8\"/>");
    }
    svg + "</svg>"
}
