//! Newton's method for the foot of the perpendicular from a point to a surface, inside a rectangle of parameters.

use super::{SurfaceJet, Vec3};

/// Parameters, and how far the surface is from the point there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    pub(crate) parameters: [f64; 2],
    pub(crate) distance: f64,
    jet: SurfaceJet,
}

/// Of the square of the distance: what rounding hides.
const HIDDEN: f64 = 1e-15;

/// A rectangle: from and to, in each direction.
pub(crate) type Rectangle = [[f64; 2]; 2];

impl Foot {
    /// The foot that Newton's method reaches from a start. Steps that gain nothing are halved; it ends where a step takes
    /// off less than the share `worth` of the distance. `jet` is the surface relative to the point.
    pub(crate) fn from_start(
        start: [f64; 2],
        within: &Rectangle,
        worth: f64,
        jet: impl Fn([f64; 2]) -> SurfaceJet,
    ) -> Foot {
        const STEPS: usize = 20;
        const HALVINGS: usize = 6;
        let mut foot = Foot::at(start, jet(start));
        for _ in 0..STEPS {
            let (step, gain) = foot.step(within);
            if gain <= HIDDEN * foot.distance * foot.distance {
                break;
            }
            let mut scale = 1.0;
            let mut gained = false;
            for _ in 0..HALVINGS {
                let next = foot.moved(step, scale, within, &jet);
                if next.distance < foot.distance {
                    gained = next.distance < foot.distance * (1.0 - worth);
                    foot = next;
                    break;
                }
                scale /= 2.0;
            }
            if !gained {
                break;
            }
        }
        foot
    }

    /// The best of what whole steps of Gauss and Newton pass through, which is not always closer step by step. Points of a
    /// surface as thin as the tip of a cone are reached by no others: the valley there is narrow and bent.
    pub(crate) fn leapt(start: [f64; 2], within: &Rectangle, jet: impl Fn([f64; 2]) -> SurfaceJet) -> Foot {
        const LEAPS: usize = 12;
        let mut foot = Foot::at(start, jet(start));
        let mut best = foot;
        for _ in 0..LEAPS {
            let SurfaceJet { position, du, dv, .. } = foot.jet;
            let flat = SurfaceJet { position, du, dv, ..SurfaceJet::default() };
            let (step, gain) = Foot { jet: flat, ..foot }.step(within);
            if gain <= HIDDEN * foot.distance * foot.distance {
                break;
            }
            foot = foot.moved(step, 1.0, within, &jet);
            if foot.distance < best.distance {
                best = foot;
            }
        }
        best
    }

    /// One more step, if it is small and takes the foot no farther away than by what rounding may do to a distance: near a
    /// foot the distance does not change any more in its last digit while the parameters still want half of theirs.
    #[must_use]
    pub(crate) fn polished(
        self,
        within: &Rectangle,
        rounding: f64,
        jet: impl Fn([f64; 2]) -> SurfaceJet,
    ) -> Foot {
        /// Longer steps have to show in the distance.
        const SMALL: f64 = 1e-5;
        let (step, _) = self.step(within);
        if step.iter().any(|t| t.abs() > SMALL) {
            return self;
        }
        let next = self.moved(step, 1.0, within, jet);
        if next.distance <= self.distance + rounding { next } else { self }
    }

    /// A start, and the surface there relative to the point.
    pub(crate) fn at(parameters: [f64; 2], jet: SurfaceJet) -> Foot {
        Foot { parameters, distance: jet.position.length(), jet }
    }

    /// The foot, relative to the point.
    pub(crate) fn offset(&self) -> Vec3 {
        self.jet.position
    }

    fn moved(
        &self,
        step: [f64; 2],
        scale: f64,
        within: &Rectangle,
        jet: impl Fn([f64; 2]) -> SurfaceJet,
    ) -> Foot {
        let [u, v] = self.parameters;
        let [[u_from, u_to], [v_from, v_to]] = *within;
        let next = [(u + scale * step[0]).clamp(u_from, u_to), (v + scale * step[1]).clamp(v_from, v_to)];
        Foot::at(next, jet(next))
    }

    /// A step towards the foot: Newton's where the distance is convex, else Gauss and Newton's. Where it would leave the
    /// rectangle, the parameter across that side is held. And by how much about it lessens the square of the distance.
    fn step(&self, within: &Rectangle) -> ([f64; 2], f64) {
        /// Of the product on the diagonal: a determinant that rounding may have made.
        const FLAT: f64 = 1e-13;
        /// Of the diagonal: far more than rounding, far less than what is felt.
        const RIDGE: f64 = 1e-12;
        let (jet, offset, [u, v]) = (&self.jet, self.jet.position, self.parameters);
        let [[u_from, u_to], [v_from, v_to]] = *within;
        let (gu, gv) = (offset.dot(jet.du), offset.dot(jet.dv));
        let (e, f, g) = (jet.du.dot(jet.du), jet.du.dot(jet.dv), jet.dv.dot(jet.dv));
        let full = (e + offset.dot(jet.duu), f + offset.dot(jet.duv), g + offset.dot(jet.dvv));
        let convex = full.0 * full.2 > full.1 * full.1 && full.0 > 0.0;
        let (mut a, b, mut c) = if convex { full } else { (e, f, g) };
        let mut determinant = a * c - b * b;
        if determinant <= FLAT * a * c {
            // The surface has shrunk to a line here, and many steps would do: a short one.
            let ridge = RIDGE * (a + c);
            (a, c) = (a + ridge, c + ridge);
            determinant = a * c - b * b;
            if determinant <= 0.0 {
                return ([0.0, 0.0], 0.0);
            }
        }
        let (mut du, mut dv) = (-(c * gu - b * gv) / determinant, -(a * gv - b * gu) / determinant);
        if u + du < u_from || u + du > u_to {
            let held = (u + du).clamp(u_from, u_to) - u;
            (du, dv) = (held, -(gv + b * held) / c);
        }
        if v + dv < v_from || v + dv > v_to {
            let held = (v + dv).clamp(v_from, v_to) - v;
            (du, dv) = (-(gu + b * held) / a, held);
        }
        ([du, dv], -(gu * du + gv * dv))
    }
}
