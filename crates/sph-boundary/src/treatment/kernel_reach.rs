//! Distance behind a wall beyond which the kernel is negligible.

use sph_kernels::Sampler;

/// Share of a particle's kernel that may be behind a wall.
const SEEN: f64 = 0.01;
/// Steps of integrals over the kernel.
const STEPS: u32 = 400;

/// Distance of a plane beyond which less than [`SEEN`] of the kernel lies, m.
///
/// In two dimensions 2r acos(d/r), in three 2πr(r − d) of the circle or sphere of radius r is beyond the distance d.
pub(crate) fn far_sight<const D: usize>(kernel: &dyn Sampler) -> f64 {
    let radius = kernel.support_radius();
    let beyond = |d: f64| -> f64 {
        let width = (radius - d) / f64::from(STEPS);
        let part = |k: u32| {
            let r = d + (f64::from(k) + 0.5) * width;
            let cap = match D {
                2 => 2.0 * r * (d / r).acos(),
                _ => std::f64::consts::TAU * r * (r - d),
            };
            kernel.at(r).0 * cap * width
        };
        (0..STEPS).map(part).sum()
    };
    let (mut near, mut far) = (0.0, radius);
    for _ in 0..40 {
        let middle = 0.5 * (near + far);
        match beyond(middle) > SEEN {
            true => near = middle,
            false => far = middle,
        }
    }
    far
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wendland C2 in the plane: the share beyond a line at q = d/h, by quadrature of its marginal density.
    #[test]
    fn a_hundredth_of_the_kernel_is_beyond_the_far_sight() {
        let (h, kernel) = (0.5, sph_kernels::wendland_c2());
        let sampler = sph_kernels::Kernel::sampler(&kernel, 2, h);
        let far = far_sight::<2>(&*sampler);
        let n = 400;
        let step = 2.0 * h / f64::from(n);
        let mut beyond = 0.0;
        for i in 0..n {
            for j in -n..n {
                let [x, y] = [i, j].map(|k| (f64::from(k) + 0.5) * step);
                let w = sampler.at(x.hypot(y)).0;
                beyond += if x > far { w * step * step } else { 0.0 };
            }
        }
        assert!((beyond / SEEN - 1.0).abs() < 0.03, "{beyond} beyond {far}");
    }
}
