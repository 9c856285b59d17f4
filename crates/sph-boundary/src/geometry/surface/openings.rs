//! Edges that no other triangle continues.

use std::cmp::Ordering;
use std::collections::HashMap;

#[cfg(feature = "plugins")]
use sph_core::number::plain;
use sph_core::{BoxTree, Sets};

use crate::error::{BoundaryError, Place, Result};
use crate::geometry::mesh::{FreeEdge, Mesh, Opening};
use crate::geometry::vector::{Point, add, along, bounds, dot, norm, sub, widened};

impl Mesh<3> {
    /// Joins free edges that share a node; `pieces` are the first nodes of the straight pieces around the openings.
    pub(super) fn find_openings(&mut self, pieces: impl Iterator<Item = usize>) {
        let mut rims = Sets::new(self.nodes.len());
        self.free_edges.iter().for_each(|e| rims.join(e.nodes));
        let mut numbers: HashMap<usize, usize> = HashMap::new();
        let mut ends: Vec<Vec<Point>> = Vec::new();
        for e in 0..self.free_edges.len() {
            let (edge, next) = (self.free_edges[e], ends.len());
            let opening = *numbers.entry(rims.root(edge.nodes[0])).or_insert(next);
            ends.resize_with(numbers.len(), Vec::new);
            ends[opening].extend(self.free_edge_ends(&edge));
            self.free_edges[e].opening = opening;
        }
        let opening = |ends: Vec<Point>| {
            let [low, high] = bounds(ends);
            Opening {
                edges: 0,
                extent: norm(sub(high, low)),
                centre: along(low, 0.5, sub(high, low)),
            }
        };
        self.openings = ends.into_iter().map(opening).collect();
        for node in pieces {
            if let Some(opening) = numbers.get(&rims.root(node)) {
                self.openings[*opening].edges += 1;
            }
        }
    }

    /// Both ends of a free edge, m.
    pub fn free_edge_ends(&self, edge: &FreeEdge) -> [Point; 2] {
        [0, 1].map(|k| self.node_from([0.0; 3], edge.nodes[k], edge.images[k]))
    }

    /// Refuses a free edge within the kernel radius of any point, where γ is not defined.
    ///
    /// # Errors
    /// Names the wall, its opening, the nearest point and the place next to it. Lengths in metres.
    pub fn check_free_edges(&self, points: &[Point], kernel_radius: f64) -> Result<()> {
        if self.free_edges.is_empty() || points.is_empty() {
            return Ok(());
        }
        let near = Rims::new(self, bounds(points.iter().copied()), kernel_radius);
        let all = points.iter().enumerate();
        let all = all.filter_map(|(particle, point)| Some((particle, near.nearest(*point)?)));
        let nearest = all.min_by(|a, b| a.1.0.partial_cmp(&b.1.0).unwrap_or(Ordering::Equal));
        let Some((particle, ((_, distance), edge, at))) = nearest else {
            return Ok(());
        };
        let free = &self.free_edges[edge];
        let opening = &self.openings[free.opening];
        let remedy = match free.met {
            Some(other) => format!(
                "wall `{}` meets it there and does not continue it: turn the one that faces the other way",
                self.walls[other]
            ),
            None => "close the wall or extend it".to_string(),
        };
        let why = format!(
            "is open: {} edge(s) without a neighbour surround an opening of {} m around {}, and at {} one of them \
             is {} m from particle {particle}, within the kernel radius {} m: {remedy}",
            opening.edges,
            plain(opening.extent),
            Place::from(opening.centre),
            Place::from(at),
            plain(distance),
            plain(kernel_radius)
        );
        Err(BoundaryError::unfit(&self.walls[free.wall], why))
    }
}

#[cfg(not(feature = "plugins"))]
fn plain(x: f64) -> String {
    x.to_string()
}

/// Images of the free edges that come near to some points.
struct Rims {
    radius: f64,
    /// Edges with their ends and the normals of their triangles.
    ends: Vec<(usize, [Point; 2], Point)>,
    tree: BoxTree<3>,
}

impl Rims {
    fn new(mesh: &Mesh<3>, points: [Point; 2], radius: f64) -> Self {
        let domain = &mesh.domain;
        let mut all = Vec::new();
        for (e, edge) in mesh.free_edges.iter().enumerate() {
            let ends = mesh.free_edge_ends(edge);
            let normal = mesh.elements[edge.triangle].normal;
            for image in domain.images_within(widened(points, radius), bounds(ends)) {
                let shift = domain.shift(image);
                all.push((e, ends.map(|p| add(p, shift)), normal));
            }
        }
        let boxes = all.iter().map(|(_, ends, _)| bounds(*ends));
        Rims {
            radius,
            tree: BoxTree::new(boxes.collect()),
            ends: all,
        }
    }

    /// Edge near a point, if one is within the radius: true if the point is behind it, the distance, the edge and the
    /// place on it: of the nearest in front of which the point is, for that wall should go on there, else of the
    /// nearest.
    fn nearest(&self, point: Point) -> Option<((bool, f64), usize, Point)> {
        let mut near = Vec::new();
        self.tree
            .each(widened([point; 2], self.radius), |n| near.push(n));
        near.sort_unstable();
        let edges = near.into_iter().map(|n| {
            let (edge, [a, b], normal) = self.ends[n];
            let (t, to) = (sub(b, a), sub(point, a));
            let part = (dot(to, t) / dot(t, t)).clamp(0.0, 1.0);
            let at = along(a, part, t);
            ((dot(to, normal) <= 0.0, norm(sub(point, at))), edge, at)
        });
        let near = edges.filter(|((_, distance), ..)| *distance < self.radius);
        near.min_by(|a, b| a.0.partial_cmp(&b.0).unwrap_or(Ordering::Equal))
    }
}
