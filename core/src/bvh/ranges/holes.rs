//! Free ranges in order, found by their length or by what lies before a place.

use alloc::vec::Vec;

/// No node.
const NONE: u32 = u32::MAX;

/// Free ranges by start, in a balanced tree (AVL) whose nodes know the longest range below them: everything takes time in
/// proportion to the depth, at most 1.44 times the logarithm of their number.
#[derive(Clone, Debug)]
pub(super) struct Holes {
    nodes: Vec<Node>,
    root: u32,
    /// A node that holds no range; its left child is the next.
    spare: u32,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    start: u32,
    length: u32,
    /// Of the ranges in this subtree.
    longest: u32,
    children: [u32; 2],
    height: u32,
}

impl Default for Holes {
    fn default() -> Self {
        Self {
            nodes: Vec::new(),
            root: NONE,
            spare: NONE,
        }
    }
}

impl Holes {
    /// Adds a range that touches no other.
    pub fn insert(&mut self, start: u32, length: u32) {
        let new = Node {
            start,
            length,
            longest: length,
            children: [NONE; 2],
            height: 1,
        };
        let at = if self.spare == NONE {
            self.nodes.push(new);
            self.nodes.len() as u32 - 1
        } else {
            let at = self.spare;
            self.spare = self.nodes[at as usize].children[0];
            self.nodes[at as usize] = new;
            at
        };
        self.root = self.insert_below(self.root, at);
    }

    /// Takes the range out that begins there, and returns its length: 0 if none does.
    pub fn remove(&mut self, start: u32) -> u32 {
        let mut at = self.root;
        while at != NONE && self.nodes[at as usize].start != start {
            let node = &self.nodes[at as usize];
            at = node.children[usize::from(start > node.start)];
        }
        if at == NONE {
            return 0;
        }
        let length = self.nodes[at as usize].length;
        self.root = self.remove_below(self.root, start);
        self.nodes[at as usize].children[0] = self.spare;
        self.spare = at;
        length
    }

    /// The last range that begins before a place, and its length.
    pub fn before(&self, place: u32) -> Option<(u32, u32)> {
        let mut found = None;
        let mut at = self.root;
        while at != NONE {
            let node = &self.nodes[at as usize];
            let is_before = node.start < place;
            if is_before {
                found = Some((node.start, node.length));
            }
            at = node.children[usize::from(is_before)];
        }
        found
    }

    /// Takes `count` indices off the beginning of the first range that has as many, and returns where it began.
    pub fn take_first(&mut self, count: u32) -> Option<u32> {
        if self.longest(self.root) < count {
            return None;
        }
        let mut at = self.root;
        let start = loop {
            let node = &self.nodes[at as usize];
            let [left, right] = node.children;
            if self.longest(left) >= count {
                at = left;
            } else if node.length >= count {
                break node.start;
            } else {
                at = right;
            }
        };
        if self.nodes[at as usize].length == count {
            self.remove(start);
        } else {
            self.shorten(self.root, start, count);
        }
        Some(start)
    }

    /// Takes indices off the beginning of the range that begins at `start`; its place among the others stays.
    fn shorten(&mut self, at: u32, start: u32, count: u32) {
        let node = &mut self.nodes[at as usize];
        if node.start == start {
            node.start += count;
            node.length -= count;
        } else {
            let child = node.children[usize::from(start > node.start)];
            self.shorten(child, start, count);
        }
        self.update(at);
    }

    /// Puts node `new` below `at`; returns what stands there then.
    fn insert_below(&mut self, at: u32, new: u32) -> u32 {
        if at == NONE {
            return new;
        }
        let side = usize::from(self.nodes[new as usize].start > self.nodes[at as usize].start);
        let child = self.insert_below(self.nodes[at as usize].children[side], new);
        self.nodes[at as usize].children[side] = child;
        self.balanced(at)
    }

    /// Takes the range that begins at `start` out from below `at`; returns what stands there then.
    fn remove_below(&mut self, at: u32, start: u32) -> u32 {
        let node = self.nodes[at as usize];
        if node.start == start {
            let [left, right] = node.children;
            if right == NONE {
                return left;
            }
            let (first, rest) = self.remove_first(right);
            self.nodes[first as usize].children = [left, rest];
            return self.balanced(first);
        }
        let side = usize::from(start > node.start);
        let child = self.remove_below(node.children[side], start);
        self.nodes[at as usize].children[side] = child;
        self.balanced(at)
    }

    /// Takes the first range out from below `at`; returns its node, and what stands there then.
    fn remove_first(&mut self, at: u32) -> (u32, u32) {
        let [left, right] = self.nodes[at as usize].children;
        if left == NONE {
            return (at, right);
        }
        let (first, rest) = self.remove_first(left);
        self.nodes[at as usize].children[0] = rest;
        (first, self.balanced(at))
    }

    /// Brings a subtree whose children differ in height by two at most in balance; returns its root.
    fn balanced(&mut self, at: u32) -> u32 {
        let [left, right] = self.nodes[at as usize].children.map(|child| self.height(child));
        if left.abs_diff(right) < 2 {
            self.update(at);
            return at;
        }
        let tall = usize::from(right > left);
        let child = self.nodes[at as usize].children[tall];
        let inner = self.nodes[child as usize].children;
        if self.height(inner[1 - tall]) > self.height(inner[tall]) {
            let child = self.rotated(child, 1 - tall);
            self.nodes[at as usize].children[tall] = child;
        }
        self.rotated(at, tall)
    }

    /// Puts the child on a side above its parent; returns it.
    fn rotated(&mut self, at: u32, side: usize) -> u32 {
        let child = self.nodes[at as usize].children[side];
        self.nodes[at as usize].children[side] = self.nodes[child as usize].children[1 - side];
        self.update(at);
        self.nodes[child as usize].children[1 - side] = at;
        self.update(child);
        child
    }

    /// What a node knows of those below it.
    fn update(&mut self, at: u32) {
        let Node { children, length, .. } = self.nodes[at as usize];
        let [left, right] = children;
        let node_height = 1 + self.height(left).max(self.height(right));
        let longest = length.max(self.longest(left)).max(self.longest(right));
        let node = &mut self.nodes[at as usize];
        node.height = node_height;
        node.longest = longest;
    }

    fn height(&self, at: u32) -> u32 {
        self.nodes.get(at as usize).map_or(0, |node| node.height)
    }

    fn longest(&self, at: u32) -> u32 {
        self.nodes.get(at as usize).map_or(0, |node| node.longest)
    }
}

#[cfg(test)]
impl Holes {
    /// Number of levels.
    pub fn depth(&self) -> u32 {
        self.height(self.root)
    }

    /// The ranges in order, with what each node says of those below it checked.
    #[track_caller]
    pub fn check(&self) -> Vec<(u32, u32)> {
        let mut out = Vec::new();
        self.check_below(self.root, &mut out);
        assert!(
            out.windows(2).all(|two| two[0].0 + two[0].1 < two[1].0),
            "{out:?}"
        );
        out
    }

    fn check_below(&self, at: u32, out: &mut Vec<(u32, u32)>) {
        if at == NONE {
            return;
        }
        let node = &self.nodes[at as usize];
        let [left, right] = node.children;
        self.check_below(left, out);
        out.push((node.start, node.length));
        self.check_below(right, out);
        assert!(self.height(left).abs_diff(self.height(right)) < 2);
        let heights = self.height(left).max(self.height(right));
        let longest = self.longest(left).max(self.longest(right));
        assert_eq!(
            (node.height, node.longest),
            (1 + heights, longest.max(node.length))
        );
    }
}
