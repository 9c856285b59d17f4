//! Vectors, shapes, walls and periodic boxes.

use crate::checks::bounds::within_bounds;
use crate::checks::shapes::body_geometry;
use crate::checks::walls::wall_geometry;
use crate::checks::whole::Problems;
use crate::geometry::polygon::crossing;
use crate::geometry::vector::{array, point};
use crate::tables::outlet;
use crate::{Polygon, Scene, Shape};

/// Checks everything that has a place in space.
pub(crate) fn check(scene: &Scene, found: &mut Problems) {
    let before = found.0.len();
    let of = Dimension(scene.dimension);
    space(scene, of, found);
    for (name, wall) in &scene.wall {
        wall_geometry(wall, of, &format!("wall.{name}"), found);
    }
    for (name, body) in &scene.body {
        body_geometry(scene, body, of, &format!("body.{name}"), found);
    }
    outlet::check(scene, of, found);
    if found.0.len() == before {
        match scene.dimension {
            2 => within_bounds::<2>(scene, found),
            _ => within_bounds::<3>(scene, found),
        }
    }
}

/// The number of dimensions of the scene, against which vectors are held.
#[derive(Clone, Copy)]
pub(crate) struct Dimension(pub usize);

impl Dimension {
    /// Whether a vector has one entry per dimension; if not, that is a problem.
    pub fn vector(self, list: &[f64], path: &str, found: &mut Problems) -> bool {
        let right = list.len() == self.0;
        if !right {
            let message = format!(
                "expected {} numbers in {}D, found {}",
                self.0,
                self.0,
                list.len()
            );
            found.add(path, message);
        }
        right
    }

    /// Whether a vector has the right length and is not zero.
    pub fn direction(self, list: &[f64], path: &str, found: &mut Problems) {
        if self.vector(list, path, found) && list.iter().all(|c| *c == 0.0) {
            found.add(path, "a direction of length 0 is none");
        }
    }

    /// An axis is given in space, where it is `needed`, and in the plane there is none.
    pub fn axis(self, axis: &Option<Vec<f64>>, needed: bool, path: &str, found: &mut Problems) {
        match axis {
            Some(_) if self.0 == 2 => {
                let message = "a rotation in 2D has no axis: it is anticlockwise";
                found.add(format!("{path}.axis"), message);
            }
            Some(axis) => self.direction(axis, &format!("{path}.axis"), found),
            None if self.0 == 3 && needed => {
                found.add(path, "the key `axis` is missing: axis of the rotation");
            }
            None => {}
        }
    }

    /// Two points have the right length and differ.
    pub fn apart(
        self,
        (first, a): (&str, &[f64]),
        (second, b): (&str, &[f64]),
        path: &str,
        found: &mut Problems,
    ) {
        let right = self.vector(a, &format!("{path}.{first}"), found)
            & self.vector(b, &format!("{path}.{second}"), found);
        if right && a == b {
            let message = format!("`{first}` and `{second}` must differ");
            found.add(format!("{path}.{second}"), message);
        }
    }

    /// Whether a shape of `dimension` can stand here.
    pub fn is(self, dimension: usize, what: &str, path: &str, found: &mut Problems) -> bool {
        let right = dimension == self.0;
        if !right {
            let message = format!(
                "{what} is a shape of {dimension}D, and this scene is {}D",
                self.0
            );
            found.add(path, message);
        }
        right
    }

    pub fn optional(self, list: &Option<Vec<f64>>, path: &str, found: &mut Problems) {
        if let Some(list) = list {
            self.vector(list, path, found);
        }
    }

    pub fn corners(self, corners: &[Vec<f64>; 2], path: &str, found: &mut Problems) {
        let right = [0, 1].map(|k| self.vector(&corners[k], &format!("{path}[{k}]"), found));
        if right != [true; 2] {
            return;
        }
        for (k, axis) in ["x", "y", "z"].iter().enumerate().take(self.0) {
            let (lo, hi) = (corners[0][k], corners[1][k]);
            if lo >= hi {
                let message = format!(
                    "the lower corner must be below the upper along {axis}, found {lo} and {hi}"
                );
                found.add(path, message);
            }
        }
    }
}

fn space(scene: &Scene, of: Dimension, found: &mut Problems) {
    let numerics = &scene.numerics;
    of.optional(&numerics.gravity, "numerics.gravity", found);
    of.optional(&numerics.driving, "numerics.driving", found);
    if let Some(domain) = &numerics.domain {
        of.corners(domain, "numerics.domain", found);
    }
    for (k, (axis, bounds)) in numerics.periodic.axes().into_iter().enumerate() {
        let Some([lo, hi]) = bounds else { continue };
        let path = format!("numerics.periodic.{axis}");
        if k >= of.0 {
            found.add(path, format!("there is no {axis} in {}D", of.0));
        } else if lo >= hi {
            found.add(
                path,
                format!("the lower bound must be below the upper, found {lo} and {hi}"),
            );
        } else if numerics
            .gravity
            .as_ref()
            .and_then(|g| g.get(k))
            .is_some_and(|g| *g != 0.0)
        {
            let message = format!(
                "gravity along the periodic direction {axis} has no hydrostatic balance: use `driving`"
            );
            found.add("numerics.gravity", message);
        }
    }
}

/// The corners, if each has two coordinates and differs from the one before.
pub(crate) fn chain(
    points: &[Vec<f64>],
    closed: bool,
    path: &str,
    found: &mut Problems,
) -> Option<Vec<[f64; 2]>> {
    let before = found.0.len();
    for (k, p) in points.iter().enumerate() {
        let place = format!("{path}[{k}]");
        if !Dimension(2).vector(p, &place, found) {
            break;
        }
        let previous = match k {
            0 if closed => points.last(),
            0 => None,
            k => points.get(k - 1),
        };
        if previous == Some(p) {
            let message = format!("the corner {} stands there twice in a row", point(p));
            found.add(place, message);
            break;
        }
    }
    (found.0.len() == before).then(|| points.iter().map(|p| array(p)).collect())
}

pub(crate) fn crossed(
    edges: &[([f64; 2], [f64; 2])],
    closed: bool,
    path: &str,
    found: &mut Problems,
) {
    if let Some((first, second, place)) = crossing(edges, closed) {
        let message = format!(
            "the edges from corners {first} and {second}, counted from 0, meet at {}",
            point(&place)
        );
        found.add(path, message);
    }
}

/// A polygon has an area and does not cross itself.
pub(crate) fn polygon(points: &[Vec<f64>], path: &str, found: &mut Problems) {
    let Some(corners) = chain(points, true, path, found) else {
        return;
    };
    let polygon = Polygon::new(corners);
    let (lo, hi) = Shape::<2>::Polygon(polygon.clone()).bounds();
    let size = (hi[0] - lo[0]).max(hi[1] - lo[1]);
    let flat = (hi[0] - lo[0]).min(hi[1] - lo[1]) <= 1e-12 * size;
    let edges: Vec<_> = polygon.edges().collect();
    if flat {
        found.add(path, "the polygon has no area");
    } else if crossing(&edges, true).is_some() {
        crossed(&edges, true, path, found);
    } else if polygon.area().abs() <= 1e-12 * size * size {
        found.add(path, "the polygon has no area");
    }
}
