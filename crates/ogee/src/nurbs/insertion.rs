//! Knot insertion and Bezier pieces: the same curve or surface with more knots, exactly.
//!
//! Boehm's algorithm: a new knot replaces `degree - 1` coefficients by `degree` convex combinations of
//! neighbours. A knot raised to multiplicity `degree` cuts a spline into polynomial pieces, whose coefficients
//! are then those of Bezier.

use super::{KnotVector, NurbsCurve, NurbsSurface};
use crate::math::{Grid, Vec3};

impl KnotVector {
    /// These knots with `knot` once more.
    ///
    /// # Panics
    /// If `knot` lies outside the open domain or stands `degree` times already.
    pub fn with_knot(&self, knot: f64) -> KnotVector {
        let [least, greatest] = self.domain();
        assert!(least < knot && knot < greatest, "only inner knots can be inserted");
        let mut knots = self.knots().to_vec();
        let place = knots.partition_point(|&other| other <= knot);
        knots.insert(place, knot);
        KnotVector::new(self.degree(), knots)
    }

    /// The distinct knots: the ends of the polynomial pieces.
    pub fn breaks(&self) -> Vec<f64> {
        let mut breaks = self.knots().to_vec();
        breaks.dedup();
        breaks
    }

    /// The knots to insert, in order, until every inner knot stands `degree` times.
    fn missing_for_bezier(&self) -> Vec<f64> {
        let all = self.multiplicities();
        let inner = &all[1..all.len() - 1];
        inner.iter().flat_map(|&(knot, times)| std::iter::repeat_n(knot, self.degree() - times)).collect()
    }
}

/// The coefficients of one row after `knot` was inserted once into `knots`.
fn insert(knots: &KnotVector, points: &[Vec3], knot: f64) -> Vec<Vec3> {
    let degree = knots.degree();
    let t = knots.knots();
    // t[last] <= knot < t[last + 1]
    let last = t.partition_point(|&other| other <= knot) - 1;
    (0..=points.len())
        .map(|i| {
            if i + degree <= last {
                points[i]
            } else if i > last {
                points[i - 1]
            } else {
                let share = (knot - t[i]) / (t[i + degree] - t[i]);
                points[i - 1].lerp(points[i], share)
            }
        })
        .collect()
}

/// The knots of one Bezier piece.
fn bezier_knots(degree: usize, from: f64, to: f64) -> KnotVector {
    KnotVector::from_multiplicities(degree, [(from, degree + 1), (to, degree + 1)])
}

impl NurbsCurve {
    /// The same curve with `knot` once more among its knots.
    ///
    /// # Panics
    /// As [`KnotVector::with_knot`].
    pub fn with_knot(&self, knot: f64) -> NurbsCurve {
        let knots = self.knots.with_knot(knot);
        NurbsCurve { points: insert(&self.knots, &self.points, knot), knots }
    }

    /// The polynomial pieces in order, each over its own knot span; neighbours share their end coefficient.
    pub fn bezier_pieces(&self) -> Vec<NurbsCurve> {
        let degree = self.knots.degree();
        let missing = self.knots.missing_for_bezier();
        let refined = missing.iter().fold(self.clone(), |curve, &knot| curve.with_knot(knot));
        let breaks = self.knots.breaks();
        breaks
            .windows(2)
            .enumerate()
            .map(|(i, span)| NurbsCurve {
                knots: bezier_knots(degree, span[0], span[1]),
                points: refined.points[i * degree..=(i + 1) * degree].to_vec(),
            })
            .collect()
    }
}

impl NurbsSurface {
    /// The same surface with `u` and `v` exchanged.
    fn exchanged(&self) -> NurbsSurface {
        NurbsSurface { u: self.v.clone(), v: self.u.clone(), net: self.net.transposed() }
    }

    /// The same surface with `knot` once more among its knots along `u`.
    ///
    /// # Panics
    /// As [`KnotVector::with_knot`].
    pub fn with_knot_u(&self, knot: f64) -> NurbsSurface {
        self.exchanged().with_knot_v(knot).exchanged()
    }

    /// The same surface with `knot` once more among its knots along `v`.
    ///
    /// # Panics
    /// As [`KnotVector::with_knot`].
    pub fn with_knot_v(&self, knot: f64) -> NurbsSurface {
        let v = self.v.with_knot(knot);
        let rows: Vec<Vec<Vec3>> =
            (0..self.net.rows()).map(|i| insert(&self.v, self.net.row(i), knot)).collect();
        let net = Grid::from_fn(rows.len(), v.coefficients(), |i, j| rows[i][j]);
        NurbsSurface { u: self.u.clone(), v, net }
    }

    /// The polynomial pieces, each over its own knot spans: `pieces[(i, j)]`, `i` along `u`. Neighbours share
    /// their boundary row.
    ///
    /// ```
    /// use ogee::nurbs::{KnotVector, NurbsSurface};
    /// use ogee::{Grid, Vec3};
    ///
    /// let u = KnotVector::from_multiplicities(3, [(0.0, 4), (1.0, 2), (2.0, 4)]);
    /// let v = KnotVector::from_multiplicities(3, [(0.0, 4), (1.0, 4)]);
    /// let net = Grid::from_fn(6, 4, |i, j| Vec3::new(i as f64, j as f64, (i * j) as f64));
    /// let pieces = NurbsSurface { u, v, net }.bezier_pieces();
    /// assert_eq!((pieces.rows(), pieces.cols()), (2, 1));
    /// assert_eq!(pieces[(0, 0)].net.row(3), pieces[(1, 0)].net.row(0));
    /// ```
    pub fn bezier_pieces(&self) -> Grid<NurbsSurface> {
        let along_v = self.v.missing_for_bezier();
        let refined = along_v.iter().fold(self.clone(), |surface, &knot| surface.with_knot_v(knot));
        let along_u = self.u.missing_for_bezier();
        let refined =
            along_u.iter().fold(refined.exchanged(), |surface, &knot| surface.with_knot_v(knot)).exchanged();

        let [p, q] = [self.u.degree(), self.v.degree()];
        let [breaks_u, breaks_v] = [self.u.breaks(), self.v.breaks()];
        Grid::from_fn(breaks_u.len() - 1, breaks_v.len() - 1, |i, j| NurbsSurface {
            u: bezier_knots(p, breaks_u[i], breaks_u[i + 1]),
            v: bezier_knots(q, breaks_v[j], breaks_v[j + 1]),
            net: Grid::from_fn(p + 1, q + 1, |a, b| refined.net[(i * p + a, j * q + b)]),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// De Boor's algorithm from its recursion, for comparison.
    fn point_at(curve: &NurbsCurve, t: f64) -> Vec3 {
        let (p, knots) = (curve.knots.degree(), curve.knots.knots());
        let span = (knots.partition_point(|&k| k <= t) - 1).clamp(p, curve.points.len() - 1);
        let mut d: Vec<Vec3> = (0..=p).map(|j| curve.points[span - p + j]).collect();
        for round in 1..=p {
            for j in (round..=p).rev() {
                let i = span - p + j;
                let share = (t - knots[i]) / (knots[i + p + 1 - round] - knots[i]);
                d[j] = d[j - 1].lerp(d[j], share);
            }
        }
        d[p]
    }

    fn curve() -> NurbsCurve {
        let knots =
            KnotVector::from_multiplicities(3, [(0.0, 4), (1.0, 2), (2.0, 1), (4.0, 3), (5.0, 1), (7.0, 4)]);
        let points = (0..knots.coefficients())
            .map(|i| Vec3::new(i as f64, (i * i % 7) as f64, (i * 5 % 3) as f64 - 1.0))
            .collect();
        NurbsCurve { knots, points }
    }

    #[test]
    fn inserting_a_knot_keeps_the_curve() {
        let curve = curve();
        for knot in [0.3, 1.0, 2.0, 3.5, 5.0, 6.99] {
            if curve.knots.multiplicities().iter().any(|&(k, times)| k == knot && times == 3) {
                continue;
            }
            let refined = curve.with_knot(knot);
            assert_eq!(refined.points.len(), curve.points.len() + 1);
            for step in 0..=70 {
                let t = f64::from(step) / 10.0;
                assert!(point_at(&curve, t).distance(point_at(&refined, t)) < 1e-13, "knot {knot} at {t}");
            }
        }
    }

    #[test]
    fn bezier_pieces_are_the_curve_between_knots() {
        let curve = curve();
        let pieces = curve.bezier_pieces();
        assert_eq!(pieces.len(), 5);
        for piece in &pieces {
            let [a, b] = piece.knots.domain();
            assert_eq!(piece.points.len(), 4);
            for step in 0..=10 {
                let t = a + (b - a) * f64::from(step) / 10.0;
                assert!(point_at(&curve, t).distance(point_at(piece, t)) < 1e-13);
            }
        }
        assert_eq!(pieces[0].points[0], curve.points[0]);
        assert_eq!(pieces[4].points[3], curve.points[curve.points.len() - 1]);
    }

    #[test]
    fn a_double_knot_gives_the_midpoint() {
        // pccm.md 16: the piece [0, 1] is Q0, Q1, Q2, (Q2 + Q4) / 2 where the spans are equal.
        let knots = KnotVector::from_multiplicities(3, [(0.0, 4), (1.0, 2), (2.0, 4)]);
        let points: Vec<Vec3> = (0..6).map(|i| Vec3::new(f64::from(i), f64::from(i * i), 0.0)).collect();
        let pieces = NurbsCurve { knots, points: points.clone() }.bezier_pieces();
        assert_eq!(pieces[0].points, [points[0], points[1], points[2], points[2].lerp(points[3], 0.5)]);
    }

    #[test]
    fn surface_pieces_share_their_rows() {
        let u = KnotVector::from_multiplicities(3, [(0.0, 4), (1.0, 1), (3.0, 4)]);
        let v = KnotVector::from_multiplicities(2, [(0.0, 3), (1.0, 1), (2.0, 2), (3.0, 3)]);
        let net =
            Grid::from_fn(5, 6, |i, j| Vec3::new(i as f64, j as f64, ((i * 3 + j * 5) % 4) as f64 / 3.0));
        let surface = NurbsSurface { u: u.clone(), v: v.clone(), net: net.clone() };
        let pieces = surface.bezier_pieces();
        assert_eq!((pieces.rows(), pieces.cols()), (2, 3));
        for j in 0..3 {
            assert_eq!(pieces[(0, j)].net.row(3), pieces[(1, j)].net.row(0));
        }
        // The boundary row of the surface is cut as the curve it is.
        let row = NurbsCurve { knots: v, points: net.row(0).to_vec() };
        for (j, piece) in row.bezier_pieces().iter().enumerate() {
            assert_eq!(pieces[(0, j)].net.row(0), piece.points);
        }
        let more = surface.with_knot_u(2.0);
        assert_eq!((more.net.rows(), more.net.cols()), (6, 6));
        assert_eq!(more.net.row(0), surface.net.row(0));
    }
}
