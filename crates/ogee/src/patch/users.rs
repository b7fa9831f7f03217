//! `Users`: what depends on a vertex of the cage, for cages that are edited.

use super::PatchTable;
use super::tree::{Node, Piece};
use crate::mesh::VertexId;

/// For each vertex of the cage the local points whose rows name it, and for each point the parametric faces that use it.
#[derive(Clone, Debug)]
pub(super) struct Users {
    local_points: Lists,
    faces: Lists,
}

/// A list for each number below a count.
#[derive(Clone, Debug)]
struct Lists {
    starts: Vec<u32>,
    entries: Vec<u32>,
}

impl Lists {
    /// From pairs of a number and an entry of its list.
    fn new(count: usize, pairs: &[(u32, u32)]) -> Lists {
        let mut starts = vec![0u32; count + 1];
        for &(number, _) in pairs {
            starts[number as usize + 1] += 1;
        }
        for number in 0..count {
            starts[number + 1] += starts[number];
        }
        let mut next = starts.clone();
        let mut entries = vec![0; pairs.len()];
        for &(number, entry) in pairs {
            let slot = &mut next[number as usize];
            entries[*slot as usize] = entry;
            *slot += 1;
        }
        Lists { starts, entries }
    }

    fn of(&self, number: u32) -> &[u32] {
        let number = number as usize;
        &self.entries[self.starts[number] as usize..self.starts[number + 1] as usize]
    }
}

impl Users {
    fn new(table: &PatchTable) -> Users {
        let mut pairs = Vec::new();
        for row in 0..table.local.len() {
            pairs.extend(table.local.row(row).map(|(vertex, _)| (vertex, row as u32)));
        }
        let local_points = Lists::new(table.cage_count, &pairs);
        pairs.clear();
        let mut sources = Vec::new();
        for root in 0..table.len() as u32 {
            sources.clear();
            match table.root_leaf(root) {
                Some(net) => sources.extend_from_slice(net),
                None if table.is_visible(root as usize) => {
                    gather(table, table.root_node(root), &mut sources);
                }
                None => {}
            }
            sources.sort_unstable();
            sources.dedup();
            pairs.extend(sources.iter().map(|&point| (point, root)));
        }
        Users { local_points, faces: Lists::new(table.cage_count + table.local.len(), &pairs) }
    }
}

/// The points of all pieces below a node.
fn gather(table: &PatchTable, node: Node, out: &mut Vec<u32>) {
    match node.piece() {
        Piece::Leaf(index) => out.extend_from_slice(table.leaf(index)),
        Piece::Tail(index) => out.extend_from_slice(table.ring(table.tail(index))),
        Piece::Split(index) => {
            for &child in table.split(index) {
                gather(table, child, out);
            }
        }
    }
}

impl PatchTable {
    fn users(&self) -> &Users {
        self.users.get_or_init(|| Users::new(self))
    }

    /// The local points whose rows name a vertex of the cage.
    pub(crate) fn local_points_of(&self, vertex: VertexId) -> &[u32] {
        self.users().local_points.of(vertex.0)
    }

    /// Numbers of the visible parametric faces whose surface a vertex of the cage has a part in, in order: all others
    /// stay as they are when it moves.
    ///
    /// The first call for a table builds an index, which costs about as much as the table did and 80 bytes a face.
    ///
    /// # Panics
    /// If the cage has no such vertex.
    pub fn seen_by(&self, vertex: VertexId) -> Vec<usize> {
        assert!(vertex.index() < self.cage_count, "the cage has {} vertices", self.cage_count);
        let users = self.users();
        let mut faces = users.faces.of(vertex.0).to_vec();
        for &row in users.local_points.of(vertex.0) {
            faces.extend_from_slice(users.faces.of(self.cage_count as u32 + row));
        }
        faces.sort_unstable();
        faces.dedup();
        faces.into_iter().map(|face| face as usize).filter(|&face| self.is_visible(face)).collect()
    }
}
