//! Checks of one table of a scene: vectors, chains of corners and shapes against the number of dimensions.

use scene_text::Problems;

use crate::Polygon;
use crate::geometry::polygon::{Edge, crossing};
use crate::geometry::vector::{array, point};

/// A table that is checked, by its path, the empty one for the whole scene, and the problems found so far.
pub(crate) struct TableCheck<'f> {
    pub path: String,
    /// Number of dimensions of the scene.
    pub dimension: usize,
    pub found: &'f mut Problems,
}

impl TableCheck<'_> {
    /// A table or list in this one, by its key or `[index]`.
    pub fn below(&mut self, key: &str) -> TableCheck<'_> {
        TableCheck {
            path: self.path_of(key),
            dimension: self.dimension,
            found: &mut *self.found,
        }
    }

    fn path_of(&self, key: &str) -> String {
        let apart = !(self.path.is_empty() || key.is_empty() || key.starts_with('['));
        let dot = if apart { "." } else { "" };
        format!("{}{dot}{key}", self.path)
    }

    /// Adds a problem at a key, without one at the table itself.
    pub fn add(&mut self, key: &str, message: impl Into<String>) {
        self.found.add(self.path_of(key), message);
    }

    /// Adds a problem if there is one, and returns whether there is.
    pub fn refuse(&mut self, wrong: bool, key: &str, message: impl Into<String>) -> bool {
        if wrong {
            self.add(key, message);
        }
        wrong
    }

    /// True if a vector, where it is given, has one entry per dimension.
    pub fn vector<'v>(&mut self, key: &str, list: impl Into<Option<&'v Vec<f64>>>) -> bool {
        let wanted = self.dimension;
        let given = list.into().map_or(wanted, Vec::len);
        let message = format!("expected {wanted} numbers in {wanted}D, found {given}");
        !self.refuse(given != wanted, key, message)
    }

    /// Checks that a vector has the right length and is not zero.
    pub fn direction(&mut self, key: &str, list: &Vec<f64>) {
        let zero = self.vector(key, list) && list.iter().all(|c| *c == 0.0);
        self.refuse(zero, key, "a direction of length 0 is none");
    }

    /// An axis is given in space, where it is `needed`, and in the plane there is none.
    pub fn axis(&mut self, axis: &Option<Vec<f64>>, needed: bool) {
        match axis {
            Some(_) if self.dimension == 2 => {
                self.add("axis", "a rotation in 2D has no axis: it is anticlockwise");
            }
            Some(axis) => self.direction("axis", axis),
            None if self.dimension == 3 && needed => {
                self.add("", "the key `axis` is missing: axis of the rotation");
            }
            None => {}
        }
    }

    /// Two points have the right length and differ.
    pub fn apart(&mut self, (first, a): (&str, &Vec<f64>), (second, b): (&str, &Vec<f64>)) {
        let right = self.vector(first, a) & self.vector(second, b);
        let message = format!("`{first}` and `{second}` must differ");
        self.refuse(right && a == b, second, message);
    }

    /// The table of a shape, if it is of the dimension of the scene.
    pub fn shape(&mut self, key: &str, what: &str, dimension: usize) -> Option<TableCheck<'_>> {
        let own = self.dimension;
        let message = format!("{what} is a shape of {dimension}D, and this scene is {own}D");
        (!self.refuse(dimension != own, key, message)).then(|| self.below(key))
    }

    /// Two corners have the right length, and one is below the other.
    pub fn corners(&mut self, key: &str, [low, high]: &[Vec<f64>; 2]) {
        let mut check = self.below(key);
        if !(check.vector("[0]", low) & check.vector("[1]", high)) {
            return;
        }
        for (axis, (lo, hi)) in ["x", "y", "z"].iter().zip(low.iter().zip(high)) {
            let message = format!(
                "the lower corner must be below the upper along {axis}, found {lo} and {hi}"
            );
            check.refuse(lo >= hi, "", message);
        }
    }

    /// Corners in the plane, if each has two coordinates and differs from the one before.
    pub fn chain(&mut self, key: &str, points: &[Vec<f64>], closed: bool) -> Option<Vec<[f64; 2]>> {
        let mut list = TableCheck {
            dimension: 2,
            ..self.below(key)
        };
        let mut before = points.last().filter(|_| closed);
        for (k, p) in points.iter().enumerate() {
            let index = format!("[{k}]");
            if !list.vector(&index, p) {
                return None;
            }
            if before.replace(p) == Some(p) {
                let message = format!("the corner {} stands there twice in a row", point(p));
                list.add(&index, message);
                return None;
            }
        }
        Some(points.iter().map(|p| array(p)).collect())
    }

    /// True if an edge meets another.
    pub fn crossed(&mut self, key: &str, edges: &[Edge], closed: bool) -> bool {
        let Some((first, second, place)) = crossing(edges, closed) else {
            return false;
        };
        let at = point(&place);
        let message =
            format!("the edges from corners {first} and {second}, counted from 0, meet at {at}");
        self.refuse(true, key, message)
    }

    /// A polygon has an area and does not cross itself.
    pub fn polygon(&mut self, key: &str, points: &[Vec<f64>]) {
        let Some(corners) = self.chain(key, points, true) else {
            return;
        };
        let polygon = Polygon::new(corners);
        let [lo, hi] = polygon.bounds();
        let size = (hi[0] - lo[0]).max(hi[1] - lo[1]);
        let flat = (hi[0] - lo[0]).min(hi[1] - lo[1]) <= 1e-12 * size;
        let edges: Vec<_> = polygon.edges().collect();
        if flat || !self.crossed(key, &edges, true) {
            let empty = flat || polygon.area().abs() <= 1e-12 * size * size;
            self.refuse(empty, key, "the polygon has no area");
        }
    }
}
