//! Colours: linear while they are mixed, sRGB in files.

/// Linear red, green and blue.
pub type Colour = [f32; 3];

/// A colour as it is written on screens, 0 to 255.
const fn anchor(red: u8, green: u8, blue: u8) -> [f32; 3] {
    [red as f32 / 255.0, green as f32 / 255.0, blue as f32 / 255.0]
}

/// From strongly negative over zero to strongly positive: cool, grey, warm, of even change in brightness.
pub const DIVERGING: [[f32; 3]; 5] = [
    anchor(59, 76, 192),
    anchor(141, 176, 254),
    anchor(221, 221, 221),
    anchor(245, 156, 125),
    anchor(180, 4, 38),
];

/// From nothing to much: dark violet to yellow.
pub const RISING: [[f32; 3]; 5] = [
    anchor(38, 20, 72),
    anchor(94, 40, 130),
    anchor(176, 60, 110),
    anchor(240, 120, 60),
    anchor(250, 220, 120),
];

/// The colour of a scale at `x` from 0 to 1; the ends beyond.
#[inline]
pub fn along(scale: &[[f32; 3]; 5], x: f32) -> Colour {
    let x = 4.0 * x.clamp(0.0, 1.0);
    let first = (x as usize).min(3);
    let part = x - first as f32;
    std::array::from_fn(|k| decode(scale[first][k] + part * (scale[first + 1][k] - scale[first][k])))
}

/// Between two colours.
#[inline]
pub fn mix(a: Colour, b: Colour, part: f32) -> Colour {
    std::array::from_fn(|k| a[k] + part * (b[k] - a[k]))
}

/// A colour made brighter or darker.
#[inline]
pub fn scaled(colour: Colour, factor: f32) -> Colour {
    colour.map(|x| factor * x)
}

/// From sRGB, 0 to 1, to linear.
#[inline]
pub fn decode(x: f32) -> f32 {
    if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

/// From linear to sRGB, 0 to 1.
#[inline]
pub fn encode(x: f32) -> f32 {
    let x = x.clamp(0.0, 1.0);
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

/// A colour as screens and files want it.
#[inline]
pub fn bytes(colour: Colour) -> [u8; 3] {
    colour.map(|x| (255.0 * encode(x) + 0.5) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encoding_and_decoding_are_inverse_and_scales_end_where_they_say() {
        for byte in 0..=255u8 {
            let x = f32::from(byte) / 255.0;
            assert!((encode(decode(x)) - x).abs() < 1e-6);
        }
        assert_eq!(along(&DIVERGING, -1.0), along(&DIVERGING, 0.0));
        assert_eq!(along(&DIVERGING, 0.5), DIVERGING[2].map(decode));
        for (x, end) in [(2.0, DIVERGING[4]), (-1.0, DIVERGING[0])] {
            let (colour, end) = (along(&DIVERGING, x), end.map(decode));
            assert!((0..3).all(|k| (colour[k] - end[k]).abs() < 1e-6));
        }
    }
}
