//! Facets: vector areas, sectors of spheres, edges.

use nalgebra::Vector3;

use crate::triangulation::{Sphere, Triangulation, Vertex, Wall};

/// From a sphere's centre to another vertex: to a centre, or to its own foot on a wall.
pub fn edge(mesh: &Triangulation, k: usize, other: Vertex) -> Vector3<f64> {
    let x = mesh.spheres[k].centre;
    match other {
        Vertex::Sphere(l) => mesh.spheres[l].centre - x,
        Vertex::Wall(w) => mesh.walls[w].projection(x) - x,
    }
}

/// Vertices of a facet, spheres before walls.
pub struct Facet<'a> {
    pub spheres: Vec<&'a Sphere>,
    pub walls: Vec<&'a Wall>,
}

impl<'a> Facet<'a> {
    pub fn new(mesh: &'a Triangulation, vertices: &[Vertex; 3]) -> Self {
        let (mut spheres, mut walls) = (Vec::new(), Vec::new());
        for v in vertices {
            match v {
                Vertex::Sphere(k) => spheres.push(&mesh.spheres[*k]),
                Vertex::Wall(w) => walls.push(&mesh.walls[*w]),
            }
        }
        Self { spheres, walls }
    }

    /// Vector area S (m²), of either sign: a triangle of three centres; a trapezoid of two and their feet on
    /// a wall; a rectangle of one, its feet on two walls, and the edge of the room.
    pub fn area(&self) -> Vector3<f64> {
        let x = |k: usize| self.spheres[k].centre;
        match *self.walls {
            [] => 0.5 * (x(1) - x(0)).cross(&(x(2) - x(0))),
            [w] => 0.5 * (w.projection(x(1)) - x(0)).cross(&(w.projection(x(0)) - x(1))),
            [v, w, ..] => v.distance(x(0)) * w.distance(x(0)) * v.normal.cross(&w.normal),
        }
    }

    /// Area S₀ (m²) by which the sector of sphere k of a triangle reaches across the opposite edge, with m
    /// the squared distance of that edge from the centre:
    ///
    /// ```text
    /// S₀ = ½ (ϑ R² − 2 √(R² − m) √m),     ϑ = 2 arccos(√m / R)
    /// ```
    pub fn across(&self, k: usize) -> f64 {
        if !self.walls.is_empty() {
            return 0.0;
        }
        let s = self.spheres[k];
        let (a, b) = (
            self.spheres[(k + 1) % 3].centre,
            self.spheres[(k + 2) % 3].centre,
        );
        let along = (b - a).normalize();
        let foot = along.dot(&(s.centre - a));
        let m = (s.centre - a - foot * along).norm_squared();
        let r2 = s.radius * s.radius;
        if foot <= 0.0 || foot >= (b - a).norm() || m >= r2 {
            return 0.0;
        }
        let angle = 2.0 * (m / r2).sqrt().acos();
        0.5 * (angle * r2 - 2.0 * ((r2 - m) * m).sqrt())
    }
}

/// Angle between two directions, rad, 0 to π.
pub fn angle(a: Vector3<f64>, b: Vector3<f64>) -> f64 {
    a.cross(&b).norm().atan2(a.dot(&b))
}
