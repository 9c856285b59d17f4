//! The velocity of the row of particles in front of a place.

use sph_core::Vect;

/// The velocity in front of a place of a face, by a fit that is linear along the face: the mean over the support smooths a
/// profile, and a flux that is too large beside a wall draws the fluid to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row<const D: usize> {
    /// Σ w, Σ w t and Σ w t².
    weights: [f64; 3],
    /// Σ w u and Σ w t u.
    velocities: [Vect<D>; 2],
}

/// Share with which a row counts who is beside a place by the square of a distance, m²: exp(−2 t²/δr²).
pub(crate) fn near(squared: f64, spacing: f64) -> f64 {
    (-2.0 * squared / (spacing * spacing)).exp()
}

impl<const D: usize> Default for Row<D> {
    fn default() -> Self {
        Row {
            weights: [0.0; 3],
            velocities: [Vect::zeros(); 2],
        }
    }
}

impl<const D: usize> Row<D> {
    /// Adds a particle on the way `apart` before the place, with its share in a mean.
    pub fn add(&mut self, n: &Vect<D>, apart: &Vect<D>, spacing: f64, share: f64, u: &Vect<D>) {
        let along = apart - n * apart.dot(n);
        let w = share * near(along.norm_squared(), spacing);
        // Along a line; over a surface the mean is taken.
        let t = if D == 2 {
            along[1] * n[0] - along[0] * n[1]
        } else {
            0.0
        };
        let all = self.weights.iter_mut().zip([w, w * t, w * t * t]);
        all.for_each(|(sum, x)| *sum += x);
        self.velocities[0] += u * w;
        self.velocities[1] += u * (w * t);
    }

    /// Σ w of all that were added.
    pub fn weight(&self) -> f64 {
        self.weights[0]
    }

    /// The velocity at the place; nothing where no particle is near.
    pub fn velocity(&self, spacing: f64) -> Option<Vect<D>> {
        let [w, t, tt] = self.weights;
        let determinant = w * tt - t * t;
        if determinant > 1e-2 * (w * spacing).powi(2) {
            return Some((self.velocities[0] * tt - self.velocities[1] * t) / determinant);
        }
        (w > 0.0).then(|| self.velocities[0] / w)
    }
}
