//! Boxes that overlap a box.

use super::vector::Point;

const LEAF: usize = 4;

/// Binary tree of axis-aligned boxes, halved along the longest side.
pub(super) struct BoxTree {
    /// Bounds of the nodes; the children of node i are 2i + 1 and 2i + 2.
    nodes: Vec<[Point; 2]>,
    order: Vec<u32>,
    boxes: Vec<[Point; 2]>,
}

impl BoxTree {
    pub fn new(boxes: Vec<[Point; 2]>) -> Self {
        let mut tree = Self {
            nodes: Vec::new(),
            order: (0..boxes.len() as u32).collect(),
            boxes,
        };
        let mut order = std::mem::take(&mut tree.order);
        tree.split(0, &mut order);
        tree.order = order;
        tree
    }

    fn split(&mut self, node: usize, order: &mut [u32]) {
        let nothing = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        let [low, high] = order.iter().fold(nothing, |all, b| {
            let one = self.boxes[*b as usize];
            [
                std::array::from_fn(|k| all[0][k].min(one[0][k])),
                std::array::from_fn(|k| all[1][k].max(one[1][k])),
            ]
        });
        if self.nodes.len() <= node {
            self.nodes.resize(node + 1, nothing);
        }
        self.nodes[node] = [low, high];
        if order.len() <= LEAF {
            return;
        }
        let side = |k: usize| high[k] - low[k];
        let axis = (0..3)
            .max_by(|a, b| side(*a).total_cmp(&side(*b)))
            .unwrap_or(0);
        let boxes = &self.boxes;
        let middle = |b: u32| boxes[b as usize][0][axis] + boxes[b as usize][1][axis];
        let half = order.len() / 2;
        order.select_nth_unstable_by(half, |a, b| {
            middle(*a).total_cmp(&middle(*b)).then(a.cmp(b))
        });
        let (left, right) = order.split_at_mut(half);
        self.split(2 * node + 1, left);
        self.split(2 * node + 2, right);
    }

    /// Calls `found` with every box that overlaps `query`.
    pub fn overlapping(&self, query: [Point; 2], found: &mut impl FnMut(usize)) {
        self.descend(0, &self.order, query, found);
    }

    fn descend(
        &self,
        node: usize,
        order: &[u32],
        query: [Point; 2],
        found: &mut impl FnMut(usize),
    ) {
        if order.is_empty() || !overlap(self.nodes[node], query) {
            return;
        }
        if order.len() <= LEAF {
            for b in order {
                if overlap(self.boxes[*b as usize], query) {
                    found(*b as usize);
                }
            }
            return;
        }
        let (left, right) = order.split_at(order.len() / 2);
        self.descend(2 * node + 1, left, query, found);
        self.descend(2 * node + 2, right, query, found);
    }

    /// Bounds of all boxes.
    pub fn bounds(&self) -> [Point; 2] {
        self.nodes[0]
    }
}

fn overlap(a: [Point; 2], b: [Point; 2]) -> bool {
    (0..3).all(|k| a[0][k] <= b[1][k] && b[0][k] <= a[1][k])
}
