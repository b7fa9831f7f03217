//! How much there is in a piece of a file: what has to be known before pieces can be read one beside the other.

use super::statements::{Kind, Statements};

/// How much there is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    pub(super) lines: usize,
    pub(super) vertices: usize,
    pub(super) texture_coordinates: usize,
    pub(super) faces: usize,
    /// At least as many corners of faces as there are; more where there are comments and wide gaps.
    pub(super) corners: usize,
}

impl Counts {
    /// With what comes next.
    pub(super) fn and(self, next: Counts) -> Counts {
        Counts {
            lines: self.lines + next.lines,
            vertices: self.vertices + next.vertices,
            texture_coordinates: self.texture_coordinates + next.texture_coordinates,
            faces: self.faces + next.faces,
            corners: self.corners + next.corners,
        }
    }
}

/// Counts what is in a piece of a file; `None` if it has a zero byte, which no text has.
pub(super) fn survey(piece: &[u8]) -> Option<Counts> {
    let mut counts = Counts::default();
    let mut statements = Statements::new(piece);
    for statement in statements.by_ref() {
        match Kind::of(&statement.text) {
            Kind::Vertex => counts.vertices += 1,
            Kind::TextureCoordinate => counts.texture_coordinates += 1,
            Kind::Face => {
                counts.faces += 1;
                counts.corners += statement.blanks;
            }
            Kind::Nothing | Kind::Other => {}
        }
    }
    counts.lines = statements.lines();
    (!statements.has_zero()).then_some(counts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_is_counted() {
        let text = b"# a\nv 1 2 3\r\n v\nvt 1\nvn 1 2 3\nf 1 2 \\\n3\nfo\nt f";
        let counts = Counts { lines: 9, vertices: 2, texture_coordinates: 1, faces: 2, corners: 4 };
        assert_eq!(survey(text), Some(counts));
        assert_eq!(survey(b"v 1 2 3\nv 1 \0 3\n"), None);
    }
}
