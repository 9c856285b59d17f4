//! The solid angle of the fluid around a node, and its share of the wall.

use std::f64::consts::{PI, TAU};

use sph_core::Sets;

use super::places::{HalfEdge, Site, half_edges};
use crate::geometry::mesh::{FreeEdge, Mesh};
use crate::geometry::vector::{Point, cross, dot, norm, sub};

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
