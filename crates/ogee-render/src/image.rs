//! `Image`: pixels, and PNG in and out; `Light`: a picture on a light plane, at every scale.

use std::io::{self, Cursor};

use crate::colour::decode;

/// Pixels of red, green, blue and opacity, row by row from the top left, encoded as sRGB.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Width and height.
    pub size: [u32; 2],
    /// `4 * width * height` numbers.
    pub pixels: Vec<u8>,
}

/// Why a picture was not read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImageError {
    /// It is no PNG, or a broken one.
    #[error("this is no PNG that can be read: {0}")]
    Decoding(#[from] png::DecodingError),
    /// It has more pixels than memory is meant for.
    #[error("{width} x {height} pixels are too many; {most} are the most")]
    TooLarge {
        /// Its width.
        width: u32,
        /// Its height.
        height: u32,
        /// The most.
        most: usize,
    },
}

/// Pixels of a picture on a light plane, at most.
const MOST: usize = 1 << 26;

impl Image {
    /// All pixels alike.
    pub fn filled(size: [u32; 2], colour: [u8; 4]) -> Image {
        Image { size, pixels: colour.repeat(size[0] as usize * size[1] as usize) }
    }

    /// The pixel in column `x` of row `y`.
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        let first = 4 * (y as usize * self.size[0] as usize + x as usize);
        std::array::from_fn(|k| self.pixels[first + k])
    }

    /// Writes a PNG.
    ///
    /// # Errors
    /// What `out` reports.
    pub fn write_png(&self, out: impl io::Write) -> io::Result<()> {
        let mut encoder = png::Encoder::new(out, self.size[0], self.size[1]);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.pixels)?;
        Ok(writer.finish()?)
    }

    /// Reads a PNG of any kind.
    ///
    /// # Errors
    /// If it is none, a broken one, or larger than memory is meant for.
    pub fn read_png(bytes: &[u8]) -> Result<Image, ImageError> {
        let mut decoder = png::Decoder::new(Cursor::new(bytes));
        decoder
            .set_transformations(png::Transformations::normalize_to_color8() | png::Transformations::ALPHA);
        let mut reader = decoder.read_info()?;
        let (width, height) = (reader.info().width, reader.info().height);
        let count = width as usize * height as usize;
        if count > MOST {
            return Err(ImageError::TooLarge { width, height, most: MOST });
        }
        let mut data = vec![0; reader.output_buffer_size().unwrap_or(8 * count)];
        let info = reader.next_frame(&mut data)?;
        data.truncate(info.buffer_size());
        let pixels = match info.color_type {
            png::ColorType::GrayscaleAlpha => {
                data.chunks_exact(2).flat_map(|p| [p[0], p[0], p[0], p[1]]).collect()
            }
            _ => data,
        };
        Ok(Image { size: [width, height], pixels })
    }
}

/// A picture as light: linear colours at every scale, each half as large as the one before.
#[derive(Clone, Debug)]
pub struct Light {
    /// From the largest to a single pixel; each with its size.
    pub levels: Vec<([u32; 2], Vec<[f32; 3]>)>,
}

impl Light {
    /// All scales of a picture; what is not opaque is dark.
    pub fn new(image: &Image) -> Light {
        let bright = |x: u8| decode(f32::from(x) / 255.0);
        let full: Vec<[f32; 3]> = image
            .pixels
            .chunks_exact(4)
            .map(|p| [p[0], p[1], p[2]].map(|x| bright(x) * f32::from(p[3]) / 255.0))
            .collect();
        let mut levels = vec![(image.size, full)];
        while let Some(([width, height], last)) = levels.last().filter(|(size, _)| size[0] > 1 || size[1] > 1)
        {
            let size = [width.div_ceil(2), height.div_ceil(2)];
            let pixel = |x: u32, y: u32| {
                let at = |x: u32, y: u32| last[(y.min(height - 1) * width + x.min(width - 1)) as usize];
                let four =
                    [at(2 * x, 2 * y), at(2 * x + 1, 2 * y), at(2 * x, 2 * y + 1), at(2 * x + 1, 2 * y + 1)];
                std::array::from_fn(|k| 0.25 * four.iter().map(|colour| colour[k]).sum::<f32>())
            };
            let next = (0..size[1])
                .flat_map(|y| (0..size[0]).map(move |x| (x, y)))
                .map(|(x, y)| pixel(x, y))
                .collect();
            levels.push((size, next));
        }
        Light { levels }
    }

    /// The colour at a place of the plane, with the picture's width from `-half` to `half` and its top towards the second
    /// axis, averaged over `spread`; `None` beside the picture.
    pub fn at(&self, [x, y]: [f64; 2], half: f64, spread: f64) -> Option<[f32; 3]> {
        let ([width, height], _) = self.levels.first()?;
        let tall = half * f64::from(*height) / f64::from(*width);
        if !(x.abs() <= half && y.abs() <= tall) {
            return None;
        }
        let (s, t) = ((x / half + 1.0) / 2.0, (1.0 - y / tall) / 2.0);
        let texels = spread / (2.0 * half) * f64::from(*width);
        let level = texels.max(1.0).log2().min((self.levels.len() - 1) as f64);
        let fine = level as usize;
        let coarse = (fine + 1).min(self.levels.len() - 1);
        let part = (level - fine as f64) as f32;
        let (a, b) = (self.level_at(fine, s, t), self.level_at(coarse, s, t));
        Some(std::array::from_fn(|k| a[k] + part * (b[k] - a[k])))
    }

    /// Between the four nearest pixels of one scale.
    fn level_at(&self, level: usize, s: f64, t: f64) -> [f32; 3] {
        let ([width, height], pixels) = &self.levels[level];
        let split = |x: f64, count: u32| {
            let x = (x * f64::from(count) - 0.5).clamp(0.0, f64::from(count - 1));
            let first = x as u32;
            (first, (first + 1).min(count - 1), (x - f64::from(first)) as f32)
        };
        let ((x0, x1, dx), (y0, y1, dy)) = (split(s, *width), split(t, *height));
        let at = |x: u32, y: u32| pixels[(y * width + x) as usize];
        let four = [at(x0, y0), at(x1, y0), at(x0, y1), at(x1, y1)];
        std::array::from_fn(|k| {
            let (top, bottom) =
                (four[0][k] + dx * (four[1][k] - four[0][k]), four[2][k] + dx * (four[3][k] - four[2][k]));
            top + dy * (bottom - top)
        })
    }
}
