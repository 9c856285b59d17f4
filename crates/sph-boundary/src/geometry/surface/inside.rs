//! On which side of the walls a point is.

use super::closest::{Feature, nearest_to_origin};
use super::grid::{NearTriangle, TriangleGrid};
use super::sides::{Columns, Sides};
use super::triangle_mesh::TriangleMesh;
use super::vector::{Point, dot, norm, sub};

/// Crossings of the ray closer to each other than this part of the wall's extent are one place.
const SAME_HEIGHT: f64 = 1e-12;

/// Places whose distances differ by less than this part are equally near.
const SAME_DISTANCE: f64 = 1e-9;

/// Spacings within which the nearest wall decides if there are free edges.
const FRONT: f64 = 4.0;

impl TriangleMesh {
    /// Whether a point is in the fluid, as the walls see it.
    ///
    /// A ray goes from the point along an axis that is not periodic (z if it may choose). Among the
    /// crossings at one height opposite ones cancel, as do the faces of two blocks that touch; the
    /// first height where one is left decides by the side that faces the point. A ray that meets
    /// nothing asks the wall that reaches furthest along it; if all axes are periodic, it goes on
    /// along the next axis until it meets a wall. Without walls every point is in the fluid.
    ///
    /// Walls with free edges have no inside, but they have a front: if there are any, the triangle
    /// nearest to the point decides where one is within four spacings. A point on a wall within
    /// rounding may be given either answer.
    ///
    /// The first call after a motion sorts the triangles into columns; then the cost is that of the
    /// triangles in one column.
    pub fn contains(&self, point: [f64; 3]) -> bool {
        let sides = self.sides.get_or_init(|| sides(self));
        let (lower, periods) = (self.domain.lower, self.domain.periods());
        let point: Point = std::array::from_fn(|k| match self.domain.periodic[k] {
            true => lower[k] + (point[k] - lower[k]).rem_euclid(periods[k]),
            false => point[k],
        });
        if let Some(grid) = &sides.front
            && let Some(front) = self.in_front(grid, point)
        {
            return front;
        }
        let mut from = point;
        for columns in &sides.columns {
            if let Some(fluid) = self.faced(columns, from) {
                return fluid;
            }
            // A line that meets nothing is all on one side.
            from[columns.along] = sides.target[columns.along];
        }
        sides.beyond
    }

    /// Whether the first wall that a ray meets faces the point; none if it meets nothing.
    fn faced(&self, columns: &Columns, point: Point) -> Option<bool> {
        let mut crossings = self.crossings(columns, point);
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (furthest, _) = crossings.last()?;
        let scale = furthest.abs() + point[columns.along].abs();
        let mut rest = crossings.as_slice();
        while let Some(&(height, _)) = rest.first() {
            let count = rest.partition_point(|(h, _)| *h <= height + SAME_HEIGHT * scale);
            let net: i32 = rest[..count].iter().map(|(_, facing)| facing).sum();
            if net != 0 {
                return Some(net > 0);
            }
            rest = &rest[count..];
        }
        None
    }

    /// Heights above the point at which the ray meets a triangle, with +1 where the fluid is on the
    /// near side of it and −1 where it is on the far side.
    ///
    /// Seen along the ray, the point is within a triangle if it is on the left of all edges or on
    /// the right of all. Both triangles at an edge compute the same number but for its sign, and a
    /// point on an edge counts as moved by an infinitely small step, so that a ray through an edge
    /// or a node meets a closed surface as often as one beside it.
    fn crossings(&self, columns: &Columns, point: Point) -> Vec<(f64, i32)> {
        let [u, v] = columns.across;
        let mut crossings = Vec::new();
        for near in columns.column(point) {
            let corners = self.corners_from(point, *near);
            let side = |i: usize| {
                let (a, b) = (corners[i], corners[(i + 1) % 3]);
                let area = a[u] * b[v] - a[v] * b[u];
                let upwards = b[v] > a[v] || (b[v] == a[v] && b[u] < a[u]);
                (area, area > 0.0 || (area == 0.0 && upwards))
            };
            let [ab, bc, ca] = [side(0), side(1), side(2)];
            let sum = ab.0 + bc.0 + ca.0;
            if ab.1 != bc.1 || bc.1 != ca.1 || sum == 0.0 {
                continue;
            }
            let heights = corners.map(|c| c[columns.along]);
            let mut height = (bc.0 * heights[0] + ca.0 * heights[1] + ab.0 * heights[2]) / sum;
            if self.domain.periodic[columns.along] {
                height = height.rem_euclid(self.domain.periods()[columns.along]);
            }
            if height > 0.0 {
                crossings.push((height, if ab.1 { -1 } else { 1 }));
            }
        }
        crossings
    }

    /// Whether the nearest triangle has the point in front of it; none if all are far.
    ///
    /// At an edge or a node the mean normal decides, weighted with the angle of each triangle
    /// there: Bærentzen and Aanæs, IEEE Trans. Vis. Comput. Graph. 11 (2005) 243.
    fn in_front(&self, grid: &TriangleGrid, point: Point) -> Option<bool> {
        let radius = FRONT * self.spacing;
        let mut nearest = f64::INFINITY;
        let mut front = 0.0;
        for near in grid.near(self, point, radius) {
            let corners = self.corners_from(point, near);
            let (offset, feature) = nearest_to_origin(corners);
            let distance = norm(offset);
            if distance > nearest * (1.0 + SAME_DISTANCE) {
                continue;
            }
            if distance < nearest * (1.0 - SAME_DISTANCE) {
                (nearest, front) = (distance, 0.0);
            }
            let weight = match feature {
                Feature::Face => std::f64::consts::TAU,
                Feature::Edge(_) => std::f64::consts::PI,
                Feature::Corner(k) => angle(corners, k as usize),
            };
            front -= weight * dot(offset, self.triangles[near.triangle as usize].normal);
        }
        nearest.is_finite().then_some(front >= 0.0)
    }
}

/// Angle of a triangle at a corner, rad.
fn angle(corners: [Point; 3], k: usize) -> f64 {
    let [a, b] = [1, 2].map(|n| sub(corners[(k + n) % 3], corners[k]));
    (dot(a, b) / (norm(a) * norm(b))).clamp(-1.0, 1.0).acos()
}

/// Columns along the axes that a ray may take, and what decides where there are none.
fn sides(mesh: &TriangleMesh) -> Sides {
    let periodic = mesh.domain.periodic;
    let open = [2, 1, 0].into_iter().find(|k| !periodic[*k]);
    let first = mesh.triangles.first();
    let axes = match (open, first) {
        (Some(k), _) => vec![k],
        (None, None) => Vec::new(),
        (None, Some(triangle)) => {
            let mut axes = vec![0, 1, 2];
            let facing = |k: &usize| triangle.normal[*k].abs();
            axes.sort_by(|a, b| facing(a).total_cmp(&facing(b)));
            axes
        }
    };
    Sides {
        target: first.map_or([0.0; 3], |triangle| triangle.centre),
        columns: axes.iter().map(|k| columns(mesh, *k)).collect(),
        beyond: open.is_none_or(|k| mesh.fluid_beyond(k)),
        front: (!mesh.free_edges.is_empty())
            .then(|| TriangleGrid::build(mesh, FRONT * mesh.spacing)),
    }
}

/// The triangles by the columns along an axis.
fn columns(mesh: &TriangleMesh, along: usize) -> Columns {
    let across = [(along + 1) % 3, (along + 2) % 3];
    Columns::new(along, across, &images(mesh, across))
}

/// Images of the triangles that lie over the box, with their bounds across the ray.
fn images(mesh: &TriangleMesh, across: [usize; 2]) -> Vec<(NearTriangle, [[f64; 2]; 2])> {
    let mut images = Vec::with_capacity(mesh.triangles.len());
    for t in 0..mesh.triangles.len() {
        let corners = mesh.corners(t);
        let ends = across.map(|k| {
            let x = corners.map(|c| c[k]);
            [x[0].min(x[1]).min(x[2]), x[0].max(x[1]).max(x[2])]
        });
        let range = |k: usize| {
            let margin = 1e-9 * mesh.spacing;
            let images = mesh
                .domain
                .images(across[k], ends[k][0], ends[k][1], margin);
            (*images.start()).max(-127) as i8..=(*images.end()).min(127) as i8
        };
        for i in range(0) {
            for j in range(1) {
                let mut image = [0; 3];
                image[across[0]] = i;
                image[across[1]] = j;
                let near = NearTriangle {
                    triangle: t as u32,
                    image,
                };
                let shift = mesh.domain.shift(image.map(i32::from));
                let bound = |end: usize| [0, 1].map(|k| ends[k][end] + shift[across[k]]);
                images.push((near, [bound(0), bound(1)]));
            }
        }
    }
    images
}

impl TriangleMesh {
    /// Whether the fluid lies beyond all walls along the positive direction of an axis.
    fn fluid_beyond(&self, along: usize) -> bool {
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
        for (t, triangle) in self.triangles.iter().enumerate() {
            for (corner, node) in triangle.nodes.iter().enumerate() {
                let height = self.nodes[*node].position[along];
                if !free[*node] && height >= top - SAME_HEIGHT * scale {
                    let weight = angle(self.corners(t), corner);
                    *outward.entry(*node).or_default() += weight * triangle.normal[along];
                }
            }
        }
        outward.values().all(|up| *up >= -SAME_DISTANCE)
    }
}
