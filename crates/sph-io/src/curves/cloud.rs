//! Values between particles.

use nalgebra::{Matrix4, Vector4};
use sph_core::place_cells::PlaceCells;

/// Radius of the fit, in spacings: some 20 particles in the plane and 65 in space.
const RADIUS: f64 = 2.5;
/// A place is in the fluid if a particle is so near, in spacings: half of the diagonal of a cell of a lattice in space
/// is 0.87.
const INSIDE: f64 = 1.0;
/// Least eigenvalue of the matrix of a fit, over the largest one, with which a slope is believed.
const LEAST: f64 = 1e-6;
/// Most that the shares of a value add up to without their signs. It is 1 in between particles, 2 at a plane surface, half
/// a spacing beyond the last row, and 2.9 in the corner of a full box. Beyond that a value is guessed from a slope.
const STRETCHED: f64 = 3.0;

/// Particles, and the share that each has in the value at a place.
pub type Weights = Vec<(u32, f64)>;

/// Points sorted into cells, between which fields are fitted.
///
/// The value at x is that of the linear function with the least Σ w(|r_j − x|) (f(r_j) − f_j)², w = (1 − r²/R²)² and
/// R = 2.5 spacings: moving least squares of first order, exact for linear fields. Where the particles around do not
/// determine a slope it is their mean.
///
/// ```
/// use sph_io::curves::Cloud;
/// let points: Vec<[f64; 3]> = (0..100).map(|k| [0.1 * (k % 10) as f64, 0.1 * (k / 10) as f64, 0.0]).collect();
/// let cloud = Cloud::new(&points, 0.1);
/// let weights = cloud.weights([0.43, 0.52, 0.0]).unwrap();
/// let value: f64 = weights.iter().map(|(j, w)| w * (2.0 * points[*j as usize][0] - points[*j as usize][1])).sum();
/// assert!((value - 0.34).abs() < 1e-12);
/// assert!(cloud.weights([3.0, 0.0, 0.0]).is_none());
/// ```
pub struct Cloud<'a> {
    /// The points, m.
    pub points: &'a [[f64; 3]],
    /// Their distance, m.
    pub spacing: f64,
    cells: PlaceCells<3, u32>,
    /// True if they lie in a plane of constant z.
    pub planar: bool,
}

impl<'a> Cloud<'a> {
    /// Sorts points that are some `spacing` apart, both in m. Points in a plane of constant z are taken as those of
    /// that plane.
    pub fn new(points: &'a [[f64; 3]], spacing: f64) -> Self {
        let first = points.first().map_or(0.0, |p| p[2]);
        let planar = points.iter().all(|p| p[2] == first);
        let finite = |(_, p): &(u32, &[f64; 3])| p.iter().all(|x| x.is_finite());
        let finite = (0..).zip(points).filter(finite);
        let cells = finite.map(|(k, point)| (zyx(*point), k));
        Cloud {
            points,
            spacing,
            cells: PlaceCells::new(RADIUS * spacing, cells),
            planar,
        }
    }

    /// The share of every particle around in the value at a place (m); nothing outside of the fluid.
    pub fn weights(&self, x: [f64; 3]) -> Option<Weights> {
        let reach = RADIUS * self.spacing;
        let mut matrix = Matrix4::<f64>::zeros();
        let mut near: Vec<(u32, f64, Vector4<f64>)> = Vec::new();
        let mut nearest = f64::INFINITY;
        for &j in self.cells.around(zyx(x)) {
            let d = [0, 1, 2].map(|k| self.points[j as usize][k] - x[k]);
            let r2 = square(&d);
            if r2 < reach * reach {
                nearest = nearest.min(r2);
                let weight = (1.0 - r2 / (reach * reach)).powi(2);
                let basis = Vector4::new(1.0, d[0] / reach, d[1] / reach, d[2] / reach);
                matrix.ger(weight, &basis, &basis, 1.0);
                near.push((j, weight, basis));
            }
        }
        if nearest.sqrt() > INSIDE * self.spacing {
            return None;
        }
        let total = matrix[(0, 0)];
        if self.planar {
            // z has no information; its row becomes that of the unit matrix.
            matrix[(3, 3)] = total;
        }
        let spectrum = matrix.symmetric_eigenvalues();
        let believed = spectrum.min() > LEAST * spectrum.max();
        let slope = believed.then(|| matrix.cholesky()).flatten();
        let slope = slope.map(|m| m.solve(&Vector4::x()));
        let factor = slope.unwrap_or_else(|| Vector4::x() / total);
        let share = |(j, weight, basis): (u32, f64, Vector4<f64>)| (j, weight * factor.dot(&basis));
        let shares: Weights = near.into_iter().map(share).collect();
        let stretched: f64 = shares.iter().map(|(_, share)| share.abs()).sum();
        (stretched <= STRETCHED).then_some(shares)
    }
}

/// A place as cells have it, so that neighbours come in the order of their x, y and z.
fn zyx([x, y, z]: [f64; 3]) -> [f64; 3] {
    [z, y, x]
}

pub(crate) fn square(d: &[f64; 3]) -> f64 {
    d.iter().map(|x| x * x).sum()
}
