//! Simple polygons: containment, distance, area, self-crossing, triangles.

use std::ops::ControlFlow;

use sph_core::{BoxTree, bounds};

/// A closed polygon in the plane of the first two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// Corners, m.
    pub(crate) points: Vec<[f64; 2]>,
}

impl Polygon {
    /// The polygon through these corners, m; the last is joined to the first.
    pub fn new(points: Vec<[f64; 2]>) -> Self {
        Polygon { points }
    }

    /// Lower and upper corner of the box around it, m.
    pub(crate) fn bounds(&self) -> [[f64; 2]; 2] {
        bounds(self.points.iter().copied())
    }

    /// Edges as pairs of corners.
    pub fn edges(&self) -> impl Iterator<Item = ([f64; 2], [f64; 2])> + '_ {
        let next = self.points.iter().cycle().skip(1);
        self.points.iter().copied().zip(next.copied())
    }

    /// Area, m², positive if the corners go round anticlockwise.
    pub fn area(&self) -> f64 {
        let Some(&o) = self.points.first() else {
            return 0.0;
        };
        0.5 * self.edges().map(|(a, b)| cross(o, a, b)).sum::<f64>()
    }

    /// True if a point is inside, by the parity of crossings.
    pub fn contains(&self, x: [f64; 2]) -> bool {
        self.edges().filter(|(a, b)| crosses_ray(x, *a, *b)).count() % 2 == 1
    }

    /// Distance of a point from the nearest edge, m, positive inside.
    pub(crate) fn depth(&self, x: [f64; 2]) -> f64 {
        let away = self.distance(x, |_, _| true);
        if self.contains(x) { away } else { -away }
    }

    /// Distance of a point from the nearest edge for which `counts` holds, m.
    pub fn distance(&self, x: [f64; 2], counts: impl Fn([f64; 2], [f64; 2]) -> bool) -> f64 {
        let to = |(a, b): Edge| {
            let (ex, ey) = (b[0] - a[0], b[1] - a[1]);
            let (px, py) = (x[0] - a[0], x[1] - a[1]);
            let length = ex * ex + ey * ey;
            let along = ((px * ex + py * ey) / length).clamp(0.0, 1.0);
            let t = if length > 0.0 { along } else { 0.0 };
            (px - t * ex).hypot(py - t * ey)
        };
        let edges = self.edges().filter(|(a, b)| counts(*a, *b));
        edges.map(to).fold(f64::INFINITY, f64::min)
    }
}

/// True if the ray from a point to the right passes an edge.
pub(crate) fn crosses_ray(x: [f64; 2], a: [f64; 2], b: [f64; 2]) -> bool {
    (a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
}

/// Largest number of compared pairs of segments; the mesh of a wall refuses one of more.
const PAIRS: usize = 200_000_000;

/// The first two segments of a chain that cross or touch without being neighbours.
///
/// Only segments whose boxes overlap are held against each other, so that a chain of n segments that is not a
/// tangle costs about n log n. A tangle of more than [`PAIRS`] is not searched to its end.
pub(crate) fn crossing(edges: &[Edge], closed: bool) -> Option<SegmentCrossing> {
    searched(edges, closed).0
}

pub(crate) type Edge = ([f64; 2], [f64; 2]);

/// Two segments, by number, and the place where they meet.
type SegmentCrossing = (usize, usize, [f64; 2]);

/// The same with the number of pairs that were held against each other.
fn searched(edges: &[Edge], closed: bool) -> (Option<SegmentCrossing>, usize) {
    let n = edges.len();
    let tree = BoxTree::new(edges.iter().map(|(a, b)| bounds([*a, *b])).collect());
    let mut pairs = 0;
    for first in 0..n {
        // The lowest of those that it meets.
        let mut met: Option<(usize, [f64; 2])> = None;
        let whole = tree.overlapping(tree.corners(first), &mut |second| {
            if second <= first || met.is_some_and(|(k, _)| k < second) {
                return ControlFlow::Continue(());
            }
            pairs += 1;
            let adjacent = second - first == 1 || (closed && first == 0 && second == n - 1);
            let place = match adjacent {
                true => folded(edges[first], edges[second], second - first == 1),
                false => meet(edges[first], edges[second]),
            };
            met = place.map(|place| (second, place)).or(met);
            match pairs > PAIRS {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        if let Some((second, place)) = met {
            return (Some((first, second, place)), pairs);
        }
        if whole.is_break() {
            break;
        }
    }
    (None, pairs)
}

pub(crate) fn cross(o: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
}

/// Neighbouring segments may share their corner but must not run back over each other.
fn folded(first: Edge, second: Edge, in_order: bool) -> Option<[f64; 2]> {
    let (corner, a, b) = match in_order {
        true => (first.1, first.0, second.1),
        false => (first.0, first.1, second.0),
    };
    let along = (a[0] - corner[0]) * (b[0] - corner[0]) + (a[1] - corner[1]) * (b[1] - corner[1]);
    (cross(corner, a, b) == 0.0 && along > 0.0).then_some(corner)
}

fn meet(p: Edge, q: Edge) -> Option<[f64; 2]> {
    let (d1, d2) = (cross(q.0, q.1, p.0), cross(q.0, q.1, p.1));
    let (d3, d4) = (cross(p.0, p.1, q.0), cross(p.0, p.1, q.1));
    let opposite = |a: f64, b: f64| (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0);
    if opposite(d1, d2) && opposite(d3, d4) {
        let t = d1 / (d1 - d2);
        return Some([0, 1].map(|k| p.0[k] + t * (p.1[k] - p.0[k])));
    }
    let on = |s: Edge, x: [f64; 2]| {
        (0..2).all(|k| s.0[k].min(s.1[k]) <= x[k] && x[k] <= s.0[k].max(s.1[k]))
    };
    let touching = [(d1, q, p.0), (d2, q, p.1), (d3, p, q.0), (d4, p, q.1)];
    let found = touching.iter().find(|(d, s, x)| *d == 0.0 && on(*s, *x));
    found.map(|(_, _, x)| *x)
}

/// Triangles of a simple polygon whose corners go round anticlockwise, by ear clipping.
///
/// Every corner is used and no triangle is degenerate, so that the neighbours of its edges fit.
pub(crate) fn triangulate(points: &[[f64; 2]]) -> Vec<[usize; 3]> {
    let mut ring: Vec<usize> = (0..points.len()).collect();
    let mut triangles = Vec::with_capacity(points.len().saturating_sub(2));
    let (mut at, mut waited) = (0, 0);
    while ring.len() >= 3 {
        let n = ring.len();
        let corner = [at + n - 1, at, at + 1].map(|k| ring[k % n]);
        // A polygon whose rounding hides its last ears is cut all the same.
        if waited > n || is_ear(points, &ring, corner) {
            triangles.push(corner);
            ring.remove(at % n);
            waited = 0;
            at = if at < ring.len() { at } else { 0 };
        } else {
            at = (at + 1) % n;
            waited += 1;
        }
    }
    triangles
}

fn is_ear(points: &[[f64; 2]], ring: &[usize], [a, b, c]: [usize; 3]) -> bool {
    let [pa, pb, pc] = [a, b, c].map(|k| points[k]);
    if cross(pa, pb, pc) <= 0.0 {
        return false;
    }
    let sides = [(pa, pb), (pb, pc), (pc, pa)];
    let within = |x: [f64; 2]| sides.iter().all(|(p, q)| cross(*p, *q, x) >= 0.0);
    let mut others = ring.iter().filter(|k| ![a, b, c].contains(k));
    !others.any(|k| within(points[*k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Polygon {
        Polygon::new(vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
    }

    fn crossed(points: Vec<[f64; 2]>) -> Option<SegmentCrossing> {
        crossing(&Polygon::new(points).edges().collect::<Vec<_>>(), true)
    }

    #[test]
    fn a_square_has_its_area_and_distances() {
        let all = |_: [f64; 2], _: [f64; 2]| true;
        assert_eq!(square().area(), 4.0);
        assert!(square().contains([1.0, 0.5]));
        assert!(!square().contains([3.0, 0.5]));
        assert_eq!(square().distance([1.0, 0.5], all), 0.5);
        assert_eq!(square().distance([5.0, 6.0], all), 5.0);
        assert_eq!(crossed(square().points), None);
    }

    #[test]
    fn a_bow_tie_crosses_itself_in_the_middle() {
        let bow = vec![[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
        assert_eq!(crossed(bow), Some((0, 2, [1.0, 1.0])));
    }

    #[test]
    fn a_corner_on_another_edge_and_a_fold_are_found() {
        let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]];
        let touch = [&corners[..], &[[2.0, 0.0], [0.0, 4.0]]].concat();
        assert!(crossed(touch).is_some());
        let fold = vec![[0.0, 0.0], [4.0, 0.0], [2.0, 0.0], [2.0, 2.0]];
        assert!(crossed(fold).is_some());
    }

    #[test]
    fn a_segment_is_held_against_those_beside_it_only() {
        for tall in [1.0, 1000.0] {
            let n = 20_000;
            let up = |k: usize| [(k as f64) * 1.5, (k % 2) as f64 * tall];
            let across = |k: usize| [up(k)[1], up(k)[0]];
            for corner in [&up as &dyn Fn(usize) -> [f64; 2], &across] {
                let edges: Vec<_> = (0..n).map(|k| (corner(k), corner(k + 1))).collect();
                // The box of a segment touches that of the next, and of no other.
                assert_eq!(searched(&edges, false), (None, n - 1));
            }
        }
    }

    fn areas(points: &[[f64; 2]]) -> Vec<f64> {
        let area = |t: &[usize; 3]| 0.5 * cross(points[t[0]], points[t[1]], points[t[2]]);
        triangulate(points).iter().map(area).collect()
    }

    #[test]
    fn a_comb_with_corners_on_its_edges_is_cut_without_slivers() {
        let back = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [4.0, 0.0]];
        let right = [[4.0, 3.0], [3.0, 3.0], [3.0, 1.0], [2.0, 1.0]];
        let left = [[1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        let comb = [&back[..], &right, &left].concat();
        let areas = areas(&comb);
        assert_eq!(areas.len(), comb.len() - 2);
        assert!(areas.iter().all(|a| *a > 0.0), "{areas:?}");
        assert!((areas.iter().sum::<f64>() - 8.0).abs() < 1e-12);
    }
}
