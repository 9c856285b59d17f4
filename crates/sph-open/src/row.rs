//! The fluid in front of an element of an open face, and the velocity of its row of particles.

use sph_core::Vect;
use sph_neighbours::Words;

use crate::FluidMean;

/// The fluid in front of an element, the same for all owners, so that all let the same pass.
#[derive(Clone)]
pub(crate) struct AdjacentFluid<const D: usize> {
    pub inside: FluidMean<D>,
    /// Distance of that mean before the face, m.
    pub reach: f64,
    /// Velocity of the row of particles, m/s.
    pub row: Vect<D>,
    /// Shares of the phases.
    pub mix: Vec<f64>,
    /// The missing part of the row, over the weight of a row on the face: φ − ½ with a row at φ δr.
    pub lacks: f64,
    /// Distance of the nearest particle to the centre, m.
    pub nearest: f64,
}

impl<const D: usize> AdjacentFluid<D> {
    /// That where no particle is near.
    pub fn new(phases: usize) -> Self {
        AdjacentFluid {
            inside: FluidMean::nothing(),
            reach: 0.0,
            row: Vect::zeros(),
            mix: vec![0.0; phases],
            lacks: 0.0,
            nearest: f64::INFINITY,
        }
    }

    fn each(&mut self, mut visit: impl FnMut(&mut f64)) {
        let inside = &mut self.inside;
        visit(&mut inside.pressure);
        visit(&mut inside.impedance);
        visit(&mut inside.density);
        visit(&mut inside.mean_pressure);
        visit(&mut inside.filled);
        visit(&mut self.reach);
        visit(&mut self.lacks);
        visit(&mut self.nearest);
        let vectors = [&mut inside.velocity, &mut inside.mean, &mut self.row];
        let vectors = vectors.into_iter().flat_map(|v| v.iter_mut());
        vectors.chain(&mut self.mix).for_each(visit);
    }
}

impl<const D: usize> Words for AdjacentFluid<D> {
    fn write(&self, to: &mut Vec<u64>) {
        to.extend([u64::from(self.inside.wet), self.mix.len() as u64]);
        self.clone().each(|x| to.push(x.to_bits()));
    }

    fn read(from: &[u64]) -> Self {
        let mut seen = AdjacentFluid::new(from[1] as usize);
        seen.inside.wet = from[0] != 0;
        let mut numbers = from[2..].iter();
        seen.each(|x| *x = numbers.next().map_or(0.0, |bits| f64::from_bits(*bits)));
        seen
    }
}

/// The velocity in front of a place of a face, by a fit that is linear along the face: the mean over the support smooths a
/// profile, and a flux that is too large beside a wall draws the fluid to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row<const D: usize> {
    /// Σ w, Σ w t and Σ w t², with t along the first axis of the face.
    pub weights: [f64; 3],
    /// Σ w s, Σ w s t and Σ w s², with s along the second; 0 in the plane.
    across: [f64; 3],
    /// Σ w u, Σ w t u and Σ w s u.
    velocities: [Vect<D>; 3],
    /// Volume of those that [stand](row_weight) before the place.
    pub volume: f64,
}

/// Share with which a row counts a particle beside a place by the square of a distance, m²: exp(−2 t²/δr²).
pub(crate) fn near(squared: f64, spacing: f64) -> f64 {
    (-2.0 * squared / (spacing * spacing)).exp()
}

/// Share of particles at a distance before a face in the wetted part of the face: a hat from 0 to 2 δr. Over
/// rows that are δr apart it sums up to 1 wherever the first of them is, so that a row that has gone a way is no dry face.
pub(crate) fn row_weight(distance: f64, spacing: f64) -> f64 {
    (1.0 - (distance / spacing - 1.0).abs()).max(0.0)
}

impl<const D: usize> Default for Row<D> {
    fn default() -> Self {
        Row {
            weights: [0.0; 3],
            across: [0.0; 3],
            velocities: [Vect::zeros(); 3],
            volume: 0.0,
        }
    }
}

/// Least determinant of a fit, over that of particles a spacing apart: below it all are on a line.
const FLAT: f64 = 1e-2;

impl<const D: usize> Row<D> {
    /// Adds a particle on the way `apart` before the place, with its share in a mean and its volume.
    pub fn add(
        &mut self,
        n: &Vect<D>,
        apart: &Vect<D>,
        spacing: f64,
        [share, volume]: [f64; 2],
        u: &Vect<D>,
    ) {
        let height = -apart.dot(n);
        let along = apart + n * height;
        let beside = near(along.norm_squared(), spacing);
        self.volume += volume * beside * row_weight(height, spacing);
        let w = share * beside;
        let [t, s] = coordinates(n, &along);
        let all = self.weights.iter_mut().zip([w, w * t, w * t * t]);
        all.for_each(|(sum, x)| *sum += x);
        self.velocities[0] += u * w;
        self.velocities[1] += u * (w * t);
        if D > 2 {
            let all = self.across.iter_mut().zip([w * s, w * s * t, w * s * s]);
            all.for_each(|(sum, x)| *sum += x);
            self.velocities[2] += u * (w * s);
        }
    }

    /// The velocity at the place; nothing where no particle is near.
    pub fn velocity(&self, spacing: f64) -> Option<Vect<D>> {
        let [w, t, tt] = self.weights;
        if D > 2 {
            return self.over_a_surface(spacing);
        }
        let determinant = w * tt - t * t;
        if determinant > FLAT * (w * spacing).powi(2) {
            return Some((self.velocities[0] * tt - self.velocities[1] * t) / determinant);
        }
        (w > 0.0).then(|| self.velocities[0] / w)
    }

    /// By the first row of the inverse of the symmetric 3 × 3 matrix of the moments.
    fn over_a_surface(&self, spacing: f64) -> Option<Vect<D>> {
        let [w, t, tt] = self.weights;
        let [s, st, ss] = self.across;
        let inverse = [tt * ss - st * st, s * st - t * ss, t * st - s * tt];
        let determinant = w * inverse[0] + t * inverse[1] + s * inverse[2];
        if determinant > FLAT * FLAT * w.powi(3) * spacing.powi(4) {
            let sum = self.velocities.iter().zip(inverse).map(|(u, x)| u * x);
            return Some(sum.sum::<Vect<D>>() / determinant);
        }
        (w > 0.0).then(|| self.velocities[0] / w)
    }
}

/// Coordinates of a vector in the face with the unit normal n.
fn coordinates<const D: usize>(n: &Vect<D>, along: &Vect<D>) -> [f64; 2] {
    if D == 2 {
        return [along[1] * n[0] - along[0] * n[1], 0.0];
    }
    // e₁ is a coordinate axis far from n, without its part along n; e₂ = n × e₁.
    let axis = if n[0].abs() < 0.6 { 0 } else { 1 };
    let unit = Vect::<D>::from_fn(|k, _| if k == axis { 1.0 } else { 0.0 });
    let e = (unit - n * n[axis]).normalize();
    let f = [
        n[1] * e[2] - n[2] * e[1],
        n[2] * e[0] - n[0] * e[2],
        n[0] * e[1] - n[1] * e[0],
    ];
    [
        along.dot(&e),
        f[0] * along[0] + f[1] * along[1] + f[2] * along[2],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A velocity that is linear along the face is found at the place, wherever the particles are.
    #[test]
    fn a_linear_velocity_over_a_surface_is_exact() {
        let n = Vect::<3>::new(1.0, 2.0, -2.0) / 3.0;
        let (spacing, at_place) = (0.1, Vect::<3>::new(0.3, -0.2, 0.7));
        let slope = [
            Vect::<3>::new(1.0, 0.5, 0.0),
            Vect::<3>::new(0.0, -2.0, 1.0),
            Vect::<3>::new(0.3, 0.0, 0.9),
        ];
        let mut row = Row::<3>::default();
        for k in 0..7 {
            let x = [0.03, 0.11, -0.06].map(|f| 0.1 * (f64::from(k) * (1.0 + 37.0 * f)).sin());
            let apart = Vect::<3>::from(x);
            let along = apart - n * apart.dot(&n);
            let both = slope.iter().zip(along.iter());
            let u = both.fold(at_place, |u, (s, x)| u + s * *x);
            row.add(&n, &apart, spacing, [0.7 + 0.1 * f64::from(k), 1.0], &u);
        }
        let off = row.velocity(spacing).map(|u| (u - at_place).norm());
        assert!(off.is_some_and(|off| off < 1e-12), "{off:?}");
    }

    #[test]
    fn where_all_are_on_a_line_the_mean_is_taken() {
        let n = Vect::<3>::new(0.0, 0.0, 1.0);
        let mut row = Row::<3>::default();
        for x in [-0.1, 0.1] {
            let apart = Vect::<3>::new(x, 0.0, 0.05);
            row.add(&n, &apart, 0.1, [1.0, 1.0], &(n * 2.0));
        }
        assert_eq!(row.velocity(0.1).map(|u| u[2]), Some(2.0));
        assert_eq!(Row::<3>::default().velocity(0.1), None);
    }
}
