//! Which column is which point of a cap, and the mirror image of a fan.

use super::CapClass;

/// A point of the two-ring, named as on the method's page: first the cells along the edge before the sector, then along the
/// edge after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Node {
    /// The vertex itself.
    Vertex,
    /// The first point of an edge.
    P10(usize),
    /// The second point of an edge.
    P20(usize),
    /// The far corner of a sector's face.
    P11(usize),
    /// Beyond that face, across the side that meets the sector's first edge.
    P21(usize),
    /// Beyond that face, across the side that meets the sector's second edge.
    P12(usize),
    /// Diagonally beyond that face.
    P22(usize),
}

impl CapClass {
    /// True if the sectors go all the way round.
    pub(crate) fn is_closed(self) -> bool {
        matches!(self, CapClass::Interior { .. })
    }

    /// The column of a point. Edges and sectors are counted around the vertex, so that numbers may run over.
    pub(super) fn column(self, node: Node) -> usize {
        let (edges, sectors) = (self.edges(), self.sectors());
        let along = |edge: usize, number: usize| match self {
            CapClass::Interior { .. } => 1 + 6 * (edge % edges) + 2 * number,
            _ => 1 + 2 * (edge % edges) + number,
        };
        let inside = |sector: usize, number: usize| match self {
            CapClass::Interior { .. } => 1 + 6 * (sector % sectors) + [1, 3, 4, 5][number],
            _ => 1 + 2 * edges + 4 * (sector % sectors) + number,
        };
        match node {
            Node::Vertex => 0,
            Node::P10(edge) => along(edge, 0),
            Node::P20(edge) => along(edge, 1),
            Node::P11(sector) => inside(sector, 0),
            Node::P21(sector) => inside(sector, 1),
            Node::P12(sector) => inside(sector, 2),
            Node::P22(sector) => inside(sector, 3),
        }
    }

    /// For each column the one whose point takes its place when the fan is seen in a mirror: around an interior vertex the one
    /// through the middle of sector 0, else the one that exchanges the first sector and the last (Points, sectors, columns on
    /// the page).
    pub(super) fn mirrored_columns(self) -> Vec<usize> {
        let (edges, sectors) = (self.edges(), self.sectors());
        let mut mirrored = vec![0; self.columns()];
        let mut pair = |node: Node, image: Node| mirrored[self.column(node)] = self.column(image);
        for edge in 0..edges {
            let image = match self {
                CapClass::Interior { .. } => edges + 1 - edge,
                _ => sectors - edge,
            };
            pair(Node::P10(edge), Node::P10(image));
            pair(Node::P20(edge), Node::P20(image));
        }
        for sector in 0..sectors {
            let image = self.mirrored_sector(sector);
            pair(Node::P11(sector), Node::P11(image));
            pair(Node::P21(sector), Node::P12(image));
            pair(Node::P12(sector), Node::P21(image));
            pair(Node::P22(sector), Node::P22(image));
        }
        mirrored
    }

    /// The sector that takes the place of another in the mirror.
    pub(super) fn mirrored_sector(self, sector: usize) -> usize {
        match self {
            CapClass::Interior { .. } => (self.sectors() - sector) % self.sectors(),
            _ => self.sectors() - 1 - sector,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::g2_caps::CornerAngle;

    #[test]
    fn mirrors_of_mirrors_are_nothing() {
        for class in [
            CapClass::Interior { valence: 5 },
            CapClass::Boundary { faces: 3 },
            CapClass::Corner { faces: 2, angle: CornerAngle::Concave },
            CapClass::Dart { valence: 4 },
        ] {
            let mirrored = class.mirrored_columns();
            assert!((0..class.columns()).all(|column| mirrored[mirrored[column]] == column));
            assert_eq!(
                mirrored[class.column(Node::P21(1))],
                class.column(Node::P12(class.mirrored_sector(1)))
            );
        }
    }
}
