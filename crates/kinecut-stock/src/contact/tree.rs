//! Boxes in a tree, to find those that meet another box.

use crate::geom::Aabb;

/// Boxes in a leaf.
const LEAF: usize = 4;

/// A tree of boxes, halved at the median of the longest side.
#[derive(Clone, Debug, Default)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    /// Numbers of the boxes, leaf by leaf, with the boxes.
    boxes: Vec<(u32, Aabb)>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Aabb,
    /// A leaf: its first box. Else: the second child; the first one follows its parent.
    at: u32,
    /// Boxes of a leaf; zero for an inner node.
    count: u32,
}

impl Tree {
    pub(super) fn new(boxes: Vec<Aabb>) -> Tree {
        let mut tree = Tree { nodes: Vec::new(), boxes: (0..).zip(boxes).collect() };
        if !tree.boxes.is_empty() {
            let count = tree.boxes.len();
            tree.split(0, count);
            tree.nodes.shrink_to_fit();
            tree.boxes.shrink_to_fit();
        }
        tree
    }

    /// Memory for so many boxes [bytes].
    pub(super) fn memory(boxes: usize) -> u64 {
        // Leaves hold two boxes at least: nodes are fewer than boxes.
        boxes as u64 * (size_of::<(u32, Aabb)>() + size_of::<Node>()) as u64
    }

    /// Memory that it holds [bytes].
    pub(super) fn memory_held(&self) -> u64 {
        (self.boxes.capacity() * size_of::<(u32, Aabb)>() + self.nodes.capacity() * size_of::<Node>()) as u64
    }

    fn split(&mut self, from: usize, to: usize) {
        let all = &mut self.boxes[from..to];
        let bounds = all.iter().fold(Aabb::EMPTY, |sum, b| sum.union(b.1));
        let node = self.nodes.len();
        self.nodes.push(Node { bounds, at: from as u32, count: (to - from) as u32 });
        if to - from <= LEAF {
            return;
        }
        let size = bounds.size();
        let side = if size.x >= size.y && size.x >= size.z { 0 } else { usize::from(size.z > size.y) + 1 };
        let middle = (to - from) / 2;
        let at = |b: &(u32, Aabb)| b.1.min[side] + b.1.max[side];
        all.select_nth_unstable_by(middle, |a, b| at(a).total_cmp(&at(b)).then(a.0.cmp(&b.0)));
        self.split(from, from + middle);
        self.nodes[node].at = self.nodes.len() as u32;
        self.nodes[node].count = 0;
        self.split(from + middle, to);
    }

    /// Calls a function with the number of each box of which something is true, until it says that it is enough. It has to be true
    /// of a box that holds one of which it is.
    pub(super) fn each_of(&self, is: impl Fn(Aabb) -> bool, mut each: impl FnMut(usize) -> bool) {
        let mut node = 0;
        // The second child of a node is behind all of the first: what is passed over is skipped in one step.
        let mut open = Vec::new();
        while let Some(n) = self.nodes.get(node) {
            let meets = is(n.bounds);
            if meets && n.count == 0 {
                open.push(n.at as usize);
                node += 1;
                continue;
            }
            if meets {
                for (number, bounds) in &self.boxes[n.at as usize..][..n.count as usize] {
                    if is(*bounds) && each(*number as usize) {
                        return;
                    }
                }
            }
            match open.pop() {
                Some(next) => node = next,
                None => return,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use proptest::prelude::*;

    fn boxes() -> impl Strategy<Value = Vec<Aabb>> {
        let one = (prop::array::uniform3(-50.0..50.0f64), prop::array::uniform3(0.0..9.0f64))
            .prop_map(|(p, s)| Aabb { min: p.into(), max: DVec3::from(p) + DVec3::from(s) });
        prop::collection::vec(one, 0..60)
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(400))]

        #[test]
        fn all_that_meet_are_found_once(all in boxes(), region in boxes()) {
            let tree = Tree::new(all.clone());
            for region in region {
                let mut found = Vec::new();
                tree.each_of(|b| b.meets(region), |i| { found.push(i); false });
                found.sort_unstable();
                let expected: Vec<usize> = (0..all.len()).filter(|i| all[*i].meets(region)).collect();
                prop_assert_eq!(&found, &expected);
                let mut count = 0;
                tree.each_of(|b| b.meets(region), |_| { count += 1; true });
                prop_assert_eq!(count, expected.len().min(1));
            }
        }
    }
}
