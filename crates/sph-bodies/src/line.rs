//! Lines between a body and a place that stays: moorings.

use nalgebra::{Vector3, Vector6};
use schemars::JsonSchema;
use serde::Deserialize;
use sph_boundary::Drawing;

use crate::six::{padded, six};

/// An elastic line from a fixed place to a place of the body: it pulls with k (l − l₀) + c l̇ ≥ 0, and never pushes.
///
/// ```toml
/// [[wall.buoy.mover.rigid-body.line]]
/// from = [0.2, 0.0]
/// to = [0.5, 0.35]
/// stiffness = "2 kN/m"
/// ```
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// The place that stays, m.
    #[schemars(extend("unit" = "m"))]
    pub from: Vec<f64>,
    /// The place of the body, where it is drawn, m.
    #[schemars(extend("unit" = "m"))]
    pub to: Vec<f64>,
    /// Stiffness k, N/m (per metre of depth in two dimensions).
    #[schemars(extend("unit" = "N/m", "exclusiveMinimum" = 0.0))]
    pub stiffness: f64,
    /// Damping c, N s/m (per metre of depth in two dimensions).
    #[serde(default)]
    #[schemars(extend("unit" = "N s/m", "minimum" = 0.0))]
    pub damping: f64,
    /// Length l₀ without tension, m; as drawn if left out.
    #[schemars(extend("unit" = "m", "exclusiveMinimum" = 0.0))]
    pub length: Option<f64>,
}

/// What a line does at a place and velocity of its body.
pub(crate) struct Pull {
    /// (e, r × e): the tension T acts with −T times it.
    pub along: Vector6<f64>,
    /// k (l − l₀) + c l̇, N.
    pub tension: f64,
    /// dl/dt, m/s.
    pub rate: f64,
}

impl Line {
    pub(crate) fn drawn_length(&self) -> f64 {
        (padded(&self.to) - padded(&self.from)).norm()
    }

    /// None while it is slack. `end` is where its place of the body is, `arm` the way there from the centre.
    pub(crate) fn pull(
        &self,
        end: Vector3<f64>,
        arm: Vector3<f64>,
        velocity: &Vector6<f64>,
    ) -> Option<Pull> {
        let way = end - padded(&self.from);
        let length = way.norm();
        let stretch = length - self.length.unwrap_or_else(|| self.drawn_length());
        if length <= 0.0 || stretch <= 0.0 {
            return None;
        }
        let e = way / length;
        let along = six(e, arm.cross(&e));
        let rate = along.dot(velocity);
        let tension = self.stiffness * stretch + self.damping * rate;
        (tension > 0.0).then_some(Pull {
            along,
            tension,
            rate,
        })
    }

    /// Whether it goes through a wall; its ends may lie on one.
    pub(crate) fn crosses(&self, wall: &Drawing) -> bool {
        let (from, to) = (padded(&self.from), padded(&self.to));
        let inner = |s: f64| (1e-9..=1.0 - 1e-9).contains(&s);
        match wall {
            Drawing::Line(line) => line.edges().any(|[a, b]| {
                let [a, b] = [a, b].map(|p| Vector3::new(p[0], p[1], 0.0));
                let (way, edge) = (to - from, b - a);
                let across = way.cross(&edge).z;
                let s = (a - from).cross(&edge).z / across;
                let t = (a - from).cross(&way).z / across;
                inner(s) && (0.0..=1.0).contains(&t)
            }),
            Drawing::Surface(surface) => surface.triangles.iter().any(|triangle| {
                let [a, b, c] = triangle.map(|k| Vector3::from(surface.points[k as usize]));
                let normal = (b - a).cross(&(c - a));
                let s = normal.dot(&(a - from)) / normal.dot(&(to - from));
                let x = from + (to - from) * s;
                let sides = [(a, b), (b, c), (c, a)];
                inner(s)
                    && sides
                        .into_iter()
                        .all(|(p, q)| normal.dot(&(q - p).cross(&(x - p))) >= 0.0)
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_boundary::{Polyline, Surface};

    fn line(from: &[f64], to: &[f64]) -> Line {
        Line {
            from: from.to_vec(),
            to: to.to_vec(),
            stiffness: 10.0,
            damping: 1.0,
            length: Some(1.0),
        }
    }

    #[test]
    fn it_pulls_and_never_pushes() {
        let line = line(&[0.0, 0.0], &[2.0, 0.0]);
        let at = |x: f64, u: f64| {
            let end = Vector3::new(x, 0.0, 0.0);
            let velocity = Vector6::new(u, 0.0, 0.0, 0.0, 0.0, 0.0);
            line.pull(end, Vector3::new(0.0, 0.5, 0.0), &velocity)
        };
        let pull = at(3.0, 2.0).unwrap();
        assert_eq!((pull.tension, pull.rate), (22.0, 2.0));
        // r × e = (0, 0.5, 0) × (1, 0, 0) = (0, 0, −0.5)
        assert_eq!(pull.along, Vector6::new(1.0, 0.0, 0.0, 0.0, 0.0, -0.5));
        assert!(at(0.9, 0.0).is_none() && at(1.1, -2.0).is_none());
    }

    #[test]
    fn it_sees_walls_that_it_goes_through() {
        let wall = Drawing::Line(Polyline {
            name: "w".into(),
            points: vec![[1.0, -1.0], [1.0, 1.0]],
            closed: false,
        });
        assert!(line(&[0.0, 0.0], &[2.0, 0.5]).crosses(&wall));
        assert!(!line(&[0.0, 0.0], &[0.9, 0.5]).crosses(&wall));
        assert!(
            !line(&[1.0, 0.0], &[2.0, 0.5]).crosses(&wall),
            "it may begin at one"
        );
        let wall = Drawing::Surface(Surface {
            name: "w".into(),
            points: vec![[1.0, 0.0, 0.0], [1.0, 2.0, 0.0], [1.0, 0.0, 2.0]],
            triangles: vec![[0, 1, 2]],
        });
        assert!(line(&[0.0, 0.5, 0.5], &[2.0, 0.5, 0.5]).crosses(&wall));
        assert!(!line(&[0.0, 1.5, 1.5], &[2.0, 1.5, 1.5]).crosses(&wall));
    }
}
