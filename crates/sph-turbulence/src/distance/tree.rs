//! Which wall element is nearest to a point.

use sph_core::Vect;
use sph_neighbours::{Domain, WallSet};

use super::simplex::squared_distance;

/// Elements in one leaf at most.
const LEAF: usize = 4;

#[derive(Clone, Copy, Debug)]
struct Node<const D: usize> {
    lower: Vect<D>,
    upper: Vect<D>,
    /// Range of the elements below.
    from: usize,
    to: usize,
    /// The second child; the first follows its parent. None of a leaf.
    second: Option<usize>,
}

/// A hierarchy of boxes around the elements of walls, for the true distance to the nearest of them, periodic images included.
#[derive(Clone, Debug, Default)]
pub struct ElementTree<const D: usize> {
    corners: Vec<[Vect<D>; D]>,
    /// Number of each in the set of walls.
    element: Vec<u32>,
    nodes: Vec<Node<D>>,
    shifts: Vec<Vect<D>>,
}

impl<const D: usize> ElementTree<D> {
    /// Of the present places of all elements that count.
    pub fn of(walls: &WallSet<D>, domain: &Domain<D>, counts: impl Fn(usize) -> bool) -> Self {
        let (elements, places) = (&walls.elements, &walls.points.position);
        let whole = |s: usize| {
            let corners = elements.corners[s].map(|c| places[c as usize]);
            corners.map(|c| corners[0] + domain.nearest_image(c - corners[0]))
        };
        let wanted = (0..elements.centre.len()).filter(|s| counts(*s));
        let mut listed: Vec<(u32, [Vect<D>; D])> = wanted.map(|s| (s as u32, whole(s))).collect();
        let mut nodes = Vec::new();
        if !listed.is_empty() {
            split(&mut listed, 0, &mut nodes);
        }
        ElementTree {
            element: listed.iter().map(|l| l.0).collect(),
            corners: listed.into_iter().map(|l| l.1).collect(),
            nodes,
            shifts: shifts(domain),
        }
    }

    /// Distance, m, to the nearest element and its number, if nearer than `within`.
    pub fn nearest(&self, x: &Vect<D>, within: f64) -> Option<(f64, u32)> {
        let mut best = (within * within, None);
        if self.nodes.is_empty() {
            return None;
        }
        for shift in &self.shifts {
            self.search(&(x + shift), 0, &mut best);
        }
        Some((best.0.sqrt(), best.1?))
    }

    fn search(&self, x: &Vect<D>, node: usize, best: &mut (f64, Option<u32>)) {
        let at = &self.nodes[node];
        if outside(x, at) >= best.0 {
            return;
        }
        let Some(second) = at.second else {
            for k in at.from..at.to {
                let squared = squared_distance(x, &self.corners[k]);
                if squared < best.0 {
                    *best = (squared, Some(self.element[k]));
                }
            }
            return;
        };
        let children = [node + 1, second];
        let apart = children.map(|c| outside(x, &self.nodes[c]));
        match apart[1] < apart[0] {
            true => children.iter().rev().for_each(|c| self.search(x, *c, best)),
            false => children.iter().for_each(|c| self.search(x, *c, best)),
        }
    }
}

/// Squared distance of a point from a box, m².
fn outside<const D: usize>(x: &Vect<D>, node: &Node<D>) -> f64 {
    let beyond = |k: usize| (node.lower[k] - x[k]).max(x[k] - node.upper[k]).max(0.0);
    (0..D).map(|k| beyond(k).powi(2)).sum()
}

/// Moves to the images of a point: none, and one period either way along each periodic axis and each diagonal.
fn shifts<const D: usize>(domain: &Domain<D>) -> Vec<Vect<D>> {
    let mut all = vec![Vect::zeros()];
    for axis in (0..D).filter(|k| domain.periodic[*k]) {
        let mut step = Vect::<D>::zeros();
        step[axis] = domain.length(axis);
        let moved = all.iter().flat_map(|s| [s + step, s - step]);
        let moved: Vec<_> = moved.collect();
        all.extend(moved);
    }
    all
}

fn split<const D: usize>(
    listed: &mut [(u32, [Vect<D>; D])],
    from: usize,
    nodes: &mut Vec<Node<D>>,
) {
    let mut lower = Vect::repeat(f64::INFINITY);
    let mut upper = Vect::repeat(f64::NEG_INFINITY);
    for corner in listed.iter().flat_map(|l| &l.1) {
        for k in 0..D {
            lower[k] = corner[k].min(lower[k]);
            upper[k] = corner[k].max(upper[k]);
        }
    }
    let own = nodes.len();
    nodes.push(Node {
        lower,
        upper,
        from,
        to: from + listed.len(),
        second: None,
    });
    if listed.len() <= LEAF {
        return;
    }
    let axis = (upper - lower).imax();
    let middle = |l: &(u32, [Vect<D>; D])| l.1.iter().map(|c| c[axis]).sum::<f64>();
    listed.sort_by(|a, b| middle(a).total_cmp(&middle(b)).then(a.0.cmp(&b.0)));
    let half = listed.len() / 2;
    let (first, second) = listed.split_at_mut(half);
    split(first, from, nodes);
    nodes[own].second = Some(nodes.len());
    split(second, from + half, nodes);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polygon's edges, one element each.
    fn ring(sides: usize) -> WallSet<2> {
        let mut walls = WallSet::<2>::default();
        for k in 0..sides {
            let angle = std::f64::consts::TAU * k as f64 / sides as f64;
            let point = Vect::from([angle.cos(), angle.sin()]);
            walls.points.position.push(point);
            let corners = [k as u32, ((k + 1) % sides) as u32];
            walls.elements.corners.push(corners);
            walls.elements.centre.push(point);
        }
        walls
    }

    #[test]
    fn it_finds_what_looking_at_all_of_them_finds() {
        let walls = ring(61);
        let domain = Domain::open(Vect::repeat(-5.0), Vect::repeat(5.0));
        let tree = ElementTree::of(&walls, &domain, |_| true);
        for k in 0..200 {
            let (angle, radius) = (0.731 * f64::from(k), 0.013 * f64::from(k));
            let x = Vect::from([radius * angle.cos(), radius * angle.sin()]);
            let each = walls.elements.corners.iter();
            let each = each.map(|c| c.map(|c| walls.points.position[c as usize]));
            let exact = each.map(|c| squared_distance(&x, &c).sqrt());
            let exact = exact.fold(f64::INFINITY, f64::min);
            let found = tree.nearest(&x, 10.0).expect("an element").0;
            assert!((found - exact).abs() < 1e-14, "{k}: {found}, {exact}");
        }
        assert_eq!(tree.nearest(&Vect::zeros(), 0.5), None);
    }

    #[test]
    fn images_across_a_period_count_and_walls_may_be_left_out() {
        let mut walls = WallSet::<2>::default();
        walls.points.position = [[0.1, 0.0], [0.1, 1.0]].map(Vect::from).to_vec();
        walls.elements.corners = vec![[0, 1]];
        walls.elements.centre = vec![Vect::from([0.1, 0.5])];
        let domain = Domain {
            lower: Vect::zeros(),
            upper: Vect::from([2.0, 2.0]),
            periodic: [true, false],
        };
        let tree = ElementTree::of(&walls, &domain, |_| true);
        let found = tree.nearest(&Vect::from([1.9, 0.5]), 5.0).expect("one");
        assert!((found.0 - 0.2).abs() < 1e-15 && found.1 == 0);
        let none = ElementTree::of(&walls, &domain, |_| false);
        assert_eq!(none.nearest(&Vect::zeros(), 5.0), None);
    }
}
