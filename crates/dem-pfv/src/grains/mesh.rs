//! Surfaces of triangles.

use serde::{Deserialize, Serialize};

use crate::grains::{GrainError, Vector};

/// A rigid surface of triangles, seen from both sides, with a given motion.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Mesh {
    /// Vertices, m.
    pub vertices: Vec<Vector>,
    /// Three vertices each. Triangles need not share their vertices.
    pub triangles: Vec<[u32; 3]>,
    /// Velocity of its centre, m/s.
    pub velocity: Vector,
    /// Angular velocity about its centre, rad/s.
    pub spin: Vector,
    /// The point about which it turns, m.
    pub centre: Vector,
    /// Number of its contact law.
    pub law: usize,
    pub(crate) force: Vector,
    pub(crate) torque: Vector,
}

impl Mesh {
    /// At rest; vertices in m.
    pub fn new(vertices: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Self {
        Self {
            vertices: vertices.into_iter().map(Vector::from).collect(),
            triangles,
            velocity: Vector::zeros(),
            spin: Vector::zeros(),
            centre: Vector::zeros(),
            law: 0,
            force: Vector::zeros(),
            torque: Vector::zeros(),
        }
    }

    /// Force of the grains on it, N.
    pub fn force(&self) -> Vector {
        self.force
    }

    /// Moment of the grains' forces about its centre, N m.
    pub fn torque(&self) -> Vector {
        self.torque
    }

    /// Velocity of the point of it that is now there, m/s.
    pub fn velocity_at(&self, point: &Vector) -> Vector {
        self.velocity + self.spin.cross(&(point - self.centre))
    }

    /// Corners of a triangle; its number is below the number of triangles.
    pub(crate) fn corners(&self, triangle: usize) -> [Vector; 3] {
        self.triangles[triangle].map(|v| self.vertices[v as usize])
    }

    pub(crate) fn check(&self, mesh: usize) -> Result<(), GrainError> {
        let problem = |triangle, problem| Err(GrainError::BadMesh(mesh, triangle, problem));
        let motion = [self.velocity, self.spin, self.centre];
        if motion.iter().any(|v| v.iter().any(|x| !x.is_finite())) {
            return problem(0, "moves at a velocity that is not finite".into());
        }
        for (t, corners) in self.triangles.iter().enumerate() {
            if let Some(v) = corners.iter().find(|&&v| v as usize >= self.vertices.len()) {
                let n = self.vertices.len();
                return problem(t, format!("names vertex {v}, but there are {n}"));
            }
            let [a, b, c] = self.corners(t);
            let sides = [b - a, c - b, a - c];
            let longest = sides.iter().map(|s| s.norm_squared()).fold(0.0, f64::max);
            let area = sides[0].cross(&sides[1]).norm();
            if !area.is_finite() {
                return problem(t, "has a vertex that is not finite".into());
            }
            if area <= 1e-12 * longest {
                return problem(t, format!("has the area {} m²", 0.5 * area));
            }
        }
        Ok(())
    }

    /// Moves it for a step, s.
    pub(crate) fn advance(&mut self, step: f64) {
        if self.velocity != Vector::zeros() || self.spin != Vector::zeros() {
            let turn = nalgebra::Rotation3::from_scaled_axis(self.spin * step);
            let to = self.centre + self.velocity * step;
            for vertex in &mut self.vertices {
                *vertex = to + turn * (*vertex - self.centre);
            }
            self.centre = to;
        }
    }
}

/// The point of a triangle nearest to a point. Source: Ericson 2005, §5.1.5.
pub(crate) fn nearest(point: &Vector, [a, b, c]: [Vector; 3]) -> Vector {
    let (ab, ac) = (b - a, c - a);
    let ap = point - a;
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = point - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cp = point - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let total = va + vb + vc;
    a + ab * (vb / total) + ac * (vc / total)
}
