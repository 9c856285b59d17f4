//! The planar faces of walls in space, and the search for the triangle of one at a place.

use sph_core::Vect;

use crate::geometry::cells::listed;
use crate::geometry::vector::{Plane, bounds, dot, foot_on_edge, perp, sub, widened};
use crate::integrals::spatial::{Circle, Patch};
use crate::{FaceEdge, Mesh};

/// A triangle that a place misses by less than this, over its size, has it.
const ROUNDING: f64 = 1e-9;

/// The faces as planes, and the triangles in them.
#[derive(Debug, Default)]
pub(crate) struct Planes {
    pub faces: Vec<PlaneFace>,
    /// By triangle; none where every face is one contact.
    pub patches: Vec<Patch>,
    pub circles: Vec<Circle>,
}

#[derive(Debug)]
pub(crate) struct PlaneFace {
    /// Its triangles.
    first: u32,
    pub end: u32,
    /// With coordinates that move with the first triangle.
    pub plane: Plane,
    pub edges: Vec<[Corner; 2]>,
    /// The search for the triangle at a place, where all that a particle sees of the face is one contact; none where
    /// each triangle is one.
    pub map: Option<FaceMap>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    pub position: Vect<3>,
    /// Whole periods to add.
    pub image: [i32; 3],
}

impl Corner {
    pub fn new(mesh: &Mesh<3>, node: usize, image: [i32; 3]) -> Self {
        let position = mesh.nodes[node].position.into();
        Corner { position, image }
    }
}

impl Planes {
    /// Of walls where they are drawn; each triangle is a contact on walls that are `cut`: fluid passes them, or their
    /// shape changes.
    pub fn new(mesh: &Mesh<3>, cut: impl Fn(usize) -> bool) -> Self {
        let mut all = Self::default();
        // Triangles are stored face by face.
        let mut ends = Vec::new();
        for (t, triangle) in mesh.elements.iter().enumerate() {
            ends.resize(triangle.face + 1, t);
            ends[triangle.face] = t + 1;
        }
        let mut first = 0;
        for end in ends {
            let whole = first < end && !cut(mesh.elements[first].wall);
            let map = whole.then(|| FaceMap::new(mesh, first, end));
            all.faces.push(PlaneFace {
                first: first as u32,
                end: end as u32,
                plane: plane_of(mesh, first, map.is_some()),
                edges: Vec::new(),
                map,
            });
            first = end;
        }
        all.follow(mesh);
        all
    }

    pub fn follow(&mut self, mesh: &Mesh<3>) {
        let corner = |e: &FaceEdge, k: usize| Corner::new(mesh, e.nodes[k], e.images[k]);
        for (face, drawn) in self.faces.iter_mut().zip(&mesh.faces) {
            face.plane = plane_of(mesh, face.first as usize, face.map.is_some());
            face.edges.clear();
            let edges = drawn.edges.iter().map(|e| [corner(e, 0), corner(e, 1)]);
            face.edges.extend(edges);
        }
        self.patches.clear();
        self.circles.clear();
        if self.faces.iter().all(|face| face.map.is_some()) {
            return;
        }
        for (t, triangle) in mesh.elements.iter().enumerate() {
            let plane = &self.faces[triangle.face].plane;
            let (patch, circle) = Patch::new(plane, mesh.corners(t), triangle.measure);
            self.patches.push(patch);
            self.circles.push(circle);
        }
    }
}

/// The triangles of a face as they are drawn, in coordinates that move with its first one, by square cells.
#[derive(Clone, Debug)]
pub(crate) struct FaceMap {
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

/// The plane of a face, with its origin at the first corner of a triangle; the first axis is along its first side if it
/// has to move with the triangle.
fn plane_of(mesh: &Mesh<3>, triangle: usize, moves: bool) -> Plane {
    let ([a, b, _], normal) = (mesh.corners(triangle), mesh.elements[triangle].normal);
    match moves {
        true => Plane::along(sub(b, a), a, normal),
        false => Plane::new(a, normal),
    }
}

impl FaceMap {
    /// Of the triangles from `first` to `end` of a mesh, which lie in one plane.
    pub fn new(mesh: &Mesh<3>, first: usize, end: usize) -> Self {
        let plane = plane_of(mesh, first, true);
        let flat = |t: usize| mesh.corners(t).map(|corner| plane.foot(corner));
        let corners: Vec<_> = (first..end).map(flat).collect();
        let [lower, upper] = bounds(corners.iter().flatten().copied());
        let count = [0, 1].map(|k| (((upper[k] - lower[k]) / mesh.spacing) as usize).max(1));
        let map = FaceMap {
            first: first as u32,
            lower,
            upper,
            count,
            per_length: [0, 1].map(|k| count[k] as f64 / (upper[k] - lower[k])),
            starts: Vec::new(),
            triangles: Vec::new(),
            corners,
        };
        let cells = |t: usize| map.cells(bounds(map.corners[t]));
        let (starts, triangles) = listed(map.corners.len(), count[0] * count[1], cells);
        FaceMap {
            starts,
            triangles,
            ..map
        }
    }

    /// The cell of a place along an axis, the nearest one of places outside.
    #[inline]
    fn cell(&self, x: f64, axis: usize) -> usize {
        let place = (x - self.lower[axis]) * self.per_length[axis];
        (place.max(0.0) as usize).min(self.count[axis] - 1)
    }

    /// Cells that a box meets, row by row.
    fn cells(&self, [low, high]: [[f64; 2]; 2]) -> impl Iterator<Item = usize> {
        let range = |k: usize| self.cell(low[k], k)..=self.cell(high[k], k);
        let (columns, along) = (range(0), self.count[0]);
        range(1).flat_map(move |j| columns.clone().map(move |i| j * along + i))
    }

    fn of_cell(&self, cell: usize) -> &[u32] {
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
        for &t in self.of_cell(j * self.count[0] + i) {
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
                    for &t in self.of_cell(row * self.count[0] + column) {
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
        for cell in self.cells(widened([x; 2], distance)) {
            found.extend(self.of_cell(cell).iter().map(|t| self.first + t));
        }
        found.sort_unstable();
        found.dedup();
    }
}

fn weights([a, b, c]: &[[f64; 2]; 3], x: [f64; 2]) -> [f64; 3] {
    let (u, v, w) = (sub(*b, *a), sub(*c, *a), sub(x, *a));
    let whole = perp(u, v);
    let [second, third] = [perp(w, v) / whole, perp(u, w) / whole];
    [1.0 - second - third, second, third]
}

/// Squared distance of a place outside a triangle from it, m², and the barycentric coordinates of the nearest place.
fn nearest_in(corners: &[[f64; 2]; 3], x: [f64; 2]) -> (f64, [f64; 3]) {
    let mut found = (f64::INFINITY, [1.0, 0.0, 0.0]);
    for k in 0..3 {
        let (part, off) = foot_on_edge(x, [corners[k], corners[(k + 1) % 3]]);
        let distance2 = dot(off, off);
        if distance2 < found.0 {
            let mut weights = [0.0; 3];
            (weights[k], weights[(k + 1) % 3]) = (1.0 - part, part);
            found = (distance2, weights);
        }
    }
    found
}
