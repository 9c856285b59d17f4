//! The fluid's side of surfaces.

use sph_core::Winding;

use crate::geometry::mesh::{Mesh, RayQueries, SAME_DISTANCE, SAME_HEIGHT, Sides, angle};
use crate::geometry::vector::{Point, add, bounds, norm, sub};

/// Images of a periodic wall on either side reach this many extents of it, and are so many at most.
const IMAGES: (f64, f64) = (5.0, 16.0);

impl RayQueries<3> for Mesh<3> {
    /// Seen along the ray, the point is within a triangle if it is on the left of all edges or on the right of all.
    /// Both triangles at an edge compute the same number but for its sign, and a point on an edge counts as moved by an
    /// infinitely small step, so that a ray through an edge or a node meets a closed surface as often as one beside it.
    fn crossing(corners: [Point; 3], _: Point, along: usize) -> Option<(f64, i32)> {
        let [u, v] = [(along + 1) % 3, (along + 2) % 3];
        let side = |i: usize| {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            let area = a[u] * b[v] - a[v] * b[u];
            let upwards = b[v] > a[v] || (b[v] == a[v] && b[u] < a[u]);
            (area, area > 0.0 || (area == 0.0 && upwards))
        };
        let [ab, bc, ca] = [side(0), side(1), side(2)];
        let sum = ab.0 + bc.0 + ca.0;
        if ab.1 != bc.1 || bc.1 != ca.1 || sum == 0.0 {
            return None;
        }
        let heights = corners.map(|c| c[along]);
        let height = (bc.0 * heights[0] + ca.0 * heights[1] + ab.0 * heights[2]) / sum;
        Some((height, if ab.1 { -1 } else { 1 }))
    }

    fn is_fluid_beyond(&self, along: usize) -> bool {
        let mut free = vec![false; self.nodes.len()];
        for node in self.free_edges.iter().flat_map(|e| e.nodes) {
            free[node] = true;
        }
        let heights = || {
            let nodes = self.nodes.iter().zip(&free).filter(|(_, free)| !**free);
            nodes.map(|(node, _)| node.position[along])
        };
        let top = heights().fold(f64::NEG_INFINITY, f64::max);
        let scale = heights().fold(0.0, |scale: f64, h| scale.max(h.abs()));
        let mut outward: std::collections::BTreeMap<usize, f64> = Default::default();
        for (e, element) in self.elements.iter().enumerate() {
            for (corner, node) in element.nodes.iter().enumerate() {
                let height = self.nodes[*node].position[along];
                if !free[*node] && height >= top - SAME_HEIGHT * scale {
                    let weight = angle(&self.corners(e), corner);
                    *outward.entry(*node).or_default() += weight * element.normal[along];
                }
            }
        }
        outward.values().all(|up| *up >= -SAME_DISTANCE)
    }

    fn wind(&self, sides: &mut Sides<3>) {
        sides.winding = winding(self);
    }

    fn wound(&self, sides: &Sides<3>, point: Point) -> Option<f64> {
        sides.winding.as_ref().map(|winding| -winding.at(&point))
    }
}

/// Of the faces, each a fan over its edges, and of their images where one axis is periodic.
fn winding(mesh: &Mesh<3>) -> Option<Winding> {
    let periodic = mesh.domain.periodic;
    if mesh.free_edges.is_empty() || periodic.iter().filter(|p| **p).count() > 1 {
        return None;
    }
    let ends = (0..mesh.faces.len()).map(|f| mesh.face_edges_from([0.0; 3], f, [0; 3]));
    let faces: Vec<Vec<[Point; 2]>> = ends.map(Iterator::collect).collect();
    let fan = |edges: &Vec<[Point; 2]>| {
        let apex = edges[0][0];
        let others = edges.iter().filter(move |[a, b]| *a != apex && *b != apex);
        others.map(move |[a, b]| [apex, *a, *b]).collect::<Vec<_>>()
    };
    let own: Vec<[Point; 3]> = faces.iter().flat_map(fan).collect();
    let Some(axis) = (0..3).find(|k| periodic[*k]) else {
        return Some(Winding::new(own));
    };
    let [low, high] = bounds(own.iter().flatten().copied());
    let images = IMAGES.0 * norm(sub(high, low)) / mesh.domain.periods()[axis];
    let images = images.ceil().min(IMAGES.1) as i32;
    let all = (-images..=images).flat_map(|n| {
        let image = std::array::from_fn(|k| if k == axis { n } else { 0 });
        let shift = mesh.domain.shift(image);
        own.iter().map(move |t| t.map(|p| add(p, shift)))
    });
    Some(Winding::new(all.collect()))
}
