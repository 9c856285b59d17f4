//! Lines between a body and a place that stays: moorings.

use nalgebra::Vector3;
use sph_core::parameters;

use crate::Drawing;
use crate::bodies::spatial_vector::padded;

/// A line from a fixed place to a place of the body. It pulls with k (l − l₀) + c l̇ ≥ 0, and never pushes.
///
/// With a `weight` it is a chain that hangs in a catenary, always at rest: k is then EA/l₀, and the rest of its length
/// lies on the bed at the height of its fixed end (Irvine 1981; Jonkman 2007).
///
/// ```toml
/// [[wall.buoy.mover.rigid-body.line]]
/// from = [0.2, 0.0]
/// to = [0.5, 0.35]
/// stiffness = "2 kN/m"
/// ```
#[parameters]
pub struct Line {
    /// The place that stays, m.
    #[parameter(unit: "m")]
    pub from: Vec<f64>,
    /// The place of the body, where it is drawn, m.
    #[parameter(unit: "m")]
    pub to: Vec<f64>,
    /// Stiffness k of the whole line, N/m (per metre of depth in two dimensions); EA/l₀ of one with a weight.
    #[parameter(unit: "N/m", above: 0.0)]
    pub stiffness: f64,
    /// Damping c, N s/m (per metre of depth in two dimensions); none with a weight.
    #[parameter(default, unit: "N s/m", min: 0.0)]
    pub damping: f64,
    /// Length l₀ without tension, m; as drawn if left out. One with a weight needs it.
    #[parameter(unit: "m", above: 0.0)]
    pub length: Option<f64>,
    /// Weight in the fluid per length, N/m (and per metre of depth in two dimensions): the line hangs.
    #[parameter(unit: "N/m", above: 0.0)]
    pub weight: Option<f64>,
    /// True if a line with a weight may lie on a bed at the height of its fixed end; yes if left out.
    pub bed: Option<bool>,
}

impl Line {
    pub(crate) fn drawn_length(&self) -> f64 {
        (padded(&self.to) - padded(&self.from)).norm()
    }
}

/// True if a straight way goes through a wall; its ends may lie on one.
pub(crate) fn crosses(from: Vector3<f64>, to: Vector3<f64>, wall: &Drawing) -> bool {
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
            let left_of =
                |(p, q): (Vector3<f64>, Vector3<f64>)| normal.dot(&(q - p).cross(&(x - p))) >= 0.0;
            inner(s) && [(a, b), (b, c), (c, a)].into_iter().all(left_of)
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Polyline, Surface};

    #[test]
    fn it_sees_walls_that_it_goes_through() {
        let way =
            |from: [f64; 3], to: [f64; 3], wall: &Drawing| crosses(from.into(), to.into(), wall);
        let wall = Drawing::Line(Polyline::open("w", vec![[1.0, -1.0], [1.0, 1.0]]));
        assert!(way([0.0, 0.0, 0.0], [2.0, 0.5, 0.0], &wall));
        assert!(!way([0.0, 0.0, 0.0], [0.9, 0.5, 0.0], &wall));
        let along = way([1.0, 0.0, 0.0], [2.0, 0.5, 0.0], &wall);
        assert!(!along, "it may begin at one");
        let along = way([1.0, 0.0, 0.0], [1.0, 0.5, 0.0], &wall);
        assert!(!along, "it may lie on one");
        let wall = Drawing::Surface(Surface {
            name: "w".into(),
            points: vec![[1.0, 0.0, 0.0], [1.0, 2.0, 0.0], [1.0, 0.0, 2.0]],
            triangles: vec![[0, 1, 2]],
        });
        assert!(way([0.0, 0.5, 0.5], [2.0, 0.5, 0.5], &wall));
        assert!(!way([0.0, 1.5, 1.5], [2.0, 1.5, 1.5], &wall));
    }
}
