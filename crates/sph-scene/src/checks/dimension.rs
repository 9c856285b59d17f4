//! Vectors and shapes against the number of dimensions.

use scene_text::Problems;

/// The number of dimensions of the scene, against which vectors are held.
#[derive(Clone, Copy)]
pub(crate) struct Dimension(pub usize);

impl Dimension {
    /// True if a vector has one entry per dimension; if not, a problem is added.
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
