//! `Bounds`: boxes along the axes; `BoundsTree`: boxes of boxes.

use super::{Vec3, par};

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) lower: Vec3,
    pub(crate) upper: Vec3,
}

impl Bounds {
    /// Around nothing.
    pub(crate) const EMPTY: Bounds = Bounds {
        lower: Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        upper: Vec3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// Around points.
    #[inline]
    pub(crate) fn of(points: impl IntoIterator<Item = Vec3>) -> Bounds {
        points.into_iter().fold(Bounds::EMPTY, |bounds, p| Bounds {
            lower: bounds.lower.min(p),
            upper: bounds.upper.max(p),
        })
    }

    /// Around both.
    #[must_use]
    #[inline]
    pub(crate) fn with(self, other: Bounds) -> Bounds {
        Bounds { lower: self.lower.min(other.lower), upper: self.upper.max(other.upper) }
    }

    /// From a point to the nearest point of the box.
    #[inline]
    pub(crate) fn offset(&self, point: Vec3) -> Vec3 {
        (self.lower - point).max(point - self.upper).max(Vec3::ZERO)
    }

    /// The largest of its coordinates, signs aside.
    pub(crate) fn reach(&self) -> f64 {
        let far = self.upper.max(-self.lower);
        far.x.max(far.y).max(far.z)
    }
}

/// A balanced tree of boxes. A node of several boxes has half of them below either child; nodes stand in the order of
/// a walk, so that numbers say where children are.
#[derive(Clone, Debug)]
pub(crate) struct BoundsTree {
    nodes: Vec<Bounds>,
    order: Vec<u32>,
}

/// A node: its number, and the boxes below it as a range of the tree's order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TreeNode {
    number: u32,
    first: u32,
    count: u32,
}

/// A box to be put into the tree.
#[derive(Clone, Copy)]
struct Entry {
    /// The sum of its ends.
    middle: Vec3,
    index: u32,
}

impl BoundsTree {
    /// A tree of some boxes: sorted by their middles along the longest side, half by half.
    pub(crate) fn new(boxes: &[Bounds]) -> BoundsTree {
        let entry = |i: usize| Entry { middle: boxes[i].lower + boxes[i].upper, index: i as u32 };
        let mut entries: Vec<Entry> = (0..boxes.len()).map(entry).collect();
        let mut nodes = vec![Bounds::EMPTY; (2 * boxes.len()).saturating_sub(1)];
        if !boxes.is_empty() {
            fill(boxes, &mut entries, &mut nodes);
        }
        BoundsTree { nodes, order: entries.into_iter().map(|entry| entry.index).collect() }
    }

    /// The node of all boxes, if there are any.
    pub(crate) fn root(&self) -> Option<TreeNode> {
        (!self.order.is_empty()).then_some(TreeNode { number: 0, first: 0, count: self.order.len() as u32 })
    }

    /// The box of a node.
    #[inline]
    pub(crate) fn bounds(&self, node: TreeNode) -> &Bounds {
        &self.nodes[node.number as usize]
    }

    /// The number of the box if there is but one below the node.
    #[inline]
    pub(crate) fn single(&self, node: TreeNode) -> Option<usize> {
        (node.count == 1).then(|| self.order[node.first as usize] as usize)
    }

    /// Both children of a node of several boxes.
    #[inline]
    pub(crate) fn children(&self, node: TreeNode) -> [TreeNode; 2] {
        let TreeNode { number, first, count } = node;
        let left = count / 2;
        [
            TreeNode { number: number + 1, first, count: left },
            TreeNode { number: number + 2 * left, first: first + left, count: count - left },
        ]
    }
}

/// Sorts entries into a tree, and writes its nodes.
fn fill(boxes: &[Bounds], entries: &mut [Entry], nodes: &mut [Bounds]) {
    /// Fewer are not worth a task of their own.
    const TASK: usize = 2048;
    if let [entry] = entries {
        nodes[0] = boxes[entry.index as usize];
        return;
    }
    let middles = Bounds::of(entries.iter().map(|entry| entry.middle));
    let size = middles.upper - middles.lower;
    let axis = if size.x >= size.y && size.x >= size.z {
        |p: Vec3| p.x
    } else if size.y >= size.z {
        |p: Vec3| p.y
    } else {
        |p: Vec3| p.z
    };
    let (count, half) = (entries.len(), entries.len() / 2);
    // The numbers decide between equals, so that the tree is the same however it is sorted.
    entries.select_nth_unstable_by(half, |a, b| {
        axis(a.middle).total_cmp(&axis(b.middle)).then(a.index.cmp(&b.index))
    });
    let (left, right) = entries.split_at_mut(half);
    let (own, below) = nodes.split_at_mut(1);
    let (left_nodes, right_nodes) = below.split_at_mut(2 * half - 1);
    if count > TASK {
        par::join(|| fill(boxes, left, left_nodes), || fill(boxes, right, right_nodes));
    } else {
        fill(boxes, left, left_nodes);
        fill(boxes, right, right_nodes);
    }
    own[0] = left_nodes[0].with(right_nodes[0]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_box_is_found_once_and_inside_all_above_it() {
        for count in [1, 2, 3, 7, 100, 5000] {
            let at = |i: usize| {
                let t = i as f64;
                Vec3::new((1.3 * t).sin(), (0.7 * t).cos(), (t * t).sin())
            };
            let boxes: Vec<Bounds> = (0..count).map(|i| Bounds::of([at(i), at(i + 1)])).collect();
            let tree = BoundsTree::new(&boxes);
            let mut seen = vec![0; count];
            let mut stack: Vec<TreeNode> = tree.root().into_iter().collect();
            while let Some(node) = stack.pop() {
                if let Some(index) = tree.single(node) {
                    seen[index] += 1;
                    assert_eq!(*tree.bounds(node), boxes[index]);
                    continue;
                }
                for child in tree.children(node) {
                    assert_eq!(tree.bounds(node).with(*tree.bounds(child)), *tree.bounds(node));
                    stack.push(child);
                }
            }
            assert!(seen.iter().all(|&times| times == 1));
        }
        assert!(BoundsTree::new(&[]).root().is_none());
    }
}
