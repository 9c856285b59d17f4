//! Points of a lattice inside a polygon.

use std::collections::{HashMap, HashSet};

use crate::geometry::vector::{bounds, foot_on_edge};

/// A rectangular lattice of points (i s₀, j s₁), m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lattice {
    pub steps: [f64; 2],
}

impl Lattice {
    pub fn point(&self, [i, j]: [i64; 2]) -> [f64; 2] {
        [i as f64 * self.steps[0], j as f64 * self.steps[1]]
    }

    /// The lattice point at a place, if one is within a millionth of a step.
    pub fn index(&self, x: [f64; 2]) -> Option<[i64; 2]> {
        let parts = [x[0] / self.steps[0], x[1] / self.steps[1]];
        let near = parts.iter().all(|p| (p - p.round()).abs() < 1e-6);
        near.then(|| parts.map(|p| p.round() as i64))
    }

    /// Points inside the polygon with these directed edges, at least `clearance` from all of them,
    /// row by row. A point is inside where the edges wind around it.
    pub fn inside(&self, edges: &[[[f64; 2]; 2]], clearance: f64) -> Vec<[i64; 2]> {
        let mut crossings: HashMap<i64, Vec<(f64, i32)>> = HashMap::new();
        let mut close: HashSet<[i64; 2]> = HashSet::new();
        let bounds = bounds(edges.iter().flatten().copied());
        for &[a, b] in edges {
            self.mark_close([a, b], clearance, bounds, &mut close);
            // Rows between the two ends, the lower end's own left out.
            let (low, high) = (a[1].min(b[1]), a[1].max(b[1]));
            let first = (low / self.steps[1]).floor() as i64;
            for row in first..=(high / self.steps[1]).ceil() as i64 {
                let y = row as f64 * self.steps[1];
                if (a[1] < y) == (b[1] < y) {
                    continue;
                }
                let part = (y - a[1]) / (b[1] - a[1]);
                let x = a[0] + part * (b[0] - a[0]);
                let turn = if b[1] > a[1] { 1 } else { -1 };
                crossings.entry(row).or_default().push((x, turn));
            }
        }
        let mut rows: Vec<_> = crossings.into_iter().collect();
        rows.sort_by_key(|(row, _)| *row);
        let mut points = Vec::new();
        for (row, mut crossings) in rows {
            crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut winding = 0;
            for pair in crossings.windows(2) {
                winding += pair[0].1;
                if winding == 0 {
                    continue;
                }
                let first = (pair[0].0 / self.steps[0]).ceil() as i64;
                let last = (pair[1].0 / self.steps[0]).floor() as i64;
                let along = (first..=last).map(|i| [i, row]);
                points.extend(along.filter(|p| !close.contains(p)));
            }
        }
        points.dedup();
        points
    }

    /// Marks the points near an edge that are within the bounds of the polygon: the clearance may be many times its
    /// size.
    fn mark_close(
        &self,
        [a, b]: [[f64; 2]; 2],
        clearance: f64,
        bounds: [[f64; 2]; 2],
        close: &mut HashSet<[i64; 2]>,
    ) {
        let range = |k: usize| {
            let low = (a[k].min(b[k]) - clearance).max(bounds[0][k]) / self.steps[k];
            let high = (a[k].max(b[k]) + clearance).min(bounds[1][k]) / self.steps[k];
            // Rounding must not leave out a point on the bounds.
            low.floor() as i64..=high.ceil() as i64
        };
        for j in range(1) {
            for i in range(0) {
                let (_, off) = foot_on_edge(self.point([i, j]), [a, b]);
                if off[0].hypot(off[1]) < clearance {
                    close.insert([i, j]);
                }
            }
        }
    }

    /// Gives all cells whose two triangles are among these the diagonal that points away from the middle of the lattice
    /// points, so that a symmetric cell stays symmetric; in the middle that from the lower left to the upper right.
    pub fn align_diagonals(&self, triangles: &mut [[usize; 3]], points: &[[f64; 2]]) {
        let index: Vec<Option<[i64; 2]>> = points.iter().map(|p| self.index(*p)).collect();
        let known = || index.iter().flatten();
        let ends = |k: usize| {
            let low = known().map(|i| i[k]).min().unwrap_or(0);
            low + known().map(|i| i[k]).max().unwrap_or(0)
        };
        let twice_middle = [0, 1].map(ends);
        let mut halves: HashMap<[i64; 2], Vec<usize>> = HashMap::new();
        for (t, corners) in triangles.iter().enumerate() {
            let [Some(a), Some(b), Some(c)] = corners.map(|v| index[v]) else {
                continue;
            };
            let low = [0, 1].map(|k| a[k].min(b[k]).min(c[k]));
            let high = [0, 1].map(|k| a[k].max(b[k]).max(c[k]));
            if high == [low[0] + 1, low[1] + 1] {
                halves.entry(low).or_default().push(t);
            }
        }
        for ([i, j], pair) in halves {
            let &[t, u] = pair.as_slice() else { continue };
            let at = |corner: [i64; 2]| {
                let both = triangles[t].iter().chain(&triangles[u]);
                both.copied().find(|v| index[*v] == Some(corner))
            };
            let corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(at);
            if let [Some(a), Some(b), Some(c), Some(d)] = corners {
                let side = |k: usize, low: i64| (2 * low + 1).cmp(&twice_middle[k]) as i8;
                [triangles[t], triangles[u]] = match side(0, i) * side(1, j) {
                    -1 => [[a, b, d], [b, c, d]],
                    _ => [[a, b, c], [a, c, d]],
                };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_with_a_hole() {
        let ring = |s: f64| [[-s, -s], [s, -s], [s, s], [-s, s]];
        let outer = (0..4).map(|k| [ring(4.0)[k], ring(4.0)[(k + 1) % 4]]);
        let inner = (0..4).map(|k| [ring(2.0)[(k + 1) % 4], ring(2.0)[k]]);
        let edges: Vec<_> = outer.chain(inner).collect();
        let lattice = Lattice { steps: [1.0, 1.0] };
        let points = lattice.inside(&edges, 0.6);
        assert_eq!(points.len(), 49 - 25);
        assert!(points.iter().all(|p| p[0].abs() == 3 || p[1].abs() == 3));
        assert_eq!(lattice.index([2.0, -1.0 + 1e-9]), Some([2, -1]));
        assert_eq!(lattice.index([2.5, 0.0]), None);
    }
}
