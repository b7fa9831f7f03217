//! What the colours of a map mean, and what a picture shows, written into its corners.

use embedded_graphics::mono_font::iso_8859_1::{FONT_7X13, FONT_10X20};
use embedded_graphics::mono_font::{MonoFont, MonoTextStyle};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::text::{Alignment, Text};

use crate::colour::{DIVERGING, RISING, along, bytes};
use crate::shade::palette;
use crate::{Image, Quantity, Style};

/// The colour of letters.
const INK: Rgb888 = Rgb888::new(40, 46, 54);

/// How little of a picture is left behind letters, of 256.
const VEIL: u32 = 56;

/// A picture as the library of letters sees it.
struct Paper<'a>(&'a mut Image);

impl OriginDimensions for Paper<'_> {
    fn size(&self) -> Size {
        Size::new(self.0.size[0], self.0.size[1])
    }
}

impl DrawTarget for Paper<'_> {
    type Color = Rgb888;
    type Error = std::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(&mut self, pixels: I) -> Result<(), Self::Error> {
        let [width, height] = self.0.size;
        for Pixel(Point { x, y }, colour) in pixels {
            let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else { continue };
            if x < width && y < height {
                let first = 4 * (y as usize * width as usize + x as usize);
                self.0.pixels[first..first + 3].copy_from_slice(&[colour.r(), colour.g(), colour.b()]);
            }
        }
        Ok(())
    }
}

impl Image {
    /// Writes the scale of a map that ends at `limit` into the picture, if it is a map and there is room.
    pub fn add_legend(&mut self, style: &Style, limit: f64) {
        let (title, scale, marks) = match style {
            Style::Curvature { quantity, .. } => {
                let number = |x: f64| short(x * limit);
                let both = vec![(0.0, number(-1.0)), (0.5, "0".to_owned()), (1.0, number(1.0))];
                match quantity {
                    Quantity::Gauss => ("Gauss curvature", &DIVERGING, both),
                    Quantity::Mean => ("mean curvature", &DIVERGING, both),
                    Quantity::K1 => ("larger principal curvature", &DIVERGING, both),
                    Quantity::K2 => ("smaller principal curvature", &DIVERGING, both),
                    Quantity::Greatest => {
                        let marks = vec![(0.0, "0".to_owned()), (0.5, number(0.5)), (1.0, number(1.0))];
                        ("greatest curvature", &RISING, marks)
                    }
                    Quantity::GaussSign => {
                        let words = ["saddle", "flat", "bowl"].map(str::to_owned);
                        let marks = [0.0, 0.5, 1.0].into_iter().zip(words).collect();
                        ("sign of Gauss curvature", &DIVERGING, marks)
                    }
                }
            }
            Style::Error { .. } => {
                let marks = vec![(0.0, "0".to_owned()), (0.5, short(0.5 * limit)), (1.0, short(limit))];
                ("displacement of lines, pixels", &RISING, marks)
            }
            _ => return,
        };
        self.draw_scale(title, scale, &marks);
    }

    /// Writes a line into the upper left corner, if there is room.
    pub fn add_caption(&mut self, caption: &str) {
        let Some(font) = self.font() else { return };
        let letter = font.character_size;
        let most = (self.size[0] / letter.width).saturating_sub(4) as usize;
        let caption: String = caption.chars().take(most).collect();
        let height = letter.height as i32;
        let width = caption.chars().count() as i32 * letter.width as i32;
        let at = Point::new(2 * height, 2 * height + height / 2);
        self.veil([at.x - height / 2, at.y - height], [at.x + width + height / 2, at.y + height / 2]);
        let Ok(_) = Text::new(&caption, at, MonoTextStyle::new(font, INK)).draw(&mut Paper(self));
    }

    /// Fades the pixels between two corners into the background, so that letters on them can be read.
    fn veil(&mut self, from: [i32; 2], to: [i32; 2]) {
        let clipped = |at: [i32; 2]| [0, 1].map(|axis| at[axis].clamp(0, self.size[axis] as i32) as usize);
        let ([left, top], [right, bottom]) = (clipped(from), clipped(to));
        let paper = bytes(palette::BACKGROUND);
        let width = self.size[0] as usize;
        for row in top..bottom {
            for pixel in self.pixels[4 * (row * width + left)..4 * (row * width + right)].chunks_exact_mut(4)
            {
                for (value, paper) in pixel.iter_mut().zip(paper) {
                    let mixed = VEIL * u32::from(*value) + (256 - VEIL) * u32::from(paper);
                    *value = ((mixed + 128) / 256) as u8;
                }
            }
        }
    }

    /// Small pictures get small letters, smaller ones none.
    fn font(&self) -> Option<&'static MonoFont<'static>> {
        match self.size[0].min(self.size[1]) {
            900.. => Some(&FONT_10X20),
            300.. => Some(&FONT_7X13),
            _ => None,
        }
    }

    /// Two pictures of the same height as one.
    #[must_use]
    pub fn beside(&self, right: &Image) -> Image {
        let row = |image: &Image| 4 * image.size[0] as usize;
        let rows = self.pixels.chunks_exact(row(self)).zip(right.pixels.chunks_exact(row(right)));
        let pixels = rows.flat_map(|(left, right)| left.iter().chain(right)).copied().collect();
        Image { size: [self.size[0] + right.size[0], self.size[1].min(right.size[1])], pixels }
    }

    fn draw_scale(&mut self, title: &str, scale: &[[f32; 3]; 5], marks: &[(f32, String)]) {
        let height = self.size[1] as i32;
        let Some(font) = self.font() else { return };
        let letter = font.character_size.height as i32;
        let bar = [16 * letter, letter * 4 / 5];
        let margin = 2 * letter;
        let (left, top) = (margin, height - margin - bar[1] - letter);
        let ink = MonoTextStyle::new(font, INK);
        let space = letter / 2;
        let from = [left - space, top - letter - 3 * space / 2];
        self.veil(from, [left + bar[0] + space, top + bar[1] + letter + space]);
        let mut paper = Paper(self);
        let text = |paper: &mut Paper<'_>, text: &str, x: i32, y: i32, alignment: Alignment| {
            let Ok(_) = Text::with_alignment(text, Point::new(x, y), ink, alignment).draw(paper);
        };
        text(&mut paper, title, left, top - letter / 2, Alignment::Left);
        for x in 0..bar[0] {
            let [red, green, blue] = bytes(along(scale, x as f32 / (bar[0] - 1) as f32));
            let colour = Rgb888::new(red, green, blue);
            let Ok(()) = paper.draw_iter((0..bar[1]).map(|y| Pixel(Point::new(left + x, top + y), colour)));
        }
        for (place, mark) in marks {
            let alignment = match *place {
                0.0 => Alignment::Left,
                1.0 => Alignment::Right,
                _ => Alignment::Center,
            };
            let x = left + (place * (bar[0] - 1) as f32) as i32;
            text(&mut paper, mark, x, top + bar[1] + letter, alignment);
        }
    }
}

/// Three digits.
fn short(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e4).contains(&size) {
        let digits = (2 - size.log10().floor() as i32).max(0) as usize;
        format!("{x:.digits$}")
    } else {
        format!("{x:.2e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        for (x, text) in
            [(0.0, "0"), (1.0, "1.00"), (-0.012345, "-0.0123"), (123.4, "123"), (5e-7, "5.00e-7")]
        {
            assert_eq!(short(x), text);
        }
    }

    #[test]
    fn maps_have_a_scale_and_others_have_none() {
        let blank = Image::filled([320, 320], [255; 4]);
        let mut map = blank.clone();
        map.add_legend(&Style::Curvature { quantity: Quantity::Mean, limit: None }, 0.25);
        assert_ne!(map, blank);
        let mut shaded = blank.clone();
        shaded.add_legend(&Style::Shaded, 0.25);
        assert_eq!(shaded, blank);
        shaded.add_caption("a body");
        assert_ne!(shaded, blank);
    }

    #[test]
    fn letters_stand_out_from_whatever_is_behind_them() {
        let mut dark = Image::filled([320, 320], [0, 0, 0, 255]);
        dark.add_caption("a body");
        dark.add_legend(&Style::Curvature { quantity: Quantity::Mean, limit: None }, 0.25);
        // Beside the first letter, and beside the last number.
        for [x, y] in [[22, 30], [238, 298]] {
            assert!(dark.pixel(x, y)[..3].iter().all(|&value| value > 150), "{:?}", dark.pixel(x, y));
        }
        assert_eq!(dark.pixel(160, 160), [0, 0, 0, 255]);
    }

    #[test]
    fn pictures_stand_side_by_side() {
        let (left, right) = (Image::filled([3, 2], [1; 4]), Image::filled([2, 2], [2; 4]));
        let both = left.beside(&right);
        assert_eq!((both.size, both.pixels.len()), ([5, 2], 40));
        assert_eq!((both.pixel(2, 1), both.pixel(3, 1)), ([1; 4], [2; 4]));
    }
}
