//! Kernel sums below a plane surface.

use sph_kernels::{Sampler, gauss_points};

/// Depths of the table.
const DEPTHS: usize = 256;

/// The share of the support that a plane surface takes, over the slope of the concentration: 1 − S(d) over w₁(d).
///
/// w₁(z) is the kernel integrated over the plane at a distance z (1/m), S(d) = ∫_{−∞}^d w₁ dz its share of a half-space at
/// a depth d (m) below the surface.
pub(super) struct HalfSpace {
    /// w₁ at growing depths, 1/m: it falls.
    slope: Vec<f64>,
    /// 1 − S there.
    deficit: Vec<f64>,
}

impl HalfSpace {
    /// Of a kernel in `dimension` dimensions.
    pub(super) fn new(kernel: &dyn Sampler, dimension: usize) -> Self {
        let reach = kernel.support_radius();
        let depth = |k: usize| reach * k as f64 / DEPTHS as f64;
        let plane = |z: f64| -> f64 {
            let radius = (reach * reach - z * z).max(0.0).sqrt();
            let ring = |y: f64| match dimension {
                2 => 2.0,
                _ => 2.0 * std::f64::consts::PI * y,
            };
            let at = |y: f64| ring(y) * kernel.at((z * z + y * y).sqrt()).0;
            let points = gauss_points(0.0, radius, 16);
            points.map(|[y, part]| part * at(y)).sum()
        };
        let mut deficit = vec![0.0; DEPTHS + 1];
        for k in (0..DEPTHS).rev() {
            let row = gauss_points(depth(k), depth(k + 1), 1);
            deficit[k] = deficit[k + 1] + row.map(|[z, part]| part * plane(z)).sum::<f64>();
        }
        HalfSpace {
            slope: (0..=DEPTHS).map(|k| plane(depth(k))).collect(),
            deficit,
        }
    }

    /// 1 − S(d) at the depth d where w₁ is `slope`, 1/m: from 1/2 at the surface to 0.
    pub(super) fn deficit(&self, slope: f64) -> f64 {
        let k = self.slope.partition_point(|s| *s > slope);
        if k == 0 || k > DEPTHS {
            return self.deficit[k.min(DEPTHS)];
        }
        let part = (self.slope[k - 1] - slope) / (self.slope[k - 1] - self.slope[k]);
        self.deficit[k - 1] + part * (self.deficit[k] - self.deficit[k - 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_kernels::{Kernel, by_name};

    #[test]
    fn a_plane_surface_takes_half_of_the_support_at_it_and_nothing_beyond() {
        for dimension in [2, 3] {
            let kernel = by_name("wendland-c2").unwrap().sampler(dimension, 0.5);
            let table = HalfSpace::new(&*kernel, dimension);
            let steepest = table.slope[0];
            assert!((table.deficit(2.0 * steepest) - 0.5).abs() < 1e-6);
            assert_eq!(table.deficit(0.0), 0.0);
            let falls = (1..100).map(|k| table.deficit(steepest * f64::from(k) / 100.0));
            assert!(falls.is_sorted());
        }
    }
}
