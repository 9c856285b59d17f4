//! From polylines to segments, and the side of the fluid.

use std::f64::consts::TAU;

use super::joints::{Continuation, Joints, joints};
use crate::error::{BoundaryError, MOST_PAIRS, Place, Result};
use crate::geometry::checks::{check_area, check_crossings, check_points, short_edges};
use crate::geometry::mesh::{Element, Mesh, Node, SAME_HEIGHT, SAME_PLACE, Sides, Simplices};
use crate::geometry::vector::{dot, perp, sub};
use crate::{FreeEnd, PeriodicBox, Polyline, WallEnd};

/// Two segments folded onto each other within this angle leave the fluid all around their node.
const FOLD: f64 = 1e-9;

impl Mesh<2> {
    /// Cuts the walls into segments of about `spacing` metres.
    ///
    /// # Errors
    /// A wall that is degenerate, crosses itself or another one, or meets another end to end with the fluid on the
    /// other side. A wall that ends freely is not refused here: see [`Mesh::check_free_ends`].
    pub fn build(polylines: &[Polyline], spacing: f64, domain: &PeriodicBox) -> Result<Self> {
        let names = polylines.iter().map(|line| line.name.clone()).collect();
        let walls: Vec<usize> = (0..polylines.len()).collect();
        Self::of_pieces((polylines, &walls), names, spacing, domain)
    }

    /// The same for pieces, each with the number of its wall.
    pub(crate) fn of_pieces(
        (polylines, walls): (&[Polyline], &[usize]),
        names: Vec<String>,
        spacing: f64,
        domain: &PeriodicBox,
    ) -> Result<Self> {
        BoundaryError::check_positive("wall spacing", spacing)?;
        domain.check()?;
        let tolerance = SAME_PLACE * spacing;
        for line in polylines {
            check_points(line)?;
        }
        check_crossings(polylines, tolerance, domain, MOST_PAIRS)?;
        for line in polylines {
            check_area(line, tolerance)?;
        }
        let joints = joints(polylines, tolerance, domain)?;
        let groups: Vec<usize> = (0..names.len()).collect();
        let mut mesh = Mesh::empty(names, &groups, spacing, domain);
        let remarks = polylines.iter().flat_map(|line| short_edges(line, spacing));
        mesh.warnings = remarks.collect();
        let first_nodes = first_nodes(polylines, &joints, spacing);
        for (piece, line) in polylines.iter().enumerate() {
            let wall = walls[piece];
            mesh.cut(wall, line, joints.after[piece], &first_nodes);
            let mut free = |end, node| mesh.free_ends.push(FreeEnd { wall, end, node });
            if joints.starts_free[piece] {
                free(WallEnd::First, first_nodes[piece]);
            }
            if joints.after[piece].is_none() {
                free(WallEnd::Last, mesh.nodes.len() - 1);
            }
        }
        mesh.reference = mesh.nodes.iter().map(|node| node.position).collect();
        for segment in 0..mesh.elements.len() {
            mesh.measure(segment);
        }
        mesh.beside = vec![[None; 2]; mesh.nodes.len()];
        for (s, segment) in mesh.elements.iter().enumerate() {
            mesh.beside[segment.nodes[0]][1] = Some(s);
            mesh.beside[segment.nodes[1]][0] = Some(s);
        }
        mesh.find_angles();
        mesh.size_nodes();
        Ok(mesh)
    }
    fn cut(&mut self, wall: usize, line: &Polyline, after: Continuation, first_nodes: &[usize]) {
        let first_face = self.elements.last().map_or(0, |segment| segment.face + 1);
        for (edge, [a, b]) in line.edges().enumerate() {
            let count = parts([a, b], self.spacing);
            for k in 0..count {
                let along = k as f64 / count as f64;
                let node = self.nodes.len();
                let position = [0, 1].map(|i| a[i] + (b[i] - a[i]) * along);
                self.nodes.push(Node::new(position, wall));
                self.elements.push(Element {
                    nodes: [node, node + 1],
                    images: [[0; 2]; 2],
                    wall,
                    face: first_face + edge,
                    measure: 0.0,
                    centre: [0.0; 2],
                    normal: [0.0; 2],
                });
            }
        }
        let Some((next, image)) = after else {
            let last = line.points[line.points.len() - 1];
            self.nodes.push(Node::new(last, wall));
            return;
        };
        if let Some(last) = self.elements.last_mut() {
            last.nodes[1] = first_nodes[next];
            last.images[1] = image;
        }
    }

    fn find_angles(&mut self) {
        for (node, beside) in self.nodes.iter_mut().zip(&self.beside) {
            if let [Some(previous), Some(next)] = *beside {
                let [from, to] = [previous, next].map(|s| self.elements[s].tangent());
                node.theta = fluid_angle(from, to);
            }
        }
    }

    /// A free end answers for the half that is missing, too.
    fn size_nodes(&mut self) {
        for (node, beside) in self.nodes.iter_mut().zip(&self.beside) {
            let half = |s: Option<usize>| s.map_or(0.0, |s| 0.5 * self.elements[s].measure);
            let [before, after] = beside.map(half);
            let length = match beside {
                [Some(_), Some(_)] => before + after,
                _ => 2.0 * (before + after),
            };
            node.size = length / self.spacing;
        }
    }

    /// Part of θ that each segment at a node answers for: half where two meet, the whole at a free end.
    pub(crate) fn theta_share(&self, node: usize) -> f64 {
        match self.beside[node] {
            [Some(_), Some(_)] => 0.5 * self.nodes[node].theta,
            _ => self.nodes[node].theta,
        }
    }

    /// Refuses a free end within the kernel radius of any point, where γ is not defined.
    ///
    /// # Errors
    /// Names the wall, the end and the nearest point. Lengths in metres.
    pub fn check_free_ends(&self, points: &[[f64; 2]], kernel_radius: f64) -> Result<()> {
        for free in &self.free_ends {
            let position = self.nodes[free.node].position;
            let distance = |point: &[f64; 2]| {
                let (_, [x, y]) = self.domain.nearest(sub(*point, position));
                x.hypot(y)
            };
            let distances = points.iter().map(distance).enumerate();
            let nearest = distances.min_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((particle, distance)) = nearest.filter(|(_, d)| *d < kernel_radius) {
                return Err(BoundaryError(format!(
                    "the {} end of wall `{}` at {} is free and particle {particle} is {distance} m away, within the \
                     kernel radius {kernel_radius} m: close the wall or extend it",
                    free.end,
                    self.walls[free.wall],
                    Place::from(position)
                )));
            }
        }
        Ok(())
    }
}

fn parts([a, b]: [[f64; 2]; 2], spacing: f64) -> usize {
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    ((length / spacing).round() as usize).max(1)
}

fn first_nodes(polylines: &[Polyline], joints: &Joints, spacing: f64) -> Vec<usize> {
    let mut next = 0;
    let first = |(line, after): (&Polyline, &Continuation)| {
        let first = next;
        next += line.edges().map(|edge| parts(edge, spacing)).sum::<usize>();
        next += usize::from(after.is_none());
        first
    };
    polylines.iter().zip(&joints.after).map(first).collect()
}

/// θ = 1/2 − turn/2π between two directions of travel; 1 where the wall folds back.
fn fluid_angle(from: [f64; 2], to: [f64; 2]) -> f64 {
    let (cross, dot) = (perp(from, to), dot(from, to));
    if dot < 0.0 && cross.abs() <= FOLD {
        return 1.0;
    }
    0.5 - cross.atan2(dot) / TAU
}

impl Simplices<2> for Mesh<2> {
    fn measure(&mut self, segment: usize) {
        let [a, b] = self.corners(segment);
        let [x, y] = sub(b, a);
        let length = x.hypot(y);
        let segment = &mut self.elements[segment];
        segment.measure = length;
        segment.centre = [a[0] + 0.5 * x, a[1] + 0.5 * y];
        segment.normal = [-y / length, x / length];
    }

    fn follow(&mut self, _: &[bool]) {
        if self.motions.iter().any(|motion| motion.bends()) {
            self.find_angles();
        }
        self.size_nodes();
    }

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
