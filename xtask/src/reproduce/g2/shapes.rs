//! Eight shapes to compare surfaces on: heights over the natural configuration.

use super::fan::Fan;

/// A shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    Paraboloid,
    Saddle,
    MonkeySaddle,
    Ridge,
    HigherSaddle,
    Noise,
    Bump,
    Cylinder,
}

impl Shape {
    pub(super) const ALL: [Shape; 8] = [
        Shape::Paraboloid,
        Shape::Saddle,
        Shape::MonkeySaddle,
        Shape::Ridge,
        Shape::HigherSaddle,
        Shape::Noise,
        Shape::Bump,
        Shape::Cylinder,
    ];

    /// What it is, with its heights.
    pub(super) fn name(self) -> &'static str {
        match self {
            Shape::Paraboloid => "paraboloid, (x^2 + y^2)/4",
            Shape::Saddle => "saddle, (x^2 - y^2)/5",
            Shape::MonkeySaddle => "monkey saddle, (x^3 - 3 x y^2)/10",
            Shape::Ridge => "ridge with a sharp turn, max(x, y)/2",
            Shape::HigherSaddle => "saddle of higher order, (x^4 - y^4)/10",
            Shape::Noise => "noise, within 0.15 of 0",
            Shape::Bump => "bump, exp(-(x - 0.5)^2 - (y - 0.3)^2)/2",
            Shape::Cylinder => "cylinder, 0.3 x^2",
        }
    }

    /// The fan of a valence in this shape.
    pub(super) fn fan(self, valence: usize) -> Fan {
        let mut noise = noise(1);
        Fan::new(valence, |x, y| match self {
            Shape::Paraboloid => (x * x + y * y) / 4.0,
            Shape::Saddle => (x * x - y * y) / 5.0,
            Shape::MonkeySaddle => (x * x * x - 3.0 * x * y * y) / 10.0,
            Shape::Ridge => x.max(y) / 2.0,
            Shape::HigherSaddle => (x.powi(4) - y.powi(4)) / 10.0,
            Shape::Noise => 0.3 * noise(),
            Shape::Bump => (-(x - 0.5).powi(2) - (y - 0.3).powi(2)).exp() / 2.0,
            Shape::Cylinder => 0.3 * x * x,
        })
    }
}

/// Numbers between -1/2 and 1/2, the same every time.
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1u32 << 31) - 0.5
    }
}
