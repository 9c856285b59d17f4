//! Plane walls and surfaces of triangles, and their motion.

use serde::{Deserialize, Serialize};
use sph_core::nearest_place;

use crate::grains::{GrainError, Vector};

/// Control of a wall along its normal.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
pub enum Control {
    /// Nothing but its velocity, which may be zero.
    #[default]
    Velocity,
    /// A servo that holds a normal stress: δ = (σ A − F) / k_w with the grains' stiffness k_w at the wall, limited to
    /// v_max Δt, filtered to D = (1 − s) δ + 0.8 D_old with s = 0.25. Source: the triaxial controller of YADE.
    Stress {
        /// σ, Pa, positive in compression.
        stress: f64,
        /// v_max, m/s.
        largest_speed: f64,
    },
    /// A rate of strain between this wall and the one that faces it: the velocity relaxes towards ½ ε̇ H by a hundredth
    /// per step. Give it to both walls.
    StrainRate {
        /// ε̇, 1/s, positive when the walls approach.
        rate: f64,
    },
    /// Keeps the volume of the box: all such walls move outward at one speed Σ A v / Σ A, the first sum over the other
    /// walls and their inward velocities v.
    Volume,
    /// A body of its own: M dv/dt = σ A − F, with the non-viscous damping of the grains.
    Piston {
        /// σ, Pa, positive in compression.
        stress: f64,
        /// M, kg; of the order of 2 to 20 % of the sample's mass.
        mass: f64,
    },
}

/// A plane with grains on the side of its normal.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct Wall {
    /// A point of it, m.
    pub point: Vector,
    /// Unit normal towards the grains.
    pub normal: Vector,
    /// Velocity, m/s; its part along the wall drags grains along.
    pub velocity: Vector,
    /// Number of its contact law.
    pub law: usize,
    /// Its control.
    pub control: Control,
    /// Area, m²; `None` is that between the walls and periods along the other two axes.
    pub area: Option<f64>,
    /// Force besides that of the grains, N: that of a fluid.
    pub external_force: Vector,
    /// Force of the grains on it, N.
    pub force: Vector,
    pub(crate) stiffness: f64,
    pub(crate) filtered: f64,
}

/// s and the share of the last displacement in [`Control::Stress`].
const FILTER: [f64; 2] = [0.25, 0.8];
/// Relaxation of [`Control::StrainRate`] per step.
const RELAXATION: f64 = 0.01;

impl Wall {
    /// A wall at rest through a point (m) with a normal towards the grains, which is made a unit vector.
    pub fn new(point: [f64; 3], normal: [f64; 3]) -> Self {
        let normal = Vector::from(normal);
        Self {
            point: point.into(),
            normal: normal / normal.norm(),
            ..Self::default()
        }
    }

    /// The six walls of a box between two corners, m: x₋, x₊, y₋, y₊, z₋, z₊.
    pub fn cuboid(low: [f64; 3], high: [f64; 3]) -> [Wall; 6] {
        std::array::from_fn(|w| {
            let mut normal = [0.0; 3];
            normal[w / 2] = if w % 2 == 0 { 1.0 } else { -1.0 };
            Wall::new(if w % 2 == 0 { low } else { high }, normal)
        })
    }

    /// The same with another law.
    #[must_use]
    pub fn with_law(mut self, law: usize) -> Self {
        self.law = law;
        self
    }

    /// Mass as a body, kg: infinite unless it is a piston.
    pub(crate) fn mass(&self) -> f64 {
        match self.control {
            Control::Piston { mass, .. } => mass,
            _ => f64::INFINITY,
        }
    }

    /// Signed distance of a point, m.
    pub fn distance(&self, point: &Vector) -> f64 {
        (point - self.point).dot(&self.normal)
    }

    /// Force with which grains and fluid push it outward, N.
    pub fn push(&self) -> f64 {
        -(self.force + self.external_force).dot(&self.normal)
    }

    /// The axis and the sign of its normal, if it is along one.
    pub(crate) fn axis(&self) -> Option<(usize, f64)> {
        let axis = self.normal.iamax();
        let sign = self.normal[axis].signum();
        let off = (self.normal * sign - Vector::ith(axis, 1.0)).amax();
        (off < 1e-12).then_some((axis, sign))
    }

    pub(crate) fn check(&self, wall: usize) -> Result<(), GrainError> {
        let problem = |problem| Err(GrainError::BadWall(wall, problem));
        let vectors = [self.point, self.normal, self.velocity, self.external_force];
        if !vectors.iter().flatten().all(|x| x.is_finite()) {
            let what = "has a point, a normal, a velocity or a force that is not finite";
            return problem(what.into());
        }
        if (self.normal.norm() - 1.0).abs() > 1e-9 {
            let normal = self.normal.as_slice();
            return problem(format!(
                "has the normal {normal:?}, which is not of length 1"
            ));
        }
        let numbers: &[(&str, f64, bool)] = match self.control {
            Control::Velocity | Control::Volume => &[],
            Control::Stress {
                stress,
                largest_speed: v,
            } => &[("stress", stress, true), ("largest speed", v, v > 0.0)],
            Control::StrainRate { rate } => &[("rate of strain", rate, true)],
            Control::Piston { stress, mass } => {
                &[("stress", stress, true), ("mass", mass, mass > 0.0)]
            }
        };
        let bad = numbers.iter().find(|n| !n.2 || !n.1.is_finite());
        if let Some((what, value, _)) = bad {
            return problem(format!("has the {what} {value}"));
        }
        let bad = |area: &f64| !(*area > 0.0 && area.is_finite());
        let bad = self.area.filter(bad);
        bad.map_or(Ok(()), |area| problem(format!("has the area {area} m²")))
    }

    /// Sets the velocity along the normal for the coming step (s): `area` in m², `height` to the facing wall in m.
    pub(crate) fn steer(&mut self, step: f64, area: f64, height: f64, damping: f64) {
        let old = self.velocity.dot(&self.normal);
        let new = match self.control {
            Control::Velocity | Control::Volume => return,
            Control::Stress {
                stress,
                largest_speed,
            } => {
                let most = largest_speed * step;
                let lack = stress * area - self.push();
                let wanted = match self.stiffness > 0.0 {
                    true => (lack / self.stiffness).clamp(-most, most),
                    false => most * sign(lack),
                };
                let filtered = (1.0 - FILTER[0]) * wanted + FILTER[1] * self.filtered;
                self.filtered = filtered.clamp(-most, most);
                self.filtered / step
            }
            Control::StrainRate { rate } => old + RELAXATION * (0.5 * rate * height - old),
            Control::Piston { stress, mass } => {
                let force = stress * area - self.push();
                let middle = old + 0.5 * force / mass * step;
                old + (force - damping * force.abs() * sign(middle)) / mass * step
            }
        };
        self.velocity += self.normal * (new - old);
    }
}

/// −1, 0 or 1.
pub(crate) fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

/// A rigid surface of triangles, seen from both sides, with a given motion.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
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
    /// Force of the grains on it, N.
    pub force: Vector,
    /// Moment of the grains' forces about its centre, N m.
    pub torque: Vector,
}

impl Mesh {
    /// At rest; vertices in m.
    pub fn new(vertices: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Self {
        Self {
            vertices: vertices.into_iter().map(Vector::from).collect(),
            triangles,
            ..Self::default()
        }
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
        if !motion.iter().flatten().all(|x| x.is_finite()) {
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

/// The point of a triangle nearest to a point.
pub(crate) fn nearest(point: &Vector, corners: [Vector; 3]) -> Vector {
    let corners = corners.map(<[f64; 3]>::from);
    nearest_place((*point).into(), &corners).0.into()
}
