//! On which side of the walls a point is.

use surface_file::Winding;

use super::closest::{Feature, nearest_to_origin};
use super::grid::{NearTriangle, TriangleGrid};
use super::sides::{Columns, Sides};
use super::triangle_mesh::TriangleMesh;
use super::vector::{Point, add, bounds, dot, norm, sub};

/// Crossings of the ray closer to each other than this part of the wall's extent are one place.
const SAME_HEIGHT: f64 = 1e-12;

/// Places whose distances differ by less than this part are equally near.
const SAME_DISTANCE: f64 = 1e-9;

/// Spacings within which the nearest wall decides if there are free edges.
const FRONT: f64 = 4.0;

/// Walls that wind around a place by more than this enclose it, though they have openings.
const ENCLOSED: f64 = 0.5;

/// Images of a periodic wall on either side reach this many extents of it, and are so many at most.
const IMAGES: (f64, f64) = (5.0, 16.0);

impl TriangleMesh {
    /// Whether a point is in the fluid, as the walls see it.
    ///
    /// A ray goes from the point along an axis that is not periodic (z if it may choose). Among the
    /// crossings at one height opposite ones cancel, as do the faces of two blocks that touch; the
    /// first height where one is left decides by the side that faces the point. A ray that meets
    /// nothing asks the wall that reaches furthest along it; if all axes are periodic, it goes on
    /// along the next axis until it meets a wall. Without walls every point is in the fluid.
    ///
    /// Walls with free edges have a front: if there are any, the triangle nearest to the point decides
    /// where one is within four spacings. Farther away their winding number decides where it is more than ½: the walls
    /// enclose the point but for their openings. A point on a wall within rounding may be given either answer.
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
        if let Some(winding) = &sides.winding {
            let enclosed = -winding.at(&point);
            if enclosed.abs() > ENCLOSED {
                return enclosed > 0.0;
            }
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

    /// How far walls with free edges enclose a point: their winding number, positive where they face it; none of walls
    /// that are closed or repeat themselves in two directions.
    pub fn enclosed(&self, point: [f64; 3]) -> Option<f64> {
        let sides = self.sides.get_or_init(|| sides(self));
        sides.winding.as_ref().map(|winding| -winding.at(&point))
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
        winding: winding(mesh),
    }
}

/// Of the faces, each a fan over its edges, and of their images where one axis is periodic.
fn winding(mesh: &TriangleMesh) -> Option<Winding> {
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
        let shift = mesh
            .domain
            .shift(std::array::from_fn(|k| if k == axis { n } else { 0 }));
        own.iter().map(move |t| t.map(|p| add(p, shift)))
    });
    Some(Winding::new(all.collect()))
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
