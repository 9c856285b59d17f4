//! Boxes that overlap a box.

use std::ops::ControlFlow;

/// Most boxes of a node that is not divided.
const LEAF: usize = 4;

/// Lower and upper corner of a box along the axes.
pub type Corners<const D: usize> = [[f64; D]; 2];

/// The box around some points.
pub fn bounds<const D: usize>(points: impl IntoIterator<Item = [f64; D]>) -> Corners<D> {
    let nothing = [[f64::INFINITY; D], [f64::NEG_INFINITY; D]];
    points.into_iter().fold(nothing, |[low, high], p| {
        [
            std::array::from_fn(|k| low[k].min(p[k])),
            std::array::from_fn(|k| high[k].max(p[k])),
        ]
    })
}

/// Binary tree of boxes along the axes, halved along the longest side.
///
/// Setting it up costs n log n, a question log n and the number of answers.
#[derive(Clone, Debug)]
pub struct BoxTree<const D: usize> {
    /// Bounds of the nodes; the children of node i are 2i + 1 and 2i + 2.
    nodes: Vec<Corners<D>>,
    order: Vec<u32>,
    boxes: Vec<Corners<D>>,
}

impl<const D: usize> BoxTree<D> {
    /// The tree of at most 2³² boxes.
    pub fn new(boxes: Vec<Corners<D>>) -> Self {
        Self::by_middles(boxes, |[low, high], _, axis| low[axis] + high[axis])
    }

    /// The tree of boxes that are halved by a value of a box, its number and an axis.
    pub fn by_middles(
        boxes: Vec<Corners<D>>,
        middle: impl Fn(&Corners<D>, usize, usize) -> f64,
    ) -> Self {
        let mut tree = Self {
            nodes: Vec::new(),
            order: Vec::new(),
            boxes,
        };
        let mut order: Vec<u32> = (0..tree.boxes.len() as u32).collect();
        tree.split(0, &mut order, &middle);
        tree.order = order;
        tree
    }

    fn split(
        &mut self,
        node: usize,
        order: &mut [u32],
        middle: &impl Fn(&Corners<D>, usize, usize) -> f64,
    ) {
        let [low, high] = bounds(order.iter().flat_map(|b| self.boxes[*b as usize]));
        if self.nodes.len() <= node {
            self.nodes.resize(node + 1, bounds([]));
        }
        self.nodes[node] = [low, high];
        if order.len() <= LEAF {
            return;
        }
        let side = |k: usize| high[k] - low[k];
        let axis = (0..D).rev().max_by(|a, b| side(*a).total_cmp(&side(*b)));
        let axis = axis.unwrap_or(0);
        let at = |b: &u32| middle(&self.boxes[*b as usize], *b as usize, axis);
        let ascending = |a: &u32, b: &u32| at(a).total_cmp(&at(b)).then(a.cmp(b));
        let half = order.len() / 2;
        order.select_nth_unstable_by(half, ascending);
        let (left, right) = order.split_at_mut(half);
        for leaf in [&mut *left, &mut *right] {
            if leaf.len() <= LEAF {
                leaf.sort_unstable_by(ascending);
            }
        }
        self.split(2 * node + 1, left, middle);
        self.split(2 * node + 2, right, middle);
    }

    /// Calls `found` with the number of every box that overlaps or touches `query`, until it breaks off.
    pub fn overlapping<B>(
        &self,
        query: Corners<D>,
        found: &mut impl FnMut(usize) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        self.descend(0, &self.order, query, found)
    }

    /// Calls `found` with the number of every box that overlaps or touches `query`.
    pub fn each(&self, query: Corners<D>, mut found: impl FnMut(usize)) {
        let mut all = |number| {
            found(number);
            ControlFlow::<()>::Continue(())
        };
        let _ = self.overlapping(query, &mut all);
    }

    fn descend<B>(
        &self,
        node: usize,
        order: &[u32],
        query: Corners<D>,
        found: &mut impl FnMut(usize) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        if order.is_empty() || !overlap(self.nodes[node], query) {
            return ControlFlow::Continue(());
        }
        if order.len() <= LEAF {
            for b in order {
                if overlap(self.boxes[*b as usize], query) {
                    found(*b as usize)?;
                }
            }
            return ControlFlow::Continue(());
        }
        let (left, right) = order.split_at(order.len() / 2);
        self.descend(2 * node + 1, left, query, found)?;
        self.descend(2 * node + 2, right, query, found)
    }

    /// Content nearest to a point: its squared distance, as given for a number, and its number;
    /// none if all are as far as `within2`.
    pub fn nearest(
        &self,
        point: [f64; D],
        within2: f64,
        distance2: impl Fn(usize) -> f64,
    ) -> Option<(f64, usize)> {
        let mut best = (within2, None);
        self.approach(0, &self.order, &point, &distance2, &mut best);
        Some((best.0, best.1?))
    }

    fn approach(
        &self,
        node: usize,
        order: &[u32],
        point: &[f64; D],
        distance2: &impl Fn(usize) -> f64,
        best: &mut (f64, Option<usize>),
    ) {
        if order.is_empty() || outside(point, &self.nodes[node]) >= best.0 {
            return;
        }
        if order.len() <= LEAF {
            for number in order.iter().map(|b| *b as usize) {
                let found = distance2(number);
                if found < best.0 {
                    *best = (found, Some(number));
                }
            }
            return;
        }
        let (left, right) = order.split_at(order.len() / 2);
        let mut children = [(2 * node + 1, left), (2 * node + 2, right)];
        let apart = children.map(|(child, _)| outside(point, &self.nodes[child]));
        if apart[1] < apart[0] {
            children.reverse();
        }
        for (child, order) in children {
            self.approach(child, order, point, distance2, best);
        }
    }

    /// Bounds of all boxes.
    pub fn bounds(&self) -> Corners<D> {
        self.nodes[0]
    }

    /// The box of a number.
    pub fn corners(&self, number: usize) -> Corners<D> {
        self.boxes[number]
    }
}

fn outside<const D: usize>(x: &[f64; D], [low, high]: &Corners<D>) -> f64 {
    let beyond = |k: usize| (low[k] - x[k]).max(x[k] - high[k]).max(0.0);
    (0..D).map(|k| beyond(k).powi(2)).sum()
}

fn overlap<const D: usize>(a: Corners<D>, b: Corners<D>) -> bool {
    (0..D).all(|k| a[0][k] <= b[1][k] && b[0][k] <= a[1][k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SplitMix;

    fn numbers(tree: &BoxTree<2>, query: Corners<2>) -> Vec<usize> {
        let mut all = Vec::new();
        tree.each(query, |k| all.push(k));
        all.sort_unstable();
        all
    }

    #[test]
    fn those_that_overlap_or_touch_are_found_and_no_other() {
        let of = |k: usize| {
            let (x, y) = ((k % 30) as f64, (k / 30) as f64);
            [[x, y], [x + 0.5, y + 0.5]]
        };
        let tree = BoxTree::new((0..900).map(of).collect());
        assert_eq!(tree.bounds(), [[0.0, 0.0], [29.5, 29.5]]);
        assert_eq!(
            numbers(&tree, [[4.5, 7.2], [5.0, 8.0]]),
            [214, 215, 244, 245]
        );
        assert_eq!(numbers(&tree, [[4.6, 7.6], [4.9, 7.9]]), [0; 0]);
        assert!(numbers(&BoxTree::new(Vec::new()), [[0.0; 2], [1.0; 2]]).is_empty());
    }

    #[test]
    fn the_nearest_has_the_least_of_all_distances() {
        let mut random = SplitMix(1);
        let mut place = |size: f64| [0, 1, 2].map(|_| size * random.unit());
        let places: Vec<[f64; 3]> = (0..500).map(|_| place(1.0)).collect();
        let tree = BoxTree::new(places.iter().map(|place| [*place; 2]).collect());
        for _ in 0..200 {
            let x = place(2.0);
            let apart = |k: usize| (0..3).map(|i| (places[k][i] - x[i]).powi(2)).sum();
            let least = (0..500).map(apart).fold(f64::INFINITY, f64::min);
            let found = tree.nearest(x, f64::INFINITY, apart);
            assert_eq!(found.map(|(apart, _)| apart), Some(least));
        }
        let none = BoxTree::<2>::new(Vec::new());
        assert_eq!(none.nearest([0.0; 2], f64::INFINITY, |_| 0.0), None);
    }

    #[test]
    fn it_stops_where_it_is_told() {
        let tree = BoxTree::new(vec![[[0.0; 2], [1.0; 2]]; 1000]);
        let mut asked = 0;
        let end = tree.overlapping([[0.0; 2]; 2], &mut |k| {
            asked += 1;
            ControlFlow::Break(k)
        });
        assert!(end.is_break() && asked == 1);
    }
}
