//! Search for the triangle of a face at a place.

use crate::Mesh;
use crate::geometry::plane::Plane;
use crate::geometry::vector::sub;

/// A triangle that a place misses by less than this, over its size, has it.
const ROUNDING: f64 = 1e-9;

/// The triangles of a face as they are drawn, in coordinates that move with its first one, by square cells.
#[derive(Clone, Debug)]
pub(crate) struct FaceMap {
    /// Number of the first triangle.
    first: u32,
    /// Corners of every triangle, m.
    corners: Vec<[[f64; 2]; 3]>,
    /// Box around the face, m.
    lower: [f64; 2],
    upper: [f64; 2],
    /// Cells along either axis, and their number over the length, 1/m.
    count: [usize; 2],
    per_length: [f64; 2],
    /// By cell: the first of its triangles among all; one more at the end.
    starts: Vec<u32>,
    /// Triangles that reach into each cell, counted from the first of the face.
    triangles: Vec<u32>,
}

/// The plane of a face, with its origin at the first corner of a triangle and the first axis along its first side.
pub(super) fn plane_of(mesh: &Mesh<3>, triangle: usize) -> Plane {
    let [a, b, _] = mesh.corners(triangle);
    let direction = std::array::from_fn(|k| b[k] - a[k]);
    Plane::along(direction, a, mesh.elements[triangle].normal)
}

impl FaceMap {
    /// Of the triangles from `first` to `end` of a mesh, which lie in one plane.
    pub fn new(mesh: &Mesh<3>, first: usize, end: usize) -> Self {
        let plane = plane_of(mesh, first);
        let flat = |t: usize| mesh.corners(t).map(|corner| plane.foot(corner));
        let corners: Vec<_> = (first..end).map(flat).collect();
        let (mut lower, mut upper) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for corner in corners.iter().flatten() {
            for k in 0..2 {
                lower[k] = lower[k].min(corner[k]);
                upper[k] = upper[k].max(corner[k]);
            }
        }
        let count = [0, 1].map(|k| (((upper[k] - lower[k]) / mesh.spacing) as usize).max(1));
        let per_length = [0, 1].map(|k| count[k] as f64 / (upper[k] - lower[k]));
        let mut map = FaceMap {
            first: first as u32,
            lower,
            upper,
            count,
            per_length,
            starts: vec![0; count[0] * count[1] + 1],
            triangles: Vec::new(),
            corners,
        };
        // Counted first, then put in.
        for t in 0..map.corners.len() {
            map.each_cell(map.reach_of(t), |map, cell| map.starts[cell + 1] += 1);
        }
        for cell in 1..map.starts.len() {
            map.starts[cell] += map.starts[cell - 1];
        }
        map.triangles = vec![0; map.starts[map.starts.len() - 1] as usize];
        let mut next = map.starts.clone();
        for t in 0..map.corners.len() {
            map.each_cell(map.reach_of(t), |map, cell| {
                map.triangles[next[cell] as usize] = t as u32;
                next[cell] += 1;
            });
        }
        map
    }

    /// Box around a triangle, m.
    fn reach_of(&self, triangle: usize) -> [[f64; 2]; 2] {
        let corners = &self.corners[triangle];
        let ends = |k: usize| corners.map(|c| c[k]);
        let least = |k: usize| ends(k).into_iter().fold(f64::INFINITY, f64::min);
        let most = |k: usize| ends(k).into_iter().fold(f64::NEG_INFINITY, f64::max);
        [[least(0), least(1)], [most(0), most(1)]]
    }

    /// The cell of a place along an axis, the nearest one of places outside.
    #[inline]
    fn cell(&self, x: f64, axis: usize) -> usize {
        let place = (x - self.lower[axis]) * self.per_length[axis];
        (place.max(0.0) as usize).min(self.count[axis] - 1)
    }

    fn each_cell(&mut self, [low, high]: [[f64; 2]; 2], mut of: impl FnMut(&mut Self, usize)) {
        let range = |map: &Self, k: usize| map.cell(low[k], k)..=map.cell(high[k], k);
        for j in range(self, 1) {
            for i in range(self, 0) {
                let cell = j * self.count[0] + i;
                of(self, cell);
            }
        }
    }

    fn of_cell(&self, i: usize, j: usize) -> &[u32] {
        let cell = j * self.count[0] + i;
        &self.triangles[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// True if the box around the face is within a distance of a place in its plane, m.
    #[inline]
    pub fn is_within(&self, x: [f64; 2], distance: f64) -> bool {
        let apart = |k: usize| (self.lower[k] - x[k]).max(x[k] - self.upper[k]).max(0.0);
        apart(0) * apart(0) + apart(1) * apart(1) < distance * distance
    }

    /// The triangle at a place in the plane, m, and the weights of its corners there; outside the face those of the
    /// nearest place of a triangle.
    pub fn find(&self, x: [f64; 2]) -> (u32, [f64; 3]) {
        let [i, j] = [0, 1].map(|k| self.cell(x[k], k));
        for &t in self.of_cell(i, j) {
            let weights = weights(&self.corners[t as usize], x);
            if weights.iter().all(|w| *w >= -ROUNDING) {
                return (self.first + t, weights);
            }
        }
        self.nearest(x, [i, j])
    }

    /// The nearest place of the triangles in the cells around, looked at ring by ring.
    fn nearest(&self, x: [f64; 2], [i, j]: [usize; 2]) -> (u32, [f64; 3]) {
        let rings = self.count[0].max(self.count[1]);
        let mut found: Option<(f64, u32, [f64; 3])> = None;
        let mut last = rings;
        for ring in 0..=rings {
            let [columns, rows] = [(i, 0), (j, 1)].map(|(c, k): (usize, usize)| {
                c.saturating_sub(ring)..=(c + ring).min(self.count[k] - 1)
            });
            for row in rows {
                for column in columns.clone() {
                    if row.abs_diff(j).max(column.abs_diff(i)) != ring {
                        continue;
                    }
                    for &t in self.of_cell(column, row) {
                        let (distance, weights) = nearest_in(&self.corners[t as usize], x);
                        if found.is_none_or(|(least, ..)| distance < least) {
                            found = Some((distance, t, weights));
                        }
                    }
                }
            }
            // A triangle in the next ring may still be nearer.
            if found.is_some() && last == rings {
                last = ring + 1;
            }
            if ring == last {
                break;
            }
        }
        let (_, t, weights) = found.unwrap_or((0.0, 0, [1.0 / 3.0; 3]));
        (self.first + t, weights)
    }

    /// Triangles that may be within a distance of a place in the plane, m, ascending.
    pub fn within(&self, x: [f64; 2], distance: f64, found: &mut Vec<u32>) {
        found.clear();
        let range = |k: usize| self.cell(x[k] - distance, k)..=self.cell(x[k] + distance, k);
        for j in range(1) {
            for i in range(0) {
                found.extend(self.of_cell(i, j).iter().map(|t| self.first + t));
            }
        }
        found.sort_unstable();
        found.dedup();
    }
}

fn cross([a, b]: [f64; 2], [c, d]: [f64; 2]) -> f64 {
    a * d - b * c
}

/// Barycentric coordinates of a place.
fn weights([a, b, c]: &[[f64; 2]; 3], x: [f64; 2]) -> [f64; 3] {
    let (u, v, w) = (sub(*b, *a), sub(*c, *a), sub(x, *a));
    let whole = cross(u, v);
    let [second, third] = [cross(w, v) / whole, cross(u, w) / whole];
    [1.0 - second - third, second, third]
}

/// Squared distance of a place outside a triangle from it, m², and the barycentric coordinates of the nearest place.
fn nearest_in(corners: &[[f64; 2]; 3], x: [f64; 2]) -> (f64, [f64; 3]) {
    let mut found = (f64::INFINITY, [1.0, 0.0, 0.0]);
    for k in 0..3 {
        let (from, to) = (corners[k], corners[(k + 1) % 3]);
        let (edge, apart) = (sub(to, from), sub(x, from));
        let length2 = edge[0] * edge[0] + edge[1] * edge[1];
        let part = ((apart[0] * edge[0] + apart[1] * edge[1]) / length2).clamp(0.0, 1.0);
        let off = [apart[0] - part * edge[0], apart[1] - part * edge[1]];
        let distance2 = off[0] * off[0] + off[1] * off[1];
        if distance2 < found.0 {
            let mut weights = [0.0; 3];
            (weights[k], weights[(k + 1) % 3]) = (1.0 - part, part);
            found = (distance2, weights);
        }
    }
    found
}
