//! Vectors, chains of corners and shapes against the number of dimensions.

use scene_text::Problems;

use crate::Polygon;
use crate::geometry::polygon::crossing;
use crate::geometry::vector::{array, point};

/// The number of dimensions of the scene, against which vectors are held.
#[derive(Clone, Copy)]
pub(crate) struct Dimension(pub usize);

impl Dimension {
    /// True if a vector has one entry per dimension; if not, a problem is added.
    pub fn vector(self, list: &[f64], path: &str, found: &mut Problems) -> bool {
        let (wanted, given) = (self.0, list.len());
        if given != wanted {
            let message = format!("expected {wanted} numbers in {wanted}D, found {given}");
            found.add(path, message);
        }
        given == wanted
    }

    /// Checks that a vector has the right length and is not zero.
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

    /// True if a shape of `dimension` can stand here.
    pub fn is(self, dimension: usize, what: &str, path: &str, found: &mut Problems) -> bool {
        let own = self.0;
        if dimension != own {
            let message = format!("{what} is a shape of {dimension}D, and this scene is {own}D");
            found.add(path, message);
        }
        dimension == own
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

/// No edge meets another.
pub(crate) fn crossed(
    edges: &[([f64; 2], [f64; 2])],
    closed: bool,
    path: &str,
    found: &mut Problems,
) {
    if let Some((first, second, place)) = crossing(edges, closed) {
        let at = point(&place);
        let message =
            format!("the edges from corners {first} and {second}, counted from 0, meet at {at}");
        found.add(path, message);
    }
}

/// A polygon has an area and does not cross itself.
pub(crate) fn polygon(points: &[Vec<f64>], path: &str, found: &mut Problems) {
    let Some(corners) = chain(points, true, path, found) else {
        return;
    };
    let [lo, hi] = sph_core::bounds(corners.iter().copied());
    let polygon = Polygon::new(corners);
    let size = (hi[0] - lo[0]).max(hi[1] - lo[1]);
    let flat = (hi[0] - lo[0]).min(hi[1] - lo[1]) <= 1e-12 * size;
    let edges: Vec<_> = polygon.edges().collect();
    if !flat && crossing(&edges, true).is_some() {
        crossed(&edges, true, path, found);
    } else if flat || polygon.area().abs() <= 1e-12 * size * size {
        found.add(path, "the polygon has no area");
    }
}
