//! Figures on the quality of a surface: as JSON, as a table, as a page.
//!
//! | file | holds |
//! | --- | --- |
//! | `figures` | [`Figures`]: names and shapes of the JSON report |
//! | `verdict` | what a figure means |
//! | `table` | the table |
//! | `page`, `page.css` | the page of HTML |
//! | `compared` | the page of one cage by several methods |
//! | `marks`, `pictures`, `chart` | what it points at, its pictures, its drawings |

mod chart;
mod compared;
pub(crate) mod figures;
mod marks;
mod page;
mod pictures;
mod table;
mod verdict;

pub(crate) use compared::compared_page;
pub(crate) use figures::Figures;
pub(crate) use pictures::SIZE as PICTURE;
pub(crate) use table::{named, table};

use ogee::ControlMesh;
use ogee::quality::{Address, PlaneLight, Sector, Surface};

use crate::error::Finding;
use crate::report::rounded;
use pictures::Picture;

/// The page of HTML about a surface.
pub(crate) struct PageOf<'a> {
    /// The name of the file that was inspected.
    pub(crate) name: &'a str,
    pub(crate) figures: &'a Figures,
    /// The largest angle that was allowed, if one was.
    pub(crate) max_angle: Option<f64>,
    /// What mirrors the lines whose kinks were measured.
    pub(crate) light: PlaneLight,
    pub(crate) notes: &'a [Finding],
}

/// A surface that pictures show beside the one that was inspected.
pub(crate) struct Second<'a> {
    pub(crate) surface: &'a dyn Surface,
    /// The name of its file.
    pub(crate) name: &'a str,
    /// Whether it is the limit of a cage, and not patches.
    pub(crate) is_limit: bool,
}

impl PageOf<'_> {
    /// The whole file, with the pictures that there are, and why others are not there.
    pub(crate) fn html(
        &self,
        surface: &dyn Surface,
        beside: Option<&Second<'_>>,
    ) -> (String, Option<Finding>) {
        let marks = marks::marks(self.figures);
        let PageOf { name, figures, max_angle, light, notes } = *self;
        let second = beside.map(|second| second.surface);
        let drawn = pictures::pictures(surface, second, figures.size, light, &marks);
        let (pictures, fault) = match drawn {
            Ok(pictures) => {
                let fault = beside.and_then(|second| missing(&pictures, second.name));
                (pictures, fault)
            }
            Err(fault) => {
                let message = format!("the page has no pictures: {fault}");
                (Vec::new(), Some(Finding::in_file(fault.code(), message, name)))
            }
        };
        let page = page::Page { name, figures, max_angle, marks: &marks, pictures: &pictures, beside, notes };
        (page.html(), fault)
    }
}

/// The first picture that does not show the second surface, and why.
fn missing(pictures: &[Picture], name: &str) -> Option<Finding> {
    pictures.iter().find_map(|picture| {
        let fault = picture.beside.as_ref()?.as_ref().err()?;
        let message = format!("it is not in the picture \"{}\": {fault}", picture.title);
        Some(Finding::in_file(fault.code(), message, name))
    })
}

/// The vertex of the cage that a point is, if it is one.
pub(crate) fn vertex_of(mesh: Option<&ControlMesh>, sector: &Sector) -> Option<u32> {
    let Address { face, corner, u, v } = sector.at;
    let corners = mesh?.faces.face(face.index());
    let at = match (corner, (u, v)) {
        (Some(corner), (0.0, 0.0)) => corner,
        (None, (0.0, 0.0)) => 0,
        (None, (1.0, 0.0)) => 1,
        (None, (1.0, 1.0)) => 2,
        (None, (0.0, 1.0)) => 3,
        _ => return None,
    };
    corners.get(at as usize).copied()
}

/// `face 3 corner 1 at (0.5, 0)`.
fn place(address: &figures::At) -> String {
    let figures::At { face, corner, u, v } = address;
    let corner = corner.map(|corner| format!(" corner {corner}")).unwrap_or_default();
    format!("face {face}{corner} at ({}, {})", rounded(*u, DIGITS), rounded(*v, DIGITS))
}

/// Digits that are read and not only looked at.
const DIGITS: i32 = 4;

/// A number as people write it: four digits, thousands apart, a minus sign, powers of ten. It does not break over lines.
fn number(x: f64) -> String {
    let text = rounded(x, DIGITS);
    let (digits, power) = text.split_once('e').unwrap_or((&text, ""));
    let (sign, digits) = digits.strip_prefix('-').map_or(("", digits), |digits| ("\u{2212}", digits));
    let (whole, rest) = digits.split_at(digits.find('.').unwrap_or(digits.len()));
    let mut number = sign.to_owned();
    for (k, digit) in whole.chars().enumerate() {
        if k > 0 && whole.len() > 4 && (whole.len() - k) % 3 == 0 {
            number.push('\u{202f}');
        }
        number.push(digit);
    }
    number += rest;
    if !power.is_empty() {
        number += "\u{a0}×\u{a0}10";
        number.extend(power.chars().map(superscript));
    }
    number
}

fn superscript(digit: char) -> char {
    match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' | '4'..='9' => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
        other => other,
    }
}

/// Text as HTML wants it.
fn escape(text: &str) -> String {
    let mut html = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => html += "&amp;",
            '<' => html += "&lt;",
            '>' => html += "&gt;",
            '"' => html += "&quot;",
            '\'' => html += "&#39;",
            letter => html.push(letter),
        }
    }
    html
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_as_people_write_them() {
        let cases = [
            (0.25, "0.25"),
            (117.6632, "117.7"),
            (1234.5, "1234"),
            (-56597.9, "\u{2212}56\u{202f}598"),
            (-1.52e-12, "\u{2212}1.5\u{a0}×\u{a0}10⁻¹²"),
            (4.06e15, "4.1\u{a0}×\u{a0}10¹⁵"),
        ];
        for (x, text) in cases {
            assert_eq!(number(x), text);
        }
    }

    #[test]
    fn names_cannot_break_the_page() {
        assert_eq!(escape("<a&\"b'>"), "&lt;a&amp;&quot;b&#39;&gt;");
    }
}
