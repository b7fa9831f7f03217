//! Plots as SVG: lines, dots and words on white, so that they can be read on pages of any colour.

use std::fmt::Write as _;

/// Colours that differ in hue and in brightness.
pub(super) const COLOURS: [&str; 7] =
    ["#1f4e9c", "#c2410c", "#15803d", "#7e22ce", "#0e7490", "#a16207", "#be185d"];

/// The colour of words and axes, and of what is to stand back.
pub(super) const INK: &str = "#222222";
pub(super) const FAINT: &str = "#d4d4d8";

/// A drawing in the making; `y` runs down.
pub(super) struct Svg {
    size: [f64; 2],
    body: String,
}

/// Where words stand beside their place.
#[derive(Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Svg {
    pub(super) fn new(size: [f64; 2]) -> Svg {
        Svg { size, body: String::new() }
    }

    pub(super) fn line(&mut self, points: &[[f64; 2]], colour: &str, width: f64) {
        let mut list = String::new();
        for [x, y] in points {
            let _ = write!(list, "{x:.1},{y:.1} ");
        }
        let list = list.trim_end();
        let _ = writeln!(
            self.body,
            "<polyline points=\"{list}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"/>"
        );
    }

    pub(super) fn dot(&mut self, [x, y]: [f64; 2], radius: f64, colour: &str) {
        let _ = writeln!(self.body, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{colour}\"/>");
    }

    pub(super) fn text(&mut self, [x, y]: [f64; 2], anchor: Anchor, size: f64, words: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let _ = writeln!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" text-anchor=\"{anchor}\" fill=\"{INK}\">{words}</text>"
        );
    }

    /// The whole file.
    pub(super) fn finish(self) -> String {
        let [width, height] = self.size;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"sans-serif\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{}</svg>\n",
            self.body
        )
    }
}

/// A rectangle of the drawing, and the numbers that its sides have.
#[derive(Clone, Copy)]
pub(super) struct Panel {
    /// Left and upper side.
    pub(super) corner: [f64; 2],
    /// Width and height.
    pub(super) size: [f64; 2],
    /// The numbers at its left and at its lower side.
    pub(super) least: [f64; 2],
    /// The numbers at its right and at its upper side.
    pub(super) most: [f64; 2],
}

impl Panel {
    /// Where numbers are in the drawing.
    pub(super) fn place(&self, at: [f64; 2]) -> [f64; 2] {
        let part = |k: usize| (at[k] - self.least[k]) / (self.most[k] - self.least[k]);
        [self.corner[0] + part(0) * self.size[0], self.corner[1] + (1.0 - part(1)) * self.size[1]]
    }

    pub(super) fn places(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        points.iter().map(|&at| self.place(at)).collect()
    }

    /// Its frame, lines across at some numbers, and these numbers beside it.
    pub(super) fn axes(&self, svg: &mut Svg, along: &[f64], up: &[f64]) {
        for &x in along {
            svg.line(&self.places(&[[x, self.least[1]], [x, self.most[1]]]), FAINT, 0.8);
            let [left, below] = self.place([x, self.least[1]]);
            svg.text([left, below + 15.0], Anchor::Middle, 12.0, &format!("{x}"));
        }
        for &y in up {
            svg.line(&self.places(&[[self.least[0], y], [self.most[0], y]]), FAINT, 0.8);
            let [left, above] = self.place([self.least[0], y]);
            svg.text([left - 6.0, above + 4.0], Anchor::End, 12.0, &format!("{y}"));
        }
        let ([x0, y0], [x1, y1]) = (self.least, self.most);
        svg.line(&self.places(&[[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]]), INK, 1.0);
    }
}
