//! Facets: vector areas, sectors of spheres, edges, solid angles, the circle between discs and walls.

use nalgebra::Matrix3;

use crate::Vector;
use crate::triangulation::{Sphere, Triangulation, Vertex, Wall};

/// From a sphere's centre to another vertex: to a centre, or to its own foot on a wall.
pub fn edge(mesh: &Triangulation, k: usize, other: Vertex) -> Vector {
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
    pub fn area(&self) -> Vector {
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
        let [a, b] = [1, 2].map(|n| self.spheres[(k + n) % 3].centre);
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
pub fn angle(a: Vector, b: Vector) -> f64 {
    a.cross(&b).norm().atan2(a.dot(&b))
}

/// Signed solid angle ω (sr, −2π to 2π) under which a triangle a, b, c is seen from the origin:
///
/// ```text
/// tan(ω/2) = a · (b × c) / (|a| |b| |c| + (a·b) |c| + (a·c) |b| + (b·c) |a|)
/// ```
///
/// positive if a, b, c turn right-handed around a + b + c. The quadrant matters: where the denominator is
/// negative, the plain arc tangent is wrong by up to 2π. Lengths of a, b, c do not matter. Source: Van Oosterom
/// & Strackee 1983.
pub fn solid_angle(a: Vector, b: Vector, c: Vector) -> f64 {
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let volume = a.dot(&b.cross(&c));
    let sum = la * lb * lc + a.dot(&b) * lc + a.dot(&c) * lb + b.dot(&c) * la;
    2.0 * volume.atan2(sum)
}

/// Radius r (m) of the circle in a facet's plane that touches its discs from outside and its walls: with c from
/// the first centre, |c|² = (r + R₀)², and for each of the other two
///
/// ```text
/// disc    2 d · c + 2 (R_k − R₀) r = |d|² − R_k² + R₀²,     wall    n · c − r = −(distance of x₀)
/// ```
///
/// c is linear in r, and r the least positive root of a quadratic equation. None if there is no such circle.
pub fn inscribed_radius(facet: &Facet, normal: Vector) -> Option<f64> {
    let first = facet.spheres[0];
    let discs = facet.spheres[1..].iter().map(|s| {
        let d = s.centre - first.centre;
        let weights = (first.radius - s.radius) * (first.radius + s.radius);
        let rate = -2.0 * (s.radius - first.radius);
        (2.0 * d, d.norm_squared() + weights, rate)
    });
    let wall = |w: &&Wall| (w.normal, -w.distance(first.centre), 1.0);
    let walls = facet.walls.iter().map(wall);
    let rows: Vec<_> = discs.chain(walls).collect();
    let [(a, a0, a1), (b, b0, b1)] = *rows else {
        return None;
    };
    let matrix = Matrix3::from_rows(&[a.transpose(), b.transpose(), normal.transpose()]);
    let inverse = matrix.try_inverse()?;
    let [u, v] = [[a0, b0], [a1, b1]].map(|[a, b]| inverse * Vector::new(a, b, 0.0));
    let square = v.norm_squared() - 1.0;
    let linear = u.dot(&v) - first.radius;
    let constant = u.norm_squared() - first.radius * first.radius;
    // Without cancellation, also where the square's factor vanishes.
    let root = (linear * linear - square * constant).sqrt();
    let sum = -(linear + root.copysign(linear));
    let roots = [sum / square, constant / sum];
    let positive = roots.into_iter().filter(|r| *r > 0.0 && r.is_finite());
    positive.min_by(f64::total_cmp)
}
