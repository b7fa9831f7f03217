//! Whether two programs made the same mesh, in whatever order its vertices are: by means of coordinates and of their
//! products, area and volume.

use anyhow::{Context, Result};
use serde_json::Value;

/// Greatest difference where all arithmetic is double.
const DOUBLE: f64 = 1e-10;

/// Greatest difference of a program that computes in single precision.
const SINGLE: f64 = 1e-5;

/// Numbers that two programs must agree on.
pub(super) struct Figures {
    pub(super) vertices: u64,
    pub(super) faces: u64,
    values: Vec<f64>,
}

/// The precision of a program.
#[derive(Clone, Copy)]
pub(super) enum Precision {
    Single,
    Double,
}

impl Figures {
    /// Reads them from an answer.
    pub(super) fn read(answer: &Value) -> Result<Figures> {
        let count = |key: &str| answer[key].as_u64().context("an answer lacks a count");
        let values = answer["figures"].as_array().context("an answer lacks figures")?;
        let values = values.iter().map(|value| value.as_f64().unwrap_or(f64::NAN)).collect();
        Ok(Figures { vertices: count("vertices")?, faces: count("faces")?, values })
    }

    /// What positions (three 64-bit numbers) and quads (four 32-bit ones) of this mesh take.
    pub(super) fn bytes(&self) -> u64 {
        24 * self.vertices + 16 * self.faces
    }

    /// What a table says of another's figures: how far they are from these, relative to the size of the mesh, or that
    /// they are not the same mesh.
    pub(super) fn compare(&self, other: &Figures, precision: Precision) -> String {
        if (self.vertices, self.faces) != (other.vertices, other.faces) {
            return format!("DIFFERS: {} faces, {} vertices", other.faces, other.vertices);
        }
        let difference = self.difference(other);
        let bound = match precision {
            Precision::Single => SINGLE,
            Precision::Double => DOUBLE,
        };
        let word = if difference <= bound { "same" } else { "DIFFERS" };
        format!("{word}, {difference:.0e}")
    }

    /// The greatest difference. Coordinates are compared with the root of the mean of their squares, products with its
    /// square, the area with itself and the volume with the area and that root.
    fn difference(&self, other: &Figures) -> f64 {
        let size = self.values[3..6].iter().sum::<f64>().sqrt();
        let scale = |k: usize| match k {
            0..3 => size,
            3..9 => size * size,
            9 => self.values[9],
            _ => self.values[9] * size,
        };
        let pairs = self.values.iter().zip(&other.values).enumerate();
        let differences = pairs.map(|(k, (own, its))| (own - its).abs() / scale(k));
        differences.fold(0.0, |worst, next| if next.is_nan() { f64::INFINITY } else { worst.max(next) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figures(vertices: u64, values: [f64; 11]) -> Figures {
        Figures { vertices, faces: 6, values: values.to_vec() }
    }

    #[test]
    fn a_difference_is_seen_in_every_figure() {
        let values = [1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 2.0, 3.0, 4.0, 20.0, 10.0];
        let own = figures(8, values);
        assert_eq!(own.compare(&figures(8, values), Precision::Double), "same, 0e0");
        for k in 0..11 {
            let mut others = values;
            others[k] += 1e-6;
            assert!(own.compare(&figures(8, others), Precision::Double).starts_with("DIFFERS"), "figure {k}");
            assert!(own.compare(&figures(8, others), Precision::Single).starts_with("same"), "figure {k}");
            others[k] = f64::NAN;
            assert!(own.compare(&figures(8, others), Precision::Single).starts_with("DIFFERS"), "figure {k}");
        }
        assert!(own.compare(&figures(9, values), Precision::Single).starts_with("DIFFERS"));
    }
}
