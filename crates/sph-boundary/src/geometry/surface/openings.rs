//! Angles and shares of nodes, and edges that no other triangle continues.

use std::cmp::Ordering;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

#[cfg(feature = "plugins")]
use sph_core::number::plain;
use sph_core::{BoxTree, Sets};

use super::places::{HalfEdge, Site, half_edges};
use crate::error::{BoundaryError, Place, Result};
use crate::geometry::mesh::{FreeEdge, Mesh, Opening};
use crate::geometry::vector::{Point, add, along, bounds, cross, dot, norm, sub, widened};

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

/// Two triangles folded onto each other within this angle leave the fluid all around their edge.
const FOLD: f64 = 1e-9;

impl Mesh<3> {
    /// Sets θ and the size of all nodes; returns the edges that no other triangle continues.
    ///
    /// The fluid at a node is a spherical polygon whose angles are those between triangles that share an edge, measured
    /// in the fluid, β = π + δ. Its area is 2π + Σ δ (Gauss and Bonnet), and θ = (2π + Σ δ) / 4π. Where several
    /// surfaces touch in a node their areas add up modulo 4π. Around a node on a free edge the wall goes straight on:
    /// the folds that it has count twice.
    pub(super) fn weigh(&mut self) -> Vec<FreeEdge> {
        let halves = half_edges(self.elements.iter().map(|triangle| {
            [0, 1, 2].map(|k| Site {
                id: triangle.nodes[k] as u32,
                image: triangle.images[k],
            })
        }));
        let mut fans = Sets::new(3 * self.elements.len());
        let mut folds = vec![0.0; self.nodes.len()];
        let mut open = vec![false; self.nodes.len()];
        let mut free = Vec::new();
        for run in halves.chunk_by(|a, b| a.key == b.key) {
            let (mut with, mut rest): (Vec<&HalfEdge>, Vec<&HalfEdge>) =
                run.iter().partition(|h| h.forward);
            if with.len() > rest.len() && !rest.is_empty() {
                // Where one is left over, the narrowest sectors are those of the fluid.
                let narrowest = |half: &&HalfEdge| {
                    let folds = rest.iter().map(|other| self.fold(half, other));
                    folds.fold(f64::INFINITY, f64::min)
                };
                with.sort_by(|a, b| narrowest(a).total_cmp(&narrowest(b)));
            }
            let met = |half: &HalfEdge| {
                let wall = |h: &HalfEdge| self.elements[h.triangle as usize].wall;
                run.iter().map(wall).find(|w| *w != wall(half))
            };
            for half in with {
                // The fluid's sector beside a triangle ends at the next one around the edge.
                let angle = |other: &HalfEdge| self.fold(half, other);
                let next =
                    (0..rest.len()).min_by(|a, b| angle(rest[*a]).total_cmp(&angle(rest[*b])));
                let Some(next) = next else {
                    free.push(self.free_edge(half, met(half)));
                    continue;
                };
                let other = rest.swap_remove(next);
                let fold = angle(other);
                for end in 0..2 {
                    let corner = (half.edge as usize + end) % 3;
                    let opposite = (other.edge as usize + 1 - end) % 3;
                    folds[self.elements[half.triangle as usize].nodes[corner]] += fold;
                    let corners = [(half.triangle, corner), (other.triangle, opposite)];
                    fans.join(corners.map(|(t, corner)| 3 * t as usize + corner));
                }
            }
            free.extend(rest.into_iter().map(|half| self.free_edge(half, met(half))));
        }
        for node in free.iter().flat_map(|edge| edge.nodes) {
            open[node] = true;
        }
        let mut count = vec![0u32; self.nodes.len()];
        let mut area = vec![0.0; self.nodes.len()];
        for (t, triangle) in self.elements.iter().enumerate() {
            let parts = parts(self.corners(t));
            for (corner, node) in triangle.nodes.iter().enumerate() {
                count[*node] += u32::from(fans.root(3 * t + corner) == 3 * t + corner);
                area[*node] += triangle.measure * parts[corner];
            }
        }
        for (n, node) in self.nodes.iter_mut().enumerate() {
            let twice = if open[n] { 2.0 } else { 1.0 };
            let angle = TAU * f64::from(count[n].max(1)) + twice * folds[n];
            let theta = angle / (4.0 * PI);
            node.theta = match count[n] {
                0 | 1 => theta.clamp(0.0, 1.0),
                _ => theta.rem_euclid(1.0),
            };
            node.size = area[n] / (self.spacing * self.spacing);
        }
        free
    }

    /// δ = β − π between two triangles along an edge of the first, positive where the fluid has
    /// more than half the space; exactly 0 within one plane.
    fn fold(&self, half: &HalfEdge, other: &HalfEdge) -> f64 {
        let [a, b] = [half, other].map(|h| &self.elements[h.triangle as usize]);
        if a.face == b.face {
            return 0.0;
        }
        let corners: [Point; 3] = self.corners(half.triangle as usize);
        let from = half.edge as usize;
        let edge = sub(corners[(from + 1) % 3], corners[from]);
        let sine = dot(cross(a.normal, b.normal), edge) / norm(edge);
        let cosine = dot(a.normal, b.normal);
        if cosine < 0.0 && sine.abs() <= FOLD {
            return PI;
        }
        sine.atan2(cosine)
    }

    fn free_edge(&self, half: &HalfEdge, met: Option<usize>) -> FreeEdge {
        let triangle = &self.elements[half.triangle as usize];
        let ends = [half.edge as usize, (half.edge as usize + 1) % 3];
        FreeEdge {
            nodes: ends.map(|k| triangle.nodes[k]),
            images: ends.map(|k| triangle.images[k]),
            wall: triangle.wall,
            triangle: half.triangle as usize,
            opening: 0,
            met,
        }
    }
}

/// Two sides are at right angles if their cosine is below this.
const RIGHT: f64 = 1e-6;

/// Parts of a triangle that its corners answer for: thirds, and of half a rectangle the part nearest to each corner, so
/// that the rectangle's corners have a quarter of it each, whichever way it is cut.
fn parts(corners: [Point; 3]) -> [f64; 3] {
    let right = |k: usize| {
        let sides = [1, 2].map(|n| sub(corners[(k + n) % 3], corners[k]));
        dot(sides[0], sides[1]).abs() <= RIGHT * norm(sides[0]) * norm(sides[1])
    };
    match (0..3).find(|k| right(*k)) {
        Some(right) => std::array::from_fn(|k| if k == right { 0.5 } else { 0.25 }),
        None => [1.0 / 3.0; 3],
    }
}
