//! Edges of the triangulation, and the faces between neighbours.

use nalgebra::Vector3;

use crate::flow::facet::edge;
use crate::flow::{PoreGeometry, Throat};
use crate::triangulation::{Sphere, Vertex};

/// Two neighbours: a sphere, and a sphere or a wall beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The sphere, of two the one with the smaller number.
    pub sphere: usize,
    /// Its neighbour.
    pub other: Vertex,
    /// Area S of the face between both in the power diagram, m²: the polygon of the power centres around the edge.
    pub area: f64,
}

impl PoreGeometry {
    /// All edges with a sphere, in the order of their numbers, spheres before walls. A face between grains at a free
    /// surface reaches up to the wall above them.
    ///
    /// The pyramids over all faces with tips at the spheres fill the room.
    pub fn edges(&self) -> Vec<Edge> {
        let mut parts: Vec<Edge> = Vec::with_capacity(3 * self.throats.len());
        for throat in &self.throats {
            for c in 0..3 {
                let (a, b) = (throat.vertices[c], throat.vertices[(c + 1) % 3]);
                let Vertex::Sphere(sphere) = a.min(b) else {
                    continue;
                };
                let other = a.max(b);
                let third = throat.vertices[(c + 2) % 3];
                let area = self.part(throat, sphere, other, third);
                parts.push(Edge {
                    sphere,
                    other,
                    area,
                });
            }
        }
        parts.sort_by_key(|e| (e.sphere, e.other));
        parts.dedup_by(|next, kept| {
            let same = (next.sphere, next.other) == (kept.sphere, kept.other);
            if same {
                kept.area += next.area;
            }
            same
        });
        parts
    }

    /// Area (m²) of the triangle of a throat's power centres and the point where the edge meets its face, with the sign
    /// of the turn around the edge: over all throats around it these add up to the face.
    fn part(&self, throat: &Throat, sphere: usize, other: Vertex, third: Vertex) -> f64 {
        let mesh = &self.mesh;
        let along = edge(mesh, sphere, other);
        let Some(direction) = along.try_normalize(0.0) else {
            return 0.0;
        };
        let Sphere { centre, radius } = mesh.spheres[sphere];
        let distance = match other {
            Vertex::Sphere(l) => face_distance(along.norm(), radius, mesh.spheres[l].radius),
            Vertex::Wall(_) => along.norm(),
        };
        let middle = centre + distance * direction;
        let [i, j] = throat.cells.map(|c| self.centres[c] - middle);
        let turn = throat
            .normal
            .dot(&direction.cross(&edge(mesh, sphere, third)));
        let area: Vector3<f64> = 0.5 * i.cross(&j);
        area.dot(&direction) * turn.signum()
    }
}

/// Distance (m) of the face between two spheres from the centre of the first: where the powers of a point on the line
/// of centres are equal.
fn face_distance(between: f64, first: f64, second: f64) -> f64 {
    0.5 * (between + (first * first - second * second) / between)
}
