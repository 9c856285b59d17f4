//! The fluid's side of lines.

use std::f64::consts::TAU;

use crate::geometry::mesh::{Mesh, RayQueries, SAME_HEIGHT, Sides};
use crate::geometry::vector::{dot, perp, sub};

impl RayQueries<2> for Mesh<2> {
    fn crossing([a, b]: [[f64; 2]; 2], normal: [f64; 2], along: usize) -> Option<(f64, i32)> {
        let x = [a[1 - along], b[1 - along]];
        if (x[0] <= 0.0) == (x[1] <= 0.0) {
            return None;
        }
        let part = x[0] / (x[0] - x[1]);
        let height = a[along] + part * (b[along] - a[along]);
        Some((height, if normal[along] < 0.0 { 1 } else { -1 }))
    }

    fn is_fluid_beyond(&self, along: usize) -> bool {
        let joined = || {
            let nodes = self.nodes.iter().zip(&self.beside);
            nodes.filter_map(|(node, [previous, next])| {
                Some((node.position[along], (*previous)?, (*next)?))
            })
        };
        let outward = |previous: usize, next: usize| {
            self.elements[previous].normal[along] + self.elements[next].normal[along]
        };
        let top = joined().fold(f64::NEG_INFINITY, |top, (h, ..)| top.max(h));
        let scale = joined().fold(0.0, |scale: f64, (h, ..)| scale.max(h.abs()));
        // Both faces of a plate of zero thickness are as high; the upper one decides.
        let furthest = joined()
            .filter(|(h, ..)| *h >= top - SAME_HEIGHT * scale)
            .max_by(|a, b| outward(a.1, a.2).total_cmp(&outward(b.1, b.2)));
        let Some((_, previous, next)) = furthest else {
            return true;
        };
        let outward = outward(previous, next);
        if outward != 0.0 {
            return outward > 0.0;
        }
        // A spike: the fluid is outside when it is travelled clockwise or folds back.
        let [t, u] = [previous, next].map(|s| self.elements[s].tangent());
        perp(t, u) <= 0.0
    }

    fn wind(&self, sides: &mut Sides<2>) {
        if self.free_ends.is_empty() || self.domain.periodic != [false; 2] {
            return;
        }
        let edges = self.elements.chunk_by(|a, b| a.face == b.face);
        let ends = edges.map(|e| [e[0].nodes[0], e[e.len() - 1].nodes[1]]);
        sides.lines = ends.collect();
    }

    fn wound(&self, sides: &Sides<2>, point: [f64; 2]) -> Option<f64> {
        let angle = |ends: &[usize; 2]| {
            let [a, b] = ends.map(|v| sub(self.nodes[v].position, point));
            perp(a, b).atan2(dot(a, b))
        };
        let sum: f64 = sides.lines.iter().map(angle).sum();
        (!sides.lines.is_empty()).then_some(sum / TAU)
    }
}
