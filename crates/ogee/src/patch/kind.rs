//! `Kind`: what an irregular corner is, as far as its chain depends on it.

use super::meeting;
use crate::math::Vec3;
use crate::mesh::LensShape;

/// What repeats itself around an irregular corner, seen from one of its quads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Kind {
    /// A smooth interior vertex of three faces and more.
    Smooth { valence: u32 },
    /// An interior vertex of valence 2, and the bits of the shape of its rule; `crease` is the edge of a crease that ends
    /// there, counted from the quad's own first.
    Lens { crease: Option<u32>, beta: u64, gamma: u64 },
    /// An interior vertex that stays, no sharp edge at it.
    Cone { valence: u32 },
    /// A vertex where curves meet at so many ports, the first of them along the quad's own first edge or the second; the bits
    /// of the parameter.
    Meeting { ports: u32, port_first: bool, t: u64 },
    /// An interior vertex of three faces and more where one crease ends; `crease` is its edge, counted from the quad's own first.
    Dart { valence: u32, crease: u32 },
    /// A sector beside a crease or boundary.
    Crease { faces: u32, position: u32 },
    /// A sector at a vertex that stays.
    Corner { faces: u32, position: u32 },
}

impl Kind {
    /// An interior vertex of valence 2.
    pub(crate) fn lens(LensShape { beta, gamma }: LensShape, crease: Option<u32>) -> Kind {
        Kind::Lens { crease, beta: beta.to_bits(), gamma: gamma.to_bits() }
    }

    /// The shape of a lens; the usual one elsewhere, where it has no say.
    pub(super) fn lens_shape(self) -> LensShape {
        let Kind::Lens { beta, gamma, .. } = self else { return LensShape::default() };
        LensShape { beta: f64::from_bits(beta), gamma: f64::from_bits(gamma) }
    }

    /// The edge of the crease that ends at the corner, counted from the quad's own first.
    pub(super) fn ending_crease(self) -> Option<u32> {
        match self {
            Kind::Dart { crease, .. } => Some(crease),
            Kind::Lens { crease, .. } => crease,
            Kind::Smooth { .. }
            | Kind::Cone { .. }
            | Kind::Meeting { .. }
            | Kind::Crease { .. }
            | Kind::Corner { .. } => None,
        }
    }

    /// Faces all the way round.
    pub(crate) fn is_closed(self) -> bool {
        !matches!(self, Kind::Crease { .. } | Kind::Corner { .. })
    }

    /// Number of faces around the corner.
    pub(crate) fn faces(self) -> u32 {
        match self {
            Kind::Smooth { valence } | Kind::Cone { valence } | Kind::Dart { valence, .. } => valence,
            Kind::Lens { .. } => 2,
            Kind::Meeting { ports, .. } => 2 * ports,
            Kind::Crease { faces, .. } | Kind::Corner { faces, .. } => faces,
        }
    }

    pub(super) fn position(self) -> u32 {
        match self {
            Kind::Smooth { .. }
            | Kind::Lens { .. }
            | Kind::Cone { .. }
            | Kind::Meeting { .. }
            | Kind::Dart { .. } => 0,
            Kind::Crease { position, .. } | Kind::Corner { position, .. } => position,
        }
    }

    /// False if the quad's first edge at the corner is sharp.
    pub(crate) fn continues_below(self) -> bool {
        match self {
            Kind::Smooth { .. } | Kind::Cone { .. } | Kind::Meeting { .. } => true,
            Kind::Lens { crease, .. } => crease != Some(0),
            Kind::Dart { crease, .. } => crease != 0,
            Kind::Crease { position, .. } | Kind::Corner { position, .. } => position > 0,
        }
    }

    /// False if the quad's other edge at the corner is sharp.
    pub(crate) fn continues_left(self) -> bool {
        match self {
            Kind::Smooth { .. } | Kind::Cone { .. } | Kind::Meeting { .. } => true,
            Kind::Lens { crease, .. } => crease != Some(1),
            Kind::Dart { crease, .. } => crease != 1,
            Kind::Crease { faces, position } | Kind::Corner { faces, position } => position + 1 < faces,
        }
    }

    /// Number of points around the corner, itself included, that decide its limit.
    pub(crate) fn inner_count(self) -> usize {
        2 * self.faces() as usize + if self.is_closed() { 1 } else { 2 }
    }

    /// Number of points of the ring.
    pub(crate) fn ring_count(self) -> usize {
        self.inner_count() + 5 + usize::from(self.continues_below()) + usize::from(self.continues_left())
    }

    /// Where curves meet, the two tangents of each quad, counter-clockwise from the quad that is looked from; none elsewhere.
    /// `ring` has the points around the vertex, relative to it.
    pub(crate) fn meeting_tangents(self, ring: &[Vec3]) -> impl Iterator<Item = [Vec3; 2]> + '_ {
        let (ports, port_first, t) = match self {
            Kind::Meeting { ports, port_first, t } => (ports as usize, port_first, f64::from_bits(t)),
            _ => (0, false, 0.0),
        };
        // Quads take turns: port first, free spoke first.
        let weights = [port_first, !port_first].map(|port_first| match ports {
            0 => [Vec::new(), Vec::new()],
            _ => meeting::tangents(ports, port_first, t),
        });
        (0..2 * ports).map(move |k| {
            [0, 1].map(|which| {
                let around = ring.iter().cycle().skip(2 * k);
                let terms = weights[k % 2][which][1..].iter().zip(around);
                terms.fold(Vec3::ZERO, |sum, (&weight, &p)| sum + weight * p)
            })
        })
    }
}
