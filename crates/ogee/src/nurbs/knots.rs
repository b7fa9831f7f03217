//! `KnotVector`: degree and knots of one direction, clamped.

use std::sync::Arc;

/// A clamped knot vector with its degree: first and last knot stand `degree + 1` times.
#[derive(Clone, Debug, PartialEq)]
pub struct KnotVector {
    degree: usize,
    /// A part has millions of knot vectors and few different ones: copies hold one list.
    knots: Arc<[f64]>,
}

impl KnotVector {
    /// A clamped knot vector.
    ///
    /// # Panics
    /// If the knots decrease, are not clamped, or an inner knot stands more than `degree` times.
    pub fn new(degree: usize, knots: Vec<f64>) -> KnotVector {
        assert!(knots.len() >= 2 * (degree + 1), "a clamped knot vector has at least 2 (degree + 1) knots");
        assert!(knots.windows(2).all(|pair| pair[0] <= pair[1]), "knots never decrease");
        let last = knots.len() - 1;
        assert!(
            knots[0] == knots[degree] && knots[last] == knots[last - degree] && knots[0] < knots[last],
            "the ends of a clamped knot vector are (degree + 1)-fold and apart"
        );
        assert!(
            (1..knots.len() - degree - 1).all(|i| knots[i] < knots[i + degree]),
            "an inner knot stands at most degree times"
        );
        KnotVector { degree, knots: knots.into() }
    }

    /// Clamped, from the distinct knots and how often each stands.
    ///
    /// # Panics
    /// As [`KnotVector::new`].
    pub fn from_multiplicities(degree: usize, knots: impl IntoIterator<Item = (f64, usize)>) -> KnotVector {
        let knots = knots.into_iter().flat_map(|(knot, times)| std::iter::repeat_n(knot, times)).collect();
        KnotVector::new(degree, knots)
    }

    /// Polynomial degree.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// All knots, repeated ones repeated.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Number of coefficients that go with these knots.
    pub fn coefficients(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// First and last parameter.
    pub fn domain(&self) -> [f64; 2] {
        [self.knots[0], self.knots[self.knots.len() - 1]]
    }

    /// The knots of the same functions in the other direction, over the same domain.
    pub(crate) fn reversed(&self) -> KnotVector {
        let [start, end] = self.domain();
        KnotVector {
            degree: self.degree,
            knots: self.knots.iter().rev().map(|&knot| start + (end - knot)).collect::<Vec<_>>().into(),
        }
    }

    /// Distinct knots with their multiplicities, as STEP wants them.
    pub fn multiplicities(&self) -> Vec<(f64, usize)> {
        let mut out: Vec<(f64, usize)> = Vec::new();
        for &knot in self.knots.iter() {
            match out.last_mut() {
                Some((last, times)) if *last == knot => *times += 1,
                _ => out.push((knot, 1)),
            }
        }
        out
    }
}

/// Knot vectors that were met: of equal ones only the first is kept.
#[derive(Debug, Default)]
pub(crate) struct SharedKnots(Vec<KnotVector>);

impl SharedKnots {
    /// Where there are more different ones, sharing would cost more than it saves.
    const MOST: usize = 64;

    /// The same knots, with the list of an equal vector that was met before.
    pub(crate) fn share(&mut self, knots: &mut KnotVector) {
        match self.0.iter().find(|known| *known == knots) {
            Some(known) => knots.knots = Arc::clone(&known.knots),
            None if self.0.len() < SharedKnots::MOST => self.0.push(knots.clone()),
            None => {}
        }
    }
}
