//! Rigid displacement of a wall from its reference position.

use crate::geometry::vector::{cross, padded};

/// x = c + R (X − c) + b, with X the reference position, lifted by the wall's [`Bend`](crate::Bend) at its moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<const D: usize = 2> {
    /// b, m.
    pub translation: [f64; D],
    /// R, row by row.
    pub rotation: [[f64; D]; D],
    /// c, in the reference position, m.
    pub centre: [f64; D],
    /// The time at which the bend of the wall is taken, s; 0 for walls without one.
    pub moment: f64,
}

impl<const D: usize> Default for Pose<D> {
    fn default() -> Self {
        Pose {
            translation: [0.0; D],
            rotation: identity(),
            centre: [0.0; D],
            moment: 0.0,
        }
    }
}

fn identity<const D: usize>() -> [[f64; D]; D] {
    std::array::from_fn(|i| std::array::from_fn(|k| f64::from(u8::from(i == k))))
}

impl<const D: usize> Pose<D> {
    /// A rotation by `angle` rad about a unit axis through `centre`, right-handed; anticlockwise in the plane.
    ///
    /// R = cos φ I + sin φ E + (1 − cos φ) e eᵀ, E v = e × v (Rodrigues).
    pub fn turned_about(e: [f64; 3], angle: f64, centre: [f64; D]) -> Self {
        if angle == 0.0 {
            return Self::default();
        }
        let (sine, cosine) = angle.sin_cos();
        let mut pose = Self {
            centre,
            ..Self::default()
        };
        for (k, unit) in identity::<D>().into_iter().enumerate() {
            // The k-th column is the image of the k-th unit vector.
            let cross = swept(e, unit);
            for i in 0..D {
                let along = if D == 2 { 0.0 } else { e[i] * e[k] };
                pose.rotation[i][k] = cosine * unit[i] + sine * cross[i] + (1.0 - cosine) * along;
            }
        }
        pose
    }

    /// True if there is a rotation.
    pub fn turns(&self) -> bool {
        self.rotation != identity()
    }

    /// The map as a function; exact where there is no rotation.
    pub fn map(&self) -> impl Fn([f64; D]) -> [f64; D] + use<D> {
        let (pose, turns) = (*self, self.turns());
        move |x| {
            if !turns {
                return std::array::from_fn(|k| x[k] + pose.translation[k]);
            }
            let arm: [f64; D] = std::array::from_fn(|k| x[k] - pose.centre[k]);
            let turned = pose.turned(arm);
            std::array::from_fn(|k| pose.centre[k] + turned[k] + pose.translation[k])
        }
    }

    /// R times a vector.
    pub fn turned(&self, vector: [f64; D]) -> [f64; D] {
        self.rotation
            .map(|row| row.iter().zip(&vector).map(|(r, v)| r * v).sum())
    }
}

/// e × v.
pub(crate) fn swept<const D: usize>(e: [f64; 3], v: [f64; D]) -> [f64; D] {
    padded(&cross(e, padded(&v)))
}

#[cfg(test)]
mod tests {
    use sph_core::Vect;

    use super::*;

    #[test]
    fn quarter_turn_about_a_centre() {
        let pose = Pose {
            translation: [1.0, 0.0],
            ..Pose::turned_about([0.0, 0.0, 1.0], 0.5 * std::f64::consts::PI, [2.0, 0.0])
        };
        let [x, y] = pose.map()([3.0, 0.0]);
        assert!((x - 3.0).abs() < 1e-15 && (y - 1.0).abs() < 1e-15);
    }

    #[test]
    fn turn_about_an_axis() {
        // A third of a turn about the diagonal carries x to y to z.
        let third = std::f64::consts::TAU / 3.0;
        let diagonal = [1.0 / 3.0_f64.sqrt(); 3];
        let pose = Pose::turned_about(diagonal, third, [0.0; 3]);
        let y = pose.map()([1.0, 0.0, 0.0]);
        assert!((Vect::from(y) - Vect::from([0.0, 1.0, 0.0])).norm() < 1e-15);
    }
}
