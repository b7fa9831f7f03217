//! `Image`: pixels, and PNG in and out; `Light`: a picture on a light plane, at every scale.

use std::io::{self, Cursor};

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
    #[error("{0}")]
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
